/* A file per chapter of the page: its title, sentence and picture are what a link to it shows where it is posted; opened
 * it goes on to the page, with what the link holds behind #.  usage: node tools/scripts/site-lessons.mjs PAGE FOLDER
 * [SITE], with the address of the site, since a picture of a preview needs a whole one; pictures where Chromium is. */
import { mkdirSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { CHROMIUM, close_browser, open_page } from "../../web/chromium.mjs";
import { words } from "../../web/words.js";

const [file, folder, site = ""] = process.argv.slice(2);
const SIZE = { width: 1200, height: 630 }; /* what previews are cut to */
const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

mkdirSync(folder, { recursive: true });
const page = CHROMIUM && (await open_page(pathToFileURL(resolve(file)).href, SIZE));
if (page) await page.until("window.rollbem?.idle()", 120);
for (const [name, { title, join }] of Object.entries(words.chapters)) {
    if (page) {
        await page.run(`rollbem.open("${name}")`);
        await page.until("rollbem.idle()", 120);
        writeFileSync(`${folder}/${name}.png`, await page.picture(false));
    }
    const about = join ?? words.hero.lead,
        tags = { "og:type": "website", "og:site_name": "rollbem", "og:title": title, "og:description": about };
    if (page && site) tags["og:image"] = `${site.replace(/\/$/, "")}/lessons/${name}.png`;
    const lines = [
        "<!doctype html>",
        `<html lang="en"><head><meta charset="utf-8"><title>rollbem: ${escaped(title)}</title>`,
        `<meta name="description" content="${escaped(about)}">`,
        ...Object.entries(tags).map(([tag, text]) => `<meta property="${tag}" content="${escaped(text)}">`),
        '<meta name="twitter:card" content="summary_large_image">',
        `<script>location.replace("../rollbem.html" + (location.hash.length > 1 ? location.hash : "#at-${name}"))</script>`,
        `</head><body><p><a href="../rollbem.html#at-${name}">${escaped(title)}</a></p></body></html>`,
    ];
    writeFileSync(`${folder}/${name}.html`, `${lines.join("\n")}\n`);
}
if (page) await close_browser();
