/* The page: worker, requests of which the newest wins, tabs, link. */
import { html } from "./draw.js";
import { PRESETS, formulation_of, hold, ALL_TANGENTIAL, read_link, write_link } from "./state.js";
import { controls } from "./controls.js";
import { contact_view } from "./contact.js";
import { roll_view } from "./roll.js";
import { below_view } from "./below.js";
import { step_view } from "./step.js";
import { take_view } from "./take.js";
import { say, words } from "./words.js";

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

    const page = { given: { ...PRESETS.rail }, answer: null, curve: null, options: workers[0].options, results: workers[0].results,
        units: Object.fromEntries(workers[0].results.number.map((r) => [r.name, r.unit])) };
    let current = "contact", curve_key = null, first = true, panel = null;
    const makers = { contact: contact_view, roll: roll_view, below: below_view, step: step_view, take: take_view }, views = {}, asked = {};

    function take(answer, request, newer) {
        if (answer.refused) { if (!newer) { tell(say(words.refused, { why: answer.refused })); at("main").classList.add("stale"); first_draw(); } if (answer.kind === "guess") { at("main").classList.remove("stale"); tell(""); views.step?.take(answer); } return; }
        at("main").classList.remove("stale");
        if (answer.kind === "solve") {
            const before = page.answer;
            page.answer = answer;
            tell(answer.unsolved ? say(words.unsolved, { why: answer.unsolved }) : "");
            if (!before) first_draw();
            ask_curve();
            views.contact?.draw();
            if (current === "take") views.take.draw();
            if (current === "step") page.ask_view(); /* its strip is that of the solution */
        } else if (answer.kind === "curve") { page.curve = answer.points; if (current === "contact") views.contact?.draw(); }
        else Object.entries(makers).forEach(([name]) => { if (views[name]?.take && (asked[name] === answer.kind || (name === "step" && answer.kind === "guess"))) views[name].take(answer); });
    }
    const [solving, aside] = workers.map(({ worker }) => requests(worker, take));
    const queue = { ask: (request) => (request.kind === "solve" ? solving : aside).ask(request), idle: () => solving.idle() && aside.idle() };
    page.ask = queue.ask;

    function ask_curve() {
        if (formulation_of(page.given) !== "steady") { page.curve = null; curve_key = null; return; }
        const given = hold(page.given, ALL_TANGENTIAL, "creep-ratio", "0.5"), key = JSON.stringify(given);
        if (key === curve_key) return;
        curve_key = key;
        page.curve = null;
        queue.ask({ kind: "curve", given, from: -1.4, to: 1.4, points: 29 });
    }
    page.ask_view = () => (views[current]?.wants() ?? []).forEach((request) => { asked[current] = request.kind; queue.ask(request); });
    page.change = (given, redraw) => {
        page.given = given;
        queue.ask({ kind: "solve", given });
        if (current !== "step") page.ask_view();
        if (redraw) panel?.draw();
        clearTimeout(page.timer);
        page.timer = setTimeout(() => history.replaceState(null, "", write_link(page.given, current)), 250);
    };

    function open(name) {
        views[current]?.leave?.();
        current = name;
        views[name] ??= makers[name](words, page);
        at("main").replaceChildren(views[name].node);
        at("main").setAttribute("aria-labelledby", `tab-${name}`);
        for (const tab of at("tabs").children) { const on = tab.id === `tab-${name}`; tab.setAttribute("aria-selected", on); tab.tabIndex = on ? 0 : -1; }
        views[name].draw();
        page.ask_view();
        history.replaceState(null, "", write_link(page.given, current));
    }
    const names = Object.keys(makers);
    at("main").setAttribute("role", "tabpanel");
    at("tabs").setAttribute("aria-label", words.subtitle);
    at("tabs").append(...names.map((name, k) => html("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": "main", onclick: () => open(name),
        onkeydown: (event) => { const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key]; if (step) { const next = at(`tab-${names[(k + step + names.length) % names.length]}`); next.click(); next.focus(); } } }, words.tabs[name])));
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
            if (link) current = link.view;
        } catch (error) { tell(say(words.link_broken, { why: error.message })); return; }
        queue.ask({ kind: "solve", given: page.given });
        if (!first) { panel.draw(); open(current); }
    }
    window.addEventListener("hashchange", follow_link);
    let width = innerWidth;
    window.addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; views[current]?.draw(); } });
    window.rollbem = { page, views, queue, open, preset: (name) => { page.change({ ...PRESETS[name] }); panel.draw(); } };
    follow_link();
    if (location.hash.length > 1 && at("message").textContent) queue.ask({ kind: "solve", given: page.given });
}
main();
