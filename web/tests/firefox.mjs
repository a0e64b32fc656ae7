/* A headless Firefox at the other end of its Marionette port: what both browsers are asked, as in chromium.mjs. */
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

export async function open_in_firefox(url, { width = 1280, height = 900 } = {}) {
    const folder = mkdtempSync(join(tmpdir(), "firefox-"));
    const quiet = [
        "datareporting.policy.dataSubmissionEnabled",
        "app.update.enabled",
        "browser.safebrowsing.update.enabled",
        "extensions.update.enabled",
        "toolkit.telemetry.enabled",
    ];
    writeFileSync(
        join(folder, "user.js"),
        [
            ...quiet.map((name) => `user_pref("${name}", false);`),
            'user_pref("marionette.port", 0);',
            'user_pref("network.captive-portal-service.enabled", false);',
        ].join("\n"),
    );
    const browser = spawn("firefox-esr", ["--headless", "--no-remote", "--marionette", "--profile", folder], {
        stdio: "ignore",
        env: { ...process.env, MOZ_HEADLESS_WIDTH: String(width), MOZ_HEADLESS_HEIGHT: String(height) },
    });
    const port_file = join(folder, "MarionetteActivePort");
    for (
        const end = Date.now() + 60e3;
        !existsSync(port_file) || !readFileSync(port_file, "utf8").trim();
        await pause(50)
    )
        if (Date.now() > end) throw new Error("firefox does not answer");
    const socket = connect(Number(readFileSync(port_file, "utf8")), "127.0.0.1"),
        waiting = new Map();
    let rest = Buffer.alloc(0),
        last = 0;
    /* Messages are their length, a colon, and JSON: [1, id, error, result]. */
    socket.on("data", (chunk) => {
        rest = Buffer.concat([rest, chunk]);
        for (let colon = rest.indexOf(58); colon > 0; colon = rest.indexOf(58)) {
            const long = Number(rest.subarray(0, colon).toString());
            if (rest.length < colon + 1 + long) return;
            const message = JSON.parse(rest.subarray(colon + 1, colon + 1 + long).toString());
            rest = rest.subarray(colon + 1 + long);
            if (!Array.isArray(message)) continue;
            const [, id, error, result] = message,
                { resolve, reject } = waiting.get(id);
            waiting.delete(id);
            if (error) reject(new Error(error.message));
            else resolve(result);
        }
    });
    const send = (command, parameters = {}) =>
        new Promise((resolve, reject) => {
            const text = JSON.stringify([0, ++last, command, parameters]);
            waiting.set(last, { resolve, reject });
            socket.write(`${Buffer.byteLength(text)}:${text}`);
        });
    await send("WebDriver:NewSession", { capabilities: { alwaysMatch: {} } });
    await send("WebDriver:SetTimeouts", { script: 600e3, pageLoad: 60e3 });
    await send("WebDriver:SetWindowRect", { width, height });
    await send("WebDriver:Navigate", { url });
    /* Value of an expression, which may be a promise. */
    async function run(expression) {
        const script = `const done = arguments[arguments.length - 1]; (async () => (${expression}))().then((value) => done({ value }), (error) => done({ error: String((error && error.stack) || error) }));`;
        const { value } = await send("WebDriver:ExecuteAsyncScript", {
            script,
            args: [],
            sandbox: null,
            newSandbox: false,
        });
        if (value.error) throw new Error(value.error);
        return value.value;
    }
    async function until(expression, seconds = 60) {
        for (const end = Date.now() + 1000 * seconds; Date.now() < end; await pause(20))
            if (await run(expression).catch(() => false)) return;
        throw new Error(`not so after ${seconds} s: ${expression}`);
    }
    async function close() {
        const ended = new Promise((resolve) => browser.once("exit", resolve));
        await send("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => {});
        await Promise.race([ended, pause(10e3)]);
        browser.kill("SIGKILL");
        socket.destroy();
        rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
    }
    /* A pointer that presses at the first of these places [x, y], goes along the others and lets go; kind: mouse or touch.
     * between(k) after each. */
    async function drag(kind, places, between) {
        const go = (actions) =>
                send("WebDriver:PerformActions", {
                    actions: [{ type: "pointer", id: kind, parameters: { pointerType: kind }, actions }],
                }),
            to = ([x, y]) => ({ type: "pointerMove", x: Math.round(x), y: Math.round(y), duration: 0 });
        await go([to(places[0]), { type: "pointerDown", button: 0 }]);
        for (const [k, place] of places.entries()) {
            await go([to(place)]);
            await between?.(k);
        }
        await go([{ type: "pointerUp", button: 0 }]);
        await send("WebDriver:ReleaseActions", {});
    }
    return { run, until, close, drag };
}
