"""The package answers as the program does, bit for bit."""

import json
import math
import os
import warnings

import numpy as np
import pytest
from conftest import PROGRAM, run, run_json, smoke

import rollbem
from rollbem._library import in_keywords

STEADY = dict(support="halfplane", similar=True, formulation="steady", load=500.0, mu=0.3)
CASES = {
    "paper": dict(mu=0.3, creep=0.1),
    "carter": dict(STEADY, creep_ratio=0.4),
    "force": dict(STEADY, force_ratio=-0.6, mesh="uniform"),
    "hub": dict(support="hub", load=1e5, mu=0.2, creep_ratio=-0.5, formulation="steady", contact_elements=24),
    "two bodies": dict(similar=True, radius_b=80.0, load=300.0, shift=0.002, contact_elements=30),
    "error bars": dict(STEADY, creep_ratio=0.4, contact_elements=40, error=True),
    "one row of elements each": dict(STEADY, creep_ratio=1.0, solver="newton", contact_elements=81),
}


UNITS = sorted({r.unit for table in rollbem.RESULTS.values() for r in table.values() if r.unit})


def same(ours, theirs):
    """Equal to the last bit; what is NaN here is null there."""
    ours = np.ravel(ours)
    theirs = np.array([math.nan if x is None else x for x in np.ravel(theirs)], dtype=float)
    return np.array_equal(ours, theirs, equal_nan=True)


def check(ours, theirs):
    """The names on both sides are the same, and so are the numbers."""
    compared = 0
    for name, values in ours.items():
        headings = [name] + [f"{name}_{unit}" for unit in UNITS]
        heading = next((h for h in headings if h in theirs), None)
        if heading is None:
            continue
        assert same(values, theirs[heading]), name
        compared += 1
    assert compared > 3


@pytest.mark.parametrize("name", [pytest.param("carter", marks=smoke), *sorted(set(CASES) - {"carter"})])
def test_solutions(name):
    want, s = run_json(**CASES[name]), rollbem.solve(**CASES[name])
    check(s.numbers, want["summary"])
    check(s.columns(), want["table"])
    assert (s.status, s.formulation) == (want["summary"]["status"], want["summary"]["formulation"])
    if CASES[name].get("error"):
        bars = {k: e for k, e in want["summary"]["errors"].items() if e is not None}
        check(s.errors, bars)
        assert not set(s.errors) - set(bars)


@pytest.mark.parametrize("over, error", [("creep-ratio", False), ("creep", False), ("creep-ratio", True)])
def test_curves(over, error):
    options = dict(support="halfplane", poisson=0.5, half_width=0.05, error=error)
    stop = 1e-3 if over == "creep" else 1.2
    want = run_json("curve", "--from", 0, "--to", stop, "--points", 9, "--over", over, **options)
    got = rollbem.curve(stop=stop, points=9, over=over, **options)
    check(got.columns(), want["curve"])
    assert bool(got.errors) == error


def test_several_curves():
    options = dict(support="halfplane", half_width=0.05, mu=[0.1, 0.4])
    for got, mu in zip(rollbem.curve(points=5, **options), options["mu"]):
        want = run_json("curve", "--points", 5, **{**options, "mu": mu})
        check(got.columns(), want["curve"])
        assert got.mu == mu
    # of a law that falls the one at rest, to which force_ratio refers
    falls = rollbem.curve(points=3, support="halfplane", half_width=0.05, mu=0.2, friction_law="exponential", mu_fall=0.3,
                          slip_scale=1.0, speed=1000.0)
    assert abs(falls.mu - 0.5) < 1e-12
    assert all(abs(falls.force_ratio * falls.mu * falls.normal_load - falls.tangential_load) < 1e-12 * falls.normal_load)


def test_curves_over_the_speed_are_drawn_over_it():
    falls = dict(support="halfplane", similar=True, load=1000.0, mu=0.3, friction_law="exponential", mu_fall=0.1, slip_scale=10.0)
    rubber = dict(support="halfplane", similar=True, young=10.0, load=1.0, relaxation_time=0.01, relaxation_ratio=1.0, creep=0.0)
    for options, ordinate, column in (
        ({**falls, "creep": 0.01}, "braking force", lambda c: -c.force_ratio),
        ({**falls, "force_ratio": -0.5}, "creepage", lambda c: c.creepage),
        (rubber, "resistance", lambda c: c.resistance_ratio),
    ):
        curve = rollbem.curve(start=1e3, stop=5e3, points=3, over="speed", contact_elements=20, **options)
        axes = curve.plot().axes[0]
        assert axes.get_ylabel().startswith(ordinate) and axes.get_xlabel() == "speed [mm/s]"
        assert (axes.get_lines()[0].get_xdata() == curve.speed).all() and (axes.get_lines()[0].get_ydata() == column(curve)).all()
    both = rollbem.curve(start=1e3, stop=5e3, points=3, over="speed", contact_elements=20, creep=0.01, **{**falls, "mu": [0.2, 0.3]})
    axes = both.plot().axes[0]
    assert axes.get_ylabel() == "braking force −Q/P"
    assert (axes.get_lines()[1].get_ydata() == -both[1].mu * both[1].force_ratio).all()


def test_half_a_material_is_said():
    half = dict(support="halfplane", young=2e5, load=100.0, contact_elements=24)
    for run in (rollbem.solve, lambda **o: rollbem.curve(points=2, **o), lambda **o: rollbem.sweep(mu=[0.1, 0.2], **o)):
        with pytest.warns(rollbem.Note, match="young= without poisson="):
            assert any("young= without poisson=" in note for note in run(**half).notes)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            run(**half, poisson=0.3, similar=True, gap="parabola")



def test_a_hardness_is_a_modulus():
    case = dict(support="halfplane", poisson=0.5, load=1.0, contact_elements=24)
    for units, load in (("mm", 1.0), ("si", 1e3)):
        of = {**case, "units": units, "load": load, "radius": 50 if units == "mm" else 0.05}
        with pytest.warns(rollbem.Note, match="young= of 60 ShoreA is E = .* by Gent"):
            hard = rollbem.solve(young="60 ShoreA", **of)
        young = 0.0981 * (56 + 7.62336 * 60) / (0.137505 * 2.54 * 40) * (1 if units == "mm" else 1e6)
        assert np.allclose(hard.p, rollbem.solve(young=young, **of).p, rtol=1e-12, atol=0)
    with pytest.raises(ValueError, match="20 to 90 ShoreA"):
        rollbem.solve(young="95ShoreA", **case)

def test_histories(tmp_path):
    program = {"distance": [0, 1.5], "creep_ratio": [0.2, 0.7]}
    options = dict(support="halfplane", similar=True, load=500.0, contact_elements=30)
    file = tmp_path / "program.txt"
    file.write_text("# distance creep_ratio\n0 0.2\n1.5 0.7\n")
    want = run_json(formulation="transient", history=file, **options)
    got = rollbem.history(program, **options)
    check(got.columns(), want["history"])
    check(got.solution.columns(), want["table"])
    assert same(got.p[-1], got.solution.p) and got.zone.shape == got.q.shape
    rest = rollbem.history({"shift": [0, 1e-4, 0]}, **options)
    assert len(rest.residual) == 3 and rest.solution.formulation == "static"


def test_stress(tmp_path):
    want = run_json("stress", "--grid", "9x7", **CASES["carter"])
    got = rollbem.stress(grid=(9, 7), **CASES["carter"])
    check(got.columns(), want["grid"])
    assert got.sxx.shape == (7, 9) and (np.diff(got.y, axis=0) > 0).all()
    for name, largest in got.maxima.items():
        assert tuple(want["maxima"][name][key] for key in ("value", "x", "y")) == largest
    points = np.array([[0.0, 0.1], [0.2, 0.3]])
    np.savetxt(tmp_path / "points", points)
    want = run_json("stress", "--points", tmp_path / "points", **CASES["carter"])
    at = rollbem.stress(got.solution, points=points)
    check(at.columns(), want["points"] if "points" in want else want["grid"])


def test_layers(tmp_path):
    layers = {"thickness [mm]": [0.1, 0.05, 0.3], "young [GPa]": [400, 3, 70], "poisson": [0.2, 0.4, 0.33]}
    case = rollbem.Case(support="halfplane", layers=layers, base_young=210e3, base_poisson=0.3, radius=50, load=500,
                        mu=0, formulation="steady", creep=0)
    stress = rollbem.stress(case, points=[[0.3, 0.12]])
    bond = stress.maxima["bond_1_peel"]
    assert abs(bond.value / 10.164 - 1) < 1e-3 and abs(abs(bond.x) - 1.1001) < 2e-3 and bond.material == "layer 1"
    assert abs(stress.maxima["bond_3_shear"].value / 101.104 - 1) < 1e-4
    assert "bond_4_peel" not in stress.maxima
    many = {"thickness": [0.1] * 12, "young": [400e3, 3e3] * 6, "poisson": [0.3] * 12}
    deep = rollbem.stress(case.but(layers=many), points=[[0.3, 0.12]]).maxima
    assert deep["bond_12_shear"].material == "layer 12" and deep["bond_12_shear"].y == pytest.approx(1.2)
    assert deep["bond_12_tension_below"].material == "base" and "bond_13_shear" not in deep
    with pytest.raises(rollbem.InvalidInput, match="the first row of layers= says it"):
        rollbem.solve(case.but(young=3.0))


def test_least_radius():
    found = rollbem.design(support="halfplane", similar=True, load=500, mu=0, minimise="radius",
                           over={"radius": (20, 200)}, subject=["max_pressure<=600"])
    assert abs(found.value - 21.10263627) < 1e-3


def test_studies_of_fretting():
    frets = dict(support="halfplane", similar=True, gap="parabola", radius=100, load=500, fretting=True,
                 history={"force_ratio": [0, 0.6, -0.6, 0.6]}, contact_elements=30)
    study = rollbem.sweep(mu=[0.3, 0.5], **frets)
    alone = rollbem.solve(mu=0.5, **frets)
    assert study.swt_max[1] == pytest.approx(alone.swt_max, rel=1e-12) and study.work_per_cycle[0] > 0


def test_sweeps():
    base = {k: v for k, v in STEADY.items() if k not in ("mu", "load")}
    out = run("sweep", "--vary-1", "mu 0.1 0.3", "--vary-2", "creep-ratio 0:1.5:4", load=500.0, **base).stdout
    lines = [line.lstrip("# ").split("\t") for line in out.splitlines() if "\t" in line]
    want = dict(zip(lines[0], np.array(lines[1:], dtype=float).T))
    got = rollbem.sweep(mu=[0.1, 0.3], creep_ratio=np.linspace(0, 1.5, 4), load=500.0, **base)
    check(got.columns(), want)
    assert got.force_ratio.shape == (2, 4) and (got.status == 0).all()


def solved_by_program(command, file, *options):
    return run_json(command, "--solution", *options, file)["problems"][0]


def test_complementarity_problems(tmp_path):
    M, q = np.array([[2, -1, 0], [-1, 2, -1], [0, -1, 2.0]]), [-1, 0.3, -2]
    file = tmp_path / "problem.txt"
    file.write_text("3\n2 -1 0  -1 2 -1  0 -1 2\n-1 0.3 -2\n")
    for solver in ("auto", "lemke", "lemke-sparse", "newton"):
        want, got = solved_by_program("lcp", file, "--solver", solver), rollbem.lcp(M, q, solver=solver)
        assert same(got.z, want["z"]) and same(got.w, want["w"]) and got.residual == want["residual"]
        assert got.solver == want["solver"] and got.scaled_residual == want["scaled_residual"]
        assert np.allclose(M @ got.z + q, got.w, atol=1e-14) and np.minimum(got.z, got.w).min() > -1e-14
    with pytest.raises(rollbem.Unsolved) as caught:  # no solution: 0 z - 1 >= 0
        rollbem.lcp([[0.0]], [-1.0])
    assert caught.value.solution.z.shape == (1,)
    with pytest.raises(rollbem.InvalidInput, match="M=: expected a matrix of 2 x 2, got 3 x 3"):
        rollbem.lcp(M, [1, 2])


def test_friction_problems(tmp_path):
    W = np.array([[2, 0.3, 0], [0.3, 1.5, 0.1], [0, 0.1, 1.2]])
    q, mu = np.array([-1, 0.4, -0.3]), 0.3
    file = tmp_path / "problem.dat"
    numbers = " ".join(map(str, [*W.T.ravel(), *q, mu]))
    file.write_text(f"3 1\n0 3 3\n3 3\n{numbers}\n")
    got = rollbem.friction(W, q, mu)
    r, u = got.r[0], got.u[0]
    assert np.allclose(W @ r + q, u, atol=1e-12) and abs(u[0]) < 1e-7
    assert np.allclose(r[1:], -mu * r[0] * u[1:] / np.hypot(*u[1:]), atol=1e-7)
    for answer in (got, rollbem.friction(file)):
        want = solved_by_program("friction", file)
        assert same(answer.r, want["r"]) and same(answer.u, want["u"])
        assert answer.scaled_residual == want["scaled_residual"] and answer.solver == want["solver"]
    assert got.notes == [] and want["note"] is None and want["measure"] == "scaled"
    exact = rollbem.friction(W, q, mu, measure="acary", tol=1e-9)
    assert exact.residual <= 1e-9
    with pytest.warns(rollbem.Note, match=r"the residual \(13\) of Acary, .* above tol=1e-08.*measure= acary"):
        small = rollbem.friction(np.diag([1e-9, 0.5e-9, 0.5e-9]), [-1e-3, 0.4e-3, -0.3e-3], 0.8)
    assert small.scaled_residual <= 1e-8 < small.residual and len(small.notes) == 1
    with pytest.raises(rollbem.InvalidInput, match="measure=: expected scaled or acary, got 'units'"):
        rollbem.friction(W, q, mu, measure="units")
    with pytest.raises(rollbem.MissingFile):
        rollbem.friction(tmp_path / "none.hdf5")


@pytest.mark.parametrize("options", [dict(mu=-1), dict(nu=1), dict(load=5, approach=1), dict(poisson=0.7),
                                     dict(support="wall"), dict(gap="/no/such/file"), dict(creep="abc"),
                                     dict(formulation="steady", shift=1)])
def test_refusals_have_the_words_of_the_program(options):
    message = run(**options).stderr.splitlines()[0]
    with pytest.raises(rollbem.Error) as caught:
        rollbem.solve(**options)
    spoken = in_keywords(message.replace("rollbem: ", "").replace("--nu", "nu"))
    assert str(caught.value).split(" (")[0].split("'")[0] in spoken
    kind = FileNotFoundError if "gap" in options else ValueError
    assert isinstance(caught.value, kind)


def test_runs_without_a_full_answer_keep_what_there_is():
    want = run_json(zone=1.0)
    with pytest.raises(rollbem.Unsolved) as caught:
        rollbem.solve(zone=1.0)
    check(caught.value.solution.columns(), want["table"])
    assert caught.value.solution.status == want["summary"]["status"]


@pytest.fixture(scope="module")
def schema():
    validator = pytest.importorskip("jsonschema")
    found = json.loads(run("--describe=schema").stdout)
    validator.Draft202012Validator.check_schema(found)

    def complaints(result):
        return [error.message for error in validator.Draft202012Validator(found).iter_errors(result)]

    return complaints


@pytest.mark.parametrize("words", [
    (), ("--error", "--contact-elements", 20), ("curve", "--points", 4, "--mu", "0.1,0.3", "--half-width", 1),
    ("curve", "--points", 4, "--error"), ("stress", "--grid", "3x4"), ("example", "bar"),
    ("--formulation", "transient", "--distance", 1, "--creep", 0.1, "--contact-elements", 20),
    ("--zone", 1), ("lcp", "examples/lcp/two.txt", "--solution")])
def test_json_keeps_its_schema(schema, words, in_root):
    result = run_json(*words)
    assert schema(result) == []
    result["schema"] = "rollbem/0"
    assert "'rollbem/1' was expected" in schema(result)
    if "summary" in result:
        del result["summary"]["max_pressure"]
        assert "'max_pressure' is a required property" in schema(result)


@pytest.mark.skipif(not os.path.exists(f"{PROGRAM}.html"), reason="the page is not built")
def test_the_page_is_the_program_s(tmp_path):
    case = dict(STEADY, creep_ratio=0.4, contact_elements=60)
    case["load"] = "500N/mm"
    assert run("page", "--output", str(tmp_path / "want.html"), **case).returncode == 0
    ours = rollbem.page(tmp_path / "ours.html", **case)
    assert open(ours, "rb").read() == (tmp_path / "want.html").read_bytes()
    for wrong in (dict(contact_elements=401), dict(error=True), dict(gap={"x": [-1, 0, 1], "gap": [1, 0, 1]}), dict(units="si"),
                  dict(formulation="transient", creep=1e-3, distance=40.5)):
        with pytest.raises(rollbem.InvalidInput):
            rollbem.page(tmp_path / "wrong.html", **{**STEADY, **wrong})
    assert not (tmp_path / "wrong.html").exists()
