/* Tests of the page: node web/test.mjs [build], with verdicts as tests/run reads them.  The library as WebAssembly answers as the
 * program does; then the page itself in a headless Chromium. */
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";
import { open_page } from "./chromium.mjs";
import { bounds_of } from "./contact.js";
import { ticks, zone_colours } from "./draw.js";
import { load_library } from "./library.js";
import { read_case_file, read_link, table_of_drawn, write_link } from "./state.js";
import { words } from "./words.js";
import { answer } from "./worker.js";

const build = process.argv[2] ?? "build", program = resolve(`${build}/rollbem`);
let passed = 0, failed = 0;

async function test(name, body) {
    const start = performance.now();
    try { await body(); passed++; console.log(`[       OK ] ${name} (${Math.round(performance.now() - start)} ms)`); }
    catch (error) { failed++; console.log(`[  FAILED  ] ${name}: ${error.message}`); }
}
function check(holds, text) { if (!holds) throw new Error(text); }
function check_close(got, want, tol, what) {
    if (!Number.isFinite(want)) return check(!Number.isFinite(got), `${what}: got ${got}, the program has none`);
    check(Math.abs(got - want) <= tol, `${what}: got ${got}, want ${want}, difference ${Math.abs(got - want)} > ${tol}`);
}

/* ---- The library ------------------------------------------------------------------- */

const file = resolve(`${build}/rollbem.html`), url = pathToFileURL(file).href, text_of_page = readFileSync(file, "utf8");
const library = await load_library(gunzipSync(Buffer.from(/^const WASM = "(.*)";$/m.exec(text_of_page)[1], "base64")));
const given_of = (ini) => Object.fromEntries(readFileSync(ini, "utf8").split("\n").map((line) => /^([\w-]+)\s*=\s*([^;]*)/.exec(line)).filter(Boolean).map(([, name, text]) => [name, text.trim()]));
const words_of = (given) => Object.entries(given).flatMap(([name, text]) => library.options.find((o) => o.name === name)?.kind === "flag" ? [`--${name}`] : [`--${name}`, text]);
const run = (args, cwd) => spawnSync(program, args, { cwd, encoding: "utf8", env: { ...process.env, OPENBLAS_NUM_THREADS: "1" } });

/* Every number that is no count of work, time or rounding, and p and q of every element. */
const LEFT_OUT = ["iterations", "residual", "residual_gap", "residual_slip", "residual_friction", "load_error", "support_balance", "slip_violations"];
function flatten(json) {
    const all = {};
    for (const [name, value] of Object.entries(json)) {
        if (value && typeof value === "object" && !Array.isArray(value)) for (const [inner, v] of Object.entries(flatten(value))) all[inner] ??= v; else all[name] ??= value;
    }
    return all;
}
function compare(given, tol, files = {}) {
    const folder = mkdtempSync(join(tmpdir(), "page-"));
    for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
    const got = answer(library, { kind: "roll", given, files }), ran = run(["--json", "--quiet", ...words_of(given)], folder);
    rmSync(folder, { recursive: true });
    check(!got.refused, got.refused);
    const want = flatten({ ...JSON.parse(ran.stdout), inputs: null });
    let compared = 0;
    for (const { name, kind, unit } of library.results.number) {
        if (kind === "seconds" || LEFT_OUT.includes(name) || !(name in want)) continue;
        const scale = unit === "N" ? want.normal_load * want.half_width : unit === "N/mm" ? want.normal_load : /ratio/.test(name) ? 1 : /creepage/.test(name) ? 1e-3
            : /half_width|stick_|contact_(from|to)/.test(name) ? want.half_width : /shift/.test(name) ? Math.abs(want.approach) : 0;
        check_close(got.numbers[name], want[name] ?? NaN, tol * Math.max(Math.abs(want[name]), scale), name);
        compared++;
    }
    check(compared > 12, `only ${compared} numbers compared`);
    for (const name of ["p", "q"])
        want[`${name}_MPa`].forEach((v, i) => check_close(got.columns[name][i], v, tol * got.numbers.max_pressure, `${name}, row ${i + 1}`));
    return got;
}

/* A fitted mesh is fitted until the edges move less than a bound: its ends carry that. */
const FITTED = 1e-6;
for (const folder of readdirSync("examples"))
    for (const file of readdirSync(`examples/${folder}`, { recursive: true }).filter((f) => f.endsWith(".ini"))) {
        const given = given_of(`examples/${folder}/${file}`), named = ["history", "irregularity", "accuracy", "error"].filter((name) => name in given && given[name] !== "no");
        if (named.length || /[/.]/.test(given.gap ?? "")) { console.log(`  left   examples/${folder}/${file}: ${named} is not in the page`); continue; }
        const fitted = given.mesh === "fitted" || (given.formulation === "steady" && !given.mesh && !given.zone);
        await test(`the program's numbers: examples/${folder}/${file}`, () => compare(given, fitted ? FITTED : 1e-9));
    }
const rail = { support: "halfplane", "support-b": "halfplane", similar: "yes", formulation: "steady", radius: "460", young: "210000", poisson: "0.3", mesh: "uniform" };
for (const more of [{ load: "1000", mu: "0.3", "creep-ratio": "0.5" }, { load: "1000", mu: "0.3", "force-ratio": "-0.9" }, { approach: "0.03", mu: "0.1", creep: "0.0004", zone: "3" },
    { "half-width": "2", mu: "0.5", "creep-ratio": "-0.7" }, { load: "1000", mu: "0.3", formulation: "static", "force-ratio": "0.5" }, { support: "hub", load: "1000", mu: "0.3", "creep-ratio": "0.3", "contact-elements": "20" },
    { approach: "0.03", mu: "0.1", creep: "0.0004" }, { formulation: "transient", load: "1000", mu: "0.3", "creep-ratio": "0.5", distance: "2", "contact-elements": "24" }])
    await test(`the program's numbers: ${JSON.stringify(more)}`, () => compare({ ...rail, ...more }, 1e-9));

/* What slips or yields has its friction at the bound that is drawn, and every zone of the table a colour and its words. */
for (const more of [{ "yield-stress": "60", hardening: "100000" }, { "yield-stress": "100", hardening: "-1000" }, { "mu-fall": "0.1", "friction-law": "exponential", "slip-scale": "500", speed: "45000" }])
    await test(`bounds and zones: ${JSON.stringify(more)}`, () => {
        const got = compare({ ...rail, load: "12500", mu: "0.3", "creep-ratio": "0.8", ...more }, 1e-8), { q, zone } = got.columns, bounds = bounds_of(got);
        check([...zone].some((z) => z === ("yield-stress" in more ? 4 : 2)), "no such zone");
        bounds.forEach((bound, i) => zone[i] > 1 ? check_close(Math.abs(q[i]), bound, 1e-8 * got.numbers.max_pressure, `bound, row ${i + 1}`) : check(Math.abs(q[i]) <= bound + 1e-9 * got.numbers.max_pressure, `row ${i + 1} beyond its bound`));
        for (const list of [zone_colours, words.zones, words.zones_signs, words.zones_short]) check(list.length > Math.max(...zone), "a zone without a name");
    });
const drawn = [{ what: "mu", values: [0.3, 0.1, 0.4] }, { what: "load", values: [1000, 1500, 600] }, { what: "force_ratio", values: [0, -0.5, 0.5, 0] }, { what: "creep_ratio", values: [0, 0.8, -0.4] }];
for (const { what, values } of drawn)
    await test(`the program's numbers: ${what} drawn by hand`, () => {
        const { load, mu, ...rest } = { ...rail, load: "1000", mu: "0.3", formulation: "transient", "contact-elements": "24", history: "drawn.tsv" };
        compare({ ...rest, ...(what === "load" || what === "mu" ? { "creep-ratio": "0.5" } : {}), ...(what === "load" ? {} : { load }), ...(what === "mu" ? {} : { mu }) }, 1e-9, { "drawn.tsv": table_of_drawn({ what, distance: 2, values }) });
    });
await test("a file that is not there, and one that is no table", () => {
    const given = { ...rail, load: "1000", mu: "0.3", formulation: "transient", history: "drawn.tsv" };
    check(/drawn.tsv/.test(answer(library, { kind: "roll", given }).refused), "no file, no word");
    check(/drawn.tsv:2/.test(answer(library, { kind: "roll", given, files: { "drawn.tsv": "distance load\n0 <b>\n" } }).refused), "the line is not named");
});
await test("links and case files are read as they are written", () => {
    const state = { given: { mu: "0.3", "creep-ratio": "0.5" }, view: "roll", drawn: { what: "load", distance: 5, values: [1, 2.5] } };
    check(JSON.stringify(read_link(write_link(state.given, state.view, state.drawn), ["hero", "roll"])) === JSON.stringify({ given: state.given, view: "roll", drawn: state.drawn, embed: false }), "the link");
    check(JSON.stringify(read_case_file("[friction]\r\nmu = 0.3 ; a comment\n# another\n\ncreep-ratio: 0.5\n")) === JSON.stringify(state.given), "the file");
    for (const text of ["", "mu", "mu = 1\nmu = 2", "x".repeat(30000), "\u0000\u0001"]) {
        let said = "";
        try { read_case_file(text); } catch (error) { said = error.message; }
        check(said, `${JSON.stringify(text.slice(0, 20))} is taken for a case`);
    }
});
await test("every axis has two numbers at least", () => {
    for (let width = 0.1; width < 100; width *= 1.07)
        for (const [from, to] of [[0, width], [-width / 2, width / 2], [-width / 3, width]])
            for (const about of [3, 4, 5]) check(ticks(from, to, about).length >= 2, `${from} to ${to}: ${ticks(from, to, about)}`);
});
for (const given of [{ mu: "-1" }, { mu: "x" }, { "contact-elements": "2" }, { support: "wall" }, { load: "1", approach: "1" }, { formulation: "steady" }, { poisson: "0.7" }, { creep: "1e400" },
    { support: "halfplane", "hub-ratio": "0.4" }, { formulation: "steady", shift: "1" }, { similar: "yes", "young-b": "3" }])
    await test(`the program's refusal: ${JSON.stringify(given)}`, () => {
        const ran = run(["--quiet", ...words_of(given)]), got = answer(library, { kind: "solve", given });
        if (ran.status === 0) return check(!got.refused, `the program solves it, the page says: ${got.refused}`);
        check(got.refused, "the page solves it");
        check(ran.stderr.includes(got.refused), `got '${got.refused}', the program says '${ran.stderr.trim()}'`);
    });
await test("a wheel that relaxes is not in the page", () => {
    const given = { support: "hub", load: "100", formulation: "steady", "creep-ratio": "0.3", "relaxation-time": "0.01", "relaxation-ratio": "1", speed: "100" };
    check(run(["--quiet", ...words_of(given)]).status === 0, "the program does not solve it");
    check(/a wheel that relaxes is not in the page: use the program/.test(answer(library, { kind: "solve", given }).refused), "it is not refused");
});
await test("a size that the page does not take", () => check(/use the program/.test(answer(library, { kind: "solve", given: { "contact-elements": "5000" } }).refused), "it is solved"));

/* ---- The page ---------------------------------------------------------------------- */

await test("one file below 700 kB that names no other", () => {
    check(text_of_page.length < 700e3, `${text_of_page.length} bytes`);
    check(!/(src|href)="?https?:/.test(text_of_page), "it asks for something");
});

/* axe-core finds contrasts that are too weak, missing names and broken roles.  It comes from the npm
 * registry as web/package-lock.json names it, into the build folder; null: it cannot be had. */
function axe_source() {
    const folder = `${build}/page/npm`, source = `${folder}/node_modules/axe-core/axe.min.js`;
    mkdirSync(folder, { recursive: true });
    for (const file of ["package.json", "package-lock.json"]) copyFileSync(`web/${file}`, `${folder}/${file}`);
    if (!existsSync(source)) spawnSync("npm", ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=0", "--fetch-timeout=20000"], { cwd: folder, timeout: 60e3 });
    return existsSync(source) ? readFileSync(source, "utf8") : null;
}

const IDLE = "window.rollbem && rollbem.page.answer && rollbem.idle()";
const VIEWS = ["hero", "press", "brake", "soft", "below", "step", "roll", "bench"];
async function views(page) {
    const number = (name) => page.run(`rollbem.page.answer.numbers.${name}`);
    /* The numbers that the page holds, and those that it shows, against a run of the program. */
    async function same_as_the_program() {
        await page.run("rollbem.open('bench')");
        await settled();
        const { given, numbers, shown } = await page.run("({ given: rollbem.page.given, numbers: rollbem.page.answer.numbers, shown: Object.fromEntries([...document.querySelectorAll('[data-number]')].map((e) => [e.dataset.number, e.firstChild.textContent])) })");
        const want = flatten({ ...JSON.parse(run(["--json", "--quiet", ...words_of(given)]).stdout), inputs: null });
        for (const name of ["normal_load", "tangential_load", "max_pressure", "approach", "half_width"]) {
            check_close(numbers[name], want[name], FITTED * Math.max(Math.abs(want[name]), /load/.test(name) ? want.normal_load : 0), name);
            if (Math.abs(want[name]) > 1 && want[name] < 1e5) check(shown[name].replace("−", "-") === String(Number(want[name].toPrecision(4))), `${name} shown: ${shown[name]}, the program has ${want[name]}`);
        }
    }
    /* Events are taken, a frame is drawn, and nothing is left to solve. */
    const settled = async () => { await page.run("new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)))"); await page.until(IDLE); };
    await test("the page solves and shows the program's numbers", async () => {
        await page.until(IDLE);
        await same_as_the_program();
    });
    await test("the command that the page shows gives the page's numbers", async () => {
        await page.run("rollbem.open('take')");
        await settled();
        const command = await page.run("document.querySelector('[data-take=command]').value");
        const want = flatten({ ...JSON.parse(run(["--json", "--quiet", ...command.split(" ").slice(1)]).stdout), inputs: null });
        check_close(await number("tangential_load"), want.tangential_load, FITTED * Math.abs(want.tangential_load), "Q");
    });
    for (const preset of ["rail", "roll", "stiff", "addi"])
        await test(`every control moved: ${preset}`, async () => {
            await page.run(`rollbem.open('bench'); rollbem.preset('${preset}')`);
            await settled();
            check(await page.run("document.getElementById('message').hidden"), await page.run("document.getElementById('message').textContent"));
            const knobs = await page.run("[...document.querySelectorAll('#controls [data-knob]')].map((k) => k.dataset.knob)");
            check(knobs.length >= 7, `${knobs.length} sliders`);
            for (const knob of knobs) {
                const before = await page.run(`rollbem.page.given['${knob}'] ?? rollbem.page.answer.values['${knob}']`);
                await page.run(`{ const k = document.querySelector('[data-knob="${knob}"]'); k.value = Number(k.value) - 12 * Number(k.step); k.dispatchEvent(new Event("input")); k.dispatchEvent(new Event("change")); }`);
                await settled();
                const after = await page.run(`rollbem.page.given['${knob}']`);
                check(after !== before, `${knob} stayed at ${before}`);
                check(await page.run("document.getElementById('message').hidden"), `${knob} = ${after}: ${await page.run("document.getElementById('message').textContent")}`);
            }
            await same_as_the_program();
        });
    await test("every choice taken", async () => {
        await page.run("rollbem.preset('rail')");
        await settled();
        const choices = await page.run("[...document.querySelectorAll('#controls input[type=radio]')].map((r) => [r.name, r.value])");
        for (const [name, value] of choices) {
            await page.run(`rollbem.preset('rail'); document.querySelector('#controls input[name="${name}"][value="${value}"]')?.click()`);
            await settled();
            check(await page.run("document.getElementById('message').hidden"), `${name} ${value}: ${await page.run("document.getElementById('message').textContent")}`);
        }
    });
    await test("the point of the creep curve moved by keys", async () => {
        await page.run("rollbem.preset('rail')");
        await settled();
        const before = await number("force_ratio");
        await page.run("document.querySelector('[data-handle=bench]').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowUp', bubbles: true }))");
        await settled();
        check_close(await number("force_ratio"), before + 0.02, 6e-4, "Q/(mu P)");
    });
    for (const [preset, matrices] of [["rail", 2], ["stiff", 6]])
        await test(`Lemke stepped to the end, zones guessed: ${preset}`, async () => {
            await page.run(`rollbem.preset('${preset}'); rollbem.open('step'); document.querySelector("#at-step details").open = true`);
            await settled();
            check(await page.run("document.querySelectorAll('#at-step canvas').length") === matrices, "matrices");
            const count = await page.run("rollbem.views.step.player.count"), click = (text) => page.run(`[...document.querySelectorAll('#at-step button')].find((b) => b.textContent === '${text}').click()`);
            for (let k = 0; k < count; k++) {
                const sentence = await page.run("document.querySelector('.sentence').textContent");
                check(/ until .+\.$|touches\.$/.test(sentence) && !/[{}]|undefined/.test(sentence), `pivot ${k + 1}: ${sentence}`);
                await click("Next");
            }
            check(/the problem is solved/.test(await page.run("document.querySelector('.sentence').textContent")), "the last pivot");
            const same = await page.run("(([now, want]) => now === want)([...document.querySelectorAll('#at-step .cells[aria-label*=\"zones\"], #at-step .cells[aria-label*=\"basis after this pivot:\"]')].map((s) => s.getAttribute('aria-label').replace(/^.*?:/, '')))");
            check(same, "the zones of the last basis are those of the solution");
            const newton = await page.run("(([zones, want]) => [zones.slice(-want.length).join(' '), want.join(' ')])([[...rollbem.views.step.data()['newton.zone'].at], [...rollbem.views.step.data().columns.zone]])");
            check(newton[0] === newton[1], `Newton's last zones are ${newton[0]}, those of the solution ${newton[1]}`);
            const told = await page.run("[...document.querySelectorAll('#at-step canvas')].map((c) => { const box = c.getBoundingClientRect(); c.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + 0.3 * box.width, clientY: box.top + 0.6 * box.height, bubbles: true })); return c.closest('figure').querySelector('p').textContent; })");
            for (const text of told) check(/\] = /.test(text) && !/[{}]|undefined|NaN/.test(text), `a block is explained as: ${text}`);
            await click("Check");
            await settled();
            check(await page.run("document.querySelector('#at-step .verdict, #at-step .bad') !== null"), "no verdict on a wrong guess");
            const why = await page.run("document.querySelector('#at-step .bad')?.textContent ?? ''");
            check(!/singular/.test(why) || /a given load needs elements that touch/.test(why), `the verdict: ${why}`);
            await click("Show the answer");
            await settled();
            check(await page.run("document.querySelector('#at-step .good') !== null"), `the answer: ${await page.run("document.querySelector('#at-step .verdict')?.textContent")}`);
        });
    await test("Step through takes the elements of the case where they are few, else those of its slider", async () => {
        const link = (n) => page.run(`location.hash = "#support=halfplane&load=100&mu=0.3&contact-elements=${n}&view=step"`);
        const slide = (n) => page.run(`{ const s = document.getElementById('step-elements'); s.value = ${n}; s.dispatchEvent(new Event("input")); s.dispatchEvent(new Event("change")); }`);
        for (const [what, move, want] of [["a link of 11", () => link(11), 11], ["its slider", () => slide(6), 6], ["a link of 60", () => link(60), 6], ["a link of 4", () => link(4), 4]]) {
            await move();
            await settled();
            const got = await page.run("[rollbem.views.step.data()['pivot.p'].rows, Number(document.getElementById('step-elements').value)].join()");
            check(got === `${want},${want}`, `${what}: elements, slider are ${got}`);
        }
    });
    await test("rolled, and looked below", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('roll')");
        await settled();
        await page.run("rollbem.views.roll.player.go(1e9)");
        check(await page.run("rollbem.views.roll.player.at") > 20, "steps");
        await page.run("document.querySelector('#at-roll .hand-drawn').open = true; document.querySelector('input[name=hand][value=force_ratio]').click()");
        await settled();
        const drag = await page.run(`(() => { const [svg] = document.querySelectorAll("#at-roll svg.hand-line"), box = svg.getBoundingClientRect(), send = (on, type, u, v) => on.dispatchEvent(new PointerEvent(type, { clientX: box.left + u * box.width, clientY: box.top + v * box.height, bubbles: true, cancelable: true }));
            const before = rollbem.page.drawn.values.join(" "); send(svg, "pointerdown", 0.5, 0.3); send(window, "pointermove", 0.7, 0.2); send(window, "pointermove", 0.98, 0.25); send(window, "pointerup", 0.98, 0.25); return [before, rollbem.page.drawn.values.join(" ")]; })()`);
        check(drag[0] !== drag[1], "the line stays as it was");
        await settled();
        const { at, force } = await page.run("({ at: rollbem.page.drawn.values.at(-1), force: rollbem.views.roll.force() })");
        check_close(force, at, 1e-9, "the force at the end is the one that was drawn");
        await page.run("document.querySelector('input[name=hand][value=none]').click()");
        await settled();
        await page.run("rollbem.open('below')");
        await settled();
        for (const kind of ["von_mises", "fringes", "max_shear"]) await page.run(`document.querySelector('#at-below input[value=${kind}]').click()`);
        await page.run("rollbem.views.below.reveal()");
        await settled();
        check(await page.run("document.querySelector('#at-below image') !== null"), "no map");
    });
    await test("a page that rollbem page made opens with its case", async () => {
        const folder = mkdtempSync(join(tmpdir(), "page-")), made = join(folder, "made.html");
        const ran = run(["page", "examples/rail/case.ini", "--mu", "0.2", "--page", file, "--output", made]);
        check(ran.status === 0, ran.stderr);
        const other = await open_page(pathToFileURL(made).href);
        try {
            await other.until(IDLE);
            const want = flatten({ ...JSON.parse(run(["--json", "--quiet", "examples/rail/case.ini", "--mu", "0.2"]).stdout), inputs: null });
            check_close(await other.run("rollbem.page.answer.numbers.tangential_load"), want.tangential_load, FITTED * want.normal_load, "Q");
        } finally { await other.close(); rmSync(folder, { recursive: true }); }
    });
    await test("rollbem page refuses what the page itself cannot show", () => {
        for (const more of [{ error: "yes" }, { accuracy: "1e-3" }, { "contact-elements": "401" }]) {
            const given = { support: "halfplane", load: "100", ...more }, ran = run(["page", ...words_of(given), "--page", file]);
            const { refused } = answer(library, { kind: "solve", given });
            check(ran.status === 64 && ran.stdout === "" && ran.stderr.trim() === `rollbem: ${refused}`, `got '${ran.stderr}', the page says '${refused}'`);
        }
    });
    await test("a case file opened, and files that are none", async () => {
        await page.run("rollbem.open('bench')");
        await page.run(`rollbem.page.open_file(new File([${JSON.stringify("[friction]\nmu = 0.17 ; of a file\n[load]\nload = 300\n[body-a]\nsupport = halfplane\n")}], "case.ini"))`);
        await settled();
        await same_as_the_program();
        check(await page.run("rollbem.page.answer.values.mu") === "0.17", "mu is not the file's");
        for (const [text, line] of [["<script>alert(1)</script>", "expected name = value"], ["x".repeat(50000), "more than"], ["mu = <img src=x onerror=alert(1)>", "--mu: expected a number"], ["colour = red", "unknown option"]]) {
            await page.run(`rollbem.page.open_file(new File([${JSON.stringify(text)}], "case.ini"))`);
            await page.until(`document.getElementById('message').textContent.includes(${JSON.stringify(line)})`, 10);
            check(await page.run("document.querySelectorAll('#message *').length") === 0, "the message holds elements");
        }
    });
    for (const [link, line] of [["#mu=%3Cimg%20src=x%3E", "--mu: expected a number"], ["#nothing=1", "unknown option"], ["#contact-elements=1e9", "--contact-elements"], [`#mu=${"9".repeat(5000)}`, "could not be read"], ["#mu=0.3&drawn=load+1+NaN+2", "could not be read"], ["#formulation=transient&history=/etc/passwd", "/etc/passwd"], ["#mu=0.3&load=-1", "this is the first case"]])
        await test(`a hostile link says so: ${link.slice(0, 30)}`, async () => {
            await page.run(`location.hash = ${JSON.stringify(link)}`);
            await page.until(`document.getElementById('message').textContent.includes(${JSON.stringify(line)})`, 10);
            check(await page.run("document.querySelectorAll('#message *').length") === 0, "the message holds elements");
        });
    for (const [width, height] of [[320, 640], [390, 844], [667, 375], [820, 1180], [900, 700], [1280, 900], [1920, 1080]])
        await test(`every view fits ${width} x ${height}, and its controls are in sight`, async () => {
            await page.size(width, height, false, width < 900);
            for (const view of VIEWS) {
                await page.run(`rollbem.open('${view}')`);
                await settled();
                const right = await page.run("[document.documentElement.scrollWidth, ...[...document.querySelectorAll('main section, main .card, main figure, main .stage-box')].map((e) => e.getBoundingClientRect().right)]");
                check(Math.max(...right) <= width, `${view}: ${right.map(Math.round).filter((x) => x > width)}`);
            }
            /* What lies over a slider is no slider: the middle of each can be touched once it is scrolled to. */
            const hidden = await page.run("[...document.querySelectorAll('input[type=range]')].filter((e) => e.offsetParent).filter((e) => { e.scrollIntoView({ block: 'center', behavior: 'instant' }); const b = e.getBoundingClientRect(); return document.elementFromPoint(b.left + b.width / 2, b.top + b.height / 2) !== e; }).map((e) => e.getAttribute('aria-label') ?? e.id)");
            check(!hidden.length, `covered: ${hidden}`);
        });
    await test("the keyboard goes from top to bottom, on a phone and on a screen", async () => {
        for (const [width, mobile] of [[390, true], [1280, false]]) {
            await page.size(width, 844, false, mobile);
            await settled();
            /* In the order of the keyboard nothing is above the section of what came before. */
            const tops = await page.run("[...document.querySelectorAll('main section.chapter')].map((s) => s.getBoundingClientRect().top + scrollY)");
            check(tops.every((top, k) => !k || top > tops[k - 1]), `${tops}`);
            const [picture, panel, before] = await page.run("[document.querySelector('.tractions').getBoundingClientRect().top, at('controls').getBoundingClientRect().top, Boolean(at('controls').compareDocumentPosition(document.querySelector('.tractions')) & Node.DOCUMENT_POSITION_FOLLOWING)]");
            check(width > 800 ? before : !before && panel > picture, `${width} px: the controls at ${panel}, the picture at ${picture}`);
        }
        await page.size(1280, 900);
    });
    await test("the sketch of the signs is shown, and closed again", async () => {
        const click = (where, text) => page.run(`[...document.querySelectorAll('${where} button')].find((b) => b.textContent === '${text}').click()`);
        await click("#controls", "Signs: what is positive");
        check(await page.run("at('signs').open && at('signs').querySelector('img').naturalWidth > 0 && at('signs').querySelector('img').clientWidth >= 600"), "no sketch, or one too small to read");
        await click("#signs", "Close");
        check(await page.run("!at('signs').open"), "it stays");
    });
    await test("every control has a name, every picture a description", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        const nameless = await page.run("[...document.querySelectorAll('input, button, select, textarea, [role=img], [role=slider]')].filter((e) => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim())).map((e) => e.outerHTML.slice(0, 80))");
        check(nameless.length === 0, nameless.join(" "));
    });
    const axe = axe_source();
    if (axe) {
        await page.run(`${axe};0`);
        for (const mode of ["light", "dark"])
            await test(`no finding of axe-core in any view, ${mode}`, async () => {
                await page.size(1280, 900, mode === "dark");
                await page.run("rollbem.preset('stiff')");
                for (const view of VIEWS) { /* each comes near, and so is drawn */
                    await page.run(`rollbem.open("${view}")`);
                    await settled();
                }
                for (const sheet of [0, 1]) {
                    await page.run(`document.querySelectorAll("main details").forEach((d) => { d.open = ${Boolean(sheet)}; }); ${sheet ? "document.querySelector('input[name=hand][value=load]')?.click()" : ""}`);
                    await settled();
                    const found = await page.run("axe.run(document).then((r) => r.violations.flatMap((v) => v.nodes.map((n) => `${v.id}: ${n.html.slice(0, 100)} ${n.any[0]?.message ?? ''}`)))");
                    check(found.length === 0, `${sheet ? "opened" : "closed"}: ${found.slice(0, 6).join("; ")}`);
                }
                await page.run("document.querySelector('input[name=hand][value=none]')?.click(); document.querySelectorAll('main details').forEach((d) => { d.open = false; })");
            });
        await page.size(1280, 900);
    } else console.log("[  SKIPPED ] accessibility: axe-core cannot be had from npm here");
    /* Young's modulus makes all anew; friction leaves the flexibility where the zone is given. */
    const moves = process.env.ROLLBEM_TEST_ALL ? 200 : 20;
    for (const [what, preset, more, option, from] of [["60 elements cold, half-planes", "rail", { "contact-elements": "60" }, "young", 150000], ["60 elements cold, wheel", "stiff", { "contact-elements": "60" }, "young", 10],
        ["200 elements on a given zone, half-planes", "rail", { "contact-elements": "200", zone: "3" }, "mu", 0.2], ["200 elements on a given zone, wheel", "stiff", { "contact-elements": "200", zone: "24" }, "mu", 0.4]])
        await test(`a move is shown: ${what} (a figure, no bound)`, async () => {
            await page.run(`rollbem.preset('${preset}')`);
            await settled();
            await page.run(`rollbem.page.change({ ...rollbem.page.given, ...${JSON.stringify(more)} })`);
            await settled();
            const times = await page.run(`rollbem.time_moves("${option}", ${from}, ${moves})`);
            check(times.length === moves, `${times.length} moves`);
            console.log(`         ${what}, ${moves} moves of ${option}: median ${times[moves / 2].toFixed(1)} ms, worst ${times.at(-1).toFixed(1)} ms`);
            const given = await page.run("rollbem.page.given"), want = flatten({ ...JSON.parse(run(["--json", "--quiet", ...words_of(given)]).stdout), inputs: null });
            check_close(await number("approach"), want.approach, FITTED * want.approach, "the approach after the last move");
        });
    await test("no error, no request", () => {
        check(page.errors.length === 0, page.errors.join("; "));
        const outside = page.requested.filter((address) => !/^(file|blob|data):/.test(address));
        check(outside.length === 0, outside.join(" "));
    });
}

if (spawnSync("chromium", ["--version"]).status === 0) {
    const page = await open_page(url);
    try { await views(page); } finally { await page.close(); }
} else {
    console.log("[  SKIPPED ] the page in a browser: no chromium here");
}
console.log(`page: ${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
