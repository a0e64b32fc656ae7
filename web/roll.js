/* From rest to steady rolling, as an animation of the transient. */
import { card, chart, html, line, player, show, stroke, svg } from "./draw.js";
import { tractions_legend, tractions_picture } from "./contact.js";
import { ALL_TANGENTIAL, TANGENTIAL, held, hold } from "./state.js";
import { say } from "./words.js";

export function roll_view(words, page) {
    let data = null, distance = "5";
    const picture = html("figure"), way = html("figure"), legend_row = html("div");
    const frames = player(words, { label: words.roll_title, milliseconds: 110, see: frame, describe: (k, n) => say(words.roll_step, { k: k + 1, n, distance: data ? show(data.history.distance[k], 3) : "" }) });
    const field = html("input", { type: "range", min: 1, max: 12, step: 1, value: distance, id: "roll-distance", oninput: () => { distance = field.value; page.ask_view(); } });
    const node = html("div", { class: "stack" }, card(words.roll_title, html("p", { class: "note" }, words.roll_note), frames.node, picture, legend_row),
        card(words.roll_curve, way, html("div", { class: "row" }, html("label", { for: "roll-distance" }, words.roll_distance), field)));

    /* The case of the page, rolling from rest on equal elements. */
    function given() {
        const base = held(page.given, TANGENTIAL.steady) ? page.given : hold(page.given, ALL_TANGENTIAL, "creep-ratio", "0.5");
        const elements = Math.min(60, Number(base["contact-elements"] ?? 40) || 40);
        return { ...base, formulation: "transient", distance, mesh: "uniform", "contact-elements": String(elements) };
    }
    function frame(k) {
        if (!data) return;
        const n = data["step.p"].rows, part = (name) => data[name].at.subarray(n * k, n * k + n);
        const columns = { x: data["step.x"].at, h: data.columns.h, p: part("step.p"), q: part("step.q"), zone: part("step.zone"), slip: new Float64Array(n) };
        const ends = data["step.x"].at, half = data.columns.h[0] / 2;
        picture.replaceChildren(tractions_picture(picture, words, { columns, numbers: data.numbers, values: data.values }, { name: "roll", forms: false, window: [ends[0] - half, ends.at(-1) + half] }));
        legend_row.replaceChildren(tractions_legend(words, { carter: 0 }, data["step.zone"].at));
        picture.firstChild.setAttribute("aria-label", say(words.roll_alt, { k: k + 1 }));
        const { distance: d, force_ratio: f } = data.history, width = Math.max(300, Math.min(1100, way.clientWidth)), low = Math.min(0, ...f), high = Math.max(0, ...f);
        const plot = chart({ width, height: 200, x: [0, d.at(-1) || 1], y: [low * 1.1, high * 1.1 || 0.1], x_label: words.roll_x, y_label: words.curve_y, label: words.roll_curve, y_ticks: 4 });
        plot.root.append(svg("path", { d: line([...d].map((v, i) => [plot.X(v), plot.Y(f[i])])), style: stroke("--rub", 3) }),
            svg("circle", { cx: plot.X(d[k]), cy: plot.Y(f[k]), r: 7, style: "fill:var(--slip);stroke:var(--card);stroke-width:2" }));
        way.replaceChildren(plot.root);
    }
    return { node, wants: () => [{ kind: "roll", given: given() }], take(answer) { const first = !data || data["step.p"].columns !== answer["step.p"].columns; data = answer; frames.set(data["step.p"].columns, first ? 0 : undefined); },
        draw() { if (data) frame(frames.at); }, leave: () => frames.stop(), player: frames };
}
