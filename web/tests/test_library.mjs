/* The library as WebAssembly answers as the program does, and reads what the program reads. */
import { readdirSync } from "node:fs";
import { check, check_close, compare, FITTED, given_of, library, rail, run, test, words_of } from "./suite.mjs";
import { bounds_of } from "../contact.js";
import { ticks, zone_colours } from "../draw.js";
import { read_case_file, read_link, table_of_drawn, write_link } from "../state.js";
import { EXAMPLES, sentence_of, tie_of } from "../step.js";
import { words } from "../words.js";
import { answer } from "../worker.js";

export async function test_library() {
    for (const { name: folder } of readdirSync("examples", { withFileTypes: true }).filter((e) => e.isDirectory()))
        for (const file of readdirSync(`examples/${folder}`, { recursive: true }).filter((f) => f.endsWith(".ini"))) {
            const given = given_of(`examples/${folder}/${file}`),
                named = ["history", "irregularity", "accuracy", "error"].filter(
                    (name) => name in given && given[name] !== "no",
                );
            if (named.length || /[/.]/.test(given.gap ?? "")) {
                console.log(`  left   examples/${folder}/${file}: ${named} is not in the page`);
                continue;
            }
            const fitted = given.mesh === "fitted" || (given.formulation === "steady" && !given.mesh && !given.zone);
            await test(`the program's numbers: examples/${folder}/${file}`, () =>
                compare(given, fitted ? FITTED : 1e-9));
        }
    for (const more of [
        { load: "1000", mu: "0.3", "creep-ratio": "0.5" },
        { load: "1000", mu: "0.3", "force-ratio": "-0.9" },
        { approach: "0.03", mu: "0.1", creep: "0.0004", zone: "3" },
        { "half-width": "2", mu: "0.5", "creep-ratio": "-0.7" },
        { load: "1000", mu: "0.3", formulation: "static", "force-ratio": "0.5" },
        { support: "hub", load: "1000", mu: "0.3", "creep-ratio": "0.3", "contact-elements": "20" },
        { approach: "0.03", mu: "0.1", creep: "0.0004" },
        {
            formulation: "transient",
            load: "1000",
            mu: "0.3",
            "creep-ratio": "0.5",
            distance: "2",
            "contact-elements": "24",
        },
    ])
        await test(`the program's numbers: ${JSON.stringify(more)}`, () => compare({ ...rail, ...more }, 1e-9));

    /* Where the program would use transforms, which the page has not, both take the same elements. */
    await test("the program's numbers: 198 elements on a mesh of the library's choice", () => {
        const { mesh, ...free } = rail;
        compare(
            { ...free, load: "12500", mu: "0.3", young: "169000", "creep-ratio": "0.5", "contact-elements": "198" },
            FITTED,
        );
    });

    /* What slips or yields has its friction at the bound that is drawn, and every zone of the table a colour and its words. */
    for (const more of [
        { "yield-stress": "60", hardening: "100000" },
        { "yield-stress": "100", hardening: "-1000" },
        { "mu-fall": "0.1", "friction-law": "exponential", "slip-scale": "500", speed: "45000" },
    ])
        await test(`bounds and zones: ${JSON.stringify(more)}`, () => {
            const got = compare({ ...rail, load: "12500", mu: "0.3", "creep-ratio": "0.8", ...more }, 1e-8),
                { q, zone } = got.columns,
                bounds = bounds_of(got);
            check(
                [...zone].some((z) => z === ("yield-stress" in more ? 4 : 2)),
                "no such zone",
            );
            bounds.forEach((bound, i) =>
                zone[i] > 1
                    ? check_close(Math.abs(q[i]), bound, 1e-8 * got.numbers.max_pressure, `bound, row ${i + 1}`)
                    : check(Math.abs(q[i]) <= bound + 1e-9 * got.numbers.max_pressure, `row ${i + 1} beyond its bound`),
            );
            for (const list of [zone_colours, words.zones, words.zones_signs, words.zones_short])
                check(list.length > Math.max(...zone), "a zone without a name");
        });
    const drawn = [
        { what: "mu", values: [0.3, 0.1, 0.4] },
        { what: "load", values: [1000, 1500, 600] },
        { what: "force_ratio", values: [0, -0.5, 0.5, 0] },
        { what: "creep_ratio", values: [0, 0.8, -0.4] },
    ];
    for (const { what, values } of drawn)
        await test(`the program's numbers: ${what} drawn by hand`, () => {
            const { load, mu, ...rest } = {
                ...rail,
                load: "1000",
                mu: "0.3",
                formulation: "transient",
                "contact-elements": "24",
                history: "drawn.tsv",
            };
            compare(
                {
                    ...rest,
                    ...(what === "load" || what === "mu" ? { "creep-ratio": "0.5" } : {}),
                    ...(what === "load" ? {} : { load }),
                    ...(what === "mu" ? {} : { mu }),
                },
                1e-9,
                { "drawn.tsv": table_of_drawn({ what, distance: 2, values }) },
            );
        });
    await test("a file that is not there, and one that is no table", () => {
        const given = { ...rail, load: "1000", mu: "0.3", formulation: "transient", history: "drawn.tsv" };
        check(/drawn.tsv/.test(answer(library, { kind: "roll", given }).refused), "no file, no word");
        check(
            /drawn.tsv:2/.test(
                answer(library, { kind: "roll", given, files: { "drawn.tsv": "distance load\n0 <b>\n" } }).refused,
            ),
            "the line is not named",
        );
    });
    await test("links and case files are read as they are written", () => {
        const state = {
            given: { mu: "0.3", "creep-ratio": "0.5" },
            view: "roll",
            drawn: { what: "load", distance: 5, values: [1, 2.5] },
        };
        check(
            JSON.stringify(read_link(write_link(state.given, state.view, state.drawn), ["hero", "roll"])) ===
                JSON.stringify({ given: state.given, view: "roll", drawn: state.drawn, embed: false, lesson: false }),
            "the link",
        );
        check(
            JSON.stringify(read_case_file("[friction]\r\nmu = 0.3 ; a comment\n# another\n\ncreep-ratio: 0.5\n")) ===
                JSON.stringify(state.given),
            "the file",
        );
        for (const text of ["", "mu", "mu = 1\nmu = 2", "x".repeat(30000), "\u0000\u0001"]) {
            let said = "";
            try {
                read_case_file(text);
            } catch (error) {
                said = error.message;
            }
            check(said, `${JSON.stringify(text.slice(0, 20))} is taken for a case`);
        }
    });
    await test("no element of an example is said to be pressed whose pressure stays zero", () => {
        for (const [name, given] of Object.entries(EXAMPLES)) {
            const a = answer(library, {
                kind: "pivots",
                slot: `pivots ${name}`,
                given: { ...given, mesh: "uniform", solver: "lemke", "lcp-form": "pivoted" },
            });
            const n = a["pivot.p"].rows,
                most = Math.max(...a["pivot.p"].at);
            for (let k = 0; k < a["pivot.z0"].columns; k++) {
                const pressed = /^Element (\d+) is pressed/.exec(sentence_of(words, a, k))?.[1];
                if (pressed)
                    check(a["pivot.p"].at[n * k + Number(pressed) - 1] > 1e-9 * most, `${name}, pivot ${k + 1}`);
                check(name !== "untied" || tie_of(a, k).tied.length === 0, `${name}: a tie in pivot ${k + 1}`);
            }
        }
    });
    await test("every axis has two numbers at least", () => {
        for (let width = 0.1; width < 100; width *= 1.07)
            for (const [from, to] of [
                [0, width],
                [-width / 2, width / 2],
                [-width / 3, width],
            ])
                for (const about of [3, 4, 5])
                    check(ticks(from, to, about).length >= 2, `${from} to ${to}: ${ticks(from, to, about)}`);
    });
    for (const given of [
        { mu: "-1" },
        { mu: "x" },
        { "contact-elements": "2" },
        { support: "wall" },
        { load: "1", approach: "1" },
        { formulation: "steady" },
        { poisson: "0.7" },
        { creep: "1e400" },
        { support: "halfplane", "hub-ratio": "0.4" },
        { formulation: "steady", shift: "1" },
        { similar: "yes", "young-b": "3" },
    ])
        await test(`the program's refusal: ${JSON.stringify(given)}`, () => {
            const ran = run(["--quiet", ...words_of(given)]),
                got = answer(library, { kind: "solve", given });
            if (ran.status === 0) return check(!got.refused, `the program solves it, the page says: ${got.refused}`);
            check(got.refused, "the page solves it");
            check(ran.stderr.includes(got.refused), `got '${got.refused}', the program says '${ran.stderr.trim()}'`);
        });
    await test("the program's numbers: a wheel that relaxes", () => {
        const given = {
            support: "hub",
            load: "100",
            formulation: "steady",
            "creep-ratio": "0.3",
            "relaxation-time": "0.01",
            "relaxation-ratio": "1",
            speed: "100",
        };
        const got = answer(library, { kind: "solve", given }).numbers;
        const want = JSON.parse(run(["--json", "--quiet", ...words_of(given)]).stdout).summary;
        for (const name of ["tangential_load", "max_pressure", "resistance_moment", "hysteresis", "creepage"])
            check_close(got[name], want[name], 1e-9 * Math.abs(want[name]), name);
    });
    await test("a size that the page does not take", () =>
        check(
            /use the program/.test(answer(library, { kind: "solve", given: { "contact-elements": "5000" } }).refused),
            "it is solved",
        ));
}
