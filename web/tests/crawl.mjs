/* Through the page as nobody has the patience to: every choice of the panel of every first case, every slider at both
 * ends, every view.  Runs inside the page, in any browser; only what is in its arguments is known to it. */

/* stride: of all these states every so many are taken, beginning with `from`.  Returns { states, wrong: [text ...] }. */
export async function crawl({ stride, from, views, seconds }) {
    const wrong = [],
        { page, store } = rollbem;
    const turn = () =>
        new Promise((resolve) => {
            const channel = new MessageChannel();
            channel.port1.onmessage = resolve;
            channel.port2.postMessage(0);
        });
    async function rest(what) {
        for (const end = performance.now() + 60e3; ; await turn()) {
            if (performance.now() > end) {
                wrong.push(`${what}: no end`);
                return;
            }
            if (!rollbem.idle()) continue;
            await new Promise((resolve) => setTimeout(resolve, 5));
            if (rollbem.idle()) return;
        }
    }
    /* What is shown is what was solved, or grey with a line. */
    function inspect(what) {
        const text = document.querySelector("main").textContent,
            trouble = store.trouble("main");
        for (const odd of ["NaN", "undefined", "[object", "{"])
            if (text.includes(odd))
                wrong.push(
                    `${what}: shows ${odd} in ...${text.slice(Math.max(0, text.indexOf(odd) - 40), text.indexOf(odd) + 20)}`,
                );
        const message = document.getElementById("message"),
            { top, bottom } = message.getBoundingClientRect();
        if (trouble && (message.hidden || top < 0 || bottom > innerHeight))
            wrong.push(`${what}: not solved (${trouble}), and nobody says so where one looks`);
        if (trouble && !document.querySelector(".contact").classList.contains("stale") && rollbem.near("bench"))
            wrong.push(`${what}: not solved, and not grey`);
        for (const fault of rollbem.faults.splice(0)) wrong.push(`${what}: ${fault}`);
        if (trouble || !rollbem.near("bench") || !page.answer) return;
        const { given, values, numbers } = page.answer;
        for (const knob of document.querySelectorAll("#controls input[id^=knob-]")) {
            const name = knob.id.slice(5),
                want = given[name] ?? values[name];
            if (knob.value !== want) wrong.push(`${what}: ${name} shows ${knob.value}, solved with ${want}`);
        }
        for (const part of document.querySelectorAll("[data-number=half_width], [data-number=max_pressure]")) {
            const shown = Number(part.firstChild.textContent.replace("−", "-")),
                have = numbers[part.dataset.number];
            if (Number.isFinite(shown) && Math.abs(shown / have - 1) > 2e-3 && Math.abs(have) > 1e-3)
                wrong.push(`${what}: ${part.dataset.number} shows ${shown}, solved ${have}`);
        }
    }
    let count = 0,
        states = 0;
    const begun = performance.now(),
        mine = () => count++ % stride === from % stride,
        late = () => performance.now() - begun > 1000 * seconds;
    for (const preset of ["rail", "stiff", "addi", "roll"]) {
        const start = async () => {
            rollbem.open("bench");
            rollbem.preset(preset);
            await rest(preset);
        };
        await start();
        const radios = [
            ["", ""],
            ...[...document.querySelectorAll("#controls input[type=radio]")].map((r) => [r.name, r.value]),
        ];
        for (const [name, value] of radios) {
            const choose = () =>
                document.querySelector(`#controls input[name="${name}"][value="${value}"]:not(:checked)`)?.click();
            /* The sliders differ with the choice: as many as may be, those that are not there are left out. */
            for (let k = 0; k < 8; k++)
                for (const end of ["min", "max"])
                    for (const view of views) {
                        if (!mine()) continue;
                        if (late() && states) return { states, wrong };
                        await start();
                        choose();
                        await rest(`${preset} ${name} ${value}`);
                        const slider = document.querySelectorAll("#controls [data-knob]")[k];
                        if (!slider) continue;
                        const what = `${preset}, ${name} ${value}, ${slider.dataset.knob} at ${end}, ${view}`;
                        slider.value = slider[end];
                        slider.dispatchEvent(new Event("input"));
                        slider.dispatchEvent(new Event("change"));
                        await rest(what);
                        inspect(what);
                        rollbem.open(view);
                        await rest(what);
                        inspect(what);
                        states++;
                        /* No dead end: back where it began. */
                        history.back();
                        await new Promise((resolve) => setTimeout(resolve, 30));
                        await rest(what);
                        if (store.trouble("main") && !name)
                            wrong.push(`${what}: Back leads to ${store.trouble("main")}`);
                    }
        }
    }
    return { states, wrong };
}
