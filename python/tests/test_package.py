"""What is Python's own: memory, interruption, documentation, pictures, examples."""

import copy
import ctypes
import gc
import json
import os
import pickle
import re
import resource
import signal
import subprocess
import sys
import time
import warnings
from concurrent.futures import ProcessPoolExecutor
from decimal import Decimal
from fractions import Fraction
from typing import Optional

import numpy as np
import pytest
from conftest import ROOT

import rollbem
from rollbem import _library

ROLLED = dict(support="halfplane", similar=True, formulation="steady", load=500.0, creep_ratio=0.5)


def test_every_function_is_declared_as_in_the_header():
    header = re.sub(r"/\*.*?\*/", "", (ROOT / "include/rollbem/api.h").read_text(), flags=re.S)
    arguments = dict(re.findall(r"\b(rb_api_\w+)\((.*?)\);", header, flags=re.S))
    for name, (_, *types) in _library.FUNCTIONS.items():
        if name != "rb_version":
            assert len(types) == arguments[name].count(",") + 1, name


def test_arrays_look_into_the_library():
    solution = rollbem.solve(**ROLLED)
    p, x = solution.p, solution.x
    rows, columns = ctypes.c_int(), ctypes.c_int()
    at = _library.lib.rb_api_array(solution._handle.at, b"p", rows, columns)
    assert p.ctypes.data == at and p.base is not None
    with pytest.raises(ValueError):
        p[0] = 1.0
    kept = p.copy()
    del solution
    gc.collect()
    rollbem.solve(**ROLLED)  # memory that were free would be used again
    assert np.array_equal(p, kept) and len(x) == len(p)


def test_matrices_of_the_solution():
    s = rollbem.solve(creep=0.1, contact_elements=12, outer_elements=24)
    n = len(s.x)
    w = s.F @ np.concatenate([s.p, s.q])
    assert s.F.shape == (2 * n + 2, 2 * n)
    assert np.allclose(w[:n] - s.approach + s._handle.array("gap0"), s.gap, atol=1e-9)
    assert abs(s.H[:, ::2].sum(axis=1)).max() < 1e-9  # rigid motion
    M, q = s.lcp()
    assert M.shape == (36, 36) and len(q) == 36
    assert s.mesh.shape == (len(s.H) // 2, 4)


def test_cases_are_settled_and_varied(tmp_path):
    case = rollbem.Case(mu=0.2, **ROLLED)
    assert case["mu"] == 0.2 and case["mesh"] == "fitted" and case["similar"] is True
    assert case.but(mu=0.4)["mu"] == 0.4 and case["mu"] == 0.2
    assert case.but(mu=None)["mu"] == 0.3
    file = tmp_path / "case.ini"
    file.write_text("[friction]\nmu = 0.17\n[normal]\nload = 800\n")
    assert rollbem.Case(file)["mu"] == 0.17 and rollbem.Case(file, mu=0.5)["mu"] == 0.5
    file.write_text("[friction]\nmue = 0.17\n")
    with pytest.raises(rollbem.InvalidInput, match="case.ini:2: unknown key 'mue'"):
        rollbem.Case(file)
    assert "mu=0.2" in repr(case)


def test_tables_are_given_as_columns():
    x = np.linspace(-2, 2, 81)
    s = rollbem.solve(gap={"x": x, "gap": x**2 / 100}, **ROLLED)
    frame = pytest.importorskip("pandas").DataFrame({"x": x, "gap": x**2 / 100})
    assert rollbem.solve(gap=frame, **ROLLED).approach == s.approach
    want = rollbem.solve(gap="parabola", mesh="uniform", **ROLLED)
    assert s.status == "solved" and abs(s.max_pressure / want.max_pressure - 1) < 2e-3


@pytest.mark.parametrize("call", [
    "rollbem.solve(support='halfplane', similar=True, formulation='transient', load=500., creep_ratio=.5,"
    " distance=2000., contact_elements=100, mesh='uniform')",
    "rollbem.solve(contact_elements=1400, outer_elements=3000, solver='lemke', creep=.1)",
    "rollbem.sweep(mu=[.1 + k/1e5 for k in range(9000)], contact_elements=60)"])
def test_long_runs_end_by_control_c(call):
    program = f"import rollbem\ntry:\n print('begun', flush=True)\n {call}\nexcept KeyboardInterrupt:\n print('ended')"
    before = cpu_seconds_of_children()
    child = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True,
        # threads that wait do no work
        env={**os.environ, "PYTHONPATH": str(ROOT / "python"), "OPENBLAS_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"},
        # a job in the background of a shell ignores SIGINT, and so would its children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    assert child.stdout.readline() == "begun\n"
    time.sleep(0.7)
    child.send_signal(signal.SIGINT)
    try:
        out, _ = child.communicate(timeout=60)
    finally:
        child.kill()
    # of work, which is not more where the machine has other work to do
    worked = cpu_seconds_of_children() - before
    assert out == "ended\n" and worked < 5, f"{out!r}, {worked:.1f} s of work"


@pytest.mark.parametrize("asked, call", [
    ("rollbem.solve(support='halfplane', load=500., contact_elements=300, mesh='uniform', solver='newton')", "s.lcp()"),
    ("rollbem.solve(support='arc', contact_elements=20, outer_elements=1500)", "s.H"),
    ("rollbem.solve(support='hub', load=500., contact_elements=60)", "rollbem.stress(s, grid=(600, 600))"),
    ("rollbem.solve(support='hub', load=500., contact_elements=200, outer_elements=600)", "rollbem.derivatives(s)"),
    ("chain(1500)", "rollbem.lcp(s, -np.ones(1500), solver='lemke-sparse')"),
    ("0", "rollbem.sweep(crack_angle=[20 + k / 50 for k in range(2000)], support='halfplane', load=500., similar=True,"
     " contact_elements=200)"),
    ("0", "rollbem.crack(support='halfplane', load=500., similar=True, passes=1000, contact_elements=400)"),
])
def test_interrupted_calls_leave_their_object_whole(asked, call):
    """Memory that such a call uses is not freed or used again before it has ended: six times one after the other."""
    program = f"""
import signal, threading, time
import rollbem
import numpy as np

def chain(n):
    return 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)

s, ends = {asked}, 6 * ["late"]
for k in range(6):
    begun, first = time.monotonic(), .02 + .02 * k
    signal.setitimer(signal.ITIMER_REAL, first, .005)  # and again while the call ends
    try:
        {call}
        if time.monotonic() - begun < first + .05:
            ends[k] = "before the signal"
    except KeyboardInterrupt:
        ends[k] = "interrupted"
    finally:
        while True:
            try:
                signal.setitimer(signal.ITIMER_REAL, 0)
                break
            except KeyboardInterrupt:
                pass
time.sleep(.1)
print(threading.active_count(), *ends, sep="\\n")
"""
    program = "import signal\nsignal.signal(signal.SIGALRM, signal.default_int_handler)\n" + program
    child = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=600, env={
        **os.environ, "PYTHONPATH": str(ROOT / "python"), "OPENBLAS_NUM_THREADS": "1", "MALLOC_CHECK_": "3"})
    assert child.returncode == 0, child.stderr
    threads, *ends = child.stdout.splitlines()
    # what a call has stored before it is interrupted is there at once the next time
    assert threads == "1" and ends[0] == "interrupted" and "late" not in ends, ends


def cpu_seconds_of_children():
    """Of those that have ended, and of theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def test_documentation_comes_from_the_tables():
    for function in (rollbem.solve, rollbem.curve, rollbem.sweep, rollbem.stress, rollbem.Case):
        for name, option in rollbem.OPTIONS.items():
            assert f"{name}: {option.help}" in function.__doc__
    assert "max_pressure: p0 [MPa]" in rollbem.Solution.__doc__
    assert rollbem.solve.__signature__.parameters["mu"].annotation == Optional[float]
    assert {"p", "max_pressure", "plot"} <= set(dir(rollbem.solve(**ROLLED)))
    with pytest.raises(AttributeError, match="has no 'pressure'"):
        rollbem.solve(**ROLLED).pressure


def test_versions_must_agree(tmp_path):
    stub = tmp_path / "stub.c"
    names = [name for name in _library.FUNCTIONS if name != "rb_version"]
    stub.write_text('const char *rb_version(void) { return "0.0.1"; }\n' +
                    "".join(f"void {name}(void) {{}}\n" for name in names))
    library = tmp_path / "librollbem.so"
    try:
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, stub], check=True)
    except FileNotFoundError:
        pytest.skip("no compiler here")
    for path, words in ((library, "has version 0.0.1, the package has"), (tmp_path / "none", "does not load")):
        got = subprocess.run([sys.executable, "-c", "import rollbem"], capture_output=True, text=True, env={
            **os.environ, "ROLLBEM_LIBRARY": str(path), "PYTHONPATH": str(ROOT / "python")})
        assert words in got.stderr.splitlines()[-1]


def test_kernels_are_chosen_before_openblas_is_loaded():
    program = ("import rollbem; better = rollbem._library.lib.rb_blas_better_core;"
               "print(better() or 'none is better')")
    got = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, env={
        **{name: text for name, text in os.environ.items() if name != "OPENBLAS_CORETYPE"},
        "PYTHONPATH": str(ROOT / "python")})
    assert got.stdout == "none is better\n"


def test_friction_over_the_way():
    way = {"distance": [0, 1, 1.01, 2], "mu": [0.3, 0.3, 0.1, 0.1], "creep": [1e-3] * 4}
    case = {"support": "halfplane", "similar": True, "load": 500, "contact_elements": 30}
    h = rollbem.history(way, formulation="transient", **case)
    assert h.mu[0] == 0.3 and h.mu[-1] == 0.1
    assert abs(h.force_ratio[-1] * 0.1 * 500 - h.tangential_load[-1]) < 1e-9
    for law in ({"yield_stress": 50, "hardening": 1000}, {"friction_law": "exponential", "mu_fall": 0.1,
                                                          "slip_scale": 100, "speed": 1000}):
        s = rollbem.solve(formulation="steady", creep=1e-3, **law, **case)
        most = rollbem.pictures.bounds(s)
        assert (abs(s.q) <= most + 1e-9).all()
        assert (abs(abs(s.q) - most)[s.zone > 1] < 1e-6).all() and (s.zone > 1).any()


def test_pictures(tmp_path):
    pytest.importorskip("matplotlib")
    base = {k: v for k, v in ROLLED.items() if k not in ("formulation", "creep_ratio")}
    drawn = [rollbem.solve(**ROLLED), rollbem.solve(creep=0.1), rollbem.curve(points=5, **base),
             rollbem.history({"distance": [0, 1], "creep_ratio": [0.3, 0.3]}, contact_elements=20, **base),
             rollbem.stress(grid=(15, 11), **ROLLED)]
    for k, result in enumerate(drawn):
        result.plot().savefig(tmp_path / f"{k}.png")
        assert (tmp_path / f"{k}.png").stat().st_size > 10000
    rollbem.pictures.curves(rollbem.curve(points=5, mu=[0.1, 0.3], **base))


def test_pictures_of_a_study():
    """What is drawn are the results, in ascending order of the options, whatever theirs is."""
    pytest.importorskip("matplotlib")
    base = {k: v for k, v in ROLLED.items() if k not in ("mu", "creep_ratio")}
    study = rollbem.sweep(creep_ratio=[0.9, 0.2, 0.5], mu=[0.1, 0.4], **base)
    axes = study.plot(show="tangential_load", over="creep_ratio").axes[0]
    assert axes.get_xlabel() == "creep ratio" and axes.get_ylabel() == "tangential load [N/mm]"
    for k, line in enumerate(axes.lines):
        assert line.get_label() == f"mu = {study.axes['mu'][k]:g}"
        assert line.get_xdata().tolist() == [0.2, 0.5, 0.9]
        assert line.get_ydata().tolist() == study.tangential_load[[1, 2, 0], k].tolist()
    over_mu = study.plot().axes[0]  # the last option that varies
    assert [list(line.get_ydata()) for line in over_mu.lines] == study.force_ratio.tolist()
    drawn = study.plot(map=True, show="max_pressure")
    assert drawn.axes[0].get_ylabel() == "creep ratio" and drawn.axes[1].get_ylabel() == "max pressure [MPa]"
    study.status[0, 0] = 1  # not solved: a hole
    assert np.isnan(study.plot().axes[0].lines[0].get_ydata()[0])
    for wrong, words in (({"show": "p"}, "expected a result"), ({"over": "radius"}, "creep_ratio, mu"),
                         ({"family": "mu"}, "option that varies")):
        with pytest.raises(rollbem.InvalidInput, match=words):
            study.plot(**wrong)
    with pytest.raises(rollbem.InvalidInput, match="a map needs two"):
        rollbem.sweep(mu=[0.1, 0.2], **base, creep_ratio=0.5).plot(map=True)


@pytest.mark.parametrize("path", sorted((ROOT / "python/examples").glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_run(path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(path.parent)
    cells = json.loads(path.read_text())["cells"]
    names = {}
    for k, cell in enumerate(cells):
        if cell["cell_type"] == "code":
            assert not cell["outputs"], "notebooks are kept without outputs"
            exec(compile("".join(cell["source"]), f"{path.name}, cell {k}", "exec"), names)


def test_notes_are_those_of_the_program():
    s = rollbem.solve(support="halfplane", formulation="steady", load=10)
    assert len(s.notes) == 1 and "rolls at creepage 0" in s.notes[0]
    assert rollbem.solve(support="halfplane", formulation="steady", load=10, creep_ratio=0.5).notes == []


def test_studies_have_notes():
    base = dict(similar=True, support="halfplane", half_width=1, contact_elements=12)
    with pytest.warns(rollbem.Note):
        s = rollbem.sweep(creep_ratio=[0.1, 0.2], **base)
    assert len(s.notes) == 1 and "(all 2 cases)" in s.notes[0] and "formulation=" in s.notes[0]
    assert rollbem.sweep(mu=[0.1, 0.2], **base).notes == []
    with pytest.warns(rollbem.Note):
        c = rollbem.curve(start=0.001, stop=1, points=3, **base)
    assert len(c.notes) == 1 and "shorter than an element" in c.notes[0] and "(point 1 of 3)" in c.notes[0]


def test_notes_warn_where_the_package_is_called():
    base = {k: v for k, v in ROLLED.items() if k != "creep_ratio"}
    calls = (lambda: rollbem.solve(**base), lambda: rollbem.Case(**base).solve(),
             lambda: rollbem.stress(grid=(3, 3), **base).solution)
    for call in calls:
        with pytest.warns(rollbem.Note) as warned:
            solution = call()
        assert [str(w.message) for w in warned] == solution.notes != []
        assert {w.filename for w in warned} == {__file__}
    notes = rollbem.solve(creep=0.1, contact_elements=12, outer_elements=24).notes
    assert any("formulation='steady'" in note for note in notes) and "--" not in " ".join(notes)


def test_tables_of_a_case_are_closed_and_removed():
    x = np.linspace(-2.0, 2.0, 41)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        case = rollbem.Case(load=100.0, gap={"x": x, "gap": x * x / 100.0}, support="halfplane")
        path = case._texts["gap"]
        assert os.path.exists(path)
        case.itself = case
        del case
        gc.collect()
    assert not os.path.exists(path) and not warned


# ---- Copies and other processes


SMALL = dict(ROLLED, contact_elements=12, mesh="uniform")


def everything(result):
    """All that a result tells, by name."""
    clocks = {r.name for table in rollbem.RESULTS.values() for r in table.values() if r.kind == "seconds"}
    found = {name: x for name, x in {**result._numbers, **result.columns()}.items() if name not in clocks}
    found["repr"] = repr(result)
    for name in ("notes", "status", "formulation", "solver", "patches", "errors", "friction_power", "carter_holds", "ends",
                 "axes", "maxima", "zone", "p", "half_width", "mu"):
        if hasattr(result, name):
            found[f"its {name}"] = getattr(result, name)
    return found


def assert_same(one, other):
    one, other = everything(one), everything(other)
    assert one.keys() == other.keys()
    for name in one:
        np.testing.assert_equal(other[name], one[name])


def results():
    base = {k: v for k, v in SMALL.items() if k not in ("formulation", "creep_ratio")}
    solution = rollbem.solve(error=True, **SMALL)
    yield from (solution, rollbem.curve(points=3, **base), rollbem.stress(grid=(3, 4), **SMALL),
                rollbem.sweep(mu=[0.1, 0.2], **SMALL),
                rollbem.history({"distance": [0, 1], "creep_ratio": [0.3, 0.3]}, **base))


@pytest.mark.parametrize("again", [
    pytest.param(copy.copy, id="copy"),
    pytest.param(copy.deepcopy, id="deepcopy"),
    pytest.param(lambda x: pickle.loads(pickle.dumps(x)), id="pickle"),
    pytest.param(lambda x: copy.deepcopy(pickle.loads(pickle.dumps(x))), id="deepcopy of pickle"),
])
def test_results_are_copied(again):
    for result in results():
        other = again(result)
        assert_same(result, other)
        del result
        gc.collect()
        everything(other)  # what it looks into is still there
    case = again(rollbem.Case(gap={"x": [-1, 0, 1], "gap": [0.01, 0, 0.01]}, **SMALL))
    assert case.solve().max_pressure == case.but(mu=0.3).solve().max_pressure > 0
    for answer in (rollbem.lcp([[2, 1], [1, 2]], [-5, -6]), rollbem.friction(np.eye(3), [-1, 0.4, 0], 0.3)):
        other = again(answer)
        assert repr(other) == repr(answer) and np.array_equal(getattr(other, "z", None), getattr(answer, "z", None))


def test_given_tractions_of_a_pickled_solution():
    strip = {"x": [-1, -1, 1, 1], "p": [0, 100, 100, 0], "q": [0, 30, 30, 0]}
    points = [[0, 0.5], [0.5, 0.25]]
    stress = rollbem.stress(tractions=strip, young=2e5, poisson=0.3, points=points)
    solution = pickle.loads(pickle.dumps(stress.solution))
    assert solution.normal_load == stress.solution.normal_load == pytest.approx(200)
    assert_same(rollbem.stress(solution, points=points), stress)
    assert_same(rollbem.stress(pickle.loads(pickle.dumps(solution)), points=points, body="a"), stress)


def test_matrices_of_a_pickled_solution():
    solution = rollbem.solve(creep=0.1, contact_elements=12, outer_elements=24)
    other = pickle.loads(pickle.dumps(solution))
    for matrix in ("F", "H", "G", "mesh"):
        assert np.array_equal(getattr(other, matrix), getattr(solution, matrix))
    assert np.array_equal(other.lcp()[0], solution.lcp()[0])
    assert_same(rollbem.stress(solution, grid=(3, 3)), rollbem.stress(pickle.loads(pickle.dumps(solution)), grid=(3, 3)))


def solved(mu):
    return rollbem.solve(**{**SMALL, "mu": mu})


def refused(mu):
    return rollbem.solve(mu=mu, zone=1.0, contact_elements=12)


def test_a_thousand_results_cross_processes():
    all_mu = np.linspace(0.1, 0.5, 1000)
    with ProcessPoolExecutor(2) as pool:
        found = list(pool.map(solved, all_mu, chunksize=50))
        with pytest.raises(rollbem.Unsolved, match="zone") as caught:
            pool.submit(refused, 0.3).result()
        with pytest.raises(rollbem.InvalidInput, match="mu=: expected a number >= 0"):
            pool.submit(solved, -1).result()
    assert len(caught.value.solution.p) == 12 and caught.value.status > 0
    for mu, solution in list(zip(all_mu, found))[::100]:
        assert_same(solved(mu), solution)
    assert np.allclose([s.value("mu") for s in found], all_mu, rtol=1e-14, atol=0)


# ---- What is handed over


@pytest.mark.parametrize("mu", [np.array(0.25), Decimal("0.25"), Fraction(1, 4), np.float32(0.25), "0.25", [0.25]])
def test_numbers_of_any_kind(mu):
    assert rollbem.Case(mu=mu)["mu"] == 0.25


def test_a_dictionary_stands_for_the_file():
    case = rollbem.Case({"mu": 0.2, "contact-elements": 20, "load": None}, mu=0.25)
    assert (case["mu"], case["contact-elements"]) == (0.25, 20)
    assert len(rollbem.sweep({"contact_elements": 20, "shift": 0.01}, mu=[0.2, 0.3]).tangential_load) == 2


EYE, TOO_LARGE = np.eye(3), "from 0 to 2147483647, got 2147483648"


@pytest.mark.parametrize("call, words", [
    (lambda: rollbem.solve(mu=-1), "mu=: expected a number >= 0"),
    (lambda: rollbem.solve(load=5, approach=1), "approach= and load= exclude each other"),
    (lambda: rollbem.solve(nu=0.3), "unknown option 'nu'"),
    (lambda: rollbem.solve(derivatives="max_pressure"), "derivatives=: .*solution.derivatives"),
    (lambda: rollbem.solve(mu="0.3\0"), "mu=: a NUL character"),
    (lambda: rollbem.solve("case.ini\0"), "case=: a NUL character"),
    (lambda: rollbem.Case(3), "case=: expected the name of a file, got 3"),
    (lambda: rollbem.Case({3: 1}), "case=: expected names of options, got 3"),
    (lambda: rollbem.solve({"mu": -1}), "mu=: expected a number >= 0"),
    (lambda: rollbem.wear(load=10, coefficient=-1, slide=1), "^coefficient=: expected a number > 0"),
    (lambda: rollbem.solve(**{"mu\0": 1}), "unknown option"),
    (lambda: rollbem.solve(mu=[]), "mu=: expected at least one number"),
    (lambda: rollbem.solve(mu=1j), "mu=: expected numbers, got 1j"),
    (lambda: rollbem.solve(mu={"x": [1]}), "mu=: .*got columns of a table"),
    (lambda: rollbem.solve(gap={"x": [1, 2], "gap": [1]}), "gap=: expected columns of one length, got 2 of x, 1 of gap"),
    (lambda: rollbem.solve(gap={}), "gap=: .*no column"),
    (lambda: rollbem.solve(gap={"x": [1, 2], "gap": ["a", "b"]}), r"gap\['gap'\]=: expected numbers, got"),
    (lambda: rollbem.solve(creep=[1.5, 2]), "creep=: expected a number, got '1.5,2.0'"),
    (lambda: rollbem.crack(crack_angle="x"), "crack_angle=: expected a number, got 'x'"),
    (lambda: rollbem.solve(contact_elements=2**31), r"contact_elements=: expected a whole number in \[3, 16777216\], got '2147483648'"),
    (lambda: rollbem.solve(contact_elements=2**32 + 30), "contact_elements=: expected a whole number"),
    (lambda: rollbem.curve(points=2**31), f"points=: expected a whole number {TOO_LARGE}"),
    (lambda: rollbem.curve(over=None), "over=: expected creep-ratio, creep or speed, got None"),
    (lambda: rollbem.curve(mu=[]), "mu=: expected at least one number"),
    (lambda: rollbem.stress(grid=(2**31, 3), **ROLLED), "grid=: expected a whole number from 2"),
    (lambda: rollbem.stress(grid=3, **ROLLED), "grid=: expected two whole numbers, got 3"),
    (lambda: rollbem.stress(depth="deep", **ROLLED), "depth=: expected a number, got 'deep'"),
    (lambda: rollbem.stress(points=[], **ROLLED), "points=: expected an array of n x 2"),
    (lambda: rollbem.sweep(mu=[]), "mu=: expected at least one number"),
    (lambda: rollbem.sweep(mu=[[1, 2], [3, 4]]), "mu=: expected numbers in one row, got 2 x 2"),
    (lambda: rollbem.sweep(support=["hub", "arcs"], workers=-1), "workers=: expected"),
    (lambda: rollbem.sweep(support=["arcs", "hubs"]), "support=: expected .*got 'arcs'"),
    (lambda: rollbem.sweep(mu=[0.1], workers=2**31), f"workers=: expected a whole number {TOO_LARGE}"),
    (lambda: rollbem.lcp(EYE, [1, 2, 3], max_pivots=1.5), "max_pivots=: expected a whole number from 0 to .*, got 1.5"),
    (lambda: rollbem.lcp(EYE, [1, 2, 3], max_pivots=2**31), f"max_pivots=: expected a whole number {TOO_LARGE}"),
    (lambda: rollbem.lcp(EYE, [1, 2, 3], solver=None), "solver=: expected auto, lemke, lemke-sparse or newton, got None"),
    (lambda: rollbem.lcp([], []), "M=: expected a matrix of 0 x 0, got 0"),
    (lambda: rollbem.lcp(3, [1, 2]), "M=: expected a matrix of 2 x 2, got a number"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], 0.3, dimension=0), "dimension=: expected a whole number from 2 to 3, got 0"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], 0.3, dimension=2), "q=: expected a multiple of dimension=2"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0]), "mu=: expected numbers, got None"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], [0.3, 0.4]), "mu=: expected a number or one per contact"),
    (lambda: rollbem.friction(EYE), "q=: expected numbers with a matrix W"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], 0.3, solver=None), "solver=: expected a name"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], 0.3, max_iters=2.5), "max_iters=: expected a whole number"),
    (lambda: rollbem.friction(EYE, [-1, 0, 0], 0.3, tol=None), "tol=: expected a number, got None")])
def test_refusals_name_keywords(call, words):
    with pytest.raises(rollbem.InvalidInput, match=words) as caught:
        call()
    assert "--" not in str(caught.value) and "\n" not in str(caught.value)


def test_messages_in_keywords():
    for said, want in (("--similar has a radius", "similar=True has a radius"), ("use --cycles N", "use cycles=N"),
                       ("--mu 0.3 is", "mu=0.3 is"), ("'a-creep-ratio.txt': creep-ratio", "'a-creep-ratio.txt': creep_ratio"),
                       ("rate-free --young, --mu", "rate-free young=, mu="), ("give --load or less", "give load= or less")):
        assert _library.in_keywords(said) == want


def test_headings_of_tables_have_units():
    """A column says its unit as in a file; what is not understood is refused with its name."""
    x, gap = [-5.0, -2.0, 0.0, 2.0, 5.0], [54.0, 8.7, 0.0, 8.7, 54.0]
    case = dict(similar=True, support="halfplane", young=210000, poisson=0.3, load=1000)
    for columns in ({"x_mm": x, "gap_um": gap}, {"x [mm]": x, "gap [um]": gap}, {"gap (µm)": gap, "x / mm": x}):
        assert rollbem.solve(gap=columns, **case).max_pressure == pytest.approx(384.221, abs=1e-3)
    for columns, said in (({"x": x, "gap_foo": gap}, "column 'gap_foo'"), ({"a": x, "b": gap}, "unknown column 'a'")):
        with pytest.raises(rollbem.InvalidInput, match=said):
            rollbem.solve(gap=columns, **case)


def test_solutions_are_proved():
    solution = rollbem.solve(support="halfplane", load=500., formulation="steady", creep_ratio=0.4, contact_elements=30)
    proof = solution.proof
    assert proof["unique"] == "not shown"
    assert proof["proved"] and proof["isolated"] and proof["undecided"] == 0 and proof["reason"] == ""
    assert 0.0 < proof["bound_p"] < 1e-8 and 0.0 < proof["stored_within"] < 1e-8
