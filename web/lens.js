/* The contact under a lens: material lines of both bodies that flow through it, stay whole while they stick and tear
 * where they slip; pressure as an area, friction as arrows.
 *
 * The offsets at the surface are those of the solution: the sum of the column shift from the leading edge on is the
 * accumulated slip, creepage times way less that slip is the strain.  How they die away with the depth is drawn. */

import { show, ticks } from "./draw.js";
import { svg_pen } from "./pen.js";
import { radius_of_ground, share_of_ground } from "./state.js";
import { fill_in } from "./words.js";

const spaces_in = (wide) => (wide < 480 ? 18 : 26); /* between the lines, in the window */
const ASIDE = [1.42, 1.45]; /* the window in half-widths, to each side */

const last = (list) => list[list.length - 1];

/* The scales of the lens.  They hold still while a hand holds something. */
export function fit_lens({ columns, numbers }) {
    const half = Math.max(numbers.half_width, 1e-9);
    const middle = (numbers.contact_from + numbers.contact_to) / 2;
    const window = [middle - ASIDE[0] * half, middle + ASIDE[1] * half];
    const wide = window[1] - window[0];
    const way = offsets_of({ columns, numbers });
    const most = Math.max(way.slip_end, 0.55 * way.strain_end, 1e-9);
    const press = 1.15 * Math.max(...columns.p);
    return {
        window,
        press,
        slip: round_125((0.042 * wide) / most),
        rub: rub_of(columns, press),
    };
}
/* The friction that an arrow of full length stands for; small ones stay small. */
const rub_of = ({ q }, press) => Math.max(0.12 * press, ...[...q].map(Math.abs));
export function round_125(x) {
    const power = 10 ** Math.floor(Math.log10(x)),
        part = x / power;
    return (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10) * power;
}
/* Whether a scale is still good enough to keep: nothing jumps without need. */
export function lens_still_fits(fit, { columns, numbers }) {
    const wide = fit.window[1] - fit.window[0],
        contact = numbers.nip_width;
    const inside =
        numbers.contact_from > fit.window[0] + 0.06 * wide && numbers.contact_to < fit.window[1] - 0.06 * wide;
    const way = offsets_of({ columns, numbers }),
        most = (fit.slip * Math.max(way.slip_end, 0.55 * way.strain_end)) / wide;
    const high = Math.max(...columns.p) / fit.press,
        rub = rub_of(columns, fit.press) / fit.rub;
    return (
        inside &&
        contact > 0.3 * wide &&
        high > 0.35 &&
        high <= 1 &&
        rub > 0.35 &&
        rub <= 1.4 &&
        most < 0.1 &&
        (most > 0.012 || fit.slip > 500)
    );
}

/* Accumulated slip and strain of the material at x, in mm; material moves from the leading edge, at +x, to -x. */
export function offsets_of({ columns: c, numbers: n }) {
    const ends = [],
        slip = [];
    let sum = 0;
    for (let i = c.x.length - 1; i >= 0; i--) {
        if (c.zone[i] === 0) continue;
        ends.push(c.x[i] + c.h[i] / 2);
        slip.push(sum);
        sum += c.shift?.[i] || 0;
    }
    const from = n.contact_from,
        to = n.contact_to,
        creep = n.creepage || 0;
    const slip_at = (x) => {
        if (!ends.length || x >= to) return 0;
        if (x <= from) return sum;
        let k = 1;
        while (k < ends.length && ends[k] > x) k++;
        const x1 = ends[k - 1],
            x0 = k < ends.length ? ends[k] : from,
            s1 = slip[k - 1],
            s0 = k < ends.length ? slip[k] : sum;
        return x1 > x0 ? s1 + ((s0 - s1) * (x1 - x)) / (x1 - x0) : s1;
    };
    const strain_at = (x) => (x >= to ? 0 : x <= from ? 0 : creep * (to - x) - slip_at(x));
    return {
        slip_at,
        strain_at,
        slip_end: Math.abs(sum),
        strain_end: Math.max(...ends.map((x) => Math.abs(strain_at(x))), 0),
        strain_last: creep * (to - from) - sum,
    };
}

/* The zone of the material at x, 0 outside. */
function zone_at({ columns: c }, x) {
    let low = 0,
        high = c.x.length - 1;
    if (x < c.x[0] - c.h[0] / 2 || x > last(c.x) + last(c.h) / 2) return 0;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (x > c.x[middle] + c.h[middle] / 2) low = middle + 1;
        else high = middle;
    }
    return c.zone[low];
}

/* Surfaces of both bodies over x, in mm: of a coarser solution over the whole window, stretched with the contact.
 * share: what of the approach body B takes; bend: its radius without load. */
function surfaces(shape, answer, share, bend) {
    const { x, gap, un } = shape.columns,
        scale = answer.numbers.half_width / shape.numbers.half_width;
    const grow = (answer.numbers.approach || 1) / (shape.numbers.approach || 1);
    const deep = Math.min(...un);
    const between = (list, at) => {
        const u = at / scale;
        if (u <= x[0]) return list[0] + ((list[1] - list[0]) / (x[1] - x[0])) * (u - x[0]);
        const end = x.length - 1;
        if (u >= x[end]) return list[end] + ((list[end] - list[end - 1]) / (x[end] - x[end - 1])) * (u - x[end]);
        let k = 1;
        while (x[k] < u) k++;
        return list[k - 1] + ((list[k] - list[k - 1]) * (u - x[k - 1])) / (x[k] - x[k - 1]);
    };
    return (at) => {
        const lower = -share * grow * (between(un, at) - deep) - at ** 2 / (2 * bend);
        return { lower, upper: lower + grow * Math.max(0, between(gap, at)) };
    };
}

/* alike: contacts of one shape are drawn alike whatever their size; middle: where the surface is, of the height, with
 * nothing drawn in the bodies; blank: without what sticks and slips.
 * box: { x, y, w, h }.  scene: { answer, shape, share, bend, fit, way (mm that the material has moved), ghost, words,
 * large }.  Returns where things are, for the handles on top. */
export function draw_lens(pen, box, scene) {
    const { answer, shape, share, bend, fit, way, ghost, words } = scene;
    const { columns: c, numbers: n } = answer;
    const [x0, x1] = fit.window,
        per = box.w / (x1 - x0),
        spaces = spaces_in(box.w);
    const X = (x) => box.x + (x - x0) * per;
    const middle = box.y + box.h * (scene.middle ?? 0.55),
        depth = Math.min(box.h * 0.36, 0.22 * box.w + 30);
    const touching = n.contact_to > n.contact_from;
    const heights = shape ? surfaces(shape, answer, share, bend) : () => ({ upper: 0, lower: 0 });
    const [end, center] = [heights(x0), heights((x0 + x1) / 2)],
        sag = Math.max(1e-12, end.upper - center.upper, center.lower - end.lower, center.upper * 2);
    const high = (0.11 * box.h) / (sag * per),
        lift = fit.lift ?? (scene.alike ? high : round_125(high)),
        level = heights(n.contact_from || 0).lower;
    const surface = (x) => {
        const at = heights(x);
        return [middle - (at.upper - level) * lift * per, middle - (at.lower - level) * lift * per];
    };
    const grid = Array.from({ length: 97 }, (_, k) => x0 + ((x1 - x0) * k) / 96);
    const upper = grid.map((x) => [X(x), surface(x)[0]]),
        lower = grid.map((x) => [X(x), surface(x)[1]]);
    const small = scene.large ? 16 : box.w < 480 ? 11 : 13;

    pen.clip(box.x, box.y, box.w, box.h, 14, () => {
        pen.shape(
            [
                [box.x, box.y],
                [box.x + box.w, box.y],
                [box.x + box.w, box.y + box.h],
                [box.x, box.y + box.h],
            ],
            { fill: "lens-gap" },
        );
        pen.shape([[box.x, box.y], ...upper, [box.x + box.w, box.y]], { fill: "body-a" });
        pen.shape([[box.x, box.y + box.h], ...lower, [box.x + box.w, box.y + box.h]], { fill: "body-b" });
        if (touching) draw_pressure();
        if (scene.middle === undefined) draw_lines();
        pen.shape(upper, { stroke: "edge", width: 1.2 });
        pen.shape(lower, { stroke: "edge", width: 1.2 });
        if (touching && !scene.blank) {
            draw_band();
            draw_friction();
        }
    });
    pen.frame(box.x, box.y, box.w, box.h, 14, { stroke: "line", width: 1.2 });
    draw_words();

    function draw_pressure() {
        const tall = 0.4 * box.h,
            inside = [...c.x.keys()].filter((i) => c.zone[i] > 0);
        const curve = (columns, from, to, list) => [
            [X(from), surface(from)[0]],
            ...list.map((i) => [X(columns.x[i]), surface(columns.x[i])[0] - (columns.p[i] / fit.press) * tall]),
            [X(to), surface(to)[0]],
        ];
        const base = grid
            .filter((x) => x > n.contact_from && x < n.contact_to)
            .map((x) => [X(x), surface(x)[0]])
            .reverse();
        const points = curve(c, n.contact_from, n.contact_to, inside);
        pen.shape([...points, ...base], { fill: "pressure", alpha: 0.16 });
        pen.shape(points, { stroke: "pressure", width: 1.4, alpha: 0.55, name: "pressure" });
        if (ghost && ghost.numbers.contact_to > ghost.numbers.contact_from) {
            const g = ghost.columns,
                list = [...g.x.keys()].filter((i) => g.zone[i] > 0);
            pen.shape(curve(g, ghost.numbers.contact_from, ghost.numbers.contact_to, list), {
                stroke: "pressure",
                width: 1.2,
                dash: [3, 5],
                alpha: 0.6,
            });
        }
    }
    function draw_lines() {
        const space = (x1 - x0) / spaces,
            phase = ((way % space) + space) % space;
        const { slip_at, strain_at, slip_end, strain_last } = offsets_of(answer),
            sign = n.creepage < 0 ? -1 : 1;
        const groups = { outside: [], stick: [], slip: [] },
            dots = { outside: [], stick: [], slip: [] };
        for (let k = -2; k <= spaces + 2; k++) {
            const x = x0 + k * space + (space - phase);
            const torn = touching && !scene.blank,
                zone = torn && x > n.contact_from && x < n.contact_to ? zone_at(answer, x) : 0;
            let slip = torn ? slip_at(x) : 0,
                strain = torn ? strain_at(x) : 0;
            if (torn && x <= n.contact_from) {
                const fade = Math.exp((x - n.contact_from) / (0.12 * (x1 - x0)));
                slip = sign * slip_end;
                strain = strain_last * fade;
            }
            const group = zone === 0 ? "outside" : zone === 1 ? "stick" : "slip";
            const near = (fit.slip * slip) / 2,
                far = (fit.slip * (slip + strain)) / 2;
            const [ya, yb] = surface(x);
            const half = (y, side) =>
                Array.from({ length: 8 }, (_, j) => {
                    const t = j / 7,
                        down = t * depth,
                        fade = Math.exp(-3.2 * t);
                    return [X(x + side * (far + (near - far) * fade)), y - side * (down + (group === "slip" ? 3 : 0))];
                });
            groups[group].push(half(ya, 1), half(yb, -1));
            const ends = [
                [X(x + near), ya - (group === "slip" ? 3 : 0)],
                [X(x - near), yb + (group === "slip" ? 3 : 0)],
            ];
            dots[group].push(...(group === "stick" ? [[X(x), (ya + yb) / 2]] : ends));
        }
        pen.strokes(groups.outside, { stroke: "soft", width: 1.3, alpha: 0.5 });
        pen.strokes(groups.stick, { stroke: "stick", width: 2.2, name: "stick" });
        pen.strokes(groups.slip, { stroke: "slip", width: 2.2, dash: [7, 4], name: "slip" });
        for (const [x, y] of dots.outside) pen.circle(x, y, 2.4, { fill: "soft", alpha: 0.7 });
        for (const [x, y] of dots.slip) pen.circle(x, y, 3.6, { fill: "slip" });
        for (const [x, y] of dots.stick)
            pen.shape(
                [
                    [x - 4, y],
                    [x, y - 5.5],
                    [x + 4, y],
                    [x, y + 5.5],
                ],
                { fill: "stick" },
            );
    }
    /* The zones along the contact: what sticks is a whole band with ticks, what slips is hatched. */
    function draw_band() {
        let i = 0;
        while (i < c.x.length) {
            let j = i;
            while (j + 1 < c.x.length && c.zone[j + 1] === c.zone[i]) j++;
            if (c.zone[i] > 0) band(c.x[i] - c.h[i] / 2, c.x[j] + c.h[j] / 2, c.zone[i]);
            i = j + 1;
        }
    }
    function band(from, to, zone) {
        const count = Math.max(2, Math.round(((to - from) * per) / 6)),
            y = (x) => (surface(x)[0] + surface(x)[1]) / 2;
        const points = Array.from({ length: count + 1 }, (_, k) => from + ((to - from) * k) / count).map((x) => [
            X(x),
            y(x),
        ]);
        const sticks = zone === 1,
            colour = sticks ? "stick" : "slip";
        pen.shape(points, { stroke: "lens-gap", width: sticks ? 3 : 9 });
        pen.shape(points, { stroke: colour, width: sticks ? 4 : 1.5 });
        pen.strokes(
            points
                .filter((_, k) => (sticks ? k % 4 === 2 : true))
                .map(([px, py]) =>
                    sticks
                        ? [
                              [px, py - 5],
                              [px, py + 5],
                          ]
                        : [
                              [px - 3, py + 5],
                              [px + 3, py - 5],
                          ],
                ),
            { stroke: colour, width: 1.6 },
        );
    }
    function draw_friction() {
        const longest = (0.9 * box.w) / spaces,
            scale = longest / fit.rub;
        const arrows = [];
        const step = (n.contact_to - n.contact_from) / 15;
        for (let k = 0; k < 15; k++) {
            const x = n.contact_from + (k + 0.5) * step;
            let i = 0;
            while (i < c.x.length - 1 && c.x[i] + c.h[i] / 2 < x) i++;
            const long = Math.max(-2 * longest, Math.min(2 * longest, c.q[i] * scale)),
                y = surface(x)[0] - 15;
            if (Math.abs(long) < 2.5) continue;
            const at = X(x) + 0,
                head = Math.sign(long) * Math.min(5, Math.abs(long) * 0.6);
            arrows.push(
                [
                    [at - long / 2, y],
                    [at + long / 2, y],
                ],
                [
                    [at + long / 2 - head, y - 3.5],
                    [at + long / 2, y],
                    [at + long / 2 - head, y + 3.5],
                ],
            );
        }
        pen.strokes(arrows, { stroke: "lens-gap", width: 5, alpha: 0.7 });
        pen.strokes(arrows, { stroke: "rub", width: 2.2, name: "friction" });
    }
    function draw_words() {
        const right = box.x + box.w - 12,
            foot = box.y + box.h - 12;
        pen.text(right, box.y + small + 9, words.wide, { fill: "soft", size: small, anchor: "end" });
        pen.text(box.x + 12, box.y + small + 9, words.press, { fill: "soft", size: small });
        pen.text(right, foot, words.moves, { fill: "soft", size: small, anchor: "end", halo: "body-b" });
        if (!touching || scene.blank) return;
        if (box.w > 560 && Math.max(...c.q.map(Math.abs)) > 1e-6 * fit.press)
            pen.text(box.x + 12, foot, words.friction, { fill: "rub", size: small, halo: "body-b" });
        /* The longest piece of each. */
        const runs = { stick: [0, 0], slip: [0, 0] },
            kind_at = (i) => [undefined, "stick", "slip"][Math.min(2, c.zone[i])];
        for (let i = 0, begin = 0; i < c.x.length; i++) {
            if (kind_at(i) !== kind_at(begin)) begin = i;
            const run = runs[kind_at(i)];
            if (run && c.x[i] - c.x[begin] > run[1] - run[0]) runs[kind_at(i)] = [c.x[begin], c.x[i]];
        }
        const at = scene.middle === undefined ? middle + depth * 0.9 + small + 4 : middle - 0.1 * box.h;
        for (const kind of ["stick", "slip"])
            if (X(runs[kind][1]) - X(runs[kind][0]) > 44)
                pen.text(
                    X((runs[kind][0] + runs[kind][1]) / 2),
                    Math.min(at, foot - small - (box.w < 480 ? 12 : 8)),
                    words[kind],
                    { fill: kind, size: small + 4, weight: 650, anchor: "middle", halo: "body-b" },
                );
        if (box.w > 560) {
            const x = X(n.contact_to) + 14,
                has_room = x + 7 * small < right;
            pen.text(has_room ? x : right, Math.min(middle + depth + 4, foot - small - 10), words.enters, {
                fill: "soft",
                size: small,
                anchor: has_room ? "start" : "end",
                halo: "body-b",
            });
        }
    }
    const border = n.stick > 0 ? n.stick_from : n.contact_to;
    return { X, border: touching ? [X(border), surface(border)[0]] : null, middle, lift };
}

/* What stands in the corners of the lens. */
export function lens_words(w, { numbers: n }, fit, wide, rolls) {
    return {
        wide: fill_in(fit.slip === 1 ? w.wide_alone : wide < 520 ? w.wide_short : w.wide, {
            wide: show(fit.window[1] - fit.window[0], 2),
            slip: show(fit.slip, 2),
        }),
        press:
            n.contact_to > n.contact_from
                ? fill_in(wide < 340 ? w.press_short : w.press, { p0: show(n.max_pressure, 3) })
                : "",
        stick: w.sticks,
        slip: w.slips,
        enters: w.enters,
        friction: w.friction,
        moves: rolls ? w.moves : "",
    };
}

/* The coarser solution over the whole window, of which the surfaces beside the contact are drawn. */
export const shape_of = (given, reach) => ({
    ...given,
    mesh: "uniform",
    zone: String(Number(reach.toPrecision(3))),
    "contact-elements": "48",
});

/* The lens of a chapter as a figure, in the page's own colours, with an axis below it.  scene as draw_lens has it, and
 * given: the case; label: what it is, for who hears it; words: those of the first screen. */
const AXIS = 34;
export function lens_figure(words, answer, { width, height, given, label, unit = words.x_axis, ...scene }) {
    const pen = svg_pen(width, height, (name) => `var(--${name})`),
        box = { x: 1, y: 1, w: width - 2, h: height - AXIS - 1 },
        rolls = given.formulation === "steady" || given.formulation === "transient";
    const large = document.documentElement.classList.contains("large");
    const drawn = draw_lens(pen, box, {
        answer,
        large,
        shape: answer,
        share: share_of_ground(given, answer.values),
        bend: radius_of_ground(answer.values),
        way: 0,
        words: { ...lens_words(words.hero, answer, scene.fit, 0, rolls), ...(scene.blank && { press: "", wide: "" }) },
        ...scene,
    });
    const { window } = scene.fit,
        a = unit === "x/a" ? answer.numbers.half_width : 1;
    for (const v of ticks(window[0] / a, window[1] / a, Math.max(3, width / 95)))
        pen.text(drawn.X(v * a), height - 16, show(v, 3), { fill: "soft", size: large ? 16 : 13, anchor: "middle" });
    pen.text(width - 2, height - 3, unit, { fill: "soft", size: large ? 15 : 12, anchor: "end" });
    const root = new DOMParser().parseFromString(pen.end(null), "image/svg+xml").documentElement;
    root.setAttribute("role", "img");
    root.setAttribute("aria-label", label);
    root.removeAttribute("font-family");
    return Object.assign(document.importNode(root, true), { drawn });
}
