/* Elements, numbers and charts. */

const SVG = "http://www.w3.org/2000/svg";

/* K_I and K_II with their modes as indices. */
const typeset = (child) =>
    typeof child === "string" && /K_I/.test(child)
        ? child
              .split(/(K_II?)/)
              .map((part) =>
                  part.startsWith("K_") ? html("i", { class: "K" }, "K", html("sub", {}, part.slice(2))) : part,
              )
        : child;
export const write = (node, text) => node.replaceChildren(...[typeset(text)].flat());

function fill(node, attributes, children) {
    for (const [name, value] of Object.entries(attributes ?? {}))
        if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
        else if (value === true) node.setAttribute(name, "");
        else if (value !== false && value != null) node.setAttribute(name, value);
    node.append(
        ...children
            .flat()
            .filter((child) => child != null && child !== false)
            .flatMap(typeset),
    );
    return node;
}
export const html = (tag, attributes, ...children) => fill(document.createElement(tag), attributes, children);
export const svg = (tag, attributes, ...children) => fill(document.createElementNS(SVG, tag), attributes, children);

export function show(x, digits = 4) {
    if (x == null || !Number.isFinite(x)) return "–";
    if (x === 0) return "0";
    const size = Math.abs(x);
    const text = size >= 1e6 || size < 1e-3 ? x.toExponential(digits - 2) : String(Number(x.toPrecision(digits)));
    return text
        .replace(
            /e\+?(-?)(\d+)/,
            (_all, sign, power) =>
                `·10${[...(sign + power)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`,
        )
        .replaceAll("-", "−");
}

export function ticks(from, to, about) {
    const raw = (to - from) / about,
        power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999) ?? raw;
    const all = [];
    for (let x = Math.ceil(from / step - 1e-9) * step; x <= to + 1e-9 * step; x += step)
        all.push(Math.abs(x) < step * 1e-9 ? 0 : x);
    return all.length > 1 || about > 20 ? all : ticks(from, to, 2 * about); /* one number alone is no scale */
}

export const line = (points) =>
    points
        .filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y))
        .map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`)
        .join("");

/* Constant over each element. */
export const stairs = (ends, value, X, Y) =>
    line(
        value.flatMap((v, i) => [
            [X(ends[i]), Y(v)],
            [X(ends[i + 1]), Y(v)],
        ]),
    );

/* An empty chart: { root, X, Y, inner size }.  x, y: [from, to]. */
export function chart({
    width,
    height,
    x,
    y,
    x_label,
    y_label,
    label,
    left = 58,
    right = 14,
    top = 24,
    bottom = 42,
    y_ticks = 5,
}) {
    const X = (value) => left + ((value - x[0]) / (x[1] - x[0])) * (width - left - right);
    const Y = (value) => height - bottom - ((value - y[0]) / (y[1] - y[0])) * (height - top - bottom);
    const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": label });
    for (const v of ticks(...y, y_ticks))
        root.append(
            svg("path", {
                d: `M${left} ${Y(v)}H${width - right}`,
                style: `stroke:var(${v === 0 ? "--soft" : "--grid"});stroke-width:1`,
            }),
            svg("text", { x: left - 8, y: Y(v) + 4, "text-anchor": "end", class: "soft" }, show(v, 3)),
        );
    if (x_label)
        for (const v of ticks(...x, Math.max(3, width / 95)))
            root.append(
                svg("path", { d: `M${X(v)} ${height - bottom}v5`, style: "stroke:var(--soft)" }),
                svg("text", { x: X(v), y: height - bottom + 19, "text-anchor": "middle", class: "soft" }, show(v, 3)),
            );
    if (x_label)
        root.append(svg("text", { x: width - right, y: height - 4, "text-anchor": "end", class: "soft" }, x_label));
    if (y_label) root.append(svg("text", { x: left, y: 13, class: "soft" }, y_label));
    return { root, X, Y, left, right, top, bottom, width, height };
}

export const stroke = (colour, width = 2, more = "") =>
    `fill:none;stroke:var(${colour});stroke-width:${width};stroke-linejoin:round;${more}`;
export const zone_colours = ["--apart", "--stick", "--slip", "--slip-other", "--yield", "--yield-other"];

/* Entries [colour, text, how]: filled, hatched, or how = "dotted" or "dashed" as the line is. */
export function legend(...entries) {
    const node = html(
        "div",
        { class: "legend" },
        entries.map(([colour, text, how]) =>
            html(
                "span",
                {},
                html("i", {
                    class: how === "hatched" ? "hatched" : "",
                    style:
                        how && how !== "hatched"
                            ? `height:0;border-top:2px ${how} var(${colour});border-radius:0;vertical-align:4px`
                            : `background-color:var(${colour})`,
                }),
                text,
            ),
        ),
    );
    node.entries = entries;
    return node;
}

/* The width that a picture gets on the page. */
export const width_of = (host) => Math.max(280, Math.min(1600, host.clientWidth || 700));

/* A figure's height: the wanted one where the figure and its sliders then fit into the window together; around: what
 * else of its card stands in the same window. */
export const SIDE_BY_SIDE = "(min-width: 921px), (min-width: 561px) and (max-height: 480px)",
    ONE_COLUMN = "(max-width: 560px), (max-width: 920px) and (min-height: 481px)";
export const in_slides = () => document.documentElement.classList.contains("slides");
export function height_for(wanted, around = 0, least = 110) {
    if (in_slides()) return Math.round(Math.max(least, Math.min(1.4 * wanted, innerHeight - 230 - around)));
    const room = matchMedia(SIDE_BY_SIDE).matches ? innerHeight - (innerHeight > 480 ? 150 : 84) : 0.44 * innerHeight;
    return Math.round(Math.max(least, Math.min(wanted, room - around)));
}

export const card = (title, ...children) =>
    html("section", { class: "card" }, title && html("h3", {}, title), ...children);

/* What the library notes of these answers, beside their numbers. */
export const show_notes = (list, ...answers) =>
    list.replaceChildren(
        ...[...new Set(answers.flatMap((answer) => answer?.notes ?? []))].map((text) => html("li", {}, text)),
    );

/* One of several: entries [[value, text] ...]. */
export const segments = (name, label, entries, chosen, choose) =>
    html(
        "div",
        { class: "segments", role: "radiogroup", "aria-label": label },
        entries.map(([value, text]) =>
            html(
                "label",
                {},
                html("input", { type: "radio", name, value, checked: value === chosen, onchange: () => choose(value) }),
                html("span", {}, text),
            ),
        ),
    );

/* Buttons and a slider for something that goes in steps; see(k) shows one. */
export function player(words, { label, see, describe, milliseconds = 700 }) {
    let at = 0,
        count = 0,
        timer = null;
    const slider = html("input", {
        type: "range",
        min: 0,
        max: 0,
        value: 0,
        "aria-label": label,
        oninput: () => go(Number(slider.value)),
    });
    const output = html("output", { "aria-live": "polite" });
    const play = html(
        "button",
        { type: "button", class: "main", onclick: () => (timer ? stop() : start()) },
        words.play,
    );
    function stop() {
        clearInterval(timer);
        timer = null;
        play.textContent = words.play;
    }
    function start() {
        if (at >= count - 1) go(0);
        play.textContent = words.pause;
        timer = setInterval(() => (at >= count - 1 ? stop() : go(at + 1)), milliseconds);
    }
    function go(k) {
        at = Math.max(0, Math.min(count - 1, k));
        slider.value = at;
        output.textContent = describe(at, count);
        slider.setAttribute("aria-valuetext", output.textContent);
        see(at);
    }
    const button = (text, to, label) =>
        html(
            "button",
            {
                type: "button",
                "aria-label": label,
                title: label,
                onclick: () => {
                    stop();
                    go(to());
                },
            },
            text,
        );
    return {
        node: html(
            "div",
            { class: "players" },
            button("«", () => 0, words.first),
            button(words.back, () => at - 1),
            play,
            button(words.next, () => at + 1),
            button("»", () => count - 1, words.last),
            slider,
            output,
        ),
        /* Other steps: what plays goes on. */
        set(n, first) {
            count = n;
            slider.max = n - 1;
            go(timer ? Math.min(at, n - 1) : (first ?? Math.min(at, n - 1)));
        },
        go,
        stop,
        get at() {
            return at;
        },
        get count() {
            return count;
        },
    };
}
