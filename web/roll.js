/* From rest to steady rolling, as an animation of the transient; load, force or creepage drawn by
 * hand over the way. */
import { card, chart, html, line, player, segments, show, stroke, svg, width_of } from "./draw.js";
import { tractions_legend, tractions_picture } from "./contact.js";
import { ALL_TANGENTIAL, DRAWN, TANGENTIAL, held, hold, table_of_drawn } from "./state.js";
import { command_of, text_card } from "./take.js";
import { say } from "./words.js";

const POINTS = 13, FILE = "drawn.tsv", MOST_ELEMENTS = 60;

export function roll_view(words, page) {
    let data = null, distance = page.drawn?.distance ?? 5;
    const picture = html("figure"), way = html("figure"), hand = html("figure"), legend_row = html("div"), same = html("div");
    const frames = player(words, { label: words.roll_title, milliseconds: 90, see: frame, describe: (k, n) => say(words.roll_step, { k: k + 1, n, distance: data ? show(data.history.distance[k], 3) : "" }) });
    const field = html("input", { type: "range", min: 1, max: 12, step: 1, value: distance, id: "roll-distance",
        oninput: () => { distance = Number(field.value); if (page.drawn) page.drawn.distance = distance; changed(); } });
    const what = html("div");
    const node = html("div", { class: "stack" }, card(words.roll_title, html("p", { class: "note" }, words.roll_note), frames.node, picture, legend_row),
        html("div", { class: "pair halves" },
            card(words.roll_curve, way, html("div", { class: "row" }, html("label", { for: "roll-distance" }, words.roll_distance), field)),
            card(words.hand_title, html("p", { class: "note" }, words.hand_note), what, hand)), same);

    /* The case of the page, rolling from rest on equal elements. */
    function given() {
        const base = held(page.given, TANGENTIAL.steady) ? page.given : hold(page.given, ALL_TANGENTIAL, "creep-ratio", "0.5");
        const all = { ...base, formulation: "transient", mesh: "uniform", "contact-elements": String(Math.min(MOST_ELEMENTS, Number(base["contact-elements"] ?? 40) || 40)) };
        if (!page.drawn) return { ...all, distance: String(distance) };
        DRAWN[page.drawn.what].forEach((name) => delete all[name]);
        return { ...all, history: FILE };
    }
    const files = () => page.drawn ? { [FILE]: table_of_drawn(page.drawn) } : {};

    /* ---- Drawn by hand ---- */

    const unit = () => page.drawn.what === "mu" ? words.hand.mu : page.drawn.what === "load" ? words.hand_load : page.drawn.what === "force_ratio" ? words.curve_y : words.curve_x;
    function span() {
        if (page.drawn.what === "mu") return [0.02, Number(Math.max(0.6, ...page.drawn.values).toPrecision(2))];
        if (page.drawn.what !== "load") return page.drawn.what === "force_ratio" ? [-0.95, 0.95] : [-1.4, 1.4];
        const P = Number(page.answer?.numbers.normal_load) || Math.max(...page.drawn.values);
        return [0.1 * P, Number((2 * Math.max(P, ...page.drawn.values.map((v) => v / 2))).toPrecision(2))];
    }
    function choose(kind) {
        if (kind === "none") page.drawn = null;
        else {
            const n = page.answer.numbers, mu = Math.max(0.02, Number(page.answer.values.mu.split(",")[0]));
            const start = { mu, load: n.normal_load, force_ratio: 0, creep_ratio: 0 }[kind], end = { mu: Number((mu / 2).toPrecision(3)), load: n.normal_load, force_ratio: -0.7, creep_ratio: 0.7 }[kind];
            const rise = (k) => kind === "load" ? 1 + 0.5 * Math.sin(2 * Math.PI * k / (POINTS - 1)) : Math.min(1, k / 4);
            page.drawn = { what: kind, distance, values: Array.from({ length: POINTS }, (_, k) => Number((kind === "load" ? start * rise(k) : start + (end - start) * rise(k)).toPrecision(3))) };
        }
        draw_hand();
        changed();
    }
    function changed() { page.remember(); page.ask_view(); }
    function put(k, value) {
        const [low, high] = span();
        page.drawn.values[k] = Number(Math.max(low, Math.min(high, value)).toPrecision(3));
        draw_hand();
        changed();
    }
    function draw_hand() {
        what.replaceChildren(segments("hand", words.hand_title, Object.entries(words.hand), page.drawn?.what ?? "none", choose));
        draw_same();
        if (!page.drawn) return hand.replaceChildren();
        const { values } = page.drawn, last = values.length - 1, [low, high] = span(), focus = [...hand.querySelectorAll("circle")].indexOf(document.activeElement);
        const width = width_of(hand), height = 210, x = [0, page.drawn.distance], y = ["load", "mu"].includes(page.drawn.what) ? [0, high] : [low * 1.1, high * 1.1];
        const plot = chart({ width, height, x, y, x_label: words.roll_x, y_label: unit(), label: words.hand_alt, y_ticks: 4 });
        plot.root.removeAttribute("role");
        plot.root.setAttribute("class", "hand");
        const at = (k) => plot.X(x[1] * k / last);
        plot.root.append(svg("rect", { x: plot.left, y: plot.top, width: width - plot.left - plot.right, height: height - plot.top - plot.bottom, style: "fill:transparent;cursor:crosshair" }),
            svg("path", { d: line(values.map((v, k) => [at(k), plot.Y(v)])), style: stroke("--slip", 2.5) }));
        values.forEach((v, k) => plot.root.append(svg("circle", { cx: at(k), cy: plot.Y(v), r: 6, class: "handle", tabindex: 0, role: "slider", "aria-label": say(words.hand_point, { k: k + 1, distance: show(x[1] * k / last, 2) }),
            "aria-valuemin": low, "aria-valuemax": high, "aria-valuenow": v, style: "fill:var(--slip);stroke:var(--card);stroke-width:2",
            onkeydown: (event) => {
                const step = { ArrowUp: 0.02, ArrowDown: -0.02, PageUp: 0.1, PageDown: -0.1 }[event.key];
                if (step) { event.preventDefault(); put(k, v + step * (high - low)); }
            } })));
        pull = (event) => {
            const box = plot.root.getBoundingClientRect(), px = (event.clientX - box.left) * width / box.width, py = (event.clientY - box.top) * height / box.height;
            put(Math.max(0, Math.min(last, Math.round((px - plot.left) / (width - plot.left - plot.right) * last))),
                y[0] + (height - plot.bottom - py) / (height - plot.top - plot.bottom) * (y[1] - y[0]));
        };
        plot.root.addEventListener("pointerdown", (event) => {
            event.preventDefault();
            const move = (e) => pull(e), up = () => { window.removeEventListener("pointermove", move); window.removeEventListener("pointerup", up); };
            window.addEventListener("pointermove", move);
            window.addEventListener("pointerup", up);
            pull(event);
        });
        hand.replaceChildren(plot.root);
        if (focus >= 0) hand.querySelectorAll("circle")[focus]?.focus();
    }
    let pull; /* by the picture that is shown: it is made anew while the pointer is down */
    function draw_same() {
        same.replaceChildren(...(page.drawn ? [html("div", { class: "pair halves" }, text_card(words, "command", command_of(given(), page.options)), text_card(words, "history", files()[FILE], FILE, "text/tab-separated-values"))] : []));
    }

    /* ---- The steps ---- */

    function frame(k) {
        if (!data) return;
        const n = data["step.p"].rows, part = (name) => data[name].at.subarray(n * k, n * k + n);
        const columns = { x: data["step.x"].at, h: data.columns.h, p: part("step.p"), q: part("step.q"), zone: part("step.zone"), slip: new Float64Array(n), mu: data.history.mu && new Float64Array(n).fill(data.history.mu[k]) };
        const ends = data["step.x"].at, half = data.columns.h[0] / 2;
        picture.replaceChildren(tractions_picture(picture, words, { columns, numbers: data.numbers, values: data.values },
            { name: "roll", forms: false, top: Math.max(...data["step.p"].at), window: [ends[0] - half, ends.at(-1) + half] }));
        legend_row.replaceChildren(tractions_legend(words, { carter: 0 }, data["step.zone"].at));
        picture.firstChild.setAttribute("aria-label", say(words.roll_alt, { k: k + 1 }));
        const { distance: d, force_ratio: f } = data.history, width = width_of(way), low = Math.min(0, ...f), high = Math.max(0, ...f);
        const plot = chart({ width, height: 210, x: [0, d.at(-1) || 1], y: [low * 1.1, high * 1.1 || 0.1], x_label: words.roll_x, y_label: words.curve_y, label: words.roll_curve, y_ticks: 4 });
        plot.root.append(svg("path", { d: line([...d].map((v, i) => [plot.X(v), plot.Y(f[i])])), style: stroke("--rub", 3) }),
            svg("circle", { cx: plot.X(d[k]), cy: plot.Y(f[k]), r: 7, style: "fill:var(--slip);stroke:var(--card);stroke-width:2" }));
        way.replaceChildren(plot.root);
    }
    return { node, player: frames, wants: () => [{ kind: "roll", given: given(), files: files() }], leave: () => frames.stop(), force: () => data.history.force_ratio.at(-1),
        take(answer) { const first = !data || data["step.p"].columns !== answer["step.p"].columns; data = answer; frames.set(data["step.p"].columns, first ? 0 : undefined); },
        draw() { if (page.answer) draw_hand(); if (data) frame(frames.at); } };
}
