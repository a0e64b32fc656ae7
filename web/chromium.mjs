/* A headless Chromium at the other end of its debugging pipe. */
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/* The shell without a desktop's browser around it starts and draws in less time; null: neither is here. */
export const CHROMIUM =
    ["chromium-headless-shell", "chromium"].find((name) => spawnSync(name, ["--version"]).status === 0) ?? null;

/* One browser for all pages of a run; every page has cookies, storage and size of its own. */
let running = null;

function start() {
    const folder = mkdtempSync(join(tmpdir(), "page-"));
    const browser = spawn(
        CHROMIUM,
        [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-background-networking",
            "--no-first-run",
            `--user-data-dir=${folder}`,
            "--remote-debugging-pipe",
            "about:blank",
        ],
        { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] },
    );
    const [to, from] = [browser.stdio[3], browser.stdio[4]],
        waiting = new Map(),
        pages = new Map();
    let last = 0,
        rest = "";
    from.on("data", (chunk) => {
        const lines = (rest + chunk).split("\0");
        rest = lines.pop();
        for (const text of lines) {
            const { id, result, error, method, params, sessionId } = JSON.parse(text);
            if (id) {
                const { resolve, reject } = waiting.get(id);
                waiting.delete(id);
                error ? reject(new Error(error.message)) : resolve(result);
            }
            const page = pages.get(sessionId);
            if (!page) continue;
            if (method === "Runtime.exceptionThrown")
                page.errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
            if (method === "Log.entryAdded" && params.entry.level === "error") page.errors.push(params.entry.text);
            if (method === "Network.requestWillBeSent") page.requested.push(params.request.url);
        }
    });
    const send = (method, params = {}, sessionId) =>
        new Promise((resolve, reject) => {
            waiting.set(++last, { resolve, reject });
            to.write(JSON.stringify({ id: last, method, params, sessionId }) + "\0");
        });
    return { browser, folder, pages, send };
}

export async function close_browser() {
    if (!running) return;
    const { browser, folder, send } = running;
    running = null;
    const ended = new Promise((resolve) => browser.once("exit", resolve));
    await send("Browser.close").catch(() => {});
    await ended;
    rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
}

export async function open_page(url, { width = 1280, height = 900, dark = false, mobile = false } = {}) {
    running ??= start();
    const { pages, send } = running,
        errors = [],
        requested = [];
    const { browserContextId } = await send("Target.createBrowserContext");
    const { targetId } = await send("Target.createTarget", { url: "about:blank", browserContextId });
    const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
    pages.set(sessionId, { errors, requested });
    const tab = (method, params) => send(method, params, sessionId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await tab(`${domain}.enable`);
    /* as if it were in front: a page behind another one does not hear that a field has the focus */
    await tab("Emulation.setFocusEmulationEnabled", { enabled: true });
    const size = (w, h, is_dark = false, is_mobile = false) =>
        Promise.all([
            tab("Emulation.setDeviceMetricsOverride", { width: w, height: h, deviceScaleFactor: 1, mobile: is_mobile }),
            tab("Emulation.setEmulatedMedia", {
                features: [{ name: "prefers-color-scheme", value: is_dark ? "dark" : "light" }],
            }),
        ]);
    await size(width, height, dark, mobile);
    await tab("Page.navigate", { url });
    /* Value of an expression, which may be a promise. */
    async function run(expression) {
        const { result, exceptionDetails } = await tab("Runtime.evaluate", {
            expression,
            awaitPromise: true,
            returnByValue: true,
        });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }
    async function until(expression, seconds = 30) {
        for (
            const end = Date.now() + 1000 * seconds;
            Date.now() < end;
            await new Promise((resolve) => setTimeout(resolve, 10))
        )
            if (await run(expression).catch(() => false)) return;
        throw new Error(`not so after ${seconds} s: ${expression}`);
    }
    async function close() {
        pages.delete(sessionId);
        await send("Target.disposeBrowserContext", { browserContextId });
    }
    async function picture(full = true) {
        const {
            cssContentSize: { width: w, height: h },
        } = await tab("Page.getLayoutMetrics");
        const { data } = await tab("Page.captureScreenshot", {
            format: "png",
            captureBeyondViewport: full,
            ...(full && { clip: { x: 0, y: 0, width: w, height: Math.min(h, 4000), scale: 1 } }),
        });
        return Buffer.from(data, "base64");
    }
    return { run, until, close, picture, size, errors, requested, tab };
}
