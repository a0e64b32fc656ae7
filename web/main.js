/* The page: worker, requests of which the newest wins, tabs, link. */
import { html } from "./draw.js";
import { PRESETS, formulation_of, hold, ALL_TANGENTIAL, read_case_file, read_link, write_link } from "./state.js";
import { controls } from "./controls.js";
import { contact_view } from "./contact.js";
import { roll_view } from "./roll.js";
import { below_view } from "./below.js";
import { step_view } from "./step.js";
import { take_view } from "./take.js";
import { say, words } from "./words.js";

const CURVE_WAITS = 120; /* ms */

const at = (id) => document.getElementById(id);

/* One request at work; of those that wait only the newest of each kind. */
function requests(worker, taken) {
    const waiting = new Map();
    let busy = null, last = 0;
    function next() {
        if (busy || !waiting.size) return;
        const [kind, request] = waiting.entries().next().value;
        waiting.delete(kind);
        busy = request;
        worker.postMessage(request);
    }
    worker.onmessage = ({ data }) => {
        const request = busy;
        busy = null;
        taken(data, request, waiting.has(data.kind));
        next();
    };
    return { ask(request) { waiting.delete(request.kind); waiting.set(request.kind, { ...request, id: ++last }); next(); }, idle: () => !busy && !waiting.size };
}

function tell(text) {
    at("message").textContent = text;
    at("message").hidden = !text;
}

/* Two of them: one solves the case itself, which never waits for the curve, the steps or the stress
 * that the other one is at. */
async function start_workers() {
    const packed = Uint8Array.from(atob(WASM), (c) => c.charCodeAt(0));
    const wasm = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    const script = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));
    return Promise.all([0, 1].map(() => new Promise((resolve, reject) => {
        const worker = new Worker(script);
        worker.onmessage = ({ data }) => resolve({ worker, ...data });
        worker.onerror = (event) => reject(new Error(event.message));
        worker.postMessage({ wasm });
    })));
}

async function main() {
    at("subtitle").textContent = words.subtitle;
    at("footer").textContent = say(words.footer, { version: VERSION });
    at("main").append(html("p", { class: "note" }, words.loading));
    let workers;
    try { workers = await start_workers(); } catch (error) { return tell(say(words.no_wasm, { why: error.message })); }

    const page = { given: JSON.parse(at("carried").textContent) ?? { ...PRESETS.rail }, drawn: null, answer: null, curve: null, options: workers[0].options, results: workers[0].results,
        units: Object.fromEntries(workers[0].results.number.map((r) => [r.name, r.unit])) };
    let current = "contact", curve_key = null, curve_shown = null, curve_timer = null, link_timer = null, first = true, panel = null;
    const makers = { contact: contact_view, roll: roll_view, below: below_view, step: step_view, take: take_view }, views = {};

    function refuse(answer, request, newer) {
        if (answer.kind === "guess") views.step.take(answer);
        else if (answer.kind === "curve") show_curve(null, request.key); /* the case itself may well be solved */
        else if (!newer) {
            tell(say(words.refused, { why: answer.refused }));
            at("main").classList.add("stale");
            first_draw();
        }
    }
    function show_curve(points, key) {
        page.curve = points;
        curve_shown = key;
        if (current === "contact") views.contact?.draw_curve();
    }
    function take(answer, request, newer) {
        if (answer.refused) return refuse(answer, request, newer);
        if (answer.kind === "curve") return show_curve(answer.points, request.key);
        if (answer.kind !== "solve") return views[request.view]?.take(answer);
        at("main").classList.remove("stale");
        page.answer = answer;
        tell(answer.unsolved ? say(words.unsolved, { why: answer.unsolved }) : "");
        first_draw();
        ask_curve();
        if (current === "contact" || current === "take") views[current].draw();
        if (current === "step") page.ask_view(); /* its strip is that of the solution */
    }
    const [solving, aside] = workers.map(({ worker }) => requests(worker, take));
    const queue = { ask: (request) => (request.kind === "solve" ? solving : aside).ask(request), idle: () => solving.idle() && aside.idle() && (current !== "contact" || curve_key === null || curve_shown === curve_key) };
    page.ask = queue.ask;

    /* The curve follows when the case rests: while a slider moves the processor is the case's. */
    function ask_curve() {
        if (formulation_of(page.given) !== "steady") { clearTimeout(curve_timer); page.curve = null; curve_key = curve_shown = null; return; }
        const given = hold(page.given, ALL_TANGENTIAL, "creep-ratio", "0.5"), key = JSON.stringify(given);
        if (key === curve_key) return;
        curve_key = key;
        clearTimeout(curve_timer);
        curve_timer = setTimeout(() => queue.ask({ kind: "curve", given, key, from: -1.4, to: 1.4, points: 29 }), page.curve ? CURVE_WAITS : 0);
    }
    page.curve_is_old = () => curve_shown !== curve_key;
    page.ask_view = () => (views[current]?.wants() ?? []).forEach((request) => queue.ask({ ...request, view: current }));
    page.change = (given, redraw) => {
        page.given = given;
        queue.ask({ kind: "solve", given });
        if (current !== "step") page.ask_view();
        if (redraw) panel?.draw();
        page.remember();
    };
    page.remember = () => {
        clearTimeout(link_timer);
        link_timer = setTimeout(() => history.replaceState(null, "", write_link(page.given, current, page.drawn)), 250);
    };

    /* On phones a view stands above the controls, but for the first one, which has them between its
     * pictures: so they also come after it for the keyboard. */
    const phone = matchMedia("(max-width: 800px)");
    function order_controls() {
        const after = phone.matches && current !== "contact";
        if (after !== (at("main").nextElementSibling === at("controls"))) at("main")[after ? "after" : "before"](at("controls"));
    }
    phone.addEventListener("change", order_controls);

    function open(name) {
        views[current]?.leave?.();
        current = name;
        order_controls();
        views[name] ??= makers[name](words, page);
        at("main").replaceChildren(views[name].node);
        at("main").dataset.view = name;
        at("main").setAttribute("aria-labelledby", `tab-${name}`);
        for (const tab of at("tabs").children) { const on = tab.id === `tab-${name}`; tab.setAttribute("aria-selected", on); tab.tabIndex = on ? 0 : -1; }
        views[name].draw();
        page.ask_view();
        history.replaceState(null, "", write_link(page.given, current, page.drawn));
    }
    const names = Object.keys(makers);
    at("tabs").setAttribute("aria-label", words.subtitle);
    at("tabs").append(...names.map((name, k) => html("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": "main", onclick: () => open(name),
        onkeydown: (event) => { const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key]; if (step) { const next = at(`tab-${names[(k + step + names.length) % names.length]}`); next.click(); next.focus(); } } }, words.tabs[name])));
    at("controls").setAttribute("aria-label", words.controls);
    at("signs").setAttribute("aria-label", words.signs);
    at("signs").append(html("button", { type: "button", class: "button", onclick: () => at("signs").close() }, words.close));
    at("controls").addEventListener("submit", (event) => event.preventDefault());

    function first_draw() {
        if (!first) return;
        first = false;
        panel = controls(at("controls"), words, page.options, page);
        open(current);
    }
    function follow_link() {
        try {
            const link = read_link(location.hash, names);
            if (link?.given) page.given = link.given;
            if (link) [current, page.drawn] = [link.view, link.drawn];
        } catch (error) { tell(say(words.link_broken, { why: error.message })); return; }
        queue.ask({ kind: "solve", given: page.given });
        if (!first) { panel.draw(); open(current); }
    }
    page.open_file = async (file) => {
        try {
            page.change(read_case_file(await file.text()));
            panel.draw();
        } catch (error) { tell(say(words.file_broken, { file: file.name, why: error.message })); }
    };
    window.addEventListener("dragover", (event) => event.preventDefault());
    window.addEventListener("drop", (event) => { event.preventDefault(); if (event.dataTransfer.files[0]) page.open_file(event.dataTransfer.files[0]); });
    window.addEventListener("hashchange", follow_link);
    let width = innerWidth;
    window.addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; (views[current]?.resize ?? views[current]?.draw)?.(); } });
    /* For its tests: milliseconds from a move to its picture, sorted; each move is a value of its own. */
    async function time_moves(option, start, count) {
        const times = [], channel = new MessageChannel(), turn = () => new Promise((resolve) => { channel.port1.onmessage = resolve; channel.port2.postMessage(0); });
        for (let k = 1; k <= count; k++) {
            const began = performance.now(), before = page.answer;
            page.change({ ...page.given, [option]: String(Number((start * (1 + 0.002 * k)).toPrecision(6))) });
            while (page.answer === before) await turn();
            document.body.getBoundingClientRect(); /* laid out */
            times.push(performance.now() - began);
        }
        return times.sort((a, b) => a - b);
    }
    window.rollbem = { time_moves, page, views, queue, open, preset: (name) => { page.change({ ...PRESETS[name] }); panel.draw(); } };
    follow_link();
    if (location.hash.length > 1 && at("message").textContent) queue.ask({ kind: "solve", given: page.given });
}
main();
