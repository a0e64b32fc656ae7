/* The page: the store, the solver, the chapters one below the other, links and files. */
import { html } from "./draw.js";
import { make_store } from "./store.js";
import { start_solver } from "./solver.js";
import { make_knob } from "./knob.js";
import { PRESETS, read_case_file, read_link, with_mu, write_link } from "./state.js";
import { hero_view } from "./hero.js";
import { CHAPTER_CASES, brake_view, press_view, soft_view } from "./chapters.js";
import { roll_view } from "./roll.js";
import { below_view } from "./below.js";
import { step_view } from "./step.js";
import { CRACK_CASE, crack_request, crack_view } from "./crack.js";
import { bench_view } from "./bench.js";
import { make_classroom } from "./classroom.js";
import { take_along } from "./take.js";
import { fill_in, words } from "./words.js";

const at = (id) => document.getElementById(id);

/* In the order of the page. */
const CHAPTERS = [
    ["hero", hero_view],
    ["press", press_view],
    ["brake", brake_view],
    ["roll", roll_view],
    ["soft", soft_view],
    ["below", below_view],
    ["crack", crack_view],
    ["step", step_view],
    ["bench", bench_view],
];
/* Cases that the library is asked for in another way than to solve them. */
const REQUESTS = { crack: crack_request };
/* The words of links of earlier pages. */
const VIEWS_OF_LINKS = { contact: "bench", take: "bench" };

/* What went wrong where nobody catches it; for the page's tests. */
const faults = [];
window.addEventListener("error", (event) => faults.push(event.error?.stack ?? event.message));
window.addEventListener("unhandledrejection", (event) => faults.push(event.reason?.stack ?? String(event.reason)));

async function main() {
    at("footer").textContent = fill_in(words.footer, { version: VERSION });
    at("headline-before").textContent = words.loading;
    const views = {},
        near = new Set(),
        stale = new Set();
    let solver = null,
        current = "hero",
        drawing = false,
        embed = false,
        lesson = false,
        classroom = null,
        link_given = null,
        link_note = "";

    const address = (state) => write_link(state.cases.main, current, state.drawn, embed);
    const store = make_store(
        {
            cases: {
                main: JSON.parse(at("carried").textContent) ?? { ...PRESETS.rail },
                ...CHAPTER_CASES,
                crack: CRACK_CASE,
            },
            drawn: null,
        },
        {
            link: address,
            changed: solve_cases,
            restored: () => ask_views(() => true),
            shown: draw_soon,
            released: () => ask_views((view) => view.fine),
        },
    );
    const opened_with = store.state;

    const page = {
        store,
        words,
        get given() {
            return store.case("main");
        },
        get answer() {
            return store.solved.main ?? null;
        },
        /* Whether the first case is the reader's own, of a link or carried by the page. */
        linked: JSON.parse(at("carried").textContent) !== null,
        get drawn() {
            return store.state.drawn;
        },
        set drawn(value) {
            store.set_drawn(value);
        },
        change(given) {
            link_note = "";
            store.set("main", given);
        },
        with_mu: (given, mu) => with_mu(given, mu, store.solved.main?.numbers),
        knob: (of) => make_knob(store, of),
        ask: (request) => solver.ask(request),
        ask_view: (name) => ask_views((view) => view === views[name]),
        large: () => document.documentElement.classList.contains("large"),
        show_message,
        open_file,
        open,
        history_buttons: () =>
            html(
                "span",
                { class: "row history" },
                ...[
                    ["undo", "↶", () => store.undo()],
                    ["redo", "↷", () => store.redo()],
                    ["reset", "⟲", () => store.reset(opened_with)],
                ].map(([name, sign, act]) =>
                    html(
                        "button",
                        {
                            type: "button",
                            class: "button sign",
                            "data-history": name,
                            "aria-label": words.history[name],
                            title: words.history[name],
                            onclick: act,
                        },
                        sign,
                    ),
                ),
            ),
    };
    page.take_along = (...of) => take_along(page, ...of);

    /* ---- Solving ---- */

    const request_of = (name) => ({
        kind: "solve",
        given: store.case(name),
        ...REQUESTS[name]?.(store.case(name), store.holding),
        slot: `solve ${name}`,
        case: name,
    });
    function solve_cases(names) {
        if (!solver) return;
        for (const name of names)
            if (name === "main" || Object.values(views).some((view) => near.has(view) && view.uses.includes(name)))
                solver.ask(request_of(name));
            else stale.add(name);
        ask_views((view) => view.uses.some((name) => names.includes(name)));
        store.rewrite();
    }
    /* What views want beside the solution, of those that can be seen; the others when they come near. */
    function ask_views(which) {
        if (!solver) return;
        for (const [name, view] of Object.entries(views)) {
            if (!which(view)) continue;
            if (!near.has(view)) {
                stale.add(view);
                continue;
            }
            stale.delete(view);
            for (const request of view.wants?.() ?? [])
                solver.ask({ slot: `${request.kind} ${name}`, ...request, view: name });
        }
    }
    function come_near(view) {
        near.add(view);
        const cases = view.uses.filter((name) => stale.has(name) || !store.answers[name]);
        cases.forEach((name) => stale.delete(name));
        if (solver) for (const name of cases) if (!solver.waits(`solve ${name}`)) solver.ask(request_of(name));
        if (stale.has(view)) ask_views((other) => other === view);
        draw_soon();
    }
    function take(answer, request, newer) {
        if (answer.broken) faults.push(answer.refused);
        if (!request.case) return views[request.view]?.take(answer, request);
        if (answer.refused && newer) return;
        if (request.case === "main" && request.given === link_given && answer.refused) {
            /* A link whose case the library refuses opens the first case, with a note. */
            link_note = fill_in(words.link_refused, { why: answer.refused });
            store.replace({ ...store.state, cases: { ...store.state.cases, main: { ...PRESETS.rail } } });
            return;
        }
        store.answer(request.case, { ...answer, given: request.given, coarse: request.coarse });
        if (request.case === "main")
            show_message(
                answer.refused
                    ? fill_in(words.refused, { why: answer.refused })
                    : answer.unsolved
                      ? fill_in(words.unsolved, { why: answer.unsolved })
                      : link_note,
            );
        for (const view of near) if (view.uses.includes(request.case)) view.solved?.(request.case);
    }

    /* ---- Drawing: once a frame, what can be seen ---- */

    function draw_soon() {
        if (drawing) return;
        drawing = true;
        requestAnimationFrame(draw_now);
    }
    function draw_now() {
        drawing = false;
        for (const view of near) {
            view.render();
            /* What was never seen has no picture, and is not printed. */
            if (view.uses.every((name) => store.answers[name])) view.section.classList.add("drawn");
        }
        for (const button of document.querySelectorAll("[data-history]")) {
            const can = { undo: store.can_undo, redo: store.can_redo, reset: true }[button.dataset.history];
            button.setAttribute("aria-disabled", String(!can));
        }
    }
    function show_message(text) {
        at("message").textContent = text;
        at("message").hidden = !text;
    }

    /* ---- The chapters ---- */

    function build(name, make) {
        const view = (views[name] = make(words, page)),
            { title, number, join } = words.chapters[name];
        const node = html(
            "section",
            { id: `at-${name}`, class: `chapter ${name}`, "aria-label": title, tabindex: -1 },
            name !== "hero" && html("h2", {}, number && html("span", { class: "count" }, number), title),
            join && html("p", { class: "join" }, join),
            view.node,
        );
        at("story").append(node);
        view.section = node;
        stale.add(view);
        at("chapters").append(
            html(
                "a",
                {
                    href: `#at-${name}`,
                    "data-view": name,
                    onclick: (event) => {
                        event.preventDefault();
                        open(name);
                    },
                },
                html("span", { class: "number", "aria-hidden": "true" }, number),
                words.chapters[name].short,
            ),
        );
        nearness.observe(node);
        place.observe(node);
    }
    const nearness = new IntersectionObserver(
        (entries) => {
            for (const { target, isIntersecting } of entries) {
                const view = Object.values(views).find((other) => other.section === target);
                if (isIntersecting) {
                    if (!near.has(view)) come_near(view);
                } else {
                    near.delete(view);
                    view.leave?.();
                }
            }
        },
        { rootMargin: "250px 0px" },
    );
    /* The chapter in the middle of the window is the one of the links; of two that meet there the lower one.  A chapter
     * above may grow into the middle and leave it again while the lower one stays: so the set is kept. */
    const middle = new Set();
    const place = new IntersectionObserver(
        (entries) => {
            for (const { target, isIntersecting } of entries) {
                if (isIntersecting) middle.add(target);
                else middle.delete(target);
            }
            const lowest = Object.values(views)
                .filter(({ section }) => middle.has(section))
                .at(-1);
            if (!lowest) return;
            current = lowest.section.id.slice(3);
            for (const link of at("chapters").children)
                link.setAttribute("aria-current", link.dataset.view === current ? "true" : "false");
            const here = at("chapters").querySelector("[aria-current=true]");
            if (here) at("chapters").scrollTo({ left: here.offsetLeft - 40 });
            store.rewrite();
        },
        { rootMargin: "-45% 0px -50% 0px" },
    );
    /* What is above a chapter may grow while it is solved: the chapter stays where it was opened, unless the reader
     * has moved on. */
    let opening = null;
    async function stay_at(view) {
        opening = view;
        await until(() => opening !== view || (solver.idle() && !drawing));
        if (opening === view) view.section.scrollIntoView({ block: "start" });
        if (opening === view) opening = null;
    }
    for (const moved of ["wheel", "touchmove", "pointerdown", "keydown"])
        window.addEventListener(
            moved,
            () => {
                opening = null;
            },
            { passive: true },
        );
    function open(name) {
        const view = views[VIEWS_OF_LINKS[name] ?? name] ?? views.hero;
        view.section.scrollIntoView({ block: "start" });
        view.section.focus({ preventScroll: true });
        come_near(view);
        view.show?.(name);
        current = name in words.chapters ? name : current;
        stay_at(view);
    }

    /* ---- Links, files, keys ---- */

    const names = [...CHAPTERS.map(([name]) => name), ...Object.keys(VIEWS_OF_LINKS)];
    function follow_link() {
        let link = null;
        try {
            link = read_link(location.hash, names);
        } catch (error) {
            link_note = fill_in(words.link_broken, { why: error.message });
            show_message(link_note);
        }
        if (!link) return false;
        embed = link.embed || embed;
        lesson = link.lesson || lesson;
        document.documentElement.classList.toggle("embed", Boolean(embed));
        document.documentElement.classList.toggle("lens", embed === "lens");
        link_note = "";
        link_given = link.given;
        page.linked ||= link.given !== null;
        current = link.view;
        store.replace({
            ...store.state,
            cases: { ...store.state.cases, ...(link.given && { main: link.given }) },
            drawn: link.drawn,
        });
        return true;
    }
    async function open_file(file) {
        try {
            page.change(read_case_file(await file.text()));
        } catch (error) {
            show_message(fill_in(words.file_broken, { file: file.name, why: error.message }));
        }
    }
    window.addEventListener("dragover", (event) => event.preventDefault());
    window.addEventListener("drop", (event) => {
        event.preventDefault();
        if (event.dataTransfer.files[0]) open_file(event.dataTransfer.files[0]);
    });
    window.addEventListener("keydown", (event) => {
        const typing = event.target.matches?.("input[type=text], textarea");
        if (!(event.ctrlKey || event.metaKey) || typing) return;
        if (event.key === "z" && !event.shiftKey) {
            event.preventDefault();
            store.undo();
        }
        if (event.key === "y" || (event.key === "z" && event.shiftKey) || event.key === "Z") {
            event.preventDefault();
            store.redo();
        }
    });
    let width = innerWidth;
    window.addEventListener("resize", () => {
        if (innerWidth === width && !document.fullscreenElement) return;
        width = innerWidth;
        for (const view of Object.values(views)) view.resize?.();
        draw_soon();
    });
    document.addEventListener("fullscreenchange", () => {
        document.documentElement.classList.toggle("large", Boolean(document.fullscreenElement || classroom?.place()));
        for (const view of Object.values(views)) view.resize?.();
        draw_soon();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw_soon);
    at("full").setAttribute("aria-label", words.full_screen);
    at("full").title = words.full_screen;
    at("full").addEventListener("click", () =>
        document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.(),
    );
    at("class").setAttribute("aria-label", words.classroom.open);
    at("class").title = words.classroom.open;
    at("class").addEventListener("click", () => classroom?.start(current));
    at("chapters").setAttribute("aria-label", words.chapters_label);
    at("signs").setAttribute("aria-label", words.signs);
    at("signs").append(
        html("button", { type: "button", class: "button", onclick: () => at("signs").close() }, words.close),
    );
    at("skip").textContent = words.skip;
    at("skip").addEventListener("click", (event) => {
        event.preventDefault();
        open("bench");
    });

    /* ---- What takes long says so ---- */

    at("busy").append(
        html("span", {}, words.solving),
        html(
            "button",
            { type: "button", class: "button", onclick: () => solver.cancel(words.cancelled) },
            words.cancel,
        ),
    );
    setInterval(() => {
        at("busy").hidden = !(solver?.working() > 600);
    }, 200);

    /* ---- Begin ---- */

    const linked = follow_link();
    try {
        solver = await start_solver(WASM, WORKER, take);
    } catch (error) {
        return show_message(fill_in(words.no_wasm, { why: error.message }));
    }
    Object.assign(page, {
        options: solver.options,
        results: solver.results,
        units: Object.fromEntries(solver.results.number.map((row) => [row.name, row.unit])),
    });
    at("headline-before").remove();
    solver.ask(request_of("main"));
    const begin = linked ? current : "hero";
    for (const [name, make] of embed ? CHAPTERS.slice(0, 1) : CHAPTERS) build(name, make);
    near.add(views.hero);
    if (!embed)
        classroom = make_classroom(words, page, {
            views,
            store,
            current: () => current,
            /* The only chapter in the window, or one of all again. */
            show(name) {
                current = name;
                for (const view of Object.values(views)) view.resize?.();
                come_near(views[name]);
                views[name].section.scrollIntoView({ block: "start" });
                store.rewrite();
            },
            near: (name) => come_near(views[name]),
            idle: async () => {
                await new Promise((resolve) => setTimeout(resolve, 60)); /* what was begun has been asked */
                await until(idle);
            },
        });
    store.listen(() => {
        if (follow_link()) open(current);
        else store.replace(opened_with);
    });
    await until(() => store.solved.main);
    store.rewrite();
    if (begin !== "hero" && !lesson) open(begin);

    const idle = () =>
        solver.idle() &&
        !drawing &&
        !opening &&
        !store.holding &&
        !Object.values(views).some((view) => near.has(view) && view.busy?.());
    window.rollbem = {
        page,
        store,
        faults,
        views,
        solver,
        open,
        idle,
        time_moves,
        near: (name) => near.has(views[name]),
        classroom,
        preset: (name) => page.change({ ...PRESETS[name] }),
    };

    if (lesson === "slides") classroom?.start(begin);
    if (lesson === "sheet") classroom?.sheet();

    /* For its tests: milliseconds from a move to its picture, sorted; each move is a value of its own. */
    async function time_moves(option, start, count) {
        const times = [],
            channel = new MessageChannel(),
            turn = () =>
                new Promise((resolve) => {
                    channel.port1.onmessage = resolve;
                    channel.port2.postMessage(0);
                });
        store.hold(); /* as a hand that moves a slider */
        for (let k = 1; k <= count; k++) {
            const began = performance.now(),
                before = page.answer;
            page.change({ ...page.given, [option]: String(Number((start * (1 + 0.002 * k)).toPrecision(6))) });
            while (page.answer === before) await turn();
            draw_now();
            document.body.getBoundingClientRect(); /* laid out */
            times.push(performance.now() - began);
        }
        store.release();
        return times.sort((a, b) => a - b);
    }
}

const until = (holds) =>
    new Promise((resolve) => {
        const poll = () => (holds() ? resolve() : setTimeout(poll, 8));
        poll();
    });
main();
