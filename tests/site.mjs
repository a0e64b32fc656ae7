/* The site in Chromium, as readers open it: on a telephone and on a desk, nothing fetched from
 * elsewhere, no error, menu, search and formulas at work.  usage: node tests/site.mjs SITE [PICTURES] */
import { createServer } from "node:http";
import { existsSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { close_browser, open_page } from "../web/chromium.mjs";

const [site, pictures] = process.argv.slice(2);
const KINDS = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".json": "application/json" };
const server = createServer((request, response) => {
    const file = join(site, normalize(decodeURIComponent(new URL(request.url, "http://site").pathname)));
    if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": KINDS[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const home = `http://127.0.0.1:${server.address().port}`;

let failed = 0;
async function check(name, steps, url, options) {
    const page = await open_page(`${home}/${url}`, options);
    try {
        await page.until("document.readyState === 'complete'");
        await steps(page);
        const foreign = page.requested.filter((at) => !at.startsWith(home) && !/^(data|blob|about):/.test(at));
        if (foreign.length) throw new Error(`fetched from elsewhere: ${foreign[0]}`);
        if (page.errors.length) throw new Error(`console: ${page.errors[0]}`);
        console.log(`[       OK ] ${name}`);
    } catch (error) {
        console.log(`[  FAILED  ] ${name}: ${error.message}`);
        failed = 1;
    }
    if (pictures) writeFileSync(join(pictures, `${name.replaceAll(/\W+/g, "-")}.png`), await page.picture(false));
    await page.close();
}

const holds = async (page, expression) => {
    if (!(await page.run(expression))) throw new Error(`does not hold: ${expression}`);
};
const NO_OVERFLOW = "document.documentElement.scrollWidth <= document.documentElement.clientWidth";
const HERO = "document.querySelector('iframe.hero').contentDocument";

await check(
    "headline, wheel and three doors in one window of 1280 x 720",
    async (page) => {
        await page.until(`${HERO} && !/Loading/.test(${HERO}.body.innerText) && ${HERO}.querySelector('canvas')`, 60);
        await holds(page, "[...document.querySelectorAll('.hero, .cards > div')].every((part) => part.getBoundingClientRect().bottom <= innerHeight)");
        await holds(page, "document.querySelectorAll('h1').length === 1");
        await holds(page, `[...${HERO}.querySelectorAll('h1')].every((h) => h.getBoundingClientRect().height === 0)`);
    },
    "index.html",
    { width: 1280, height: 720 },
);
for (const [width, height, mobile] of [
    [390, 844, true],
    [1440, 900, false],
]) {
    await check(
        `the landing page rolls at ${width} px`,
        async (page) => {
            await page.until(`${HERO} && !/Loading/.test(${HERO}.body.innerText) && ${HERO}.querySelector('svg, canvas')`, 60);
            await holds(page, "document.querySelectorAll('.cards > div').length === 3");
            await holds(page, NO_OVERFLOW);
        },
        "index.html",
        { width, height, mobile },
    );
    await check(
        `search finds an option at ${width} px`,
        async (page) => {
            /* what is typed before the search is ready may be lost for good */
            await page.until("/Type to start/.test(document.querySelector('.md-search-result__meta').textContent)");
            await page.run(`{ document.querySelector('label[for=__search]').click();
                const box = document.querySelector('.md-search__input'); box.focus(); box.value = 'contact-elements';
                box.dispatchEvent(new KeyboardEvent('keyup', { bubbles: true })); box.dispatchEvent(new Event('input', { bubbles: true })) }`);
            await page.until("document.querySelectorAll('.md-search-result__item').length > 0");
        },
        "getting-started.html",
        { width, height, mobile },
    );
}
await check(
    "the menu of a telephone opens",
    async (page) => {
        await page.run("document.querySelector('label.md-header__button[for=__drawer]').click()");
        await page.until("document.querySelector('.md-nav--primary').getBoundingClientRect().left >= 0");
        await holds(page, "[...document.querySelectorAll('.md-nav--primary label, .md-nav--primary a')].some((a) => a.innerText.includes('Course'))");
    },
    "faq.html",
    { width: 390, height: 844, mobile: true },
);
await check(
    "formulas are typeset, in the dark too",
    async (page) => {
        await holds(page, "document.querySelectorAll('.katex-display').length > 10");
        await holds(page, "document.querySelector('.katex-html .mfrac').getBoundingClientRect().height > 15");
        await page.until("document.fonts.check('16px KaTeX_Main')");
        await page.run("document.getElementById('3-boundary-elements').scrollIntoView()");
        await holds(page, NO_OVERFLOW);
    },
    "theory.html",
    { width: 1440, height: 1400, dark: true },
);
await check(
    "course pictures are there",
    async (page) => holds(page, "document.images.length > 0 && [...document.images].every((image) => image.complete && image.naturalWidth > 0)"),
    "course/06-rolling.html",
    { width: 1440, height: 900 },
);
await close_browser();
server.close();
process.exit(failed);
