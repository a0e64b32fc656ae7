/* rollbem/api.h in JavaScript: the library as WebAssembly, with numbers, text and arrays. */

const NO_SUCH_FILE = 44, BAD_DESCRIPTOR = 8;

/* What the C library asks of a system: a clock; there are no files. */
function system_calls(module, memory) {
    const view = () => new DataView(memory().buffer);
    const known = {
        clock_time_get: (id, precision, at) => {
            view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
            return 0;
        },
        path_open: () => NO_SUCH_FILE,
        proc_exit: (code) => { throw new Error(`the library ended with ${code}`); },
    };
    const calls = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module))
        (calls[from] ??= {})[name] = known[name] ?? (() => BAD_DESCRIPTOR);
    return calls;
}

export async function load_library(bytes) {
    const module = await WebAssembly.compile(bytes);
    let c;
    const instance = await WebAssembly.instantiate(module, system_calls(module, () => c.memory));
    c = instance.exports;
    c._initialize?.();
    const room = c.malloc(4096), counts = c.malloc(8);

    function with_text(words, call) {
        const at = words.map((word) => {
            const utf8 = new TextEncoder().encode(word);
            const place = c.malloc(utf8.length + 1);
            new Uint8Array(c.memory.buffer).set([...utf8, 0], place);
            return place;
        });
        const result = call(...at);
        at.forEach((place) => c.free(place));
        return result;
    }
    function text_at(place) {
        if (!place) return null;
        const all = new Uint8Array(c.memory.buffer);
        return new TextDecoder().decode(all.subarray(place, all.indexOf(0, place)));
    }

    class Case {
        constructor() { this.at = c.rb_api_create(); }
        free() { c.rb_api_free(this.at); }
        set(name, text) { return with_text([name, String(text)], (n, t) => c.rb_api_set(this.at, n, t)); }
        settle() { return c.rb_api_settle(this.at); }
        solve() { return c.rb_api_solve(this.at); }
        curve(from, to, points) { return c.rb_api_curve(this.at, from, to, points); }
        pivots() { return c.rb_api_pivots(this.at); }
        stress(nx, ny, depth) { return c.rb_api_stress(this.at, nx, ny, depth); }
        guess(zones) {
            const at = c.malloc(4 * zones.length);
            new Int32Array(c.memory.buffer).set(zones, at / 4);
            const status = c.rb_api_guess(this.at, zones.length, at);
            c.free(at);
            return status;
        }
        get message() { return text_at(c.rb_api_message(this.at)); }
        number(name) { return with_text([name], (n) => c.rb_api_number(this.at, n)); }
        value(name) { return with_text([name], (n) => text_at(c.rb_api_value(this.at, n, room, 4096))); }
        variable(k) { return text_at(c.rb_api_variable(this.at, k, room, 4096)); }
        /* { rows, columns, at: Float64Array } of its own, or null. */
        array(name) {
            const place = with_text([name], (n) => c.rb_api_array(this.at, n, counts, counts + 4));
            if (!place) return null;
            const [rows, columns] = new Int32Array(c.memory.buffer, counts, 2);
            return { rows, columns, at: new Float64Array(c.memory.buffer, place, rows * columns).slice() };
        }
    }

    function rows_of(fields, call) {
        const rows = [];
        for (let k = 0; call(k, "name") !== null; k++)
            rows.push(Object.fromEntries(fields.map((field) => [field, call(k, field)])));
        return rows;
    }
    const options = rows_of(
        ["name", "section", "kind", "unit", "expected", "from", "to", "choices", "word", "default", "excludes", "help"],
        (k, field) => with_text([field], (f) => text_at(c.rb_api_option(k, f, room, 4096))));
    const results = Object.fromEntries(["number", "column", "step", "point"].map((table) => [table,
        rows_of(["name", "unit", "kind", "meaning"],
            (k, field) => with_text([table, field], (t, f) => text_at(c.rb_api_result(t, k, f, room, 4096))))]));
    return { Case, options, results };
}
