import { crawl } from "./crawl.mjs";
import { check, check_close, FITTED, flatten, run, test, words_of } from "./suite.mjs";

/* A part of all choices, sliders' ends and views; all of them with ROLLBEM_TEST_ALL. */
export async function crawled(browser, page) {
    const all = Boolean(process.env.ROLLBEM_TEST_ALL);
    await test(`crawled: choices, sliders' ends, views in ${browser}`, async () => {
        const { states, wrong } = await page.run(
            `(${crawl})(${JSON.stringify({ stride: all ? 1 : 331, from: 5, views: VIEWS, seconds: all ? 5000 : 3 })})`,
        );
        check(states >= 1, `${states} states`);
        check(!wrong.length, `${wrong.length} of ${states} states: ${wrong.slice(0, 8).join("; ")}`);
        console.log(`         ${states} states in ${browser}`);
    });
}

export const IDLE = "window.rollbem && rollbem.page.answer && rollbem.idle()";
export const VIEWS = ["hero", "press", "brake", "soft", "below", "step", "crack", "roll", "bench"];
/* The page in a browser, and what its tests ask of it. */
export function visit(page) {
    const number = (name) => page.run(`rollbem.page.answer.numbers.${name}`);
    /* The numbers that the page holds, and those that it shows, against a run of the program. */
    async function same_as_the_program() {
        await page.run("rollbem.open('bench')");
        await settled();
        const { given, numbers, shown } = await page.run(
            "({ given: rollbem.page.given, numbers: rollbem.page.answer.numbers, shown: Object.fromEntries([...document.querySelectorAll('[data-number]')].map((e) => [e.dataset.number, e.firstChild.textContent])) })",
        );
        const want = flatten({ ...JSON.parse(run(["--json", "--quiet", ...words_of(given)]).stdout), inputs: null });
        for (const name of ["normal_load", "tangential_load", "max_pressure", "approach", "half_width"]) {
            check_close(
                numbers[name],
                want[name],
                FITTED * Math.max(Math.abs(want[name]), /load/.test(name) ? want.normal_load : 0),
                name,
            );
            if (Math.abs(want[name]) > 1 && want[name] < 1e5)
                check(
                    shown[name].replace("−", "-") === String(Number(want[name].toPrecision(4))),
                    `${name} shown: ${shown[name]}, the program has ${want[name]}`,
                );
        }
    }
    /* Events are taken, a frame is drawn, and nothing is left to solve. */
    const settled = async () => {
        await page.run("new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)))");
        await page.until(IDLE);
    };
    const text_of = (selector) => page.run(`document.querySelector(${JSON.stringify(selector)})?.textContent ?? ""`);
    /* One event of a hand that holds the left button, or lets it go. */
    const mouse = (type, x, y) =>
        page.tab("Input.dispatchMouseEvent", {
            type,
            x,
            y,
            button: "left",
            buttons: type === "mouseReleased" ? 0 : 1,
            clickCount: 1,
        });
    return { page, number, settled, same_as_the_program, text_of, mouse };
}
