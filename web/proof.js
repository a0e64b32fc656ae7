/* What is proved of a solution: the library's proof in words, below the numbers that it is about. */
import { html, show } from "./draw.js";
import { fill_in } from "./words.js";

/* A sentence of each statement; the first one says whether anything is proved. */
export function proof_in_words(words, { numbers: n, reason, unique }) {
    const w = words.proof;
    if (!(n.proved > 0)) return [fill_in(w.not, { why: reason }), exact(w, n)].filter(Boolean);
    return [
        fill_in(n.undecided > 0 ? (n.undecided === 1 ? w.but_one : w.but) : w.proved, { n: n.undecided }),
        fill_in(w.within, { p: show(n.bound_p, 2), q: show(n.bound_q, 2) }),
        w.unique[unique] ?? (n.isolated > 0 ? w.isolated : w.unique["not shown"]),
        exact(w, n),
    ].filter(Boolean);
}
const exact = (w, { nearby }) => Number.isFinite(nearby) && fill_in(w.nearby, { nearby: show(nearby, 2) });

/* show(answer), or nothing where there is none: it is that of another case. */
export function proof_card(words) {
    const w = words.proof,
        list = html("ul", { class: "proof", "aria-live": "polite" });
    const node = html(
        "section",
        { class: "card" },
        html("h3", {}, w.title),
        list,
        html("p", { class: "note" }, w.about),
    );
    return {
        node,
        show(answer) {
            list.classList.toggle("old", !answer);
            if (!answer) return;
            const lines = answer.refused ? [fill_in(w.not, { why: answer.refused })] : proof_in_words(words, answer);
            list.replaceChildren(...lines.map((text) => html("li", {}, text)));
        },
    };
}
