"""Cracks, and what is asked of a case backwards: derivatives, fits to measurements, designs."""

from __future__ import annotations

import os
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _values, pictures
from ._case import (Array, Case, Derivatives, Solution, Table, _case, _CaseLike, _Named, _uncertain, _unit, _warn,
                    crack_option, curve, history)
from ._library import SOLVED, InvalidInput, Progress, doubles, in_keywords, lib, texts


# ---- Cracks -------------------------------------------------------------------------------


class Crack(_Named):
    """A crack under a passing contact: numbers of the pass, columns over the positions.

    ``faces`` holds ``opening``, ``sliding``, ``pressure``, ``friction`` and ``zone`` (nodes x positions), the places
    ``x``, ``y`` of the nodes and the corners ``path_x``, ``path_y`` of the crack; ``growth`` the columns of a crack that grows.
    """

    faces: "dict[str, Array]"
    growth: "dict[str, Array]"

    def __init__(self, case: Case, handle: Any) -> None:
        self.case, self._system = case, handle.value("units")
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

    _tables = ("position", "crack")

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None) -> Any:
        """K_I and K_II over the position of the contact.  Returns the figure; ``ax``, ``label`` as of a solution."""
        figure, (axes,) = pictures._figure(figure, 1, ax)
        axes.plot(self.x, self.K_I, label=pictures._named_line(axes, label, "$K_I$"))
        axes.plot(self.x, self.K_II, "--", label=pictures._named_line(axes, label, "$K_{II}$"))
        axes.set_xlabel(f"position of the contact  [{self._in('mm')}]")
        axes.set_ylabel(f"stress intensity  [{self._in('MPa.mm^0.5').replace('.', ' ', 1).replace('^0.5', '$^{1/2}$')}]")
        axes.legend()
        return figure

    def __repr__(self) -> str:
        return (f"<Crack: {len(self.x)} positions; K_I at most {self.K_I_max:.5g}, "
                f"K_II {self.K_II_min:.5g} ... {self.K_II_max:.5g} {self._in('MPa.mm^0.5').replace('.', ' ', 1)}>")


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


def _solved(solution: Union[Solution, _CaseLike], options: "dict[str, Any]") -> Solution:
    if isinstance(solution, Solution):
        return solution.case.but(**options).solve() if options else solution
    return _case(solution, options).solve()


def tolerances(solution: Union[Solution, _CaseLike] = None, *, tolerance: Any, **options: Any) -> "dict[str, float]":
    """Standard deviations of all numbers, to first order, from those of inputs, which are independent.

    Of a sequence of steps: ``{}``, and those of the columns are ``tolerances`` of its ``history``.
    ``tolerance`` as of ``rollbem --tolerance``: ``"mu=0.02,radius=1%"``, or ``{"mu": 0.02, "radius": "1%"}``.
    """
    text = _uncertain(tolerance)
    solution = _solved(solution, options)
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
    entry per element. In the units of the case, which ``d.units`` names. ``d.to_pandas()``: a row per result and option. ``smooth``:
    without the jumps where an element changes between stick and slip, as of ``rollbem --smooth-derivatives``.
    """
    solution = _solved(solution, options)
    if solution.history is not None:
        raise InvalidInput("derivatives: this case has several steps; history(..., derivatives=...) has those after each")
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
                found._add(result, name, left if same else (left, right), _unit(result, "column" if is_column else "number", unit, solution._system))
        if smooth:
            return found
        over_x = {result: {by: handle.array(f"derivative.{result}.{by}") for by in ("gap", "mu")}
                  for result in ("normal_load", "tangential_load", "approach", "creepage")}
        solution._more["over_x"] = {result: {by: array.copy() for by, array in both.items()}
                                    for result, both in over_x.items() if both["gap"] is not None}
    return found


# ---- Fits and designs ---------------------------------------------------------------------


class Parameter(NamedTuple):
    """A fitted number: NaN where the data do not tell it."""

    value: float
    interval: "tuple[float, float]"
    deviation: float
    correlation: "dict[str, float]"
    identified: bool
    mesh: float  # what the mesh leaves in the value, of fit(error=True); NaN: not known


class Fit(_Named):
    """Numbers of a case fitted to measured forces: ``parameters`` by name, and the fitted curve as columns."""

    parameters: "dict[str, Parameter]"
    sentences: "list[str]"

    def __init__(self, names: Sequence[str], handle: Any, level: float) -> None:
        self._system = handle.value("units")
        columns = [handle.array(f"fit.{name}") for name in
                   ("value", "interval.from", "interval.to", "deviation", "identified", "mesh")]
        correlation = np.atleast_2d(handle.array("fit.correlation"))
        self.parameters = {}
        for j, name in enumerate(names):
            value, low, high, deviation, identified, mesh = (float(column[j]) for column in columns)
            others = {other: float(correlation[i, j]) for i, other in enumerate(names) if i != j}
            self.parameters[name] = Parameter(value, (low, high), deviation, others, identified == 1.0, mesh)
        self.sentences = [in_keywords(line) for line in handle.word("fit.sentences").splitlines()]
        self._arrays = {name: array.copy() for name in ("creep", "creep_ratio", *_FORCES, "fitted", "band")
                        if (array := handle.array(f"fit.{name}")) is not None}
        force = next(name for name in _FORCES if name in self._arrays)
        self._arrays["residual"] = self._arrays[force] - self._arrays["fitted"]
        numbers = {name: float(handle.array(f"fit.{name}")[0])
                   for name in ("chi_square", "degrees_of_freedom", "noise", "kappa", "iterations")}
        self._numbers = {"level": level, **numbers, **{name: int(numbers[name]) for name in ("degrees_of_freedom", "iterations")}}

    def __getitem__(self, name: str) -> Parameter:
        return self.parameters[name.replace("_", "-")]

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None) -> Any:
        """Points and fitted curve.  Returns the figure; ``ax``, ``label`` as of a solution."""
        figure, (axes,) = pictures._figure(figure, 1, ax)
        over, force = list(self._arrays)[:2]
        order = np.argsort(self._arrays[over])
        axes.plot(self._arrays[over], self._arrays[force], "o", label=pictures._named_line(axes, label, "measured"))
        axes.plot(self._arrays[over][order], self._arrays["fitted"][order],
                  label=pictures._named_line(axes, label, "fitted"))
        axes.set_xlabel(over)
        axes.set_ylabel(force)
        axes.legend()
        return figure

    def __repr__(self) -> str:
        return "<Fit: " + ", ".join(f"{name} = {p.value:.5g} ({p.interval[0]:.5g} ... {p.interval[1]:.5g})"
                                    for name, p in self.parameters.items()) + ">"


def _assigned(name: str, of: Optional[Mapping[str, Any]], ends: int) -> Optional[bytes]:
    """``{"mu": (0.1, 0.6)}`` as the library reads it: ``mu=0.1:0.6``; texts may have units."""
    if not of:
        return None
    if not isinstance(of, Mapping):
        raise InvalidInput(f"{name}=: expected a dictionary, got {of!r}")

    def text(key: str, value: Any) -> str:
        values = list(value) if ends == 2 and np.ndim(value) == 1 and not isinstance(value, str) else [value]
        if len(values) != ends:
            raise InvalidInput(f"{name}=: expected {key}: (from, to), got {value!r}")
        return ":".join(_values.text(f"{name} of {key}", x) for x in values)

    return ",".join(f"{str(key).replace('_', '-')}={text(key, value)}" for key, value in of.items()).encode()


_FORCES = ("force", "force_ratio", "force_over_load")
_MEASURED = ("creep", *_FORCES, "load", "speed", "temperature", "sigma")


def _columns(data: Table) -> "dict[str, Array]":
    """Those that are numbers; others, such as the names of tests, are left out where nobody reads them."""
    if not hasattr(data, "keys") or np.ndim(data) == 1:  # a Series is one column without a name
        raise InvalidInput(f"data=: expected the name of a file, or columns by their names, got {_values.shown(data)}")
    found = {}
    for name in data:
        try:
            column = np.asarray(data[name])
            if column.dtype.kind == "c":
                raise TypeError
            found[str(name)] = column.astype(float)
        except (TypeError, ValueError):
            if str(name).lower().startswith(_MEASURED):
                raise InvalidInput(f"data: column {name!r}: expected numbers") from None
    if len(data) > 0 and not found:
        raise InvalidInput("data: no column is numeric; expected creep or creep_ratio, and a force")
    if all(column.size == 0 for column in found.values()):
        raise InvalidInput("data: expected at least one row")
    if len({column.shape for column in found.values()}) != 1 or any(column.ndim != 1 for column in found.values()):
        raise InvalidInput("data: expected columns of one length")
    return found


def fit(data: Union[str, os.PathLike, Table], names: Union[str, Sequence[str]], case: _CaseLike = None,
        sigma: Optional[float] = None, bounds: Optional[Mapping[str, "tuple[float, float]"]] = None,
        start: Optional[Mapping[str, float]] = None, level: float = 0.95, progress: Progress = None,
        **options: Any) -> Fit:
    """Fits numbers of a case to a measured creep curve, as ``rollbem fit``.

    ``data`` is a file, a dictionary of columns or a ``pandas.DataFrame``: ``creep`` or ``creep_ratio``; ``force``,
    ``force_ratio`` or ``force_over_load``; and ``load``, ``speed``, ``temperature``, ``sigma`` where they vary.
    ``names`` are options, or ``creep_offset``. Numbers are in the units of the case.
    Intervals hold the noise in the data; with ``error=True`` each parameter has its ``mesh``, what the elements leave.
    A number that the data do not tell is NaN; a warning (:class:`Note`, also in ``sentences``) says so.
    ``progress(done, 0)`` is called with the number of steps now and then. A fit that does not converge raises
    :class:`Unsolved`, whose ``solution`` has the numbers so far, for ``start=``.
    """
    whole = _case(case, options)
    names = [name.replace("_", "-") for text in _values.texts("names", names, "names of options") for name in text.split(",")]
    handle = whole.handle("solve")
    level = _values.number("level", level)
    words = (_values.word("names", ",".join(names), "names of options"), _assigned("start", start, 1),
             _assigned("bounds", bounds, 2), float("nan") if sigma is None else _values.number("sigma", sigma), level)
    if isinstance(data, (str, bytes, os.PathLike)):
        status = handle.run("rb_api_fit_file", os.fsencode(_values.path("data", data)), *words, progress=progress)
    else:
        columns = _columns(data)
        table = np.concatenate(list(columns.values()))
        status = handle.run("rb_api_fit", len(columns), texts(list(columns)), len(table) // len(columns), doubles(table),
                            *words, progress=progress)
    if status == SOLVED:
        found = Fit(names, handle, level)
        _warn(found.sentences)
        return found
    error, so_far = handle.error(status), handle.array("fit.value")
    if so_far is not None:
        error.solution = dict(zip(names, so_far.tolist()))
    raise error


class Design(_Named):
    """The least or largest of a result: ``value``, ``start``, and the ``variables`` by name."""

    variables: "dict[str, float]"

    def __init__(self, result: str, handle: Any) -> None:
        names, values = handle.word("design.variables").split(), handle.array("design.value").tolist()
        self.variables = dict(zip(names, values))
        subject = handle.array("design.constraint")
        rows = [] if subject is None else np.reshape(subject, (-1, 3)).tolist()
        self.constraints = [{"result": name, "at_least": at_least == 1.0, "bound": bound, "value": value}
                            for name, (at_least, bound, value) in zip(handle.word("design.constraints").split(), rows)]
        x = handle.array("design.gap.x")
        gap = [value for name, value in self.variables.items() if name.startswith("gap-")]
        self._arrays = {} if x is None else {"x": x.copy(), "gap": np.array(gap)}
        self._numbers = {"value": float(handle.array("design.result")[0]),
                         "start": float(handle.array("design.result.start")[0]),
                         "evaluations": int(handle.array("design.evaluations")[0])}
        self.result, self.status, self._system = result, handle.word("status"), handle.value("units")

    def to_pandas(self) -> Any:
        """A row per variable: ``value``."""
        import pandas

        return pandas.DataFrame(list(self.variables.items()), columns=["variable", "value"])

    def __repr__(self) -> str:
        return f"<Design: {self.result} {self.value:.6g}, at the start {self.start:.6g}>"


def design(case: _CaseLike = None, *, minimise: Optional[str] = None, maximise: Optional[str] = None,
           over: Mapping[str, "tuple[float, float]"], subject: Union[str, Sequence[str]] = (),
           span: Optional[float] = None, evaluations: int = 200, progress: Progress = None, **options: Any) -> Design:
    """The minimum or maximum of a result over numbers of a case, as ``rollbem design``.

    ``design(load=500, minimise="max_pressure", over={"radius": (20, 200)}, subject=["half_width<=1.2"])``; ``over={"gap":
    (a, b)}`` varies every value of the table of the gap. Numbers are in the units of the case.
    ``progress(done, total)`` is called with the number of evaluations now and then.
    """
    whole = _case(case, options)
    if (minimise is None) == (maximise is None):
        raise InvalidInput("design: expected minimise= or maximise=, one of them")
    result = str(minimise if maximise is None else maximise)
    subject = _values.texts("subject", subject, "RESULT<=X")
    handle = whole.handle("solve")
    status = handle.run("rb_api_design", _values.word("minimise" if maximise is None else "maximise", result, "a result"),
                        int(maximise is not None), _assigned("over", over, 2) or b"",
                        ",".join(subject).encode() or None,
                        float("nan") if span is None else _values.number("span", span),
                        _values.whole("evaluations", evaluations, 1), progress=progress)
    if status != SOLVED and (status < SOLVED or handle.array("design.value") is None):
        raise handle.error(status)
    return Design(result, handle)
