/* The case of the page: options as text, as the library reads them; its link and its case file. */

export const PRESETS = {
    rail: {
        support: "halfplane",
        "support-b": "halfplane",
        similar: "yes",
        formulation: "steady",
        radius: "460",
        young: "210000",
        poisson: "0.3",
        mu: "0.3",
        load: "12500",
        "creep-ratio": "0.5",
        "contact-elements": "60",
    },
    stiff: {
        support: "hub",
        "hub-ratio": "0.5",
        formulation: "steady",
        radius: "100",
        young: "10",
        poisson: "0.45",
        mu: "0.6",
        load: "20",
        "force-ratio": "-0.6",
        mesh: "uniform",
        "contact-elements": "40",
    },
    roll: {
        support: "hub",
        "hub-ratio": "0.6",
        "cover-thickness": "12",
        "core-young": "210000",
        "core-poisson": "0.3",
        "young-b": "210000",
        "poisson-b": "0.3",
        "radius-b": "100",
        formulation: "steady",
        radius: "150",
        young: "8",
        poisson: "0.48",
        mu: "0.25",
        load: "25",
        "creep-ratio": "0.9",
        mesh: "uniform",
        "contact-elements": "40",
    },
    addi: { mu: "0.3", mesh: "uniform", "contact-elements": "40", shift: "2" },
};
export const NORMAL = ["load", "approach", "half-width"];
export const TANGENTIAL = {
    static: ["force-ratio", "force", "shift"],
    steady: ["creep-ratio", "creep", "force-ratio", "force"],
};
export const ALL_TANGENTIAL = ["creep-ratio", "creep", "force-ratio", "force", "shift"];
const LONGEST = 4000,
    LONGEST_FILE = 20000;

/* A number as an option takes it. */
export const plain = (x) => String(Number(x.toPrecision(6)));
export const formulation_of = (given) => given.formulation ?? "static";
export const held = (given, among) => among.find((name) => name in given);

/* The options of a group of which one is held, without the others. */
export function hold(given, group, name, text) {
    const next = { ...given };
    for (const other of group) delete next[other];
    next[name] = text;
    return next;
}

/* What belongs to one way of holding body A, or of asking something of it. */
const BELONGS = {
    arc: ["arc"],
    hub: ["hub-ratio", "cover-thickness", "core-young", "core-poisson"],
    halfplane: ["datum", "layer-thickness", "base-young", "base-poisson"],
};
/* Another support, without what has no meaning there; on B, where B has the same one by its own word. */
export function with_support(given, support) {
    const next = { ...given, support };
    for (const [kind, names] of Object.entries(BELONGS))
        if (kind !== support) for (const name of names) delete next[name];
    if (support === "halfplane" && (next["support-b"] ?? "halfplane") === "halfplane")
        for (const name of ["outer-elements", "near-field"]) delete next[name];
    if (support !== "halfplane" || !(Number(next.speed) > 0))
        for (const name of ["relaxation-time", "relaxation-ratio", "speed"]) if (support === "arc") delete next[name];
    return next;
}

/* Without friction there is no friction to be a part of: the drive becomes a creepage, or a shift at rest. */
export function with_mu(given, mu, numbers) {
    const next = { ...given, mu: String(mu) },
        held_now = held(given, ALL_TANGENTIAL);
    if (Number(mu) > 0 || !held_now || ["creep", "shift"].includes(held_now)) return next;
    if (formulation_of(given) === "static") return hold(next, ALL_TANGENTIAL, "shift", "0");
    const creep = numbers?.creepage;
    return hold(next, ALL_TANGENTIAL, "creep", String(Number.isFinite(creep) ? Number(creep.toPrecision(4)) : 0));
}

/* A case with a crack below its contact: the options of the contact, and those of the crack. */
const of_crack = (name) => /^crack-|^fluid$/.test(name);
const only = (given, which) => Object.fromEntries(Object.entries(given).filter(([name]) => which(name)));
export const contact_of = (given) => only(given, (name) => !of_crack(name));
export const crack_of = (given) => only(given, of_crack);

/* Which of three grounds is given: rigid, of the same material, another elastic one. */
export const ground_of = (given) =>
    "similar" in given && given.similar !== "no" ? "similar" : "young-b" in given ? "other" : "rigid";
/* Another ground, without what has no meaning there.  What has A's cover is a roll as A is. */
export function with_ground(given, kind) {
    const next = { ...given },
        elastic = { "young-b": given["young-b"] ?? "70000", "poisson-b": given["poisson-b"] ?? "0.33" };
    for (const name of Object.keys(given)) if (/-b$/.test(name) && name !== "radius-b") delete next[name];
    delete next.similar;
    if (kind === "rigid") {
        for (const name of ["support-b", "radius-b"]) delete next[name];
        return next;
    }
    next["support-b"] = "halfplane";
    if (kind === "other") return Object.assign(next, elastic);
    if ("cover-thickness" in given)
        Object.assign(next, { "support-b": "hub", "radius-b": given["radius-b"] ?? given.radius });
    return Object.assign(next, { similar: "yes" });
}
/* What of the approach the ground takes, for drawing only: as two half-planes share it. */
export function share_of_ground(given, values) {
    const soft = (young, poisson) => (1 - Number(poisson) ** 2) / Number(young);
    const kind = ground_of(given);
    if (kind !== "other") return kind === "similar" ? 0.5 : 0;
    const [a, b] = [soft(values.young, values.poisson), soft(values["young-b"], values["poisson-b"])];
    return b / (a + b) || 0;
}

/* Its radius; infinite: a plane, negative: a bore around A. */
export const radius_of_ground = (values) => Number(values["radius-b"]) || Infinity;

/* "0,3" of a German or French keyboard; a list of numbers keeps its commas. */
export const with_point = (text) =>
    (/^\s*[-+]?\d*,\d+(e[-+]?\d+)?\s*[^\d,.]*$/i.test(text) ? text.replace(",", ".") : text).trim();

/* What is drawn by hand over the way: { what, distance, values }, what a column of a history. */
export const DRAWN = { mu: ["mu"], load: NORMAL, force_ratio: ALL_TANGENTIAL, creep_ratio: ALL_TANGENTIAL };
const MOST_DRAWN = 60;

function read_drawn(text) {
    const [what, distance, ...values] = text.split(" "),
        numbers = values.map(Number);
    if (
        !Object.hasOwn(DRAWN, what) ||
        !(Number(distance) > 0) ||
        numbers.length < 2 ||
        numbers.length > MOST_DRAWN ||
        !numbers.every(Number.isFinite)
    )
        throw new Error(`drawn=${text.slice(0, 40)}`);
    return { what, distance: Number(distance), values: numbers };
}
export const table_of_drawn = ({ what, distance, values }) =>
    `distance\t${what}\n` +
    values.map((v, k) => `${Number(((distance * k) / (values.length - 1)).toPrecision(6))}\t${v}\n`).join("");

export function write_link(given, view, drawn, embed = false) {
    return (
        "#" +
        new URLSearchParams({
            ...given,
            ...(drawn && { drawn: [drawn.what, drawn.distance, ...drawn.values].join(" ") }),
            view,
            ...(embed && { embed }),
        }).toString()
    );
}

/* What a frame of another page shows: the first screen, or its picture alone. */
const EMBEDDED = ["hero", "lens"];
/* What a class gets: slides, or a worksheet. */
const CLASSES = ["slides", "sheet"];

/* { given, view, drawn, embed, lesson } of a fragment; null: there is none.  Names and values are the library's
 * to judge; an Error says what is no link at all. */
export function read_link(fragment, views) {
    if (fragment.length < 2) return null;
    const place = /^#at-(\w+)$/.exec(fragment)?.[1];
    if (views.includes(place)) return { given: null, view: place, drawn: null, embed: false, lesson: false };
    if (fragment.length > LONGEST) throw new Error(`${fragment.length} characters, more than ${LONGEST}`);
    const given = Object.fromEntries(new URLSearchParams(fragment.slice(1)));
    const view = views.includes(given.view) ? given.view : views[0];
    const drawn = given.drawn ? read_drawn(given.drawn) : null;
    delete given.view;
    const embed = EMBEDDED.includes(given.embed) && given.embed;
    const lesson = CLASSES.includes(given.class) && given.class;
    for (const name of ["drawn", "embed", "class"]) delete given[name];
    return { given: Object.keys(given).length ? given : null, view, drawn, embed, lesson };
}

/* The options of a case file.  Sections, names and values are the library's to judge. */
export function read_case_file(text) {
    if (text.length > LONGEST_FILE) throw new Error(`${text.length} characters, more than ${LONGEST_FILE}`);
    const given = {};
    text.split(/\r?\n/).forEach((line, k) => {
        const bare = line
                .replace(/^\uFEFF/, "")
                .replace(/(^|\s)[;#].*/, "")
                .trim(),
            pair = /^([\w-]+)\s*[=:]\s*(.*)$/.exec(bare);
        if (!bare || /^\[.*\]$/.test(bare)) return;
        if (!pair) throw new Error(`line ${k + 1}: expected name = value`);
        if (pair[1] in given) throw new Error(`line ${k + 1}: '${pair[1]}' is given twice`);
        given[pair[1]] = pair[2];
    });
    if (!Object.keys(given).length) throw new Error("no line with name = value");
    return given;
}
