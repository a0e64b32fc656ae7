/* Hostile links, windows of every size, the keyboard, accessibility, frames. */
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync } from "node:fs";
import { build, check, check_close, FITTED, flatten, run, test, words_of } from "./suite.mjs";
import { crawled, VIEWS } from "./visit.mjs";

function axe_source() {
    const folder = `${build}/page/npm`,
        source = `${folder}/node_modules/axe-core/axe.min.js`;
    mkdirSync(folder, { recursive: true });
    for (const file of ["package.json", "package-lock.json"]) copyFileSync(`web/${file}`, `${folder}/${file}`);
    if (!existsSync(source))
        spawnSync(
            "npm",
            ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=0", "--fetch-timeout=20000"],
            { cwd: folder, timeout: 60e3 },
        );
    return existsSync(source) ? readFileSync(source, "utf8") : null;
}

export async function test_windows({ page, number, settled, mouse }) {
    for (const [link, line] of [
        ["#mu=%3Cimg%20src=x%3E", "--mu: expected a number"],
        ["#nothing=1", "unknown option"],
        ["#contact-elements=1e9", "--contact-elements"],
        [`#mu=${"9".repeat(5000)}`, "could not be read"],
        ["#mu=0.3&drawn=load+1+NaN+2", "could not be read"],
        ["#mu=0.3&drawn=toString+1+1+2", "could not be read"],
        ["#formulation=transient&history=/etc/passwd", "/etc/passwd"],
        ["#mu=0.3&load=-1", "the first case is shown instead"],
    ])
        await test(`a hostile link says so: ${link.slice(0, 30)}`, async () => {
            await page.run(`location.hash = ${JSON.stringify(link)}`);
            await page.until(`document.getElementById('message').textContent.includes(${JSON.stringify(line)})`, 10);
            check(
                (await page.run("document.querySelectorAll('#message *').length")) === 0,
                "the message holds elements",
            );
        });
    for (const [width, height] of [
        [320, 640],
        [390, 844],
        [667, 375],
        [820, 1180],
        [900, 700],
        [1280, 900],
        [1920, 1080],
    ])
        await test(`every view fits ${width} x ${height}, and its controls are in sight`, async () => {
            await page.size(width, height, false, width < 900);
            for (const view of VIEWS) {
                await page.run(`rollbem.open('${view}')`);
                await settled();
                const right = await page.run(
                    "[document.documentElement.scrollWidth, ...[...document.querySelectorAll('main section, main .card, main figure, main .stage-box')].map((e) => e.getBoundingClientRect().right)]",
                );
                check(Math.max(...right) <= width, `${view}: ${right.map(Math.round).filter((x) => x > width)}`);
            }
            /* What lies over a slider is no slider: the middle of each can be touched once it is scrolled to. */
            const hidden = await page.run(
                "[...document.querySelectorAll('input[type=range]')].filter((e) => e.offsetParent).filter((e) => { e.scrollIntoView({ block: 'center', behavior: 'instant' }); const b = e.getBoundingClientRect(); return document.elementFromPoint(b.left + b.width / 2, b.top + b.height / 2) !== e; }).map((e) => e.getAttribute('aria-label') ?? e.id)",
            );
            check(!hidden.length, `covered: ${hidden}`);
        });
    await test("the keyboard goes from top to bottom, on a phone and on a screen", async () => {
        for (const [width, mobile] of [
            [390, true],
            [1280, false],
        ]) {
            await page.size(width, 844, false, mobile);
            await settled();
            /* In the order of the keyboard nothing is above the section of what came before. */
            const tops = await page.run(
                "[...document.querySelectorAll('main section.chapter')].map((s) => s.getBoundingClientRect().top + scrollY)",
            );
            check(
                tops.every((top, k) => !k || top > tops[k - 1]),
                `${tops}`,
            );
            const [picture, panel, before] = await page.run(
                "[document.querySelector('.tractions').getBoundingClientRect().top, at('controls').getBoundingClientRect().top, Boolean(at('controls').compareDocumentPosition(document.querySelector('.tractions')) & Node.DOCUMENT_POSITION_FOLLOWING)]",
            );
            check(
                width > 800 ? before : !before && panel > picture,
                `${width} px: the controls at ${panel}, the picture at ${picture}`,
            );
        }
        await page.size(1280, 900);
    });
    await test("the sketch of the signs is shown, and closed again", async () => {
        const click = (where, text) =>
            page.run(
                `[...document.querySelectorAll('${where} button')].find((b) => b.textContent === '${text}').click()`,
            );
        await click("#controls", "Signs: what is positive");
        check(
            await page.run(
                "at('signs').open && at('signs').querySelector('img').naturalWidth > 0 && at('signs').querySelector('img').clientWidth >= 600",
            ),
            "no sketch, or one too small to read",
        );
        await click("#signs", "Close");
        check(await page.run("!at('signs').open"), "it stays");
    });
    await test("every control has a name, every picture a description", async () => {
        await page.run("rollbem.preset('rail'); rollbem.open('bench')");
        await settled();
        const nameless = await page.run(
            "[...document.querySelectorAll('input, button, select, textarea, [role=img], [role=slider]')].filter((e) => !(e.getAttribute('aria-label') || e.labels?.length || e.textContent.trim())).map((e) => e.outerHTML.slice(0, 80))",
        );
        check(nameless.length === 0, nameless.join(" "));
    });
    const axe = axe_source();
    if (axe) {
        await page.run(`${axe};0`);
        /* Opened sections show all that closed ones show, in the same colours: contrast, half of the time, once for
         * both.  Rules that are not of colours find in the dark what they find in the light. */
        const COLOURS = ["color-contrast", "link-in-text-block"],
            NO_CONTRAST = { rules: { "color-contrast": { enabled: false } } };
        for (const [mode, width, closed, opened] of [
            ["light", 1280, NO_CONTRAST, {}],
            ["dark", 1280, null, { runOnly: COLOURS }],
            ["light", 390, NO_CONTRAST, {}],
            ["dark", 320, NO_CONTRAST, {}],
        ])
            await test(`no finding of axe-core in any view, ${mode}, ${width} px`, async () => {
                await page.size(width, 900, mode === "dark");
                await page.run("rollbem.preset('stiff')");
                for (const view of VIEWS) {
                    /* each comes near, and so is drawn */
                    await page.run(`rollbem.open("${view}")`);
                    await settled();
                }
                for (const [sheet, rules] of [closed, opened].entries()) {
                    if (!rules) continue;
                    await page.run(
                        `document.querySelectorAll("main details").forEach((d) => { d.open = ${Boolean(sheet)}; }); ${sheet ? "document.querySelector('input[name=hand][value=load]')?.click()" : ""}`,
                    );
                    await settled();
                    const asked = JSON.stringify({ resultTypes: ["violations"], ...rules });
                    const found = await page.run(
                        `axe.run(document, ${asked}).then((r) => r.violations.flatMap((v) => v.nodes.map((n) => v.id + ": " + n.html.slice(0, 100) + " " + (n.any[0]?.message ?? ""))))`,
                    );
                    check(found.length === 0, `${sheet ? "opened" : "closed"}: ${found.slice(0, 6).join("; ")}`);
                }
                await page.run(
                    "document.querySelector('input[name=hand][value=none]')?.click(); document.querySelectorAll('main details').forEach((d) => { d.open = false; })",
                );
            });
        await page.size(1280, 900);
    } else console.log("[  SKIPPED ] accessibility: axe-core cannot be had from npm here");
    /* Young's modulus makes all anew; friction leaves the flexibility where the zone is given. */
    const moves = process.env.ROLLBEM_TEST_ALL ? 200 : 8;
    for (const [what, preset, more, option, from] of [
        ["60 elements cold, half-planes", "rail", { "contact-elements": "60" }, "young", 150000],
        ["60 elements cold, wheel", "stiff", { "contact-elements": "60" }, "young", 10],
        ["200 elements on a given zone, half-planes", "rail", { "contact-elements": "200", zone: "3" }, "mu", 0.2],
        ["200 elements on a given zone, wheel", "stiff", { "contact-elements": "200", zone: "24" }, "mu", 0.4],
    ])
        await test(`a move is shown: ${what} (a figure, no bound)`, async () => {
            await page.run(`rollbem.preset('${preset}')`);
            await settled();
            await page.run(`rollbem.page.change({ ...rollbem.page.given, ...${JSON.stringify(more)} })`);
            await settled();
            const times = await page.run(`rollbem.time_moves("${option}", ${from}, ${moves})`);
            check(times.length === moves, `${times.length} moves`);
            console.log(
                `         ${what}, ${moves} moves of ${option}: median ${times[moves / 2].toFixed(1)} ms, worst ${times.at(-1).toFixed(1)} ms`,
            );
            const given = await page.run("rollbem.page.given"),
                want = flatten({ ...JSON.parse(run(["--json", "--quiet", ...words_of(given)]).stdout), inputs: null });
            check_close(
                await number("approach"),
                want.approach,
                FITTED * want.approach,
                "the approach after the last move",
            );
        });
    await crawled("Chromium", page);
    await test("the first screen's sliders have room for a hand in every window", async () => {
        for (const wide of [320, 360, 430, 480, 500, 540, 600, 768, 1000, 1440]) {
            await page.size(wide, 850);
            await settled();
            const least = await page.run(
                "Math.min(...[...document.querySelectorAll('#at-hero [data-dial]')].map((of) => of.getBoundingClientRect().width))",
            );
            check(least > 55, `a slider of ${least} px in a window of ${wide}`);
        }
        await page.size(1440, 900);
    });
    await test("frames while a hand drags the border of the hero (a figure, no bound)", async () => {
        await page.size(1440, 900);
        await page.run("rollbem.preset('rail'); rollbem.open('hero')");
        await settled();
        const box = await page.run(
            "(() => { const b = document.querySelector('.hand.border').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()",
        );
        const drag = (type, dx) => mouse(type, box[0] + dx, box[1]);
        await drag("mousePressed", 0);
        await page.run("rollbem.views.hero.forget_frames()");
        for (let k = 0; k < 60; k++) {
            await drag("mouseMoved", 120 * Math.sin(k / 6));
            await new Promise((resolve) => setTimeout(resolve, 12));
        }
        const frames = (await page.run("rollbem.views.hero.frames()")).sort((a, b) => a - b);
        await drag("mouseReleased", 0);
        await settled();
        check(frames.length > 10, `${frames.length} frames`);
        console.log(
            `         60 elements, dragged: a frame every ${frames[frames.length >> 1].toFixed(1)} ms in the median, 95 % below ${frames[Math.floor(0.95 * frames.length)].toFixed(1)} ms; the first solved picture after ${(await page.run("performance.getEntriesByName('first-solved')[0].startTime")).toFixed(0)} ms`,
        );
    });
}
