/* Stress below the surface of A: contours and photoelastic fringes. */
import { card, html, segments, show, ticks, svg, width_of } from "./draw.js";
import { say } from "./words.js";

const NX = 81, NY = 49, FRINGES = 9, BANDS = 14;
/* A colour scale of even brightness steps, dark to bright. */
const SCALE = [[26, 29, 64], [38, 70, 120], [28, 120, 140], [72, 164, 124], [166, 196, 90], [244, 214, 96], [250, 240, 200]];

function colour(t) {
    const place = Math.max(0, Math.min(0.99999, t)) * (SCALE.length - 1), k = Math.floor(place), part = place - k;
    return SCALE[k].map((v, i) => v + (SCALE[k + 1][i] - v) * part);
}

/* The colours of the bands and their stresses. */
const scale_bar = (words, most) => html("div", { class: "scale", role: "img", "aria-label": say(words.below_scale, { most: show(most) }) },
    html("span", {}, "0"), html("i", { style: `background:linear-gradient(90deg,${Array.from({ length: BANDS }, (_, k) => `rgb(${colour(k / (BANDS - 0.5)).map(Math.round)}) ${100 * k / BANDS}% ${100 * (k + 1) / BANDS}%`).join()})` }), html("span", {}, `${show(most)} ${words.mpa}`));

export function below_view(words, page) {
    let data = null, kind = "max_shear";
    const picture = html("figure"), note = html("p", { "aria-live": "polite" });
    const choice = html("div", { style: "max-width:34rem" }, segments("below", words.below_title, Object.entries(words.below_kinds), kind, (value) => { kind = value; draw(); }));
    const node = html("div", { class: "stack" }, card(words.below_title, choice, picture, note));

    function draw() {
        if (!data) return;
        const name = kind === "fringes" ? "max_shear" : kind, field = data[`stress.${name}`].at, xs = data["stress.x"].at, ys = data["stress.y"].at;
        const width = width_of(picture), left = 58, right = 10, inner = width - left - right;
        const x0 = xs[0], x1 = xs[NX - 1], depth = Math.max(...ys) - Math.min(...ys), height = Math.min(560, Math.round(inner * depth / (x1 - x0)));
        let best = 0, most = 0;
        for (let i = 0; i < field.length; i++) if (Number.isFinite(field[i]) && field[i] > most) { most = field[i]; best = i; }
        const canvas = document.createElement("canvas"), image = new ImageData(canvas.width = Math.min(900, Math.round(inner)), canvas.height = Math.round(height * canvas.width / inner));
        for (let row = 0; row < canvas.height; row++)
            for (let column = 0; column < canvas.width; column++) {
                const u = column / (canvas.width - 1) * (NX - 1), v = row / (canvas.height - 1) * (NY - 1), i = Math.min(NX - 2, Math.floor(u)), j = Math.min(NY - 2, Math.floor(v));
                const s = u - i, t = v - j, at = i + NX * j;
                const value = (field[at] * (1 - s) + field[at + 1] * s) * (1 - t) + (field[at + NX] * (1 - s) + field[at + NX + 1] * s) * t;
                const rgb = !Number.isFinite(value) ? [128, 128, 128] : kind === "fringes" ? Array(3).fill(250 * Math.sin(Math.PI * FRINGES * value / most) ** 2)
                    : colour(Math.floor(value / most * BANDS) / (BANDS - 0.5));
                image.data.set([...rgb, 255], 4 * (column + canvas.width * row));
            }
        canvas.getContext("2d").putImageData(image, 0, 0);
        const X = (x) => left + (x - x0) / (x1 - x0) * inner, top = 12, y0 = ys[(NX - 1) / 2];
        const Y = (d) => top + d / depth * height;
        const root = svg("svg", { viewBox: `0 0 ${width} ${height + 62}`, width, height: height + 62, role: "img", "aria-label": words.below_alt });
        root.append(svg("image", { href: canvas.toDataURL(), x: left, y: top, width: inner, height }));
        for (const v of ticks(x0, x1, Math.max(4, width / 110))) root.append(svg("text", { x: X(v), y: height + 34, "text-anchor": "middle", class: "soft" }, show(v, 3)));
        for (const v of ticks(0, depth, 5)) root.append(svg("text", { x: left - 8, y: Y(v) + 5, "text-anchor": "end", class: "soft" }, show(v, 3)));
        root.append(svg("text", { x: width - right, y: height + 54, "text-anchor": "end", class: "soft" }, words.x_axis), svg("text", { x: left, y: height + 54, class: "soft" }, "↓ " + words.depth));
        const { contact_from: from, contact_to: to } = data.numbers;
        root.append(svg("path", { d: `M${X(from)} ${top - 3}H${X(to)}`, style: "stroke:var(--slip);stroke-width:6" }));
        const place = best % NX, below = (ys[best] - ys[place]), mark = [X(xs[best]), Y(below)];
        root.append(svg("circle", { cx: mark[0], cy: mark[1], r: 8, style: "fill:none;stroke:#fff;stroke-width:4" }), svg("circle", { cx: mark[0], cy: mark[1], r: 8, style: "fill:none;stroke:#c4501b;stroke-width:2.2" }));
        picture.replaceChildren(root, kind === "fringes" ? "" : scale_bar(words, most));
        note.textContent = say(words.below_note, { what: words.below_kinds[name], value: show(most), x: show(xs[best], 3), place: below > 0 ? say(words.below_depth, { depth: show(below, 3) }) : words.below_surface })
            + (kind === "fringes" ? " " + say(words.below_fringes, { step: show(2 * most / FRINGES, 3) }) : "");
    }
    return { node, draw, wants: () => [{ kind: "stress", given: page.given, nx: NX, ny: NY, depth: 0 }], take(answer) { data = answer; draw(); } };
}
