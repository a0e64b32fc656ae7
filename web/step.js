/* Step through the method: matrices, Lemke's pivots, Newton's zones, guessed zones. */
import { chart, html, player, segments, show, stairs, stroke, svg, width_of, zone_colours } from "./draw.js";
import { lens_figure } from "./lens.js";
import { matrices, parse, pretty } from "./matrices.js";
import { proof_in_words } from "./proof.js";
import { fill_in } from "./words.js";

/* The two contacts that are stepped through before one's own: an odd number of elements, of which every one touches, on
 * a wheel whose pressure shifts its friction, so that no two values reach zero together; and an even number, whose middle
 * two are mirror images of each other. */
const FIVE = {
    support: "hub",
    "hub-ratio": "0.5",
    "outer-elements": "24",
    formulation: "steady",
    radius: "100",
    young: "10",
    poisson: "0.3",
    mu: "0.3",
    approach: "0.8",
    "creep-ratio": "0.2",
    "contact-elements": "5",
    zone: "7",
};
export const EXAMPLES = { untied: FIVE, tied: { ...FIVE, "contact-elements": "4" } };
const METHOD = { mesh: "uniform", solver: "lemke", "lcp-form": "pivoted" };

/* The rows that may stop what enters in pivot k, the first one first: { i, value, change, ratio }. */
function ratios_of(a, k) {
    const size = a["pivot.before"].rows,
        at = (name, i) => a[name].at[i + size * k],
        chosen = a["pivot.row"].at[k];
    const rows = Array.from({ length: size }, (_, i) => ({
        i,
        value: at("pivot.before", i),
        change: at("pivot.column", i),
    }));
    return k === 0
        ? rows
              .filter(({ value }) => value < 0)
              .map((row) => ({ ...row, ratio: -row.value }))
              .sort((x, y) => y.ratio - x.ratio)
        : rows
              .filter(({ change }) => change < 0)
              .map((row) => ({ ...row, ratio: -row.value / row.change }))
              .sort((x, y) => x.ratio - y.ratio || (x.i === chosen ? -1 : 1));
}
const basic_before = (a, k, i) => a.names[k === 0 ? i : a["pivot.basis"].at[i + a["pivot.before"].rows * (k - 1)]];
/* Numbers are scaled to order one: below this they are rounding. */
const LEVEL = 1e-9;

/* Of pivot k: the names that reach zero with the one that leaves, and whether the step has no length. */
export function tie_of(a, k) {
    const rows = ratios_of(a, k),
        chosen = rows.find(({ i }) => i === a["pivot.row"].at[k]);
    if (!chosen) return { tied: [], still: false };
    const near = ({ ratio }) => Math.abs(ratio - chosen.ratio) <= LEVEL * Math.max(1, chosen.ratio);
    return {
        tied: rows.filter((row) => row !== chosen && near(row)).map(({ i }) => basic_before(a, k, i)),
        still: k > 0 && chosen.ratio <= LEVEL,
    };
}
/* What is said of it, after the sentence of the pivot. */
function tie_in_words(words, a, k) {
    const { tied, still } = tie_of(a, k),
        leaving = a.names[a["pivot.leaving"].at[k]],
        names = (list) => list.map((name) => pretty(words, name)).join(", ");
    return [
        still && words.step.still,
        tied.length > 0 &&
            fill_in(leaving === "z0" ? words.step.tie_last : words.step.tie, {
                all: names([leaving, ...tied]),
                leaves: names([leaving]),
                stays: names(tied),
            }),
    ]
        .filter(Boolean)
        .join(" ");
}

/* "Element 3 is pressed until element 2 touches." */
export function sentence_of(words, a, k) {
    if (k === 0)
        return `${words.pivot_start} ${fill_in(words.sentence, { enter: words.enters.z0, leave: fill_in(words.leaves[parse(a.names[a["pivot.leaving"].at[0]]).kind], parse(a.names[a["pivot.leaving"].at[0]])) })}`;
    const enters = parse(a.names[a["pivot.entering"].at[k]]),
        leaves = parse(a.names[a["pivot.leaving"].at[k]]);
    const same = enters.i === leaves.i && words.same_element[`${enters.kind} ${leaves.kind}`];
    if (same) return fill_in(same, enters) + ".";
    return fill_in(words.sentence, {
        enter: fill_in((tie_of(a, k).still && words.enters_still[enters.kind]) || words.enters[enters.kind], enters),
        leave: fill_in(words.leaves[leaves.kind], leaves),
    });
}

const short_sentence = (words, a, k) =>
    sentence_of(words, a, k)
        .replace(`${words.pivot_start} `, "")
        .replace(/<[^>]*>/g, "");

/* Basic kinds of each element after pivot k: a set of names like "p", "lambda+". */
function basis_of(a, k, n) {
    const { rows, at } = a["pivot.basis"],
        of = Array.from({ length: n }, () => new Set());
    for (let i = 0; i < rows; i++) {
        const { kind, i: element } = parse(a.names[at[i + rows * k]]);
        if (kind in { gap: 1, p: 1, "lambda+": 1, "lambda-": 1, "gamma+": 1, "gamma-": 1 }) of[element - 1].add(kind);
    }
    return of;
}
const zone_of = (kinds) => (!kinds.has("p") ? 0 : kinds.has("lambda+") ? 2 : kinds.has("lambda-") ? 3 : 1);

/* In words where there is room. */
const zone_word = (words, z, n) => (n > 9 || innerWidth < 640 ? words.zones_signs[z] : words.zones_short[z]);

const strip = (words, zones, label) =>
    html(
        "div",
        {
            class: "cells",
            style: `grid-template-columns:6.5rem repeat(${zones.length},1fr);align-items:center`,
            role: "img",
            "aria-label": `${label}: ${zones.map((z) => words.zones_short[z]).join(", ")}`,
        },
        html("span", { class: "head", style: "text-align:left" }, label),
        zones.map((z, _i) =>
            html("span", { class: `zone${z}`, title: words.zones[z] }, zone_word(words, z, zones.length)),
        ),
    );

function basis_grid(words, kinds) {
    const pairs = [
        ["gap", "p"],
        ["lambda+", "gamma+"],
        ["lambda-", "gamma-"],
    ];
    const cells = pairs.flatMap((pair, r) => [
        html("span", { class: "head", style: "text-align:left" }, words.basis_rows[r]),
        ...kinds.map((set) => {
            const basic = pair.filter((kind) => set.has(kind));
            return html(
                "span",
                {
                    style: `background:var(--grid)${basic.includes("p") || basic.some((b) => b.startsWith("lambda")) ? ";background:var(--press);color:var(--card)" : ""}`,
                },
                basic.map((b) => words.basis[b]).join(" ") || words.neither,
            );
        }),
    ]);
    const numbers = [
        html("span", { class: "head" }),
        ...kinds.map((_set, i) => html("span", { class: "head" }, i + 1)),
    ];
    return html(
        "div",
        {
            class: "cells",
            style: `grid-template-columns:6.5rem repeat(${kinds.length},1fr)`,
            role: "img",
            "aria-label": words.basis_now,
        },
        numbers,
        cells,
    );
}

/* The zones that each step of Newton's method assumes; those that differ from the step before are marked. */
function newton_strips(words, a) {
    const zone = a["newton.zone"];
    if (!zone) return [];
    const n = zone.rows,
        of = (k) => [...zone.at.subarray(n * k, n * k + n)];
    const all = Array.from({ length: zone.columns }, (_, k) => of(k)),
        changed = (k) => k === 0 || all[k].some((z, i) => z !== all[k - 1][i]);
    return [
        html("h4", {}, words.newton_title),
        html("p", { class: "note" }, fill_in(words.newton_note, { n: zone.columns, pivots: a["pivot.z0"].columns })),
        ...all.flatMap((zones, k) => {
            if (!changed(k)) return []; /* pressure and friction in turn: these zones hold */
            const row = strip(words, zones, fill_in(words.newton_step, { k: k + 1 }));
            if (k > 0) zones.forEach((z, i) => z !== all[k - 1][i] && row.children[i + 1].classList.add("changed"));
            return [row];
        }),
    ];
}

function bars(host, words, { ends, p, q, mu, top, label }) {
    const width = width_of(host),
        x = [ends[0], ends[p.length]];
    const plot = chart({
        width,
        height: 230,
        x,
        y: [-mu * top * 1.15, top * 1.08],
        x_label: words.x_axis,
        y_label: words.mpa,
        label,
    });
    const bound = (sign) =>
        svg("path", {
            d: stairs(
                ends,
                [...p].map((v) => sign * mu * v),
                plot.X,
                plot.Y,
            ),
            style: stroke("--soft", 1.3, "stroke-dasharray:2 4"),
        });
    plot.root.append(
        ...[...p].map((v, i) =>
            svg("rect", {
                x: plot.X(ends[i]) + 1,
                width: Math.max(1, plot.X(ends[i + 1]) - plot.X(ends[i]) - 2),
                y: Math.min(plot.Y(v), plot.Y(0)),
                height: Math.abs(plot.Y(v) - plot.Y(0)),
                style: "fill:var(--press-fill);stroke:var(--press);stroke-width:1.2",
            }),
        ),
        bound(1),
        bound(-1),
        svg("path", { d: stairs(ends, [...q], plot.X, plot.Y), style: stroke("--rub", 3) }),
    );
    return plot.root;
}

function ratio_test(words, a, k) {
    const chosen = a["pivot.row"].at[k],
        rows = ratios_of(a, k);
    const shown = rows.slice(0, 7);
    if (!shown.some(({ i }) => i === chosen)) shown.splice(6, 1, rows.find(({ i }) => i === chosen) ?? shown[6]);
    /* The bar of the one that stops it is full: the others would need longer. */
    const first = shown.find((row) => row?.i === chosen)?.ratio ?? 1;
    const race = ({ ratio }) =>
        k === 0
            ? Math.round((100 * ratio) / (first || 1))
            : ratio > 0
              ? Math.max(2, Math.round((100 * first) / ratio))
              : 100;
    const head = [words.ratio_variable, words.step.race, words.ratio_value, words.ratio_change, words.ratio_ratio];
    return [
        html(
            "p",
            { class: "note" },
            k === 0
                ? words.ratio_first
                : fill_in(words.ratio_note, { entering: pretty(words, a.names[a["pivot.entering"].at[k]]) }),
        ),
        html(
            "table",
            {},
            html(
                "thead",
                {},
                html(
                    "tr",
                    {},
                    head.map((text, c) => html("th", { scope: "col", class: c > 1 ? "number" : "" }, text)),
                ),
            ),
            html(
                "tbody",
                {},
                shown.filter(Boolean).map((row) =>
                    html(
                        "tr",
                        { class: row.i === chosen ? "chosen" : "" },
                        html("td", {}, pretty(words, basic_before(a, k, row.i)) + (row.i === chosen ? " ←" : "")),
                        html("td", { class: "race" }, html("i", { style: `width:${race(row)}%` })),
                        [row.value, row.change, row.ratio].map((v) => html("td", { class: "number" }, show(v, 3))),
                    ),
                ),
            ),
        ),
    ];
}

/* What a guess violates, in words; tolerances of rounding only. */
export function assess(words, { p, q, gap, shift }, zones, mu) {
    const most = Math.max(...[...p].map(Math.abs)),
        tol = 1e-9 * most,
        wide = 1e-9 * Math.max(...[...gap].map(Math.abs)),
        far = 1e-9 * Math.max(...[...shift].map(Math.abs));
    return zones.flatMap((z, k) => {
        const i = k + 1;
        if (z === 0) return gap[k] < -wide ? [fill_in(words.guess_overlap, { i, gap: show(-gap[k], 3) })] : [];
        if (p[k] < -tol) return [fill_in(words.guess_pull, { i, p: show(p[k], 3) })];
        if (z === 1)
            return Math.abs(q[k]) > mu * p[k] + tol
                ? [fill_in(words.guess_friction, { i, q: show(Math.abs(q[k]), 3), bound: show(mu * p[k], 3) })]
                : [];
        return (z === 2 ? shift[k] < -far : shift[k] > far) ? [fill_in(words.guess_direction, { i })] : [];
    });
}

/* How many elements are few enough that each can be looked at, and how many where the case has more. */
const FEWEST = 4,
    MOST = 16,
    USUAL = 8;

export function step_view(words, page) {
    const { store } = page;
    let data = null,
        zones = [],
        elements = USUAL,
        of_case = null,
        asked = null,
        wanted = null,
        proved = null;
    let which = null; /* the contact that is stepped through, once it is chosen */
    const chosen = () => which ?? (page.linked ? "own" : "untied");
    const title = html("h3", {}, words.guess_title),
        matrix_host = html("div"),
        sentence = html("p", { class: "sentence", "aria-live": "polite" }),
        tie = html("p", { class: "note tie" });
    const strips = html("div", { class: "stack", style: "gap:.35rem" }),
        picture = html("figure"),
        z0 = html("p", { class: "note" }),
        proof = html("p", { class: "note", "aria-live": "polite" }),
        ratios = html("div"),
        newton = html("div", { class: "stack", style: "gap:.35rem" });
    const count = html("input", {
        type: "range",
        id: "step-elements",
        min: FEWEST,
        max: MOST,
        value: elements,
        oninput: () => {
            elements = Number(count.value);
            page.ask_view("step");
        },
    });
    const frames = player(words, {
        label: words.pivots,
        see: frame,
        milliseconds: 1400,
        describe: (k, n) => fill_in(words.pivot_count, { k: k + 1, n }),
    });
    const contacts = html("div"),
        size = html("div", { class: "row" }, html("label", { for: "step-elements" }, words.step_elements), count);
    const paint = html("div"),
        guess_picture = html("figure"),
        verdict = html("div", { "aria-live": "polite" });
    const button = (text, act, more = "") =>
        html("button", { type: "button", class: `button ${more}`, onclick: act }, text);
    const counted = html("p", { class: "big-number" });
    const node = html(
        "div",
        { class: "stack" },
        html("p", { class: "question" }, words.step.question),
        contacts,
        html(
            "section",
            { class: "card guess" },
            title,
            html("p", {}, words.guess_note),
            size,
            paint,
            html(
                "div",
                { class: "row", style: "margin:.7rem 0" },
                button(words.guess_check, check, "main"),
                button(words.guess_clear, () => repaint(zones.fill(0))),
                button(words.guess_answer, () => {
                    repaint(solution());
                    check();
                }),
            ),
            verdict,
            guess_picture,
        ),
        html("div", { class: "tale" }, counted, html("p", {}, words.step.how)),
        html(
            "section",
            { class: "card pivots" },
            html("h3", {}, words.pivots),
            frames.node,
            sentence,
            html(
                "div",
                { class: "pair" },
                html("div", {}, strips, picture, z0),
                html("div", {}, html("h4", {}, words.ratio_title), ratios, tie),
            ),
            proof,
            newton,
            html(
                "div",
                { class: "row" },
                page.take_along(
                    () => pivots_sheet(),
                    "rollbem-pivots",
                    null,
                    () => wanted ?? page.given,
                ),
            ),
        ),
        html(
            "details",
            {
                class: "card",
                open: true,
                ontoggle: (event) => {
                    matrices_open = event.target.open;
                    show_matrices();
                },
            },
            html("summary", {}, words.matrices),
            html("p", {}, words.step_intro),
            matrix_host,
        ),
    );
    let matrices_open = true,
        matrices_of = null;
    function show_matrices() {
        if (!matrices_open || !data || matrices_of === data) return;
        matrices_of = data;
        matrix_host.replaceChildren(...matrices(words, data, data["pivot.p"].rows));
    }

    /* The case's own number of elements whenever that is a new one and few enough; else the slider's. */
    function follow_case() {
        if (page.given["contact-elements"] === of_case) return;
        of_case = page.given["contact-elements"];
        const n = Number(of_case);
        if (Number.isInteger(n) && n >= FEWEST && n <= MOST) count.value = elements = n;
    }
    /* The zones after each pivot below each other, with what the pivot does. */
    function pivots_sheet() {
        const n = data["pivot.p"].rows,
            count = data["pivot.z0"].columns,
            wide = 900,
            cell = 240 / n,
            row = 22;
        const root = svg("svg", {
            viewBox: `0 0 ${wide} ${row * (count + 1)}`,
            width: wide,
            height: row * (count + 1),
        });
        for (let i = 0; i < n; i++)
            root.append(
                svg("text", { x: 40 + (i + 0.5) * cell, y: 14, "text-anchor": "middle", class: "soft" }, `${i + 1}`),
            );
        for (let k = 0; k < count; k++) {
            const y = row * (k + 1);
            root.append(
                svg("text", { x: 30, y: y + 14, "text-anchor": "end" }, `${k + 1}`),
                ...basis_of(data, k, n).map((kinds, i) =>
                    svg("rect", {
                        x: 40 + i * cell,
                        y: y + 2,
                        width: cell - 2,
                        height: row - 4,
                        style: `fill:var(${zone_colours[zone_of(kinds)]})`,
                    }),
                ),
                svg("text", { x: 292, y: y + 14 }, short_sentence(words, data, k)),
            );
        }
        const shown = new Set(Array.from({ length: count }, (_, k) => basis_of(data, k, n).map(zone_of)).flat());
        return {
            root,
            title: words.take.titles.pivots,
            numbers: data.numbers,
            legend: [...shown].sort().map((z) => [zone_colours[z], words.zones[z]]),
        };
    }
    function choose(name) {
        which = name;
        contacts.replaceChildren(
            segments("step", words.step.contacts_title, Object.entries(words.step.contacts), chosen(), (to) => {
                choose(to);
                page.ask_view("step");
            }),
        );
        size.hidden = chosen() !== "own";
    }
    choose(null);
    function given() {
        if (EXAMPLES[chosen()]) return { ...EXAMPLES[chosen()], ...METHOD };
        follow_case();
        const few = { ...page.given, ...METHOD, "contact-elements": String(elements) };
        if ((few.support ?? "arc") !== "halfplane") few["outer-elements"] ??= "24";
        if ((few.support ?? "arc") === "halfplane") delete few["outer-elements"];
        const { contact_from: from, contact_to: to } = page.answer?.numbers ?? {};
        if (to > from) few.zone ??= String(Number((1.35 * Math.max(-from, to)).toPrecision(3)));
        if (few.formulation === "transient") few.formulation = "steady";
        return few;
    }
    const mu = () => Number(data.values.mu.split(",")[0]),
        solution = () => [...data.columns.zone];
    const top = () => Math.max(...data["pivot.p"].at);

    function frame(k) {
        if (!data) return;
        const n = data["pivot.p"].rows,
            kinds = basis_of(data, k, n);
        sentence.innerHTML = sentence_of(words, data, k).replace(/(\d+|z₀)(?![^<]*>)/g, "<b>$1</b>");
        tie.textContent = tie_in_words(words, data, k);
        strips.replaceChildren(
            basis_grid(words, kinds),
            strip(words, kinds.map(zone_of), words.basis_now),
            strip(words, solution(), words.solution_zones),
        );
        const part = (name) => data[name].at.subarray(n * k, n * k + n);
        picture.replaceChildren(lens_of_pivot(k, kinds.map(zone_of), part("pivot.p"), part("pivot.q")));
        z0.textContent =
            fill_in(words.z0, { z0: show(data["pivot.z0"].at[k], 4) }) +
            (k === frames.count - 1 && data.end ? ` ${data.end}` : "");
        ratios.replaceChildren(...ratio_test(words, data, k));
        show_proof();
    }
    /* What the method ends with is proved. */
    function show_proof() {
        const ended = data && proved && frames.at === frames.count - 1;
        proof.textContent = ended ? `${words.proof.title}: ${proof_in_words(words, proved).join(" ")}` : "";
    }
    /* The lens with its elements as the basis has them: what is not pressed is apart. */
    function lens_of_pivot(k, zone, p, q) {
        const ends = data.ends.at,
            n = zone.length,
            width = width_of(picture),
            beside = 0.15 * (ends[n] - ends[0]),
            pressed = zone.flatMap((z, i) => (z > 0 ? [i] : [])),
            none = new Float64Array(n);
        const columns = { x: data.columns.x, h: data.columns.h, p: p.map((v) => Math.max(0, v)), q, zone, shift: none },
            numbers = {
                ...data.numbers,
                contact_from: pressed.length ? ends[pressed[0]] : 0,
                contact_to: pressed.length ? ends[pressed.at(-1) + 1] : 0,
                max_pressure: Math.max(...columns.p),
                stick: zone.filter((z) => z === 1).length,
                stick_from: ends[n],
                creepage: 0,
            };
        const edges = [ends[0] - beside, ends[n] + beside];
        return lens_figure(
            words,
            { columns, numbers, values: data.values },
            {
                width,
                height: Math.round(Math.min(280, Math.max(200, width * 0.4))),
                given: wanted,
                shape: { numbers, columns: { x: edges, gap: [0, 0], un: [0, 0] } },
                share: 0,
                bend: Infinity,
                fit: { window: edges, press: 1.15 * top(), rub: mu() * top() || 1, slip: 1, lift: 1 },
                label: fill_in(words.pivot_alt, { k: k + 1, z0: show(data["pivot.z0"].at[k]) }),
            },
        );
    }
    function repaint(next) {
        zones = [...next];
        const focus = [...paint.querySelectorAll("button")].indexOf(document.activeElement);
        paint.replaceChildren(
            html(
                "div",
                { class: "cells", style: `grid-template-columns:repeat(${zones.length},minmax(0,1fr))` },
                zones.map((z, i) =>
                    html(
                        "button",
                        {
                            type: "button",
                            class: `zone${z}`,
                            "aria-label": fill_in(words.guess_element, { i: i + 1, zone: words.zones[z] }),
                            onclick: () => {
                                zones[i] = (zones[i] + 1) % 4;
                                repaint(zones);
                            },
                        },
                        i + 1,
                        html("br"),
                        zone_word(words, z, zones.length),
                    ),
                ),
            ),
        );
        if (focus >= 0) paint.querySelectorAll("button")[focus]?.focus();
        verdict.replaceChildren();
        guess_picture.replaceChildren();
    }
    function check() {
        asked = [...zones];
        page.ask({ kind: "guess", slot: "guess step", view: "step", given: wanted, zones: asked });
    }
    function judged(answer) {
        if (answer.refused)
            return verdict.replaceChildren(
                html("p", { class: "bad" }, fill_in(words.guess_refused, { why: answer.refused })),
            );
        const part = (name) => answer[`guess.${name}`].at,
            wrong = assess(words, { p: part("p"), q: part("q"), gap: part("gap"), shift: part("shift") }, asked, mu());
        verdict.replaceChildren(
            html(
                "p",
                { class: wrong.length ? "bad" : "good" },
                wrong.length
                    ? fill_in(words.guess_wrong[wrong.length === 1 ? "one" : "other"], { n: wrong.length })
                    : words.guess_right,
            ),
            html(
                "ul",
                { class: "verdict" },
                wrong.map((text) => html("li", {}, text)),
            ),
        );
        guess_picture.replaceChildren(
            bars(guess_picture, words, {
                ends: answer.ends.at,
                p: part("p"),
                q: part("q"),
                mu: mu(),
                top: Math.max(...part("p"), ...[...part("q")].map((v) => Math.abs(v) / Math.max(mu(), 0.05))) || 1,
                label: words.guess_title,
            }),
        );
    }
    let drawn_at = 0;
    return {
        node,
        player: frames,
        uses: ["main"],
        fine: true,
        data: () => data,
        choose,
        leave: () => frames.stop(),
        wants() {
            if (store.holding || store.trouble("main")) return [];
            wanted = given();
            return ["pivots", "prove"].map((kind) => ({ kind, given: wanted }));
        },
        /* The elements of the strip are around the contact of the solution. */
        solved() {
            page.ask_view("step");
        },
        render() {
            count_ways();
            if (data && width_of(picture) !== drawn_at) {
                drawn_at = width_of(picture);
                frame(frames.at);
            }
        },
        take(answer) {
            if (answer.kind === "guess") return judged(answer);
            if (answer.kind === "prove") {
                proved = answer.refused ? null : answer;
                return show_proof();
            }
            /* What the method ended before its first pivot has no pivots to show. */
            if (answer.refused || !answer["pivot.p"]) return failed(answer.refused || answer.unsolved || answer.end);
            data = answer;
            proved = null; /* the proof comes behind the pivots */
            const n = data["pivot.p"].rows;
            title.textContent = fill_in(words.step_title, { n });
            show_matrices();
            newton.replaceChildren(...newton_strips(words, data));
            if (zones.length !== n) repaint(Array(n).fill(0));
            else repaint(zones);
            frames.set(data["pivot.z0"].columns, 0);
        },
    };
    function failed(why) {
        data = null;
        title.textContent = fill_in(words.refused, { why });
        for (const host of [strips, picture, ratios, newton, matrix_host, paint, verdict, guess_picture])
            host.replaceChildren();
        sentence.textContent = tie.textContent = z0.textContent = "";
    }
    /* 3^n beside the exchanges that the library needed: in digits as far as a reader counts them at a glance. */
    function count_ways() {
        const a = page.answer,
            n = a?.columns.x.length;
        if (!n) return;
        const log = n * Math.log10(3),
            digits = Math.floor(log) + 1,
            many = { lead: Math.floor(10 ** (log - digits + 2)), more: digits - 2 };
        counted.textContent = fill_in(a.words.solver === "lemke" ? words.step.ways : words.step.ways_only, {
            n,
            ways: digits > 6 ? fill_in(words.step.many_ways, many) : 3 ** n,
            pivots: a.numbers.iterations,
        });
    }
}
