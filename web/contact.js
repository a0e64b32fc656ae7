/* The workbench's pictures: tractions, zones and slip; the numbers; the creep curve with a point that can be dragged. */
import {
    ONE_COLUMN,
    chart,
    html,
    legend,
    line,
    segments,
    show,
    show_notes,
    stairs,
    stroke,
    svg,
    ticks,
    width_of,
    zone_colours,
} from "./draw.js";
import { make_draggable } from "./knob.js";
import { matters_card } from "./matters.js";
import { proof_card } from "./proof.js";
import { ALL_TANGENTIAL, formulation_of, hold } from "./state.js";
import { fill_in } from "./words.js";

const edges = (c) => [...c.x].map((x, i) => x - c.h[i] / 2).concat(c.x.at(-1) + c.h.at(-1) / 2);
const most_of = (list) => list.reduce((most, v) => Math.max(most, Math.abs(v) || 0), 0);

export const edges_of_equal = (c) => [c.x[0] - c.h[0] / 2, c.x.at(-1) + c.h.at(-1) / 2];

/* The window on x: the contact and a bit beside it. */
export function window_of(numbers, ends) {
    const { contact_from: from, contact_to: to } = numbers;
    if (!(to > from)) return [ends[0], ends.at(-1)];
    const beside = 0.3 * (to - from);
    return [from - beside, to + beside];
}

/* What friction may be at each element: mu p with the coefficients of the friction law, or the yield stress of
 * the layer between the surfaces; null where the columns do not say. */
export function bounds_of({ columns: c, values }) {
    const mu = Number(values.mu.split(",")[0]),
        yields = Number(values["yield-stress"]) || 0,
        hardening = Number(values.hardening) || 0;
    const varies = values["friction-law"] !== "constant" || Boolean(Number((values["mu-heat"] ?? "").split(",")[0]));
    if ((varies && !c.mu) || (yields && !c.plastic)) return null;
    return [...c.p].map((p, i) =>
        Math.min((c.mu ? c.mu[i] : mu) * p, yields ? Math.max(yields + hardening * c.plastic[i], 0) : Infinity),
    );
}

/* Axes that hold still: { x, top, low, slip } of an answer, and whether they still do for another one. */
export function axes_of(answer) {
    const { columns: c, numbers } = answer,
        bounds = bounds_of(answer);
    const top = 1.12 * most_of(c.p) || 1;
    return {
        x: window_of(numbers, edges(c)),
        top,
        low: -1.15 * Math.max(bounds ? most_of(bounds) : 0, most_of(c.q), 0.1 * top),
        slip: slip_of(c).most,
    };
}
export function axes_still_fit(axes, answer) {
    const { columns: c, numbers: n } = answer,
        wide = axes.x[1] - axes.x[0],
        p = most_of(c.p),
        q = most_of(c.q);
    return (
        n.contact_from >= axes.x[0] &&
        n.contact_to <= axes.x[1] &&
        n.contact_to - n.contact_from > 0.22 * wide &&
        p <= axes.top &&
        p > 0.28 * axes.top &&
        q <= -axes.low
    );
}
function slip_of(c) {
    const slip = [...c.slip].map((v, i) => (c.zone[i] > 1 && Number.isFinite(v) ? v : 0));
    return { slip, most: most_of(slip) };
}

/* The same in x/a and p/p0. */
export function scaled(answer) {
    const { columns: c, numbers: n } = answer,
        a = n.half_width || 1,
        p0 = n.max_pressure || 1,
        middle = (n.contact_from + n.contact_to) / 2 || 0;
    const over = (list, by, from = 0) => list && Float64Array.from(list, (v) => (v - from) / by);
    return {
        ...answer,
        columns: { ...c, x: over(c.x, a, middle), h: over(c.h, a), p: over(c.p, p0), q: over(c.q, p0) },
        values: {
            ...answer.values,
            "yield-stress": String((Number(answer.values["yield-stress"]) || 0) / p0),
            hardening: String((Number(answer.values.hardening) || 0) / p0),
        },
        numbers: { ...n, contact_from: (n.contact_from - middle) / a, contact_to: (n.contact_to - middle) / a },
    };
}

/* options: width, height, axes, forms: { x, p, q } of closed forms, ghost: another answer, units: [of x, of stress], name. */
export function tractions_picture(host, words, answer, options = {}) {
    const { columns: c } = answer,
        width = options.width ?? width_of(host),
        ends = edges(c),
        bounds = options.bounds === false ? null : bounds_of(answer);
    const { x, top, low, slip: slip_axis } = options.axes ?? axes_of(answer),
        { slip, most } = slip_of(c),
        slip_top = Math.max(slip_axis || 0, most);
    const small = innerHeight < 1000 && width < 560,
        height =
            options.height ??
            Math.round(Math.max(small ? Math.min(190, 0.34 * innerHeight) : 250, Math.min(420, width * 0.44))),
        strip = 26;
    const below = options.slip === false ? 8 : 84,
        total = height + strip + below + 46;
    const plot = chart({
        width,
        height: total,
        x,
        y: [low, top],
        y_label: options.units?.[1] ?? words.mpa,
        bottom: strip + below + 46,
        label: fill_in(words.tractions_alt, {
            unit: options.units ? "p₀" : words.mpa,
            p0: show(most_of(c.p)),
            qmin: show(Math.min(...c.q)),
            qmax: show(Math.max(...c.q)),
        }),
    });
    const { root, X, Y } = plot,
        id = `clip-${options.name ?? "a"}`,
        inner = svg("g", { "clip-path": `url(#${id})` });
    root.append(
        svg(
            "clipPath",
            { id },
            svg("rect", { x: plot.left, y: 0, width: width - plot.left - plot.right, height: total }),
        ),
        inner,
    );
    const at = (list, xs = c.x) => line([...xs].map((v, i) => [X(v), Y(list[i])]));
    /* The state before, where the axis has room for it. */
    if (options.ghost && most_of(options.ghost.columns.p) < 1.5 * top) {
        const g = options.ghost.columns;
        inner.append(
            svg("path", {
                class: "ghost",
                d: at(g.p, g.x),
                style: stroke("--press", 1.6, "stroke-dasharray:2 5;opacity:.75"),
            }),
            (options.bounds !== false &&
                svg("path", {
                    class: "ghost",
                    d: at(g.q, g.x),
                    style: stroke("--rub", 1.6, "stroke-dasharray:2 5;opacity:.75"),
                })) ||
                "",
        );
    }
    inner.append(
        svg("path", {
            d: `M${X(c.x[0])} ${Y(0)}L${at(c.p).slice(1)}L${X(c.x.at(-1))} ${Y(0)}Z`,
            style: "fill:var(--press-fill);stroke:none",
        }),
        ...(bounds ? [1, -1] : []).map((sign) =>
            svg("path", { d: at(bounds.map((b) => sign * b)), style: stroke("--soft", 1.4, "stroke-dasharray:2 4") }),
        ),
        svg("path", { class: "p", d: at(c.p), style: stroke("--press", 2.4) }),
        svg("path", { class: "q", d: at(c.q), style: stroke("--rub", 3) }),
    );
    if (options.forms)
        inner.append(
            ...["p", "q"].map((name) =>
                svg("path", {
                    d: at(options.forms[name], options.forms.x),
                    style: stroke("--reference", 1.6, "stroke-dasharray:7 5"),
                }),
            ),
        );
    const y_strip = height + 6;
    for (const node of zone_strip(c, ends, X, y_strip, strip - 8)) inner.append(node);
    let base = y_strip + strip;
    if (options.slip !== false) {
        const middle = base + 36,
            S = (v) => middle - (v / (slip_top || 1)) * 30;
        inner.append(
            svg("path", { d: `M${plot.left} ${middle}H${width}`, style: stroke("--soft", 1) }),
            svg("path", { d: stairs(ends, slip, X, S), style: stroke("--slip", 2) }),
        );
        if (slip_top)
            root.append(
                svg(
                    "text",
                    { x: plot.left - 8, y: middle - 20, "text-anchor": "end", class: "soft" },
                    show(slip_top, 2),
                ),
            );
        root.append(
            svg("text", { x: plot.left - 8, y: middle + 4, "text-anchor": "end", class: "soft" }, words.slip_axis),
        );
        base += 76;
    }
    root.append(
        svg(
            "text",
            { x: width - plot.right, y: base + 38, "text-anchor": "end", class: "soft" },
            options.units?.[0] ?? words.x_axis,
        ),
    );
    for (const v of ticks(...x, Math.max(3, width / 95)))
        root.append(
            svg("path", { d: `M${X(v)} ${base}v5`, style: "stroke:var(--soft)" }),
            svg("text", { x: X(v), y: base + 19, "text-anchor": "middle", class: "soft" }, show(v, 3)),
        );
    root.append(svg("path", { d: `M${plot.left} ${base}H${width - plot.right}`, style: "stroke:var(--soft)" }));
    return root;
}

/* The zones as a strip: colours, and a pattern of lines in what slips or yields. */
export function zone_strip(c, ends, X, y, tall) {
    return zone_colours.flatMap((colour, zone) => {
        const own = [...c.zone.keys()].filter((i) => c.zone[i] === zone);
        if (!own.length) return [];
        const cells = own
            .map(
                (i) =>
                    `M${X(ends[i]).toFixed(1)} ${y}h${Math.max(0.5, X(ends[i + 1]) - X(ends[i]) - 0.6).toFixed(1)}v${tall}H${X(ends[i]).toFixed(1)}Z`,
            )
            .join("");
        const lean = zone === 3 || zone === 5 ? -1 : 1,
            hatch = [];
        if (zone > 1)
            for (const i of own)
                for (let at = X(ends[i]); at < X(ends[i + 1]) - 1; at += 6)
                    hatch.push(
                        `M${at.toFixed(1)} ${y + (lean > 0 ? tall : 0)}l${Math.min(6, X(ends[i + 1]) - at).toFixed(1)} ${-lean * tall}`,
                    );
        return [
            svg("path", { style: `fill:var(${colour})`, d: cells }),
            hatch.length &&
                svg("path", { d: hatch.join(""), style: "fill:none;stroke:var(--card);stroke-width:1.3;opacity:.75" }),
        ].filter(Boolean);
    });
}

export const tractions_legend = (words, zones, closed) =>
    legend(
        ["--press", words.pressure],
        ["--rub", words.friction],
        ["--soft", [...zones].some((z) => z > 3) ? words.bounds : words.bound, "dotted"],
        ...(closed ? [["--reference", words.hertz, "dashed"]] : []),
        ...[...zone_colours.keys()]
            .filter((z) => [...zones].includes(z))
            .map((z) => [zone_colours[z], words.zones[z], z > 1 ? "hatched" : undefined]),
    );

/* Which options hold which number, so that it can be marked; and what a number is small against. */
const HOLDS = {
    normal_load: ["load"],
    half_width: ["half-width"],
    approach: ["approach"],
    tangential_load: ["force"],
    force_ratio: ["force-ratio"],
    creepage: ["creep", "creep-ratio"],
};
const ROUNDING = 1e-10;
/* Without what rounding leaves of a zero. */
export function tidy_number(name, n) {
    const scale = { tangential_load: n.normal_load, force_ratio: 1, creepage: 1e-3 }[name];
    return scale && Math.abs(n[name]) < ROUNDING * scale ? 0 : n[name];
}

function number_row(words, { numbers: n }, units, given) {
    const is_held = (name) => HOLDS[name]?.some((option) => option in given);
    const entry = (name, value, unit) =>
        html(
            "div",
            { class: is_held(name) ? "held" : "" },
            html("dt", {}, words.numbers[name], is_held(name) && html("span", {}, words.held)),
            html("dd", { "data-number": name }, value, " ", html("small", {}, unit)),
        );
    return html(
        "dl",
        { class: "card numbers" },
        ...[
            "normal_load",
            "tangential_load",
            "force_ratio",
            "max_pressure",
            "half_width",
            "approach",
            "creepage",
            "strain_energy",
        ].map((name) => entry(name, show(tidy_number(name, n)), units[name] === "-" ? "" : (units[name] ?? ""))),
        entry("stick", n.contact ? `${Math.round((100 * n.stick) / n.contact)} %` : "–", ""),
    );
}

const FAR = 1.45; /* of the creep curve's axis */

/* The curve of a case and the point of an answer on it; set(creep ratio), or set(force ratio) by set_force, where a
 * hand drags the point sideways, or up and down. */
export function creep_curve(words, { width, height, curve, old, numbers: n, store, set, set_force, name, ghost }) {
    const plot = chart({
        width,
        height,
        x: [-FAR, FAR],
        y: [-1.12, 1.12],
        x_label: words.curve_x,
        y_label: words.curve_y,
        label: words.curve_title,
        y_ticks: 4,
    });
    const { root, X, Y } = plot;
    root.removeAttribute("role");
    root.append(svg("path", { d: `M${X(0)} ${plot.top}V${height - plot.bottom}`, style: stroke("--soft", 1) }));
    if (ghost)
        root.append(
            svg("path", {
                class: "ghost",
                d: line([...ghost.creep_ratio].map((s, k) => [X(s), Y(ghost.force_ratio[k])])),
                style: stroke("--rub", 1.4, "stroke-dasharray:2 5"),
            }),
        );
    if (curve?.creep_ratio)
        root.append(
            svg("path", {
                class: `curve${old ? " old" : ""}`,
                d: line([...curve.creep_ratio].map((s, k) => [X(s), Y(curve.force_ratio[k])])),
                style: stroke("--rub", 3),
            }),
        );
    if (!Number.isFinite(n?.creep_ratio) || !Number.isFinite(n.force_ratio)) return root;
    const at = [Math.max(-FAR, Math.min(FAR, n.creep_ratio)), n.force_ratio],
        off = at[0] !== n.creep_ratio;
    const point = svg("circle", {
        cx: X(at[0]),
        cy: Y(at[1]),
        r: 10,
        class: "handle",
        tabindex: 0,
        role: "slider",
        "aria-label": words.curve_point,
        "aria-valuemin": -FAR,
        "data-handle": name,
        "aria-valuemax": FAR,
        "aria-valuenow": n.creep_ratio.toFixed(3),
        "aria-valuetext": fill_in(words.curve_value, { s: show(n.creep_ratio, 3), f: show(n.force_ratio, 3) }),
        style: "fill:var(--accent);stroke:var(--card);stroke-width:3;touch-action:none",
    });
    make_draggable(store, point, (event) => {
        const zoom = width / root.getBoundingClientRect().width,
            start = [event.clientX, event.clientY];
        let way = null;
        return (e) => {
            const [dx, dy] = [e.clientX - start[0], e.clientY - start[1]];
            way ??= Math.hypot(dx, dy) > 4 ? (Math.abs(dx) > Math.abs(dy) ? "side" : "up") : null;
            if (way === "side")
                set(Math.max(-FAR, Math.min(FAR, at[0] + (dx * zoom * 2 * FAR) / (width - plot.left - plot.right))));
            if (way === "up")
                set_force(
                    Math.max(-0.99, Math.min(0.99, at[1] - (dy * zoom * 2.24) / (height - plot.top - plot.bottom))),
                );
        };
    });
    point.addEventListener("keydown", (event) => {
        const side = { ArrowRight: 0.02, ArrowLeft: -0.02 }[event.key],
            up = { ArrowUp: 0.02, ArrowDown: -0.02, PageUp: 0.1, PageDown: -0.1 }[event.key];
        if (!side && !up) return;
        event.preventDefault();
        if (side) set(Math.max(-FAR, Math.min(FAR, at[0] + side)));
        else set_force(Math.max(-0.99, Math.min(0.99, at[1] + up)));
    });
    root.append(
        svg("path", {
            d: `M${plot.left} ${Y(at[1])}H${X(at[0])}V${height - plot.bottom}`,
            style: stroke("--accent", 1.2, "stroke-dasharray:3 4"),
        }),
        point,
    );
    if (off)
        root.append(
            svg(
                "text",
                {
                    x: X(at[0]) + (at[0] > 0 ? -14 : 14),
                    y: Y(at[1]) - 14,
                    "text-anchor": at[0] > 0 ? "end" : "start",
                    class: "off",
                },
                at[0] > 0 ? `${show(n.creep_ratio, 3)} →` : `← ${show(n.creep_ratio, 3)}`,
            ),
        );
    return root;
}
/* Of a case: what its curve is asked for. */
export const curve_request = (given, slot) => {
    const of = hold(given, ALL_TANGENTIAL, "creep-ratio", "0.5");
    return { kind: "curve", slot, given: of, key: JSON.stringify(of), from: -1.4, to: 1.4, points: 57 };
};

export function contact_view(words, page) {
    const { store } = page,
        matters = matters_card(words, page),
        proof = proof_card(words),
        phone = matchMedia(ONE_COLUMN);
    let curve = null,
        curve_key = "",
        closed = null,
        proved = null,
        axes = null,
        is_scaled = false,
        drawn_for = null;
    const numbers = html("div"),
        tractions = html("figure"),
        curve_host = html("figure"),
        note = html("p", { class: "note" }),
        notes = html("ul", { class: "notes" });
    const legend_row = html("div"),
        unit_switch = segments("units", words.units_title, Object.entries(words.units), "plain", (value) => {
            is_scaled = value === "scaled";
            axes = null;
            drawn_for = null;
            draw();
        });
    const curve_note = html("p", { class: "note" });
    const tractions_card = html(
        "section",
        { class: "card tractions" },
        html("h3", {}, words.tractions_title),
        tractions,
    );
    const node = html(
        "div",
        { class: "stack contact" },
        numbers,
        notes,
        tractions_card,
        html("div", { class: "beside" }, unit_switch, legend_row, note),
        proof.node,
        html("section", { class: "card" }, html("h3", {}, words.curve_title), curve_host, curve_note),
        matters.node,
    );
    const drives = () => formulation_of(page.given) === "steady";
    const wanted_curve = () => curve_request(page.given, "curve bench");
    function wants() {
        if (store.holding || store.trouble("main")) return matters.wants();
        const all = [{ kind: "closed", slot: "closed bench", given: page.given }];
        if (proved?.given !== page.given) all.push({ kind: "prove", slot: "proof bench", given: page.given });
        if (drives() && Number(page.given.mu ?? 0.3) !== 0 && curve_key !== wanted_curve().key)
            all.push(wanted_curve());
        return all.concat(matters.wants());
    }
    function take(answer, request) {
        if (answer.kind === "derivatives") return matters.take(answer, request);
        if (answer.kind === "closed") closed = answer.refused ? null : { ...answer, given: request.given };
        else if (answer.kind === "prove") proved = { ...answer, given: request.given };
        else if (answer.kind === "curve") [curve, curve_key] = [answer.refused ? null : answer.points, request.key];
        drawn_for = null;
        draw();
    }
    const forms_of = (answer) =>
        closed?.given === answer.given && closed["closed.p"]
            ? { x: answer.columns.x, p: closed["closed.p"].at, q: closed["closed.q"].at }
            : null;

    function draw() {
        matters.draw();
        const a = page.answer,
            key = [a, closed, proved, curve, store.ghosts.main, is_scaled, store.trouble("main"), store.holding];
        if (!a || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        const trouble = store.trouble("main"),
            width = width_of(tractions),
            curve_width = width_of(curve_host);
        node.classList.toggle("stale", Boolean(trouble));
        numbers.replaceChildren(number_row(words, a, page.units, page.given));
        show_notes(notes, a);
        const ghost = store.ghosts.main && store.ghosts.main !== a ? store.ghosts.main : null,
            drawn = is_scaled ? scaled(a) : a;
        if (is_scaled)
            axes = { x: [-1.55, 1.55], top: 1.12, low: -Math.max(0.45, 1.15 * most_of(drawn.columns.q)), slip: 0 };
        else if (!axes || (!store.holding && !axes_still_fit(axes, a))) axes = axes_of(a);
        const forms = forms_of(a),
            shown =
                is_scaled && forms
                    ? {
                          x: drawn.columns.x,
                          p: forms.p.map((v) => v / a.numbers.max_pressure),
                          q: forms.q.map((v) => v / a.numbers.max_pressure),
                      }
                    : forms;
        tractions.replaceChildren(
            tractions_picture(tractions, words, drawn, {
                width,
                axes,
                ...(phone.matches && {
                    height: Math.max(120, Math.min(240, Math.round(0.18 * innerHeight))),
                    slip: false,
                }),
                forms: shown,
                ghost: ghost && (is_scaled ? scaled(ghost) : ghost),
                units: is_scaled ? ["x/a", "p/p₀"] : undefined,
                name: "bench",
            }),
        );
        legend_row.replaceChildren(
            tractions_legend(words, a.columns.zone, Boolean(forms)),
            ghost ? html("p", { class: "note" }, words.ghost) : "",
        );
        note.textContent = fill_in(words.solved_in, {
            contact: a.numbers.contact,
            stick: a.numbers.stick,
            ms: show(a.milliseconds, 2),
            residual: show(a.numbers.residual, 2),
        });
        proof.show(proved?.given === a.given ? proved : null);
        draw_curve(curve_width, a);
    }
    function draw_curve(width, a) {
        const can = drives() && Number.isFinite(a.numbers.creep_ratio);
        curve_note.textContent = !drives()
            ? words.curve_none
            : can
              ? words.curve_note + (a.numbers.carter === 1 ? ` ${words.curve_carter}` : "")
              : words.curve_smooth;
        if (!can) return curve_host.replaceChildren();
        const focused = curve_host.contains(document.activeElement);
        curve_host.replaceChildren(
            creep_curve(words, {
                width,
                height: Math.round(Math.min(400, Math.max(280, width * 0.5))),
                curve,
                old: curve_key !== wanted_curve().key,
                numbers: a.numbers,
                store,
                name: "bench",
                set: (s) => page.change(hold(page.given, ALL_TANGENTIAL, "creep-ratio", String(Number(s.toFixed(3))))),
                set_force: (f) =>
                    page.change(hold(page.given, ALL_TANGENTIAL, "force-ratio", String(Number(f.toFixed(3))))),
            }),
        );
        if (focused) curve_host.querySelector(".handle")?.focus();
    }
    return {
        node,
        tractions: tractions_card,
        draw,
        wants,
        take,
        busy: () => false,
        resize() {
            drawn_for = null;
            axes = null;
        },
        curve_is_old: () => curve_key !== wanted_curve().key,
    };
}
