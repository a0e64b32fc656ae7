"""Cracks, and what is asked of a case backwards: derivatives, fits to measurements, designs."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _program, _values
from ._case import (Array, Case, Derivatives, Solution, Table, _case, _Named, _uncertain, _unit, crack_option, curve,
                    history)
from ._library import OPTIONS, SOLVED, InvalidInput, Unsolved, lib, texts

_CaseLike = Union[Case, str, os.PathLike, None]


def _text(value: Any) -> str:
    """As the program reads it: numbers to the last bit."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if np.ndim(value) == 1:
        return ",".join(_text(x) for x in value)
    return repr(float(value)) if not float(value).is_integer() else str(int(value))


# ---- Cracks -------------------------------------------------------------------------------


class Crack(_Named):
    """A crack under a passing contact: numbers of the pass, columns over the positions.

    ``faces`` holds ``opening``, ``sliding``, ``pressure``, ``friction`` and ``zone`` (nodes x positions), the places
    ``x``, ``y`` of the nodes and the corners ``path_x``, ``path_y`` of the crack; ``growth`` the columns of a crack that grows.
    """

    faces: "dict[str, Array]"
    growth: "dict[str, Array]"

    def __init__(self, case: Case, handle: Any) -> None:
        self.case = case
        faces = {"opening": "opening", "sliding": "sliding", "pressure": "pressure",
                 "friction": "friction", "zone": "zone", "x": "node.x", "y": "node.y",
                 "path_x": "path.x", "path_y": "path.y"}

        self._arrays = handle.arrays("position", "crack.", copied=True)
        self._numbers = {name: float(np.ravel(x)[0]) for name, x in handle.arrays("crack", "crack.summary.").items()}
        self.growth = handle.arrays("growth", "crack.growth.", copied=True)
        self.faces = {name: handle.array(f"crack.{at}").copy() for name, at in faces.items()}
        self.faces["zone"] = self.faces["zone"].astype(int)

    @property
    def numbers(self) -> dict:
        """The numbers by name."""
        return dict(self._numbers)

    def plot(self, figure: Any = None) -> Any:
        """K_I and K_II over the position of the contact.  Returns the figure."""
        import matplotlib.pyplot

        figure = figure or matplotlib.pyplot.figure()
        axes = figure.add_subplot()
        axes.plot(self.x, self.K_I, label="$K_I$")
        axes.plot(self.x, self.K_II, "--", label="$K_{II}$")
        axes.set_xlabel("position of the contact  [mm]")
        axes.set_ylabel("stress intensity  [MPa mm$^{1/2}$]")
        axes.legend()
        return figure

    def __repr__(self) -> str:
        return (f"<Crack: {len(self.x)} positions; K_I at most {self.K_I_max:.5g}, "
                f"K_II {self.K_II_min:.5g} ... {self.K_II_max:.5g} MPa mm^0.5>")


def crack(case: _CaseLike = None, **options: Any) -> Crack:
    """Passes the contact of a case over a crack in body B: ``crack(rail, crack_angle=30, fluid="trapped")``.

    Options of the crack are those of ``rollbem crack`` with ``_`` for ``-`` (``from_`` for ``from``); the others are
    those of the case.
    """
    own = {crack_option(name): _values.text(name, value) for name, value in options.items() if crack_option(name)}
    whole = _case(case, {name: value for name, value in options.items() if not crack_option(name)})
    handle = whole.handle("crack")
    names = texts([name.replace("_", "-") for name in own])
    status = handle.run("rb_api_crack", len(own), names, texts(list(own.values())))
    if status != SOLVED:
        raise handle.error(status)
    return Crack(whole, handle)


# ---- Derivatives --------------------------------------------------------------------------


def curve_derivatives(case: _CaseLike = None, results: Any = True, start: float = 0.0, stop: float = 1.5,
                      points: int = 61, over: str = "creep-ratio", **options: Any) -> Derivatives:
    """``curve(..., derivatives=results).derivatives``: see :func:`curve`."""
    return curve(_case(case, options), start, stop, points, over, derivatives=results).derivatives


def history_derivatives(case: _CaseLike = None, results: Any = True, **options: Any) -> Derivatives:
    """``history(..., derivatives=results).derivatives``: see :func:`history`."""
    return history(None, _case(case, options), derivatives=results).derivatives


def tolerances(solution: Union[Solution, _CaseLike] = None, *, tolerance: Any, **options: Any) -> "dict[str, float]":
    """Standard deviations of all numbers, to first order, from those of inputs, which are independent.

    Of a sequence of steps: ``{}``, and those of the columns are ``tolerances`` of its ``history``.
    ``tolerance`` as of ``rollbem --tolerance``: ``"mu=0.02,radius=1%"``, or ``{"mu": 0.02, "radius": "1%"}``.
    """
    text = _uncertain(tolerance)
    if not isinstance(solution, Solution):
        solution = _case(solution, options).solve()
    handle = solution._live()
    with handle.lock:
        status = handle.run("rb_api_tolerances", text)
        if status != SOLVED:
            raise handle.error(status)
        found = {name: handle.array(f"tolerance.{name}") for name in solution._numbers}
        return {name: float(x.ravel()[0]) for name, x in found.items() if x is not None and np.isfinite(x).all()}


def derivatives(solution: Union[Solution, _CaseLike] = None, *, smooth: bool = False, **options: Any) -> Derivatives:
    """Derivatives of every number of a solution by every number of its case: ``d["tangential_load"]["mu"]``.

    A pair (left, right) where the two sides differ, NaN where there is none. Names of columns (``"p"``, ``"q"``) give an array with an
    entry per element. In mm, N and MPa; ``d.units`` has the units. ``d.to_pandas()``: a row per result and option. ``smooth``:
    without the jumps where an element changes between stick and slip, as of ``rollbem --smooth-derivatives``.
    """
    if not isinstance(solution, Solution):
        solution = _case(solution, options).solve()
    handle = solution._live()
    with handle.lock:
        status = handle.run("rb_api_smooth_derivatives" if smooth else "rb_api_derivatives")
        if status != SOLVED:
            raise handle.error(status)
        room, inputs = handle.text_room(), []

        def field(name: str) -> Optional[str]:
            text = lib.rb_api_input(handle.at, len(inputs), name.encode(), room, len(room))
            return None if text is None else text.decode()

        while (name := field("name")) is not None:
            inputs.append((name, field("unit")))
        found = Derivatives()
        found.elements = handle.word("elements")
        for result in (*solution._numbers, *solution._arrays):
            array = handle.array(f"derivative.{result}")
            if array is None or np.isnan(array).all():
                continue
            is_column = result in solution._arrays
            sides = np.atleast_2d(array.reshape(-1, 2 * len(inputs)))
            for k, (name, unit) in enumerate(inputs):
                left, right = sides[:, 2 * k].copy(), sides[:, 2 * k + 1].copy()
                same = np.array_equal(left, right, equal_nan=True)
                if not is_column:
                    left, right = float(left[0]), float(right[0])
                found._add(result, name, left if same else (left, right), _unit(result, "column" if is_column else "number", unit))
        if smooth:
            return found
        over_x = {result: {by: handle.array(f"derivative.{result}.{by}") for by in ("gap", "mu")}
                  for result in ("normal_load", "tangential_load", "approach", "creepage")}
        solution._more["over_x"] = {result: {by: array.copy() for by, array in both.items()}
                                    for result, both in over_x.items() if both["gap"] is not None}
    return found


# ---- By the program -----------------------------------------------------------------------


def _arguments(case: Case) -> "list[str]":
    words = []
    for name, text in case._texts.items():
        flag = name in OPTIONS and OPTIONS[name].kind == "flag"
        option = "--" + name.replace("_", "-")
        if not flag:
            words.append(f"{option}={text}")
        elif text == "yes":
            words.append(option)
    return words


def _ask(command: str, case: Case, words: "list[str]", operands: "list[str]",
         purpose: str = "solve") -> "tuple[int, dict]":
    case.handle(purpose)  # refusals of single options in this package's words
    if case.file is not None:
        operands = [*operands, _values.path("case", case.file)]
    code, printed, message = _program._run(command, *words, *_arguments(case), "--json", "--quiet", "--", *operands)
    if not printed:
        raise Unsolved(message)
    return code, json.loads(printed)


class Parameter(NamedTuple):
    """A fitted number: NaN where the data do not tell it."""

    value: float
    interval: "tuple[float, float]"
    deviation: float
    correlation: "dict[str, float]"
    identified: bool


class Fit(_Named):
    """Numbers of a case fitted to measured forces: ``parameters`` by name, and the fitted curve as columns."""

    parameters: "dict[str, Parameter]"
    sentences: "list[str]"

    def __init__(self, answer: Mapping[str, Any]) -> None:
        def number(x: Optional[float]) -> float:
            return float("nan") if x is None else float(x)

        self.parameters = {
            name: Parameter(number(p["value"]), tuple(map(number, p["interval"])), number(p["deviation"]),
                            {other: number(x) for other, x in p["correlation"].items()}, p["identified"])
            for name, p in answer["parameters"].items()}
        self.sentences = list(answer["sentences"])
        self._arrays = {name: np.array([number(x) for x in column]) for name, column in answer["fit"].items()}
        self._arrays["residual"] = np.array([number(x) for x in answer["residuals"]])
        self._numbers = {name: answer[name] for name in ("level", "chi_square", "degrees_of_freedom", "noise", "kappa",
                                                          "iterations")}

    def __getitem__(self, name: str) -> Parameter:
        return self.parameters[name.replace("_", "-")]

    def plot(self, figure: Any = None) -> Any:
        """Points and fitted curve.  Returns the figure."""
        import matplotlib.pyplot

        figure = figure or matplotlib.pyplot.figure()
        axes = figure.add_subplot()
        over, force = list(self._arrays)[:2]
        order = np.argsort(self._arrays[over])
        axes.plot(self._arrays[over], self._arrays[force], "o", label="measured")
        axes.plot(self._arrays[over][order], self._arrays["fitted"][order], label="fitted")
        axes.set_xlabel(over)
        axes.set_ylabel(force)
        axes.legend()
        return figure

    def __repr__(self) -> str:
        return "<Fit: " + ", ".join(f"{name} = {p.value:.5g} ({p.interval[0]:.5g} ... {p.interval[1]:.5g})"
                                    for name, p in self.parameters.items()) + ">"


def fit(data: Union[str, os.PathLike, Table], names: Union[str, Sequence[str]], case: _CaseLike = None,
        sigma: Optional[float] = None, bounds: Optional[Mapping[str, "tuple[float, float]"]] = None,
        start: Optional[Mapping[str, float]] = None, level: float = 0.95, **options: Any) -> Fit:
    """Fits numbers of a case to a measured creep curve, by ``rollbem fit``.

    ``data`` is a file, a dictionary of columns or a ``pandas.DataFrame``: ``creep`` or ``creep_ratio``; ``force``,
    ``force_ratio`` or ``force_over_load``; and ``load``, ``speed``, ``temperature``, ``sigma`` where they vary.
    ``names`` are options, or ``creep_offset``. Numbers are in the units of the case.
    """
    whole = _case(case, options)
    names = [names] if isinstance(names, str) else list(names)

    def program(name: str) -> str:
        return name.replace("_", "-")

    if not isinstance(data, (str, os.PathLike)):
        columns = {str(name): np.asarray(data[name], dtype=float) for name in data}
        if len({len(column) for column in columns.values()}) != 1:
            raise InvalidInput("data: expected columns of one length")
        data = whole._write_table(columns)
    words = ["--fit=" + ",".join(map(program, names)), f"--level={level!r}"]
    if sigma is not None:
        words.append(f"--sigma={float(sigma)!r}")
    if bounds:
        words.append("--bounds=" + ",".join(f"{program(k)}={float(a)!r}:{float(b)!r}" for k, (a, b) in bounds.items()))
    if start:
        words.append("--start=" + ",".join(f"{program(k)}={float(x)!r}" for k, x in start.items()))
    return Fit(_ask("fit", whole, words, [os.fspath(data)])[1])


class Design(_Named):
    """The least or largest of a result: ``value``, ``start``, and the ``variables`` by name."""

    variables: "dict[str, float]"

    def __init__(self, answer: Mapping[str, Any]) -> None:
        design = answer["design"]
        self.variables = {name: v["value"] for name, v in design["variables"].items()}
        self.constraints = design["constraints"]
        table = [v for v in design["variables"].values() if "x" in v]
        self._arrays = ({"x": np.array([v["x"] for v in table]), "gap": np.array([v["value"] for v in table])}
                        if table else {})
        self._numbers = {name: design[name] for name in ("value", "start", "evaluations")}
        self.result, self.status = design["result"], design["status"]

    def __repr__(self) -> str:
        return f"<Design: {self.result} {self.value:.6g}, at the start {self.start:.6g}>"


def design(case: _CaseLike = None, *, minimise: Optional[str] = None, maximise: Optional[str] = None,
           over: Mapping[str, "tuple[float, float]"], subject: Union[str, Sequence[str]] = (),
           span: Optional[float] = None, evaluations: int = 200, **options: Any) -> Design:
    """The minimum or maximum of a result over numbers of a case, by ``rollbem design``.

    ``design(load=500, minimise="max_pressure", over={"radius": (20, 200)}, subject=["half_width<=1.2"])``; ``over={"gap":
    (a, b)}`` varies every value of the table of the gap. Numbers are in the units of the case.
    """
    whole = _case(case, options)
    words = ["--over=" + ",".join(f"{k.replace('_', '-')}={float(a)!r}:{float(b)!r}" for k, (a, b) in over.items()),
             f"--evaluations={int(evaluations)}"]
    for option, result in (("--minimise", minimise), ("--maximise", maximise)):
        if result is not None:
            words.append(f"{option}={result}")
    subject = [subject] if isinstance(subject, str) else list(subject)
    if subject:
        words.append("--subject=" + ",".join(subject))
    if span is not None:
        words.append(f"--span={float(span)!r}")
    return Design(_ask("design", whole, words, [])[1])
