/* What the tests of the page share: verdicts as tests/run reads them, the library of the page, the program, and the
 * comparison of their numbers. */
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gunzipSync } from "node:zlib";
import { load_library } from "../library.js";
import { bytes_of } from "../solver.js";
import { answer } from "../worker.js";

export const build = process.argv[2] ?? "build",
    program = resolve(`${build}/rollbem`);
let passed = 0,
    failed = 0,
    half = "first";
export const wanted = process.argv[3] ?? "";

/* What `make test` runs of them. */
const SMOKE = [
    "the program's numbers: examples/carter/",
    "proofs are the program's",
    "one file of at most 800 kB",
    "the page solves and shows",
    "the command that the page shows",
];
/* Tests of one kind, which take some seconds each: continuous integration runs one of so many. */
const KINDS = {
        "every control moved: ": 4,
        "the program's numbers: ": 3,
        "every view fits ": 3,
        "no finding of axe-core ": 4,
    },
    met = {};
function is_in_turn(name) {
    const kind = Object.keys(KINDS).find((start) => name.startsWith(start)),
        turn = process.env.ROLLBEM_TEST_TURN;
    if (!kind || !turn || wanted === "smoke" || process.env.ROLLBEM_TEST_ALL) return true;
    met[kind] = (met[kind] ?? -1) + 1;
    return (met[kind] + Number(turn)) % KINDS[kind] === 0;
}

/* The tests that follow belong to this half. */
export function begin(name) {
    half = name;
}
/* ROLLBEM_TEST_ONLY: a part of the names of those that run, for one's own work. */
export async function test(name, body) {
    if (wanted === "smoke" ? !SMOKE.some((start) => name.startsWith(start)) : wanted && half !== wanted) return;
    if (!name.includes(process.env.ROLLBEM_TEST_ONLY ?? "")) return;
    if (!is_in_turn(name)) return;
    const start = performance.now();
    try {
        await body();
        passed++;
        console.log(`[       OK ] ${name} (${Math.round(performance.now() - start)} ms)`);
    } catch (error) {
        failed++;
        console.log(`[  FAILED  ] ${name}: ${error.message}`);
    }
}
export function check(holds, text) {
    if (!holds) throw new Error(text);
}
export function check_close(got, want, tol, what) {
    if (!Number.isFinite(want)) return check(!Number.isFinite(got), `${what}: got ${got}, the program has none`);
    check(
        Math.abs(got - want) <= tol,
        `${what}: got ${got}, want ${want}, difference ${Math.abs(got - want)} > ${tol}`,
    );
}

export const file = resolve(`${build}/rollbem.html`),
    url = pathToFileURL(file).href,
    text_of_page = readFileSync(file, "utf8");
export const library = await load_library(gunzipSync(bytes_of(/^const WASM = "(.*)";$/m.exec(text_of_page)[1])));
export const given_of = (ini) =>
    Object.fromEntries(
        readFileSync(ini, "utf8")
            .split("\n")
            .map((line) => /^([\w-]+)\s*=\s*([^;]*)/.exec(line))
            .filter(Boolean)
            .map(([, name, text]) => [name, text.trim()]),
    );
export const words_of = (given) =>
    Object.entries(given).flatMap(([name, text]) =>
        library.options.find((o) => o.name === name)?.kind === "flag" ? [`--${name}`] : [`--${name}`, text],
    );
export const run = (args, cwd) =>
    spawnSync(program, args, { cwd, encoding: "utf8", env: { ...process.env, OPENBLAS_NUM_THREADS: "1" } });

/* Every number that is no count of work, time or rounding, and p and q of every element. */
const LEFT_OUT = [
    "iterations",
    "residual",
    "residual_gap",
    "residual_slip",
    "residual_friction",
    "load_error",
    "support_balance",
    "slip_violations",
];
export function flatten(json) {
    const all = {};
    for (const [name, value] of Object.entries(json)) {
        if (value && typeof value === "object" && !Array.isArray(value))
            for (const [inner, v] of Object.entries(flatten(value))) all[inner] ??= v;
        else all[name] ??= value;
    }
    return all;
}
export function compare(given, tol, files = {}) {
    const folder = mkdtempSync(join(tmpdir(), "page-"));
    for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
    const got = answer(library, { kind: "roll", given, files }),
        ran = run(["--json", "--quiet", ...words_of(given)], folder);
    rmSync(folder, { recursive: true });
    check(!got.refused, got.refused);
    const want = flatten({ ...JSON.parse(ran.stdout), inputs: null });
    let compared = 0;
    for (const { name, kind, unit } of library.results.number) {
        if (kind === "seconds" || LEFT_OUT.includes(name) || !(name in want)) continue;
        const scale =
            unit === "N"
                ? want.normal_load * want.half_width
                : unit === "N/mm"
                  ? want.normal_load
                  : /ratio/.test(name)
                    ? 1
                    : /creepage/.test(name)
                      ? 1e-3
                      : /half_width|stick_|contact_(from|to)/.test(name)
                        ? want.half_width
                        : /shift/.test(name)
                          ? Math.abs(want.approach)
                          : 0;
        check_close(got.numbers[name], want[name] ?? NaN, tol * Math.max(Math.abs(want[name]), scale), name);
        compared++;
    }
    check(compared > 12, `only ${compared} numbers compared`);
    for (const name of ["p", "q"])
        want[`${name}_MPa`].forEach((v, i) =>
            check_close(got.columns[name][i], v, tol * got.numbers.max_pressure, `${name}, row ${i + 1}`),
        );
    return got;
}

/* By how much results on fitted elements may differ: these are fitted until the edges move less than
 * a bound, and depend on where the search began. */
export const FITTED = 1e-6;
export const rail = {
    support: "halfplane",
    "support-b": "halfplane",
    similar: "yes",
    formulation: "steady",
    radius: "460",
    young: "210000",
    poisson: "0.3",
    mesh: "uniform",
};
export const solve = (given) => answer(library, { kind: "solve", given });
/* The number of failed tests, said with that of the others. */
export function told() {
    console.log(`page: ${passed} passed, ${failed} failed`);
    return failed;
}
