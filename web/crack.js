/* A contact that passes over a crack, as the library solves it position by position: the wheel is dragged
 * over it, and its faces open, stick and slide. */
import {
    card,
    chart,
    height_for,
    html,
    in_slides,
    legend,
    line,
    player,
    segments,
    show,
    stroke,
    svg,
    width_of,
    write,
} from "./draw.js";
import { make_draggable } from "./knob.js";
import { round_125 } from "./lens.js";
import { ALL_TANGENTIAL, PRESETS, contact_of, crack_of, hold, plain } from "./state.js";
import { fill_in } from "./words.js";

export const CRACK_CASE = {
    ...hold(PRESETS.rail, ALL_TANGENTIAL, "creep-ratio", "-0.5"),
    "crack-angle": "30",
    "crack-length": "1",
    "crack-friction": "0.1",
    fluid: "none",
};
/* Fewer positions and elements while a hand moves something. */
const FINE_PASS = { steps: "120", elements: "40" },
    COARSE_PASS = { steps: "60", elements: "20" };
const ANGLES = [15, 165],
    LENGTHS = [0.2, 1.6],
    FACES = 0.22 /* half-widths: how far apart the faces are drawn at most */,
    WAY = 6; /* half-widths: where the pass begins and ends */

/* What the library is asked for. */
export function crack_request(given, coarse) {
    const { steps, elements } = coarse ? COARSE_PASS : FINE_PASS;
    return {
        kind: "crack",
        given: { ...contact_of(given), steps },
        crack: { ...crack_of(given), "crack-elements": elements },
        coarse,
    };
}

/* The faces at a position: { x, y, open, slid, zone } of every node from the mouth on. */
export function faces_at(answer, k) {
    const nodes = answer["crack.node.x"].at.length,
        part = (name) => answer[name].at.subarray(k * nodes, (k + 1) * nodes);
    return {
        x: answer["crack.node.x"].at,
        y: answer["crack.node.y"].at,
        tx: answer["crack.node.t_x"].at,
        ty: answer["crack.node.t_y"].at,
        open: part("crack.opening"),
        slid: part("crack.sliding"),
        zone: part("crack.zone"),
    };
}

/* What the faces do where the contact stands above the mouth: "opens", or "slides". */
export function at_the_mouth(answer) {
    const x = answer["crack.x"].at,
        k = x.reduce((best, v, i) => (Math.abs(v) < Math.abs(x[best]) ? i : best), 0),
        [K_I, K_II] = ["K_I", "K_II"].map((name) => answer[`crack.${name}`].at[k]);
    return { k, K_I, K_II, kind: K_I > 0.1 * Math.abs(K_II) ? "opens" : "slides" };
}

export function crack_view(words, page) {
    const { store } = page,
        w = words.crack,
        picture = html("figure"),
        curves = html("figure"),
        water = html("div"),
        told = html("p", { class: "answer", "aria-live": "polite" }),
        state = html("p", { class: "note" }),
        sum = html("p", { "aria-live": "polite" });
    let guess = null,
        answered = null,
        drawn_for = null,
        data = null,
        magnified = 0,
        axis = null,
        place = 0; /* of the wheel, in half-widths */
    const given = () => store.case("crack"),
        set = (more) => store.set("crack", { ...given(), ...more });
    const crack_knob = (name, label, from, to, unit, digits = 3) =>
        page.knob({
            name,
            label,
            from,
            to,
            unit,
            digits,
            read: (a) => Number(a.crack[name]),
            write: (v) => set({ [name]: plain(Math.max(from, Math.min(to, v))) }),
        });
    const drive = page.knob({
        name: "crack-drive",
        label: words.hero.drive,
        from: -1.2,
        to: 1.2,
        ends: [words.hero.accelerate, words.hero.brake],
        read: (a) => a.numbers.creep_ratio,
        write: (v) => store.set("crack", hold(given(), ALL_TANGENTIAL, "creep-ratio", plain(v))),
    });
    const knobs = [
        crack_knob("crack-angle", w.angle, ...ANGLES, "°"),
        crack_knob("crack-length", w.length, ...LENGTHS, ""),
        crack_knob("crack-friction", w.friction, 0, 1, ""),
    ];
    const frames = player(words, {
        label: w.where,
        milliseconds: 50,
        see(k) {
            if (!data) return;
            /* Other positions under the same wheel do not move it. */
            const [x, between] = [data["crack.x"].at[k], data["crack.x"].at[1] - data["crack.x"].at[0]].map(
                (v) => v / data.numbers.half_width,
            );
            if (Math.abs(x - place) > 0.51 * between) place = x;
            draw_at(k);
        },
        describe: (k) => (data ? where_of(data["crack.x"].at[k] / data.numbers.half_width) : ""),
    });
    const where_of = (x) =>
        Math.abs(x) < 0.01 ? w.above : fill_in(x < 0 ? w.before : w.after, { x: show(Math.abs(x), 2) });
    const node = html(
        "div",
        { class: "two" },
        html(
            "div",
            { class: "tale" },
            html("p", { class: "question" }, w.question),
            html(
                "div",
                { class: "row choices", role: "group", "aria-label": w.question },
                w.choices.map(([value, text]) =>
                    html(
                        "button",
                        {
                            type: "button",
                            class: "button choice",
                            "aria-pressed": "false",
                            "data-value": value,
                            onclick: () => choose(value),
                        },
                        text,
                    ),
                ),
            ),
            told,
        ),
        card(
            "",
            html("div", { class: "revealing" }, frames.node),
            picture,
            state,
            html(
                "div",
                { class: "revealing" },
                curves,
                legend(
                    ["--press", w.K_I],
                    ["--rub", w.K_II],
                    ["--stick", words.hero.sticks],
                    ["--slip", words.hero.slips, "hatched"],
                ),
            ),
            html(
                "div",
                { class: "row" },
                page.take_along(
                    () => ({
                        root: picture.querySelector("svg"),
                        title: fill_in(words.take.titles.crack, { where: where_of(place) }),
                        numbers: data.numbers,
                        legend: [
                            ["--stick", words.hero.sticks],
                            ["--slip", words.hero.slips, "hatched"],
                        ],
                    }),
                    "rollbem-crack",
                    null,
                    given,
                ),
            ),
        ),
        html(
            "div",
            { class: "after" },
            html("p", {}, w.then),
            water,
            html("div", { class: "knobs one" }, drive.node, ...knobs.map((knob) => knob.node)),
            sum,
            page.history_buttons(),
        ),
    );
    function choose(value) {
        guess = value;
        for (const button of node.querySelectorAll(".choice"))
            button.setAttribute("aria-pressed", String(button.dataset.value === value));
        drawn_for = null;
        render();
    }

    /* ---- The picture ---- */

    /* A scale of the faces that serves the whole pass, and holds while a hand moves something. */
    function fit(a) {
        const most = ["crack.opening", "crack.sliding"].reduce(
                (m, name) => a[name].at.reduce((n, v) => Math.max(n, Math.abs(v)), m),
                1e-12,
            ),
            K = ["crack.K_I", "crack.K_II"].map((name) => a[name].at),
            low = Math.min(0, ...K.map((list) => Math.min(...list))),
            high = Math.max(...K.map((list) => Math.max(...list)));
        if (
            !magnified ||
            (!store.holding && Math.abs(Math.log((magnified * most) / (FACES * a.numbers.half_width))) > 0.7)
        )
            magnified = round_125((FACES * a.numbers.half_width) / most);
        if (!axis || low < axis[0] || high > axis[1] || (!store.holding && high - low < 0.5 * (axis[1] - axis[0])))
            axis = [1.15 * low, 1.15 * high];
    }
    function draw_at(k) {
        const a = data.numbers.half_width,
            width = width_of(picture),
            per = Math.min(
                (height_for(0.52 * innerHeight, in_slides() ? 100 : 60, 200) - 60) / 2.7,
                width / 4.8,
            ) /* px of a half-width */,
            tall = Math.round(0.95 * per + 62),
            height = Math.round(tall + 1.72 * per + 24),
            shown = guess !== null,
            at = faces_at(data, k),
            X = (x) => width / 2 + (x / a) * per,
            Y = (y) => tall - (y / a) * per;
        const moved = (j, side) => {
            const [n, t] = shown ? [at.open[j] * magnified, at.slid[j] * magnified] : [0, 0];
            return [
                X(at.x[j] + (side / 2) * (-at.ty[j] * n + at.tx[j] * t)),
                Y(at.y[j] + (side / 2) * (at.tx[j] * n + at.ty[j] * t)),
            ];
        };
        const nodes = [...at.x.keys()],
            path = ["crack.path.x", "crack.path.y"].map((name) => data[name].at),
            tip = [X(path[0].at(-1)), Y(path[1].at(-1))],
            upper = [...nodes.map((j) => moved(j, 1)), tip],
            lower = [...nodes.map((j) => moved(j, -1)), tip],
            wet = data["crack.fluid_pressure"].at[k] > 0;
        const root = svg("svg", {
            viewBox: `0 0 ${width} ${height}`,
            width,
            height,
            role: "group",
            "aria-label": fill_in(w.alt, { where: where_of(place) }),
        });
        root.append(
            svg("rect", { x: 0, y: tall, width, height: height - tall, style: "fill:var(--body-b)" }),
            svg("path", { d: `${line(wheel())}V0H0Z`, style: "fill:var(--body-a);stroke:none" }),
            svg("path", { d: line(wheel()), style: stroke("--edge", 1.2) }),
            svg("path", { d: `M0 ${tall}H${width}`, style: stroke("--edge", 1.5) }),
            ...pressure(),
            svg("path", {
                class: "gap",
                d: `${line(upper)}L${line([...lower].reverse()).slice(1)}Z`,
                style: `fill:var(${wet ? "--rub" : "--lens-gap"});stroke:none`,
            }),
            ...(shown ? hair_lines() : []),
            ...faces(),
        );
        root.append(svg("text", { x: 8, y: 16, class: "soft" }, width < 520 ? w.press_short : w.press));
        if (shown)
            root.append(
                svg(
                    "text",
                    { x: width - 8, y: height - 10, "text-anchor": "end", class: "soft" },
                    fill_in(width < 520 ? w.magnified_short : w.magnified, { times: show(magnified) }),
                ),
                ...(wet
                    ? [
                          svg(
                              "text",
                              { x: 8, y: height - 10, class: "soft" },
                              fill_in(w.wet, { p: show(data["crack.fluid_pressure"].at[k], 3) }),
                          ),
                      ]
                    : []),
                wheel_handle(),
                tip_handle(),
            );
        const focused = picture.contains(document.activeElement) && document.activeElement.dataset.handle;
        picture.replaceChildren(root);
        if (focused) picture.querySelector(`[data-handle="${focused}"]`)?.focus();
        picture.classList.toggle("stale", Boolean(store.trouble("crack")));
        if (shown) draw_curves(k);

        /* The wheel above the ground, gaps magnified: that of Hertz beside the contact, of two half-planes. */
        function wheel() {
            const at_x = shown ? data["crack.x"].at[k] : 0;
            return Array.from({ length: 81 }, (_, i) => {
                const x = (i * width) / 80,
                    s = Math.max(1, Math.abs((x - X(at_x)) / per)),
                    root = Math.sqrt(s * s - 1);
                return [x, Math.max(0, tall - 0.16 * per * (s * root - Math.log(s + root)))];
            });
        }
        /* The pressure of the contact where it stands, and which way its friction pulls the ground. */
        function pressure() {
            const { x, p, q } = data.columns,
                at_x = shown ? data["crack.x"].at[k] : 0,
                top = Math.max(...p),
                points = [...x].map((v, i) => [X(v + at_x), tall - (p[i] / top) * 0.95 * per]);
            const Q = [...q].reduce((total, v, i) => total + v * data.columns.h[i], 0),
                P = [...p].reduce((total, v, i) => total + v * data.columns.h[i], 0),
                long = (-Q / P) * 2.2 * per,
                head = Math.sign(long) * 6,
                [from, to, y] = [X(at_x) - long / 2, X(at_x) + long / 2, tall + 11];
            return [
                svg("path", {
                    d: `M${points[0][0]} ${tall}L${line(points).slice(1)}L${points.at(-1)[0]} ${tall}Z`,
                    style: "fill:var(--press-fill);stroke:var(--press);stroke-width:2",
                }),
                Math.abs(long) > 8
                    ? svg("path", {
                          d: `M${from} ${y}H${to}m${-head} -4l${head} 4l${-head} 4`,
                          style: stroke("--rub", 2.4, "stroke-linecap:round"),
                      })
                    : "",
            ].filter(Boolean);
        }
        /* Lines across the crack, torn where its faces have slid. */
        function hair_lines() {
            const count = Math.max(3, Math.round((Number(given()["crack-length"]) * per) / 22)),
                long = 0.24 * per,
                length = Math.hypot(path[0].at(-1) - path[0][0], path[1].at(-1) - path[1][0]);
            return Array.from({ length: count }, (_, i) => ((i + 0.6) / count) * length).flatMap((s) => {
                const j = nodes.reduce(
                    (best, n) =>
                        Math.abs(Math.hypot(at.x[n] - path[0][0], at.y[n] - path[1][0]) - s) <
                        Math.abs(Math.hypot(at.x[best] - path[0][0], at.y[best] - path[1][0]) - s)
                            ? n
                            : best,
                    0,
                );
                return [1, -1].map((side) => {
                    const [x, y] = moved(j, side),
                        [nx, ny] = [-at.ty[j] * side * long, -at.tx[j] * side * long];
                    return svg("path", {
                        d: `M${x.toFixed(1)} ${y.toFixed(1)}l${nx.toFixed(1)} ${ny.toFixed(1)}`,
                        style: stroke(
                            ["--soft", "--stick", "--slip", "--slip"][at.zone[j]],
                            1.8,
                            at.zone[j] > 1 ? "stroke-dasharray:5 3" : "",
                        ),
                    });
                });
            });
        }
        /* Both faces, by zones: open, sticking (whole), sliding (dashed). */
        function faces() {
            return [upper, lower].flatMap((face) =>
                nodes.map((j) =>
                    svg("path", {
                        d: line([face[j], face[j + 1]]),
                        style: stroke(
                            shown ? ["--edge", "--stick", "--slip", "--slip"][at.zone[j]] : "--edge",
                            3,
                            shown && at.zone[j] > 1 ? "stroke-dasharray:6 3" : "stroke-linecap:round",
                        ),
                    }),
                ),
            );
        }
        function wheel_handle() {
            const x = Math.max(16, Math.min(width - 16, X(data["crack.x"].at[k])));
            return handle("wheel", x, tall - 0.95 * per - 20, {
                label: w.hand_wheel,
                min: -WAY,
                max: WAY,
                now: place,
                text: where_of(place),
                sign: "↔",
                drag: (dx) => go_to(place + dx / per),
                keys: { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], PageUp: [1, 0], PageDown: [-1, 0] },
                step: ([by]) => go_to(place + by),
            });
        }
        function tip_handle() {
            const start = { angle: Number(given()["crack-angle"]), length: Number(given()["crack-length"]) };
            return handle("tip", ...tip, {
                label: w.hand_tip,
                min: ANGLES[0],
                max: ANGLES[1],
                now: start.angle,
                text: fill_in(w.tip_value, { angle: show(start.angle, 3), length: show(start.length, 3) }),
                sign: "",
                drag(dx, dy) {
                    const rad = (start.angle * Math.PI) / 180,
                        x = start.length * Math.cos(rad) + dx / per,
                        y = Math.max(0.02, start.length * Math.sin(rad) + dy / per);
                    put_tip((Math.atan2(y, x) * 180) / Math.PI, Math.hypot(x, y));
                },
                keys: { ArrowLeft: [2, 0], ArrowRight: [-2, 0], ArrowUp: [0, -0.05], ArrowDown: [0, 0.05] },
                step: ([angle, length]) => put_tip(start.angle + angle, start.length + length),
            });
        }
    }
    const put_tip = (angle, length) =>
        set({
            "crack-angle": plain(Number(Math.max(ANGLES[0], Math.min(ANGLES[1], angle)).toPrecision(3))),
            "crack-length": plain(Number(Math.max(LENGTHS[0], Math.min(LENGTHS[1], length)).toPrecision(3))),
        });
    /* A point of the picture that is dragged; the picture is made anew on the way. */
    function handle(name, x, y, { label, min, max, now, text, sign, drag, keys, step }) {
        const group = svg(
            "g",
            {
                class: "handle",
                tabindex: 0,
                role: "slider",
                "data-handle": name,
                "aria-label": label,
                "aria-valuemin": min,
                "aria-valuemax": max,
                "aria-valuenow": now.toFixed(2),
                "aria-valuetext": text,
                transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
                style: "touch-action:none",
            },
            svg("circle", { r: 18, style: "fill:transparent" }),
            svg("circle", { r: sign ? 13 : 8, style: "fill:var(--accent);stroke:var(--card);stroke-width:3" }),
            svg("text", { "text-anchor": "middle", y: 5, style: "fill:var(--on-accent);font-size:15px" }, sign),
        );
        make_draggable(store, group, (event) => {
            group.focus({ preventScroll: true });
            frames.stop();
            const zoom = width_of(picture) / picture.firstChild.getBoundingClientRect().width;
            return (e) => drag((e.clientX - event.clientX) * zoom, (e.clientY - event.clientY) * zoom);
        });
        group.addEventListener("keydown", (event) => {
            if (!keys[event.key]) return;
            event.preventDefault();
            step(keys[event.key]);
        });
        return group;
    }
    const index_of = (x) => {
        const list = data["crack.x"].at,
            wanted = x * data.numbers.half_width;
        return list.reduce((best, v, i) => (Math.abs(v - wanted) < Math.abs(list[best] - wanted) ? i : best), 0);
    };
    const go_to = (x) => frames.go(index_of(Math.max(-WAY, Math.min(WAY, x))));

    /* ---- K over the way ---- */

    function draw_curves(k) {
        const width = width_of(curves),
            a = data.numbers.half_width,
            ghost = store.ghosts.crack && store.ghosts.crack !== store.solved.crack ? store.ghosts.crack : null;
        const plot = chart({
            width,
            height: Math.round(Math.max(150, Math.min(220, innerHeight - 560))),
            x: [-WAY, WAY],
            y: axis,
            x_label: w.x_axis,
            y_label: w.y_axis,
            label: w.curves,
            y_ticks: 4,
            left: 62,
        });
        const curve = (of, name) =>
            line([...of["crack.x"].at].map((x, i) => [plot.X(x / of.numbers.half_width), plot.Y(of[name].at[i])]));
        for (const [name, colour, dash] of [
            ["crack.K_I", "--press", ""],
            ["crack.K_II", "--rub", ""],
        ]) {
            if (ghost)
                plot.root.append(
                    svg("path", {
                        class: "ghost",
                        d: curve(ghost, name),
                        style: stroke(colour, 1.5, "stroke-dasharray:2 5;opacity:.75"),
                    }),
                );
            plot.root.append(
                svg("path", { class: name.slice(6), d: curve(data, name), style: stroke(colour, 2.6, dash) }),
                svg("circle", {
                    cx: plot.X(data["crack.x"].at[k] / a),
                    cy: plot.Y(data[name].at[k]),
                    r: 5,
                    style: `fill:var(${colour});stroke:var(--card);stroke-width:2`,
                }),
            );
        }
        plot.root.append(
            svg("path", {
                d: `M${plot.X(data["crack.x"].at[k] / a)} ${plot.top}V${220 - plot.bottom}`,
                style: stroke("--accent", 1.2, "stroke-dasharray:3 4"),
            }),
        );
        curves.replaceChildren(plot.root);
        const length = Number(data.crack["crack-length"]) * a,
            part = (name) => Math.round((100 * data[`crack.${name}`].at[k]) / length),
            [open, stick] = [part("open_length"), part("stick_length")];
        write(
            state,
            fill_in(w.state, {
                where: where_of(place),
                K_I: show(data["crack.K_I"].at[k], 3),
                K_II: show(data["crack.K_II"].at[k], 3),
                open,
                stick,
                slip: Math.max(0, 100 - open - stick),
            }),
        );
    }

    /* ---- Words ---- */

    function render() {
        const a = store.solved.crack,
            trouble = store.trouble("crack"),
            key = [a, trouble, guess, width_of(picture), store.ghosts.crack];
        if (!a || (drawn_for && key.every((part, i) => part === drawn_for[i]))) return;
        drawn_for = key;
        [drive, ...knobs].forEach((knob) => knob.sync(a));
        node.classList.toggle("revealed", guess !== null);
        node.classList.toggle("stale-inside", Boolean(trouble));
        data = a;
        fit(a);
        const here = index_of(place);
        frames.set(a["crack.x"].at.length, here);
        if (frames.at !== here) frames.go(here);
        if (guess === null) return;
        const kept = water.querySelector(":focus")?.value;
        water.replaceChildren(
            segments("fluid", w.water, Object.entries(w.fluids), given().fluid, (fluid) => set({ fluid })),
        );
        if (kept) water.querySelector(`[value="${kept}"]`)?.focus();
        if (trouble || answered !== guess) {
            const { kind, K_I, K_II } = at_the_mouth(a);
            write(
                told,
                trouble
                    ? fill_in(words.refused, { why: trouble })
                    : [
                          guess === kind ? w.right : w.wrong,
                          fill_in(w.answer[kind], { K_I: show(K_I, 3), K_II: show(K_II, 3) }),
                      ].join(" "),
            );
        }
        answered = guess;
        const ghost = store.ghosts.crack && store.ghosts.crack !== a ? store.ghosts.crack : null,
            number = (of, name) => show(of.summary[name], 3);
        const sums = [
            fill_in(w.sum, { K_I: number(a, "K_I_max"), dK: number(a, "delta_K_II") }),
            ghost && fill_in(w.was, { K_I: number(ghost, "K_I_max"), dK: number(ghost, "delta_K_II") }),
            given().fluid === "trapped" && w.wet_why,
        ];
        write(sum, sums.filter(Boolean).join(" "));
    }
    return {
        node,
        render,
        uses: ["crack"],
        fine: true,
        leave: () => frames.stop(),
        /* What was solved coarsely under a hand is solved anew when it lets go. */
        wants: () =>
            !store.holding && store.answers.crack?.coarse
                ? [{ ...crack_request(given(), false), slot: "solve crack", case: "crack" }]
                : [],
        take() {},
        resize() {
            drawn_for = null;
        },
        answer: choose,
        go_to,
        player: frames,
        shown: () => ({ data, place, magnified }),
    };
}
