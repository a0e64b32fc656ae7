import { check, check_close, test } from "./suite.mjs";

export async function test_hands({ page, number, settled, text_of, mouse }) {
    /* Of each end of a slider, held by a hand so that axes stay: where the lines of its figure are. */
    const lines_of = (view) =>
        page.run(`(() => {
            const places = {}, put = (name, e) => { let k = 0; while (name + k in places) k++; const long = e.getTotalLength(); places[name + k] = Array.from({ length: 11 }, (_, i) => e.getPointAtLength((long * i) / 10)).flatMap((p) => [p.x, p.y]); };
            for (const e of document.querySelectorAll("#at-${view} svg path[class], #at-${view} svg circle")) put(e.getAttribute("class") ?? "circle", e);
            if ("${view}" === "hero") {
                const picture = new DOMParser().parseFromString(rollbem.views.hero.picture_of(), "image/svg+xml").documentElement;
                document.body.append(picture);
                for (const e of picture.querySelectorAll("path[class]")) put(e.getAttribute("class"), e);
                picture.remove();
            }
            return places;
        })()`);
    /* Sliders whose figure does not move, and the sentence that says why. */
    const STILL = {
        "brake-load": /Load, radius and stiffness do not change this curve/,
        "brake-radius": /Load, radius and stiffness do not change this curve/,
        "brake-young": /Load, radius and stiffness do not change this curve/,
    };
    await test("a slider's whole range moves its figure by 20 px, or a sentence says why not", async () => {
        await page.size(1280, 900);
        const found = [];
        for (const [view, presets] of [
            ["hero", ["rail"]],
            ["press", [""]],
            ["brake", [""]],
            ["soft", [""]],
            ["below", ["rail"]],
            ["crack", [""]],
            ["roll", ["rail"]],
            ["bench", process.env.ROLLBEM_TEST_ALL ? ["rail", "stiff", "roll", "addi"] : ["rail"]],
        ])
            for (const preset of presets) {
                if (preset) await page.run(`rollbem.preset('${preset}')`);
                await page.run(`rollbem.open('${view}')`);
                await settled();
                await page.run(
                    `rollbem.views['${view}'].answer?.(document.querySelector('#at-${view} .choice')?.dataset.value); rollbem.views['${view}'].see?.(); rollbem.views['${view}'].reveal?.()`,
                );
                await settled();
                const sliders = await page.run(
                    `[...document.querySelectorAll('#at-${view} input[type=range]')].filter((s) => s.offsetParent && !s.closest('.players')).map((s) => s.dataset.dial ?? s.dataset.knob ?? s.id)`,
                );
                for (const name of sliders) {
                    const slider = `document.querySelector('#at-${view} [data-dial="${name}"], #at-${view} [data-knob="${name}"], #at-${view} input[type=range][id="${name}"]')`;
                    await page.run(`{ const s = ${slider}; s.dispatchEvent(new PointerEvent('pointerdown')); }`);
                    const ends = [];
                    let way = 0;
                    /* Between the ends too where these are mirror images. */
                    for (const part of [0, 1, 0.5]) {
                        if (way >= 20) break;
                        await page.run(
                            `{ const s = ${slider}; s.value = Number(s.min) + ${part} * (s.max - s.min); s.dispatchEvent(new Event('input')); }`,
                        );
                        await page.until("rollbem.solver.idle()");
                        await page.run(
                            "new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve, 30))))",
                        );
                        await page.until("rollbem.solver.idle()");
                        ends.push({
                            places: await lines_of(view),
                            trouble: await page.run(
                                "Object.keys(rollbem.store.answers).map(rollbem.store.trouble).find(Boolean) ?? ''",
                            ),
                        });
                        const [one, other] = [ends[0].places, ends.at(-1).places];
                        for (const key of Object.keys(one).filter((name) => other[name]))
                            one[key].forEach((v, k) => {
                                way = Math.max(way, Math.abs(v - other[key][k]));
                            });
                    }
                    await page.run(`${slider}.dispatchEvent(new PointerEvent('pointerup'))`);
                    await settled();
                    await page.run(
                        "rollbem.store.can_undo && new Promise((resolve) => { addEventListener('popstate', resolve, { once: true }); rollbem.store.undo(); })",
                    );
                    await settled();
                    const said = STILL[name]?.test(await page.run(`document.querySelector('#at-${view}').textContent`));
                    if (way < 20 && !said && !ends.some(({ trouble }) => trouble))
                        found.push(`${view} ${preset} ${name}: ${way.toFixed(1)} px`);
                    if (said && way > 20) found.push(`${view} ${name} is said to move nothing: ${way.toFixed(1)} px`);
                }
            }
        check(!found.length, found.join("; "));
    });
    await test("hands on the hero, by keys: brake, turn, press", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        const key = async (hand, name) => {
            await page.run(
                `document.querySelector('.hand.${hand}').dispatchEvent(new KeyboardEvent('keydown', { key: '${name}', bubbles: true, cancelable: true }))`,
            );
            await settled();
        };
        await key("border", "ArrowRight");
        check_close(await number("creep_ratio"), 0.52, 1e-9, "the border");
        await key("rim", "ArrowLeft");
        check_close(await number("creep_ratio"), 0.57, 1e-9, "the rim, turned back");
        await key("hub", "ArrowDown");
        check_close(await number("normal_load"), 13800, 1, "the hub, pressed");
        check(/5[78] % of this contact is slipping/.test(await text_of("#headline")), await text_of("#headline"));
    });
    await test("a slow drag is undone to where it began", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        await page.run("rollbem.store.hold()");
        for (const load of [15000, 20000, 25000]) {
            await page.run(`rollbem.page.change({ ...rollbem.page.given, load: '${load}' })`);
            await new Promise((resolve) => setTimeout(resolve, 400));
        }
        await page.run("rollbem.store.release()");
        await settled();
        await page.run("rollbem.store.undo()");
        await page.until("rollbem.page.given.load === '12500'", 5);
        await page.run("rollbem.store.redo()");
        await page.until("rollbem.page.given.load === '25000'", 5);
    });
    await test("a change that comes before the first entry has its state leaves that state to go back to", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        const states = await page.run(`(async () => {
            const load = () => rollbem.page.given.load, loads = [load()];
            history.replaceState(null, "");
            rollbem.page.change({ ...rollbem.page.given, load: "20000" });
            loads.push(load());
            const back = new Promise((resolve) => addEventListener("popstate", resolve, { once: true }));
            rollbem.store.undo();
            await back;
            return [...loads, load(), rollbem.store.can_redo];
        })()`);
        check(states.join() === "12500,20000,12500,true", states.join());
    });
    await test("undo, redo, Back and reset", async () => {
        const s = () => page.run("rollbem.page.given['creep-ratio'] ?? null");
        await page.run("rollbem.preset('rail')");
        await settled();
        for (const value of ["0.1", "0.2", "0.3"]) {
            await page.run(`rollbem.page.change({ ...rollbem.page.given, "creep-ratio": "${value}" })`);
            await settled();
        }
        const press = async (act, want) => {
            await page.run(act);
            await page.until(`rollbem.page.given['creep-ratio'] === '${want}'`, 5);
            await settled();
            check((await s()) === want, `${act}: ${await s()}`);
        };
        await press("document.querySelector('[data-history=undo]').click()", "0.2");
        await press(
            "window.dispatchEvent(new KeyboardEvent('keydown', { key: 'z', ctrlKey: true, cancelable: true }))",
            "0.1",
        );
        await press(
            "window.dispatchEvent(new KeyboardEvent('keydown', { key: 'y', ctrlKey: true, cancelable: true }))",
            "0.2",
        );
        await press("history.back()", "0.1");
        check(Math.abs((await number("creep_ratio")) - 0.1) < 1e-12, "the answer is another state's");
        await press("document.querySelector('[data-history=reset]').click()", "0.5");
        await press("history.back()", "0.1");
        /* a stroke of a slider is one step */
        await page.run(
            "{ const k = document.querySelector('[data-dial=creep-ratio]'); for (const v of [0.3, 0.6, 0.9]) { k.value = v; k.dispatchEvent(new Event('input')); } k.dispatchEvent(new Event('change')); }",
        );
        await settled();
        await press("history.back()", "0.1");
    });
    await test("fields show what was solved: after a preset, a file, a link, undo", async () => {
        await page.run("rollbem.open('bench')");
        const field = (name) => page.run(`document.getElementById('knob-${name}')?.value`),
            slider = (name) => page.run(`Number(document.querySelector('[data-knob="${name}"]').value)`);
        for (const [what, act, want] of [
            ["a preset", "rollbem.preset('stiff')", { radius: "100", mu: "0.6", young: "10" }],
            [
                "a file",
                `rollbem.page.open_file(new File([${JSON.stringify("radius = 77\nmu = 0.2\nsupport = halfplane\nload = 30\n")}], "a.ini"))`,
                { radius: "77", mu: "0.2" },
            ],
            [
                "a link",
                "location.hash = '#support=halfplane&radius=88&mu=0.25&load=50'",
                { radius: "88", mu: "0.25", load: "50" },
            ],
            ["Back", "history.back()", { radius: "77" }],
        ]) {
            await page.run(act);
            await new Promise((resolve) => setTimeout(resolve, 150));
            await page.run("rollbem.open('bench')");
            await settled();
            for (const [name, text] of Object.entries(want)) {
                check((await field(name)) === text, `${what}: ${name} is ${await field(name)}, not ${text}`);
                check_close(
                    await slider(name),
                    ["mu", "poisson"].includes(name) ? Number(text) : Math.log(Number(text)),
                    0.03,
                    `${what}: the slider of ${name}`,
                );
            }
        }
        await page.run("rollbem.preset('rail')");
        await settled();
        await page.run(
            "{ const f = document.getElementById('knob-young'); f.value = '205GPa'; f.dispatchEvent(new Event('change')); }",
        );
        await settled();
        check_close(await slider("young"), Math.log(205000), 0.03, "the slider after 205GPa");
        await page.run(
            "{ const f = document.getElementById('knob-mu'); f.value = '0,25'; f.dispatchEvent(new Event('change')); }",
        );
        await settled();
        check((await page.run("rollbem.page.answer.values.mu")) === "0.25", "0,25 is not 0.25");
    });
    await test("the soft wheel at its largest load: grey, with the library's line, no exception", async () => {
        await page.run("rollbem.preset('stiff'); rollbem.open('bench')");
        await settled();
        await page.run("rollbem.page.change({ ...rollbem.page.given, load: '100000' })");
        await settled();
        check(
            /does not end within/.test(await text_of("#message")) &&
                (await page.run("document.querySelector('.contact').classList.contains('stale')")),
            `${await text_of("#message")}`,
        );
        check(
            /strains are far beyond linear elasticity/.test(await text_of(".contact .notes")),
            `notes: ${await text_of(".contact .notes")}`,
        );
    });
    await test("the point of the creep curve dragged sideways, and far off its axis", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        const box = await page.run(
            "(() => { const h = document.querySelector('[data-handle=bench]'); h.scrollIntoView({ block: 'center' }); const b = h.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()",
        );
        const drag = (type, dx) => mouse(type, box[0] + dx, box[1]);
        await drag("mousePressed", 0);
        for (const dx of [3, 10, 30, 60]) await drag("mouseMoved", dx);
        await drag("mouseReleased", 60);
        await settled();
        check(
            (await page.run("'creep-ratio' in rollbem.page.given")) && (await number("creep_ratio")) > 0.55,
            `creep ratio ${await number("creep_ratio")}`,
        );
        await page.run("rollbem.page.change({ ...rollbem.page.given, 'creep-ratio': '13.6' })");
        await settled();
        check(/13.6 →/.test(await text_of("#at-bench svg text.off")), "13.6 is shown as something else");
    });
    await test("a finger that scrolls over a slider leaves it as it was; a matrix lets the page scroll", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        await page.run(
            "{ const k = document.querySelector('[data-dial=creep-ratio]'); k.dispatchEvent(new PointerEvent('pointerdown', { pointerType: 'touch', bubbles: true })); k.value = 1; k.dispatchEvent(new Event('input')); k.dispatchEvent(new PointerEvent('pointercancel', { pointerType: 'touch', bubbles: true })); }",
        );
        await settled();
        check_close(await number("creep_ratio"), 0.5, 2e-3, "creep ratio after a swipe");
        const styles = await page.run(
            "[...document.querySelectorAll('input[type=range]')].map((e) => getComputedStyle(e).touchAction).concat(getComputedStyle(document.querySelector('#at-step canvas') ?? document.body).touchAction)",
        );
        check(
            styles.every((style) => ["pan-y", "manipulation", "auto"].includes(style)),
            styles.join(),
        );
    });
    await test("a fast stroke over the drawn line sets every point", async () => {
        await page.run(
            "rollbem.preset('rail'); rollbem.open('roll'); document.querySelector('#at-roll .hand-drawn').open = true; document.querySelector('input[name=hand][value=creep_ratio]').click()",
        );
        await settled();
        await page.run(`(() => { const svg = document.querySelector("#at-roll svg.hand-line"), box = svg.getBoundingClientRect(), send = (on, type, u, v) => on.dispatchEvent(new PointerEvent(type, { clientX: box.left + u * box.width, clientY: box.top + v * box.height, bubbles: true, cancelable: true }));
            send(svg, "pointerdown", 0.17, 0.3); send(window, "pointermove", 0.97, 0.3); send(window, "pointerup", 0.97, 0.3); })()`);
        await settled();
        const values = await page.run("rollbem.page.drawn.values");
        check(new Set(values).size === 1, `drawn level: ${values}`);
        await page.run("document.querySelector('input[name=hand][value=none]').click()");
        await settled();
    });
}
