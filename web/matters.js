/* Which input matters: what one percent more of each input does to a result, by the library's own derivatives. */
import { card, html, segments, show } from "./draw.js";
import { say } from "./words.js";

const RESULTS = ["max_pressure", "approach", "tangential_load", "creepage"],
    MOST_ROWS = 8,
    LIVE = 150 /* ms: what takes longer waits until the hand lets go */,
    PATIENCE = 300 /* ms after which bars of the case before say so */,
    SMALL = 1e-6; /* of the result: rounding, not an effect */

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
const size_of = ({ less, more }) => Math.max(Math.abs(less) || 0, Math.abs(more) || 0);

export function matters_card(words, page) {
    const { store } = page,
        w = words.matters,
        rows = html("div", { class: "bars" }),
        choice = html("div", { class: "narrow" }),
        told = html("p", { "aria-live": "polite" });
    let chosen = "max_pressure",
        data = null,
        drawn_for = null,
        scale = 0,
        cost = 0,
        behind_since = 0,
        seen = false;
    const node = card(w.title, html("p", { class: "note" }, w.note), choice, rows, told);
    new IntersectionObserver(([entry]) => {
        seen = entry.isIntersecting;
        if (seen) page.ask_view("bench");
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
            setTimeout(draw, PATIENCE + 20);
        }
        const old = behind_since > 0 && performance.now() - behind_since > PATIENCE,
            key = [data, chosen, store.trouble("main"), old];
        node.classList.toggle("stale-inside", Boolean(store.trouble("main")));
        rows.classList.toggle("old", old);
        if (!data || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        if (data.refused || !has(chosen)) {
            rows.replaceChildren();
            told.textContent = data.refused
                ? say(words.refused, { why: data.refused })
                : say(w.zero, { result: words.numbers[chosen] });
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
        rows.replaceChildren(
            ...list.slice(0, MOST_ROWS).map(({ name, less, more }) =>
                html(
                    "div",
                    { class: "bar", "data-input": name },
                    html("span", {}, words.names[name] ?? name),
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
                    html("span", { class: "value" }, old ? "…" : percent(more)),
                ),
            ),
        );
        const kinks = list.filter(({ less, more }) => !(Math.abs(less + more) <= 1e-3 * scale));
        if (old) {
            told.textContent = "…";
            return;
        }
        told.textContent = [
            list.length
                ? say(w.most, {
                      name: words.names[list[0].name] ?? list[0].name,
                      result: words.numbers[chosen],
                      change: percent(Number.isFinite(list[0].more) ? list[0].more : list[0].less),
                  })
                : say(w.none, { result: words.numbers[chosen] }),
            kinks.length && say(w.kink, { names: kinks.map(({ name }) => words.names[name] ?? name).join(", ") }),
        ]
            .filter(Boolean)
            .join(" ");
    }
    return {
        node,
        draw,
        wants: () =>
            !seen || store.trouble("main") || (store.holding && cost > LIVE) || data?.given === page.given
                ? []
                : [{ kind: "derivatives", slot: "derivatives bench", given: page.given }],
        take(answer, request) {
            data = { ...answer, given: request.given };
            cost = answer.milliseconds ?? cost;
            draw();
        },
        data: () => data,
    };
}
