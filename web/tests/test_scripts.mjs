/* The scripts of the page without a browser: what they make of the library's answers. */
import { existsSync } from "node:fs";
import { check, check_close, FITTED, library, run, solve, test, text_of_page, words_of } from "./suite.mjs";
import { axes_of, axes_still_fit, tidy_number } from "../contact.js";
import { value_to_hold, with_motion } from "../controls.js";
import { at_the_mouth, CRACK_CASE, crack_request, faces_at } from "../crack.js";
import { headline_of, slip_share } from "../hero.js";
import { fit_lens, offsets_of } from "../lens.js";
import { change_along, effects, kinks_of, told_change } from "../matters.js";
import { proof_in_words } from "../proof.js";
import { ground_of, PRESETS, share_of_ground, with_ground, with_mu, with_point, with_support } from "../state.js";
import { LESSONS, PAGES } from "../take.js";
import { words } from "../words.js";
import { answer } from "../worker.js";

export async function test_scripts() {
    await test("headlines follow the state", () => {
        const of = (more) => {
            const { "creep-ratio": creep, ...still } = PRESETS.rail,
                given = { ...still, ...(more.formulation !== "static" && { "creep-ratio": creep }), ...more },
                got = solve(given);
            return headline_of(words, got.refused ? null : got, got.refused, given);
        };
        for (const [more, kind, text] of [
            [{}, "partial", "Half of this contact is slipping, and the wheel still rolls."],
            [{ "creep-ratio": "0" }, "free", "It rolls freely. Nothing slips."],
            [{ "creep-ratio": "0.08" }, "touch", "A touch on the brake: 8 % of the contact slips."],
            [{ "creep-ratio": "0.95" }, "nearly", "One more push and it skids."],
            [{ "creep-ratio": "1.2" }, "skid", "Now it skids."],
            [{ "creep-ratio": "-1.2" }, "skid", "Now it spins."],
            [{ "creep-ratio": "-0.5" }, "partial", "Accelerating: half of this contact"],
            [{ formulation: "static", "force-ratio": "-0.76" }, "rest", "It stands, and "],
            [{ formulation: "static", mu: "0" }, "smooth", "It stands. Without"],
            [{ load: "-1" }, "unsolved", "No solution here: --load"],
            [{ "creep-ratio": "0.25" }, "partial", "A quarter of this contact"],
        ]) {
            const got = of(more);
            check(got.kind === kind && got.text.includes(text), `${JSON.stringify(more)}: ${got.kind}, ${got.text}`);
        }
    });
    await test("the lines of the lens: slip is the sum of shift, and where it sticks there is none", () => {
        const got = solve(PRESETS.rail),
            { slip_at, strain_at, slip_end } = offsets_of(got),
            n = got.numbers;
        check(slip_at(n.contact_to) === 0 && slip_at(n.stick_from + 0.1) === 0, "it slips where it sticks");
        check_close(slip_at(n.contact_from), slip_end, 1e-12, "slip at the trailing edge");
        check_close(slip_share(got), 0.5, 1e-3, "half of it slips");
        /* creepage times way is slip and strain together; the strain of both ends of the stick strip is that of the creepage */
        check_close(
            strain_at(n.stick_from + 1e-9),
            n.creepage * (n.contact_to - n.stick_from),
            1e-6,
            "strain where slip begins",
        );
        check(
            Math.abs(slip_at(n.contact_from) / slip_at((n.contact_from + n.stick_from) / 2)) > 1.5,
            "slip does not grow",
        );
        const fit = fit_lens(got);
        check(
            fit.window[0] < n.contact_from && fit.window[1] > n.contact_to && fit.press > n.max_pressure,
            JSON.stringify(fit),
        );
    });
    await test("another quantity that is held takes over at its value, also at zero", () => {
        const free = solve({ ...PRESETS.rail, "creep-ratio": "0" }).numbers,
            half = solve(PRESETS.rail).numbers;
        for (const name of ["creep", "force", "force-ratio", "creep-ratio"])
            check(value_to_hold(name, free) === "0", `${name}: ${value_to_hold(name, free)}`);
        for (const formulation of ["static", "steady"]) {
            let given = { ...PRESETS.rail };
            for (const to of [formulation, "static", "steady"]) given = with_motion(given, to, solve(given).numbers);
            check_close(
                solve(given).numbers.force_ratio,
                half.force_ratio,
                1e-5,
                "friction, from rolling to rest and back",
            );
        }
    });
    await test("another support drops what has no meaning there, from everywhere to everywhere", () => {
        for (const [name, preset] of Object.entries(PRESETS))
            for (const first of ["arc", "hub", "halfplane"])
                for (const second of ["arc", "hub", "halfplane"]) {
                    const got = solve(
                        with_support(with_support({ ...preset, "contact-elements": "8" }, first), second),
                    );
                    check(!got.refused, `${name}, ${first}, ${second}: ${got.refused}`);
                }
    });
    await test("without friction the drive becomes a creepage", () => {
        for (const [name, preset] of Object.entries(PRESETS)) {
            const given = with_mu(
                    { ...preset, "contact-elements": "8" },
                    0,
                    solve({ ...preset, "contact-elements": "8" }).numbers,
                ),
                got = solve(given);
            check(!got.refused, `${name}: ${got.refused}`);
        }
    });
    await test("three grounds, and what of the approach each takes", () => {
        const other = { ...PRESETS.rail, similar: undefined, "young-b": "70000", "poisson-b": "0.33" };
        delete other.similar;
        const got = solve(other);
        check(
            !got.refused &&
                ground_of(other) === "other" &&
                ground_of(PRESETS.rail) === "similar" &&
                ground_of(PRESETS.stiff) === "rigid",
            `${got.refused}`,
        );
        check_close(share_of_ground(other, got.values), 0.745, 2e-3, "the softer ground's share");
        for (const [name, preset] of Object.entries(PRESETS))
            for (const first of ["rigid", "similar", "other"])
                for (const then of ["rigid", "similar", "other"]) {
                    const given = with_ground(with_ground({ ...preset, "contact-elements": "8" }, first), then),
                        { refused } = solve(given);
                    check(!refused && ground_of(given) === then, `${name}, ${first}, ${then}: ${refused}`);
                }
    });
    await test("numbers of German and French keyboards", () => {
        for (const [text, want] of [
            ["0,3", "0.3"],
            ["210GPa", "210GPa"],
            ["2,1e5", "2.1e5"],
            ["0.3,0.2", "0.3,0.2"],
            ["-0,5", "-0.5"],
            ["12,5 kN/mm", "12.5 kN/mm"],
        ])
            check(with_point(text) === want, `${text}: ${with_point(text)}`);
    });
    await test("rounding of zero is zero", () => {
        check(
            tidy_number("tangential_load", { tangential_load: 2.57e-16, normal_load: 1000 }) === 0,
            "a friction force of 2.57e-16",
        );
        check(
            tidy_number("tangential_load", { tangential_load: 1e-3, normal_load: 1000 }) === 1e-3,
            "a friction force of 1e-3",
        );
    });
    await test("axes stay where they still fit", () => {
        const before = solve(PRESETS.rail),
            axes = axes_of(before);
        for (const [more, fits] of [
            [{ "creep-ratio": "1" }, true],
            [{ load: "11000" }, true],
            [{ load: "50000" }, false],
            [{ load: "100" }, false],
        ])
            check(axes_still_fit(axes, solve({ ...PRESETS.rail, ...more })) === fits, JSON.stringify(more));
    });
    await test("the largest stress is the library's, not the grid's", () => {
        const got = answer(library, { kind: "stress", given: PRESETS.rail, nx: 5, ny: 4, depth: 0, maxima: true }),
            want = JSON.parse(run(["stress", "--json", "--quiet", ...words_of(PRESETS.rail)]).stdout).maxima;
        const value = JSON.stringify(want.max_shear)
            .match(/[\d.e+-]+/g)
            .map(Number);
        check(
            value.some((v) => Math.abs(v / got["maxima.max_shear"].at[0] - 1) < FITTED),
            `${got["maxima.max_shear"].at[0]}, the program has ${JSON.stringify(want.max_shear)}`,
        );
    });
    await test("a pass over a crack is the program's, dry and with water", () => {
        for (const more of [{}, { fluid: "trapped", "crack-angle": "60" }]) {
            const { coarse, ...request } = crack_request({ ...CRACK_CASE, ...more }, false),
                got = answer(library, request),
                want = JSON.parse(
                    run(["crack", "--json", "--quiet", ...words_of(request.given), ...words_of(request.crack)]).stdout,
                );
            check(!got.refused && !coarse, got.refused);
            const most = Math.max(want.summary.K_I_max, want.summary.K_II_max);
            for (const name of Object.keys(got.summary))
                check_close(got.summary[name], want.summary[name], 1e-5 * most, `${name} ${JSON.stringify(more)}`);
            for (const name of ["K_I", "K_II"])
                want.table[name].forEach((v, k) =>
                    check_close(got[`crack.${name}`].at[k], v, 1e-5 * most, `${name}, position ${k}`),
                );
            /* Open faces are apart, closed ones touch, and the last node opens as K_I says. */
            const k = got["crack.K_I"].at.reduce((best, v, i, all) => (v > all[best] ? i : best), 0),
                faces = faces_at(got, k);
            check(
                faces.open.at(-1) > 0 && [...faces.open].every((v, j) => v >= 0 && (faces.zone[j] === 0 || v < 1e-9)),
                "faces",
            );
        }
        const { kind, K_I, K_II } = at_the_mouth(answer(library, crack_request(CRACK_CASE, true)));
        check(kind === "slides" && K_I < 1 && K_II > 500, `${kind}: ${K_I}, ${K_II}`);
    });
    await test("a crack that the library refuses is refused with its line", () => {
        const got = answer(library, crack_request({ ...CRACK_CASE, "crack-angle": "180" }, true));
        check(/^--crack-angle: expected more than 0 and less than 180/.test(got.refused), got.refused);
    });
    await test("which input matters: the derivatives are differences of the library's own solutions", () => {
        const given = { ...PRESETS.rail, mesh: "uniform", zone: "12" },
            got = answer(library, { kind: "derivatives", given }),
            names = got.inputs.map(({ name }) => name),
            value = (name) => got["derivative.value"].at[names.indexOf(name)];
        for (const result of ["max_pressure", "tangential_load"]) {
            const list = effects(
                names,
                got["derivative.value"].at,
                got[`derivative.${result}`].at,
                got.numbers[result],
            );
            for (const name of ["load", "young", "radius", "mu", "creep-ratio"]) {
                const at = (part) =>
                        solve({ ...given, [name]: String(value(name) * (1 + part)) }).numbers[result] /
                        Math.abs(got.numbers[result]),
                    want = (at(1e-5) - at(-1e-5)) / 2e-3,
                    have = list.find((row) => row.name === name)?.more ?? 0;
                check_close(have, want, 1e-6, `${result} by ${name}`);
            }
            check(
                list.every((row, k) => !k || Math.abs(row.more) <= Math.abs(list[k - 1].more) + 1e-12),
                `${result}: not sorted`,
            );
        }
        /* It skids: friction follows the load and mu alone, by as many percent. */
        const slides = answer(library, { kind: "derivatives", given: { ...given, "creep-ratio": "3" } }),
            list = effects(
                slides.inputs.map(({ name }) => name),
                slides["derivative.value"].at,
                slides["derivative.tangential_load"].at,
                slides.numbers.tangential_load,
            );
        check(
            list.length === 2 &&
                list.every(({ name, more }) => ["mu", "load"].includes(name) && Math.abs(more + 0.01) < 1e-9),
            JSON.stringify(list),
        );
    });
    await test("an input at the end of its range: what one percent less changes is told as that", () => {
        const given = { support: "halfplane", load: "500", poisson: "0.5", "contact-elements": "20" },
            got = answer(library, { kind: "derivatives", given }),
            list = effects(
                got.inputs.map(({ name }) => name),
                got["derivative.value"].at,
                got["derivative.max_pressure"].at,
                got.numbers.max_pressure,
            ),
            poisson = list.find(({ name }) => name === "poisson"),
            told = told_change(poisson),
            less = 1e3 * (solve({ ...given, poisson: "0.499995" }).numbers.max_pressure / got.numbers.max_pressure - 1);
        check(told.falls && told.change < 0, JSON.stringify(poisson));
        check_close(told.change, less, 1e-3 * Math.abs(less), "1 % less of poisson");
        check(!told_change(list.find(({ name }) => name === "young")).falls, "young can grow");
        check(!kinks_of(list, 0.01).some(({ name }) => name === "poisson"), "one slope is no kink");
        check(kinks_of([{ name: "mu", less: 0.001, more: 0.001 }], 0.01).length === 1, "two slopes are");
    });
    await test("changes along the contact and standard deviations are the program's", () => {
        const given = { ...PRESETS.rail, "interlayer-tangential": "0" },
            ask = (tolerance) => answer(library, { kind: "derivatives", given, tolerance }),
            got = ask("mu=10%,radius=4.6"),
            want = JSON.parse(
                run(["--json", "--quiet", "--derivatives=p,q", "--tolerance=mu=10%,radius=4.6", ...words_of(given)])
                    .stdout,
            );
        check(got.elements === want.derivatives_are.split(";")[0], got.elements);
        for (const name of ["load", "mu", "interlayer-tangential"]) {
            const k = got.inputs.findIndex((one) => one.name === name);
            for (const column of ["p", "q"]) {
                const along = change_along(got[`derivative.${column}`].at, got.x.length, k, 100),
                    rows = want.derivatives[column][name],
                    sides = Array.isArray(rows[0] ?? rows[1]) ? rows[1] : rows /* it can only grow */,
                    most = Math.max(...sides.map(Math.abs)) || 1;
                sides.forEach((v, i) => check_close(along[i], v, 1e-5 * most, `${column} by ${name}, element ${i}`));
            }
        }
        check(Object.keys(want.tolerances).length > 5 && want.tolerances.tangential_load > 0, "no tolerances");
        for (const [name, v] of Object.entries(want.tolerances))
            check_close(got.deviations[name], v, 1e-5 * Math.abs(v) + 1e-12, `deviation of ${name}`);
        for (const [wrong, why] of [
            ["moo=1%", /'moo' is not a number/],
            ["mu=-1", /standard deviation >= 0/],
            ["mu=1%,mu=2%", /twice/],
        ]) {
            const refused = ask(wrong);
            check(why.test(refused.uncertain) && !refused.deviations && refused["derivative.p"], refused.uncertain);
        }
        check(ask("").deviations === null && ask("").uncertain === "", "nothing uncertain");
    });
    await test("lessons that figures name are there", () => {
        for (const file of [...Object.values(LESSONS), ...Object.values(PAGES)])
            check(existsSync(`docs/${file}`), file);
    });
    await test("Carter's tractions are the library's", () => {
        const got = answer(library, { kind: "closed", given: PRESETS.rail }),
            worst = Math.max(...got["closed.q"].at.map((q, i) => Math.abs(q - got.columns.q[i])));
        check(worst < 0.02 * got.numbers.max_pressure, `off by ${worst}`);
        check(
            answer(library, { kind: "closed", given: PRESETS.stiff })["closed.q"] === null,
            "Carter for a wheel on a hub",
        );
    });
    await test("proofs are the program's, in its words and in the page's", () => {
        for (const [preset, more, unique] of [
            ["rail", {}, /no other solution: friction does not change/],
            ["rail", { mu: "0", "creep-ratio": undefined, creep: "0.001" }, /without friction/],
            ["roll", {}, /solution at this creepage|energy test|not shown/],
        ]) {
            const given = JSON.parse(JSON.stringify({ ...PRESETS[preset], ...more })),
                got = answer(library, { kind: "prove", given }),
                told = proof_in_words(words, got).join(" "),
                { proof } = JSON.parse(run([...words_of(given), "--prove", "--json", "--quiet"]).stdout).summary;
            check(got.numbers.proved === 1 && proof.status === "proved", `${preset}: ${got.reason}, ${proof.status}`);
            check(got.unique === proof.unique && unique.test(told), `${got.unique}, ${proof.unique}: ${told}`);
            check(
                Math.abs(Math.log10(got.numbers.bound_p / proof.bound_p)) < 1,
                `bounds ${got.numbers.bound_p} and ${proof.bound_p}`,
            );
            check(!/undefined|NaN|\{/.test(told), told);
        }
    });
    await test("notes of the library reach the page", () =>
        check(
            /linear elasticity/.test(solve({ ...PRESETS.stiff, load: "1000" }).notes.join()),
            "no note on the strain",
        ));

    await test("one file of at most 800 kB that names no other", () => {
        check(text_of_page.length <= 800e3, `${text_of_page.length} bytes`);
        check(!/(src|href)="?https?:/.test(text_of_page), "it asks for something");
    });

    /* axe-core finds contrasts that are too weak, missing names and broken roles.  It comes from the npm
     * registry as web/package-lock.json names it, into the build folder; null: it cannot be had. */
}
