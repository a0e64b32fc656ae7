/* Take it away: the case as a file and as a command, its numbers and its picture. */
import { card, html, show, svg } from "./draw.js";
import { tractions_legend, tractions_picture } from "./contact.js";
import { contact_of, crack_of, write_link } from "./state.js";
import { fill_in } from "./words.js";

const words_for_crack = (given) => Object.entries(crack_of(given)).map(([name, text]) => `--${name} ${text}`);
export const command_of = (given, options) =>
    [
        words_for_crack(given).length ? "rollbem crack" : "rollbem",
        ...options
            .filter((o) => o.name in given && o.kind !== "group")
            .map((o) =>
                o.kind === "flag"
                    ? given[o.name] === "yes"
                        ? `--${o.name}`
                        : ""
                    : /^[\w.+-]+$/.test(given[o.name])
                      ? `--${o.name} ${given[o.name]}`
                      : `--${o.name} '${given[o.name].replaceAll("'", "'\\''")}'`,
            )
            .filter(Boolean),
        ...words_for_crack(given),
    ].join(" ");

export const ini_of = (given, options) =>
    options
        .filter((o) => o.kind === "group")
        .map((group) => {
            const rows = options.filter((o) => o.section === group.name && o.kind !== "group" && o.name in given);
            return rows.length
                ? `[${group.name}]\n${rows.map((o) => `${o.name} = ${given[o.name]}`).join("\n")}\n`
                : "";
        })
        .concat(
            ["[crack]\n", ...Object.entries(crack_of(given)).map(([name, text]) => `${name} = ${text}\n`)]
                .join("")
                .replace(/^\[crack\]\n$/, ""),
        )
        .filter(Boolean)
        .join("\n");

/* As the program heads its columns: a ratio has no unit. */
const column_name = (r) => (r.unit && r.unit !== "1" ? `${r.name}_${r.unit}` : r.name);
export const table_of = (columns, results) =>
    [
        results.map(column_name).join("\t"),
        ...[...columns.x].map((_x, i) => results.map((r) => columns[r.name][i]).join("\t")),
    ].join("\n") + "\n";

/* As the program's --json has them, without what only the program has (input_hash, seconds). */
export function json_of(words, answer, given, options, results) {
    const number = (x) => (Number.isFinite(x) ? x : null),
        kind = Object.fromEntries(options.map((o) => [o.name, o.kind]));
    const input = (name, text) =>
        kind[name] === "flag"
            ? text === "yes"
            : (kind[name] === "number" || kind[name] === "integer") && Number.isFinite(Number(text))
              ? Number(text)
              : text;
    const { status, formulation, solver, "lcp-form": lcp_form } = answer.words;
    return JSON.stringify(
        {
            schema: "rollbem/1",
            version: VERSION,
            command: command_of(given, options),
            conventions: words.conventions,
            notes: answer.notes,
            units: words.json_units,
            inputs: Object.fromEntries(Object.entries(given).map(([name, text]) => [name, input(name, text)])),
            summary: {
                status,
                formulation,
                solver,
                lcp_form,
                ...Object.fromEntries(
                    results.number
                        .filter((r) => r.kind !== "seconds")
                        .map((r) => [r.name, number(answer.numbers[r.name])]),
                ),
            },
            table: Object.fromEntries(
                results.column.map((r) => [column_name(r), [...answer.columns[r.name]].map(number)]),
            ),
        },
        null,
        1,
    );
}

export const python_of = (given, options) => {
    const kind = Object.fromEntries(options.map((o) => [o.name, o.kind]));
    const value = (name, text) =>
        kind[name] === "flag"
            ? text === "no"
                ? "False"
                : "True"
            : Number.isFinite(Number(text)) && /number|integer/.test(kind[name])
              ? text
              : JSON.stringify(text);
    return `import rollbem\n\ns = rollbem.solve(${Object.entries(given)
        .map(([name, text]) => `${name.replaceAll("-", "_")}=${value(name, text)}`)
        .join(", ")})\nprint(s.normal_load, s.tangential_load, s.notes)\ns.plot().savefig("tractions.png")\n`;
};

/* A figure as a sheet that stands alone: title and numbers above it, legend, colour bar and the command that computes it
 * below; what a hand drags is left out.  legend: entries as legend() of draw.js has them; bar: { colours, from, to }. */
const SOURCE_SIZE = 12,
    NARROWEST = 480;
export function sheet(root, { title, numbers, legend = [], bar, source }) {
    const [, wide, tall] = /^0 0 ([\d.]+) ([\d.]+)$/.exec(root.getAttribute("viewBox")).map(Number),
        width = Math.max(NARROWEST, wide),
        of = (text, size) => lines_of(text, (width - 16) / (0.54 * size));
    const all = svg("svg", { role: "img", "aria-label": title }),
        figure = root.cloneNode(true);
    let y = 8;
    const put = (text, size, more) => {
        for (const line of of(text, size)) {
            y += 1.35 * size;
            all.append(svg("text", { x: 8, y, ...more, style: `font-size:${size}px;${more.style ?? ""}` }, line));
        }
    };
    put(title, 20, { style: "font-weight:700" });
    put(numbers_in_words(numbers), 14, { class: "soft" });
    y += 10;
    for (const handle of figure.querySelectorAll(".handle")) handle.remove();
    for (const [name, value] of Object.entries({ x: (width - wide) / 2, y, width: wide, height: tall }))
        figure.setAttribute(name, value);
    all.append(figure);
    y += tall + 6;
    if (bar) {
        const long = (width - 200) / bar.colours.length;
        all.append(
            ...bar.colours.map((fill, k) =>
                svg("rect", { x: 40 + k * long, y, width: long + 0.5, height: 14, style: `fill:${fill}` }),
            ),
            svg("text", { x: 32, y: y + 12, "text-anchor": "end" }, bar.from),
            svg("text", { x: width - 152, y: y + 12 }, bar.to),
        );
        y += 24;
    }
    let x = 8;
    for (const [colour, text, how] of legend) {
        const long = 40 + 7.2 * text.length;
        if (x > 8 && x + long > width) [x, y] = [8, y + 20];
        const line = how === "dotted" || how === "dashed";
        all.append(
            line
                ? svg("path", {
                      d: `M${x} ${y + 9}h18`,
                      style: `stroke:var(${colour});stroke-width:2;stroke-dasharray:${how === "dotted" ? "2 4" : "6 4"}`,
                  })
                : svg("rect", { x, y: y + 3, width: 18, height: 12, rx: 2, style: `fill:var(${colour})` }),
            svg("text", { x: x + 24, y: y + 14 }, text),
        );
        if (how === "hatched")
            all.append(
                svg("path", { d: `M${x + 1} ${y + 15}l8 -12m1 12l8 -12`, style: "stroke:var(--card);stroke-width:2" }),
            );
        x += long;
    }
    y += legend.length ? 26 : 6;
    put(source, SOURCE_SIZE, { class: "soft" });
    all.setAttribute("viewBox", `0 0 ${width} ${Math.ceil(y + 12)}`);
    for (const [name, value] of Object.entries({ width, height: Math.ceil(y + 12) })) all.setAttribute(name, value);
    return svg_text(all);
}
function lines_of(text, most) {
    const lines = [""];
    for (const word of text.split(" ")) {
        if (lines.at(-1) && lines.at(-1).length + word.length + 1 > most) lines.push("");
        lines.push(`${lines.pop()} ${word}`.trim());
    }
    return lines.filter(Boolean);
}
const numbers_in_words = (n = {}) =>
    [
        ["P", n.normal_load, "N/mm"],
        ["p₀", n.max_pressure, "MPa"],
        ["a", n.half_width, "mm"],
        ["Q/(μP)", n.force_ratio, ""],
        ["ξ", n.creepage, ""],
    ]
        .filter(([, value]) => Number.isFinite(value))
        .map(([name, value, unit]) => `${name} = ${show(Math.abs(value) < 1e-12 ? 0 : value, 3)} ${unit}`.trim())
        .join(", ");

/* A picture of the page as a file by itself. */
export function svg_text(root) {
    const style = getComputedStyle(document.documentElement),
        copy = root.cloneNode(true);
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.insertAdjacentHTML(
        "afterbegin",
        `<rect width="100%" height="100%" fill="var(--card)"/><style>text{font:13px sans-serif;fill:var(--ink)}text.soft{fill:var(--soft)}</style>`,
    );
    return new XMLSerializer()
        .serializeToString(copy)
        .replace(/var\((--[\w-]+)\)/g, (_all, name) => style.getPropertyValue(name).trim());
}

/* The same in points, twice as dense as on the screen. */
async function png_of(text) {
    const image = new Image(),
        [, width, height] = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(text);
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
    await image.decode();
    const canvas = html("canvas", { width: 2 * width, height: 2 * height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

const CLIP_SECONDS = 5;
async function clip_of(canvas) {
    const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((t) =>
        MediaRecorder.isTypeSupported(t),
    );
    const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 6e6 }),
        parts = [],
        wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    let size = 0;
    recorder.ondataavailable = ({ data }) => {
        parts.push(data);
        size += data.size;
    };
    const ended = new Promise((resolve) => {
        recorder.onstop = resolve;
    });
    recorder.start(250);
    await wait(1000 * CLIP_SECONDS);
    /* where the machine is busy the first frame comes late; the head of the file has some hundred bytes */
    for (let late = 0; size < 1000 && late < CLIP_SECONDS; late += 0.25) await wait(250);
    recorder.stop();
    await ended;
    return new Blob(parts, { type: "video/webm" });
}

const can_clip = () => typeof MediaRecorder !== "undefined" && "captureStream" in HTMLCanvasElement.prototype;

async function copy_text(text) {
    try {
        await navigator.clipboard.writeText(text);
    } catch {
        const area = html("textarea", { class: "unseen" });
        area.value = text;
        document.body.append(area);
        area.select();
        document.execCommand("copy");
        area.remove();
    }
}

/* The lesson to a figure, and the pages of docs/ that are the same on every one. */
export const LESSONS = {
    "rollbem-contact": "course/06-rolling.md",
    "rollbem-press": "course/03-hertz.md",
    "rollbem-brake": "course/06-rolling.md",
    "rollbem-soft": "course/08-bodies.md",
    "rollbem-stress": "course/09-stress.md",
    "rollbem-crack": "crack.md",
    "rollbem-roll": "course/07-transient.md",
    "rollbem-creep": "course/06-rolling.md",
    "rollbem-pivots": "course/04-lemke.md",
    tractions: "course/05-friction.md",
};
export const PAGES = { theory: "theory.md", page: "page.md" };
/* Served, the page lies beside the site's pages; in a checkout beside those of the sources; else it names these. */
function link_to(words, file) {
    const [, number, lesson] = /^course\/0?(\d+)-(.*)\.md$/.exec(file) ?? [],
        name = number ? fill_in(words.lesson_name, { number, name: lesson }) : file.replace(/\.md$/, "");
    if (/^https?:$/.test(location.protocol)) return html("a", { href: file.replace(/\.md$/, ".html") }, name);
    if (location.pathname.endsWith("/build/rollbem.html")) return html("a", { href: `../docs/${file}` }, name);
    return `${name} (docs/${file})`;
}

/* A menu beside a figure: its picture as a file, its case as text.  picture(): the text of an SVG file;
 * canvas(): what a clip is taken from, if it moves; given(): the case that the figure shows. */
export function take_along(page, picture, name, canvas, given = () => page.given, heading = page.words.take.title) {
    const { words, options } = page,
        w = words.take;
    /* What stands on a sheet beside the figure; a picture that is a text already is complete. */
    const complete = () => {
        const made = picture();
        if (typeof made === "string") return made;
        const source = fill_in(w.source, { version: VERSION, command: command_of(given(), options) });
        return sheet(made.root, { source, numbers: page.store.solved.main.numbers, ...made });
    };
    const said = html("span", { class: "note", role: "status" });
    const copies = {
        command: () => command_of(given(), options),
        ini: () => ini_of(given(), options),
        ...(!words_for_crack(given()).length && { python: () => python_of(given(), options) }),
        link: () => location.href.split("#")[0] + write_link(contact_of(given()), "hero", null),
        embed: () =>
            `<iframe src="${(location.href.split("#")[0] + write_link(contact_of(given()), "hero", null, "hero")).replaceAll("&", "&amp;")}" width="900" height="620" title="rollbem" style="border:0"></iframe>`,
    };
    const button = (text, act) =>
        html(
            "button",
            {
                type: "button",
                class: "button",
                onclick: async () => {
                    said.textContent = "";
                    try {
                        said.textContent = (await act()) ?? "";
                    } catch (error) {
                        said.textContent = fill_in(w.failed, { why: error.message });
                    }
                },
            },
            text,
        );
    const menu = html(
        "details",
        { class: "menu" },
        html("summary", { class: "button" }, heading),
        html(
            "div",
            { class: "sheet" },
            html(
                "div",
                { class: "row" },
                button("PNG", async () => save(`${name}.png`, await png_of(complete()), "image/png")),
                button("SVG", () => save(`${name}.svg`, complete(), "image/svg+xml")),
                canvas &&
                    can_clip() &&
                    button(w.clip, async () => {
                        said.textContent = fill_in(w.recording, { seconds: CLIP_SECONDS });
                        save(`${name}.webm`, await clip_of(canvas()), "video/webm");
                        return w.saved;
                    }),
            ),
            html(
                "div",
                { class: "row" },
                Object.entries(copies).map(([key, text]) =>
                    button(w[key], async () => {
                        await copy_text(text());
                        return words.copied;
                    }),
                ),
            ),
            html(
                "p",
                { class: "note" },
                w.lesson,
                link_to(w, LESSONS[name]),
                ". ",
                ...Object.entries(PAGES).flatMap(([key, file]) => [w[key], link_to(w, file), ". "]),
                w.cite,
            ),
            said,
        ),
    );
    menu.addEventListener("keydown", (event) => {
        if (event.key === "Escape") {
            menu.open = false;
            menu.firstChild.focus();
        }
    });
    return menu;
}

function save(name, text, type) {
    const link = html("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/* A text to copy, and to save where it has a file name. */
export function text_card(words, key, text, file, type) {
    const area = html("textarea", {
        readonly: true,
        "aria-label": words[`take_${key}`],
        "data-take": key,
        wrap: text.includes("\t") ? "off" : "soft",
        rows: text.split("\n").length > 3 ? 9 : 3,
        style: text.split("\n").length > 3 ? "" : "min-height:4.5rem",
    });
    area.value = text;
    const copy = html(
        "button",
        {
            type: "button",
            class: "button",
            onclick: async () => {
                area.select();
                try {
                    await navigator.clipboard.writeText(text);
                } catch {
                    document.execCommand("copy");
                }
                copy.textContent = words.copied;
                setTimeout(() => {
                    copy.textContent = words.copy;
                }, 1200);
            },
        },
        words.copy,
    );
    return card(
        words[`take_${key}`],
        area,
        html(
            "div",
            { class: "row", style: "margin-top:.5rem" },
            copy,
            file &&
                html(
                    "button",
                    { type: "button", class: "button", onclick: () => save(file, text, type) },
                    words.download,
                ),
        ),
    );
}

export function take_view(words, page) {
    const node = html("div", { class: "stack" });
    let drawn_for = null;
    function draw() {
        const a = page.answer;
        if (!a || (a === drawn_for && node.firstChild)) return;
        drawn_for = a;
        const given = a.given,
            columns = page.results.column.filter((r) => a.columns[r.name]); /* some belong to some cases */
        const picture = () => ({
            root: tractions_picture(document.body, words, a, { width: 900, name: "file" }),
            title: words.tractions_title,
            legend: tractions_legend(words, a.columns.zone, false).entries,
        });
        node.replaceChildren(
            text_card(words, "command", command_of(given, page.options)),
            text_card(words, "link", location.href.split("#")[0] + write_link(given, "bench", page.drawn)),
            html(
                "div",
                { class: "trio" },
                text_card(words, "ini", ini_of(given, page.options), "case.ini", "text/plain"),
                text_card(words, "table", table_of(a.columns, columns), "table.tsv", "text/tab-separated-values"),
                text_card(
                    words,
                    "json",
                    json_of(words, a, given, page.options, { ...page.results, column: columns }),
                    "case.json",
                    "application/json",
                ),
                text_card(words, "python", python_of(given, page.options), "case.py", "text/x-python"),
            ),
            html("div", { class: "row" }, take_along(page, picture, "tractions", null)),
        );
    }
    return { node, draw };
}
