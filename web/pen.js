/* Pictures that are drawn anew many times a second: the same calls on a canvas, or as the text of an SVG file.
 * Colours are the names of the page's own ("slip"), shapes are lists of [x, y] in CSS pixels. */

const FONT = 'system-ui, "Segoe UI", "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif';

/* The page's colours as they are now, by name. */
export function read_palette() {
    const style = getComputedStyle(document.documentElement);
    const known = new Map();
    return (name) => {
        if (!known.has(name)) known.set(name, style.getPropertyValue(`--${name}`).trim() || name);
        return known.get(name);
    };
}

export function canvas_pen(canvas, width, height, palette) {
    const density = Math.min(2, window.devicePixelRatio || 1);
    const [w, h] = [Math.round(width * density), Math.round(height * density)];
    if (canvas.width !== w || canvas.height !== h) Object.assign(canvas, { width: w, height: h });
    const context = canvas.getContext("2d");
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, width, height);
    const path = (points, closed) => {
        context.beginPath();
        points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
        if (closed) context.closePath();
    };
    const ink = ({ fill, stroke, width: wide = 1.5, dash = [], alpha = 1 }) => {
        context.globalAlpha = alpha;
        if (fill) {
            context.fillStyle = palette(fill);
            context.fill();
        }
        if (stroke) {
            context.strokeStyle = palette(stroke);
            context.lineWidth = wide;
            context.lineJoin = context.lineCap = "round";
            context.setLineDash(dash);
            context.stroke();
        }
        context.globalAlpha = 1;
    };
    return {
        shape(points, style) {
            path(points, Boolean(style.fill));
            ink(style);
        },
        /* Many unconnected lines in one stroke. */
        strokes(lines, style) {
            context.beginPath();
            for (const points of lines)
                points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
            ink(style);
        },
        circle(x, y, r, style) {
            context.beginPath();
            context.arc(x, y, r, 0, 2 * Math.PI);
            ink(style);
        },
        text(x, y, words, { fill = "ink", size = 13, weight = 400, anchor = "start", halo } = {}) {
            context.font = `${weight} ${size}px ${FONT}`;
            context.textAlign = { start: "left", middle: "center", end: "right" }[anchor];
            if (halo) {
                context.strokeStyle = palette(halo);
                context.lineWidth = 4;
                context.lineJoin = "round";
                context.setLineDash([]);
                context.strokeText(words, x, y);
            }
            context.fillStyle = palette(fill);
            context.fillText(words, x, y);
        },
        clip(x, y, w, h, radius, draw) {
            context.save();
            context.beginPath();
            context.roundRect(x, y, w, h, radius);
            context.clip();
            draw();
            context.restore();
        },
        frame(x, y, w, h, radius, style) {
            context.beginPath();
            context.roundRect(x, y, w, h, radius);
            ink(style);
        },
    };
}

let clips = 0; /* several pictures of one page, each with names of its own */
export function svg_pen(width, height, palette) {
    const out = [];
    const safe = (text) =>
        String(text).replace(/[<>&"]/g, (c) => ({ "<": "&lt;", ">": "&gt;", "&": "&amp;", '"': "&quot;" })[c]);
    const number = (v) => Number(v.toFixed(2));
    const d = (points) => points.map(([x, y], k) => `${k ? "L" : "M"}${number(x)} ${number(y)}`).join("");
    const attributes = ({ fill, stroke, width: wide = 1.5, dash, alpha = 1, name }) =>
        (name ? `class="${safe(name)}" ` : "") +
        `fill="${fill ? safe(palette(fill)) : "none"}"` +
        (stroke
            ? ` stroke="${safe(palette(stroke))}" stroke-width="${wide}" stroke-linejoin="round" stroke-linecap="round"`
            : "") +
        (dash?.length ? ` stroke-dasharray="${dash.join(" ")}"` : "") +
        (alpha < 1 ? ` opacity="${alpha}"` : "");
    return {
        shape: (points, style) => out.push(`<path d="${d(points)}${style.fill ? "Z" : ""}" ${attributes(style)}/>`),
        strokes: (lines, style) =>
            lines.length && out.push(`<path d="${lines.map(d).join("")}" ${attributes(style)}/>`),
        circle: (x, y, r, style) =>
            out.push(`<circle cx="${number(x)}" cy="${number(y)}" r="${number(r)}" ${attributes(style)}/>`),
        text(x, y, words, { fill = "ink", size = 13, weight = 400, anchor = "start", halo } = {}) {
            const around = halo
                ? ` stroke="${safe(palette(halo))}" stroke-width="4" stroke-linejoin="round" paint-order="stroke"`
                : "";
            out.push(
                `<text x="${number(x)}" y="${number(y)}" text-anchor="${anchor}" style="font-size:${size}px;font-weight:${weight};fill:${safe(palette(fill))}"${around}>${safe(words)}</text>`,
            );
        },
        clip(x, y, w, h, radius, draw) {
            const id = `clip${++clips}`;
            out.push(
                `<clipPath id="${id}"><rect x="${x}" y="${y}" width="${w}" height="${h}" rx="${radius}"/></clipPath><g clip-path="url(#${id})">`,
            );
            draw();
            out.push("</g>");
        },
        frame: (x, y, w, h, radius, style) =>
            out.push(`<rect x="${x}" y="${y}" width="${w}" height="${h}" rx="${radius}" ${attributes(style)}/>`),
        /* background: none for a picture of the page itself */
        end: (background = "paper") =>
            `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="${safe(FONT)}">` +
            `${background ? `<rect width="100%" height="100%" fill="${safe(palette(background))}"/>` : ""}${out.join("")}</svg>`,
    };
}
