/* The one store of the page: the cases that are given, by name; what was solved of each; the states before, which
 * are entries of the browser's own history, so that its Back button and Ctrl+Z do the same. */

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/* state: { cases: { main, press, ... }, drawn }.  link(state): the address of a state.  changed(names): cases to
 * be solved anew; restored(): after undo, redo and Back; released(): after a hand has let go; shown(): after every change. */
export function make_store(first, { link, changed, restored, shown, released }) {
    let state = first,
        kept = first,
        index = 0,
        top = 0,
        timer = null;
    const store = {
        answers: {} /* of each case: what the library says, or { refused } */,
        solved: {} /* the last answer that was not refused */,
        ghosts: {} /* the answers before the hand took hold */,
        holding: false,
        get state() {
            return state;
        },
        get can_undo() {
            return index > 0;
        },
        get can_redo() {
            return index < top;
        },
        case: (name) => state.cases[name],

        /* A hand takes hold of something: states until release() are one step for undo. */
        hold() {
            if (store.holding) return;
            store.holding = true;
            store.ghosts = { ...store.solved };
        },
        release() {
            if (!store.holding) return;
            store.holding = false;
            store.keep();
            released();
            shown();
        },
        set(name, given) {
            if (same(given, state.cases[name])) return;
            if (!store.holding) store.ghosts = { ...store.solved };
            state = { ...state, cases: { ...state.cases, [name]: given } };
            changed([name]);
            if (!store.holding) store.keep();
            shown();
        },
        set_drawn(drawn) {
            state = { ...state, drawn };
            if (!store.holding) store.keep();
            shown();
        },
        /* One more state before this one, unless nothing has changed. */
        keep() {
            if (same(state, kept)) return;
            /* The page's own entry has its state a moment after the start: a change may come before. */
            if (!history.state?.rollbem) write("replaceState");
            kept = state;
            top = ++index;
            write("pushState");
            shown();
        },
        undo() {
            if (store.can_undo) history.back();
        },
        redo() {
            if (store.can_redo) history.forward();
        },
        reset(to) {
            if (same(state, to)) return;
            store.ghosts = {};
            take_state(to);
            store.keep();
        },
        /* Another state without a step for undo: of a link that was opened. */
        replace(to) {
            take_state(to);
            kept = state;
            write("replaceState");
        },
        answer(name, answer) {
            store.answers[name] = answer;
            if (!answer.refused) store.solved[name] = answer;
            shown();
        },
        trouble: (name) => store.answers[name]?.refused ?? store.answers[name]?.unsolved ?? "",
        rewrite() {
            clearTimeout(timer);
            timer = setTimeout(() => write("replaceState"), 250);
        },
    };
    function write(how) {
        clearTimeout(timer);
        try {
            /* Of what a hand is at only the state before it is an entry. */
            history[how]({ rollbem: true, state: kept, index }, "", link(kept));
        } catch {
            /* a frame without an address */
        }
    }
    function take_state(to) {
        const names = Object.keys(to.cases).filter((name) => !same(to.cases[name], state.cases[name]));
        state = to;
        changed(names);
        restored();
        shown();
    }
    /* Back, Forward and links that are typed; of the latter the page makes a state. */
    store.listen = (follow_link) =>
        window.addEventListener("popstate", (event) => {
            if (!event.state?.rollbem) {
                top = ++index;
                return follow_link();
            }
            index = event.state.index;
            store.ghosts = {};
            kept = event.state.state;
            take_state(kept);
        });
    return store;
}
