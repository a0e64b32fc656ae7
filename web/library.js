/* rollbem/api.h in JavaScript: the library as WebAssembly, with numbers, text and arrays. */

const NO_SUCH_FILE = 44,
    BAD_DESCRIPTOR = 8;

/* What the C library asks of a system: a clock, and the files that the page hands it, by name in
 * a folder of their own. */
function system_calls(module, memory, files) {
    const FOLDER = 3,
        OPENED = 4,
        NOT_SUPPORTED = 58,
        REGULAR = 4,
        DIRECTORY = 3;
    const view = () => new DataView(memory().buffer),
        bytes = () => new Uint8Array(memory().buffer);
    const text = (at, length) => new TextDecoder().decode(bytes().subarray(at, at + length));
    const opened = [];
    const file = (fd) => opened[fd - OPENED];
    const known = {
        clock_time_get: (_id, _precision, at) => {
            view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
            return 0;
        },
        environ_sizes_get: (count, size) => {
            view().setUint32(count, 0, true);
            view().setUint32(size, 0, true);
            return 0;
        },
        environ_get: () => 0,
        fd_prestat_get: (fd, at) => {
            if (fd !== FOLDER) return BAD_DESCRIPTOR;
            view().setUint32(at, 0, true);
            view().setUint32(at + 4, 1, true);
            return 0;
        },
        fd_prestat_dir_name: (_fd, at) => {
            bytes()[at] = "/".charCodeAt(0);
            return 0;
        },
        fd_fdstat_get: (fd, at) => {
            if (fd !== FOLDER && !file(fd)) return BAD_DESCRIPTOR;
            view().setUint32(at, fd === FOLDER ? DIRECTORY : REGULAR, true);
            view().setUint32(at + 4, 0, true);
            view().setBigUint64(at + 8, 0xffffffffn, true);
            view().setBigUint64(at + 16, 0xffffffffn, true);
            return 0;
        },
        fd_filestat_get: (fd, at) => {
            if (!file(fd)) return BAD_DESCRIPTOR;
            bytes().fill(0, at, at + 64);
            bytes()[at + 16] = REGULAR;
            view().setBigUint64(at + 32, BigInt(file(fd).all.length), true);
            return 0;
        },
        path_open: (_fd, _how, path, length, _flags, _rights, _inherited, _more, at) => {
            const all = files.get(text(path, length));
            if (!all) return NO_SUCH_FILE;
            view().setUint32(at, OPENED + opened.push({ all, at: 0 }) - 1, true);
            return 0;
        },
        fd_read: (fd, vectors, count, at) => {
            const from = file(fd),
                start = from?.at;
            if (!from) return BAD_DESCRIPTOR;
            for (let k = 0; k < count; k++) {
                const part = from.all.subarray(from.at, from.at + view().getUint32(vectors + 8 * k + 4, true));
                bytes().set(part, view().getUint32(vectors + 8 * k, true));
                from.at += part.length;
            }
            view().setUint32(at, from.at - start, true);
            return 0;
        },
        fd_seek: (fd, offset, whence, at) => {
            const from = file(fd);
            if (!from) return NOT_SUPPORTED;
            from.at = Number(offset) + [0, from.at, from.all.length][whence];
            view().setBigUint64(at, BigInt(from.at), true);
            return 0;
        },
        fd_close: (fd) => {
            delete opened[fd - OPENED];
            while (opened.length && !opened.at(-1)) opened.pop();
            return 0;
        },
        proc_exit: (code) => {
            throw new Error(`the library ended with ${code}`);
        },
    };
    const calls = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module))
        (calls[from] ??= {})[name] = known[name] ?? (() => BAD_DESCRIPTOR);
    return calls;
}

export async function load_library(bytes) {
    const module = await WebAssembly.compile(bytes),
        files = new Map();
    let c = null;
    const instance = await WebAssembly.instantiate(
        module,
        system_calls(module, () => c.memory, files),
    );
    c = instance.exports;
    c._initialize?.();
    const room = c.malloc(4096),
        counts = c.malloc(8);

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
        /* For the purpose of a command, which decides what is refused and some defaults. */
        constructor(purpose = "solve") {
            this.at = with_text([purpose], (p) => c.rb_api_create_for(p));
        }
        free() {
            c.rb_api_free(this.at);
        }
        set(name, text) {
            return with_text([name, String(text)], (n, t) => c.rb_api_set(this.at, n, t));
        }
        resolve() {
            return c.rb_api_resolve(this.at);
        }
        solve() {
            return c.rb_api_solve(this.at);
        }
        curve(from, to, points) {
            return with_text(["creep-ratio"], (over) => c.rb_api_curve(this.at, over, from, to, points, 0, 0));
        }
        prove() {
            return c.rb_api_prove(this.at);
        }
        newton() {
            return c.rb_api_newton(this.at);
        }
        pivots() {
            return c.rb_api_pivots(this.at);
        }
        derivatives() {
            return c.rb_api_derivatives(this.at);
        }
        /* Standard deviations of the results from those of inputs: "mu=0.02,radius=1%". */
        tolerances(inputs) {
            return with_text([inputs], (text) => c.rb_api_tolerances(this.at, text));
        }
        /* Input k of the derivatives: { name, unit, refusal }, or null. */
        input(k) {
            const field = (name) => with_text([name], (f) => text_at(c.rb_api_input(this.at, k, f, room, 4096)));
            const name = field("name");
            return name === null ? null : { name, unit: field("unit"), refusal: field("refusal") };
        }
        /* Passes the contact over a crack with these options. */
        crack(options) {
            const names = Object.keys(options),
                list = c.malloc(8 * names.length + 8);
            const status = with_text([...names, ...names.map((name) => String(options[name]))], (...at) => {
                new Uint32Array(c.memory.buffer).set(at, list / 4);
                return c.rb_api_crack(this.at, names.length, list, list + 4 * names.length);
            });
            c.free(list);
            return status;
        }
        maxima(depth) {
            return c.rb_api_stress_maxima(this.at, depth);
        }
        /* What must be known to read the solution rightly. */
        get notes() {
            const found = [];
            for (let k = 0, text; (text = text_at(c.rb_api_note(this.at, k, room, 4096))) !== null; k++)
                found.push(text);
            return found;
        }
        stress(nx, ny, depth) {
            return c.rb_api_stress(this.at, nx, ny, depth);
        }
        guess(zones) {
            const at = c.malloc(4 * zones.length);
            new Int32Array(c.memory.buffer).set(zones, at / 4);
            const status = c.rb_api_guess(this.at, zones.length, at);
            c.free(at);
            return status;
        }
        get message() {
            return text_at(c.rb_api_message(this.at));
        }
        word(name) {
            return with_text([name], (n) => text_at(c.rb_api_word(this.at, n)));
        }
        number(name) {
            return with_text([name], (n) => c.rb_api_number(this.at, n));
        }
        value(name) {
            return with_text([name], (n) => text_at(c.rb_api_value(this.at, n, room, 4096)));
        }
        variable(k) {
            return text_at(c.rb_api_variable(this.at, k, room, 4096));
        }
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
        (k, field) => with_text([field], (f) => text_at(c.rb_api_option(k, f, room, 4096))),
    );
    const results = Object.fromEntries(
        ["number", "column", "step", "point"].map((table) => [
            table,
            rows_of(["name", "unit", "kind", "meaning"], (k, field) =>
                with_text([table, field], (t, f) => text_at(c.rb_api_result(t, k, f, room, 4096))),
            ),
        ]),
    );
    return { Case, options, results, files };
}
