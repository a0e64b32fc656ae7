import { check, check_close, run, test } from "./suite.mjs";

export async function test_chapters({ page, number, settled, text_of, mouse }) {
    await test("the chapters answer what they ask", async () => {
        await page.run("rollbem.open('press')");
        await settled();
        const drawn = () =>
                page.run(
                    "[...document.querySelectorAll('#at-press figure path')].map((e) => e.getAttribute('d')).join()",
                ),
            before_guess = await drawn(),
            of_question = await page.run("JSON.stringify(rollbem.store.case('press'))");
        await page.run("rollbem.store.set('press', { ...rollbem.store.case('press'), load: '3000' })");
        await settled();
        check(
            before_guess.length > 500 && before_guess === (await drawn()),
            "what is drawn before the guess gives it away",
        );
        await page.run(`rollbem.store.set('press', ${of_question})`);
        await settled();
        await page.run("rollbem.views.press.answer('16')");
        await settled();
        check(/Yes, 15.9\d* mm.*99\d MPa/.test(await text_of("#at-press .answer")), await text_of("#at-press .answer"));
        await page.run(
            "[...document.querySelectorAll('#at-press button')].find((b) => b.textContent === 'Twice the load').click()",
        );
        await settled();
        check(
            /^2 times the load: the strip is 1.41 times as wide, and the pressure 1.41/.test(
                await text_of("#at-press .after .note"),
            ),
            await text_of("#at-press .after .note"),
        );
        await page.run("rollbem.open('brake')");
        await settled();
        await page.run("for (let k = 0; k < 8; k++) rollbem.views.brake.paint(k, 1); rollbem.views.brake.see()");
        await settled();
        check(/^16 of 16 right/.test(await text_of("#at-brake .answer")), await text_of("#at-brake .answer"));
        check(
            /50 % of the strip slips and 75 % of the friction/.test(
                await page.run("document.querySelector('#at-brake').textContent"),
            ),
            "the state",
        );
        /* the creep curve, and along x the pressure in the lens */
        const places = async () => {
            const of = async (what) =>
                (await page.run(`document.querySelector('#at-brake path.${what}').getAttribute('d')`))
                    .match(/[\d.]+/g)
                    .map(Number);
            return [...(await of("curve")), ...(await of("pressure")).filter((_, k) => k % 2 === 0)];
        };
        const before = await places();
        await page.run("rollbem.store.set('brake', { ...rollbem.store.case('brake'), load: '2000', radius: '200' })");
        await settled();
        const after = await places(),
            moved = Math.max(...before.map((v, k) => Math.abs(v - after[k])));
        check(
            moved < 1.5 &&
                before.length === after.length &&
                /scales only/.test(await page.run("document.querySelector('#at-brake').textContent")),
            `the curve moved by ${moved} px`,
        );
        await page.run("rollbem.open('soft')");
        await settled();
        await page.run("rollbem.views.soft.answer('larger')");
        await settled();
        check(
            /^Yes. It turns as if it were larger, by 3.[89]/.test(await text_of("#at-soft .answer")),
            await text_of("#at-soft .answer"),
        );
        check(
            /rolling costs a moment of 0?\.?[1-9]|rolling costs a moment of \d/.test(
                await page.run("document.querySelector('#at-soft').textContent"),
            ),
            "the resistance",
        );
        await page.run("rollbem.preset('rail'); rollbem.open('below'); rollbem.views.below.reveal()");
        await settled();
        const table = await page.run(
            "[...document.querySelectorAll('.skids tbody tr')].map((r) => [...r.children].map((c) => c.textContent).join(' '))",
        );
        for (const want of [
            "rolls freely 0.79 a 0.3 p₀",
            "0.1 0.74 a 0.305 p₀",
            "0.2 0.6 a 0.319 p₀",
            "0.3 0.38 a 0.345 p₀",
            "0.4 at the surface 0.4 p₀",
        ])
            check(table.includes(want), `${want} is not in ${table.join("; ")}`);
    });
    await test("the chapter of the crack: a guess, the wheel dragged over it, its tip, water, undo", async () => {
        await page.run("rollbem.open('crack')");
        await settled();
        await page.run("rollbem.views.crack.answer('slides')");
        await settled();
        check(
            /^Yes. They are pressed together.*KI = 0\. .*KII = 79\d/.test(await text_of("#at-crack .answer")),
            await text_of("#at-crack .answer"),
        );
        const crack_state = () =>
            page.run(
                "(() => { const { data, place } = rollbem.views.crack.shown(); return { place, coarse: rollbem.store.answers.crack.coarse, positions: data['crack.x'].at.length, K: data.summary.K_I_max }; })()",
            );
        /* By hand: what is solved on the way is coarse, and fine when the hand lets go. */
        const drag = async (name, dx, dy) => {
            const box = await page.run(
                `(() => { const h = document.querySelector('#at-crack [data-handle=${name}]'); h.scrollIntoView({ block: 'center', behavior: 'instant' }); const b = h.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()`,
            );
            const held = (type, k) => mouse(type, box[0] + k * dx, box[1] + k * dy);
            await held("mousePressed", 0);
            for (const k of [0.3, 0.6, 1]) await held("mouseMoved", k);
            await page.until("rollbem.solver.idle()");
            await page.run("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))");
            const on_the_way = await crack_state();
            await held("mouseReleased", 1);
            await settled();
            return on_the_way;
        };
        const before = await crack_state();
        await drag("wheel", -120, 0);
        const there = await crack_state();
        check(
            there.place < before.place - 0.5 && there.K === before.K,
            `the wheel: ${JSON.stringify([before, there])}`,
        );
        const on_the_way = await drag("tip", 20, 40),
            after = await crack_state();
        check(
            on_the_way.coarse && on_the_way.positions === 61 && !after.coarse && after.positions === 121,
            `the tip: ${JSON.stringify([on_the_way, after])}`,
        );
        check(
            Number(await page.run("rollbem.store.case('crack')['crack-angle']")) > 35 &&
                Math.abs(after.place - there.place) < 0.06,
            `the tip: ${JSON.stringify(await page.run("rollbem.store.case('crack')"))}, the wheel at ${after.place}`,
        );
        await page.run("rollbem.store.undo()");
        await page.until("rollbem.store.case('crack')['crack-angle'] === '30'");
        await settled();
        /* By keys. */
        for (const [name, key, holds] of [
            ["wheel", "ArrowRight", `rollbem.views.crack.shown().place > ${there.place} + 0.05`],
            ["tip", "ArrowLeft", "rollbem.store.case('crack')['crack-angle'] === '32'"],
            ["tip", "ArrowDown", "rollbem.store.case('crack')['crack-length'] === '1.05'"],
        ]) {
            await page.run(
                `{ const h = document.querySelector('#at-crack [data-handle=${name}]'); h.focus(); h.dispatchEvent(new KeyboardEvent('keydown', { key: '${key}', bubbles: true, cancelable: true })); }`,
            );
            await settled();
            check(
                (await page.run(holds)) && (await page.run(`document.activeElement.dataset.handle === '${name}'`)),
                `${name} ${key}`,
            );
        }
        await page.run("document.querySelector('#at-crack [name=fluid][value=trapped]').click()");
        await settled();
        const wet = await crack_state();
        check(
            wet.K > 5 * before.K &&
                /Before: \d/.test(await page.run("document.querySelector('#at-crack').textContent")),
            `${wet.K} with water, ${before.K} dry`,
        );
        /* The command that is copied gives the page's numbers. */
        const command = await page.run(
            "(() => { let text = ''; navigator.clipboard.writeText = async (t) => { text = t; }; [...document.querySelectorAll('#at-crack .menu button')].find((b) => b.textContent === 'Copy as command').click(); return text; })()",
        );
        const want = JSON.parse(run([...command.split(" ").slice(1), "--json", "--quiet"]).stdout).summary;
        check_close(wet.K, want.K_I_max, 1e-4 * want.K_I_max, command);
        /* Refused: grey, with the library's line. */
        await page.run("rollbem.store.set('crack', { ...rollbem.store.case('crack'), 'crack-angle': '180' })");
        await settled();
        check(
            /^Not solved: --crack-angle: expected more than 0/.test(await text_of("#at-crack .answer")) &&
                (await page.run("document.querySelector('#at-crack figure').classList.contains('stale')")),
            await text_of("#at-crack .answer"),
        );
        await page.run("rollbem.store.undo()");
        await page.until("rollbem.store.case('crack')['crack-angle'] !== '180'");
        await settled();
    });
    await test("which input matters: bars that follow the sliders", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        await page.run("document.querySelector('.bars').scrollIntoView({ block: 'center', behavior: 'instant' })");
        await page.until("document.querySelector('.bars').childElementCount > 0");
        const bars = () =>
            page.run(
                "[...document.querySelectorAll('#at-bench .bar')].map((b) => [b.dataset.input, b.querySelector('.value').textContent, Math.round(b.querySelector('.more').getBoundingClientRect().width)])",
            );
        const first = await bars();
        check(
            JSON.stringify(
                first
                    .slice(0, 3)
                    .map(([name, text]) => name + text)
                    .sort(),
            ) === '["load+0.5 %","radius−0.5 %","young+0.5 %"]' && first[0][2] > 40,
            JSON.stringify(first),
        );
        await page.run("document.querySelector('#at-bench [name=matters][value=tangential_load]').click()");
        await settled();
        const friction = await bars();
        await page.run("rollbem.page.change({ ...rollbem.page.given, 'creep-ratio': '1.2' })");
        await settled();
        const slides = await bars();
        check(
            friction.some(([name]) => name === "creep-ratio") && !slides.some(([name]) => name === "creep-ratio"),
            JSON.stringify([friction, slides]),
        );
        check(
            /matters most/.test(await page.run("document.querySelector('.bars').nextSibling.textContent")),
            "no sentence",
        );
        await page.run("document.querySelector('#at-bench .bar[data-input=load] button').click()");
        check(
            await page.run(
                "document.querySelector('#at-bench .bar[data-input=load] button').getAttribute('aria-pressed') === 'true' && /1 % more of load P/.test(document.querySelector('#at-bench .bars ~ figure').textContent)",
            ),
            "no changes along the contact by the load",
        );
        await page.run("rollbem.page.change({ ...rollbem.page.given, poisson: '0.5' })");
        await settled();
        await page.run(
            "document.querySelector('#at-bench [name=matters][value=max_pressure]').click(); document.querySelector('#at-bench .bar[data-input=poisson] button').click()",
        );
        const texts = await page.run(
            "[document.querySelector('#at-bench .bar[data-input=poisson]').textContent, document.querySelector('#at-bench .bars ~ figure').textContent]",
        );
        check(/, 1 % less−/.test(texts[0]) && /What 1 % less of /.test(texts[1]), texts.join(" | "));
        await page.run(
            "rollbem.page.change({ ...rollbem.page.given, poisson: '0.3' }); document.querySelector('#at-bench [name=matters][value=tangential_load]').click()",
        );
        await settled();
    });
    await test("uncertain inputs give standard deviations, a wrong name its refusal", async () => {
        const type = async (text) => {
            await page.run(
                `{ const field = document.getElementById('uncertain'); field.value = ${JSON.stringify(text)}; field.dispatchEvent(new Event("change")); }`,
            );
            await settled();
            return page.run("document.querySelector('.deviations').textContent");
        };
        /* It skids: Q = -mu P. */
        const [P, Q] = [await number("normal_load"), await number("tangential_load")];
        check_close(Q, -0.3 * P, 1e-6 * P, "Q");
        check(/Q friction −3750 ± 300 N\/mm/.test(await type("mu=8%")), await type("mu=8%"));
        check(/Not a standard deviation of this case: 'moo'/.test(await type("moo=1%")), await type("moo=1%"));
        check((await type("")) === "", "nothing is uncertain");
        await type("mu=10%,radius=1%,young=1%");
    });
    await test("notes of the library stand beside the chapter's numbers", async () => {
        await page.run("rollbem.open('soft')");
        await settled();
        await page.run("rollbem.views.soft.answer('larger')");
        await settled();
        check(
            /strains are large/.test(
                await page.run("[...document.querySelectorAll('#at-soft .notes')].map((n) => n.textContent).join()"),
            ),
            "no note",
        );
    });
    await test("orange is slip alone: no matrix has it", async () => {
        await page.run(
            "rollbem.preset('rail'); rollbem.views.step.choose('own'); rollbem.open('step'); document.querySelector('#at-step details').open = true",
        );
        await settled();
        const orange = await page.run(
            "[...document.querySelectorAll('#at-step .matrix canvas')].map((c) => { const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0; for (let k = 0; k < d.length; k += 4) n += Math.hypot(d[k] - 196, d[k + 1] - 80, d[k + 2] - 27) < 60; return n; })",
        );
        check(orange.length >= 2 && orange.every((n) => n === 0), `${orange}`);
    });
}
