/* Nothing moves under a hand: a mouse drags "brake" over its whole way, at five sizes; what moves meanwhile, in CSS pixels,
 * and Chromium's layout shift, also while the page loads.  node web/tests/still.mjs [build] prints them. */
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { close_browser, open_page } from "../chromium.mjs";
import { open_in_firefox } from "./firefox.mjs";

export const SIZES = [
    [1440, 900],
    [1280, 720],
    [1280, 590],
    [844, 390],
    [390, 844],
    [360, 640],
];
const SHIFTS = `window.shifts = 0;
    new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) shifts += entry.value;
    }).observe({ type: "layout-shift", buffered: true });`;

/* { loading, shift, moved }: layout shift while it loads and under the hand; the most that the picture or a slider moved. */
export async function drag_brake(url, width, height) {
    const page = await open_page("about:blank", { width, height, mobile: width < 500 });
    await page.tab("Page.addScriptToEvaluateOnNewDocument", { source: SHIFTS });
    await page.tab("Page.navigate", { url });
    await page.until("window.rollbem && rollbem.idle()");
    await new Promise((done) => setTimeout(done, 300));
    const loading = await page.run("shifts");
    const places = () =>
        page.run(
            `["#at-hero .stage-box", "#at-hero [data-dial=creep-ratio]", "#at-hero [data-dial=load]"].map((of) => {
                const box = document.querySelector(of).getBoundingClientRect();
                return [box.left, box.top, box.width, box.height];
            })`,
        );
    const first = await places(),
        [left, top, wide, tall] = first[1],
        y = top + tall / 2;
    await page.run("shifts = 0");
    const mouse = (type, x) =>
        page.tab("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1 });
    let moved = 0;
    await mouse("mousePressed", left + 0.7 * wide);
    for (let k = 0; k <= 24; k++) {
        await mouse("mouseMoved", left + wide * (0.5 + 0.5 * Math.sin((k / 12) * Math.PI)));
        await page.until("rollbem.solver.idle()");
        await page.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
        const now = await places();
        moved = Math.max(moved, ...now.flatMap((box, i) => box.map((v, j) => Math.abs(v - first[i][j]))));
    }
    await mouse("mouseReleased", left + 0.7 * wide);
    await page.until("rollbem.idle()");
    const shift = await page.run("shifts"),
        errors = page.errors;
    await page.close();
    return { loading, shift, moved, errors };
}

/* The same in Firefox, which does not tell its layout shift: how far a mouse or a finger moved picture or slider. */
export async function drag_brake_in_firefox(url, kind, width, height) {
    const page = await open_in_firefox(url, { width, height: height + 90 });
    try {
        await page.until("window.rollbem && rollbem.idle()");
        const places = () =>
            page.run(
                `["#at-hero .stage-box", "#at-hero [data-dial=creep-ratio]"].map((of) => {
                    const box = document.querySelector(of).getBoundingClientRect();
                    return [box.left, box.top, box.width, box.height];
                })`,
            );
        await page.run(
            'document.querySelector("#at-hero [data-dial=creep-ratio]").scrollIntoView({ block: "nearest", behavior: "instant" })',
        );
        const first = await places(),
            [left, top, wide, tall] = first[1],
            way = Array.from({ length: 13 }, (_, k) => [
                left + wide * (0.5 + 0.48 * Math.sin(0.4 + (k / 6) * Math.PI)),
                top + tall / 2,
            ]),
            texts = new Set();
        let moved = 0;
        await page.drag(kind, way, async () => {
            await page.until("rollbem.solver.idle()");
            const now = await places();
            moved = Math.max(moved, ...now.flatMap((box, i) => box.map((v, j) => Math.abs(v - first[i][j]))));
            texts.add(await page.run("document.getElementById('headline').textContent"));
        });
        return { moved, headlines: texts.size, faults: await page.run("rollbem.faults") };
    } finally {
        await page.close();
    }
}

if (process.argv[1]?.endsWith("still.mjs")) {
    const url = pathToFileURL(resolve(`${process.argv[2] ?? "build"}/rollbem.html`)).href;
    for (const [width, height] of SIZES) {
        const { loading, shift, moved } = await drag_brake(url, width, height);
        console.log(
            `${width} x ${height}: moved ${moved.toFixed(1)} px, layout shift ${shift.toFixed(4)}, loading ${loading.toFixed(4)}`,
        );
    }
    await close_browser();
    for (const [kind, [width, height]] of SIZES.flatMap((size) => ["mouse", "touch"].map((kind) => [kind, size]))) {
        const { moved, headlines, faults } = await drag_brake_in_firefox(url, kind, width, height);
        console.log(
            `Firefox, ${kind}, ${width} x ${height}: moved ${moved.toFixed(1)} px, ${headlines} headlines${faults.join()}`,
        );
    }
}
