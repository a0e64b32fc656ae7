/* From rest to steady rolling: the picture of a step, and under it the way there with the steady value that is
 * reached; load, friction, force or creepage drawn by hand over the way. */
import {
    card,
    chart,
    height_for,
    html,
    in_slides,
    line,
    player,
    segments,
    show,
    show_notes,
    stroke,
    svg,
    width_of,
} from "./draw.js";
import { edges_of_equal, tractions_legend } from "./contact.js";
import { lens_figure } from "./lens.js";
import { make_draggable, slider_for } from "./knob.js";
import { ALL_TANGENTIAL, DRAWN, NORMAL, TANGENTIAL, formulation_of, held, hold, table_of_drawn } from "./state.js";
import { command_of, text_card } from "./take.js";
import { fill_in } from "./words.js";

const POINTS = 13,
    FILE = "drawn.tsv",
    MOST_ELEMENTS = 60,
    MOST_FORCE = 0.97;

export function roll_view(words, page) {
    const { store } = page,
        w = words.roll;
    let data = null,
        steady = null,
        distance = page.drawn?.distance ?? 6,
        by = "force",
        steps_top = 0,
        axes = null,
        drawn_for = null;
    const picture = html("figure"),
        way = html("figure"),
        hand = html("figure"),
        legend_row = html("div"),
        notes = html("ul", { class: "notes" }),
        same = html("div"),
        told = html("p", { class: "note", "aria-live": "polite" });
    const frames = player(words, {
        label: words.roll_title,
        milliseconds: 60,
        see: frame,
        describe: (k, n) =>
            fill_in(words.roll_step, { k: k + 1, n, distance: data ? show(data.history.distance[k], 3) : "" }),
    });
    const field = slider_for(
        store,
        { min: 1, max: 30, step: 1, value: distance, id: "roll-distance", "aria-label": words.roll_distance },
        (value) => {
            distance = value;
            if (page.drawn) page.drawn = { ...page.drawn, distance };
            changed();
        },
    );
    const what = html("div"),
        driven = html("div"),
        drive = page.knob({
            name: "roll-drive",
            label: words.hero.drive,
            from: -1,
            to: 1,
            ends: [words.hero.accelerate, words.hero.brake],
            read: (a) => a.numbers.creep_ratio || -a.numbers.force_ratio || 0,
            write: (v) =>
                page.change(
                    formulation_of(page.given) === "static"
                        ? hold(page.given, ALL_TANGENTIAL, "force-ratio", String(-v))
                        : hold(page.given, ALL_TANGENTIAL, "creep-ratio", String(v)),
                ),
        });
    const node = html(
        "div",
        { class: "two revealed" },
        html("div", { class: "tale" }, html("p", { class: "question" }, w.question), html("p", {}, w.tale), driven),
        card("", frames.node, picture, way, legend_row, notes),
        html(
            "div",
            { class: "after" },
            html("div", { class: "knobs one" }, drive.node),
            html("div", { class: "row" }, html("label", { for: "roll-distance" }, words.roll_distance), field),
            told,
            html(
                "div",
                { class: "row" },
                page.history_buttons(),
                page.take_along(
                    () => ({
                        root: picture.querySelector("svg"),
                        title: fill_in(words.take.titles.roll, {
                            distance: data ? show(data.history.distance[frames.at], 3) : "",
                        }),
                        legend: legend_row.firstChild?.entries,
                    }),
                    "rollbem-roll",
                    null,
                ),
            ),
            html(
                "details",
                { class: "hand-drawn", open: Boolean(page.drawn), ontoggle: () => draw_hand() },
                html("summary", {}, words.hand_title),
                html("p", { class: "note" }, words.hand_note),
                what,
                hand,
                same,
            ),
        ),
    );

    /* The case of the page, rolling from rest on equal elements. */
    function given() {
        const { drawn } = page,
            numbers = page.answer?.numbers;
        let base = held(page.given, TANGENTIAL.steady)
            ? page.given
            : hold(page.given, ALL_TANGENTIAL, "creep-ratio", "0.5");
        const force = numbers?.force_ratio;
        if (by === "force" && Number.isFinite(force))
            base = hold(
                base,
                ALL_TANGENTIAL,
                "force-ratio",
                String(Number(Math.max(-MOST_FORCE, Math.min(MOST_FORCE, force)).toPrecision(4))),
            );
        if (by === "creep" && !held(base, ["creep", "creep-ratio"]))
            base = hold(
                base,
                ALL_TANGENTIAL,
                "creep-ratio",
                String(Number((numbers?.creep_ratio || 0.5).toPrecision(4))),
            );
        const all = {
            ...base,
            formulation: "transient",
            mesh: "uniform",
            "contact-elements": String(Math.min(MOST_ELEMENTS, Number(base["contact-elements"] ?? 40) || 40)),
        };
        if (!drawn) return { ...all, distance: String(distance) };
        DRAWN[drawn.what].forEach((name) => delete all[name]);
        if (!held(all, NORMAL) && drawn.what !== "load") all.load = String(numbers?.normal_load ?? 100);
        return { ...all, history: FILE };
    }
    const files = () => (page.drawn ? { [FILE]: table_of_drawn(page.drawn) } : {});
    function wants() {
        if (!page.answer || store.trouble("main")) return [];
        const of = given(),
            all = [{ kind: "roll", given: of, files: files() }];
        if (!page.drawn) {
            const { distance: way, ...rest } = { ...of, formulation: "steady" };
            all.push({ kind: "closed", slot: "steady roll", given: rest });
        }
        return all;
    }
    const changed = () => page.ask_view("roll");

    /* ---- Drawn by hand ---- */

    const unit = () =>
        page.drawn.what === "mu"
            ? words.hand.mu
            : page.drawn.what === "load"
              ? words.hand_load
              : page.drawn.what === "force_ratio"
                ? words.curve_y
                : words.curve_x;
    function span() {
        if (page.drawn.what === "mu") return [0.02, Number(Math.max(0.6, ...page.drawn.values).toPrecision(2))];
        if (page.drawn.what !== "load") return page.drawn.what === "force_ratio" ? [-0.95, 0.95] : [-1.4, 1.4];
        const P = Number(page.answer?.numbers.normal_load) || Math.max(...page.drawn.values);
        return [0.1 * P, Number((2 * Math.max(P, ...page.drawn.values.map((v) => v / 2))).toPrecision(2))];
    }
    function choose(kind) {
        if (kind === "none") page.drawn = null;
        else {
            const n = page.answer.numbers,
                mu = Math.max(0.02, Number(page.answer.values.mu.split(",")[0]));
            const start = { mu, load: n.normal_load, force_ratio: 0, creep_ratio: 0 }[kind],
                end = { mu: Number((mu / 2).toPrecision(3)), load: n.normal_load, force_ratio: -0.7, creep_ratio: 0.7 }[
                    kind
                ];
            const rise = (k) =>
                kind === "load" ? 1 + 0.5 * Math.sin((2 * Math.PI * k) / (POINTS - 1)) : Math.min(1, k / 4);
            page.drawn = {
                what: kind,
                distance,
                values: Array.from({ length: POINTS }, (_, k) =>
                    Number((kind === "load" ? start * rise(k) : start + (end - start) * rise(k)).toPrecision(3)),
                ),
            };
        }
        draw_hand();
        changed();
    }
    /* Points from ... to, of a stroke between two places: none is left out however fast it is. */
    function put(from, to) {
        const [low, high] = span(),
            values = [...page.drawn.values],
            steps = Math.abs(to.k - from.k);
        for (let j = 0; j <= steps; j++) {
            const t = steps ? j / steps : 1,
                k = from.k + Math.sign(to.k - from.k) * j;
            values[k] = Number(Math.max(low, Math.min(high, from.value + (to.value - from.value) * t)).toPrecision(3));
        }
        page.drawn = { ...page.drawn, values };
        draw_hand();
        changed();
    }
    let pull; /* by the picture that is shown: it is made anew while the pointer is down */
    function draw_hand() {
        what.replaceChildren(
            segments("hand", words.hand_title, Object.entries(words.hand), page.drawn?.what ?? "none", choose),
        );
        same.replaceChildren(
            ...(page.drawn
                ? [
                      html(
                          "div",
                          { class: "stack" },
                          text_card(words, "command", command_of(given(), page.options)),
                          text_card(words, "history", files()[FILE], FILE, "text/tab-separated-values"),
                      ),
                  ]
                : []),
        );
        if (!page.drawn) return hand.replaceChildren();
        const { values } = page.drawn,
            last = values.length - 1,
            [low, high] = span(),
            focus = [...hand.querySelectorAll("circle")].indexOf(document.activeElement);
        const width = width_of(hand),
            height = 210,
            x = [0, page.drawn.distance],
            y = ["load", "mu"].includes(page.drawn.what) ? [0, high] : [low * 1.1, high * 1.1];
        const plot = chart({
            width,
            height,
            x,
            y,
            x_label: words.roll_x,
            y_label: unit(),
            label: words.hand_alt,
            y_ticks: 4,
        });
        plot.root.removeAttribute("role");
        plot.root.setAttribute("class", "hand-line");
        const at = (k) => plot.X((x[1] * k) / last);
        plot.root.append(
            svg("rect", {
                x: plot.left,
                y: plot.top,
                width: width - plot.left - plot.right,
                height: height - plot.top - plot.bottom,
                style: "fill:transparent;cursor:crosshair",
            }),
            svg("path", { d: line(values.map((v, k) => [at(k), plot.Y(v)])), style: stroke("--accent", 2.5) }),
        );
        values.forEach((v, k) =>
            plot.root.append(
                svg("circle", {
                    cx: at(k),
                    cy: plot.Y(v),
                    r: 6,
                    class: "handle",
                    tabindex: 0,
                    role: "slider",
                    "aria-label": fill_in(words.hand_point, { k: k + 1, distance: show((x[1] * k) / last, 2) }),
                    "aria-valuemin": low,
                    "aria-valuemax": high,
                    "aria-valuenow": v,
                    style: "fill:var(--accent);stroke:var(--card);stroke-width:2",
                    onkeydown: (event) => {
                        const step = { ArrowUp: 0.02, ArrowDown: -0.02, PageUp: 0.1, PageDown: -0.1 }[event.key];
                        if (!step) return;
                        event.preventDefault();
                        put({ k, value: v }, { k, value: v + step * (high - low) });
                    },
                }),
            ),
        );
        pull = (event) => {
            const box = plot.root.getBoundingClientRect(),
                px = ((event.clientX - box.left) * width) / box.width,
                py = ((event.clientY - box.top) * height) / box.height;
            return {
                k: Math.max(
                    0,
                    Math.min(last, Math.round(((px - plot.left) / (width - plot.left - plot.right)) * last)),
                ),
                value: y[0] + ((height - plot.bottom - py) / (height - plot.top - plot.bottom)) * (y[1] - y[0]),
            };
        };
        make_draggable(store, plot.root, (event) => {
            let from = pull(event);
            const move = (e) => {
                const to = pull(e);
                put(from, to);
                from = to;
            };
            move(event);
            return move;
        });
        hand.replaceChildren(plot.root);
        if (focus >= 0) hand.querySelectorAll("circle")[focus]?.focus();
    }

    /* ---- The steps ---- */

    /* What is not held follows: the creepage under a force, the force under a creepage. */
    const followed = () =>
        page.drawn
            ? page.drawn.what === "creep_ratio"
                ? "force_ratio"
                : page.drawn.what === "force_ratio"
                  ? "creepage"
                  : by === "force"
                    ? "creepage"
                    : "force_ratio"
            : by === "force"
              ? "creepage"
              : "force_ratio";
    function frame(k) {
        if (!data) return;
        const n = data["step.p"].rows,
            part = (name) => data[name].at.subarray(n * k, n * k + n);
        const columns = {
            x: data["step.x"].at,
            h: data.columns.h,
            p: part("step.p"),
            q: part("step.q"),
            zone: part("step.zone"),
            slip: new Float64Array(n),
            mu: data.history.mu && new Float64Array(n).fill(data.history.mu[k]),
        };
        const width = width_of(picture),
            tall = height_for(
                Math.min(300, Math.max(170, width * 0.36), in_slides() ? 115 : Math.max(130, innerHeight - 450)),
                130,
            ),
            inside = [...columns.x.keys()].filter((i) => columns.zone[i] > 0),
            [from, to] = edges_of_equal(columns),
            [begin, end] = inside.length
                ? [columns.x[inside[0]] - columns.h[0] / 2, columns.x[inside.at(-1)] + columns.h[0] / 2]
                : [0, 0],
            grown = (end - begin) / (data.numbers.contact_to - data.numbers.contact_from) || 1,
            mu = Math.max(Number(data.values.mu.split(",")[0]) || 0.1, ...(data.history.mu ?? []));
        /* Zones and friction are those of the step. The lines are straight: a step does not know the slip of earlier ones. */
        const numbers = {
            ...data.numbers,
            contact_from: begin,
            contact_to: end,
            half_width: data.numbers.half_width * grown,
            approach: data.numbers.approach * grown ** 2,
            max_pressure: Math.max(...columns.p),
            stick: columns.zone.filter((z) => z === 1).length,
            stick_from: end,
            creepage: 0,
        };
        picture.replaceChildren(
            lens_figure(
                words,
                { columns: { ...columns, shift: columns.slip }, numbers, values: data.values },
                {
                    width,
                    height: tall,
                    given: given(),
                    shape: data,
                    fit: {
                        window: [from - 0.2 * (to - from), to + 0.2 * (to - from)],
                        press: 1.15 * steps_top,
                        rub: mu * steps_top,
                        slip: 1,
                    },
                    label: "",
                },
            ),
        );
        picture.firstChild.setAttribute("aria-label", fill_in(words.roll_alt, { k: k + 1 }));
        draw_way(k);
    }
    function draw_way(k) {
        const name = followed(),
            d = data.history.distance,
            list = data.history[name],
            percent = name === "creepage" ? 100 : 1;
        const end = steady && !page.drawn ? steady.numbers[name] : NaN,
            values = [...list].filter(Number.isFinite).concat(Number.isFinite(end) ? [end] : []);
        const low = Math.min(0, ...values) * percent,
            high = Math.max(0, ...values) * percent;
        /* The axis stays while it fits. */
        if (
            !axes ||
            axes.name !== name ||
            axes.x !== d.at(-1) ||
            low < axes.y[0] ||
            high > axes.y[1] ||
            (!store.holding && high - low < 0.4 * (axes.y[1] - axes.y[0]))
        )
            axes = { name, x: d.at(-1), y: [low * 1.15, high * 1.15 || (low ? 0 : 0.1)] };
        const width = width_of(way),
            plot = chart({
                width,
                height: 168,
                x: [0, d.at(-1) || 1],
                y: axes.y,
                x_label: words.roll_x,
                y_label: name === "creepage" ? w.creepage : words.curve_y,
                label: words.roll_curve,
                y_ticks: 3,
            });
        if (Number.isFinite(end))
            plot.root.append(
                svg("path", {
                    class: "steady",
                    d: `M${plot.left} ${plot.Y(end * percent)}H${width - plot.right}`,
                    style: stroke("--reference", 2, "stroke-dasharray:8 5"),
                }),
                svg(
                    "text",
                    {
                        x: width - plot.right - 4,
                        y:
                            plot.Y(end * percent) +
                            (Math.abs(end * percent - high) < Math.abs(end * percent - low) ? -6 : 16),
                        "text-anchor": "end",
                        class: "soft",
                    },
                    w.steady,
                ),
            );
        plot.root.append(
            svg("path", {
                class: "way",
                d: line([...d].map((v, i) => [plot.X(v), plot.Y(list[i] * percent)])),
                style: stroke("--rub", 3),
            }),
            svg("circle", {
                cx: plot.X(d[k]),
                cy: plot.Y((Number.isFinite(list[k]) ? list[k] : 0) * percent),
                r: 7,
                style: "fill:var(--accent);stroke:var(--card);stroke-width:2",
            }),
        );
        way.replaceChildren(plot.root);
        const last = list.at(-1),
            far = Math.abs(last / end - 1);
        told.textContent =
            Number.isFinite(end) && Number.isFinite(last)
                ? fill_in(far < 0.01 ? w.reached : w.not_yet, {
                      distance: show(d.at(-1), 3),
                      part: show(100 * (last / end), 3),
                  })
                : "";
    }
    function render() {
        drive.sync(store.solved.main);
        if (store.trouble("main")) node.classList.add("stale-inside");
        const key = `${by} ${page.drawn?.what} ${width_of(picture)}`;
        if (key === drawn_for) return;
        drawn_for = key;
        driven.replaceChildren(
            segments("driven", w.by_title, Object.entries(w.by), by, (value) => {
                by = value;
                distance = value === "force" ? 6 : 30;
                field.value = distance;
                axes = null;
                changed();
            }),
        );
        if (document.activeElement?.closest(".hand-line") == null) draw_hand();
        if (data) frame(frames.at);
    }
    return {
        node,
        player: frames,
        uses: ["main"],
        fine: true,
        wants,
        leave: () => frames.stop(),
        force: () => data.history.force_ratio.at(-1),
        data: () => data,
        steady: () => steady,
        render,
        /* What is drawn by hand and the force it is driven by are those of the solution. */
        solved() {
            changed();
        },
        resize() {
            drawn_for = null;
        },
        take(answer) {
            if (answer.kind === "closed") steady = answer.refused ? null : answer;
            else if (answer.refused || !answer["step.p"]) {
                told.textContent = fill_in(words.refused, { why: answer.refused ?? answer.unsolved });
                node.classList.add("stale-inside");
            } else {
                const first = !data || data["step.p"].columns !== answer["step.p"].columns;
                node.classList.remove("stale-inside");
                data = answer;
                steps_top = Math.max(...data["step.p"].at);
                legend_row.replaceChildren(tractions_legend(words, data["step.zone"].at, false));
                show_notes(notes, data);
                return frames.set(data["step.p"].columns, first ? 0 : undefined);
            }
            if (data) frame(frames.at);
        },
    };
}
