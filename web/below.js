/* Chapter 6: the stress below the contact of the first screen, coarse while a hand moves something; its largest value
 * and the place of it are the library's own. */
import { card, height_for, html, segments, show, show_notes, svg, ticks, width_of } from "./draw.js";
import { draw_lens, fit_lens } from "./lens.js";
import { svg_pen } from "./pen.js";
import { ALL_TANGENTIAL, formulation_of, hold, plain } from "./state.js";
import { fill_in } from "./words.js";

const FINE = [81, 49],
    COARSE = [41, 25],
    FRINGES = 9,
    BANDS = 14;
/* A colour scale of even brightness steps, dark to bright. */
const SCALE = [
    [26, 29, 64],
    [38, 70, 120],
    [28, 120, 140],
    [72, 164, 124],
    [166, 196, 90],
    [244, 214, 96],
    [250, 240, 200],
];
const WHEEL = 0.3; /* what of the picture the wheel takes, above the stress in the ground */
const SKIDS = [0, 0.1, 0.2, 0.3, 0.4]; /* 0: it rolls freely */
const NEAR = 0.2; /* half-widths: a guess that is right */

function colour(t) {
    const place = Math.max(0, Math.min(0.99999, t)) * (SCALE.length - 1),
        k = Math.floor(place),
        part = place - k;
    return SCALE[k].map((v, i) => v + (SCALE[k + 1][i] - v) * part);
}
/* Of even steps upwards, so that colours mean the same while a hand moves something. */
const nice_above = (x) => {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((m) => m * power).find((v) => v >= x * 0.999);
};

/* The colours of the bands and their stresses. */
const bands = () => Array.from({ length: BANDS }, (_, k) => [k, `rgb(${colour(k / (BANDS - 0.5)).map(Math.round)})`]);
const scale_bar = (words, most) =>
    html(
        "div",
        { class: "scale", role: "img", "aria-label": fill_in(words.below_scale, { most: show(most) }) },
        html("span", {}, "0"),
        html("i", {
            style: `background:linear-gradient(90deg,${bands().map(([k, rgb]) => `${rgb} ${(100 * k) / BANDS}% ${(100 * (k + 1)) / BANDS}%`)})`,
        }),
        html("span", {}, `${show(most)} ${words.mpa}`),
    );

/* A field between its points, as an image. */
function image_of(field, [nx, ny], width, height, paint) {
    const canvas = document.createElement("canvas"),
        image = new ImageData((canvas.width = width), (canvas.height = height));
    for (let row = 0; row < height; row++)
        for (let column = 0; column < width; column++) {
            const u = (column / (width - 1)) * (nx - 1),
                v = (row / (height - 1)) * (ny - 1),
                i = Math.min(nx - 2, Math.floor(u)),
                j = Math.min(ny - 2, Math.floor(v));
            const s = u - i,
                t = v - j,
                at = i + nx * j;
            const value =
                (field[at] * (1 - s) + field[at + 1] * s) * (1 - t) +
                (field[at + nx] * (1 - s) + field[at + nx + 1] * s) * t;
            image.data.set(
                [...(Number.isFinite(value) ? paint(value) : [128, 128, 128]), 255],
                4 * (column + width * row),
            );
        }
    canvas.getContext("2d").putImageData(image, 0, 0);
    return canvas.toDataURL();
}

export function below_view(words, page) {
    const { store } = page,
        w = words.below;
    let data = null,
        kind = "max_shear",
        scale = 0,
        guess = null,
        revealed = false,
        skids = new Map(),
        drawn_for = null,
        place = null;
    const picture = html("figure"),
        note = html("p", { class: "answer", "aria-live": "polite" }),
        bar = html("div"),
        notes = html("ul", { class: "notes" });
    const choice = html(
        "div",
        { class: "narrow" },
        segments("below", words.below_title, Object.entries(words.below_kinds), kind, (value) => {
            kind = value;
            scale = 0;
            draw_anew();
        }),
    );
    const question = html("p", { class: "question" }, w.question),
        told = html("p", { class: "answer", "aria-live": "polite" });
    const reveal_button = html("button", { type: "button", class: "button main", onclick: () => reveal() }, w.reveal);
    const table = html("div");
    const knob = page.knob({
        name: "below-drive",
        label: w.drive,
        from: 0,
        to: 1.2,
        ends: [w.free, w.skids],
        read: (a) => Math.abs(a.numbers.creep_ratio) || 0,
        write: drive,
    });
    const mu = page.knob({
        name: "below-mu",
        label: words.hero.mu,
        from: 0,
        to: 0.5,
        read: (a) => Number(a.values.mu.split(",")[0]),
        write: (v) => page.change(page.with_mu(page.given, v)),
    });
    const node = html(
        "div",
        { class: "two" },
        html("div", { class: "tale" }, question, html("p", { class: "note" }, w.how), reveal_button, told),
        card(
            "",
            choice,
            picture,
            bar,
            note,
            notes,
            html(
                "div",
                { class: "row" },
                page.take_along(() => on_sheet(), "rollbem-stress", null),
            ),
        ),
        html(
            "div",
            { class: "after" },
            html("p", {}, w.then),
            html("div", { class: "knobs one" }, knob.node, mu.node),
            table,
            page.history_buttons(),
        ),
    );

    const on_sheet = () => ({
        root: picture.querySelector("svg"),
        title: fill_in(words.take.titles.below, { kind: words.below_kinds[kind] }),
        numbers: data.numbers,
        bar:
            revealed && kind !== "fringes"
                ? { colours: bands().map(([, rgb]) => rgb), from: "0", to: `${show(scale)} ${words.mpa}` }
                : null,
        legend:
            kind === "fringes"
                ? [["--ink", fill_in(words.below_fringes, { step: show((2 * scale) / FRINGES, 3) })]]
                : [],
    });

    /* The direction of the drive stays; full sliding is a creep ratio beyond 1. */
    function drive(value) {
        if (formulation_of(page.given) === "static")
            return page.change(hold(page.given, ALL_TANGENTIAL, "force-ratio", String(-Math.min(0.99, value))));
        const sign = store.solved.main?.numbers.creep_ratio < 0 ? -1 : 1;
        if (Number(page.given.mu) === 0)
            return page.change(hold(page.given, ALL_TANGENTIAL, "creep", plain(value / 1000)));
        page.change(hold(page.given, ALL_TANGENTIAL, "creep-ratio", String(Number((sign * value).toFixed(3)))));
    }
    function wants() {
        const [nx, ny] = store.holding ? COARSE : FINE;
        return store.trouble("main")
            ? []
            : [{ kind: "stress", given: page.given, nx, ny, depth: 0, maxima: !store.holding, grid: [nx, ny] }];
    }
    function take(answer, request) {
        if (request.skid !== undefined) {
            if (!answer.refused) skids.set(request.skid, answer);
            return draw_table();
        }
        data = answer.refused ? data : { ...answer, grid: request.grid, given: request.given };
        draw_anew();
    }
    function reveal() {
        revealed = true;
        draw_anew();
        if (formulation_of(page.given) !== "static" && !skids.size)
            for (const skid of SKIDS)
                page.ask({
                    kind: "stress",
                    slot: `skid ${skid}`,
                    view: "below",
                    skid,
                    given: {
                        ...hold(page.given, ALL_TANGENTIAL, "creep-ratio", skid ? "1.2" : "0"),
                        mu: String(skid || 0.3),
                    },
                    nx: 5,
                    ny: 4,
                    depth: 0,
                    maxima: true,
                });
    }
    /* { value, x, depth } of the largest stress: the library's, or of the grid while it moves. */
    function largest(name) {
        const found = data[`maxima.${name}`];
        if (found)
            return {
                value: found.at[0],
                x: found.at[1],
                depth: Math.abs(found.at[2] - surface_at(found.at[1])),
                own: true,
            };
        const field = data[`stress.${name}`].at,
            xs = data["stress.x"].at,
            ys = data["stress.y"].at,
            nx = data.grid[0];
        let best = 0;
        field.forEach((v, i) => {
            if (v > field[best]) best = i;
        });
        return { value: field[best], x: xs[best], depth: Math.abs(ys[best] - ys[best % nx]), own: false };
    }
    /* Height of the surface at x: the first row of the grid. */
    function surface_at(x) {
        const xs = data["stress.x"].at,
            nx = data.grid[0];
        let k = 0;
        while (k < nx - 1 && Math.abs(xs[k + 1] - x) < Math.abs(xs[k] - x)) k++;
        return data["stress.y"].at[k];
    }

    function draw_anew() {
        drawn_for = null;
        draw();
    }
    function draw() {
        knob.sync(store.solved.main);
        mu.sync(store.solved.main);
        picture.classList.toggle("stale", Boolean(store.trouble("main")));
        const key = [data, kind, revealed, guess, width_of(picture)].map(String).join() + (data?.milliseconds ?? "");
        if (!data || key === drawn_for) return;
        drawn_for = key;
        const name = kind === "fringes" ? "max_shear" : kind,
            field = data[`stress.${name}`].at,
            xs = data["stress.x"].at,
            ys = data["stress.y"].at,
            [nx, _ny] = data.grid;
        const width = width_of(picture),
            left = 52,
            right = 10,
            inner = width - left - right;
        const x0 = xs[0],
            x1 = xs[nx - 1],
            depth = Math.max(...ys) - Math.min(...ys),
            height = height_for(Math.min(420, (inner * depth) / (x1 - x0)) / (1 - WHEEL), 130, 190) * (1 - WHEEL),
            top = (height * WHEEL) / (1 - WHEEL);
        const most = largest(name);
        if (!scale || (!store.holding && (most.value > scale || most.value < 0.6 * scale)))
            scale = nice_above(most.value || 1);
        const X = (x) => left + ((x - x0) / (x1 - x0)) * inner,
            Y = (d) => top + (d / depth) * height;
        const root = svg("svg", {
            viewBox: `0 0 ${width} ${top + height + 50}`,
            width,
            height: top + height + 50,
            role: "img",
            "aria-label": revealed ? words.below_alt : w.guess_alt,
        });
        place = { X, Y, x0, x1, depth, left, inner, top, height, width };
        root.append(wheel_above({ x: left, y: 1, w: inner, h: top + height - 1 }, top, x0, x1));
        if (revealed) {
            const pixels = store.holding ? 260 : 560,
                tall = Math.max(20, Math.round((height * pixels) / inner));
            const paint =
                kind === "fringes"
                    ? (v) => Array(3).fill(250 * Math.sin((Math.PI * FRINGES * v) / scale) ** 2)
                    : (v) => colour(Math.floor((v / scale) * BANDS) / (BANDS - 0.5));
            root.append(
                svg("image", {
                    href: image_of(field, data.grid, pixels, tall, paint),
                    x: left,
                    y: top,
                    width: inner,
                    height,
                    preserveAspectRatio: "none",
                }),
            );
        } else root.append(svg("rect", { x: left, y: top, width: inner, height, style: "fill:var(--body-b)" }));
        for (const v of ticks(x0, x1, Math.max(4, width / 110)))
            root.append(
                svg("text", { x: X(v), y: top + height + 18, "text-anchor": "middle", class: "soft" }, show(v, 3)),
            );
        for (const v of ticks(0, depth, 5))
            root.append(svg("text", { x: left - 8, y: Y(v) + 5, "text-anchor": "end", class: "soft" }, show(v, 3)));
        root.append(
            svg("text", { x: width - right, y: top + height + 40, "text-anchor": "end", class: "soft" }, words.x_axis),
            svg("text", { x: left, y: top + height + 40, class: "soft" }, "↓ " + words.depth),
        );
        const mark = (x, y, style) => [
            svg("circle", { cx: x, cy: y, r: 9, style: "fill:none;stroke:#fff;stroke-width:5" }),
            svg("circle", { cx: x, cy: y, r: 9, style }),
        ];
        if (revealed) root.append(...mark(X(most.x), Y(most.depth), "fill:none;stroke:#101418;stroke-width:2.2"));
        if (guess)
            root.append(
                svg("path", {
                    d: `M${X(guess.x) - 8} ${Y(guess.depth) - 8}l16 16m0 -16l-16 16`,
                    style: "stroke:#fff;stroke-width:6;stroke-linecap:round",
                }),
                svg("path", {
                    d: `M${X(guess.x) - 8} ${Y(guess.depth) - 8}l16 16m0 -16l-16 16`,
                    style: "stroke:var(--accent);stroke-width:3;stroke-linecap:round",
                }),
            );
        if (!revealed) make_guessable(root);
        picture.replaceChildren(root);
        choice.hidden = !revealed;
        node.classList.toggle("revealed", revealed);
        reveal_button.hidden = revealed;
        show_notes(notes, data);
        if (!revealed) return;
        bar.replaceChildren(kind === "fringes" ? "" : scale_bar(words, scale));
        const a = data.numbers.half_width,
            p0 = data.numbers.max_pressure;
        note.textContent =
            fill_in(words.below_note, {
                what: words.below_kinds[name],
                value: show(most.value, 3),
                part: show(most.value / p0, 3),
                x: show(most.x, 2),
                place:
                    most.depth > 0.02 * a
                        ? fill_in(words.below_depth, { depth: show(most.depth, 3), part: show(most.depth / a, 2) })
                        : words.below_surface,
            }) +
            (most.own ? "" : ` ${w.coarse}`) +
            (kind === "fringes" ? " " + fill_in(words.below_fringes, { step: show((2 * scale) / FRINGES, 3) }) : "");
        const shear = largest("max_shear"),
            deep = shear.depth > 0.02 * a,
            off = guess && Math.hypot(guess.x - shear.x, guess.depth - shear.depth) / a;
        told.textContent = [
            guess && (off < NEAR ? w.right : fill_in(w.wrong, { off: show(off, 2) })),
            fill_in(deep ? w.answer_below : w.answer_surface, {
                depth: show(shear.depth / a, 2),
                part: show(shear.value / p0, 2),
            }),
            Number(data.given.mu) === 0 ? w.smooth : w.why,
        ]
            .filter(Boolean)
            .join(" ");
        draw_table();
    }
    /* The wheel's half of the lens, with a plane surface as the map of the stress has it. */
    function wheel_above(box, top, x0, x1) {
        const pen = svg_pen(width_of(picture), box.h + 2, (name) => `var(--${name})`),
            flat = { x: [x0, x1], gap: [0, 0], un: [0, 0] },
            n = data.numbers;
        draw_lens(pen, box, {
            answer: data,
            shape: { numbers: n, columns: flat },
            share: 0,
            bend: Infinity,
            fit: { ...fit_lens(data), window: [x0, x1], lift: 1, press: (0.5 / WHEEL) * n.max_pressure },
            way: 0,
            large: page.large(),
            middle: (top - box.y) / box.h,
            words: {
                wide: "",
                press: box.w < 480 ? "" : fill_in(words.hero.press, { p0: show(n.max_pressure, 3) }),
                stick: words.hero.sticks,
                slip: words.hero.slips,
                enters: "",
                friction: "",
                moves: "",
            },
        });
        return document.importNode(
            new DOMParser().parseFromString(pen.end(null), "image/svg+xml").documentElement,
            true,
        );
    }
    /* A point is marked by pointer, or by arrow keys and Enter. */
    function make_guessable(root) {
        root.setAttribute("role", "group");
        const box = svg("rect", {
            x: place.left,
            y: place.top,
            width: place.inner,
            height: place.height,
            tabindex: 0,
            role: "button",
            "aria-label": w.guess_alt,
            style: "fill:transparent;cursor:crosshair",
        });
        const put = (x, depth) => {
            guess = { x: Math.max(place.x0, Math.min(place.x1, x)), depth: Math.max(0, Math.min(place.depth, depth)) };
        };
        box.addEventListener("click", (event) => {
            const rect = root.getBoundingClientRect(),
                zoom = place.width / rect.width;
            put(
                place.x0 + (((event.clientX - rect.left) * zoom - place.left) / place.inner) * (place.x1 - place.x0),
                (((event.clientY - rect.top) * zoom - place.top) / place.height) * place.depth,
            );
            reveal();
        });
        box.addEventListener("keydown", (event) => {
            if (event.key === "Enter" || event.key === " ") {
                event.preventDefault();
                guess ??= { x: 0, depth: 0 };
                return reveal();
            }
            const [dx, dy] =
                { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key] ?? [];
            if (dx === undefined) return;
            event.preventDefault();
            const from = guess ?? { x: (place.x0 + place.x1) / 2, depth: 0 },
                step = place.depth / 25;
            put(from.x + dx * step, from.depth + dy * step);
            draw_anew();
            picture.querySelector("rect[tabindex]")?.focus();
        });
        root.append(box);
    }
    function draw_table() {
        if (!revealed || !skids.size) return;
        const rows = SKIDS.filter((skid) => skids.has(skid)).map((skid) => {
            const answer = skids.get(skid),
                found = answer["maxima.max_shear"].at,
                { half_width: a, max_pressure: p0 } = answer.numbers;
            const depth = Math.abs(found[2] - answer["stress.y"].at[2]) / a;
            return [
                skid ? show(skid) : w.rolls_freely,
                depth > 0.02 ? `${show(depth, 2)} a` : words.below_surface,
                `${show(found[0] / p0, 3)} p₀`,
            ];
        });
        table.replaceChildren(
            html(
                "table",
                { class: "skids" },
                html("caption", {}, w.table),
                html(
                    "thead",
                    {},
                    html(
                        "tr",
                        {},
                        w.head.map((text) => html("th", { scope: "col" }, text)),
                    ),
                ),
                html(
                    "tbody",
                    {},
                    rows.map((row) =>
                        html(
                            "tr",
                            {},
                            row.map((text) => html("td", {}, text)),
                        ),
                    ),
                ),
            ),
        );
    }
    return {
        node,
        render: draw,
        uses: ["main"],
        fine: true,
        wants,
        take,
        resize: draw_anew,
        reveal,
        is_deep: () => Boolean(data) && largest("max_shear").depth > 0.02 * data.numbers.half_width,
        data: () => data,
        shown: () => revealed,
    };
}
