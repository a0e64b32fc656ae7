/* See and touch: the wheel, the strip, the tractions, slip and zones, the creep curve. */
import { card, chart, html, legend, line, show, stairs, stroke, svg, ticks, width_of, zone_colours } from "./draw.js";
import { ALL_TANGENTIAL, formulation_of, hold } from "./state.js";
import { say } from "./words.js";

const edges = (c) => [...c.x].map((x, i) => x - c.h[i] / 2).concat(c.x.at(-1) + c.h.at(-1) / 2);

/* The window on x: the contact and a bit beside it. */
export function window_of(numbers, ends) {
    const { contact_from: from, contact_to: to } = numbers;
    if (!(to > from)) return [ends[0], ends.at(-1)];
    const beside = 0.22 * (to - from);
    return [from - beside, to + beside];
}

/* Hertz and Carter where they hold: pressure and friction at x. */
function closed_forms({ hertz_half_width: a, normal_load: P, creep_ratio: s, carter }, mu) {
    if (carter !== 1) return null;
    const p0 = 2 * P / (Math.PI * a), stuck = Math.max(0, 1 - Math.abs(s)), b = stuck * a, middle = a - b;
    const ellipse = (x, half) => half > 0 && Math.abs(x) < half ? Math.sqrt(1 - (x / half) ** 2) : 0;
    return { p: (x) => p0 * ellipse(x, a), q: (x) => -Math.sign(s) * mu * p0 * (ellipse(x, a) - stuck * ellipse(x - middle, b)) };
}

/* What friction may be at each element: mu p with the coefficients of the friction law, or the yield stress of
 * the layer between the surfaces; null where the columns do not say. */
export function bounds_of({ columns: c, values }) {
    const mu = Number(values.mu.split(",")[0]), yields = Number(values["yield-stress"]) || 0, hardening = Number(values.hardening) || 0;
    const varies = values["friction-law"] !== "constant" || Boolean(Number((values["mu-heat"] ?? "").split(",")[0]));
    if ((varies && !c.mu) || (yields && !c.plastic)) return null;
    return [...c.p].map((p, i) => Math.min((c.mu ? c.mu[i] : mu) * p, yields ? Math.max(yields + hardening * c.plastic[i], 0) : Infinity));
}

export function tractions_picture(host, words, { columns: c, numbers, values }, options = {}) {
    const width = options.width ?? width_of(host), ends = edges(c), mu = Number(values.mu.split(",")[0]), bounds = bounds_of({ columns: c, values });
    const x = options.window ?? window_of(numbers, ends);
    const most_p = options.top ?? Math.max(...c.p), top = most_p * 1.12 || 1, low = -Math.max(bounds && !options.top ? Math.max(...bounds) : mu * most_p, ...[...c.q].map(Math.abs)) * 1.15;
    const slip = [...c.slip].map((v, i) => c.zone[i] > 1 && Number.isFinite(v) ? v : 0), has_slip = slip.some((v) => v !== 0);
    const height = Math.round(Math.max(innerHeight < 1000 && width < 560 ? 190 : 260, Math.min(430, width * 0.46))), strip = 26, below = has_slip ? 84 : 8;
    const plot = chart({ width, height: height + strip + below + 46, x, y: [low, top], y_label: words.mpa, bottom: strip + below + 46,
        label: say(words.tractions_alt, { p0: show(Math.max(...c.p)), qmin: show(Math.min(...c.q)), qmax: show(Math.max(...c.q)) }) });
    const { root, X, Y } = plot;
    const id = `clip${options.name ?? "a"}`, inner = svg("g", { "clip-path": `url(#${id})` });
    root.append(svg("clipPath", { id }, svg("rect", { x: plot.left, y: 0, width: width - plot.left - plot.right, height: height + strip + below + 46 })), inner);
    const at = (values) => line([...c.x].map((v, i) => [X(v), Y(values[i])]));
    inner.append(
        svg("path", { d: `M${X(c.x[0])} ${Y(0)}L${at(c.p).slice(1)}L${X(c.x.at(-1))} ${Y(0)}Z`, style: "fill:var(--press-fill);stroke:none" }),
        ...(bounds ? [1, -1] : []).map((sign) => svg("path", { d: at(bounds.map((b) => sign * b)), style: stroke("--soft", 1.4, "stroke-dasharray:2 4") })),
        svg("path", { d: at(c.p), style: stroke("--press", 2.4) }),
        svg("path", { d: at(c.q), style: stroke("--rub", 3) }));
    const forms = options.forms === false ? null : closed_forms(numbers, mu);
    if (forms) {
        const a = numbers.hertz_half_width, way = Array.from({ length: 201 }, (_, k) => a * Math.sin((k / 100 - 1) * Math.PI / 2));
        inner.append(...[forms.p, forms.q].map((f) => svg("path", { d: line(way.map((v) => [X(v), Y(f(v))])), style: stroke("--reference", 1.6, "stroke-dasharray:7 5") })));
    }
    const y_strip = height + 6;
    zone_colours.forEach((colour, zone) => inner.append(svg("path", { style: `fill:var(${colour})`, d: [...c.zone.keys()].filter((i) => c.zone[i] === zone)
        .map((i) => `M${X(ends[i]).toFixed(1)} ${y_strip}h${Math.max(0.5, X(ends[i + 1]) - X(ends[i]) - 0.6).toFixed(1)}v${strip - 8}H${X(ends[i]).toFixed(1)}Z`).join("") })));
    let base = y_strip + strip;
    if (has_slip) {
        const most = Math.max(...slip.map(Math.abs));
        const middle = base + 36, S = (v) => middle - v / most * 30;
        inner.append(svg("path", { d: `M${plot.left} ${middle}H${width}`, style: stroke("--soft", 1) }),
            svg("path", { d: stairs(ends, slip, X, S), style: stroke("--slip", 2) }));
        root.append(svg("text", { x: plot.left - 8, y: middle - 14, "text-anchor": "end", class: "soft" }, show(most, 2)), svg("text", { x: plot.left - 8, y: middle + 4, "text-anchor": "end", class: "soft" }, words.slip_axis));
        base += 76;
    }
    root.append(svg("text", { x: width - plot.right, y: base + 36, "text-anchor": "end", class: "soft" }, words.x_axis));
    for (const v of ticks(...x, Math.max(3, width / 95)))
        root.append(svg("path", { d: `M${X(v)} ${base}v5`, style: "stroke:var(--soft)" }), svg("text", { x: X(v), y: base + 19, "text-anchor": "middle", class: "soft" }, show(v, 3)));
    root.append(svg("path", { d: `M${plot.left} ${base}H${width - plot.right}`, style: "stroke:var(--soft)" }));
    return root;
}

export const tractions_legend = (words, numbers, zones) => legend(["--press", words.pressure], ["--rub", words.friction], ["--soft", [...zones].some((z) => z > 3) ? words.bounds : words.bound, "dotted"],
    ...(numbers.carter === 1 ? [["--reference", words.hertz, "dashed"]] : []), ...[...zone_colours.keys()].filter((z) => [...zones].includes(z)).map((z) => [zone_colours[z], words.zones[z]]));

const arrow = (x0, y0, x1, y1, colour, width = 2.5) => {
    const long = Math.hypot(x1 - x0, y1 - y0), ux = (x1 - x0) / long, uy = (y1 - y0) / long, h = 9;
    return svg("path", { d: `M${x0} ${y0}L${x1} ${y1}M${x1 - h * ux - h * 0.55 * uy} ${y1 - h * uy + h * 0.55 * ux}L${x1} ${y1}L${x1 - h * ux + h * 0.55 * uy} ${y1 - h * uy - h * 0.55 * ux}`,
        style: stroke(colour, width, "stroke-linecap:round") });
};

/* The wheel to scale on the left; on the right the strip, its heights magnified. */
function scene(width, words, { columns: c, numbers: n, values }, given) {
    const narrow = width < 560, wheel = narrow ? width : Math.min(300, width * 0.34), height = 250;
    const R = Number(values.radius), scale = 82 / R, cx = wheel / 2, ground = 212, cy = ground - 82;
    const total = narrow ? 2 * height : height;
    const root = svg("svg", { viewBox: `0 0 ${width} ${total}`, width, height: total, role: "img" });
    const rolls = formulation_of(given) !== "static", support = values.support;
    root.append(svg("path", { d: `M8 ${ground}H${wheel - 8}`, style: stroke("--ink", 2) }));
    for (let x = 14; x < wheel - 8; x += 13) root.append(svg("path", { d: `M${x} ${ground + 1}l-7 8`, style: stroke("--soft", 1) }));
    root.append(svg("circle", { cx, cy, r: 82, style: `fill:var(--press-fill);stroke:var(--ink);stroke-width:2${support === "halfplane" ? ";stroke-dasharray:6 5" : ""}` }));
    if (support === "hub") root.append(svg("circle", { cx, cy, r: 82 * Number(values["hub-ratio"]), style: "fill:var(--apart);stroke:var(--ink);stroke-width:1.5" }));
    if (support === "arc") {
        const half = Number(values.arc) * Math.PI / 180;
        root.append(svg("path", { d: `M${cx - 82 * Math.sin(half)} ${cy - 82 * Math.cos(half)}A82 82 0 0 1 ${cx + 82 * Math.sin(half)} ${cy - 82 * Math.cos(half)}`, style: stroke("--ink", 7) }));
    }
    const half = Math.max(2, n.half_width * scale);
    root.append(svg("path", { d: `M${cx - half} ${ground}H${cx + half}`, style: stroke("--slip", 6) }));
    root.append(arrow(cx, cy - 46, cx, cy + 8, "--ink"), svg("text", { x: cx + 9, y: cy - 24, class: "big" }, "P"));
    if (n.tangential_load) {
        const way = Math.sign(n.tangential_load);
        root.append(arrow(cx - 14 * way, ground - 14, cx + 30 * way, ground - 14, "--rub"), svg("text", { x: cx + 52 * way, y: ground - 10, class: "big", "text-anchor": way > 0 ? "start" : "end" }, "Q"));
    }
    if (rolls) root.append(arrow(cx - 34, 22, cx + 34, 22, "--soft"));
    root.append(svg("text", { x: cx, y: 14, "text-anchor": "middle", class: "soft" }, rolls ? words.rolls : words.at_rest),
        svg("text", { x: cx, y: 242, "text-anchor": "middle", class: "soft" }, say(words.to_scale, { radius: show(R) })));

    /* B takes its share of the displacement where it is elastic, relative to the ends of the strip. */
    const ends = edges(c), x = window_of(n, ends), left = narrow ? 10 : wheel + 20, from = narrow ? height : 0;
    const share = "similar" in given ? 0.5 : 0, un = [...c.un], datum = Math.max(...un.map((w) => -Math.abs(w)));
    const b = un.map((w) => share * (-Math.abs(w) - datum)), a = b.map((v, i) => v + c.gap[i]);
    const inside = [...c.x.keys()].filter((i) => c.x[i] >= x[0] && c.x[i] <= x[1]);
    const undeformed = inside.map((i) => c.x[i] ** 2 / (2 * n.radius) - Math.max(...inside.map((k) => c.x[k] ** 2)) / (2 * n.radius) + Math.max(...inside.map((k) => a[k])));
    const heights = inside.flatMap((i) => [a[i], b[i]]).concat(undeformed), low = Math.min(...heights), high = Math.max(...heights);
    const X = (v) => left + (v - x[0]) / (x[1] - x[0]) * (width - left - 10), per = (width - left - 10) / (x[1] - x[0]);
    const factor = Number((118 / Math.max(high - low, 1e-12) / per).toPrecision(1)), Y = (v) => from + 66 + (high - v) * per * factor;
    const upper = line(inside.map((i) => [X(c.x[i]), Y(a[i])])), lower = line(inside.map((i) => [X(c.x[i]), Y(b[i])]));
    const first = X(c.x[inside[0]]), last = X(c.x[inside.at(-1)]);
    root.append(svg("path", { d: `M${first} ${from + 36}L${upper.slice(1)}L${last} ${from + 36}Z`, style: "fill:var(--press-fill);stroke:none" }),
        svg("path", { d: `M${first} ${from + 226}L${lower.slice(1)}L${last} ${from + 226}Z`, style: "fill:var(--grid);stroke:none" }),
        svg("path", { d: line(inside.map((i, k) => [X(c.x[i]), Y(undeformed[k])])), style: stroke("--soft", 1.4, "stroke-dasharray:5 5") }),
        svg("path", { d: lower, style: stroke("--ink", 1.6) }), svg("path", { d: upper, style: stroke("--ink", 2.2) }));
    const between = (i, j) => (b[i] + (b[j] ?? b[i])) / 2;
    zone_colours.forEach((colour, zone) => zone && root.append(svg("path", { style: stroke(colour, 5), d: inside.filter((i) => c.zone[i] === zone)
        .map((i) => line([[X(ends[i]), Y(between(i, i - 1))], [X(c.x[i]), Y(b[i])], [X(ends[i + 1]), Y(between(i, i + 1))]])).join("") })));
    root.append(svg("text", { x: (left + width) / 2, y: from + 242, "text-anchor": "middle", class: "soft" }, say(words.magnified, { factor: show(factor, 2) })),
        svg("text", { x: (left + width) / 2, y: from + 56, "text-anchor": "middle", class: "soft" }, words.surface_a));
    root.setAttribute("aria-label", say(words.scene_alt, { width: show(n.contact_to - n.contact_from), factor: show(factor, 2) }));
    return root;
}

/* Which options hold which number, so that it can be marked. */
const HOLDS = { normal_load: ["load"], half_width: ["half-width"], approach: ["approach"], tangential_load: ["force"], force_ratio: ["force-ratio"], creepage: ["creep", "creep-ratio"] };

function number_row(words, { numbers: n }, units, given) {
    const is_held = (name) => HOLDS[name]?.some((option) => option in given);
    const entry = (name, value, unit) => html("div", { class: is_held(name) ? "held" : "" }, html("dt", {}, words.numbers[name], is_held(name) && html("span", {}, words.held)), html("dd", { "data-number": name }, value, " ", html("small", {}, unit)));
    return html("dl", { class: "card numbers", style: "margin:0" },
        ...["normal_load", "tangential_load", "force_ratio", "max_pressure", "half_width", "approach", "creepage"].map((name) => entry(name, show(n[name]), units[name] ?? "")),
        entry("stick", n.contact ? `${Math.round(100 * n.stick / n.contact)} %` : "–", ""));
}

/* The curve and the point of the case on it, which can be dragged. */
function creep_curve(width, words, page) {
    const { answer, curve } = page, n = answer.numbers;
    if (formulation_of(page.given) !== "steady") return html("p", { class: "note" }, words.curve_none);
    const height = Math.round(Math.min(430, Math.max(290, width * 1.15)));
    const plot = chart({ width, height, x: [-1.45, 1.45], y: [-1.12, 1.12], x_label: words.curve_x, y_label: words.curve_y, label: words.curve_title, y_ticks: 4 });
    const { root, X, Y } = plot;
    root.removeAttribute("role");
    root.append(svg("path", { d: `M${X(0)} ${plot.top}V${height - plot.bottom}`, style: stroke("--soft", 1) }));
    if (curve) root.append(svg("path", { class: page.curve_is_old() ? "old" : "", d: line([...curve.creep_ratio].map((s, k) => [X(s), Y(curve.force_ratio[k])])), style: stroke("--rub", 3) }));
    const at = [Math.max(-1.45, Math.min(1.45, n.creep_ratio)), n.force_ratio];
    if (!at.every(Number.isFinite)) return root;
    const point = svg("circle", { cx: X(at[0]), cy: Y(at[1]), r: 10, class: "handle", tabindex: 0, role: "slider", "aria-label": words.curve_point, "aria-valuemin": -0.99,
        "aria-valuemax": 0.99, "aria-valuenow": at[1].toFixed(3), style: "fill:var(--slip);stroke:var(--card);stroke-width:3;touch-action:none" });
    const set = (ratio) => page.change(hold(page.given, ALL_TANGENTIAL, "force-ratio", String(Number(Math.max(-0.99, Math.min(0.99, ratio)).toFixed(3)))), true);
    const ratio_at = (event) => { const box = root.getBoundingClientRect(), y = (event.clientY - box.top) * height / box.height;
        return 1.12 - (y - plot.top) / (height - plot.top - plot.bottom) * 2.24; };
    point.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        const move = (e) => set(ratio_at(e));
        const up = () => { window.removeEventListener("pointermove", move); window.removeEventListener("pointerup", up); };
        window.addEventListener("pointermove", move);
        window.addEventListener("pointerup", up);
    });
    point.addEventListener("keydown", (event) => {
        const step = { ArrowUp: 0.02, ArrowRight: 0.02, ArrowDown: -0.02, ArrowLeft: -0.02, PageUp: 0.1, PageDown: -0.1 }[event.key];
        if (step) { event.preventDefault(); set(at[1] + step); }
    });
    root.append(svg("path", { d: `M${plot.left} ${Y(at[1])}H${X(at[0])}V${height - plot.bottom}`, style: stroke("--slip", 1.2, "stroke-dasharray:3 4") }), point);
    return root;
}

export function contact_view(words, page) {
    let curve_width = 0;
    const numbers = html("div"), figure = html("figure"), tractions = html("figure"), curve = html("figure"), note = html("p", { class: "note", "aria-live": "polite", style: "margin:0" });
    const node = html("div", { class: "stack contact" }, numbers, html("div", { class: "pair" }, html("section", { class: "card tractions" }, html("h2", {}, words.tractions_title), tractions),
        html("div", { class: "stack" }, card(words.curve_title, curve, html("p", { class: "note" }, words.curve_note)), html("div", { class: "card" }, note))),
        card(words.scene_title, figure));
    function draw() {
        const a = page.answer;
        if (!a) return;
        const [tractions_width, scene_width] = [tractions, figure].map(width_of); /* before anything changes: each look is a layout */
        numbers.replaceChildren(number_row(words, a, page.units, page.given));
        tractions.replaceChildren(tractions_picture(tractions, words, a, { width: tractions_width }), tractions_legend(words, a.numbers, a.columns.zone));
        figure.replaceChildren(scene(scene_width, words, a, page.given));
        draw_curve();
        note.textContent = say(words.solved_in, { contact: a.numbers.contact, stick: a.numbers.stick, ms: show(a.milliseconds, 2), residual: show(a.numbers.residual, 2) });
    }
    function draw_curve() {
        const focused = curve.contains(document.activeElement);
        curve.replaceChildren(creep_curve(curve_width ||= width_of(curve), words, page));
        if (focused) curve.querySelector(".handle")?.focus();
    }
    return { node, draw, draw_curve, wants: () => [], resize() { curve_width = 0; draw(); } };
}
