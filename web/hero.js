/* The first screen: a wheel to scale that turns, a lens on its contact, hands on both, and a sentence that says what
 * one sees. */
import { canvas_pen, read_palette, svg_pen } from "./pen.js";
import { draw_lens, fit_lens, lens_still_fits, lens_words, shape_of } from "./lens.js";
import { html, show } from "./draw.js";
import { make_draggable } from "./knob.js";
import { ALL_TANGENTIAL, NORMAL, formulation_of, hold, radius_of_ground, share_of_ground } from "./state.js";
import { fill_in } from "./words.js";

const LENS_SPEED = 0.24; /* contact widths per second: slow motion */
const TURN_SPEED = 0.55; /* radians per second */
const TURN_FOR_FULL = 1.1; /* radians by hand for a creep ratio of 1 */

/* What of the contact slips, from 0 to 1; NaN: nothing touches or nothing rolls. */
export function slip_share({ numbers: n }) {
    const wide = n.nip_width;
    if (!(wide > 0)) return NaN;
    if (n.stick === 0) return 1;
    return Math.min(
        1,
        Math.max(0, 1 - (Number.isFinite(n.stick_length) ? n.stick_length / wide : n.stick / n.contact)),
    );
}
const PARTS = [
    [1 / 4, "quarter"],
    [1 / 3, "third"],
    [1 / 2, "half"],
    [2 / 3, "two_thirds"],
    [3 / 4, "three_quarters"],
];

/* The headline of a state: which, and in words. */
export function headline_of(words, answer, trouble, given) {
    const w = words.hero;
    if (!answer && !trouble) return { kind: "solving", text: w.solving };
    if (trouble) return { kind: "unsolved", text: fill_in(w.unsolved, { why: trouble }) };
    const share = slip_share(answer),
        n = answer.numbers,
        percent = Math.round(100 * share);
    const way = n.tangential_load > 0 ? "drive" : "brake",
        rolls = formulation_of(given) !== "static";
    if (Number.isNaN(share)) return { kind: "apart", text: w.apart };
    if (!(Number(answer.values.mu.split(",")[0]) > 0))
        return { kind: "smooth", text: rolls ? w.smooth : w.smooth_rest };
    if (!rolls)
        return {
            kind: "rest",
            text: share >= 1 ? w.rest_slides : share < 0.005 ? w.rest_sticks : with_part(w, w.rest, share),
        };
    if (share >= 0.9995) return { kind: "skid", text: w.skid[way] };
    if (share > 0.9) return { kind: "nearly", text: w.nearly[way] };
    if (share < 0.005 && Math.abs(n.force_ratio) < 0.01) return { kind: "free", text: w.free };
    if (share < 0.1) return { kind: "touch", text: fill_in(w.touch[way], { percent: Math.max(1, percent) }) };
    return { kind: "partial", text: with_part(w, w.partial[way], share) };
}
/* A part is written small within a sentence. */
function with_part(w, text, share) {
    const part = part_in_words(w, share);
    return fill_in(text, { share: text.startsWith("{share}") ? part : part[0].toLowerCase() + part.slice(1) });
}
function part_in_words(w, share) {
    const [part, name] = PARTS.reduce((best, next) =>
        Math.abs(next[0] - share) < Math.abs(best[0] - share) ? next : best,
    );
    return Math.abs(part - share) < 0.012
        ? w.parts[name]
        : fill_in(w.parts.percent, { percent: Math.round(100 * share) });
}

export function hero_view(words, page) {
    const w = words.hero,
        store = page.store;
    const canvas = html("canvas", { role: "img", class: "stage" });
    const headline = html("h1", { id: "headline" }),
        lead = html("p", { class: "lead" }, w.lead),
        note = html("p", { class: "trouble", hidden: true });
    const live = html("p", { class: "unseen", role: "status", "aria-live": "polite" });
    const handle = (kind, label, min, max) =>
        html("button", {
            type: "button",
            class: `hand ${kind}`,
            role: "slider",
            "aria-label": label,
            "aria-valuemin": min,
            "aria-valuemax": max,
            "aria-valuenow": 0,
        });
    const border = handle("border", w.hand_border, -1.2, 1.2),
        rim = handle("rim", w.hand_rim, -1.2, 1.2),
        hub = handle("hub", w.hand_hub, 10, 1e5);
    hub.append(html("span", { "aria-hidden": "true" }, "↓"));
    rim.append(html("span", { "aria-hidden": "true" }, "↻"));
    const stage = html("div", { class: "stage-box" }, canvas, rim, hub, border);
    /* Places of the numbers before there are any: nothing moves when they come. */
    const facts = html(
        "dl",
        { class: "facts" },
        ["pressed", "wide", "pressure", "used", "slower"].map((name) =>
            html("div", {}, html("dt", {}, w.facts[name]), html("dd", {}, "–")),
        ),
    );
    const knobs = html("div", { class: "knobs" });
    const pause = html("button", { type: "button", class: "button", onclick: () => set_running(!running) });
    const motion = matchMedia("(prefers-reduced-motion: reduce)");
    let running = !motion.matches,
        visible = true,
        way = 0,
        turn = 0,
        before = 0,
        fit = null,
        goal = null,
        fitted = null,
        shape = null,
        palette = read_palette(),
        placed = null;
    let frame_times = [];

    const drive = page.knob({
        name: "creep-ratio",
        label: w.drive,
        from: -1.2,
        to: 1.2,
        ends: [w.accelerate, w.brake],
        read: drive_of,
        write: set_drive,
        text: drive_text,
    });
    const load = page.knob({
        name: "load",
        label: w.load,
        from: 200,
        to: 50000,
        scale: "log",
        unit: "N/mm",
        read: (a) => a.numbers.normal_load,
        write: set_load,
    });
    const mu = page.knob({
        name: "mu",
        label: w.mu,
        from: 0,
        to: 1,
        read: (a) => Number(a.values.mu.split(",")[0]),
        write: (v) => page.change(page.with_mu(page.given, v)),
    });
    knobs.append(drive.node, load.node, mu.node);
    const node = html(
        "div",
        { class: "hero" },
        html("div", { class: "says" }, headline, lead),
        stage,
        live,
        facts,
        html(
            "div",
            { class: "hero-controls" },
            knobs,
            html(
                "div",
                { class: "row" },
                pause,
                page.history_buttons("main"),
                page.take_along(
                    () => picture_of(),
                    "rollbem-contact",
                    () => canvas,
                ),
            ),
        ),
        note,
    );

    function drive_of(answer) {
        const { creep_ratio: s, force_ratio: f } = answer.numbers;
        return Number.isFinite(s) ? s : Number.isFinite(f) ? -f : 0;
    }
    function drive_text(value) {
        const a = store.solved.main;
        if (!a) return "";
        const used = Math.abs(a.numbers.force_ratio);
        return fill_in(value >= 0 ? w.drive_brake : w.drive_accelerate, {
            used: Number.isFinite(used) ? Math.round(100 * used) : 0,
        });
    }
    /* By the creepage where it rolls, by the force where it stands. */
    function set_drive(value) {
        const given = page.given,
            to = Math.max(-1.2, Math.min(1.2, value));
        if (formulation_of(given) === "static")
            return page.change(hold(given, ALL_TANGENTIAL, "force-ratio", round(Math.max(-0.99, Math.min(0.99, -to)))));
        const a = store.solved.main;
        if (!(Number(a?.values.mu.split(",")[0]) > 0))
            return page.change(hold(given, ALL_TANGENTIAL, "creep", round(to / 1000)));
        page.change(hold(given, ALL_TANGENTIAL, "creep-ratio", round(to)));
    }
    function set_load(value) {
        /* of what was solved first nine digits: its rounding must not decide the third one */
        const exact = Number(Math.max(1, Math.min(1e5, value)).toPrecision(9));
        page.change(hold(page.given, NORMAL, "load", String(Number(exact.toPrecision(3)))));
    }
    const round = (x) => String(Number(x.toFixed(Math.abs(x) < 0.01 ? 6 : 3)));

    /* ---- Hands ---- */

    const now = () => store.solved.main;
    function grip(node, begin, move, keys) {
        make_draggable(store, node, (event) => {
            if (!now()) return null;
            node.focus({ preventScroll: true });
            const start = begin(event);
            return (e) => move(e, start);
        });
        node.addEventListener("keydown", (event) => {
            const step = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 5, PageDown: -5 }[
                event.key
            ];
            if (!step || !now()) return;
            event.preventDefault();
            keys(step, event.key);
        });
    }
    grip(
        border,
        (e) => ({ x: e.clientX, s: drive_of(now()), wide: placed.contact_px }),
        (e, from) => {
            const sign = from.s < 0 ? -1 : 1;
            set_drive(from.s + (sign * (e.clientX - from.x)) / Math.max(40, from.wide));
        },
        (step) => set_drive(drive_of(now()) + 0.02 * step * (drive_of(now()) < 0 ? -1 : 1)),
    );
    const angle_of = (e) => {
        const box = canvas.getBoundingClientRect();
        return Math.atan2(e.clientY - box.top - placed.wheel.cy, e.clientX - box.left - placed.wheel.cx);
    };
    grip(
        rim,
        (e) => ({ angle: angle_of(e), s: drive_of(now()), sum: 0 }),
        (e, from) => {
            const angle = angle_of(e),
                d = Math.atan2(Math.sin(angle - from.angle), Math.cos(angle - from.angle));
            from.angle = angle;
            from.sum += d; /* clockwise on the screen, the way it rolls, drives */
            turn += d;
            set_drive(from.s - from.sum / TURN_FOR_FULL);
        },
        (step) => set_drive(drive_of(now()) - 0.05 * step),
    );
    grip(
        hub,
        (e) => ({ y: e.clientY, load: now().numbers.normal_load }),
        (e, from) => set_load(from.load * Math.exp((e.clientY - from.y) / 70)),
        (step, key) =>
            set_load(now().numbers.normal_load * 1.1 ** (key === "ArrowUp" || key === "ArrowDown" ? -step : step)),
    );

    /* ---- Motion ---- */

    function set_running(on) {
        running = on;
        pause.textContent = on ? w.pause : w.run;
        pause.setAttribute("aria-pressed", String(!on));
        if (on) start_frames();
    }
    let looping = false;
    function start_frames() {
        if (looping) return;
        looping = true;
        before = 0;
        requestAnimationFrame(step);
    }
    function step(time) {
        if (before) frame_times.push(time - before);
        if (frame_times.length > 4000) frame_times = frame_times.slice(-2000);
        const seconds = before ? Math.min(0.05, (time - before) / 1000) : 0;
        before = time;
        const a = now(),
            rolls = a && formulation_of(page.given) !== "static";
        if (running && rolls && !store.trouble("main")) {
            way += seconds * LENS_SPEED * (fit?.window[1] - fit?.window[0] || 0);
            turn += seconds * TURN_SPEED;
        }
        paint();
        if ((running || store.holding || fit !== goal) && visible && !document.hidden) requestAnimationFrame(step);
        else looping = false;
    }
    new IntersectionObserver(([entry]) => {
        visible = entry.isIntersecting;
        if (visible) start_frames();
    }).observe(stage);
    document.addEventListener("visibilitychange", start_frames);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
        palette = read_palette();
        paint();
    });
    motion.addEventListener("change", () => set_running(!motion.matches));

    /* ---- The picture ---- */

    const size = () => ({ width: Math.round(stage.clientWidth), height: Math.round(stage.clientHeight) });
    function layout({ width, height }) {
        const wide = width / height > 1.25;
        if (!wide) {
            const top = Math.round(height * 0.36),
                r = top * 0.34;
            return {
                wheel: { cx: width / 2, cy: top * 0.43, r, ground: top * 0.43 + r, left: 6, right: width - 6 },
                lens: { x: 1, y: top + 6, w: width - 2, h: height - top - 8 },
                wide,
            };
        }
        const aside = Math.round(Math.min(width * 0.27, height * 0.72)),
            r = Math.min(aside * 0.4, height * 0.3);
        return {
            wheel: { cx: aside / 2, cy: height * 0.47, r, ground: height * 0.47 + r, left: 4, right: aside - 6 },
            lens: { x: aside + 14, y: 1, w: width - aside - 15, h: height - 2 },
            wide,
        };
    }
    /* Scales hold still while a hand holds something, then glide to where they go, so that the eye can follow. */
    function glide(a) {
        if (!goal) fit = goal = fit_lens(a);
        if (!store.holding && fitted !== a) {
            fitted = a;
            if (!lens_still_fits(goal, a)) goal = fit_lens(a);
        }
        if (fit === goal) return fit;
        const part = motion.matches || !running ? 1 : 0.22,
            mix = (p, q) => p + (q - p) * part;
        fit = {
            window: fit.window.map((x, k) => mix(x, goal.window[k])),
            press: mix(fit.press, goal.press),
            slip: mix(fit.slip, goal.slip),
            rub: mix(fit.rub, goal.rub),
        };
        if (
            Math.abs(fit.window[1] / goal.window[1] - 1) +
                Math.abs(fit.press / goal.press - 1) +
                Math.abs(fit.rub / goal.rub - 1) +
                Math.abs(fit.slip / goal.slip - 1) <
            0.01
        )
            fit = goal;
        return fit;
    }
    function draw_wheel(pen, at, a, lens_box, given) {
        const { cx, cy, r, ground, left, right } = at,
            R = Number(a.values.radius),
            support = a.values.support;
        /* The ground: a plane, another roll, or a bore around the wheel, to the same scale. */
        const bend = radius_of_ground(a.values) * (r / R),
            reach = Math.min(right - cx, cx - left, 0.98 * Math.abs(bend)),
            places = Array.from({ length: 41 }, (_, k) => cx + (k / 20 - 1) * reach),
            ground_at = (x) =>
                Number.isFinite(bend)
                    ? ground + bend - Math.sign(bend) * Math.sqrt(Math.max(0, bend ** 2 - (x - cx) ** 2))
                    : ground;
        const rolls = formulation_of(given) !== "static";
        const small = page.large() ? 15 : r < 50 ? 11 : 13;
        pen.shape([...places.map((x) => [x, ground_at(x)]), ...places.map((x) => [x, ground_at(x) + 14]).reverse()], {
            fill: "body-b",
        });
        pen.strokes([places.map((x) => [x, ground_at(x)])], { stroke: "edge", width: 1.6, name: "ground" });
        const ties = [],
            gap = 22,
            shift = (((turn * r) % gap) + gap) % gap;
        for (let x = cx + reach - shift; x > cx - reach + 6; x -= gap)
            ties.push([
                [x, ground_at(x) + 4],
                [x - 5, ground_at(x) + 11],
            ]);
        pen.strokes(ties, { stroke: "soft", width: 1.2, alpha: 0.7 });
        pen.circle(cx, cy, r, { fill: "body-a", stroke: "edge", width: 2 });
        const cover = Number(a.values["cover-thickness"]);
        if (cover > 0) pen.circle(cx, cy, r * (1 - cover / Number(a.values.radius)), { stroke: "edge", width: 1.2 });
        const inner = support === "hub" ? Number(a.values["hub-ratio"]) : 0.14;
        pen.strokes(
            Array.from({ length: 8 }, (_, k) => turn + (k * Math.PI) / 4).map((t) => [
                [cx + inner * r * Math.cos(t), cy + inner * r * Math.sin(t)],
                [cx + 0.93 * r * Math.cos(t), cy + 0.93 * r * Math.sin(t)],
            ]),
            { stroke: "soft", width: 1.2, alpha: 0.75 },
        );
        pen.circle(cx, cy, inner * r, { fill: "card", stroke: "edge", width: 1.6 });
        if (rolls) {
            const top = Math.max(cy - r - 15, 10),
                from = cx - r * 0.42,
                to = cx + r * 0.42;
            pen.strokes(
                [
                    [
                        [from, top],
                        [to, top],
                    ],
                    [
                        [to - 7, top - 5],
                        [to, top],
                        [to - 7, top + 5],
                    ],
                ],
                { stroke: "soft", width: 1.8 },
            );
        }
        const Q = a.numbers.force_ratio,
            long = Number.isFinite(Q) ? Q * r * 0.8 : 0;
        if (Math.abs(long) > 3) {
            const y = ground - 9,
                head = Math.sign(long) * 6,
                tip = cx + long;
            pen.strokes(
                [
                    [
                        [cx, y],
                        [tip, y],
                    ],
                    [
                        [tip - head, y - 4],
                        [tip, y],
                        [tip - head, y + 4],
                    ],
                ],
                { stroke: "rub", width: 2.6 },
            );
        }
        const ring = Math.max(7, Math.min(13, r * 0.12));
        pen.circle(cx, ground, ring, { stroke: "ink", width: 1.6 });
        const joints = lens_box
            ? [
                  [
                      [cx + ring * 0.7, ground - ring * 0.7],
                      [lens_box.x, lens_box.y + 14],
                  ],
                  [
                      [cx + ring * 0.7, ground + ring * 0.7],
                      [lens_box.x, lens_box.y + lens_box.h - 14],
                  ],
              ]
            : [];
        pen.strokes(joints, { stroke: "ink", width: 1.1, dash: [4, 5], alpha: 0.6 });
        pen.text(cx, ground + 32, fill_in(right - left < 160 ? w.to_scale_short : w.to_scale, { radius: show(R) }), {
            fill: "soft",
            size: small,
            anchor: "middle",
            halo: "paper",
        });
    }
    function draw_all(pen, dimensions, a, given) {
        const at = layout(dimensions),
            scale = glide(a);
        const drawn = draw_lens(pen, at.lens, {
            answer: a,
            shape: shape ?? a,
            share: share_of_ground(given, a.values),
            bend: radius_of_ground(a.values),
            fit: scale,
            way,
            ghost: ghost_shown(a) ? store.ghosts.main : null,
            words: lens_words(w, a, goal, at.lens.w, formulation_of(page.given) !== "static"),
            large: page.large(),
        });
        draw_wheel(pen, at.wheel, a, at.wide ? at.lens : null, given);
        return { ...at, ...drawn, contact_px: drawn.X(a.numbers.contact_to) - drawn.X(a.numbers.contact_from) };
    }
    /* The state before, where it differs and the axis has room for it. */
    const ghost_shown = (a) =>
        store.ghosts.main &&
        fit &&
        store.ghosts.main.numbers.max_pressure < 1.5 * fit.press &&
        store.ghosts.main !== a &&
        Math.abs(store.ghosts.main.numbers.max_pressure / a.numbers.max_pressure - 1) > 0.01;
    function paint() {
        const a = now(),
            dimensions = size();
        if (!a || dimensions.width < 10) return;
        if (!placed) performance.mark("first-solved");
        placed = draw_all(canvas_pen(canvas, dimensions.width, dimensions.height, palette), dimensions, a, page.given);
        stage.classList.toggle("stale", Boolean(store.trouble("main")));
        place(
            rim,
            placed.wheel.cx + 0.9 * placed.wheel.r * Math.SQRT1_2,
            placed.wheel.cy - 0.9 * placed.wheel.r * Math.SQRT1_2,
        );
        place(hub, placed.wheel.cx, placed.wheel.cy);
        border.hidden = !placed.border;
        if (placed.border)
            place(
                border,
                Math.max(placed.lens.x + 12, Math.min(placed.lens.x + placed.lens.w - 12, placed.border[0])),
                placed.border[1],
            );
    }
    function place(node, x, y) {
        node.style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px) translate(-50%,-50%)`;
    }

    function picture_of(colours = read_palette()) {
        const dimensions = { width: 1200, height: 560 },
            pen = svg_pen(dimensions.width, dimensions.height, colours);
        pen.text(8, 34, headline.textContent, { size: 26, weight: 700 });
        const moved = Object.fromEntries(Object.entries(pen).map(([name, f]) => [name, f]));
        draw_all(shifted(moved, 0, 56), { width: 1200, height: 500 }, now(), page.given);
        return pen.end();
    }
    /* The same calls further down. */
    function shifted(pen, dx, dy) {
        const move = (points) => points.map(([x, y]) => [x + dx, y + dy]);
        return {
            shape: (points, style) => pen.shape(move(points), style),
            strokes: (lines, style) => pen.strokes(lines.map(move), style),
            circle: (x, y, r, style) => pen.circle(x + dx, y + dy, r, style),
            text: (x, y, ...more) => pen.text(x + dx, y + dy, ...more),
            clip: (x, y, ...more) => pen.clip(x + dx, y + dy, ...more),
            frame: (x, y, ...more) => pen.frame(x + dx, y + dy, ...more),
        };
    }

    /* ---- Words and numbers ---- */

    let said = "",
        say_timer = null;
    function render() {
        const a = now(),
            trouble = store.trouble("main"),
            { text, kind } = headline_of(words, a, trouble, page.given);
        if (headline.textContent !== text) headline.textContent = text;
        headline.dataset.kind = kind;
        if (!a) return;
        const n = a.numbers;
        lead.textContent = formulation_of(page.given) === "static" ? w.lead_rest : w.lead;
        note.hidden = !trouble && !a.notes?.length;
        note.textContent = trouble ? w.stale : (a.notes ?? []).map((line) => line.replace(/\.?$/, ".")).join(" ");
        canvas.setAttribute(
            "aria-label",
            fill_in(w.alt, {
                headline: text,
                wide: show(n.nip_width, 3),
                p0: show(n.max_pressure, 3),
                slips: Math.round(100 * (slip_share(a) || 0)),
            }),
        );
        const fact = (label, value, unit) =>
            html("div", {}, html("dt", {}, label), html("dd", {}, html("b", {}, value), " ", html("small", {}, unit)));
        facts.replaceChildren(
            fact(w.facts.pressed, show(n.normal_load, 3), "N/mm"),
            fact(w.facts.wide, show(n.nip_width, 3), "mm"),
            fact(w.facts.pressure, show(n.max_pressure, 3), "MPa"),
            fact(
                w.facts.used,
                Number.isFinite(n.force_ratio) ? `${Math.round(100 * Math.abs(n.force_ratio))} %` : "–",
                w.facts.of_friction,
            ),
            fact(
                w.facts.slower,
                Number.isFinite(n.creepage) ? `${short_percent(100 * Math.abs(n.creepage))} %` : "–",
                n.creepage < 0 ? w.facts.faster_unit : w.facts.slower_unit,
            ),
        );
        [drive, load, mu].forEach((knob) => knob.sync(a));
        border.setAttribute("aria-valuenow", show_plain(drive_of(a)));
        rim.setAttribute("aria-valuenow", show_plain(drive_of(a)));
        for (const hand of [border, rim]) hand.setAttribute("aria-valuetext", drive_text(drive_of(a)));
        hub.setAttribute("aria-valuenow", show_plain(n.normal_load));
        hub.setAttribute("aria-valuetext", `${show(n.normal_load, 3)} N/mm`);
        clearTimeout(say_timer);
        say_timer = setTimeout(() => {
            const now_said = `${text} ${w.facts.used}: ${Math.round(100 * Math.abs(n.force_ratio || 0))} %`;
            if (now_said !== said) live.textContent = said = now_said;
        }, 700);
        if (looping) return;
        paint();
        start_frames();
    }
    /* Never so long that its line would break. */
    const short_percent = (x) => show(x < 0.01 ? Number(x.toFixed(3)) : x, 2);
    const show_plain = (x) => String(Number((x || 0).toPrecision(4)));
    set_running(running);
    return {
        node,
        render,
        picture_of,
        uses: ["main"],
        fine: true,
        /* The surfaces beside the contact are those of a coarser solution over the whole window. */
        wants() {
            const a = now();
            if (!a || store.holding || store.trouble("main") || !(a.numbers.half_width > 0) || "zone" in page.given)
                return [];
            const reach = 1.5 * Math.max(Math.abs(a.numbers.contact_from), Math.abs(a.numbers.contact_to));
            return [
                {
                    kind: "closed",
                    slot: "shape hero",
                    given: shape_of(page.given, reach),
                },
            ];
        },
        solved() {
            if (!store.holding) page.ask_view("hero");
        },
        take(answer) {
            shape = answer.refused || answer.unsolved ? null : answer;
            if (!looping) paint();
        },
        resize() {
            palette = read_palette();
            paint();
        },
        frames: () => frame_times,
        forget_frames() {
            frame_times = [];
        },
        pause: () => set_running(false),
        layout: () => ({ placed, way, fit, running }),
    };
}
