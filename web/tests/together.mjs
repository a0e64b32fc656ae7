/* Pictures and their sliders in one window: every slider of the page in the middle of the window, or as near as the page
 * lets it, and how much of its picture is then to be seen.  node web/tests/together.mjs [build] prints it at four sizes. */
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { close_browser, open_page } from "../chromium.mjs";

export const SIZES = [
    [1280, 590],
    [844, 390],
    [390, 844],
    [360, 640],
];
const PICTURES = { hero: ".stage-box", bench: ".tractions figure svg" };

/* Rows of { slider, chapter, part } of one size. */
export async function seen_together(url, width, height) {
    const page = await open_page(url, { width, height, mobile: width < 500 });
    await page.until("window.rollbem && rollbem.idle()");
    const rows = [];
    for (const chapter of ["hero", "press", "brake", "roll", "soft", "below", "crack", "bench"]) {
        await page.run(`rollbem.open("${chapter}")`);
        await page.until("rollbem.idle()");
        await page.run(
            `{ const view = rollbem.views["${chapter}"]; view.answer?.({ press: "16", soft: "larger" }["${chapter}"]); view.see?.(); view.reveal?.();
               document.querySelector("#at-crack .choice").click(); }`,
        );
        await page.until("rollbem.idle()");
        rows.push(
            ...(await page.run(
                `document.querySelector("#at-${chapter} ${PICTURES[chapter] ?? ".two"}").scrollIntoView({ block: "start", behavior: "instant" });
                [...document.querySelectorAll("#at-${chapter} input[type=range]")].filter((slider) => slider.offsetParent).map((slider) => {
                    slider.scrollIntoView({ block: slider.closest(".players") ? "start" : slider.closest(".two > .after") ? "center" : "nearest", behavior: "instant" });
                    const head = document.querySelector("header").getBoundingClientRect().bottom,
                        picture = (slider.closest(".two") ?? document.querySelector("#at-${chapter}")).querySelector("${PICTURES[chapter] ?? "figure svg"}").getBoundingClientRect(),
                        at = slider.getBoundingClientRect(),
                        visible = Math.min(innerHeight, picture.bottom) - Math.max(head, picture.top);
                    return { slider: slider.dataset.dial ?? slider.ariaLabel ?? slider.id, chapter: "${chapter}",
                        part: at.top >= head && at.bottom <= innerHeight + 1 ? Math.max(0, visible / picture.height) : 0 };
                })`,
            )),
        );
    }
    await page.close();
    return rows;
}

if (process.argv[1]?.endsWith("together.mjs")) {
    const url = pathToFileURL(resolve(`${process.argv[2] ?? "build"}/rollbem.html`)).href;
    for (const [width, height] of SIZES) {
        const rows = await seen_together(url, width, height),
            short = rows.filter(({ part }) => part < 0.9);
        console.log(`${width} x ${height}: ${rows.length - short.length} of ${rows.length} sliders with their picture`);
        for (const { slider, chapter, part } of short)
            console.log(`  ${chapter} ${slider}: ${Math.round(100 * part)} %`);
    }
    await close_browser();
}
