/* The numbers that the page shows are the program's, whatever control is moved. */
import { check, check_close, FITTED, flatten, run, test } from "./suite.mjs";
import { IDLE } from "./visit.mjs";

/* What make test runs of the page in a browser. */
export async function test_first_screen({ page, number, settled, same_as_the_program }) {
    await page.until(IDLE);
    await test("the page solves and shows the program's numbers", async () => {
        await same_as_the_program();
    });
    await test("the command that the page shows gives the page's numbers", async () => {
        await page.run("rollbem.open('take')");
        await settled();
        const command = await page.run("document.querySelector('[data-take=command]').value");
        const want = flatten({
            ...JSON.parse(run(["--json", "--quiet", ...command.split(" ").slice(1)]).stdout),
            inputs: null,
        });
        check_close(
            await number("tangential_load"),
            want.tangential_load,
            FITTED * Math.abs(want.tangential_load),
            "Q",
        );
    });
}

export async function test_controls({ page, number, settled, same_as_the_program }) {
    for (const preset of ["rail", "roll", "stiff", "addi"])
        await test(`every control moved: ${preset}`, async () => {
            await page.run(`rollbem.open('bench'); rollbem.preset('${preset}')`);
            await settled();
            check(
                await page.run("document.getElementById('message').hidden"),
                await page.run("document.getElementById('message').textContent"),
            );
            const knobs = await page.run(
                "[...document.querySelectorAll('#controls [data-knob]')].map((k) => k.dataset.knob)",
            );
            check(knobs.length >= 7, `${knobs.length} sliders`);
            for (const knob of knobs) {
                const before = await page.run(`rollbem.page.given['${knob}'] ?? rollbem.page.answer.values['${knob}']`);
                await page.run(
                    `{ const k = document.querySelector('[data-knob="${knob}"]'); k.value = Number(k.value) - 12 * Number(k.step); k.dispatchEvent(new Event("input")); k.dispatchEvent(new Event("change")); }`,
                );
                await settled();
                const after = await page.run(`rollbem.page.given['${knob}']`);
                check(after !== before, `${knob} stayed at ${before}`);
                check(
                    await page.run("document.getElementById('message').hidden"),
                    `${knob} = ${after}: ${await page.run("document.getElementById('message').textContent")}`,
                );
            }
            await same_as_the_program();
        });
    await test("every choice taken", async () => {
        await page.run("rollbem.preset('rail')");
        await settled();
        const choices = await page.run(
            "[...document.querySelectorAll('#controls input[type=radio]')].map((r) => [r.name, r.value])",
        );
        for (const [name, value] of choices) {
            await page.run(
                `rollbem.preset('rail'); document.querySelector('#controls input[name="${name}"][value="${value}"]')?.click()`,
            );
            await settled();
            check(
                await page.run("document.getElementById('message').hidden"),
                `${name} ${value}: ${await page.run("document.getElementById('message').textContent")}`,
            );
        }
    });
    await test("the point of the creep curve moved by keys", async () => {
        await page.run("rollbem.preset('rail')");
        await settled();
        const before = await number("force_ratio");
        await page.run(
            "document.querySelector('[data-handle=bench]').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowUp', bubbles: true }))",
        );
        await settled();
        check_close(await number("force_ratio"), before + 0.02, 6e-4, "Q/(mu P)");
    });
}
