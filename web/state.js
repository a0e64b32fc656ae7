/* The case of the page: options as text, as the library reads them; and its link. */

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
const LONGEST = 4000;

export const formulation_of = (given) => given.formulation ?? "static";
export const held = (given, among) => among.find((name) => name in given);

/* The options of a group of which one is held, without the others. */
export function hold(given, group, name, text) {
    const next = { ...given };
    for (const other of group) delete next[other];
    next[name] = text;
    return next;
}

export function write_link(given, view) {
    return "#" + new URLSearchParams({ ...given, view }).toString();
}

/* { given, view } of a fragment; null: there is none.  Names and values are the library's
 * to judge; an Error says what is no link at all. */
export function read_link(fragment, views) {
    if (fragment.length < 2) return null;
    if (fragment.length > LONGEST) throw new Error(`${fragment.length} characters, more than ${LONGEST}`);
    const given = Object.fromEntries(new URLSearchParams(fragment.slice(1)));
    const view = views.includes(given.view) ? given.view : views[0];
    delete given.view;
    return { given: Object.keys(given).length ? given : null, view };
}
