/* Three workers with the library: one solves the cases, which never wait for the curves, steps and stresses that the
 * second one is at; the third one is at derivatives, which take long for some bodies.  Of requests that wait the newest
 * of each slot is answered. */

async function start_worker(wasm, script) {
    return new Promise((resolve, reject) => {
        const worker = new Worker(script);
        worker.onmessage = ({ data }) => resolve({ worker, ...data });
        worker.onerror = (event) => reject(new Error(event.message));
        worker.postMessage({ wasm });
    });
}

const LONG = 300; /* ms after which an older question is given up for a newer one */

/* One request at work at a time.  take(answer, request, newer): newer, another one of its slot waits. */
function line_up(wasm, script, take, impatient = false) {
    const waiting = new Map();
    let worker = null,
        busy = null,
        since = 0,
        last = 0,
        begun = false;
    const begin = async () => {
        begun = true;
        const started = await start_worker(wasm, script);
        worker = started.worker;
        worker.onmessage = ({ data }) => {
            const request = busy;
            busy = null;
            take(data, request, waiting.has(request.slot));
            next();
        };
        next();
        return started;
    };
    function next() {
        if (!worker || busy || !waiting.size) return;
        const [slot, request] = waiting.entries().next().value;
        waiting.delete(slot);
        busy = request;
        since = performance.now();
        worker.postMessage(request);
    }
    function end_worker() {
        worker.terminate();
        worker = busy = null;
        return begin();
    }
    return {
        begin,
        ask(request) {
            waiting.delete(request.slot);
            waiting.set(request.slot, { ...request, id: ++last });
            if (!begun) begin();
            /* Nobody waits for the answer to an older question. */
            if (impatient && busy?.slot === request.slot && performance.now() - since > LONG) end_worker().then(next);
            else next();
        },
        idle: () => !busy && !waiting.size,
        waits: (slot) => busy?.slot === slot || waiting.has(slot),
        working: () => (busy ? performance.now() - since : 0),
        /* What is at work is ended with its worker; what waits is forgotten. */
        async cancel(why) {
            if (!busy) return;
            const request = busy;
            waiting.clear();
            const begun = end_worker();
            take({ id: request.id, kind: request.kind, refused: why }, request, false);
            await begun;
        },
    };
}

/* What a string within a script may hold, in the order of its values: no quote, no backslash, no "<". */
export const DIGITS = Array.from({ length: 87 }, (_, k) => String.fromCharCode(35 + k))
    .filter((c) => !"<\\".includes(c))
    .join("");

/* Of the text that web/build.mjs makes of bytes. */
export function bytes_of(text) {
    const value = new Uint8Array(128),
        none = Number(text[0]),
        out = new Uint8Array(((text.length - 1) / 5) * 4),
        view = new DataView(out.buffer);
    [...DIGITS].forEach((c, k) => {
        value[c.charCodeAt(0)] = k;
    });
    for (let at = 0, k = 1; k < text.length; at += 4) {
        let four = 0;
        for (let j = 0; j < 5; j++) four = 85 * four + value[text.charCodeAt(k++)];
        view.setUint32(at, four);
    }
    return out.subarray(0, out.length - none);
}

/* packed: the library, gzip as text. */
export async function start_solver(packed, worker_source, take) {
    const wasm = await new Response(
        new Blob([bytes_of(packed)]).stream().pipeThrough(new DecompressionStream("gzip")),
    ).arrayBuffer();
    const script = URL.createObjectURL(new Blob([worker_source], { type: "text/javascript" }));
    const lines = [line_up(wasm, script, take), line_up(wasm, script, take), line_up(wasm, script, take, true)];
    const { options, results } = await lines[0].begin();
    lines[1].begin(); /* the third one when it is asked */
    const line_of = ({ kind }) => lines[kind === "solve" ? 0 : kind === "derivatives" ? 2 : 1];
    return {
        options,
        results,
        ask: (request) => line_of(request).ask(request),
        idle: () => lines.every((line) => line.idle()),
        waits: (slot) => lines.some((line) => line.waits(slot)),
        working: () => Math.max(...lines.map((line) => line.working())),
        cancel: (why) => Promise.all(lines.map((line) => line.cancel(why))),
    };
}
