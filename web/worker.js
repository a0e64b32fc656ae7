/* Solves in the background.  A request: { id, kind, given, ... }; the answer: { id, kind,
 * ... } or { id, kind, refused: line }. */
import { load_library } from "./library.js";

/* What the page does not take; rollbem page reads it in the page itself. */
export const LARGEST = { "contact-elements": 400, "outer-elements": 800, steps: 600, distance: 40, increments: 60 };
export const LEFT_OUT = ["accuracy", "error", "irregularity", "units"];

/* A case of these words.  Of each slot of requests the last case is kept: where only values differ
 * they are set on it, and the library uses what it can of its matrices again. */
function case_of(library, slot, given, purpose) {
    const kept = (library.kept ??= new Map()),
        last = kept.get(slot),
        names = Object.keys(given);
    const same = last && names.length === Object.keys(last.given).length && names.every((name) => name in last.given);
    if (!same) last?.work.free();
    const work = same ? last.work : new library.Case(purpose);
    kept.set(slot, { work, given });
    return { work, changed: same ? names.filter((name) => given[name] !== last.given[name]) : names };
}
function forget_case(library, slot) {
    library.kept?.get(slot)?.work.free();
    library.kept?.delete(slot);
}

/* Solved and asked; refused where the page cannot.  files: those that the words name, by name. */
function solve_case(library, slot, given, then, { files = {}, purpose } = {}) {
    library.files.clear();
    for (const [name, text] of Object.entries(files)) library.files.set(name, new TextEncoder().encode(text));
    for (const [name, text] of Object.entries(given)) {
        if (LEFT_OUT.includes(name)) return { refused: `--${name}: not in the page, use the program` };
        if (Number(text) > LARGEST[name])
            return { refused: `--${name}: the page goes up to ${LARGEST[name]}, use the program for ${text}` };
    }
    if (library.files.size) forget_case(library, slot); /* a case reads its files once */
    const { work, changed } = case_of(library, slot, given, purpose),
        start = performance.now();
    try {
        if (changed.some((name) => work.set(name, given[name]) < 0) || work.solve() < 0) {
            const refused = work.message;
            forget_case(library, slot);
            return { refused };
        }
        return { ...then(work, library), unsolved: work.message, milliseconds: performance.now() - start };
    } catch (error) {
        forget_case(library, slot);
        throw error;
    }
}

const arrays = (work, names) => Object.fromEntries(names.map((name) => [name, work.array(name)]));

function all_results(work, library) {
    const names = [...library.results.number.map((row) => row.name), "carter", "radius", "modulus"];
    return {
        numbers: Object.fromEntries(names.map((name) => [name, work.number(name)])),
        words: Object.fromEntries(
            ["status", "formulation", "solver", "lcp-form"].map((name) => [name, work.word(name)]),
        ),
        notes: work.notes,
        columns: Object.fromEntries(library.results.column.map(({ name }) => [name, work.array(name)?.at])),
        values: Object.fromEntries(
            library.options.filter((o) => o.kind !== "group").map(({ name }) => [name, work.value(name)]),
        ),
    };
}

const steps = (work, library) => {
    const history = Object.fromEntries(
        library.results.step.map(({ name }) => [name, work.array(`history.${name}`)?.at]),
    );
    return { ...all_results(work, library), history, ...arrays(work, ["step.x", "step.p", "step.q", "step.zone"]) };
};

function pivots(work, library) {
    const status = work.pivots();
    if (status < 0) return { refused: work.message };
    const end = status ? work.message : "";
    const names = [];
    for (let k = 0, name; (name = work.variable(k)) !== null; k++) names.push(name);
    const parts = ["entering", "leaving", "row", "ratio", "z0", "basis", "value", "before", "column", "p", "q"];
    const newton = work.newton() < 0 ? {} : arrays(work, ["newton.zone", "newton.p", "newton.q"]);
    return {
        ...all_results(work, library),
        names,
        end,
        ...newton,
        ...arrays(
            work,
            parts.map((part) => `pivot.${part}`),
        ),
        ...arrays(work, ["H", "G", "F", "lcp.M", "lcp.q", "ends", "gap0", "mesh.x0", "mesh.y0", "mesh.x1", "mesh.y1"]),
    };
}

const answers = {
    solve: (library, { slot, given }) => solve_case(library, slot, given, all_results),
    /* With Hertz and Carter beside it, where they hold. */
    closed: (library, { slot, given }) =>
        solve_case(library, slot, given, (work, l) => ({
            ...all_results(work, l),
            ...arrays(work, ["closed.p", "closed.q"]),
        })),
    roll: (library, { slot, given, files }) => solve_case(library, slot, given, steps, { files }),
    pivots: (library, { slot, given }) => solve_case(library, slot, given, pivots),
    curve: (library, { slot, given, from, to, points }) =>
        solve_case(library, slot, given, (work, { results }) =>
            work.curve(from, to, points) < 0
                ? { refused: work.message }
                : {
                      points: Object.fromEntries(
                          results.point.map(({ name }) => [name, work.array(`curve.${name}`)?.at]),
                      ),
                  },
        ),
    /* Of the numbers and tractions of a solution, with respect to every input; tolerance: standard deviations of inputs,
     * for those of the numbers. */
    derivatives: (library, { slot, given, tolerance = "" }) =>
        solve_case(library, slot, given, (work, l) => {
            if (work.derivatives() !== 0) return { refused: work.message };
            const inputs = [];
            for (let k = 0, input; (input = work.input(k)) !== null; k++) inputs.push(input);
            const numbers = l.results.number.map((row) => row.name),
                uncertain = tolerance && work.tolerances(tolerance) !== 0 ? work.message : "";
            return {
                numbers: Object.fromEntries(numbers.map((name) => [name, work.number(name)])),
                inputs,
                x: work.array("x").at,
                ...arrays(
                    work,
                    ["value", "p", "q", ...numbers].map((name) => `derivative.${name}`),
                ),
                deviations:
                    tolerance && !uncertain
                        ? Object.fromEntries(numbers.map((name) => [name, work.array(`tolerance.${name}`)?.at[0]]))
                        : null,
                uncertain,
                elements: work.word("elements"),
            };
        }),
    /* A proof that the solution is one, with bounds; what is not known is not a number. */
    prove: (library, { slot, given }) =>
        solve_case(library, slot, given, (work) => {
            if (work.prove() < 0) return { refused: work.message };
            const names = ["proved", "undecided", "isolated", "bound_p", "bound_q", "nearby"];
            return {
                numbers: Object.fromEntries(names.map((name) => [name, work.number(`proof.${name}`)])),
                reason: work.word("proof.reason"),
                unique: work.word("proof.unique"),
            };
        }),
    /* The contact, then its pass over a crack. */
    crack: (library, { slot, given, crack }) =>
        solve_case(
            library,
            slot,
            given,
            (work, l) => {
                if (work.crack(crack) !== 0) return { refused: work.message };
                const columns = ["x", "K_I", "K_II", "open_length", "stick_length", "fluid_pressure"],
                    faces = ["opening", "sliding", "zone", "path.x", "path.y"],
                    nodes = ["x", "y", "t_x", "t_y"].map((name) => `node.${name}`),
                    sums = ["K_I_max", "K_I_min", "K_II_max", "K_II_min", "delta_K_II", "fluid_pressure_max"];
                return {
                    ...all_results(work, l),
                    crack,
                    ...arrays(
                        work,
                        [...columns, ...faces, ...nodes].map((name) => `crack.${name}`),
                    ),
                    summary: Object.fromEntries(
                        sums.map((name) => [name, work.array(`crack.summary.${name}`)?.at[0] ?? Number.NaN]),
                    ),
                };
            },
            { purpose: "crack" },
        ),
    guess: (library, { slot, given, zones }) =>
        solve_case(library, slot, given, (work) => {
            const status = work.guess(zones);
            return status !== 0
                ? { refused: work.message }
                : arrays(work, ["guess.p", "guess.q", "guess.gap", "guess.shift", "ends"]);
        }),
    /* maxima: with the largest stresses, which the library finds between the points of the grid. */
    stress: (library, { slot, given, nx, ny, depth, maxima }) =>
        solve_case(library, slot, given, (work, l) =>
            work.stress(nx, ny, depth) < 0 || (maxima && work.maxima(depth) < 0)
                ? { refused: work.message }
                : {
                      ...all_results(work, l),
                      ...arrays(work, [
                          "stress.x",
                          "stress.y",
                          "stress.max_shear",
                          "stress.sxx",
                          "stress.syy",
                          "stress.sxy",
                          "stress.von_mises",
                          "maxima.max_shear",
                          "maxima.von_mises",
                      ]),
                  },
        ),
};
/* A request of its own slot where it names none. */
const answer_of = (library, request) => answers[request.kind](library, { slot: request.kind, ...request });

/* For tests, which have no worker. */
export const answer = answer_of;

if (typeof self !== "undefined" && typeof window === "undefined") {
    let library;
    self.onmessage = async ({ data }) => {
        if (data.wasm) {
            library = await load_library(data.wasm);
            self.postMessage({ ready: true, options: library.options, results: library.results });
            return;
        }
        try {
            self.postMessage({ id: data.id, kind: data.kind, ...answer_of(library, data) });
        } catch (error) {
            self.postMessage({ id: data.id, kind: data.kind, refused: String(error.message), broken: true });
        }
    };
}
