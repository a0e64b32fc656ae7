/* Tests of the page: node web/tests/test.mjs [build [first | second | smoke]], with verdicts as tests/run reads them.  The
 * library as WebAssembly answers as the program does; then the page itself in a headless Chromium.  Much of the time of a
 * browser is waiting for its next frame, so tests/page runs both halves at once; without a word all tests run. */
import { spawnSync } from "node:child_process";
import { begin, check, test, told, url, wanted } from "./suite.mjs";
import { test_chapters } from "./test_chapters.mjs";
import { test_controls, test_first_screen } from "./test_controls.mjs";
import { test_figures } from "./test_figures.mjs";
import { test_firefox } from "./test_firefox.mjs";
import { test_hands } from "./test_hands.mjs";
import { test_library } from "./test_library.mjs";
import { test_scripts } from "./test_scripts.mjs";
import { test_step } from "./test_step.mjs";
import { test_take } from "./test_take.mjs";
import { test_windows } from "./test_windows.mjs";
import { visit } from "./visit.mjs";
import { CHROMIUM, close_browser, open_page } from "../chromium.mjs";

const PARTS = [
    ["first", [test_controls, test_step, test_chapters, test_figures]],
    ["second", [test_hands, test_take, test_windows]],
];

/* One visit: each part goes on where the one before it has left the page. */
async function test_page(page) {
    const visited = visit(page);
    await test_first_screen(visited);
    if (wanted === "smoke") return;
    for (const [half, parts] of PARTS) {
        begin(half);
        for (const part of parts) await part(visited);
    }
    begin(wanted); /* of each browser */
    await test("no error, no request", () => {
        check(page.errors.length === 0, page.errors.join("; "));
        const outside = page.requested.filter((address) => !/^(file|blob|data):/.test(address));
        check(outside.length === 0, outside.join(" "));
    });
}

await test_library();
await test_scripts();
if (CHROMIUM) {
    const page = await open_page(url);
    try {
        await test_page(page);
    } finally {
        await close_browser();
    }
} else {
    console.log("[  SKIPPED ] the page in a browser: no chromium here");
}
begin("first");
if (wanted === "second" || wanted === "smoke");
else if (spawnSync("firefox-esr", ["--version"]).status === 0) await test_firefox();
else console.log("[  SKIPPED ] the page in Firefox: no firefox-esr here");
process.exit(told() ? 1 : 0);
