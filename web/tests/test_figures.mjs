/* Figures: nothing moves by itself, what is printed, drawn, saved and played. */
import { readFileSync } from "node:fs";
import { random_hands, tasks_done } from "./hands.mjs";
import { drag_brake, SIZES } from "./still.mjs";
import { check, test, url } from "./suite.mjs";
import { seen_together, SIZES as WINDOWS } from "./together.mjs";
import { VIEWS } from "./visit.mjs";

export async function test_figures({ page, settled, same_as_the_program, text_of }) {
    await test("nothing moves under a hand, nor while it loads", async () => {
        for (const [width, height] of process.env.ROLLBEM_TEST_ALL ? SIZES : SIZES.slice(1, 2)) {
            const { loading, shift, moved, errors } = await drag_brake(url, width, height),
                what = `${width} x ${height}`;
            check(moved < 1 && shift < 0.01, `${what}: moved ${moved} px, layout shift ${shift}`);
            check(loading < 0.01, `${what}: layout shift ${loading} while it loads`);
            check(!errors.length, `${what}: ${errors}`);
        }
        await page.tab("Page.bringToFront");
    });
    if (process.env.ROLLBEM_TEST_ALL)
        await test("every slider stands in one window with its picture, at four sizes", async () => {
            for (const [width, height] of WINDOWS) {
                const rows = await seen_together(url, width, height),
                    short = rows.filter(({ part }) => part < 0.9);
                check(rows.length > 25 && !short.length, `${width} x ${height}: ${JSON.stringify(short)}`);
            }
        });
    if (process.env.ROLLBEM_TEST_ALL)
        await test("ten tasks of a lecturer, and random hands", async () => {
            const { rows, errors } = await tasks_done(url),
                not_done = rows.filter(({ said }) => said);
            check(rows.length === 10 && !not_done.length && !errors.length, JSON.stringify({ not_done, errors }));
            const { faults } = await random_hands(url, { width: 1280, height: 720, seconds: 30, seed: Date.now() });
            check(!faults.length, faults.join("; "));
        });
    await test("printed: a page for each chapter that was seen, its figure as wide as the page", async () => {
        for (const view of VIEWS) {
            await page.run(`rollbem.open('${view}')`);
            await settled();
        }
        await page.run("document.querySelectorAll('main details').forEach((d) => { d.open = false; })");
        const { data } = await page.tab("Page.printToPDF", {
                printBackground: true,
                paperWidth: 8.27,
                paperHeight: 11.69,
            }),
            pages = Buffer.from(data, "base64")
                .toString("latin1")
                .match(/\/Type\s*\/Page\b/g).length;
        check(pages === VIEWS.length, `${pages} pages of ${VIEWS.length} chapters`);
        await page.tab("Emulation.setEmulatedMedia", { media: "print" });
        await page.size(718, 1046);
        const wide = await page.run(
            "[...document.querySelectorAll('.two figure svg')].filter((e) => e.clientWidth).map((e) => e.getBoundingClientRect().width)",
        );
        await page.tab("Emulation.setEmulatedMedia", { media: "" });
        await page.size(1280, 900);
        check(wide.length > 4 && Math.min(...wide) > 400, `${wide}`);
    });
    await test("the three sentences of docs/page.md are what the first screen shows", async () => {
        const text = readFileSync("docs/page.md", "utf8").replace(/\s+/g, " ");
        for (const sentence of [
            "on the left, at the rear, the lines are torn; on the right, where the material enters, they are whole",
            "a little slower than it travels, a quarter of a percent",
            "Braking harder moves the border to the front, until all of it slips and the wheel skids",
        ])
            check(text.includes(sentence), sentence);
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        const places = () =>
            page.run(`(() => {
                const picture = new DOMParser().parseFromString(rollbem.views.hero.picture_of(), "image/svg+xml").documentElement;
                document.body.append(picture);
                const box = (name) => { const b = picture.querySelector("path." + name)?.getBBox(); return b ? [b.x, b.x + b.width] : null; };
                const found = [box("slip"), box("stick")];
                picture.remove();
                return found;
            })()`);
        const [slip, stick] = await places(),
            facts = await text_of(".facts");
        /* lines lean, so that those at the border stand above each other */
        check(slip[0] < stick[0] - 100 && slip[1] < stick[1] - 100, `${slip} torn, ${stick} whole`);
        check(/the rim turns\s*0.26 % slower than it travels/.test(facts), facts);
        await page.run("rollbem.page.change({ ...rollbem.page.given, 'creep-ratio': '0.8' })");
        await settled();
        const [, harder] = await places();
        check(harder[0] > stick[0] + 40, `whole from ${stick[0]}, then from ${harder[0]}`);
        await page.run("rollbem.page.change({ ...rollbem.page.given, 'creep-ratio': '1.1' })");
        await settled();
        check((await text_of("#headline")) === "Now it skids." && !(await places())[1], await text_of("#headline"));
    });
    await test("the slider of Poisson's ratio ends where the library refuses", async () => {
        await page.run("rollbem.preset('roll'); rollbem.open('bench')");
        const end = () => page.run("Number(document.querySelector('[data-knob=poisson]').max)");
        await settled();
        check((await end()) === 0.499, `Poisson's ratio of a cover on an elastic core ends at ${await end()}`);
        await page.run(
            "rollbem.page.change(Object.fromEntries(Object.entries(rollbem.page.given).filter(([k]) => !/^core|^hub/.test(k))))",
        );
        await settled();
        check((await end()) === 0.5, `Poisson's ratio of a cover on a rigid core ends at ${await end()}`);
    });
    await test("another roll is drawn as one, to scale; a state of another scale is no ghost", async () => {
        const ground = () =>
            page.run(`(() => {
                const picture = new DOMParser().parseFromString(rollbem.views.hero.picture_of(), "image/svg+xml").documentElement;
                const d = picture.querySelector("path.ground").getAttribute("d").match(/[-\\d.]+ [-\\d.]+/g).map((p) => p.split(" ").map(Number));
                return { low: Math.max(...d.map(([, y]) => y)) - d[20][1], reach: d[40][0] - d[20][0] };
            })()`);
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        const plane = await ground();
        await page.run("rollbem.preset('roll')");
        await settled();
        const roll = await ground();
        check(plane.low === 0 && roll.low > 0.6 * roll.reach, JSON.stringify([plane, roll]));
        const ghosts = await page.run("document.querySelectorAll('#at-bench .tractions .ghost').length");
        check(ghosts === 0, `${ghosts} lines of 1000 MPa on an axis of 2 MPa`);
        await page.run("rollbem.page.change({ ...rollbem.page.given, load: '30' })");
        await settled();
        check(await page.run("document.querySelectorAll('#at-bench .tractions .ghost').length === 2"), "no ghost");
        await page.run("rollbem.open('hero')");
        await settled();
        check(
            /to scale, R = 150 mm/.test(await page.run("rollbem.views.hero.picture_of()")),
            "the radius of the wheel",
        );
        check(
            await page.run("!/[.][.]/.test(document.querySelector('.hero .trouble').textContent)"),
            "two full stops after a note",
        );
    });
    await test("below: the brake without friction moves nothing, and a sentence says so", async () => {
        await page.run(
            "rollbem.preset('rail'); rollbem.page.change(rollbem.page.with_mu(rollbem.page.given, 0)); rollbem.open('below')",
        );
        await settled();
        await page.run("rollbem.views.below.reveal()");
        await settled();
        await page.run(
            "{ const s = document.querySelector('[data-dial=below-drive]'); s.value = 1; s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); }",
        );
        await settled();
        const told = await text_of("#at-below .tale .answer");
        check(
            /Without friction braking changes nothing/.test(told) &&
                (await page.run("Math.abs(rollbem.page.given.creep - 0.001) < 1e-5")),
            told,
        );
        await page.run("rollbem.preset('rail')");
        await settled();
    });
    await test("pictures and clips are saved as files", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        const saved = async (text, wait) =>
            page.run(`(async () => {
                const blobs = [], make = URL.createObjectURL, timer = window.setTimeout;
                window.setTimeout = (act, ms) => timer(act, Math.min(ms, 1000)); /* a clip of a second */
                URL.createObjectURL = (blob) => { blobs.push(blob); return make.call(URL, blob); };
                HTMLAnchorElement.prototype.click = function () { this.dispatchEvent(new Event("click")); };
                [...document.querySelectorAll("#at-hero .menu button")].find((b) => b.textContent === ${JSON.stringify(text)}).click();
                for (const end = performance.now() + ${wait}; !blobs.length && performance.now() < end; ) await new Promise((r) => setTimeout(r, 50));
                URL.createObjectURL = make;
                window.setTimeout = timer;
                delete HTMLAnchorElement.prototype.click;
                const head = blobs[0] ? [...new Uint8Array(await blobs[0].slice(0, 4).arrayBuffer())] : [];
                return blobs[0] ? [blobs[0].type, blobs[0].size, head] : document.querySelector("#at-hero .menu [role=status]").textContent;
            })()`);
        for (const [text, type, head, least] of [
            ["PNG", "image/png", [0x89, 0x50, 0x4e, 0x47], 20e3],
            ["SVG", "image/svg+xml", [0x3c, 0x73, 0x76, 0x67], 5e3],
            ["Clip (WebM)", "video/webm", [0x1a, 0x45, 0xdf, 0xa3], 10e3],
        ]) {
            const got = await saved(text, 20e3);
            check(
                got[0] === type && got[1] > least && JSON.stringify(got[2]) === JSON.stringify(head),
                `${text}: ${JSON.stringify(got)}`,
            );
        }
    });
    await test("what takes long is cancelled with its worker, and the page goes on", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        await page.run(
            "rollbem.page.change({ support: 'arc', mesh: 'uniform', 'contact-elements': '400', 'outer-elements': '800', load: '100' })",
        );
        await page.until("!document.getElementById('busy').hidden");
        await page.run("document.querySelector('#busy button').click()");
        await settled();
        check(
            /cancelled/.test(await text_of("#message")) &&
                (await page.run("document.querySelector('.contact').classList.contains('stale')")),
            await text_of("#message"),
        );
        await page.run("rollbem.preset('rail')");
        await settled();
        await same_as_the_program();
    });
    await test("what plays goes on while sliders move", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('roll')");
        await settled();
        await page.run("document.querySelector('#at-roll .players .main').click()");
        await page.run("rollbem.page.change({ ...rollbem.page.given, 'creep-ratio': '0.6' })");
        await page.until("rollbem.solver.idle()");
        const at = await page.run("rollbem.views.roll.player.at");
        await page.until(`rollbem.views.roll.player.at > ${at}`);
        check((await text_of("#at-roll .players .main")) === "Pause", "it stopped");
        await page.run("rollbem.views.roll.player.stop()");
    });
}
