/* Puts the page together: node web/build.mjs PAGE WASM.  The library as WebAssembly (the Makefile
 * compiles it), styles and scripts go into one file that asks nothing of any network. */
import { readFileSync, writeFileSync } from "node:fs";
import { Script } from "node:vm";
import { gzipSync } from "node:zlib";
import { DIGITS } from "./solver.js";
import { LARGEST, LEFT_OUT } from "./worker.js";

/* Scripts in the order of their use; each is an ES module for tests and editors. */
const WORKER = ["library.js", "worker.js"];
const PAGE = [
    "words.js",
    "draw.js",
    "state.js",
    "store.js",
    "solver.js",
    "knob.js",
    "pen.js",
    "lens.js",
    "matters.js",
    "proof.js",
    "contact.js",
    "take.js",
    "controls.js",
    "bench.js",
    "hero.js",
    "chapters.js",
    "roll.js",
    "below.js",
    "matrices.js",
    "step.js",
    "crack.js",
    "classroom.js",
    "main.js",
];
const LIMIT = 800e3;

/* The sketch of docs/ as a picture of its own, which the page's styles leave as it is; its title describes it. */
function picture(file) {
    const svg = readFileSync(file, "utf8"),
        title = /<title[^>]*>([^"<]*)<\/title>/.exec(svg)[1];
    return `<img alt="${title}" src="data:image/svg+xml;base64,${Buffer.from(svg).toString("base64")}">`;
}

/* Bytes as text: four of them are five characters of 85, one quarter more where base64 takes one third.  The first
 * character says how many bytes of the last four are none. */
function text_of_bytes(bytes) {
    const none = (4 - (bytes.length % 4)) % 4,
        padded = Buffer.concat([bytes, Buffer.alloc(none)]),
        parts = [String(none)];
    for (let k = 0; k < padded.length; k += 4) {
        let value = padded.readUInt32BE(k),
            five = "";
        for (let j = 0; j < 5; j++, value = Math.floor(value / 85)) five = DIGITS[value % 85] + five;
        parts.push(five);
    }
    return parts.join("");
}

/* Modules in one: their imports are of each other.  Lines without their indentation, which is a fifth of the page,
 * and without comments, which are for readers of the sources. */
const joined = (files) =>
    files
        .map((file) =>
            readFileSync(`web/${file}`, "utf8")
                .replace(/^import .*?;\n/gms, "")
                .replace(/^export /gm, "")
                .replace(/^ +/gm, "")
                .replace(/^\/\*[\s\S]*?\*\/\n/gm, ""),
        )
        .join("\n");

const [output, wasm] = process.argv.slice(2);
const parts = {
    STYLE: readFileSync("web/style.css", "utf8").replace(/^ +/gm, ""),
    WASM: text_of_bytes(gzipSync(readFileSync(wasm), { level: 9 })),
    WORKER: JSON.stringify(joined(WORKER)).replaceAll("</", "<\\/"),
    SCRIPT: joined(PAGE).replaceAll("</script", "<\\/script"),
    SIGNS: picture("docs/signs.svg"),
    LIMITS: JSON.stringify({ left_out: LEFT_OUT, largest: LARGEST }),
    VERSION: /RB_VERSION "(.*)"/.exec(readFileSync("include/rollbem/base.h", "utf8"))[1],
};
for (const script of [parts.SCRIPT, joined(WORKER)]) new Script(script); /* two modules with one name, and the like */
const page = readFileSync("web/page.html", "utf8").replace(/@([A-Z]+)@/g, (all, name) => parts[name] ?? all);
if (page.length > LIMIT) throw new Error(`page: ${page.length} bytes, more than ${LIMIT}`);
writeFileSync(output, page);
console.log(`  PAGE ${output} (${Math.round(page.length / 1000)} kB)`);
