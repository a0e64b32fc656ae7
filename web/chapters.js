/* Press, Brake and A soft wheel: each asks first, then answers with what the library has solved, then leaves it to the hand. */
import { SIDE_BY_SIDE, card, height_for, html, in_slides, show, show_notes, width_of } from "./draw.js";
import { creep_curve, curve_request, tractions_legend, tractions_picture } from "./contact.js";
import { ALL_TANGENTIAL, NORMAL, PRESETS, hold, plain } from "./state.js";
import { slip_share } from "./hero.js";
import { fit_lens, lens_figure, shape_of } from "./lens.js";
import { fill_in } from "./words.js";

const FREE = { ...PRESETS.rail, "creep-ratio": "0" };
const MEMORY = {
    support: "halfplane",
    formulation: "steady",
    radius: "150",
    young: "8",
    poisson: "0.48",
    mu: "0.25",
    load: "25",
    force: "0",
    "contact-elements": "40",
    mesh: "uniform",
    "relaxation-time": "0.01",
    "relaxation-ratio": "1",
    speed: "300",
};

/* The cases of the chapters that have one of their own. */
export const CHAPTER_CASES = {
    press: FREE,
    brake: { ...PRESETS.rail },
    soft: hold(PRESETS.roll, ALL_TANGENTIAL, "force", "0"),
    memory: MEMORY,
};

/* One of several answers: buttons; told(chosen) after. */
function choices(label, entries, chosen) {
    const buttons = entries.map(([value, text]) =>
        html(
            "button",
            {
                type: "button",
                class: "button choice",
                "aria-pressed": "false",
                onclick: () => {
                    for (const button of buttons)
                        button.setAttribute("aria-pressed", String(button.dataset.value === value));
                    chosen(value);
                },
                "data-value": value,
            },
            text,
        ),
    );
    return html("div", { class: "row choices", role: "group", "aria-label": label }, buttons);
}
/* The question, the figure beside it, and below the question what comes after the guess, hidden until then. */
const layout = (tale, after, ...figure) =>
    html(
        "div",
        { class: "two" },
        html("div", { class: "tale" }, tale),
        card("", ...figure),
        html("div", { class: "after" }, after),
    );

/* Of two figures in one window beside the text; on a phone the first one stays in sight. */
const beside = (wanted, around, least = 130) =>
    in_slides()
        ? Math.max(least, Math.round((innerHeight - 236) / 2))
        : matchMedia(SIDE_BY_SIDE).matches
          ? height_for(Math.min(wanted, 0.5 * (innerHeight - 180) + 30 - around), 0, least)
          : height_for(wanted, around, least);

/* What a chapter tells where its case was not solved; grey. */
function grey(node, page, name) {
    const trouble = page.store.trouble(name);
    node.classList.toggle("stale-inside", Boolean(trouble));
    return trouble ? fill_in(page.words.refused, { why: trouble }) : "";
}

/* The surfaces of a chapter's lens: those of a coarser solution as far as reach(answer) to each side, asked for when a hand
 * has let go.  asked: what a view wants for them; take: whether the answer was theirs. */
function surfaces_of({ store }, name, reach) {
    let shape = null,
        of = null;
    return {
        of: (answer) => shape ?? answer,
        asked() {
            const given = store.case(name),
                a = store.solved[name];
            return !a || store.holding || store.trouble(name) || of === given
                ? []
                : [{ kind: "closed", slot: `shape ${name}`, given: shape_of(given, reach(a)), of: given }];
        },
        take(answer, request) {
            if (!request.of) return false;
            of = request.of; /* also where there are none: they are not asked for again */
            if (!answer.refused) shape = answer;
            return true;
        },
    };
}

/* The lens of a chapter: so high that it and what else its card holds stand in one window. */
const lens_height = (wide, around) => height_for(Math.min(440, Math.max(230, wide * 0.5)), around, 150);

/* ---- Press ----------------------------------------------------------------------- */

const BESIDE = 24 /* mm that the lens shows to each side */,
    RISES = 12 /* solutions on the way to the load, each for as many milliseconds: */,
    RISE_EACH = 90,
    OPEN = 0.5; /* mm between wheel and rail before they touch */
const PRESS_FIT = { window: [-BESIDE, BESIDE], press: 2400, slip: 1, rub: 1e9, lift: 10 };
/* Before it is pressed: a wheel of radius R above its rail. */
function apart_above(a) {
    const x = Float64Array.from({ length: 49 }, (_, k) => k - BESIDE),
        none = new Float64Array(49),
        R = Number(a.values.radius);
    const numbers = { ...a.numbers, contact_from: 0, contact_to: 0, half_width: 1, approach: 1, nip_width: 0 };
    return {
        ...a,
        numbers,
        columns: {
            ...a.columns,
            x,
            h: none.map(() => 1),
            p: none,
            q: none,
            un: none,
            zone: none,
            shift: none,
            gap: x.map((v) => OPEN / PRESS_FIT.lift + v ** 2 / (2 * R)),
        },
    };
}

export function press_view(words, page) {
    const { store } = page,
        w = words.press,
        picture = html("figure"),
        notes = html("ul", { class: "notes" }),
        told = html("p", { class: "answer", "aria-live": "polite" }),
        compared = html("p", { class: "note", "aria-live": "polite" });
    let guess = null,
        answered = null,
        drawn_for = null,
        rise = [],
        risen = 0,
        timer = null;
    const motion = matchMedia("(prefers-reduced-motion: reduce)"),
        surfaces = surfaces_of(page, "press", () => BESIDE);
    /* The gap closes element by element: the library's own solutions under growing loads. */
    function let_rise() {
        if (motion.matches || !store.solved.press) return;
        rise = [];
        risen = 0;
        const load = store.solved.press.numbers.normal_load;
        for (let k = 1; k < RISES; k++)
            page.ask({
                kind: "closed",
                slot: `rise ${k}`,
                view: "press",
                k,
                given: {
                    ...shape_of(hold(store.case("press"), NORMAL, "load", plain(load * (k / RISES) ** 2)), BESIDE),
                },
            });
        clearInterval(timer);
        timer = setInterval(() => {
            if (risen >= RISES - 1 || store.holding) {
                clearInterval(timer);
                rise = [];
            } else if (rise[risen + 1]) risen++;
            drawn_for = null;
            render();
        }, RISE_EACH);
    }
    const set = (name, value) =>
        store.set(
            "press",
            name === "load"
                ? hold(store.case("press"), NORMAL, "load", plain(value))
                : { ...store.case("press"), [name]: plain(value) },
        );
    const load = page.knob({
        name: "press-load",
        label: words.hero.load,
        from: 1000,
        to: 50000,
        scale: "log",
        unit: "N/mm",
        read: (a) => a.numbers.normal_load,
        write: (v) => set("load", v),
    });
    const radius = page.knob({
        name: "press-radius",
        label: w.radius,
        from: 100,
        to: 1000,
        scale: "log",
        unit: "mm",
        read: (a) => Number(a.values.radius),
        write: (v) => set("radius", v),
    });
    const twice = html(
        "button",
        {
            type: "button",
            class: "button",
            onclick: () => set("load", Math.min(50000, 2 * (store.solved.press?.numbers.normal_load ?? 0))),
        },
        w.twice,
    );
    const node = layout(
        [
            html("p", { class: "question" }, w.question),
            choices(w.question, w.choices, (value) => {
                if (guess === null) let_rise();
                guess = value;
                drawn_for = null;
                render();
            }),
            told,
        ],
        [
            html("p", {}, w.then),
            html("div", { class: "knobs one" }, load.node, radius.node),
            html("div", { class: "row" }, twice, page.history_buttons()),
            compared,
        ],
        picture,
        notes,
        html(
            "div",
            { class: "row" },
            page.take_along(
                () => ({
                    root: picture.querySelector("svg"),
                    title: words.take.titles.press,
                    numbers: store.solved.press.numbers,
                    legend: [["--press", words.pressure]],
                }),
                "rollbem-press",
                null,
                () => store.case("press"),
            ),
        ),
    );
    function render() {
        const a = store.solved.press,
            before = store.ghosts.press,
            key = [a, before, guess, width_of(picture), store.trouble("press")];
        if (!a || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        const n = a.numbers,
            ghost = before && before !== a ? before : null,
            trouble = grey(node, page, "press");
        [load, radius].forEach((knob) => knob.sync(a));
        show_notes(notes, a);
        node.classList.toggle("revealed", guess !== null);
        const wide = width_of(picture),
            rising = rise[risen],
            shown = guess === null ? apart_above(a) : (rising ?? a);
        picture.replaceChildren(
            lens_figure(words, shown, {
                width: wide,
                height: lens_height(wide, 80),
                given: store.case("press"),
                fit: PRESS_FIT,
                shape: guess === null ? shown : (rising ?? surfaces.of(a)),
                ghost: guess === null || rising ? null : ghost,
                label: fill_in(words.tractions_alt, {
                    p0: guess === null ? "?" : show(shown.numbers.max_pressure, 3),
                    qmin: 0,
                    qmax: 0,
                    unit: words.mpa,
                }),
            }),
        );
        /* The answer is that of the question, whatever the hand does later. */
        if (trouble || (guess !== null && answered !== guess))
            told.textContent =
                trouble ||
                fill_in(guess === "16" ? w.right : w.wrong, {
                    wide: show(2 * n.half_width, 3),
                    a: show(n.half_width, 3),
                    p0: show(n.max_pressure, 3),
                    approach: show(n.approach, 2),
                    air: show(n.max_pressure * 10, 2),
                });
        answered = guess;
        compared.textContent =
            !ghost || guess === null
                ? w.hint
                : fill_in(w.compared, {
                      load: show(n.normal_load / ghost.numbers.normal_load, 3),
                      wide: show(n.half_width / ghost.numbers.half_width, 3),
                      pressure: show(n.max_pressure / ghost.numbers.max_pressure, 3),
                  });
    }
    return {
        node,
        render,
        uses: ["press"],
        fine: true,
        busy: () => rise.length > 0,
        wants: surfaces.asked,
        solved() {
            if (!store.holding) page.ask_view("press");
        },
        take(answer, request) {
            if (!surfaces.take(answer, request) && !answer.refused) rise[request.k] = answer;
            drawn_for = null;
            render();
        },
        resize() {
            drawn_for = null;
        },
        answer: (value) => node.querySelector(`[data-value="${value}"]`).click(),
    };
}

/* ---- Brake ----------------------------------------------------------------------- */

const CELLS = 16;
/* What the offsets of the lines are magnified by, so that all of it shows full sliding in one size: it moves nothing
 * where load, radius or stiffness change. */
const FULL = 0.085;
const slip_scale = ({ numbers: n, values }) =>
    (FULL * n.half_width) / ((Number(values.mu.split(",")[0]) || 1) * (n.half_width ** 2 / Number(values.radius)));
/* The state before in the window of this one. */
const at_same_width = (ghost, a) => {
    const by = a.numbers.half_width / ghost.numbers.half_width,
        high = a.numbers.max_pressure / ghost.numbers.max_pressure,
        over = (list, k) => list.map((v) => k * v);
    return {
        ...ghost,
        columns: { ...ghost.columns, x: over(ghost.columns.x, by), p: over(ghost.columns.p, high) },
        numbers: {
            ...ghost.numbers,
            contact_from: by * ghost.numbers.contact_from,
            contact_to: by * ghost.numbers.contact_to,
        },
    };
};

export function brake_view(words, page) {
    const { store } = page,
        w = words.brake,
        picture = html("figure"),
        curve_host = html("figure"),
        legend_row = html("div"),
        notes = html("ul", { class: "notes" });
    const told = html("p", { class: "answer", "aria-live": "polite" }),
        state = html("p", { "aria-live": "polite" }),
        care = html("p", { class: "note", "aria-live": "polite" }),
        solved_row = html("div", { class: "cells", role: "img", hidden: true });
    let painted = Array(CELLS).fill(0),
        revealed = false,
        drawn_for = null,
        curve = null,
        curve_key = "",
        ghost_curve = null,
        brush = null;
    const surfaces = surfaces_of(page, "brake", ({ numbers }) => 1.5 * numbers.half_width);
    const set = (given) => store.set("brake", given),
        given = () => store.case("brake");
    const drive = page.knob({
        name: "brake-drive",
        label: w.drive,
        from: 0,
        to: 1.2,
        ends: [words.below.free, words.below.skids],
        read: (a) => a.numbers.creep_ratio,
        write: (v) => set(hold(given(), ALL_TANGENTIAL, "creep-ratio", plain(v))),
    });
    const scale_knob = (name, label, from, to, unit, read) =>
        page.knob({
            name: `brake-${name}`,
            label,
            from,
            to,
            scale: "log",
            unit,
            read,
            write: (v) =>
                set(name === "load" ? hold(given(), NORMAL, "load", plain(v)) : { ...given(), [name]: plain(v) }),
        });
    const scales = [
        scale_knob("load", words.hero.load, 1000, 50000, "N/mm", (a) => a.numbers.normal_load),
        scale_knob("radius", words.press.radius, 100, 1000, "mm", (a) => Number(a.values.radius)),
        scale_knob("young", w.stiffness, 50000, 400000, "MPa", (a) => Number(a.values.young)),
    ];
    const cells = painted.map((_, k) =>
        html("button", {
            type: "button",
            "data-cell": k,
            onclick: (event) => {
                if (event.detail === 0) paint(k, 1 - painted[k]);
            },
            onpointerdown: (event) => {
                event.preventDefault();
                cells[k].focus();
                cells[k].releasePointerCapture?.(event.pointerId);
                brush = 1 - painted[k];
                paint(k, brush);
            },
        }),
    );
    const strip = html(
        "div",
        {
            class: "cells paint",
            style: `grid-template-columns:repeat(${CELLS},minmax(0,1fr))`,
            role: "group",
            "aria-label": w.question,
            onpointermove: (event) => {
                const over = document.elementFromPoint(event.clientX, event.clientY)?.dataset?.cell;
                if (brush !== null && over !== undefined) paint(Number(over), brush);
            },
        },
        cells,
    );
    window.addEventListener("pointerup", () => {
        brush = null;
    });
    const see = html(
        "button",
        {
            type: "button",
            class: "button main",
            onclick: () => {
                revealed = true;
                drawn_for = null;
                render();
            },
        },
        w.see,
    );
    const node = layout(
        [
            html("p", { class: "question" }, w.question),
            html("p", { class: "note" }, w.how),
            html("div", { class: "ends-row" }, html("span", {}, w.rear), html("span", {}, w.front)),
            strip,
            solved_row,
            html("div", { class: "row", style: "margin:.7rem 0" }, see),
            told,
        ],
        [
            html("p", {}, w.then),
            html("div", { class: "knobs one" }, drive.node),
            state,
            html("div", { class: "row" }, page.history_buttons()),
            html("p", {}, w.and),
            html(
                "div",
                { class: "knobs one" },
                scales.map((knob) => knob.node),
            ),
            care,
        ],
        picture,
        legend_row,
        notes,
        html("div", { class: "revealing" }, curve_host),
        html(
            "div",
            { class: "row" },
            page.take_along(
                () => ({
                    root: picture.querySelector("svg"),
                    title: words.take.titles.brake,
                    numbers: store.solved.brake.numbers,
                    legend: legend_row.firstChild?.entries,
                }),
                "rollbem-brake",
                null,
                given,
            ),
            html(
                "span",
                { class: "revealing" },
                page.take_along(
                    () => ({
                        root: curve_host.querySelector("svg"),
                        title: words.take.titles.curve,
                        numbers: store.solved.brake.numbers,
                    }),
                    "rollbem-creep",
                    null,
                    given,
                    words.take.curve,
                ),
            ),
        ),
    );

    function paint(k, zone) {
        painted[k] = zone;
        draw_cells();
    }
    function draw_cells() {
        painted.forEach((zone, k) => {
            cells[k].className = zone ? "zone2" : "zone1";
            cells[k].textContent = zone ? "≈" : "=";
            cells[k].setAttribute(
                "aria-label",
                fill_in(w.cell, { k: k + 1, n: CELLS, zone: zone ? words.hero.slips : words.hero.sticks }),
            );
            cells[k].setAttribute("aria-pressed", String(Boolean(zone)));
        });
    }
    /* What the middles of the cells do, as solved. */
    function solved_cells({ columns: c, numbers: n }) {
        return painted.map((_, k) => {
            const x = n.contact_from + ((k + 0.5) / CELLS) * n.nip_width;
            let i = 0;
            while (i < c.x.length - 1 && c.x[i] + c.h[i] / 2 < x) i++;
            return c.zone[i] > 1 ? 1 : 0;
        });
    }
    const wanted = () => curve_request(given(), "curve brake");
    const wants = () => [...(revealed && wanted().key !== curve_key ? [wanted()] : []), ...surfaces.asked()];
    function render() {
        const a = store.solved.brake,
            before = store.ghosts.brake,
            key = [a, before, revealed, curve, width_of(picture), store.trouble("brake")];
        if (!a || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        const n = a.numbers,
            trouble = grey(node, page, "brake"),
            ghost = before && before !== a ? before : null;
        [drive, ...scales].forEach((knob) => knob.sync(a));
        show_notes(notes, a);
        node.classList.toggle("revealed", revealed);
        see.hidden = revealed;
        const wide = width_of(picture);
        picture.replaceChildren(
            lens_figure(words, a, {
                width: wide,
                height: beside(Math.min(340, Math.max(210, wide * 0.42)), 80),
                given: given(),
                fit: { ...fit_lens(a), slip: slip_scale(a) },
                shape: surfaces.of(a),
                blank: !revealed,
                alike: true,
                ghost: revealed && ghost ? at_same_width(ghost, a) : null,
                unit: "x/a",
                label: revealed ? words.take.titles.brake : w.question,
            }),
        );
        legend_row.replaceChildren(revealed ? tractions_legend(words, a.columns.zone, false) : "");
        if (!revealed) return;
        if (wants().length) page.ask_view("brake");
        const right = solved_cells(a),
            hits = right.filter((zone, k) => zone === painted[k]).length,
            focused = curve_host.contains(document.activeElement),
            used = Math.abs(n.force_ratio),
            slips = slip_share(a) || 0;
        if (!solved_row.firstChild) {
            solved_row.hidden = false;
            solved_row.style.gridTemplateColumns = `repeat(${CELLS},minmax(0,1fr))`;
            solved_row.setAttribute("aria-label", w.solved);
            solved_row.append(
                ...right.map((zone) => html("span", { class: zone ? "zone2" : "zone1" }, zone ? "≈" : "=")),
            );
            told.textContent = `${fill_in(w.hits, { hits, n: CELLS })} ${w.answer}`;
        }
        state.textContent =
            trouble ||
            fill_in(n.stick === 0 ? w.state_skids : w.state, {
                s: show(100 * n.creep_ratio, 3),
                slips: show(100 * (n.stick === 0 ? 1 : slips), 2),
                used: show(100 * used, 2),
                slower: show(100 * n.creepage, 2),
            });
        care.textContent =
            ghost && Math.abs(ghost.numbers.max_pressure / n.max_pressure - 1) > 0.01
                ? fill_in(w.care_not, {
                      before: show(ghost.numbers.max_pressure, 3),
                      now: show(n.max_pressure, 3),
                      width_before: show(2 * ghost.numbers.half_width, 3),
                      width: show(2 * n.half_width, 3),
                  })
                : "";
        curve_host.replaceChildren(
            creep_curve(words, {
                width: width_of(curve_host),
                height: beside(Math.min(330, Math.max(240, width_of(curve_host) * 0.42)), 40, 160),
                curve,
                ghost: ghost_curve,
                old: curve_key !== wanted().key,
                numbers: n,
                store,
                name: "brake",
                set: (s) => set(hold(given(), ALL_TANGENTIAL, "creep-ratio", plain(Math.max(0, s)))),
                set_force: (f) => set(hold(given(), ALL_TANGENTIAL, "force-ratio", plain(Math.min(-0.001, f)))),
            }),
        );
        if (focused) curve_host.querySelector(".handle")?.focus();
    }
    draw_cells();
    return {
        node,
        render,
        wants,
        uses: ["brake"],
        fine: true,
        solved() {
            if (!store.holding) page.ask_view("brake");
        },
        resize() {
            drawn_for = null;
        },
        paint,
        see: () => see.click(),
        take(answer, request) {
            if (surfaces.take(answer, request)) {
                drawn_for = null;
                return render();
            }
            ghost_curve = curve;
            [curve, curve_key] = [answer.refused ? null : answer.points, request.key];
            render();
        },
    };
}

/* ---- A soft wheel ---------------------------------------------------------------- */

const SOFT_WINDOW = [-26, 26];

export function soft_view(words, page) {
    const { store } = page,
        w = words.soft,
        picture = html("figure"),
        curve_host = html("figure"),
        leaning = html("figure"),
        notes = html("ul", { class: "notes" }),
        notes_memory = html("ul", { class: "notes" });
    const told = html("p", { class: "answer", "aria-live": "polite" }),
        state = html("p", { "aria-live": "polite" }),
        costs = html("p", { "aria-live": "polite" });
    let guess = null,
        drawn_for = null,
        curve = null,
        curve_key = "";
    const given = () => store.case("soft"),
        set = (more) => store.set("soft", { ...given(), ...more });
    const cover = page.knob({
        name: "soft-cover",
        label: w.cover,
        from: 4,
        to: 40,
        unit: "mm",
        read: (a) => Number(a.values["cover-thickness"]),
        write: (v) => set({ "cover-thickness": plain(v) }),
    });
    const poisson = page.knob({
        name: "soft-poisson",
        label: w.poisson,
        from: 0.2,
        to: 0.485,
        read: (a) => Number(a.values.poisson),
        write: (v) => set({ poisson: plain(v) }),
    });
    const speed = page.knob({
        name: "soft-speed",
        label: w.speed,
        from: 10,
        to: 100000,
        scale: "log",
        unit: "mm/s",
        read: (a) => Number(a.values.speed),
        write: (v) => store.set("memory", { ...store.case("memory"), speed: plain(v) }),
    });
    const relaxing = layout(
        html("p", {}, w.memory),
        [html("div", { class: "knobs one" }, speed.node), costs],
        html("h3", {}, w.leaning),
        leaning,
        notes_memory,
    );
    const asking = layout(
        [
            html("p", { class: "question" }, w.question),
            choices(w.question, w.choices, (value) => {
                guess = value;
                drawn_for = null;
                page.ask_view("soft");
                render();
            }),
            told,
        ],
        [
            html("p", {}, w.then),
            html("div", { class: "knobs one" }, cover.node, poisson.node),
            state,
            html("div", { class: "row" }, page.history_buttons()),
        ],
        picture,
        notes,
        html("div", { class: "revealing" }, curve_host),
        html(
            "div",
            { class: "row" },
            page.take_along(
                () => ({
                    root: picture.querySelector("svg"),
                    title: words.take.titles.soft,
                    numbers: store.solved.soft.numbers,
                    legend: tractions_legend(words, store.solved.soft.columns.zone, false).entries,
                }),
                "rollbem-soft",
                null,
                given,
            ),
        ),
    );
    relaxing.hidden = true;
    const node = html("div", { class: "stack" }, asking, relaxing);
    const wanted = () => curve_request(given(), "curve soft");
    const surfaces = surfaces_of(page, "soft", () => SOFT_WINDOW[1]);
    const wants = () => [
        ...(guess !== null && !store.holding && wanted().key !== curve_key ? [wanted()] : []),
        ...surfaces.asked(),
    ];
    /* The wheel turns as if its radius were larger by this part: the rim is so much slower than it travels. */
    const larger_by = (n) => 1 / (1 - n.free_creepage) - 1;
    function render() {
        const a = store.solved.soft,
            m = store.solved.memory,
            key = [
                a,
                m,
                store.ghosts.soft,
                store.ghosts.memory,
                guess,
                curve,
                width_of(picture),
                store.trouble("soft"),
                store.trouble("memory"),
            ];
        if (!a || (drawn_for && key.every((part, k) => part === drawn_for[k]))) return;
        drawn_for = key;
        const n = a.numbers,
            trouble =
                grey(node, page, "soft") ||
                (store.trouble("memory") && fill_in(words.refused, { why: store.trouble("memory") })),
            shown = guess !== null,
            percent = 100 * larger_by(n);
        const ghost_of = (name) =>
            shown && store.ghosts[name] && store.ghosts[name] !== store.solved[name] ? store.ghosts[name] : null;
        [cover, poisson].forEach((knob) => knob.sync(a));
        show_notes(notes, a);
        for (const part of [asking, relaxing]) part.classList.toggle("revealed", shown);
        relaxing.hidden = !shown;
        const wide = width_of(picture),
            tall = beside(Math.min(230, Math.max(150, wide * 0.3)), 80);
        picture.replaceChildren(
            lens_figure(words, a, {
                width: wide,
                height: (in_slides() ? height_for : beside)(Math.min(330, Math.max(200, wide * 0.42)), 80),
                given: given(),
                fit: { ...fit_lens(a), window: SOFT_WINDOW, press: 3 },
                shape: surfaces.of(a),
                ghost: ghost_of("soft"),
                label: words.take.titles.soft,
            }),
        );
        if (!shown) return;
        const kind = Math.abs(percent) < 0.05 ? "same" : percent > 0 ? "larger" : "smaller";
        told.textContent =
            trouble ||
            [
                guess === kind ? w.right : w.wrong,
                fill_in(w.answer[kind], { percent: show(Math.abs(percent), 2), xi: show(n.free_creepage, 2) }),
                kind === "larger" ? w.why : "",
            ]
                .filter(Boolean)
                .join(" ");
        state.textContent = trouble || fill_in(w.state, { percent: show(percent, 2), half: show(n.half_width, 3) });
        if (curve_key !== wanted().key && wants().length) page.ask_view("soft");
        curve_host.replaceChildren(
            creep_curve(words, {
                width: width_of(curve_host),
                height: beside(270, 40, 160),
                curve,
                old: curve_key !== wanted().key,
                numbers: n,
                store,
                name: "soft",
                set: (s) => store.set("soft", hold(given(), ALL_TANGENTIAL, "creep-ratio", plain(s))),
                set_force: (f) => store.set("soft", hold(given(), ALL_TANGENTIAL, "force-ratio", plain(f))),
            }),
        );
        if (!m) return;
        speed.sync(m);
        show_notes(notes_memory, m);
        leaning.replaceChildren(
            tractions_picture(leaning, words, m, {
                width: wide,
                height: tall,
                name: "memory",
                slip: false,
                axes: { x: [-32, 32], top: 1.9, low: -0.4, slip: 0 },
                ghost: ghost_of("memory"),
            }),
        );
        const sum = [...m.columns.p].reduce((s, p, i) => s + p * m.columns.h[i], 0);
        costs.textContent = fill_in(w.costs, {
            moment: show(m.numbers.resistance_moment, 2),
            forward: show(m.numbers.resistance_moment / (sum || 1), 2),
        });
    }
    return {
        node,
        render,
        wants,
        uses: ["soft", "memory"],
        fine: true,
        solved() {
            if (!store.holding) page.ask_view("soft");
        },
        resize() {
            drawn_for = null;
        },
        answer: (value) => node.querySelector(`[data-value="${value}"]`).click(),
        take(answer, request) {
            if (surfaces.take(answer, request)) {
                drawn_for = null;
                return render();
            }
            [curve, curve_key] = [answer.refused ? null : answer.points, request.key];
            render();
        },
    };
}
