/* The case of the page: options as text, as the library reads them; its link and its case file. */

export const PRESETS = {
    rail: { support: "halfplane", "support-b": "halfplane", similar: "yes", formulation: "steady", radius: "460", young: "210000", poisson: "0.3",
        mu: "0.3", load: "1000", "creep-ratio": "0.5", mesh: "uniform", "contact-elements": "60" },
    stiff: { support: "hub", "hub-ratio": "0.5", formulation: "steady", radius: "100", young: "10", poisson: "0.45", mu: "0.6", load: "20",
        "force-ratio": "-0.6", mesh: "uniform", "contact-elements": "40" },
    addi: { mu: "0.3", mesh: "uniform", "contact-elements": "40", shift: "2" },
};
export const NORMAL = ["load", "approach", "half-width"];
export const TANGENTIAL = { static: ["force-ratio", "force", "shift"], steady: ["creep-ratio", "creep", "force-ratio", "force"] };
export const ALL_TANGENTIAL = ["creep-ratio", "creep", "force-ratio", "force", "shift"];
const LONGEST = 4000, LONGEST_FILE = 20000;

export const formulation_of = (given) => given.formulation ?? "static";
export const held = (given, among) => among.find((name) => name in given);

/* The options of a group of which one is held, without the others. */
export function hold(given, group, name, text) {
    const next = { ...given };
    for (const other of group) delete next[other];
    next[name] = text;
    return next;
}

/* What is drawn by hand over the way: { what, distance, values }, what a column of a history. */
export const DRAWN = { mu: ["mu"], load: NORMAL, force_ratio: ALL_TANGENTIAL, creep_ratio: ALL_TANGENTIAL };
const MOST_DRAWN = 60;

function read_drawn(text) {
    const [what, distance, ...values] = text.split(" "), numbers = values.map(Number);
    if (!(what in DRAWN) || !(Number(distance) > 0) || numbers.length < 2 || numbers.length > MOST_DRAWN || !numbers.every(Number.isFinite))
        throw new Error(`drawn=${text.slice(0, 40)}`);
    return { what, distance: Number(distance), values: numbers };
}
export const table_of_drawn = ({ what, distance, values }) => `distance\t${what}\n`
    + values.map((v, k) => `${Number((distance * k / (values.length - 1)).toPrecision(6))}\t${v}\n`).join("");

export function write_link(given, view, drawn) {
    return "#" + new URLSearchParams({ ...given, ...(drawn && { drawn: [drawn.what, drawn.distance, ...drawn.values].join(" ") }), view }).toString();
}

/* { given, view, drawn } of a fragment; null: there is none.  Names and values are the library's
 * to judge; an Error says what is no link at all. */
export function read_link(fragment, views) {
    if (fragment.length < 2) return null;
    if (fragment.length > LONGEST) throw new Error(`${fragment.length} characters, more than ${LONGEST}`);
    const given = Object.fromEntries(new URLSearchParams(fragment.slice(1)));
    const view = views.includes(given.view) ? given.view : views[0];
    const drawn = given.drawn ? read_drawn(given.drawn) : null;
    delete given.view;
    delete given.drawn;
    return { given: Object.keys(given).length ? given : null, view, drawn };
}

/* The options of a case file.  Sections, names and values are the library's to judge. */
export function read_case_file(text) {
    if (text.length > LONGEST_FILE) throw new Error(`${text.length} characters, more than ${LONGEST_FILE}`);
    const given = {};
    text.split(/\r?\n/).forEach((line, k) => {
        const bare = line.replace(/^\uFEFF/, "").replace(/(^|\s)[;#].*/, "").trim(), pair = /^([\w-]+)\s*[=:]\s*(.*)$/.exec(bare);
        if (!bare || /^\[.*\]$/.test(bare)) return;
        if (!pair) throw new Error(`line ${k + 1}: expected name = value`);
        if (pair[1] in given) throw new Error(`line ${k + 1}: '${pair[1]}' is given twice`);
        given[pair[1]] = pair[2];
    });
    if (!Object.keys(given).length) throw new Error("no line with name = value");
    return given;
}
