"""Cracks, derivatives, fits and designs answer as the program does."""

import numpy as np
import pytest
from conftest import run_json

import rollbem

PLANES = dict(support="halfplane", similar=True, load=500.0)
STEADY = dict(PLANES, formulation="steady", creep_ratio=0.5)


def test_cracks():
    c = rollbem.crack(**PLANES, mu=0.0, crack_angle=45, passes=2, from_=-7)
    assert len(c.x) == 242 and c.x[0] == pytest.approx(-7 * 0.8165, rel=1e-3)
    assert c.K_II_max == c.K_II[121:].max()
    assert c.faces["opening"].shape == (40, 242) and c.faces["path_y"][1] < 0
    assert c.growth == {}
    assert "delta_K_II" in c.numbers and "positions" in repr(c)
    assert len(c.to_pandas()) == 242
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
    assert d["q"]["mu"].shape == s.q.shape
    assert rollbem.derivatives(**STEADY)["max_pressure"]["load"] == pytest.approx(s.max_pressure / 1000, rel=1e-3)
    with pytest.raises(rollbem.InvalidInput):
        rollbem.derivatives(**PLANES, formulation="static", increments=3)


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
    assert rollbem.history(**rolled).tolerances == {}
    assert rollbem.solve(**rolled, tolerance="mu=0.02").tolerances == {}
    with pytest.raises(rollbem.InvalidInput, match="given approach"):
        rollbem.history(**{**rolled, "load": None, "approach": 0.01}, tolerance={"mu": 0.02})


def test_fits():
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
    with pytest.raises(rollbem.InvalidInput, match="fit"):
        rollbem.fit(data, "mou", **PLANES)


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
    with pytest.raises(rollbem.InvalidInput, match="did you mean|no result"):
        rollbem.design(**PLANES, minimise="max_presure", over={"radius": (20, 200)})
