/* Builds the page: node web/build.mjs [build/rollbem.html].  The library as WebAssembly,
 * styles and scripts go into one file that asks nothing of any network. */
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { gzipSync } from "node:zlib";
import { LARGEST, LEFT_OUT } from "./worker.js";

const CLANG = "clang-14";
const FLAGS = ["--target=wasm32-wasi", "--sysroot=/usr", "-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O3", "-msimd128",
    "-Iweb/wasm/include", "-Iinclude", "-Isrc", "-idirafter", "/usr/include"];
const EXPORTS = ["create", "free", "set", "settle", "solve", "status", "message", "option", "result", "value", "number",
    "array", "curve", "pivots", "newton", "variable", "guess", "stress"].map((name) => `rb_api_${name}`).concat("malloc", "free");
/* Scripts in the order of their use; each is an ES module for tests and editors. */
const WORKER = ["library.js", "worker.js"];
const PAGE = ["words.js", "draw.js", "state.js", "controls.js", "contact.js", "take.js", "roll.js", "below.js", "matrices.js", "step.js", "main.js"];
const LIMIT = 600e3;

function sources() {
    const words = readFileSync("web/sources", "utf8").replace(/#.*/g, "").split(/\s+/).filter(Boolean);
    const without = new Set(words.filter((word) => word.startsWith("-")).map((word) => `src/${word.slice(1)}`));
    const of = (folder) => readdirSync(folder).filter((file) => file.endsWith(".c")).map((file) => `${folder}/${file}`);
    return words.filter((word) => !word.startsWith("-")).flatMap((word) => of(`src/${word}`))
        .filter((file) => !without.has(file)).concat(of("web/wasm"));
}

/* The sketch of docs/ as a picture of its own, which the page's styles leave as it is; its title describes it. */
function picture(file) {
    const svg = readFileSync(file, "utf8"), title = /<title[^>]*>([^"<]*)<\/title>/.exec(svg)[1];
    return `<img alt="${title}" src="data:image/svg+xml;base64,${Buffer.from(svg).toString("base64")}">`;
}

function newest(folder) {
    return Math.max(...readdirSync(folder, { withFileTypes: true }).map((entry) =>
        entry.isDirectory() ? newest(`${folder}/${entry.name}`) : statSync(`${folder}/${entry.name}`).mtimeMs));
}

/* One object per source, again only where a source or a header is newer. */
function compile(folder) {
    mkdirSync(folder, { recursive: true });
    const headers = Math.max(newest("include"), newest("web/wasm/include"),
        ...readdirSync("src").flatMap((part) => readdirSync(`src/${part}`).filter((file) => file.endsWith(".h"))
            .map((file) => statSync(`src/${part}/${file}`).mtimeMs)));
    return sources().map((file) => {
        const object = `${folder}/${file.replaceAll("/", "_")}.o`;
        if (!existsSync(object) || statSync(object).mtimeMs < Math.max(headers, statSync(file).mtimeMs))
            execFileSync(CLANG, [...FLAGS, "-c", file, "-o", object], { stdio: "inherit" });
        return object;
    });
}

function link(objects, output) {
    execFileSync(CLANG, ["--target=wasm32-wasi", "--sysroot=/usr", "-mexec-model=reactor", ...objects, "-lm", "-Wl,--strip-all",
        "-Wl,-z,stack-size=1048576", ...EXPORTS.map((name) => `-Wl,--export=${name}`), "-o", output], { stdio: "inherit" });
}

/* Modules in one: their imports are of each other. */
const joined = (files) => files.map((file) => readFileSync(`web/${file}`, "utf8")
    .replace(/^import .*?;\n/gms, "").replace(/^export /gm, "")).join("\n");

const output = process.argv[2] ?? "build/rollbem.html";
if (spawnSync(CLANG, ["--version"]).status !== 0) {
    console.error(`page: no ${CLANG}; scripts/packages --install page`);
    process.exit(1);
}
const wasm = `${dirname(output)}/page/rollbem.wasm`;
link(compile(`${dirname(output)}/page/objects`), wasm);
if (!process.argv.includes("--wasm")) {
    const version = /RB_VERSION "(.*)"/.exec(readFileSync("include/rollbem/base.h", "utf8"))[1];
    const parts = {
        STYLE: readFileSync("web/style.css", "utf8"),
        WASM: gzipSync(readFileSync(wasm), { level: 9 }).toString("base64"),
        WORKER: JSON.stringify(joined(WORKER)).replaceAll("</", "<\\/"),
        SCRIPT: joined(PAGE).replaceAll("</script", "<\\/script"),
        SIGNS: picture("docs/signs.svg"),
        LIMITS: JSON.stringify({ left_out: LEFT_OUT, largest: LARGEST }),
        VERSION: version,
    };
    const page = readFileSync("web/page.html", "utf8").replace(/@([A-Z]+)@/g, (all, name) => parts[name] ?? all);
    if (page.length > LIMIT) throw new Error(`page: ${page.length} bytes, more than ${LIMIT}`);
    writeFileSync(output, page);
    console.log(`  PAGE ${output} (${Math.round(page.length / 1000)} kB)`);
}
