import { check, test, url } from "./suite.mjs";
import { open_page } from "../chromium.mjs";

export async function test_step({ page, settled }) {
    for (const [preset, matrices] of [
        ["rail", 2],
        ["stiff", 6],
    ])
        await test(`Lemke stepped to the end, zones guessed: ${preset}`, async () => {
            await page.run(
                `rollbem.preset('${preset}'); rollbem.views.step.choose('own'); rollbem.open('step'); document.querySelector("#at-step details").open = true`,
            );
            await settled();
            check((await page.run("document.querySelectorAll('#at-step canvas').length")) === matrices, "matrices");
            const count = await page.run("rollbem.views.step.player.count"),
                click = (text) =>
                    page.run(
                        `[...document.querySelectorAll('#at-step button')].find((b) => b.textContent === '${text}').click()`,
                    );
            for (let k = 0; k < count; k++) {
                const sentence = await page.run("document.querySelector('.sentence').textContent");
                check(
                    / until .+\.$|touches\.$/.test(sentence) && !/[{}]|undefined/.test(sentence),
                    `pivot ${k + 1}: ${sentence}`,
                );
                await click("Next");
            }
            check(
                /the problem is solved/.test(await page.run("document.querySelector('.sentence').textContent")),
                "the last pivot",
            );
            const same = await page.run(
                "(([now, want]) => now === want)([...document.querySelectorAll('#at-step .cells[aria-label*=\"zones\"], #at-step .cells[aria-label*=\"basis after this pivot:\"]')].map((s) => s.getAttribute('aria-label').replace(/^.*?:/, '')))",
            );
            check(same, "the zones of the last basis are those of the solution");
            const newton = await page.run(
                "(([zones, want]) => [zones.slice(-want.length).join(' '), want.join(' ')])([[...rollbem.views.step.data()['newton.zone'].at], [...rollbem.views.step.data().columns.zone]])",
            );
            check(newton[0] === newton[1], `Newton's last zones are ${newton[0]}, those of the solution ${newton[1]}`);
            const told = await page.run(
                "[...document.querySelectorAll('#at-step canvas')].map((c) => { const box = c.getBoundingClientRect(); c.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + 0.3 * box.width, clientY: box.top + 0.6 * box.height, bubbles: true })); return c.closest('figure').querySelector('p').textContent; })",
            );
            for (const text of told)
                check(/\] = /.test(text) && !/[{}]|undefined|NaN/.test(text), `a block is explained as: ${text}`);
            await click("Check");
            await settled();
            check(
                await page.run("document.querySelector('#at-step .verdict, #at-step .bad') !== null"),
                "no verdict on a wrong guess",
            );
            const why = await page.run("document.querySelector('#at-step .bad')?.textContent ?? ''");
            check(!/singular/.test(why) || /a given load needs elements that touch/.test(why), `the verdict: ${why}`);
            await click("Show the answer");
            await settled();
            check(
                await page.run("document.querySelector('#at-step .good') !== null"),
                `the answer: ${await page.run("document.querySelector('#at-step .verdict')?.textContent")}`,
            );
        });
    await test("the first contact that is stepped through has no tie, the second one, which is explained", async () => {
        await page.run("rollbem.preset('rail')");
        for (const [name, ties] of [
            ["untied", 0],
            ["tied", 1],
        ]) {
            await page.run(`rollbem.views.step.choose('${name}'); rollbem.open('step'); rollbem.page.ask_view('step')`);
            await settled();
            const told = await page.run(
                "Array.from({ length: rollbem.views.step.player.count }, (_, k) => { rollbem.views.step.player.go(k); return ['.sentence', '.tie', '#at-step .pair figure svg'].map((part) => document.querySelector(part).textContent); })",
            );
            check(told.length > 4, `${name}: ${told.length} pivots`);
            check(told.filter(([, tie]) => tie.startsWith("A tie")).length === ties, `${name}: ties`);
            check(
                told.filter(([sentence]) => /may be pressed now, but only until/.test(sentence)).length === ties,
                `${name}: steps of length zero`,
            );
        }
        check(
            await page.run("document.querySelector('#at-step .row[hidden] #step-elements') !== null"),
            "the slider of another contact",
        );
        await page.run("rollbem.views.step.choose('own'); rollbem.page.ask_view('step')");
    });
    await test("a link to a chapter marks that chapter; four elements have 81 combinations", async () => {
        const other = await open_page(`${url}#support=halfplane&load=100&mu=0.3&contact-elements=4&view=step`);
        await other.until("window.rollbem && rollbem.idle()");
        await other.until(`document.querySelector("#chapters [aria-current=true]")?.dataset.view === "step"`, 5);
        await new Promise((resolve) => setTimeout(resolve, 300)); /* chapters above it have grown */
        check(
            (await other.run(`document.querySelector("#chapters [aria-current=true]").dataset.view`)) === "step",
            "another chapter is marked",
        );
        check(
            /that is 81 combinations/.test(await other.run("document.getElementById('at-step').textContent")),
            "not 81",
        );
        await other.close();
    });
    await test("Step through takes the elements of the case where they are few, else those of its slider", async () => {
        const link = (n) =>
            page.run(`location.hash = "#support=halfplane&load=100&mu=0.3&contact-elements=${n}&view=step"`);
        const slide = (n) =>
            page.run(
                `{ const s = document.getElementById('step-elements'); s.value = ${n}; s.dispatchEvent(new Event("input")); s.dispatchEvent(new Event("change")); }`,
            );
        for (const [what, move, want] of [
            ["a link of 11", () => link(11), 11],
            ["its slider", () => slide(6), 6],
            ["a link of 60", () => link(60), 6],
            ["a link of 4", () => link(4), 4],
        ]) {
            await move();
            await settled();
            const got = await page.run(
                "[rollbem.views.step.data()['pivot.p'].rows, Number(document.getElementById('step-elements').value)].join()",
            );
            check(got === `${want},${want}`, `${what}: elements, slider are ${got}`);
        }
    });
}
