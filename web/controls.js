/* The controls: sliders with exact fields, what is held, and every option of the table. */
import { html, segments } from "./draw.js";
import { ALL_TANGENTIAL, NORMAL, PRESETS, TANGENTIAL, formulation_of, held, hold } from "./state.js";
import { say } from "./words.js";

/* Spans of the sliders: exact fields and the library's own ranges go beyond them. */
const SPANS = {
    load: [1, 1e5, "log"], approach: [1e-4, 100, "log"], "half-width": [0.01, 100, "log"], "creep-ratio": [-1.4, 1.4], creep: [-0.02, 0.02],
    "force-ratio": [-0.99, 0.99], force: [-500, 500], shift: [-5, 5], mu: [0, 1], radius: [10, 2000, "log"], young: [1, 400000, "log"],
    poisson: [0, 0.5], "contact-elements": [6, 200, "log"],
};
const RESULT_OF = { load: "normal_load", approach: "approach", "half-width": "hertz_half_width", "creep-ratio": "creep_ratio", creep: "creepage",
    "force-ratio": "force_ratio", force: "tangential_load", shift: "tangential_shift" };

const plain = (x) => String(Number(x.toPrecision(6)));

export function controls(host, words, options, page) {
    const option = Object.fromEntries(options.map((o) => [o.name, o]));
    const help_of = (o) => say(words.expected, { help: o.help, expected: o.expected, default: o.default || "–" });
    const value_of = (name) => page.given[name] ?? page.answer?.values[name] ?? option[name].default;
    const whole = (name) => option[name].kind === "integer";

    function knob(name, set) {
        const [from, to, scale] = SPANS[name], log = scale === "log";
        const up = (v) => log ? Math.log(v) : v, down = (v) => log ? Math.exp(v) : v;
        const now = value_of(name);
        const id = `knob-${name}`, unit = option[name].unit;
        const text = html("input", { type: "text", id, inputmode: "decimal", value: now, title: help_of(option[name]), onchange: () => change(text.value) });
        const slider = html("input", { type: "range", min: up(from), max: up(to), step: (up(to) - up(from)) / 400, value: up(Number(now)),
            "aria-label": words.names[name], "aria-valuetext": `${now} ${unit}`, "data-knob": name,
            oninput: () => { const v = down(Number(slider.value)); change(whole(name) ? String(Math.round(v)) : String(Number(v.toPrecision(3)))); } });
        function change(value) { text.value = value; slider.value = up(Number(value)); slider.setAttribute("aria-valuetext", `${value} ${unit}`); set(value); }
        return html("div", { class: "knob" }, html("label", { for: id }, words.names[name]), text,
            html("span", { class: "unit" }, unit === "-" ? "" : unit), slider);
    }
    const group = (title, ...children) => html("fieldset", {}, html("legend", {}, title), ...children);
    const change = (given) => { page.change(given); draw(); };
    const set = (name) => (text) => page.change({ ...page.given, [name]: text });

    /* One of several quantities is held; another one takes over at the value that it has now. */
    function held_group(title, label, among, all, fallback) {
        const now = held(page.given, among) ?? fallback;
        const take = (name) => change(hold(page.given, all, name, plain(page.answer?.numbers[RESULT_OF[name]] || Number(SPANS[name][0]) / 2)));
        return group(title, segments(label, title, among.map((name) => [name, words.names[name]]), now, take),
            knob(now, (text) => page.change(hold(page.given, all, now, text))));
    }
    function move(formulation) {
        const given = { ...page.given, formulation };
        if (held(given, TANGENTIAL[formulation])) return change(given);
        return change(hold(given, ALL_TANGENTIAL, formulation === "static" ? "force-ratio" : "creep-ratio", "0.5"));
    }
    function ground(kind) {
        const given = { ...page.given, "support-b": "halfplane", similar: "yes" };
        if (kind === "rigid") for (const name of ["support-b", "similar", "young-b", "poisson-b"]) delete given[name];
        change(given);
    }
    function all_options() {
        const row = (o) => {
            const id = `option-${o.name}`;
            const input = html("input", { id, value: page.given[o.name] ?? "", placeholder: o.default, "aria-describedby": `${id}-help`,
                onchange: () => { const given = { ...page.given }; if (input.value.trim()) given[o.name] = input.value.trim(); else delete given[o.name]; change(given); } });
            return html("div", { class: "option" }, html("label", { for: id }, o.name), input,
                html("p", { id: `${id}-help` }, `${o.help}. ${o.expected}${o.unit && o.unit !== "-" ? ` [${o.unit}]` : ""}`));
        };
        return html("details", { class: "all", open: open_all, ontoggle: (event) => { open_all = event.target.open; } }, html("summary", {}, words.all_options),
            ...options.map((o) => o.kind === "group" ? html("h3", {}, o.help) : row(o)));
    }
    let open_all = false;

    function draw() {
        const moving = formulation_of(page.given) === "static" ? "static" : "steady";
        const focus = document.activeElement, kept = focus && host.contains(focus) && (focus.dataset.knob ? `[data-knob="${focus.dataset.knob}"]`
            : focus.id ? `#${focus.id}` : focus.name ? `[name="${focus.name}"]:checked` : null);
        const preset = html("select", { "aria-label": words.start, onchange: () => { if (PRESETS[preset.value]) change({ ...PRESETS[preset.value] }); } },
            html("option", { value: "" }, `${words.start} …`), ...Object.keys(PRESETS).map((name) => html("option", { value: name }, words.presets[name])));
        const file = html("input", { type: "file", accept: ".ini,text/plain", hidden: true, "aria-label": words.open_file, onchange: () => { if (file.files[0]) page.open_file(file.files[0]); } });
        host.replaceChildren(
            preset, file, html("button", { type: "button", class: "button open", onclick: () => file.click() }, words.open_file),
            html("button", { type: "button", class: "button open", "aria-haspopup": "dialog", onclick: () => document.getElementById("signs").showModal() }, words.signs),
            group(words.groups.problem, segments("formulation", words.groups.problem, Object.entries(words.formulations), moving, move)),
            held_group(words.groups.normal, "normal", NORMAL, NORMAL, "approach"),
            held_group(words.groups.tangential, "tangential", TANGENTIAL[moving], ALL_TANGENTIAL, TANGENTIAL[moving][moving === "static" ? 2 : 0]),
            group(words.groups.friction, knob("mu", set("mu"))),
            group(words.groups.body, segments("support", words.support_label, Object.entries(words.supports), page.given.support ?? "arc", (v) => change({ ...page.given, support: v })),
                segments("ground", words.body_label, Object.entries(words.bodies), "similar" in page.given || "young-b" in page.given ? "similar" : "rigid", ground),
                knob("radius", set("radius")), knob("young", set("young")), knob("poisson", set("poisson"))),
            group(words.groups.mesh, knob("contact-elements", set("contact-elements"))),
            html("fieldset", {}, all_options()));
        if (kept) host.querySelector(kept)?.focus();
    }
    draw();
    return { draw };
}
