/* Which input matters: what one percent more of each input does to a result and to the tractions, and how uncertain the
 * results are, by the library's own derivatives. */
import { card, chart, html, legend, line, segments, show, stroke, svg, width_of } from "./draw.js";
import { fill_in } from "./words.js";

const RESULTS = ["max_pressure", "approach", "tangential_load", "creepage"],
    MOST_ROWS = 8,
    LIVE = 150 /* ms: what takes longer waits until the hand lets go */,
    STALE_AFTER = 300 /* ms after which bars of the case before say so */,
    SMALL = 1e-6 /* of the result: rounding, not an effect */,
    UNCERTAIN = "mu=10%,radius=1%,young=1%";

/* [{ name, less, more }], the largest first: the change of a result, as a part of it, for one percent less and more of
 * each input; both have the same size where the result has one derivative.  Inputs that are zero have no percent. */
export function effects(inputs, values, derivative, result) {
    const part = (slope, value) => (slope * value) / Math.abs(result) / 100;
    return inputs
        .map((name, k) => ({
            name,
            less: -part(derivative[2 * k], values[k]),
            more: part(derivative[2 * k + 1], values[k]),
        }))
        .filter(({ less, more }) => Math.max(Math.abs(less) || 0, Math.abs(more) || 0) > SMALL / 100)
        .sort((a, b) => size_of(b) - size_of(a));
}
/* What one percent more (less, where it cannot grow) of input k changes in a column of n elements. */
export function change_along(derivative, n, k, value) {
    const side = (from) => Array.from({ length: n }, (_, i) => derivative[i + n * (2 * k + from)]),
        right = side(1),
        grows = right.some(Number.isFinite);
    return (grows ? right : side(0)).map((slope) => (slope * value) / (grows ? 100 : -100));
}
const size_of = ({ less, more }) => Math.max(Math.abs(less) || 0, Math.abs(more) || 0);
/* The change to tell: for one percent more, or less of an input at the end of its range, which can only fall. */
export const told_change = ({ less, more }) =>
    Number.isFinite(more) ? { falls: false, change: more } : { falls: true, change: less };
/* Those of which one percent less is not the opposite of one percent more. */
export const kinks_of = (list, scale) =>
    list.filter(
        ({ less, more }) => Number.isFinite(less) && Number.isFinite(more) && Math.abs(less + more) > 1e-3 * scale,
    );

export function matters_card(words, page) {
    const { store } = page,
        w = words.matters,
        rows = html("div", { class: "bars" }),
        choice = html("div", { class: "narrow" }),
        told = html("p", { "aria-live": "polite" }),
        along = html("figure"),
        deviations = html("ul", { class: "deviations", "aria-live": "polite" }),
        field = html("input", {
            type: "text",
            id: "uncertain",
            value: UNCERTAIN,
            spellcheck: "false",
            autocomplete: "off",
            onchange: () => page.ask_view("bench"),
        });
    let chosen = "max_pressure",
        input = null /* whose changes along the contact are shown; null: the one that matters most */,
        data = null,
        drawn_for = null,
        scale = 0,
        cost = 0,
        behind_since = 0,
        in_view = false;
    const node = card(
        w.title,
        html("p", { class: "note" }, w.note),
        choice,
        rows,
        told,
        along,
        html("label", { for: "uncertain", class: "uncertain" }, html("span", {}, w.uncertain), field),
        html("p", { class: "note" }, w.uncertain_note),
        deviations,
    );
    new IntersectionObserver(([entry]) => {
        in_view = entry.isIntersecting;
        if (in_view) page.ask_view("bench");
    }).observe(node);
    const has = (name) => Math.abs(data.numbers[name]) > 1e-12 && data[`derivative.${name}`];
    choice.append(
        segments(
            "matters",
            w.of,
            RESULTS.map((name) => [name, words.numbers[name]]),
            chosen,
            (name) => {
                chosen = name;
                scale = 0;
                drawn_for = null;
                draw();
            },
        ),
    );
    const name_of = (name) => words.names[name] ?? name.replaceAll("-", " "),
        side_of = (falls) => (falls ? w.less : w.more);
    const percent = (x) =>
        !Number.isFinite(x)
            ? "–"
            : Math.abs(x) < 1e-4
              ? w.little
              : `${x > 0 ? "+" : ""}${show(100 * x, Math.abs(x) > 10 ? 3 : 2)} %`;
    function draw() {
        /* Of another case than the one that is shown: faint and without numbers until the answer is there. */
        if (!data || data.given === page.given) behind_since = 0;
        else if (!behind_since) {
            behind_since = performance.now();
            setTimeout(draw, STALE_AFTER + 20);
        }
        const old = behind_since > 0 && performance.now() - behind_since > STALE_AFTER,
            key = [data, chosen, input, store.trouble("main"), old];
        node.classList.toggle("stale-inside", Boolean(store.trouble("main")));
        rows.classList.toggle("old", old);
        if (!data || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        draw_deviations(old);
        if (data.refused || !has(chosen)) {
            rows.replaceChildren();
            along.replaceChildren();
            told.textContent = data.refused
                ? fill_in(words.refused, { why: data.refused })
                : fill_in(w.zero, { result: words.numbers[chosen] });
            return;
        }
        const list = effects(
            data.inputs.map(({ name }) => name),
            data["derivative.value"].at,
            data[`derivative.${chosen}`].at,
            data.numbers[chosen],
        );
        const most = list.length ? size_of(list[0]) : 0.01;
        /* The scale holds while a hand moves something. */
        if (!scale || most > scale || (!store.holding && most < 0.5 * scale)) scale = most;
        const shown = list.slice(0, MOST_ROWS),
            focused = rows.contains(document.activeElement) && document.activeElement.closest(".bar")?.dataset.input,
            at = shown.some(({ name }) => name === input) ? input : shown[0]?.name;
        rows.replaceChildren(
            ...shown.map(({ name, less, more }) =>
                html(
                    "div",
                    { class: "bar", "data-input": name },
                    html(
                        "button",
                        {
                            type: "button",
                            "aria-pressed": String(name === at),
                            onclick: () => {
                                input = name;
                                draw();
                            },
                        },
                        told_change({ less, more }).falls ? fill_in(w.less_of, { name: name_of(name) }) : name_of(name),
                    ),
                    html(
                        "span",
                        { class: "track", "aria-hidden": "true" },
                        ...[
                            ["more", more],
                            ["less", less],
                        ].map(([kind, x]) =>
                            html("i", {
                                class: `${kind} ${x < 0 ? "falls" : "grows"}`,
                                style: `width:${((50 * Math.abs(x || 0)) / scale).toFixed(2)}%`,
                            }),
                        ),
                    ),
                    html("span", { class: "value" }, old ? "…" : percent(told_change({ less, more }).change)),
                ),
            ),
        );
        if (focused) rows.querySelector(`[data-input="${focused}"] button`)?.focus();
        draw_along(
            at,
            list.some((row) => row.name === at && told_change(row).falls),
        );
        const kinks = kinks_of(list, scale);
        if (old) {
            told.textContent = "…";
            return;
        }
        told.textContent = [
            list.length
                ? fill_in(w.most, {
                      name: name_of(list[0].name),
                      result: words.numbers[chosen],
                      side: side_of(told_change(list[0]).falls),
                      change: percent(told_change(list[0]).change),
                  })
                : fill_in(w.none, { result: words.numbers[chosen] }),
            kinks.length && fill_in(w.kink, { names: kinks.map(({ name }) => name_of(name)).join(", ") }),
        ]
            .filter(Boolean)
            .join(" ");
    }
    /* What one percent more, or less, of this input changes in pressure and friction. */
    function draw_along(name, falls) {
        const k = data.inputs.findIndex((one) => one.name === name),
            n = data.x.length;
        if (k < 0 || !data["derivative.p"]) return along.replaceChildren();
        const [p, q] = ["p", "q"].map((column) =>
                change_along(data[`derivative.${column}`].at, n, k, data["derivative.value"].at[k]),
            ),
            most = (list) => Math.max(...list.map((v) => Math.abs(v) || 0)),
            ends = [Math.min(...p, ...q) || 0, Math.max(...p, ...q) || 0],
            room = 0.08 * (ends[1] - ends[0]) || 1,
            { contact_from: from, contact_to: to } = data.numbers,
            beside = 0.08 * (to - from),
            of = { name: name_of(name), side: side_of(falls) };
        const { root, X, Y } = chart({
            width: width_of(along),
            height: 210,
            x: [from - beside, to + beside],
            y: [Math.min(ends[0], 0) - room, Math.max(ends[1], 0) + room],
            x_label: words.x_axis,
            y_label: words.mpa,
            y_ticks: 4,
            label: fill_in(w.along_alt, { ...of, p: show(most(p), 3), q: show(most(q), 3) }),
        });
        const inside = [...data.x.keys()].filter((i) => data.x[i] > from - beside && data.x[i] < to + beside);
        for (const [column, colour, width] of [
            [p, "--press", 2.4],
            [q, "--rub", 2.4],
        ])
            root.append(
                svg("path", { d: line(inside.map((i) => [X(data.x[i]), Y(column[i])])), style: stroke(colour, width) }),
            );
        along.replaceChildren(
            html("p", { class: "note" }, fill_in(w.along, { ...of, elements: data.elements })),
            root,
            legend(["--press", words.pressure], ["--rub", words.friction]),
        );
    }
    function draw_deviations(old) {
        field.setAttribute("aria-invalid", String(Boolean(data.uncertain)));
        deviations.classList.toggle("old", old);
        deviations.replaceChildren(
            ...(data.uncertain
                ? [html("li", {}, fill_in(w.uncertain_refused, { why: data.uncertain.replace("--tolerance: ", "") }))]
                : data.deviations
                  ? RESULTS.filter((name) => Number.isFinite(data.deviations[name])).map((name) =>
                        html(
                            "li",
                            { "data-deviation": name },
                            old
                                ? "…"
                                : fill_in(w.uncertain_of, {
                                      result: words.numbers[name],
                                      value: show(data.numbers[name], 4),
                                      deviation: show(data.deviations[name], 2),
                                      unit: page.units[name] === "-" ? "" : (page.units[name] ?? ""),
                                  }),
                        ),
                    )
                  : []),
        );
    }
    return {
        node,
        draw,
        wants: () =>
            !in_view ||
            store.trouble("main") ||
            (store.holding && cost > LIVE) ||
            (data?.given === page.given && data.tolerance === field.value.trim())
                ? []
                : [
                      {
                          kind: "derivatives",
                          slot: "derivatives bench",
                          given: page.given,
                          tolerance: field.value.trim(),
                      },
                  ],
        take(answer, request) {
            data = { ...answer, given: request.given, tolerance: request.tolerance };
            cost = answer.milliseconds ?? cost;
            draw();
        },
        data: () => data,
    };
}
