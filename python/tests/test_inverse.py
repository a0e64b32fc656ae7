"""Cracks, derivatives, fits and designs answer as the program does."""

import copy
import pickle
import threading

import numpy as np
import pytest
from conftest import run_json

import rollbem

PLANES = dict(support="halfplane", similar=True, load=500.0)
STEADY = dict(PLANES, formulation="steady", creep_ratio=0.5)


def test_cracks():
    c = rollbem.crack(**PLANES, mu=0.0, crack_angle=45, passes=2, from_=-7)
    assert len(c.x) % 2 == 0 and c.x[0] == pytest.approx(-7 * 0.8165, rel=1e-3)
    assert c.K_II_max == c.K_II[len(c.x) // 2:].max()
    assert c.faces["opening"].shape == (40, len(c.x)) and c.faces["path_y"][1] < 0
    assert c.growth == {}
    assert "delta_K_II" in c.numbers and "positions" in repr(c)
    assert len(c.to_pandas()) == len(c.x)
    grown = rollbem.crack(**PLANES, mu=0.0, paris=(1e-12, 3), grow_steps=2)
    assert grown.growth["cycles"][0] == 0 and len(grown.growth["length"]) == 3
    with pytest.raises(rollbem.InvalidInput, match="crack.angle"):
        rollbem.crack(**PLANES, crack_angle=180)


def test_studies_of_cracks():
    study = rollbem.sweep(**PLANES, mu=0.0, from_=-7, crack_length=[0.5, 1.0], crack_angle=[30, 60, 90], workers=1)
    one = rollbem.crack(**PLANES, mu=0.0, from_=-7, crack_length=1.0, crack_angle=60)
    assert study.delta_K_II.shape == (2, 3) and study.delta_K_II[1, 1] == one.delta_K_II
    assert (study.max_pressure == study.max_pressure[0, 0]).all()  # of the contact
    assert np.isnan(study.pass_change).all() and (study.status == 0).all()
    figure = study.plot(show="delta_K_II", map=True)
    assert "MPa" in figure.axes[1].get_ylabel() and figure.axes[0].get_xlabel() == "crack angle [degrees]"
    with pytest.raises(rollbem.InvalidInput, match="case 1: crack_angle=: expected more than 0"):
        rollbem.sweep(**PLANES, crack_angle=[0, 30])
    with pytest.raises(rollbem.InvalidInput, match="paris"):
        rollbem.sweep(**PLANES, crack_angle=[30], paris=(1e-12, 3))


def test_derivatives():
    s = rollbem.solve(**STEADY)
    d = s.derivatives
    want = run_json(**STEADY, derivatives="tangential_load")["derivatives"]["tangential_load"]
    for name, value in want.items():
        if isinstance(value, list):
            assert np.isnan(d["tangential_load"][name][0]) and value[0] is None
        else:
            assert d["tangential_load"][name] == pytest.approx(value, rel=1e-6)
    assert d["normal_load"]["load"] == pytest.approx(1, rel=1e-9)
    assert run_json(**STEADY, derivatives="tangential_load")["derivatives_are"].startswith(d.elements)
    assert d["q"]["mu"].shape == s.q.shape
    assert rollbem.derivatives(**STEADY)["max_pressure"]["load"] == pytest.approx(s.max_pressure / 1000, rel=1e-3)
    with pytest.raises(rollbem.InvalidInput):
        rollbem.derivatives(**PLANES, formulation="static", increments=3)
    other = rollbem.derivatives(**{**STEADY, "load": 900.0})["tangential_load"]["mu"]
    assert rollbem.derivatives(s, load=900.0)["tangential_load"]["mu"] == other != d["tangential_load"]["mu"]
    assert rollbem.tolerances(s, tolerance={"mu": 0.01}, load=900.0)["tangential_load"] == pytest.approx(
        0.01 * abs(other))


def test_smooth_derivatives():
    case = dict(STEADY, mesh="aligned", creep=-5e-4)
    case.pop("creep_ratio", None)
    s = rollbem.solve(**case)
    want = run_json(**case, smooth_derivatives="tangential_load")["smooth_derivatives"]["tangential_load"]
    assert s.smooth_derivatives["tangential_load"]["creep"] == pytest.approx(want["creep"], rel=1e-9)
    assert s.derivatives["tangential_load"]["creep"] != pytest.approx(want["creep"], rel=1e-6)
    assert rollbem.derivatives(**case, smooth=True)["tangential_load"]["mu"] == pytest.approx(want["mu"], rel=1e-9)


def test_derivatives_in_columns():
    d = rollbem.curve_derivatives(**{**PLANES, "contact_elements": 30}, results="tangential_load:mu,max_pressure",
                                  start=0.2, stop=0.6, points=3)
    one = rollbem.derivatives(**{**PLANES, "contact_elements": 30}, formulation="steady", creep_ratio=0.6)
    assert d["tangential_load"]["mu"].shape == (3,) and list(d["tangential_load"]) == ["mu"]
    assert d["tangential_load"]["mu"][2] == pytest.approx(one["tangential_load"]["mu"], rel=1e-8)
    assert d["max_pressure"]["load"][0] == pytest.approx(one["max_pressure"]["load"], rel=1e-8)
    rolled = {**PLANES, "contact_elements": 30, "formulation": "transient", "distance": 1, "creep": 1e-3}
    steps = rollbem.history_derivatives(**rolled, results="tangential_load")
    low, high = (rollbem.solve(**{**rolled, "mu": mu}).history.tangential_load for mu in (0.2999, 0.3001))
    assert steps["tangential_load"]["mu"] == pytest.approx((high - low) / 2e-4, rel=1e-4, abs=1e-6)
    with pytest.raises(rollbem.InvalidInput, match="expected a result that has derivatives"):
        rollbem.curve_derivatives(**PLANES, results="nonsense")


SMALL = {**PLANES, "contact_elements": 30}
ROLLED = {**SMALL, "formulation": "transient", "distance": 1, "creep": 1e-3}


def assert_as_printed(derivatives, printed, size):
    """As the program prints them: a number, or [left, right] of both sides."""
    assert set(derivatives) == set(printed)
    for result, inputs in printed.items():
        assert list(derivatives[result]) == list(inputs)
        for name, rows in inputs.items():
            both = np.array([row if isinstance(row, list) else [row, row] for row in rows], dtype=float)
            found = derivatives.sides[result][name] if derivatives.sides else derivatives[result][name]
            one = np.where(np.isnan(both[:, 1]), both[:, 0], both[:, 1])
            assert found == pytest.approx(both if found.ndim == 2 else one, rel=1e-7, abs=1e-9, nan_ok=True)
            assert derivatives[result][name] == pytest.approx(one, rel=1e-7, abs=1e-9, nan_ok=True)
            assert len(derivatives[result][name]) == size


def test_columns_are_those_of_the_program():
    c = rollbem.curve(**SMALL, points=4, derivatives=True)
    assert_as_printed(c.derivatives, run_json("curve", **SMALL, points=4, derivatives="all")["curve"]["derivatives"], 4)
    assert (np.isnan(c.derivatives.sides["tangential_load"]["interlayer-tangential"]) == [True, False]).all()
    h = rollbem.history(**ROLLED, derivatives=["tangential_load", "all:load"])
    assert_as_printed(h.derivatives, run_json(**ROLLED, derivatives="tangential_load,all:load")["history"]["derivatives"],
                      len(h.distance))
    # numbers are in the units of the case
    si = dict(support="halfplane", similar=True, load=500e3, units="si", contact_elements=30, radius=0.05, young=2.1e11)
    mm = {**SMALL, "radius": 50, "young": 2.1e5}
    by = [rollbem.curve(**case, points=3, derivatives="tangential_load:radius").derivatives for case in (mm, si)]
    assert by[1]["tangential_load"]["radius"] == pytest.approx(1e6 * by[0]["tangential_load"]["radius"], rel=1e-9)
    assert by[1].units["tangential_load"]["radius"] == "(N/m)/m"
    for several in rollbem.curve(**SMALL, mu=[0.2, 0.3], points=3, derivatives="tangential_load:mu"):
        assert several.derivatives["tangential_load"]["mu"].shape == (3,)
    over = rollbem.curve(start=10, stop=1000, points=3, over="speed", creep=1e-3, relaxation_time=1e-3, relaxation_ratio=1,
                         derivatives="resistance_moment:creep", **SMALL)
    assert len(over.derivatives["resistance_moment"]["creep"]) == 3


def test_columns_as_pandas_has_them():
    pandas = pytest.importorskip("pandas")
    c = rollbem.curve(**SMALL, points=4, derivatives="tangential_load:creep_ratio,max_pressure:radius")
    frame = c.to_pandas()
    assert (frame["d_tangential_load_by_creep_ratio"] == c.derivatives["tangential_load"]["creep_ratio"]).all()
    assert frame.attrs["units"]["d_max_pressure_by_radius"] == "MPa/mm"
    h = rollbem.history(**ROLLED, derivatives="tangential_load:mu", tolerance={"mu": 0.02}).to_pandas()
    assert h["deviation_tangential_load"].values == pytest.approx(0.02 * abs(h["d_tangential_load_by_mu"].values))
    study = rollbem.sweep(**SMALL, mu=[0.2, 0.3], workers=1, derivatives="max_pressure:load").to_pandas()
    assert study["d_max_pressure_by_load"].values == pytest.approx(study["max_pressure"].values / 1000, rel=1e-3)
    table = rollbem.solve(**STEADY).derivatives.to_pandas()
    assert isinstance(table, pandas.DataFrame) and set(table["result"]) > {"tangential_load", "max_pressure"}
    row = table[(table["result"] == "tangential_load") & (table["input"] == "interlayer-tangential")].iloc[0]
    assert np.isnan(row["left"]) and row["right"] > 0 and row["unit"] == "(N/mm)/(mm/MPa)"
    table = table[(table["result"] == "normal_load") & (table["input"] == "load")].iloc[0]
    assert table["left"] == table["right"] == pytest.approx(1) and table["unit"] == "1"


def test_wrong_questions_of_histories_are_refused_before_they_run():
    seen = []
    case = {**ROLLED, "progress": lambda done, total: seen.append(done)}
    for wrong, said in (({"derivatives": "tangentil_load"}, "did you mean 'tangential_load'"), ({"derivatives": 3}, "expected True"),
                        ({"tolerance": {"zone": 1}}, "'zone' is not a number"), ({"tolerance": "mu=-1"}, "standard deviation >= 0"),
                        ({"derivatives": "all", "load": None, "approach": 0.01}, "given approach"),
                        ({"tolerance": "mu=1%", "load": None, "approach": 0.01}, "given approach"),
                        ({"derivatives": "all", "error": True}, "not together with error bars")):
        with pytest.raises(rollbem.InvalidInput, match=said):
            rollbem.history(**{**case, **wrong})
    assert seen == []
    with pytest.raises(rollbem.InvalidInput, match=r"history\(..., derivatives=...\) has those after each"):
        rollbem.derivatives(**ROLLED)


def test_derivatives_over_x():
    s = rollbem.solve(**STEADY)
    printed = run_json(**STEADY, derivatives="tangential_load")["derivatives_over_x"]
    for result, both in printed.items():
        for by, values in both.items():
            assert s.derivatives_over_x[result][by] == pytest.approx(np.array(values), rel=1e-6, abs=1e-6)
    stays = rollbem.solve(**PLANES, formulation="steady", creep=2e-3, mesh="uniform", zone=1.2)
    total = stays.derivatives_over_x["tangential_load"]["mu"].sum()  # mu of every element is mu of the case
    assert total == pytest.approx(stays.derivatives["tangential_load"]["mu"], rel=1e-8) and total < -10
    assert rollbem.solve(**STEADY, mu_fall=0.1, slip_scale=50.0, speed=1000.0, friction_law="exponential").derivatives_over_x == {}


def test_derivatives_are_copied_and_kept():
    c = rollbem.curve(**SMALL, points=3, derivatives="tangential_load")
    h = rollbem.history(**ROLLED, derivatives="tangential_load", tolerance={"mu": 0.02})
    for again in (copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))):
        for one, other in ((c.derivatives, again(c).derivatives), (h.derivatives, again(h).derivatives),
                           (h.derivatives, again(h.solution).history.derivatives),
                           (h.tolerances, again(h.solution).history.tolerances)):
            assert list(one) == list(other) and getattr(one, "units", 0) == getattr(other, "units", 0)
            for result in one:
                inputs = one[result] if isinstance(one[result], dict) else {"": one[result]}
                others = other[result] if isinstance(one[result], dict) else {"": other[result]}
                assert all(np.array_equal(inputs[name], others[name]) for name in inputs)
        assert again(c.derivatives)["tangential_load"]["creep_ratio"] is not None
    before = h.tolerances["tangential_load"].copy()  # the next call computes in the same place
    rollbem.tolerances(h.solution, tolerance="mu=0.04")
    assert np.array_equal(h.tolerances["tangential_load"], before)
    with pytest.raises(KeyError):
        c.derivatives["tangential_load"]["creep"]


def test_derivatives_in_threads():
    s = rollbem.solve(**STEADY)
    want, wrong = rollbem.derivatives(s)["tangential_load"]["mu"], []

    def work():
        try:
            for _ in range(10):
                slope = rollbem.derivatives(s)["tangential_load"]["mu"]
                deviation = rollbem.tolerances(s, tolerance="mu=1")["tangential_load"]
                if slope != want or deviation != pytest.approx(abs(want)) or rollbem.stress(s, (4, 4)).sxx.shape != (4, 4):
                    wrong.append(slope)
        except Exception as error:
            wrong.append(error)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


@pytest.mark.parametrize("wrong, said", [
    ("", "expected a name"), (3, "expected True, or RESULT"), ([], "expected True"), (False, "expected True"),
    ("all:zone", "'zone' is not a number of this case"), ("max_presure", "did you mean"), ("a\0b", "expected names"),
    ("max_pressure:load:mu", "not a number of this case"), ("x" * 3000, "expected a result that has derivatives")])
def test_what_has_no_derivatives_is_refused(wrong, said):
    for call in (lambda: rollbem.curve(**SMALL, points=3, derivatives=wrong),
                 lambda: rollbem.history(**ROLLED, derivatives=wrong),
                 lambda: rollbem.sweep(**SMALL, mu=[0.1, 0.2], workers=1, derivatives=wrong)):
        with pytest.raises(rollbem.InvalidInput, match=said):
            call()
    for call in (lambda: rollbem.curve(**SMALL, points=3, error=True, derivatives="max_pressure"),
                 lambda: rollbem.history(**ROLLED, error=True, derivatives="max_pressure")):
        with pytest.raises(rollbem.InvalidInput, match="not together with error bars"):
            call()


def test_derivatives_of_studies():
    case = {**PLANES, "contact_elements": 30, "formulation": "steady"}
    study = rollbem.sweep(**case, mu=[0.2, 0.3], creep_ratio=[0.3, 0.6, 0.8], workers=2,
                          derivatives="tangential_load:mu,max_pressure")
    one = rollbem.derivatives(**case, mu=0.3, creep_ratio=0.6)
    assert study.derivatives["tangential_load"]["mu"].shape == (2, 3) and list(study.derivatives["tangential_load"]) == ["mu"]
    for result, name in (("tangential_load", "mu"), ("max_pressure", "load"), ("max_pressure", "radius")):
        assert study.derivatives[result][name][1, 1] == pytest.approx(one[result][name], rel=1e-9), name
    assert rollbem.sweep(**case, mu=[0.2], workers=1).derivatives == {}
    with pytest.raises(rollbem.InvalidInput, match="expected a result that has derivatives"):
        rollbem.sweep(**case, mu=[0.2], derivatives="nonsense")
    with pytest.raises(rollbem.InvalidInput, match="not of cracks"):
        rollbem.sweep(**PLANES, mu=0.0, crack_angle=[30], derivatives="max_pressure")


def test_tolerances_of_studies():
    pandas = pytest.importorskip("pandas")
    case = {**PLANES, "contact_elements": 30, "formulation": "steady"}
    study = rollbem.sweep(**case, mu=[0.2, 0.3], creep_ratio=[0.3, 0.6, 0.8], workers=2, derivatives="tangential_load:mu",
                          tolerance={"mu": "10%", "creep_ratio": 0.05})
    one = rollbem.solve(**case, mu=0.3, creep_ratio=0.6, tolerance="mu=10%,creep-ratio=0.05")
    for name in ("tangential_load", "max_pressure", "dissipation"):
        assert study.tolerances[name].shape == (2, 3)
        assert study.tolerances[name][1, 1] == pytest.approx(one.tolerances[name], rel=1e-9), name
    frame = study.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame["deviation_tangential_load"].iloc[4] == one.tolerances["tangential_load"]
    assert rollbem.sweep(**case, mu=[0.2], workers=1, tolerance="mu=1%").derivatives == {}
    assert rollbem.sweep(**case, mu=[0.2], workers=1).tolerances == {}
    with pytest.raises(rollbem.InvalidInput, match="'zone' is not a number"):
        rollbem.sweep(**case, mu=[0.2], tolerance="zone=1")
    with pytest.raises(rollbem.InvalidInput, match="tolerance: not of cracks"):
        rollbem.sweep(**PLANES, mu=0.0, crack_angle=[30], tolerance="load=1%")


def test_tolerances():
    s = rollbem.solve(**STEADY, tolerance={"mu": 0.02, "radius": "1%"})
    want = run_json(**STEADY, tolerance="mu=0.02,radius=1%")["tolerances"]
    assert s.tolerances == pytest.approx(want, rel=1e-6, abs=1e-12) and s.tolerances["normal_load"] == 0
    assert rollbem.tolerances(s, tolerance="mu=0.01")["tangential_load"] == pytest.approx(
        0.01 * abs(s.derivatives["tangential_load"]["mu"]))
    assert rollbem.solve(**STEADY).tolerances == {}
    with pytest.raises(rollbem.InvalidInput, match="zone"):
        rollbem.solve(**STEADY, tolerance={"zone": 1})


def test_tolerances_of_histories():
    rolled = {**PLANES, "contact_elements": 30, "formulation": "transient", "distance": 1, "creep": 1e-3}
    h = rollbem.history(**rolled, tolerance={"mu": 0.02, "load": "1%"})
    want = run_json(**rolled, tolerance="mu=0.02,load=1%")["history"]["tolerances"]
    assert h.tolerances["tangential_load"] == pytest.approx(want["tangential_load"], rel=1e-6, abs=1e-12)
    d = rollbem.history_derivatives(**rolled, results="tangential_load")["tangential_load"]
    assert h.tolerances["tangential_load"] == pytest.approx(np.hypot(0.02 * d["mu"], 5 * d["load"]), rel=1e-6)
    assert h.tolerances["normal_load"] == pytest.approx(5 * np.ones_like(h.distance))
    both = rollbem.history(**rolled, tolerance={"mu": 0.02, "load": "1%"}, derivatives="tangential_load")
    assert (both.tolerances["tangential_load"] == h.tolerances["tangential_load"]).all()
    assert (both.derivatives["tangential_load"]["mu"] == d["mu"]).all()
    assert rollbem.history(**rolled).tolerances == {}
    assert rollbem.solve(**rolled, tolerance="mu=0.02").tolerances == {}
    with pytest.raises(rollbem.InvalidInput, match="given approach"):
        rollbem.history(**{**rolled, "load": None, "approach": 0.01}, tolerance={"mu": 0.02})


def test_tolerances_of_curves():
    c = rollbem.curve(**SMALL, points=4, tolerance={"mu": 0.02, "creep_ratio": "5%"})
    printed = run_json("curve", **SMALL, points=4, tolerance="mu=0.02,creep-ratio=5%")["curve"]["tolerances"]
    assert len(c.tolerances) > 5 and c.derivatives == {}
    for name, values in c.tolerances.items():
        column = next(key for key in printed if key.split("_N")[0] in (name, {"tangential_load": "Q", "normal_load": "P"}.get(name)))
        assert values == pytest.approx(np.array(printed[column], dtype=float), rel=1e-7, abs=1e-12), name
    assert c.tolerances["tangential_load"][-1] == pytest.approx(0.02 * 500)  # it slides
    assert (pytest.importorskip("pandas") and c.to_pandas())["deviation_tangential_load"].iloc[-1] == pytest.approx(10)
    with pytest.raises(rollbem.InvalidInput, match="^tolerance=: 'zone' is not a number"):
        rollbem.curve(**SMALL, points=4, tolerance="zone=1")
    with pytest.raises(rollbem.InvalidInput, match="not together with error bars"):
        rollbem.curve(**SMALL, points=4, error=True, tolerance="mu=1%")


def test_fits(tmp_path):
    xi = -0.5e-3 * np.arange(1, 13)
    ratio = [-rollbem.solve(**PLANES, formulation="steady", mu=0.25, creep=float(x) + 1e-4).tangential_load / 500
             for x in xi]
    data = {"creep": xi, "force_over_load": -np.array(ratio)}
    pandas = pytest.importorskip("pandas")
    for columns in (data, pandas.DataFrame(data)):
        found = rollbem.fit(columns, ["mu", "creep_offset"], **PLANES, bounds={"mu": (0.1, 0.6)}, start={"mu": 0.3})
        assert found["mu"].value == pytest.approx(0.25, abs=1e-3)
        assert found["creep_offset"].value == pytest.approx(1e-4, abs=1e-5)
        assert found["mu"].interval[0] <= found["mu"].value <= found["mu"].interval[1]
        assert len(found.fitted) == 12 and "mu" in repr(found)
    with pytest.raises(rollbem.InvalidInput, match="did you mean 'mu'"):
        rollbem.fit(data, "mou", **PLANES)
    pandas.DataFrame(data).to_csv(tmp_path / "data.csv", index=False)
    printed = run_json("fit", tmp_path / "data.csv", **PLANES, fit="mu,creep-offset", start="mu=0.3")["parameters"]["mu"]
    by_file = rollbem.fit(tmp_path / "data.csv", "mu,creep-offset", **PLANES, start={"mu": 0.3})
    assert by_file["mu"].interval == pytest.approx(printed["interval"], rel=1e-9)
    assert by_file["mu"].correlation == pytest.approx(printed["correlation"], rel=1e-6)


def test_data_of_fits():
    pandas = pytest.importorskip("pandas")
    xi = -0.5e-3 * np.arange(1, 13)
    force = 100 * np.tanh(-600 * xi) + np.where(np.arange(12) % 2, 1.5, -1.5)
    frame = pandas.DataFrame({"test": ["A"] * 6 + ["B"] * 6, "creep": xi, "force": force, "load": [500.0] * 6 + [600.0] * 6})
    seen = []
    found = rollbem.fit(frame, "mu", **PLANES, progress=lambda done, total: seen.append((done, total)))
    assert 0.1 < found["mu"].value < 0.3 and found["mu"].identified and len(found.residual) == 12
    wider = rollbem.fit(frame, "mu", **PLANES, sigma=20.0)
    assert wider["mu"].deviation == pytest.approx(found["mu"].deviation * 20 / found.noise, rel=1e-6)
    assert rollbem.fit(frame, ["mu", "creep_offset"], **PLANES, bounds={"mu": ("0.1", 0.6)})["creep-offset"].identified
    si = frame.assign(force=1e3 * force, load=1e3 * frame["load"])
    case = dict(support="halfplane", similar=True, load=500e3, units="si", young=2.1e11, radius=0.3)
    loads = [rollbem.fit(one.drop(columns="load"), "load", **of, bounds={"load": ends}, mu=0.2)["load"].value
             for one, of, ends in ((frame, {**PLANES, "young": 2.1e5, "radius": 300}, (300, 900)),
                                   (si, case, (3e5, "900 N/mm")))]
    assert loads[0] == pytest.approx(475, rel=0.1) and loads[1] == pytest.approx(1e3 * loads[0], rel=1e-6)
    with pytest.warns(rollbem.Note, match="do not determine young"):
        assert np.isnan(rollbem.fit(frame, "young", **PLANES, mu=0.05)["young"].value)
    for columns, said in (({"creep": xi, "force": force, "lode": force}, "unknown column 'lode' .did you mean 'load'"),
                          ({"creep": xi, "force": np.where(xi < -5e-3, np.nan, force)}, "data, row 11: force: expected a finite"),
                          ({"creep": xi[:1], "force": force[:1]}, "expected at least 2 points for 1 number, got 1"),
                          ({"creep": xi, "force": ["1,5"] * 12}, "column 'force': expected numbers"),
                          ({"creep": xi, "force": force[:-1]}, "columns of one length"), ({}, "expected at least one row"),
                          ({"creep": xi, "force": force, "sigma": -np.ones(12)}, "data, row 1: sigma: expected > 0"),
                          ({"creep": xi}, "expected a column creep or creep_ratio")):
        with pytest.raises(rollbem.InvalidInput, match=said):
            rollbem.fit(columns, "mu", **PLANES)
    for wrong, said in (({"bounds": {"mu": 0.1}}, "from, to"), ({"bounds": {"load": (1, 2)}}, "of a fitted number"),
                        ({"start": {"mu": "x"}}, "start=: expected NAME=X"), ({"level": 95}, r"level=: expected a number in \(0, 1\), got 95"),
                        ({"sigma": -1}, "sigma=: expected a number > 0"), ({"bounds": 3}, "a dictionary")):
        with pytest.raises(rollbem.InvalidInput, match=said):
            rollbem.fit(frame, "mu", **PLANES, **wrong)
    with pytest.raises(KeyboardInterrupt):
        rollbem.fit(frame, "mu", **PLANES, progress=interrupt)


@pytest.mark.parametrize("data, names, said", [
    (None, "mu", "data=: expected the name of a file, or columns by their names, got None"),
    ([1, 2, 3], "mu", "data=: expected the name of a file, or columns by their names, got .1, 2, 3"),
    ({}, "mu", "data: expected at least one row"),
    ({"creep": [], "force": []}, "mu", "data: expected at least one row"),
    ({"test": ["a", "b"], "who": ["c", "d"]}, "mu", "data: no column is numeric"),
    ({"creep": [1e-3j], "force": [-1]}, "mu", "data: column 'creep': expected numbers"),
    ({"creep": [1e-3], "force": [-1]}, 3, "names=: expected names of options, got 3"),
    ({"creep": [1e-3], "force": [-1]}, None, "names=: expected names of options, got None"),
    ({"creep": [1e-3], "force": [-1]}, "mus", "^names=: 'mus' is not a number .*did you mean 'mu'")])
def test_data_that_are_none(data, names, said):
    with pytest.raises(rollbem.InvalidInput, match=said):
        rollbem.fit(data, names, load=500, support="halfplane")


def interrupt(done, total):
    raise KeyboardInterrupt


def test_designs():
    try:
        found = rollbem.design(**PLANES, minimise="max_pressure", over={"radius": (20, 200)}, subject="half_width<=1.2")
    except rollbem.InvalidInput as error:
        pytest.skip(str(error))
    assert found.variables["radius"] == pytest.approx(107, rel=2e-2)
    assert found.value < found.start and "max_pressure" in repr(found)
    x = np.linspace(-4, 4, 9)
    table = rollbem.design(**PLANES, mu=0, gap={"x": x, "gap": 1e-2 * x**2}, minimise="max_pressure",
                           over={"gap": (-1e-3, 1e-3)}, evaluations=20)
    assert table.gap.shape == x.shape and table.value < table.start
    with pytest.raises(rollbem.InvalidInput, match="subject=: expected RESULT<=X, got 3"):
        rollbem.design(**PLANES, minimise="max_pressure", over={"radius": (20, 200)}, subject=3)
    with pytest.raises(rollbem.InvalidInput, match="one of them"):
        rollbem.design(**PLANES, over={"radius": (20, 200)})
    with pytest.raises(rollbem.Unsolved, match="satisfy all constraints"):
        rollbem.design(**PLANES, minimise="max_pressure", over={"radius": (20, 200)}, subject=["half_width<=0.1", "half_width>=1"])
    best = rollbem.design(**PLANES, minimise="max_pressure", over={"radius": (20, 200)}, evaluations=2)
    assert best.status == "iteration limit" and best.value <= best.start and best.constraints == []
    assert found.constraints[0]["result"] == "half_width" and not found.constraints[0]["at_least"]
    with pytest.raises(rollbem.InvalidInput, match="did you mean|no result"):
        rollbem.design(**PLANES, minimise="max_presure", over={"radius": (20, 200)})
