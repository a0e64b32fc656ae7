/* The workbench: the whole panel, tractions, numbers and the creep curve, and what can be taken along. */
import { ONE_COLUMN, html } from "./draw.js";
import { controls } from "./controls.js";
import { contact_view } from "./contact.js";
import { take_view } from "./take.js";

export function bench_view(words, page) {
    const form = html("form", { id: "controls", autocomplete: "off" }),
        contact = contact_view(words, page),
        take = take_view(words, page);
    const panel = controls(form, words, page);
    const more = html(
        "details",
        {
            class: "card take",
            ontoggle: () => {
                if (more.open) take.draw();
            },
        },
        html("summary", {}, words.take_title),
        take.node,
    );
    const node = html(
        "div",
        { class: "columns" },
        form,
        html("div", { class: "stack", id: "bench" }, contact.node, more),
    );
    /* On phones the controls come after the tractions, which stay in sight. */
    const phone = matchMedia(ONE_COLUMN);
    function place_controls() {
        if (phone.matches) contact.tractions.after(form);
        else node.prepend(form);
    }
    phone.addEventListener("change", place_controls);
    place_controls();
    return {
        node,
        uses: ["main"],
        fine: true,
        wants: () => contact.wants(),
        take: (answer, request) => contact.take(answer, request),
        busy: () => contact.busy(),
        show(name) {
            if (name === "take") more.open = true;
        },
        render() {
            if (!page.answer) return;
            panel.draw();
            contact.draw();
            if (more.open) take.draw();
        },
        resize() {
            contact.resize();
        },
        contact,
    };
}
