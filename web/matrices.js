/* From the boundary to the complementarity problem: the wheel's elements, H and G, condensation, F
 * and M as shades, with the block under the pointer explained. */
import { html, show, stroke, svg } from "./draw.js";
import { fill_in } from "./words.js";

export const parse = (name) => {
    const m = /^([a-z0-9]+[+-]?)(?:\[(\d+)\])?$/.exec(name);
    return { kind: m[1], i: Number(m[2] ?? 0) };
};
export const pretty = (words, name) => {
    const { kind, i } = parse(name);
    return kind === "z0" ? "z₀" : words.basis[kind] ? `${words.basis[kind]} ${i}` : words.rows[kind];
};

/* The longest run of equal entries about i: { from, size }. */
function run_about(kinds, i) {
    let from = i,
        to = i;
    while (from > 0 && kinds[from - 1] === kinds[i]) from--;
    while (to < kinds.length - 1 && kinds[to + 1] === kinds[i]) to++;
    return { from, size: to - from + 1 };
}

/* A matrix as shades: blue negative, ochre positive (orange is slip alone), small values lifted by a root.  rows, columns:
 * the kind of each, equal ones side by side are a block; explain(i, j, value, block) says what an
 * entry is, see(i, j) is told of it. */
function shaded(words, name, matrix, { rows, columns, explain, see = () => {} }) {
    const { at } = matrix,
        canvas = html("canvas", {
            width: columns.length,
            height: rows.length,
            tabindex: 0,
            role: "img",
            "aria-label": words.matrix_names[name],
        });
    const most = Math.max(...at.map(Math.abs)) || 1,
        image = new ImageData(columns.length, rows.length),
        dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const zero = dark ? [26, 32, 41] : [255, 254, 251],
        ends = dark
            ? [
                  [108, 197, 228],
                  [217, 199, 104],
              ]
            : [
                  [20, 99, 126],
                  [122, 106, 29],
              ];
    for (let i = 0; i < rows.length; i++)
        for (let j = 0; j < columns.length; j++) {
            const v = at[i + rows.length * j] / most,
                t = Math.abs(v) ** 0.4,
                end = ends[v < 0 ? 0 : 1];
            image.data.set([...zero.map((z, k) => z + (end[k] - z) * t), 255], 4 * (j + columns.length * i));
        }
    canvas.getContext("2d").putImageData(image, 0, 0);
    const text = html("p", { "aria-live": "polite" }, words.matrix_hint),
        outline = html("i", { hidden: true }),
        place = { i: 0, j: 0 };
    function announce() {
        const { i, j } = place,
            r = run_about(rows, i),
            c = run_about(columns, j);
        outline.hidden = false;
        outline.style.cssText = `left:${(100 * c.from) / columns.length}%;top:${(100 * r.from) / rows.length}%;width:${(100 * c.size) / columns.length}%;height:${(100 * r.size) / rows.length}%`;
        text.textContent = explain(i, j, show(at[i + rows.length * j], 3), { row: rows[i], column: columns[j] });
        see(i, j);
    }
    canvas.addEventListener("pointermove", (event) => {
        const box = canvas.getBoundingClientRect();
        place.j = Math.max(
            0,
            Math.min(columns.length - 1, Math.floor(((event.clientX - box.left) / box.width) * columns.length)),
        );
        place.i = Math.max(
            0,
            Math.min(rows.length - 1, Math.floor(((event.clientY - box.top) / box.height) * rows.length)),
        );
        announce();
    });
    canvas.addEventListener("keydown", (event) => {
        const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
        if (!step) return;
        event.preventDefault();
        place.i = Math.max(0, Math.min(rows.length - 1, place.i + step[0]));
        place.j = Math.max(0, Math.min(columns.length - 1, place.j + step[1]));
        announce();
    });
    return html(
        "figure",
        { class: "matrix", "data-matrix": name },
        html("figcaption", {}, html("b", {}, words.matrix_names[name]), ` ${rows.length} × ${columns.length}`),
        html(
            "div",
            { class: "blocks", style: `width:${100 * Math.min(1, columns.length / rows.length)}%` },
            canvas,
            outline,
        ),
        text,
    );
}

/* ---- The boundary ---- */

/* "contact", "held" or "free" of each boundary element of the wheel, by where it lies. */
function kinds_of(a, n) {
    const [x0, y0, x1, y1] = ["mesh.x0", "mesh.y0", "mesh.x1", "mesh.y1"].map((name) => a[name].at),
        ends = a.ends.at;
    const R = Number(a.values.radius),
        hub = a.values.support === "hub" ? (R * (1 + Number(a.values["hub-ratio"]))) / 2 : 0,
        arc = a.values.support === "arc" ? (Number(a.values.arc) * Math.PI) / 180 : 0;
    return [...x0].map((_, k) => {
        const x = (x0[k] + x1[k]) / 2,
            y = (y0[k] + y1[k]) / 2 - R;
        if (Math.hypot(x, y) < hub || (y > 0 && Math.abs(Math.atan2(x, y)) < arc)) return "held";
        return y < 0 && x > ends[0] && x < ends[n] && Math.hypot(x, y) > 0.9 * R ? "contact" : "free";
    });
}
const boundary_colours = { contact: "--reference", held: "--ink", free: "--rub" };

/* The elements; see(i, j) marks two of them. */
function boundary_picture(words, a, kinds) {
    const [x0, y0, x1, y1] = ["mesh.x0", "mesh.y0", "mesh.x1", "mesh.y1"].map((name) => a[name].at),
        R = Number(a.values.radius),
        size = 260,
        scale = 112 / R;
    const X = (x) => size / 2 + x * scale,
        Y = (y) => size / 2 - (y - R) * scale,
        marks = svg("g");
    const root = svg(
        "svg",
        { viewBox: `0 0 ${size} ${size}`, role: "img", "aria-label": fill_in(words.boundary_alt, { n: kinds.length }) },
        kinds.map((kind, k) =>
            svg("path", {
                d: `M${X(x0[k])} ${Y(y0[k])}L${X(x1[k])} ${Y(y1[k])}`,
                style: stroke(boundary_colours[kind], kind === "free" ? 2.5 : 5),
            }),
        ),
        kinds.map((kind, k) =>
            svg("circle", { cx: X(x0[k]), cy: Y(y0[k]), r: 1.8, style: `fill:var(${boundary_colours[kind]})` }),
        ),
        marks,
    );
    const middle = (k) => [X((x0[k] + x1[k]) / 2), Y((y0[k] + y1[k]) / 2)];
    function see(i, j) {
        const [[xi, yi], [xj, yj]] = [middle(i), middle(j)];
        marks.replaceChildren(
            svg("path", { d: `M${xj} ${yj}L${xi} ${yi}`, style: stroke("--soft", 1.3, "stroke-dasharray:4 4") }),
            svg("circle", { cx: xj, cy: yj, r: 7, style: "fill:var(--accent);stroke:var(--card);stroke-width:2" }),
            svg("circle", { cx: xi, cy: yi, r: 7, style: "fill:var(--card);stroke:var(--accent);stroke-width:3" }),
        );
    }
    const legend = html(
        "div",
        { class: "legend" },
        ["contact", "free", "held"].map((kind) =>
            html("span", {}, html("i", { style: `background:var(${boundary_colours[kind]})` }), words.boundary[kind]),
        ),
    );
    return {
        node: html(
            "figure",
            { class: "matrix" },
            html("figcaption", {}, html("b", {}, words.boundary_title), ` ${kinds.length}`),
            root,
            legend,
        ),
        see,
    };
}

/* The columns of unknowns, A, and those of the contact's tractions, G_c, out of H and G. */
function condensed(a, kinds) {
    const N = 2 * kinds.length,
        contact = kinds.flatMap((kind, k) => (kind === "contact" ? [2 * k, 2 * k + 1] : []));
    const column = (matrix, j, sign) => Array.from({ length: N }, (_, i) => sign * matrix.at[i + N * j]);
    return {
        A: {
            at: kinds.flatMap((kind, k) =>
                [0, 1].flatMap((d) => (kind === "held" ? column(a.G, 2 * k + d, -1) : column(a.H, 2 * k + d, 1))),
            ),
        },
        Gc: { at: contact.flatMap((j) => column(a.G, j, 1)) },
        contact,
    };
}

/* The blocks of M by name; the orientation of slip decides which signs stand first. */
function block_table(words, size, kind) {
    const some = (from, word) =>
        Array.from({ length: size }, (_, k) => kind(from + k)).find((name) => name.startsWith(word));
    const rows = ["gap", "lambda", "gamma"],
        columns = ["p", "gamma", "lambda"];
    return html(
        "figure",
        { class: "matrix" },
        html("figcaption", {}, html("b", {}, words.blocks_title)),
        html(
            "table",
            { class: "formulas" },
            html(
                "thead",
                {},
                html(
                    "tr",
                    {},
                    html("td"),
                    columns.map((name) => html("th", { scope: "col" }, words.basis[some(size, name)])),
                ),
            ),
            html(
                "tbody",
                {},
                rows.map((row) =>
                    html(
                        "tr",
                        {},
                        html("th", { scope: "row" }, words.basis[some(0, row)]),
                        columns.map((column) => html("td", {}, words.formulas[`${row} ${column}`])),
                    ),
                ),
            ),
        ),
    );
}

export function matrices(words, a, n) {
    const flexibility = (i, j, value) => {
        const ei = i % (n + 1);
        return fill_in(words.matrix_F, {
            i: i + 1,
            j: j + 1,
            value,
            di: i <= n ? words.normal : words.tangent,
            dj: j < n ? words.pressing : words.rubbing,
            ei: ei === n ? fill_in(words.upstream, { n: n + 1 }) : ei + 1,
            ej: (j % n) + 1,
        });
    };
    const F =
        a.F &&
        shaded(words, "F", a.F, {
            rows: Array.from({ length: 2 * n + 2 }, (_, i) => (i <= n ? "N" : "T")),
            columns: Array.from({ length: 2 * n }, (_, j) => (j < n ? "N" : "T")),
            explain: (i, j, value, block) => `${fill_in(words.block_F, block)} ${flexibility(i, j, value)}`,
        });
    const size = a["lcp.M"].rows,
        kind = (k) => parse(a.names[k]).kind,
        bare = (name) => name.replace(/[+-]/, "");
    const M = shaded(words, "lcp.M", a["lcp.M"], {
        rows: Array.from({ length: size }, (_, i) => kind(i)),
        columns: Array.from({ length: size }, (_, j) => kind(size + j)),
        explain: (i, j, value, { row, column }) =>
            `${words.blocks_M[`${bare(row)} ${bare(column)}`] ?? words.block_border} ${fill_in(words.matrix_M, { i: i + 1, j: j + 1, value, wi: pretty(words, a.names[i]), zj: pretty(words, a.names[size + j]) })}`,
    });
    const lcp = [
        html("h4", {}, words.lcp_title),
        html("p", {}, words.lcp_note),
        html("p", { class: "note" }, words.step.scaled),
        html("div", { class: "quad" }, a.H ? null : F, M, block_table(words, size, kind)),
    ];
    if (!a.H) return [html("p", { class: "note" }, words.no_boundary), ...lcp];

    const kinds = kinds_of(a, n),
        boundary = boundary_picture(words, a, kinds),
        { A, Gc, contact } = condensed(a, kinds),
        dof = kinds.flatMap((k) => [k, k]);
    const element = (k) => ({ e: Math.floor(k / 2) + 1, d: words.direction[k % 2] });
    const influence = (which, to = (j) => j) => ({
        rows: dof,
        columns: which === "Gc" ? contact.map(() => "contact") : dof,
        see: (i, j) => boundary.see(Math.floor(i / 2), Math.floor(to(j) / 2)),
        explain: (i, j, value, { row, column }) =>
            fill_in(words.block_boundary, { row: words.boundary[row], column: words.boundary[column] }) +
            " " +
            fill_in(words[which === "A" && column === "held" ? "matrix_A_held" : `matrix_${which}`], {
                i: i + 1,
                j: j + 1,
                value,
                ei: element(i).e,
                ej: element(to(j)).e,
                di: element(i).d,
                dj: element(to(j)).d,
            }),
    });
    return [
        html(
            "div",
            { class: "quad" },
            boundary.node,
            shaded(words, "H", a.H, influence("H")),
            shaded(words, "G", a.G, influence("G")),
        ),
        html("h4", {}, words.condense_title),
        html(
            "p",
            {},
            fill_in(words.condense_note, {
                N: 2 * kinds.length,
                n: contact.length,
                held: 2 * kinds.filter((kind) => kind === "held").length,
            }),
        ),
        html(
            "div",
            { class: "quad" },
            shaded(words, "A", A, influence("A")),
            shaded(
                words,
                "Gc",
                Gc,
                influence("Gc", (j) => contact[j]),
            ),
            F,
        ),
        ...lcp,
    ];
}
