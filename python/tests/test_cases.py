"""Cases as mappings, tables as arrays, studies with impossible combinations, pictures of several cases."""

import copy
import pickle

import numpy as np
import pytest

import rollbem

PLANES = dict(support="halfplane", similar=True, formulation="steady", contact_elements=16)
LOADED = dict(PLANES, load=500.0, creep_ratio=0.4)


def test_a_case_is_a_mapping_of_its_values():
    case = rollbem.Case(load="1kN/mm", **PLANES)
    assert "load" in case and "contact-elements" in case and "lod" not in case and 3 not in case
    assert list(case) == list(rollbem.OPTIONS) and len(case) == len(list(case))
    values = dict(case)
    assert values["load"] == 1000 == case["load"] and values["similar"] is True and values["mu"] == case["mu"]
    assert list(case.items()) == list(values.items()) and case.values() == list(values.values())
    with pytest.raises(KeyError):
        case["lod"]


def test_cases_are_equal_if_their_values_are():
    case, x = rollbem.Case(load=1000, **PLANES), np.linspace(-2, 2, 21)
    same = rollbem.Case({"load": "1kN/mm", **PLANES})
    assert case == same and hash(case) == hash(same) and len({case, same}) == 1
    assert case == rollbem.Case(case) == copy.deepcopy(case) == pickle.loads(pickle.dumps(case)) == case.but(mu=case["mu"])
    assert case != case.but(mu=0.2) and case != "case" and case.but(mu=-1.0 + 1.2) == case.but(mu=-1.0 + 1.2)
    gaps = [rollbem.Case(gap=gap, load=500, **PLANES)
            for gap in (np.column_stack([x, x**2 / 100]), {"x": x, "gap": x**2 / 100}, {"x": x, "gap": x**2 / 101})]
    assert gaps[0] == gaps[1] != gaps[2]


def test_a_gap_is_an_array_of_two_columns():
    x = np.linspace(-2, 2, 81)
    by_array, by_name = (rollbem.solve(gap=gap, load=500, **PLANES)
                         for gap in (np.column_stack([x, x**2 / 100]), {"x": x, "gap": x**2 / 100}))
    assert by_array.approach == by_name.approach
    lists = [[float(a), float(a) ** 2 / 100] for a in x]
    assert rollbem.solve(gap=lists, load=500, **PLANES).approach == by_name.approach
    for wrong in (np.zeros((5, 1)), np.zeros((0, 2))):
        with pytest.raises(rollbem.InvalidInput, match="gap=: expected columns, an array of N x 2"):
            rollbem.Case(gap=wrong)
    with pytest.raises(rollbem.InvalidInput, match="mu=: expected"):
        rollbem.Case(mu=np.zeros((2, 2)))


@pytest.mark.parametrize("value, want", [(0, False), (1, True), (0.0, False), (np.bool_(True), True), ("no", False)])
def test_flags_are_also_numbers(value, want):
    assert rollbem.Case(similar=value, support="halfplane")["similar"] is want
    with pytest.raises(rollbem.InvalidInput, match="similar="):
        rollbem.Case(similar=2)


def test_studies_take_units_and_words():
    study = rollbem.sweep(load=["100kN/m", "0.2 kN/mm", 300], creep_ratio=[0.3, 0.6], **PLANES)
    assert study.axes["load"].tolist() == [100, 200, 300]
    assert np.allclose(study.normal_load[:, 0], [100, 200, 300])
    words = rollbem.sweep(support=["halfplane", "hub"], load=[300.0, 400.0], contact_elements=12)
    assert words.axes["support"].tolist() == ["halfplane", "hub"] and np.all(words.status == 0)
    assert list(words.columns()["support"]) == ["halfplane"] * 2 + ["hub"] * 2
    pytest.importorskip("matplotlib")
    words.plot(show="max_pressure"), words.plot(show="max_pressure", over="support")
    with pytest.raises(rollbem.InvalidInput, match="numbers"):
        words.plot(map=True)


def test_a_study_survives_an_impossible_combination():
    with pytest.warns(rollbem.Note, match="2 of 6 combinations are impossible .*mu=-0.3, creep_ratio=0.3: mu=: expected"):
        study = rollbem.sweep(mu=[0.1, -0.3, 0.5], creep_ratio=[0.3, 0.6], load=500.0, derivatives="tangential_load:mu",
                              **PLANES)
    assert study.status.tolist() == [[0, 0], [-1, -1], [0, 0]]
    assert np.isnan(study.force_ratio[1]).all() and np.isfinite(study.force_ratio[::2]).all()
    slope = study.derivatives["tangential_load"]["mu"]
    assert slope.shape == (3, 2) and np.isnan(slope[1]).all() and np.isfinite(slope[::2]).all()
    single = rollbem.solve(mu=0.5, creep_ratio=0.6, load=500.0, **PLANES)
    assert study.tangential_load[2, 1] == single.tangential_load
    with pytest.warns(rollbem.Note, match="1 of 2 combinations is impossible"):
        cracks = rollbem.sweep(contact_elements=[16, -1], crack_angle=30, load=500.0, creep_ratio=0.4, support="halfplane",
                               similar=True, formulation="steady")
    assert np.isfinite(cracks.K_I_max[0]) and np.isnan(cracks.K_I_max[1])
    with pytest.raises(rollbem.InvalidInput, match="mu=: expected"):  # nothing is left
        rollbem.sweep(mu=[-0.1, -0.2], load=500.0, **PLANES)
    with pytest.raises(rollbem.InvalidInput, match="did you mean 'mu'"):
        rollbem.sweep(mux=[0.1, 0.2], **PLANES)


@pytest.mark.parametrize("name, meant", [("tangental_load", "tangential_load"), ("Q", "tangential_load"), ("P", "normal_load"),
                                         ("p0", "max_pressure"), ("tangential_force", "tangential_load"), ("pmax", "max_pressure"),
                                         ("aproach", "approach"), ("halfwidth", "half_width")])
def test_misspelt_results_are_named(name, meant):
    solution = rollbem.solve(**LOADED)
    with pytest.raises(AttributeError, match=f"did you mean '{meant}'"):
        getattr(solution, name)
    with pytest.raises(KeyError, match=f"did you mean '{meant}'"):
        solution.derivatives[name]
    study = rollbem.sweep(mu=[0.1, 0.2], **LOADED)
    pytest.importorskip("matplotlib")
    with pytest.raises(rollbem.InvalidInput, match=f"did you mean '{meant}'"):
        study.plot(show=name)


def test_units_are_those_of_the_table():
    pytest.importorskip("pandas")
    units = rollbem.solve(**LOADED).to_pandas().attrs["units"]
    assert units["p"] == "MPa" and "slip" not in units  # not "elements", which is the unit of the number slip
    steps = rollbem.history({"distance": [0, 0.5], "creep": [0, 1e-3]}, load=500.0, support="halfplane", contact_elements=12)
    assert steps.to_pandas().attrs["units"]["slip"] == "elements"


def test_stress_below_given_tractions():
    rows = np.array([[-1, 1, 0], [1, 1, 0]])
    below = rollbem.stress(tractions=rows, points=[[1.0, 0.1]])
    assert [below.sxx[0], below.syy[0], below.sxy[0]] == pytest.approx([-0.468222, -0.499974, -0.317516], abs=1e-6)
    assert below.solution.normal_load == 2 and np.isnan(below.solution.creepage)
    sheared = rollbem.stress(tractions={"x": [-1, 1], "p": [0, 0], "q": [1, 1]}, points=[[1.0, -0.1]], body="b", similar=True)
    assert sheared.sxx[0] == pytest.approx(1.590421, abs=1e-6)
    assert rollbem.stress(tractions=rows[:, :2], points=[[0.5, 0.25]]).sxx[0] == pytest.approx(-0.620906, abs=1e-6)
    metre = rollbem.stress(tractions=rows * [1e-3, 1e6, 1], points=[[1e-3, 1e-4]], units="si")
    assert metre.sxx[0] == pytest.approx(-0.468222e6, rel=1e-5) and metre.solution.normal_load == pytest.approx(2000)
    for bad, says in ((dict(load=100), "^load=: with given tractions"), (dict(support="hub"), "support"),
                      (dict(tractions=rows[::-1]), "x has to increase"), (dict(tractions=[[1, 2, 3, 4]]), "expected x, p and q")):
        with pytest.raises(rollbem.InvalidInput, match=says):
            rollbem.stress(**{"tractions": rows, **bad})


def test_fretting_is_a_part_of_the_solution():
    steps = rollbem.history(
        {"force_ratio": [0, 0.6, -0.6, 0.6]}, fretting=True, load=500.0, mu=0.5, **{**PLANES, "formulation": "static"}
    )
    solution = steps.solution
    assert solution.work_per_cycle == pytest.approx((solution.fretting_work * solution.h).sum())
    assert solution.ruiz_2_max == solution.ruiz_2.max() > 0 and solution.swt_max >= solution.swt.max()


def test_pictures_of_several_cases():
    pyplot = pytest.importorskip("matplotlib").pyplot
    one, other = rollbem.solve(**LOADED), rollbem.solve(**{**LOADED, "load": 700.0})
    figure = one.plot(label="500")
    assert other.plot(figure, label="700") is figure and len(figure.axes) == 2
    names = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert names == ["±μp", "pressure p, 500", "friction q, 500", "pressure p, 700", "friction q, 700"]
    figure, axes = pyplot.subplots(1, 2)
    assert one.plot(ax=axes[0]) is figure and other.plot(ax=axes[1]) is figure and len(figure.axes) == 2
    assert len(axes[0].get_lines()) == len(axes[1].get_lines()) > 3
    curves = rollbem.curve(mu=[0.1, 0.3], points=4, load=500.0, **PLANES)
    assert len(curves.plot().axes[0].get_lines()) == 4  # two, each with Carter's
    figure, ax = pyplot.subplots()
    curves[0].plot(ax=ax, label="dry"), curves[1].plot(ax=ax, label="wet")
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["dry", "Carter", "wet"]
    rollbem.stress(one, grid=(5, 4)).plot(ax=pyplot.subplots()[1])
    rollbem.crack(LOADED, crack_elements=6).plot(ax=pyplot.subplots()[1], label="30 degrees")
    with pytest.raises(rollbem.InvalidInput, match="ax=: expected axes"):
        one.plot(ax="axes")
    drawn = one.plot(dimensionless=True).axes[0]
    pressure, friction = (line for line in drawn.get_lines() if line.get_label() in ("pressure p", "friction q"))
    assert max(pressure.get_xdata()) == pytest.approx(max(one.x) / one.half_width)
    assert max(pressure.get_ydata()) == pytest.approx(max(one.p) / one.max_pressure)
    assert min(friction.get_ydata()) == pytest.approx(min(one.q) / one.value("mu") / one.max_pressure)
    for body in ("a", "b"):
        axes = rollbem.stress(one, grid=(5, 4), body=body).plot(dimensionless=True).axes[0]
        assert axes.get_ylabel() == "depth / a" and axes.get_ylim()[0] > axes.get_ylim()[1] == 0
    wheel = rollbem.stress(support="hub", load=1e5, contact_elements=12, grid=(9, 5), whole=True)
    assert np.hypot(wheel.x, wheel.y - 50)[0] == pytest.approx(50) and wheel.y[0, 0] == pytest.approx(100)
    assert np.hypot(wheel.x, wheel.y - 50)[-1] == pytest.approx(15)  # its hub
    contours = wheel.plot().axes[0]
    assert contours.get_xlim()[1] == pytest.approx(-contours.get_xlim()[0]) and contours.get_ylim()[0] == pytest.approx(100)
    for wrong in ({"depth": 1}, {"points": [[0, 1]]}):
        with pytest.raises(rollbem.InvalidInput, match="not together with"):
            rollbem.stress(support="hub", load=1e5, whole=True, **wrong)
    with pytest.raises(rollbem.InvalidInput, match="half-plane has no end"):
        rollbem.stress(one, whole=True)
    pyplot.close("all")


def test_every_result_has_a_frame(tmp_path):
    pandas = pytest.importorskip("pandas")
    assert list(rollbem.lcp([[2, 1], [1, 2]], [-5, -6]).to_pandas()) == ["z", "w"]
    together = rollbem.curve(mu=[0.1, 0.3], points=4, load=500.0, **PLANES).to_pandas()
    assert len(together) == 8 and together["mu"].tolist() == [0.1] * 4 + [0.3] * 4
    design = rollbem.design(LOADED, minimise="max_pressure", over={"radius": (40, 60)})
    assert isinstance(design.to_pandas(), pandas.DataFrame)
    from conftest import run

    path = tmp_path / "result.json"
    path.write_text(run("--json", "--quiet", **LOADED).stdout)
    frame = rollbem.check(path).to_pandas()
    assert frame["valid"].all() and len(frame) >= 1


def test_columns_are_blamed_by_their_option():
    plane = dict(support="halfplane", base_young=1000, base_poisson=0.3, load=5, mu=0)
    with pytest.raises(rollbem.InvalidInput, match="^layers=, row 2: thickness: expected a number > 0, got -1"):
        rollbem.solve(**plane, layers=[[0.5, 5000, 0.3], [-1, 2000, 0.3]])
    with pytest.raises(rollbem.InvalidInput, match="^layers=: unknown column 'a'"):
        rollbem.solve(**plane, layers={"a": [1, 2], "b": [2, 3], "c": [3, 4]})
    with pytest.raises(rollbem.InvalidInput, match="^gap=, row 3: expected an x larger"):
        rollbem.solve(support="halfplane", load=5, gap=[[-1, 1], [0, 0], [0, 0.5], [1, 1]])


def test_accuracy_names_the_mesh_it_ended_with():
    found = rollbem.solve(support="halfplane", half_width=1.0, formulation="steady", creep_ratio=0.4, accuracy=1e-2)
    assert found.accuracy_elements >= 24 and len(found.x) >= found.accuracy_elements
    assert np.isnan(found.accuracy_boundary)  # no wheel
    assert found.errors["max_pressure"] <= 1e-2 * found.max_pressure
    wheel = rollbem.solve(support="hub", half_width=1.0, formulation="steady", creep_ratio=0.4, accuracy=3e-2)
    assert wheel.accuracy_elements >= 12 and wheel.accuracy_boundary >= 1.0
    assert np.isnan(rollbem.solve(support="halfplane", half_width=1.0).accuracy_elements)
