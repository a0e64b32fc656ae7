/* For a class: every chapter as one slide, with a question whose guesses are counted by taps, and a worksheet of the same
 * questions. */
import { html, svg } from "./draw.js";
import { NORMAL, hold } from "./state.js";
import { fill_in } from "./words.js";

/* The answer of a question that depends on the case, else that of the words. */
const right_of = ({ views }, name, question) =>
    name === "below" ? (views.below.is_deep?.() ? "below" : "surface") : question.right;
const told_of = (page, question) => fill_in(question.told, { pivots: page.answer?.numbers.iterations ?? "" });

/* What a slide shows before the answer, and what the answer does to its picture. */
const BEFORE = { brake: (views) => views.brake.see() };
const AFTER = {
    press: (views) => views.press.answer("16"),
    brake: (_views, store) => store.set("brake", hold(store.case("brake"), NORMAL, "load", "25000")),
    roll: (views) => views.roll.player.go(1e6),
    soft: (views) => views.soft.answer("larger"),
    below: (views) => views.below.reveal(),
    crack: (views) => views.crack.answer("slides"),
    step: (views) => views.step.player.go(1e6),
};

/* parts: { views, store, show(name), near(name), idle() }: the chapters, one of them alone in the window, one of them
 * solved and drawn although it is not in the window, and whether all is drawn. */
export function make_classroom(words, page, parts) {
    const w = words.classroom,
        { views, store } = parts,
        names = Object.keys(w.questions),
        root = document.documentElement,
        panels = {},
        place = html("output", { class: "place" });
    let at = 0,
        on = false;
    const button = (text, act, more = {}) =>
        html("button", { type: "button", class: "button", onclick: act, ...more }, text);
    const bar = html(
        "nav",
        { id: "slides", "aria-label": w.title, hidden: true },
        button("←", () => go(at - 1), { "aria-label": w.back }),
        place,
        button("→", () => go(at + 1), { "aria-label": w.next }),
        html("span", { class: "note" }, w.keys),
        button(w.worksheet, open_sheet),
        button(w.leave, leave),
    );
    document.body.append(bar);

    /* ---- Slides ---- */

    function panel_of(name) {
        const question = w.questions[name],
            counts = Object.fromEntries(question.choices.map(([value]) => [value, 0])),
            told = html("p", { class: "answer", "aria-live": "polite", hidden: true }, ""),
            sum = () => Math.max(1, ...Object.values(counts));
        const rows = question.choices.map(([value, text]) => {
            const number = html("b", {}, "0"),
                track = html("i", {});
            const tap = (by) => {
                counts[value] = Math.max(0, counts[value] + by);
                rows.forEach((row) => row.draw());
            };
            return {
                value,
                tap,
                draw() {
                    number.textContent = counts[value];
                    track.style.width = `${(100 * counts[value]) / sum()}%`;
                },
                node: html(
                    "div",
                    { class: "tally", "data-value": value },
                    button([html("span", {}, text), number], () => tap(1), { class: "button choice" }),
                    button("−", () => tap(-1), { "aria-label": fill_in(w.less, { text }) }),
                    html("span", { class: "count-bar", "aria-hidden": "true" }, track),
                ),
            };
        });
        const show = button(
            w.show,
            () => {
                if (!told.hidden) return;
                AFTER[name]?.(views, store);
                show.hidden = true;
                for (const row of rows)
                    row.node.classList.toggle("right", row.value === right_of(parts, name, question));
                told.textContent = told_of(page, question);
                told.hidden = false;
            },
            { class: "button main" },
        );
        return {
            rows,
            show,
            node: html(
                "div",
                { class: "panel" },
                html("p", { class: "question" }, question.ask),
                ...rows.map(({ node }) => node),
                show,
                told,
            ),
        };
    }
    function go(k) {
        at = Math.max(0, Math.min(names.length - 1, k));
        const name = names[at],
            { section } = views[name];
        if (!panels[name]) {
            panels[name] = panel_of(name);
            section.insertBefore(panels[name].node, views[name].node);
        }
        for (const other of document.querySelectorAll(".chapter.now")) other.classList.remove("now");
        section.classList.add("now");
        place.textContent = `${at + 1} / ${names.length}`;
        parts.show(name);
        BEFORE[name]?.(views);
    }
    function start(name) {
        on = true;
        bar.hidden = false;
        root.classList.add("slides", "large");
        go(Math.max(0, names.indexOf(name)));
    }
    function leave() {
        on = false;
        bar.hidden = true;
        root.classList.remove("slides", "large");
        parts.show(names[at]);
    }
    window.addEventListener("keydown", (event) => {
        const target = event.target,
            typing = target.matches?.("input[type=text], textarea"),
            holds = target.matches?.("input[type=range], [role=slider], .handle");
        if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
        if (!on) {
            if (event.key === "s" || event.key === "S") start(parts.current());
            return;
        }
        const step = { PageDown: 1, PageUp: -1, ...(!holds && { ArrowRight: 1, ArrowLeft: -1 }) }[event.key],
            panel = panels[names[at]];
        if (step) {
            event.preventDefault();
            go(at + step);
        } else if (event.key === "Escape") leave();
        else if (event.key === "a" || event.key === "A") panel.show.click();
        else panel.rows[Number(event.key) - 1]?.tap(1);
    });
    /* A slider that the hand has let go leaves the arrow keys to the slides. */
    window.addEventListener("pointerup", () => on && document.activeElement?.blur?.());

    /* ---- The worksheet ---- */

    function open_sheet() {
        window.open(`${location.href.split("#")[0]}#class=sheet`, "_blank");
    }
    const picture_of = (name) => {
        if (name === "hero") {
            const text = views.hero.picture_of((colour) => `var(--${colour})`);
            return document.importNode(new DOMParser().parseFromString(text, "image/svg+xml").documentElement, true);
        }
        const figure = name === "step" ? ".pivots figure svg" : "figure svg",
            copy = views[name].section.querySelector(figure).cloneNode(true);
        copy.querySelectorAll(".handle").forEach((handle) => handle.remove());
        return copy;
    };
    /* Colours that are drawn, so that they are printed without backgrounds too. */
    function legend_drawn() {
        const entries = [
            ["--stick", words.hero.sticks],
            ["--slip", words.hero.slips],
            ["--press", words.pressure],
            ["--rub", words.friction],
        ];
        return svg(
            "svg",
            {
                viewBox: "0 0 560 20",
                class: "keys",
                role: "img",
                "aria-label": entries.map(([, text]) => text).join(", "),
            },
            entries.flatMap(([colour, text], k) => [
                svg("rect", { x: 140 * k, y: 4, width: 18, height: 12, style: `fill:var(${colour})` }),
                svg("text", { x: 140 * k + 24, y: 15 }, text),
            ]),
        );
    }
    async function sheet() {
        root.classList.add("worksheet");
        const blank = {},
            solved = {};
        for (const name of names) {
            parts.near(name);
            await parts.idle();
            BEFORE[name]?.(views);
            await parts.idle();
            blank[name] = picture_of(name);
            AFTER[name]?.(views, store);
            await parts.idle();
            solved[name] = picture_of(name);
        }
        const one = (name, k, answered) => {
            const question = w.questions[name],
                right = answered && right_of(parts, name, question);
            return html(
                "section",
                {},
                html("h2", {}, `${k + 1} ${words.chapters[name].title}`),
                html("p", {}, question.ask),
                (answered ? solved : blank)[name],
                html(
                    "ul",
                    {},
                    question.choices.map(([value, text]) => html("li", {}, `${value === right ? "☒" : "☐"} ${text}`)),
                ),
                answered && html("p", { class: "answer" }, told_of(page, question)),
            );
        };
        const page_of = (title, answered) =>
            html(
                "article",
                {},
                html("h1", {}, title, !answered && html("small", {}, w.name)),
                legend_drawn(),
                html(
                    "div",
                    { class: "questions" },
                    names.map((name, k) => one(name, k, answered)),
                ),
            );
        document.body.append(
            html(
                "div",
                { id: "sheet" },
                button(w.print, () => window.print(), { class: "button main" }),
                page_of(w.sheet, false),
                page_of(w.solutions, true),
            ),
        );
    }
    return { start, sheet, go, leave, panels, place: () => (on ? names[at] : null), names };
}
