"""Every argument and every result of the package in mm, SI and inch: the same quantities."""

import numpy as np
import pytest

import rollbem
from rollbem._library import CRACK_OPTIONS, OPTIONS, RESULTS, unit_of

LENGTH, FORCE = {"si": 1e-3, "inch": 1 / 25.4}, {"si": 1.0, "inch": 1 / 4.4482216152605}
# powers of length and force
KINDS = {"mm": (1, 0), "mm2": (2, 0), "MPa": (-2, 1), "N/mm": (-1, 1), "N": (0, 1), "mm/s": (1, 0),
         "mm/MPa": (3, -1), "1/MPa": (2, -1), "MPa/mm": (-3, 1), "MPa.mm^0.5": (-1.5, 1)}


def factor(system, unit):
    if system == "mm" or unit not in KINDS:
        return 1.0
    length, force = KINDS[unit]
    return LENGTH[system] ** length * FORCE[system] ** force


def given(system, **options):
    """Options of mm, N, MPa as plain numbers of a system."""
    found = {"units": system}
    for name, value in options.items():
        option = OPTIONS.get(name) or CRACK_OPTIONS.get(name)
        scale = factor(system, option.unit) if option and option.kind == "number" else 1.0
        found[name] = value if scale == 1.0 or isinstance(value, (str, bool)) else np.multiply(value, scale).tolist()
    return found


STEEL = dict(similar=True, support="halfplane", radius=46.5, young=205000, poisson=0.3, contact_elements=20)
SYSTEMS = ("si", "inch")


def units(table):
    return {name: row.unit for name, row in RESULTS[table].items()}


def same(system, a, b, known, but=()):
    """Numbers and arrays by name, each with its unit."""
    assert set(a) == set(b)
    seen = 0
    for name in set(a) - {"residual", "iterations", "load_error", "residual_gap", "residual_slip",
                          "residual_friction", "assembly", "factor", "condense", "lcp", "total", *but}:
        scale = factor(system, known.get(name, "1"))
        x, y = np.asarray(a[name], float) * scale, np.asarray(b[name], float)
        assert x.shape == y.shape, name
        largest = np.nanmax(np.abs(x), initial=0)
        assert np.allclose(x, y, rtol=1e-6, atol=1e-6 * largest + 1e-13 * scale, equal_nan=True), (name, x, y)
        seen += scale != 1.0 and largest > 0
    return seen


def each(call, **options):
    """What a call gives in mm, and in each other system."""
    mm = call(**given("mm", **options))
    for system in SYSTEMS:
        yield system, mm, call(**given(system, **options))


def test_solutions():
    for options in (dict(STEEL, load=700, shift=0.002, datum=120, zone=1.25),
                    dict(STEEL, load=700, formulation="steady", creep=2e-3, interlayer_normal=2e-6, error=True),
                    dict(STEEL, load=700, force=90, yield_stress=90, hardening=400, formulation="steady")):
        for system, a, b in each(rollbem.solve, **options):
            assert same(system, a.numbers, b.numbers, units("number")) > 8
            assert same(system, a.errors, b.errors, units("number")) >= 0
            assert same(system, a.columns(), b.columns(), units("column"), but=("gap", "slip")) > 5
            assert a.case["radius"] * factor(system, "mm") == pytest.approx(b.case["radius"], rel=1e-12)
            assert b.to_pandas().attrs["units"]["p"] == unit_of(system, "MPa")
            assert unit_of(system, "N/mm") in repr(b) and unit_of(system, "MPa") in repr(b)
            assert b.x[1] - b.x[0] == pytest.approx((a.x[1] - a.x[0]) * factor(system, "mm"))


def test_derivatives():
    for system, a, b in each(rollbem.solve, **STEEL, load=700, shift=0.002, zone=1.25):
        a, b = rollbem.derivatives(a), rollbem.derivatives(b)
        assert set(a) == set(b)
        for result in ("max_pressure", "approach", "tangential_load", "half_width"):
            for name in ("load", "radius", "young", "mu", "shift"):
                scale = factor(system, RESULTS["number"][result].unit) / factor(system, OPTIONS[name].unit)
                x, y = (np.ravel(of[result][name])[-1] for of in (a, b))
                assert y == pytest.approx(x * scale, rel=1e-6, abs=1e-9 * scale, nan_ok=True), (result, name)
        assert b.units["max_pressure"]["load"] == {"si": "Pa/(N/m)", "inch": "psi/(lbf/in)"}[system]


def test_curves():
    for system, a, b in each(lambda **options: rollbem.curve(points=3, tolerance="mu=0.1", derivatives="tangential_load:load", **options),
                             **STEEL, load=700):
        assert same(system, a.columns(), b.columns(), {**units("point"), "deviation_tangential_load": "N/mm",
                                                       "deviation_dissipation": "N/mm", "deviation_torque_a": "N"}) > 2
        assert a.half_width * factor(system, "mm") == pytest.approx(b.half_width)
        assert unit_of(system, "mm") in b.plot().axes[0].get_title()
    soft = {**STEEL, "young": 10, "relaxation_time": 0.01, "relaxation_ratio": 1, "load": 20, "free_axle": True}
    for system in SYSTEMS:
        scale = factor(system, "mm/s")
        a, b = (rollbem.curve(over="speed", start=10 * s, stop=1000 * s, points=3, **given(of, **soft))
                for of, s in (("mm", 1.0), (system, scale)))
        assert same(system, a.columns(), b.columns(), units("point")) > 2
        assert b.speed[0] == pytest.approx(10 * scale)


def test_stresses():
    for system, a, b in each(rollbem.solve, **STEEL, load=700, shift=0.002):
        mm = factor(system, "mm")
        for arguments in (lambda s: dict(grid=(4, 3), depth=1.5 * s), lambda s: dict(points=[[0, 0.5 * s], [0.1 * s, 0.3 * s]])):
            x, y = rollbem.stress(a, **arguments(1.0)), rollbem.stress(b, **arguments(mm))
            assert same(system, x.columns(), y.columns(), units("stress")) > 5
            for name, of in x.maxima.items():
                assert y.maxima[name].value == pytest.approx(of.value * factor(system, "MPa"), rel=1e-6)
                assert y.maxima[name].y == pytest.approx(of.y * mm, rel=1e-5, abs=1e-6 * mm)
            assert unit_of(system, "MPa") in repr(y)


def test_histories_tell_where_the_contact_jumps():
    of = dict(support="halfplane", similar=True, young=210000, radius=100, half_width=1, mu=0.2, formulation="static",
              contact_elements=30, datum=36.788, datum_b=36.788, friction_law="exponential", mu_fall=0.1, slip_scale=1,
              memory=5e-5)
    found = []
    for system in ("mm", *SYSTEMS):
        with pytest.warns(rollbem.Note, match="jumps to full sliding"):
            found.append(rollbem.history({"shift [mm]": [0.0, 3e-3, 6e-3]}, **given(system, **of)))
        mm, load = factor(system, "mm"), factor(system, "N/mm")
        assert found[-1].jump_row == 3 and 3e-3 < found[-1].jump_shift / mm < 6e-3
        assert np.isclose(found[-1].jump_shift / mm, found[0].jump_shift)
        assert np.isclose(found[-1].jump_force / load, found[0].jump_force)
        assert abs(found[-1].jump_force) > abs(found[-1].tangential_load[-1])
    assert np.isnan(rollbem.history({"shift": [0.0, 1e-4]}, load=500, formulation="static").jump_row)


def test_histories_and_wear():
    for system in SYSTEMS:
        load, mm = factor(system, "N/mm"), factor(system, "mm")
        a, b = (rollbem.history({"load": [100 * p, 200 * p], "shift": [0.0, 5e-4 * s]}, **given(of, **STEEL))
                for of, p, s in (("mm", 1.0, 1.0), (system, load, mm)))
        assert same(system, a.columns(), b.columns(), units("step")) > 5
        assert np.allclose(a.p * factor(system, "MPa"), b.p, atol=1e-6 * b.p.max()) and np.allclose(a.x * mm, b.x)
        for more in (dict(slide=1e5), dict(cycles=1e5)):
            one = dict(STEEL, load=500) if "slide" in more else dict(STEEL, load=500, shift=2e-3)
            a, b = (rollbem.wear(coefficient=1e-10 * factor(of, "1/MPa"), steps=2, quarter=3,
                                 **{name: x * (factor(of, "mm") if name == "slide" else 1) for name, x in more.items()},
                                 **given(of, **one)) for of in ("mm", system))
            known = {**units("wear"), "way": "mm" if "slide" in more else "1", "work": "N/mm" if "slide" in more else "N"}
            assert same(system, a.columns(), b.columns(), known) > 3
            assert np.allclose(a.depth * mm, b.depth, atol=1e-6 * b.depth.max())


def test_cracks_and_studies():
    for system, a, b in each(rollbem.crack, **STEEL, half_width=1.0, mu=0.1, crack_length=0.5, crack_elements=20,
                             remote_stress=50.0):
        assert same(system, a.numbers, b.numbers, units("crack"), but=("K_II_max_at", "K_I_max_at", "K_II_min_at")) > 3
        assert same(system, a.columns(), b.columns(), units("position")) > 2
        assert np.allclose(a.faces["opening"] * factor(system, "mm"), b.faces["opening"], atol=1e-9)
        assert unit_of(system, "mm") in b.plot().axes[0].get_xlabel()
    for system, a, b in each(lambda **o: rollbem.sweep(derivatives="max_pressure:load", tolerance="mu=0.1", **o),
                             **STEEL, load=[500, 700], shift=1e-3):
        known = {**units("number"), "load": "N/mm"}
        known.update({f"deviation_{name}": unit for name, unit in known.items()})
        x, y = a.columns(), b.columns()
        scale = factor(system, "MPa") / factor(system, "N/mm")
        assert np.allclose(x.pop("d_max_pressure_by_load") * scale, y.pop("d_max_pressure_by_load"), rtol=1e-6)
        assert same(system, x, y, known) > 5
    with pytest.raises(rollbem.InvalidInput, match="units"):
        rollbem.sweep(units=["mm", "si"], load=500)


def test_fits_and_designs():
    creep, force = np.array([5e-4, 1e-3, 2e-3, 3e-3, 5e-3]), np.array([50.0, 88, 132, 146, 150])
    for system in SYSTEMS:
        load = factor(system, "N/mm")
        a, b = (rollbem.fit({"creep": -creep, "force": force * s}, ["load", "mu"], bounds={"load": (100 * s, 900 * s)},
                            start={"load": 500 * s}, **given(of, **STEEL)) for of, s in (("mm", 1.0), (system, load)))
        assert b["load"].value == pytest.approx(a["load"].value * load, rel=1e-5)
        assert b.noise == pytest.approx(a.noise * load, rel=1e-5) and np.allclose(a.fitted * load, b.fitted, rtol=1e-5)
        if rollbem.design is not None:
            one = dict(STEEL, load=100, mu=0)
            a, b = (rollbem.design(minimise="max_pressure", over={"radius": (30 * s, 90 * s)}, **given(of, **one))
                    for of, s in (("mm", 1.0), (system, factor(system, "mm"))))
            assert b.value == pytest.approx(a.value * factor(system, "MPa"), rel=1e-6)
            assert b.variables["radius"] == pytest.approx(a.variables["radius"] * factor(system, "mm"), rel=1e-6)
