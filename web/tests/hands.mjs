/* Random hands: a mouse, a finger and keys that do anything anywhere, and the tasks of a lecturer.
 * node web/tests/hands.mjs [build [seconds [seed]]] prints what was done and every fault. */
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { close_browser, open_page } from "../chromium.mjs";

const SIZES = [
    [1280, 720],
    [390, 844],
    [844, 390],
];
/* Numbers from 0 to 1 of a seed. */
function random_of(seed) {
    let state = seed >>> 0 || 1;
    return () => {
        state ^= state << 13;
        state ^= state >>> 17;
        state ^= state << 5;
        state >>>= 0;
        return state / 2 ** 32;
    };
}
const KEYS = [
    ..."sa123",
    "Tab",
    "Enter",
    "Escape",
    "ArrowLeft",
    "ArrowRight",
    "ArrowUp",
    "ArrowDown",
    "PageUp",
    "PageDown",
    " ",
];

/* { done, faults: [text ...] } of so many seconds. */
export async function random_hands(url, { width, height, seconds, seed }) {
    const page = await open_page(url, { width, height, mobile: width < 500 }),
        random = random_of(seed),
        any = (list) => list[Math.floor(random() * list.length)],
        place = () => ({ x: Math.floor(random() * width), y: Math.floor(random() * height) });
    await page.until("window.rollbem && rollbem.idle()", 60);
    /* New windows, printers and files are not for hands that nobody watches. */
    await page.run(
        "window.open = () => null; window.print = () => {}; HTMLAnchorElement.prototype.click = () => {}; 0",
    );
    const mouse = (type, { x, y }, more) =>
        page.tab("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1, ...more });
    const hands = {
        async click() {
            const at = place();
            await mouse("mousePressed", at);
            await mouse("mouseReleased", at);
        },
        async drag() {
            await mouse("mousePressed", place());
            for (let k = 0; k < 5; k++) await mouse("mouseMoved", place());
            await mouse("mouseReleased", place());
        },
        async finger() {
            await page.tab("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [place()] });
            await page.tab("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [place()] });
            await page.tab("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
        },
        async key() {
            const key = any(KEYS);
            for (const type of ["keyDown", "keyUp"])
                await page.tab("Input.dispatchKeyEvent", { type, key, ...(key.length === 1 && { text: key }) });
        },
        scroll: () =>
            mouse("mouseWheel", place(), { button: "none", buttons: 0, deltaX: 0, deltaY: 1600 * (random() - 0.4) }),
        slider: () =>
            page.run(
                `{ const all = [...document.querySelectorAll("input[type=range]")].filter((node) => node.offsetParent), one = all[Math.floor(${random()} * all.length)];
                   if (one) { one.value = Number(one.min) + ${random()} * (one.max - one.min); one.dispatchEvent(new Event("input")); one.dispatchEvent(new Event("change")); } }`,
            ),
        press: () =>
            page.run(
                `{ const all = [...document.querySelectorAll("main button, main label, nav a, summary")].filter((node) => node.offsetParent && !/PNG|SVG|WebM/.test(node.textContent)); all[Math.floor(${random()} * all.length)]?.click(); }`,
            ),
    };
    let done = 0;
    for (const end = Date.now() + 1000 * seconds; Date.now() < end; done++) await any(Object.values(hands))();
    await page.until("rollbem.idle()", 90).catch((error) => page.errors.push(error.message));
    const odd = await page.run(
        "['NaN', 'undefined', '[object'].filter((what) => document.querySelector('main').innerText.includes(what))",
    );
    const faults = [...page.errors, ...(await page.run("rollbem.faults")), ...odd.map((what) => `shows ${what}`)];
    await page.close();
    return { done, faults };
}

/* What a lecturer wants, each from the page alone: [what, how, holds]. */
export const TASKS = [
    ["take the brake off", "dial('#at-hero', 'creep-ratio', 0)", "/Nothing slips/.test(headline())"],
    ["let the wheel skid", "dial('#at-hero', 'creep-ratio', 1.1)", "headline() === 'Now it skids.'"],
    [
        "double the load",
        "press('#at-press [data-value=\"16\"]'); await rest(); press('#at-press .after .row .button')",
        "/^2 times the load: the strip is 1.41/.test(text('#at-press .after .note'))",
    ],
    ["show the creep curve", "press('#at-brake .button.main')", "document.querySelector('#at-brake path.curve')"],
    ["roll from rest", "press('#at-roll .players .main')", "text('#at-roll .players .main') === 'Pause'"],
    [
        "mark where the steel is strained most",
        "press('#at-below .button.main')",
        "document.querySelector('#at-below image')",
    ],
    [
        "open a crack with water",
        "press('#at-crack [data-value=slides]'); await rest(); press('#at-crack input[value=trapped]')",
        "/water/i.test(text('#at-crack'))",
    ],
    [
        "step to the solution and its proof",
        "for (let k = 0; k < 12; k++) press('#at-step .players button:nth-child(4)')",
        "/^Proof: There is a solution/.test(text('#at-step .pivots > .note'))",
    ],
    [
        "take the case along as Python",
        "press('#at-bench details.take > summary')",
        "/import rollbem/.test([...document.querySelectorAll('#at-bench textarea')].map((node) => node.value).join())",
    ],
    [
        "count guesses on a slide",
        "press('#class'); press('.now .tally .choice'); press('.now .panel .main')",
        "text('.now .tally b') === '1' && document.querySelector('.now .tally.right')",
    ],
];
export async function tasks_done(url) {
    const page = await open_page(url, { width: 1280, height: 720 }),
        rows = [];
    await page.until("window.rollbem && rollbem.idle()", 60);
    await page.run(`Object.assign(window, {
        text: (of) => document.querySelector(of)?.innerText ?? "",
        headline: () => document.getElementById("headline").textContent,
        press(of) { const node = document.querySelector(of); if (!node?.getClientRects().length) throw new Error("nothing to press: " + of); node.click(); },
        dial(of, name, value) { const node = document.querySelector(of + ' [data-dial="' + name + '"]'); node.value = value; node.dispatchEvent(new Event("input")); node.dispatchEvent(new Event("change")); },
        async rest() { await new Promise((done) => setTimeout(done, 100)); while (!rollbem.idle()) await new Promise((done) => setTimeout(done, 20)); },
    }); 0`);
    for (const [what, how, holds] of TASKS) {
        const chapter = /#at-(\w+)/.exec(how)?.[1];
        let said = "";
        try {
            if (chapter) await page.run(`(async () => { rollbem.open("${chapter}"); await rest(); })()`);
            await page.run(`(async () => { ${how}; })()`);
            await page.until(`Boolean(${holds})`, 20);
        } catch (error) {
            said = error.message.split("\n")[0];
        }
        rows.push({ what, said });
    }
    const { errors } = page;
    await page.close();
    return { rows, errors };
}

if (process.argv[1]?.endsWith("hands.mjs")) {
    const [build = "build", seconds = "300", seed = "1"] = process.argv.slice(2),
        url = pathToFileURL(resolve(`${build}/rollbem.html`)).href,
        { rows, errors } = await tasks_done(url);
    for (const { what, said } of rows) console.log(`${said ? "not done" : "done"}: ${what} ${said}`);
    for (const fault of errors) console.log(`  ${fault}`);
    for (const [k, [width, height]] of SIZES.entries()) {
        const { done, faults } = await random_hands(url, {
            width,
            height,
            seconds: Number(seconds) / SIZES.length,
            seed: Number(seed) + k,
        });
        console.log(`${width} x ${height}: ${done} acts of random hands, ${faults.length} faults`);
        for (const fault of faults) console.log(`  ${fault}`);
    }
    await close_browser();
}
