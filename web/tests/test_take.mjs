/* What is taken along, shown to a class, made by rollbem page, and opened. */
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { check, check_close, file, FITTED, flatten, library, run, test, url, words_of } from "./suite.mjs";
import { IDLE } from "./visit.mjs";
import { open_page } from "../chromium.mjs";
import { words } from "../words.js";
import { answer } from "../worker.js";

export async function test_take({ page, settled, same_as_the_program }) {
    await test("JSON as the program has it: command, notes, units, status, signs", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('take')");
        await settled();
        const got = JSON.parse(await page.run("document.querySelector('[data-take=json]').value")),
            want = JSON.parse(run(["--json", "--quiet", ...got.command.split(" ").slice(1)]).stdout);
        for (const name of ["schema", "version", "conventions"])
            check(got[name] === want[name], `${name}: ${got[name]}`);
        for (const name of ["notes", "units"])
            check(JSON.stringify(got[name]) === JSON.stringify(want[name]), `${name}: ${JSON.stringify(got[name])}`);
        for (const name of ["status", "formulation", "solver", "lcp_form"])
            check(
                got.summary[name] === want.summary[name],
                `${name}: ${got.summary[name]}, the program has ${want.summary[name]}`,
            );
        for (const name of Object.keys(got.table))
            check(got.table[name].length === want.table[name]?.length, `column ${name}`);
        for (const [name, value] of Object.entries(got.inputs))
            check(want.inputs[name] === value, `input ${name}: ${value}, the program has ${want.inputs[name]}`);
    });
    await test("pictures to take along are whole SVG files", async () => {
        for (const text of [
            await page.run("rollbem.views.hero.picture_of()"),
            await page.run("(rollbem.open('below'), null)"),
        ].filter(Boolean)) {
            const ok = await page.run(
                `(() => { const d = new DOMParser().parseFromString(${JSON.stringify(text)}, "image/svg+xml"); return !d.querySelector("parsererror") && d.querySelectorAll("path").length; })()`,
            );
            check(ok > 20, `${ok} paths`);
        }
    });
    await test("one condition that fails is one", () =>
        check(
            words.guess_wrong.one.startsWith("1 condition fails") &&
                words.guess_wrong.other.includes("conditions fail"),
            "plural",
        ));
    await test("an embedded first screen, and nothing else", async () => {
        const other = await open_page(
            `${url}#mu=0.2&support=halfplane&support-b=halfplane&similar=yes&formulation=steady&load=1000&creep-ratio=0.3&embed=hero`,
        );
        try {
            await other.until(IDLE);
            check(
                await other.run(
                    "document.querySelectorAll('main > section').length === 1 && getComputedStyle(document.querySelector('header')).display === 'none' && rollbem.page.answer.values.mu === '0.2'",
                ),
                "more than the hero, or another case",
            );
            await other.run("location.hash = location.hash.replace('embed=hero', 'embed=lens')");
            await other.until(IDLE);
            check(
                await other.run(
                    "document.querySelector('.says').getBoundingClientRect().height === 0 && document.querySelector('.stage').getBoundingClientRect().height > 0.9 * innerHeight && document.documentElement.scrollHeight <= innerHeight",
                ),
                "more than the lens",
            );
            check(other.errors.length === 0, other.errors.join("; "));
        } finally {
            await other.close();
        }
    });
    await test("slides: one chapter each in 1280 x 590, keys, counted guesses, the answer beside them", async () => {
        const other = await open_page(`${url}#class=slides`, { width: 1280, height: 590 });
        const press = (key) =>
            Promise.all(["keyDown", "keyUp"].map((type) => other.tab("Input.dispatchKeyEvent", { type, key })));
        try {
            await other.until(IDLE);
            const names = await other.run("rollbem.classroom.names");
            check(names.length === 8, names.join());
            for (const [k, name] of names.entries()) {
                check((await other.run("rollbem.classroom.place()")) === name, `slide ${k + 1} is not ${name}`);
                await press("2");
                await press("2");
                await press("1");
                await press("a");
                await other.until(IDLE);
                await other.run("new Promise((resolve) => setTimeout(resolve, 150))");
                await other.until(IDLE);
                const found = await other.run(`(() => {
                    const chapter = document.querySelector("#at-${name}"), floor = document.getElementById("slides").getBoundingClientRect().top,
                        shown = [...chapter.querySelectorAll("figure svg, .stage, input[type=range], .panel .answer")].filter((node) => node.getClientRects().length);
                    return { chapters: [...document.querySelectorAll(".chapter")].filter((node) => node.offsetParent).length,
                        low: shown.filter((node) => node.getBoundingClientRect().bottom > floor + 1 || node.getBoundingClientRect().right > innerWidth).map((node) => node.outerHTML.slice(0, 80)),
                        pictures: shown.filter((node) => !node.matches("input, .answer")).length,
                        counts: [...chapter.querySelectorAll(".tally b")].map((node) => node.textContent).join(),
                        right: chapter.querySelectorAll(".tally.right").length, told: chapter.querySelector(".panel .answer").textContent };
                })()`);
                check(found.chapters === 1 && found.pictures > 0, `${name}: ${JSON.stringify(found)}`);
                check(found.low.length === 0, `${name}: not in the window: ${found.low.join()}`);
                check(/^1,2/.test(found.counts) && found.right === 1, `${name}: ${JSON.stringify(found)}`);
                check(found.told.length > 20 && !/undefined|NaN|\{/.test(found.told), found.told);
                await press("ArrowRight");
                await other.until(IDLE);
            }
            await press("PageUp");
            check((await other.run("rollbem.classroom.place()")) === names.at(-2), "PageUp");
            await press("Escape");
            check(
                await other.run(
                    "document.querySelectorAll('.chapter').length === 9 && rollbem.classroom.place() === null",
                ),
                "Escape does not leave",
            );
            check(other.errors.length === 0, other.errors.join("; "));
        } finally {
            await other.close();
        }
    });
    await test("a worksheet: a page of questions, a page of solutions", async () => {
        const other = await open_page(`${url}#class=sheet`, { width: 1280, height: 900 });
        try {
            await other.until("document.querySelectorAll('#sheet article').length === 2", 60);
            const found = await other.run(`(() => {
                const text = document.getElementById("sheet").textContent, count = (what) => document.querySelectorAll("#sheet " + what).length;
                return { questions: count("article:first-of-type section"), pictures: count("section > svg"), ticked: (text.match(/☒/g) ?? []).length,
                    first: document.querySelector("#sheet article").textContent.includes("☒"), odd: /undefined|NaN|\\{/.test(text) };
            })()`);
            check(
                found.questions === 8 && found.pictures === 16 && found.ticked === 8 && !found.first && !found.odd,
                JSON.stringify(found),
            );
            const { data } = await other.tab("Page.printToPDF", {}),
                pages = Buffer.from(data, "base64")
                    .toString("latin1")
                    .match(/\/Type\s*\/Page[^s]/g).length;
            check(pages === 2, `${pages} pages`);
            check(other.errors.length === 0, other.errors.join("; "));
        } finally {
            await other.close();
        }
    });
    await test("pictures that are taken along have title, numbers, legend and source, and no handles", async () => {
        await page.run("rollbem.preset('rail')");
        for (const [chapter, reveal, menu, wanted] of [
            ["press", "rollbem.views.press.answer('16')", 0, ["A wheel pressed", "pressure p", "MPa"]],
            ["brake", "rollbem.views.brake.see()", 0, ["A braked wheel", "sticks", "slips: A slides to +x", "x/a"]],
            ["brake", "0", 1, ["Creep curve", "Q/(μP)", "creep ratio"]],
            ["roll", "rollbem.views.roll.player.go(9)", 0, ["From rest", "half-widths", "sticks"]],
            ["soft", "rollbem.views.soft.answer('larger')", 0, ["A soft wheel", "sticks"]],
            [
                "below",
                "document.querySelector('#at-below .button.main').click()",
                0,
                ["in-plane shear", "MPa", "<image"],
            ],
            ["crack", "rollbem.views.crack.answer('slides')", 0, ["A crack below", "sticks", "rollbem crack"]],
            ["step", "0", 0, ["Lemke's method", "until", "sticks"]],
        ]) {
            await page.run(`rollbem.open('${chapter}')`);
            await settled();
            await page.run(`void (${reveal})`);
            await settled();
            const text = await page.run(`new Promise((resolve) => {
                const make = URL.createObjectURL;
                URL.createObjectURL = (blob) => { URL.createObjectURL = make; blob.text().then(resolve); return make(blob); };
                [...document.querySelectorAll('#at-${chapter} .menu')[${menu}].querySelectorAll('button')].find((b) => b.textContent === 'SVG').click();
            })`);
            const lines = text.replace(/<[^>]*>/g, " ");
            for (const part of [...wanted, "Computed by rollbem", "P = "])
                check(text.includes(part) || lines.includes(part), `${chapter}: no ${part}`);
            check(!/class="handle"|undefined|NaN|\{\w+\}|var\(/.test(text), `${chapter}: handles or holes`);
        }
    });
    await test("rolled, and looked below", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('roll')");
        await settled();
        await page.run("rollbem.views.roll.player.go(1e9)");
        check(
            /within 1 %/.test(await page.run("document.querySelector('#at-roll').textContent")),
            "the steady value is not reached",
        );
        check((await page.run("rollbem.views.roll.player.at")) > 20, "steps");
        await page.run(
            "document.querySelector('#at-roll .hand-drawn').open = true; document.querySelector('input[name=hand][value=force_ratio]').click()",
        );
        await settled();
        const drag =
            await page.run(`(() => { const [svg] = document.querySelectorAll("#at-roll svg.hand-line"), box = svg.getBoundingClientRect(), send = (on, type, u, v) => on.dispatchEvent(new PointerEvent(type, { clientX: box.left + u * box.width, clientY: box.top + v * box.height, bubbles: true, cancelable: true }));
            const before = rollbem.page.drawn.values.join(" "); send(svg, "pointerdown", 0.5, 0.3); send(window, "pointermove", 0.7, 0.2); send(window, "pointermove", 0.98, 0.25); send(window, "pointerup", 0.98, 0.25); return [before, rollbem.page.drawn.values.join(" ")]; })()`);
        check(drag[0] !== drag[1], "the line stays as it was");
        await settled();
        const { at, force } = await page.run(
            "({ at: rollbem.page.drawn.values.at(-1), force: rollbem.views.roll.force() })",
        );
        check_close(force, at, 1e-9, "the force at the end is the one that was drawn");
        await page.run("document.querySelector('input[name=hand][value=none]').click()");
        await settled();
        await page.run("rollbem.open('below')");
        await settled();
        for (const kind of ["von_mises", "fringes", "max_shear"])
            await page.run(`document.querySelector('#at-below input[value=${kind}]').click()`);
        await page.run("rollbem.views.below.reveal()");
        await settled();
        check(await page.run("document.querySelector('#at-below image') !== null"), "no map");
    });
    await test("a page that rollbem page made opens with its case", async () => {
        const folder = mkdtempSync(join(tmpdir(), "page-")),
            made = join(folder, "made.html");
        const ran = run(["page", "examples/rail/case.ini", "--mu", "0.2", "--page", file, "--output", made]);
        check(ran.status === 0, ran.stderr);
        const other = await open_page(pathToFileURL(made).href);
        try {
            await other.until(IDLE);
            const want = flatten({
                ...JSON.parse(run(["--json", "--quiet", "examples/rail/case.ini", "--mu", "0.2"]).stdout),
                inputs: null,
            });
            check_close(
                await other.run("rollbem.page.answer.numbers.tangential_load"),
                want.tangential_load,
                FITTED * want.normal_load,
                "Q",
            );
        } finally {
            await other.close();
            rmSync(folder, { recursive: true });
        }
    });
    await test("what rollbem page takes the page solves: up to 400 elements", () => {
        for (const more of [{}, { formulation: "steady", "creep-ratio": "0.5" }, { support: "arc" }])
            for (const n of ["300", "400"]) {
                const given = { support: "halfplane", load: "100", "contact-elements": n, ...more },
                    got = answer(library, { kind: "solve", given });
                check(!got.refused && !got.unsolved, `${JSON.stringify(given)}: ${got.refused ?? got.unsolved}`);
            }
    });
    await test("rollbem page refuses what the page itself cannot show", () => {
        for (const more of [{ error: "yes" }, { accuracy: "1e-3" }, { "contact-elements": "401" }]) {
            const given = { support: "halfplane", load: "100", ...more },
                ran = run(["page", ...words_of(given), "--page", file]);
            const { refused } = answer(library, { kind: "solve", given });
            check(
                ran.status === 64 && ran.stdout === "" && ran.stderr.trim() === `rollbem: ${refused}`,
                `got '${ran.stderr}', the page says '${refused}'`,
            );
        }
    });
    await test("a case file opened, and files that are none", async () => {
        await page.run("rollbem.open('bench')");
        await page.run(
            `rollbem.page.open_file(new File([${JSON.stringify("[friction]\nmu = 0.17 ; of a file\n[load]\nload = 300\n[body-a]\nsupport = halfplane\n")}], "case.ini"))`,
        );
        await settled();
        await same_as_the_program();
        check((await page.run("rollbem.page.answer.values.mu")) === "0.17", "mu is not the file's");
        for (const [text, line] of [
            ["<script>alert(1)</script>", "expected name = value"],
            ["x".repeat(50000), "more than"],
            ["mu = <img src=x onerror=alert(1)>", "--mu: expected a number"],
            ["colour = red", "unknown option"],
        ]) {
            await page.run(`rollbem.page.open_file(new File([${JSON.stringify(text)}], "case.ini"))`);
            await page.until(`document.getElementById('message').textContent.includes(${JSON.stringify(line)})`, 10);
            check(
                (await page.run("document.querySelectorAll('#message *').length")) === 0,
                "the message holds elements",
            );
        }
    });
}
