/* Typesets the ```math blocks of Markdown files by Debian's KaTeX: no script runs in the browser.
 *  usage: node tools/scripts/site-math.mjs FILE.md... */
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";

const katex = createRequire(import.meta.url)("/usr/share/nodejs/katex/dist/katex.js");

for (const file of process.argv.slice(2)) {
    const text = readFileSync(file, "utf8");
    const typeset = text.replace(/^```math\n([\s\S]*?)^```$/gm, (_, tex) => {
        const html = katex.renderToString(tex, { displayMode: true, throwOnError: true });
        return `<div class="math">${html.replaceAll("\n", " ")}</div>`;
    });
    if (typeset !== text) writeFileSync(file, typeset);
}
