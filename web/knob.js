/* What hands move: things that are dragged, sliders, and a slider with an exact field for one number of a case. */
import { html, show } from "./draw.js";
import { with_point } from "./state.js";

const KEYS_REST = 500; /* ms after which keys are taken to rest */

/* A slider that a hand takes hold of: states on the way are one step for undo, and a finger that scrolls the page
 * over it leaves it as it was.  move(value) on the way.  The knob may stand beside the value that is shown, on the
 * nearest of its steps: show_on keeps that value too. */
export function show_on(slider, value) {
    slider.value = value;
    slider.dataset.shown = value;
}
export function slider_for(store, attributes, move) {
    const slider = html("input", { type: "range", ...attributes });
    let before = null,
        shown = null,
        down = false,
        timer = null;
    slider.addEventListener(
        "pointerdown",
        () => {
            before = slider.value;
            shown = slider.dataset.shown ?? before;
            down = true;
            store.hold();
        },
        true,
    );
    slider.addEventListener("pointercancel", () => {
        if (before !== null && slider.value !== before) {
            slider.value = before;
            move(Number(shown));
        }
        release();
    });
    slider.addEventListener("input", () => {
        store.hold();
        move(Number(slider.value));
        clearTimeout(timer);
        if (!down) timer = setTimeout(release, KEYS_REST);
    });
    function release() {
        down = false;
        clearTimeout(timer);
        store.release();
    }
    for (const event of ["change", "pointerup", "blur"]) slider.addEventListener(event, release);
    return slider;
}

/* A thing that a pointer drags: states on the way are one step for undo.  begin(event) gives what follows the pointer,
 * or nothing where there is nothing to drag. */
export function make_draggable(store, node, begin) {
    node.addEventListener("pointerdown", (event) => {
        store.hold();
        const move = begin(event);
        if (!move) return store.release();
        event.preventDefault();
        const up = () => {
            window.removeEventListener("pointermove", move);
            for (const end of ["pointerup", "pointercancel"]) window.removeEventListener(end, up);
            store.release();
        };
        window.addEventListener("pointermove", move);
        for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, up);
    });
}

/* read(answer): its number as solved; write(number): another one; text(number): what it means, for who hears it. */
export function make_knob(
    store,
    { name, label, from, to, scale, unit = "", read, write, text, ends, step = 400, digits = 3, whole = false, title },
) {
    const log = scale === "log",
        up = (v) => (log ? Math.log(v) : v),
        down = (v) => (log ? Math.exp(v) : v);
    const tidy = (v) => (whole ? Math.round(v) : Number(v.toPrecision(digits)));
    const id = `dial-${name}-${++count}`;
    const slider = slider_for(
        store,
        { min: up(from), max: up(to), step: (up(to) - up(from)) / step, "aria-label": label, "data-dial": name },
        (v) => write(tidy(down(v))),
    );
    const field = html("input", {
        type: "text",
        id,
        inputmode: "decimal",
        title,
        onchange: () => {
            const value = Number(with_point(field.value));
            if (Number.isFinite(value) && value >= (log ? 1e-300 : -Infinity)) write(value);
            else sync(last);
        },
    });
    let last = null;
    function sync(answer) {
        if (!answer) return;
        last = answer;
        const value = read(answer),
            shown = Number.isFinite(value) ? value : 0;
        if (document.activeElement !== slider || !store.holding)
            show_on(slider, up(Math.max(log ? from : -Infinity, shown)));
        if (document.activeElement !== field)
            field.value = String(Number((Math.abs(shown) < 1e-12 ? 0 : shown).toPrecision(4)));
        slider.setAttribute("aria-valuetext", text ? text(shown) : `${show(shown)} ${unit}`);
    }
    return {
        node: html(
            "div",
            { class: "dial" },
            html("label", { for: id }, label),
            html("span", { class: "field" }, field, unit && html("span", { class: "unit" }, unit)),
            slider,
            ends &&
                html(
                    "span",
                    { class: "ends", "aria-hidden": "true" },
                    html("span", {}, ends[0]),
                    html("span", {}, ends[1]),
                ),
        ),
        sync,
        slider,
        field,
    };
}
let count = 0;
