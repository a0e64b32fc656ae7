/* The panel of the workbench: sliders with exact fields, what is held, and every option of the table. */
import { html, segments } from "./draw.js";
import { show_on, slider_for } from "./knob.js";
import {
    ALL_TANGENTIAL,
    NORMAL,
    PRESETS,
    TANGENTIAL,
    formulation_of,
    ground_of,
    held,
    hold,
    plain,
    with_ground,
    with_point,
    with_support,
} from "./state.js";
import { fill_in } from "./words.js";

/* Spans of the sliders: exact fields and the library's own ranges go beyond them. */
const SPANS = {
    load: [1, 1e5, "log"],
    approach: [1e-4, 100, "log"],
    "half-width": [0.01, 100, "log"],
    "creep-ratio": [-1.4, 1.4],
    creep: [-0.02, 0.02],
    "force-ratio": [-0.99, 0.99],
    force: [-500, 500],
    shift: [-5, 5],
    mu: [0, 1],
    radius: [10, 2000, "log"],
    young: [1, 400000, "log"],
    poisson: [0, 0.5],
    "contact-elements": [6, 200, "log"],
};
const RESULT_OF = {
    load: "normal_load",
    approach: "approach",
    "half-width": "hertz_half_width",
    "creep-ratio": "creep_ratio",
    creep: "creepage",
    "force-ratio": "force_ratio",
    force: "tangential_load",
    shift: "tangential_shift",
};
const STEPS = 400;

/* What another quantity is held at when it takes over: its value as solved, within what may be held. */
export function value_to_hold(name, numbers) {
    const now = numbers?.[RESULT_OF[name]],
        [from, to, scale] = SPANS[name];
    if (scale === "log") return now > 0 ? plain(now) : plain(Math.sqrt(from * to));
    if (!Number.isFinite(now) || Math.abs(now) < 1e-12) return "0";
    return name === "force-ratio" ? plain(Math.max(from, Math.min(to, now))) : plain(now);
}

/* From rolling to rest and back the friction stays what it is. */
export function with_motion(given, formulation, numbers) {
    const next = { ...given, formulation },
        now = held(given, ALL_TANGENTIAL);
    for (const name of ["distance", "steps", "history"]) delete next[name];
    if (!now || TANGENTIAL[formulation].includes(now)) return next;
    if (!(Math.abs(numbers?.force_ratio) > 0))
        return hold(next, ALL_TANGENTIAL, formulation === "static" ? "shift" : "creep", "0");
    return hold(next, ALL_TANGENTIAL, "force-ratio", value_to_hold("force-ratio", numbers));
}

export function controls(host, words, page) {
    const { options, store } = page,
        option = Object.fromEntries(options.map((o) => [o.name, o]));
    const help_of = (o) => fill_in(words.expected, { help: o.help, expected: o.expected, default: o.default || "–" });
    const whole = (name) => option[name].kind === "integer";
    const numbers = () => page.answer?.numbers;
    /* As it was typed; a number as the library has read it, units and all. */
    const typed = (name) => page.given[name] ?? page.answer?.values[name] ?? option[name].default;
    const read = (name) =>
        Number(page.answer?.given?.[name] === page.given[name] ? page.answer.values[name] : typed(name)) ||
        Number(typed(name)) ||
        0;
    /* A cover on an elastic core has to be compressible: the library refuses more. */
    const COMPRESSIBLE = 0.499;
    const has_elastic_core = () => Number(typed("cover-thickness")) > 0 && Number(typed("core-young")) > 0;
    let knobs = [],
        made_for = null,
        open_all = false,
        draw_kept = "";

    function knob(name, set) {
        const [from, to, scale] = SPANS[name],
            log = scale === "log",
            up = (v) => (log ? Math.log(Math.max(v, 1e-12)) : v),
            down = (v) => (log ? Math.exp(v) : v);
        const id = `knob-${name}`,
            unit = option[name].unit;
        const text = html("input", {
            type: "text",
            id,
            inputmode: "decimal",
            title: help_of(option[name]),
            onchange: () => set(with_point(text.value)),
        });
        const slider = slider_for(
            store,
            {
                min: up(from),
                max: up(to),
                step: (up(to) - up(from)) / STEPS,
                "aria-label": words.names[name],
                "data-knob": name,
            },
            (at) => {
                const v = down(at);
                set(whole(name) ? String(Math.round(v)) : String(Number((Math.abs(v) < 1e-9 ? 0 : v).toPrecision(3))));
            },
        );
        knobs.push(() => {
            if (document.activeElement !== text) text.value = typed(name);
            if (name === "poisson") slider.max = has_elastic_core() ? COMPRESSIBLE : to;
            if (document.activeElement !== slider || !store.holding) show_on(slider, up(read(name)));
            slider.setAttribute("aria-valuetext", `${typed(name)} ${unit}`);
        });
        return html(
            "div",
            { class: "knob" },
            html("label", { for: id }, words.names[name]),
            text,
            html("span", { class: "unit" }, unit === "-" ? "" : unit),
            slider,
        );
    }
    const group = (title, ...children) => html("fieldset", {}, html("legend", {}, title), ...children);
    const set = (name) => (text) => page.change({ ...page.given, [name]: text });

    /* One of several quantities is held; another one takes over at the value that it has now. */
    function held_group(title, label, among, all, fallback) {
        const now = held(page.given, among) ?? fallback;
        return group(
            title,
            segments(
                label,
                title,
                among.map((name) => [name, words.names[name]]),
                now,
                (name) => page.change(hold(page.given, all, name, value_to_hold(name, numbers()))),
            ),
            knob(now, (text) => page.change(hold(page.given, all, now, text))),
        );
    }
    const ground = (kind) => page.change(with_ground(page.given, kind));
    function all_options() {
        const row = (o) => {
            const id = `option-${o.name}`;
            const input = html("input", {
                id,
                placeholder: o.default,
                "aria-describedby": `${id}-help`,
                onchange: () => {
                    const given = { ...page.given },
                        text = o.kind === "number" ? with_point(input.value) : input.value.trim();
                    if (text) given[o.name] = text;
                    else delete given[o.name];
                    page.change(given);
                },
            });
            knobs.push(() => {
                if (document.activeElement !== input) input.value = page.given[o.name] ?? "";
            });
            return html(
                "div",
                { class: "option" },
                html("label", { for: id }, o.name),
                input,
                html(
                    "p",
                    { id: `${id}-help` },
                    `${o.help}. ${o.expected}${o.unit && o.unit !== "-" ? ` [${o.unit}]` : ""}`,
                ),
            );
        };
        return html(
            "details",
            {
                class: "all",
                open: open_all,
                ontoggle: (event) => {
                    open_all = event.target.open;
                },
            },
            html("summary", {}, words.all_options),
            ...options.map((o) => (o.kind === "group" ? html("h3", {}, o.help) : row(o))),
        );
    }
    /* What of the case decides which controls there are. */
    const structure = () =>
        JSON.stringify([
            formulation_of(page.given),
            held(page.given, NORMAL),
            held(page.given, ALL_TANGENTIAL),
            page.given.support,
            ground_of(page.given),
            page.answer?.values.support,
        ]);

    function make() {
        const moving = formulation_of(page.given) === "static" ? "static" : "steady";
        const focus = document.activeElement,
            kept =
                focus &&
                host.contains(focus) &&
                (focus.dataset.knob
                    ? `[data-knob="${focus.dataset.knob}"]`
                    : focus.id
                      ? `#${focus.id}`
                      : focus.name
                        ? `[name="${focus.name}"]:checked`
                        : null);
        knobs = [];
        const preset = html(
            "select",
            {
                id: "preset",
                "aria-label": words.start,
                onchange: () => {
                    if (PRESETS[preset.value]) page.change({ ...PRESETS[preset.value] });
                },
            },
            html("option", { value: "" }, `${words.start} …`),
            ...Object.keys(PRESETS).map((name) => html("option", { value: name }, words.presets[name])),
        );
        const file = html("input", {
            type: "file",
            id: "file",
            accept: ".ini,text/plain",
            hidden: true,
            "aria-label": words.open_file,
            onchange: () => {
                if (file.files[0]) page.open_file(file.files[0]);
            },
        });
        host.replaceChildren(
            preset,
            file,
            html(
                "div",
                { class: "row" },
                html(
                    "button",
                    { type: "button", class: "button open", id: "open-file", onclick: () => file.click() },
                    words.open_file,
                ),
                html(
                    "button",
                    {
                        type: "button",
                        class: "button open",
                        id: "open-signs",
                        "aria-haspopup": "dialog",
                        onclick: () => document.getElementById("signs").showModal(),
                    },
                    words.signs,
                ),
            ),
            group(
                words.groups.problem,
                segments("formulation", words.groups.problem, Object.entries(words.formulations), moving, (to) =>
                    page.change(with_motion(page.given, to, numbers())),
                ),
            ),
            held_group(words.groups.normal, "normal", NORMAL, NORMAL, "approach"),
            held_group(
                words.groups.tangential,
                "tangential",
                TANGENTIAL[moving],
                ALL_TANGENTIAL,
                TANGENTIAL[moving][moving === "static" ? 2 : 0],
            ),
            group(
                words.groups.friction,
                knob("mu", (text) => page.change(page.with_mu(page.given, text))),
            ),
            group(
                words.groups.body,
                segments(
                    "support",
                    words.support_label,
                    Object.entries(words.supports),
                    page.given.support ?? "arc",
                    (kind) => page.change(with_support(page.given, kind)),
                ),
                segments("ground", words.body_label, Object.entries(words.bodies), ground_of(page.given), ground),
                knob("radius", set("radius")),
                knob("young", set("young")),
                knob("poisson", set("poisson")),
            ),
            group(words.groups.mesh, knob("contact-elements", set("contact-elements"))),
            html("fieldset", {}, all_options()),
        );
        if (kept) host.querySelector(kept)?.focus();
    }
    host.setAttribute("aria-label", words.controls);
    host.addEventListener("submit", (event) => event.preventDefault());
    return {
        draw() {
            if (!store.holding && structure() !== made_for) {
                made_for = structure();
                make();
            }
            const text = JSON.stringify([page.given, page.answer?.values, made_for]);
            if (text === draw_kept) return;
            draw_kept = text;
            for (const sync of knobs) sync();
        },
    };
}
