/* Take it away: the case as a file and as a command, its numbers and its picture. */
import { card, html } from "./draw.js";
import { tractions_picture } from "./contact.js";
import { write_link } from "./state.js";

export const command_of = (given, options) => "rollbem " + options.filter((o) => o.name in given && o.kind !== "group")
    .map((o) => o.kind === "flag" ? (given[o.name] === "yes" ? `--${o.name}` : "") : /^[\w.+-]+$/.test(given[o.name]) ? `--${o.name} ${given[o.name]}` : `--${o.name} '${given[o.name].replaceAll("'", "'\\''")}'`).filter(Boolean).join(" ");

export const ini_of = (given, options) => options.filter((o) => o.kind === "group").map((group) => {
    const rows = options.filter((o) => o.section === group.name && o.kind !== "group" && o.name in given);
    return rows.length ? `[${group.name}]\n${rows.map((o) => `${o.name} = ${given[o.name]}`).join("\n")}\n` : "";
}).filter(Boolean).join("\n");

const column_name = (r) => r.unit ? `${r.name}_${r.unit}` : r.name;
export const table_of = (columns, results) => [results.map(column_name).join("\t"),
    ...[...columns.x].map((x, i) => results.map((r) => columns[r.name][i]).join("\t"))].join("\n") + "\n";

/* As the program's --json has them: inputs, summary and table. */
export function json_of(answer, given, options, results) {
    const number = (x) => Number.isFinite(x) ? x : null, kind = Object.fromEntries(options.map((o) => [o.name, o.kind]));
    const inputs = Object.fromEntries(Object.entries(given).map(([name, text]) => [name, (kind[name] === "number" || kind[name] === "integer") && Number.isFinite(Number(text)) ? Number(text) : text]));
    return JSON.stringify({ schema: "rollbem/1", version: VERSION, inputs,
        summary: Object.fromEntries(results.number.filter((r) => r.kind !== "seconds").map((r) => [r.name, number(answer.numbers[r.name])])),
        table: Object.fromEntries(results.column.map((r) => [column_name(r), [...answer.columns[r.name]].map(number)])) }, null, 1);
}

function picture_of(words, answer) {
    const root = tractions_picture(document.body, words, answer, { width: 900, name: "file" }), style = getComputedStyle(document.documentElement);
    root.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    root.insertAdjacentHTML("afterbegin", `<rect width="100%" height="100%" fill="var(--card)"/><style>text{font:13px sans-serif;fill:var(--ink)}text.soft{fill:var(--soft)}</style>`);
    return new XMLSerializer().serializeToString(root).replace(/var\((--[\w-]+)\)/g, (all, name) => style.getPropertyValue(name).trim());
}

function save(name, text, type) {
    const link = html("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/* A text to copy, and to save where it has a file name. */
export function text_card(words, key, text, file, type) {
    const area = html("textarea", { readonly: true, "aria-label": words[`take_${key}`], "data-take": key, wrap: text.includes("\t") ? "off" : "soft", rows: text.split("\n").length > 3 ? 9 : 3, style: text.split("\n").length > 3 ? "" : "min-height:4.5rem" });
    area.value = text;
    const copy = html("button", { type: "button", class: "button", onclick: async () => {
        area.select();
        try { await navigator.clipboard.writeText(text); } catch { document.execCommand("copy"); }
        copy.textContent = words.copied;
        setTimeout(() => { copy.textContent = words.copy; }, 1200);
    } }, words.copy);
    return card(words[`take_${key}`], area, html("div", { class: "row", style: "margin-top:.5rem" }, copy,
        file && html("button", { type: "button", class: "button", onclick: () => save(file, text, type) }, words.download)));
}

export function take_view(words, page) {
    const node = html("div", { class: "stack" });
    function draw() {
        const a = page.answer;
        if (!a) return;
        const columns = page.results.column.filter((r) => a.columns[r.name]); /* some belong to some cases */
        const picture = picture_of(words, a), figure = html("figure", { style: "max-width:900px" });
        figure.append(tractions_picture(figure, words, a, { width: Math.max(300, Math.min(900, node.clientWidth - 40)), name: "take" }));
        node.replaceChildren(text_card(words, "command", command_of(page.given, page.options)), text_card(words, "link", location.href.split("#")[0] + write_link(page.given, "contact", page.drawn)),
            html("div", { class: "pair", style: "grid-template-columns:repeat(auto-fit,minmax(min(100%,270px),1fr))" }, text_card(words, "ini", ini_of(page.given, page.options), "case.ini", "text/plain"),
                text_card(words, "table", table_of(a.columns, columns), "table.tsv", "text/tab-separated-values"), text_card(words, "json", json_of(a, page.given, page.options, { ...page.results, column: columns }), "case.json", "application/json")),
            card(words.take_picture, figure, html("div", { class: "row", style: "margin-top:.6rem" }, html("button", { type: "button", class: "button main", onclick: () => save("rollbem.svg", picture, "image/svg+xml") }, words.download_svg))));
    }
    return { node, draw, wants: () => [] };
}
