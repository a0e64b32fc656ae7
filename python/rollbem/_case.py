"""Cases, and what comes of them."""

from __future__ import annotations

import contextlib
import html
import inspect
import io
import itertools
import keyword
import os
import sys
import tempfile
import warnings
import weakref
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _values, pictures
from ._library import (CRACK_OPTIONS, GROUPS, HISTORY_NUMBERS, OPTIONS, RESULTS, SOLVED, Handle, InvalidInput, Kept,
                       Note, Progress, Unsolved, doubles, handles, lib, texts, unit_of, written_tables)

Array = NDArray[np.float64]
Table = Union[Mapping[str, Sequence[float]], Array]
Value = Union[bool, int, float, str, os.PathLike, Sequence[float], Table]

REFUSED = -1  # status of a combination that is none

_CaseLike = Union["Case", str, os.PathLike, Mapping[str, Optional[Value]], None]

# ---- Cases --------------------------------------------------------------------------------


def _remove(path: str, process: int) -> None:
    """Removes a temporary file, but not from a process that was forked from the one that made it."""
    if os.getpid() == process:
        written_tables.pop(path, None)
        with contextlib.suppress(FileNotFoundError):
            os.unlink(path)


class Case:
    """A case: options by their names, checked one by one as they are given.

    ``Case(mu=0.3, creep=0.1)``, ``Case("rail.ini", load=800)``.  Names are those of the
    program with ``_`` for ``-``; what is given here wins over the file.  Options that name a
    file with a table (``gap``, ``layers``, ``irregularity``, ``history``) take a dictionary of columns as
    well, or an array of N x 2.  ``case["mu"]`` is a value as the program resolves it, ``dict(case)`` has all of them;
    cases are equal if all their values are.  A dictionary of options may
    stand for the file: ``Case({"mu": 0.3, "contact-elements": 60})``.
    """

    def __init__(self, file: Union["Case", str, os.PathLike, Mapping[str, Optional[Value]], None] = None,
                 **options: Optional[Value]) -> None:
        if isinstance(file, Case):
            file, options = file.file, {**file.options, **options}
        if hasattr(file, "keys"):  # also a pandas.Series
            options = {**_values.names("case", file), **options}
            file = None
        self.file = file
        self._take({name: value for name, value in options.items() if value is not None})
        self.handle("solve")

    def _take(self, options: dict) -> None:
        self.options = options
        self._texts = {name: self._as_text(name, value) for name, value in options.items()}

    def __getstate__(self) -> dict:
        return {"file": self.file, "options": self.options}

    def __setstate__(self, state: dict) -> None:
        self.file = state["file"]
        self._take(state["options"])

    def _as_text(self, name: str, value: Value) -> str:
        kind = OPTIONS[name].kind if name in OPTIONS else ""
        if kind == "integer" and isinstance(value, (float, np.floating)) and float(value).is_integer():
            value = int(value)  # of an axis of a study, or of a column of pandas
        if not _values.is_table(value):
            return _values.flag(name, value) if kind == "flag" else _values.text(name, value)
        if kind in ("number", "integer", "flag"):
            raise InvalidInput(f"{name}=: expected {OPTIONS[name].expected}, got columns of a table")
        return self._write_table(name, _values.columns(name, value))

    def _write_table(self, option: str, columns: Table) -> str:
        with tempfile.NamedTemporaryFile("w", prefix="rollbem-", suffix=".txt", delete=False) as file:
            weakref.finalize(self, _remove, file.name, os.getpid())  # it lives as long as the case
            written_tables[file.name] = option
            _values.write_columns(columns, file)
        return file.name

    def handle(self, purpose: str, **more: Value) -> Handle:
        """A new handle of the library with these options."""
        handle = Handle(purpose)
        for name, text in {**self._texts, **{k: self._as_text(k, v) for k, v in more.items()}}.items():
            handle.set(name, text)
        if self.file is not None:
            handle.check(handle.ask("rb_api_read", os.fsencode(_values.path("case", self.file))))
        return handle

    def but(self, **options: Optional[Value]) -> "Case":
        """The same case with other options; None takes one away."""
        return Case(self.file, **{**self.options, **options})

    def _resolved(self) -> Handle:
        handle = self.handle("solve")
        handle.check(handle.ask("rb_api_resolve"))
        return handle

    def __contains__(self, option: object) -> bool:
        """Whether there is an option of that name; ``case.options`` has those that were given."""
        return isinstance(option, str) and option.replace("-", "_") in OPTIONS

    def __iter__(self) -> Iterator[str]:
        return iter(OPTIONS)

    def __len__(self) -> int:
        return len(OPTIONS)

    def __getitem__(self, option: str) -> Union[bool, int, float, str]:
        if option not in self:
            raise KeyError(option)
        return _value(option, self._resolved())

    def keys(self) -> Any:
        """All options; ``dict(case)`` has their values as the program resolves them."""
        return OPTIONS.keys()

    def values(self) -> list:
        """The values of all options, as the program resolves them."""
        return [value for _, value in self.items()]

    def items(self) -> list:
        """All options with their values, as the program resolves them."""
        handle = self._resolved()
        return [(name, _value(name, handle)) for name in OPTIONS]

    def _key(self) -> tuple:
        """What makes two cases one: values as they are resolved, and what stands in tables."""
        handle = self._resolved()
        tables = {name: tuple((column, *map(float, values)) for column, values in _values.columns(name, value).items())
                  for name, value in self.options.items() if _values.is_table(value)}
        return tuple(tables.get(name, handle.value(option.name)) for name, option in OPTIONS.items())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Case):
            return NotImplemented
        try:
            return self is other or self._key() == other._key()
        except InvalidInput:  # one of them is none that can be solved
            return self.file == other.file and self._texts == other._texts

    def __hash__(self) -> int:
        try:
            return hash(self._key())
        except InvalidInput:
            return hash((self.file, *sorted(self._texts.items())))

    def solve(self, progress: Progress = None) -> "Solution":
        """See :func:`solve`."""
        solution = self._solve("solve", progress)
        _warn(solution.notes)
        return solution

    def _solve(self, purpose: str, progress: Progress = None) -> "Solution":
        handle = self.handle(purpose)
        return handle.kept(Solution(self, handle), handle.run("rb_api_solve", progress=progress))

    def __repr__(self) -> str:
        words = [repr(os.fspath(self.file))] if self.file is not None else []
        return f"Case({', '.join(words + [f'{k}={v!r}' for k, v in self.options.items()])})"


def _value(option: str, handle: Handle) -> Union[bool, int, float, str]:
    row = OPTIONS[option.replace("-", "_")]
    text = handle.value(row.name)
    try:
        return {"flag": lambda: text == "yes", "integer": lambda: int(text),
                "number": lambda: float(text)}.get(row.kind, lambda: text)()
    except ValueError:  # a word stands for the number, or several numbers
        return text


def _case(case: _CaseLike, options: Mapping[str, Any]) -> Case:
    if isinstance(case, Case):
        return case.but(**options) if options else case
    return Case(case, **options)


# ---- Results ------------------------------------------------------------------------------


class _ByInput(dict):
    """By the names of options, with ``_`` or ``-``."""

    def __missing__(self, name: str) -> Any:
        other = name.replace("_", "-") if isinstance(name, str) else name
        if other in self:
            return self[other]
        raise KeyError(f"{name}{_values.guess(name, self)}")


def _unit(result: str, table: str, unit_of_input: str, system: str) -> str:
    """The unit of a derivative; "1": it has none."""
    one, by = RESULTS[table][result].unit or "1", "" if unit_of_input in ("-", "1") else unit_of_input
    one, by = unit_of(system, one), unit_of(system, by)
    if not by or one == by:
        return "1" if by else one
    return "/".join(f"({unit})" if "/" in unit else unit for unit in (one, by))


class Derivatives(dict):
    """Derivatives by result and option: ``d["tangential_load"]["mu"]``, in the units of the case.

    Of a curve, of the steps of a history or of a study each is an array like the results. Where the two sides of a
    derivative differ it is that for a growing input; of a curve ``sides`` has both: arrays of points x 2 for a falling and
    for a growing input, NaN where there is none.  ``units["tangential_load"]["mu"]`` is the unit of each.
    """

    sides: "dict[str, dict[str, Array]]"
    units: "dict[str, dict[str, str]]"
    elements: Optional[str] = None  # of a solution: whether its elements move while an input changes

    def __init__(self, handle: Any = None, of: str = "", placed: "Callable[[Array], Array]" = np.ravel,
                 system: str = "") -> None:
        super().__init__()
        self.sides, self.units = {}, {}
        for slope in handle.slopes(of) if handle is not None else []:
            array = handle.array(f"{of}.derivative.{slope.name}").copy()
            if array.ndim == 2:
                self.sides.setdefault(slope.result, _ByInput())[slope.input] = array
                array = np.where(np.isnan(array[:, 1]), array[:, 0], array[:, 1])
            self._add(slope.result, slope.input, placed(array),
                      _unit(slope.result, "step" if of == "history" else "number", slope.unit,
                            system or handle.value("units")))

    def __missing__(self, result: str) -> Any:
        raise KeyError(f"{result}{_values.guess(result, self)}")

    def _add(self, result: str, name: str, value: Any, unit: str) -> None:
        self.setdefault(result, _ByInput())[name] = value
        self.units.setdefault(result, _ByInput())[name] = unit

    def columns(self) -> dict:
        """Arrays by the names of their columns: ``d_tangential_load_by_mu``."""
        return {_heading(result, name): np.ravel(value) for result, inputs in self.items()
                for name, value in inputs.items()}

    def to_pandas(self) -> Any:
        """Of a curve, a history or a study a ``pandas.DataFrame`` with a column each; of a solution a row per result
        and option: ``left`` and ``right`` (falling and growing input), ``unit``."""
        import pandas

        entries = [(result, name, value) for result, inputs in self.items() for name, value in inputs.items()]
        if entries and all(isinstance(value, np.ndarray) for *_, value in entries):
            frame = pandas.DataFrame(self.columns())
            frame.attrs["units"] = _units_of(self)
            return frame
        return pandas.DataFrame(
            [(result, name, *(value if isinstance(value, tuple) else (value, value)), self.units[result][name])
             for result, name, value in entries if np.ndim(value) == 0 or isinstance(value, tuple) and np.ndim(value[0]) == 0],
            columns=["result", "input", "left", "right", "unit"])


def _heading(result: str, name: str) -> str:
    return f"d_{result}_by_{name.replace('-', '_')}"


def _units_of(derivatives: Derivatives) -> dict:
    return {_heading(result, name): unit for result, inputs in derivatives.units.items() for name, unit in inputs.items()}


def _uncertain(tolerance: Any) -> bytes:
    """Uncertain inputs as the library reads them: "mu=0.02,radius=1%"."""
    if isinstance(tolerance, Mapping):
        tolerance = ",".join(f"{name.replace('_', '-')}={_values.text(f'tolerance of {name}', value)}"
                             for name, value in tolerance.items())
    return _values.word("tolerance", tolerance, "\"mu=0.02,radius=1%\", or a dictionary")


def _words(derivatives: Any) -> bytes:
    """What ``derivatives=`` asks for, as the library reads it."""
    words = "all" if derivatives is True else derivatives
    if isinstance(words, str):
        words = words.split(",")
    if not isinstance(words, (list, tuple)) or not words or not all(isinstance(word, str) for word in words):
        raise InvalidInput("derivatives=: expected True, or RESULT or RESULT:OPTION, separated by commas or in a list, "
                           f"got {derivatives!r}")
    parts = [word.strip().partition(":") for word in words]
    return _values.word("derivatives", ",".join(result + colon + name.replace("_", "-") for result, colon, name in parts),
                        "names")


def _check(case: "Case", words: Optional[bytes], inputs: Optional[bytes]) -> None:
    """Refuses before a case is solved what would be refused after it."""
    handle = case.handle("solve")
    handle.check(handle.ask("rb_api_check_derivatives", words, inputs))


class _Named:
    """Results as attributes by the names of the library's tables."""

    _arrays: dict
    _numbers: dict
    _system: str = "mm"  # units of the case
    _tables: "tuple[str, ...]" = ()  # of its columns

    def _in(self, unit: str) -> str:
        """A unit of mm, N, MPa as the results have it."""
        return unit_of(self._system, unit)

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            for values in (self._arrays, self._numbers):
                for known in (name, name[:-1] if name.endswith("_") else name):  # yield_
                    if known in values:
                        return values[known]
        known = (*self._arrays, *self._numbers) if not name.startswith("_") else ()
        raise AttributeError(f"{type(self).__name__} has no '{name}'{_values.guess(name, known)}")

    def __dir__(self) -> list:
        found = {name + "_" * keyword.iskeyword(name) for name in (*self._arrays, *self._numbers)}
        return sorted({*super().__dir__(), *found})

    def columns(self) -> dict:
        """All arrays by name, as ``pandas.DataFrame(...)`` takes them; of a curve or a history also those of
        derivatives, ``d_..._by_...``, and of tolerances, ``deviation_...``."""
        derivatives, tolerances = (self.__dict__.get(name) or {} for name in ("derivatives", "tolerances"))
        return {**self._arrays, **(derivatives.columns() if derivatives else {}),
                **{f"deviation_{name}": x for name, x in tolerances.items() if np.ndim(x) > 0}}

    def to_pandas(self) -> Any:
        """The columns as a ``pandas.DataFrame``; ``attrs["units"]`` has their units."""
        import pandas

        columns = self.columns()
        frame = pandas.DataFrame({name: np.ravel(values) for name, values in columns.items()})
        known = {name: self._in(row.unit) for table in (*RESULTS, *reversed(self._tables))
                 for name, row in RESULTS[table].items()}
        known.update({f"deviation_{name}": unit for name, unit in known.items()})
        if self.__dict__.get("derivatives"):
            known.update(_units_of(self.__dict__["derivatives"]))
        frame.attrs["units"] = {name: known[name] for name in columns if known.get(name) not in (None, "", "1")}
        return frame

    def _repr_html_(self) -> str:
        """In notebooks: the picture under what it is."""
        text = f"<pre>{html.escape(repr(self))}</pre>"
        try:
            figure = self.plot()
        except (ImportError, ValueError, AttributeError):  # no matplotlib, or nothing to draw
            return text
        drawn = io.StringIO()
        figure.savefig(drawn, format="svg", bbox_inches="tight")
        picture = drawn.getvalue()
        pictures.close(figure)
        return text + picture[picture.index("<svg"):]


def _warn(notes: "list[str]") -> None:
    """Notes as warnings, at the line that called this package."""
    here, depth, frame = os.path.dirname(__file__), 2, sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(here):
        frame, depth = frame.f_back, depth + 1
    for note in notes:
        warnings.warn(note, Note, stacklevel=depth)


class Solution(_Named):
    """A solved case: numbers and columns of its table as attributes.

    Arrays are read-only views of memory that the solution owns; they stay valid as long as
    they are used.  A column hides a number of the same name; ``numbers`` has all numbers.
    """

    _tables = ("column",)

    def __init__(self, case: Case, handle: Handle) -> None:
        self.case, self._handle = case, handle
        self._more: dict = {}
        self.tolerances: "dict[str, float]" = {}  # standard deviations, of solve(tolerance=...)
        self._tractions: "Optional[list]" = None  # x, p and q that stand in the place of a contact

    def __getstate__(self) -> dict:
        return {"case": self.case, "_handle": self._handle, "_more": {}, "tolerances": self.tolerances,
                "_tractions": self._tractions}

    def _live(self) -> Handle:
        """The library's handle; the case of a solution that was pickled is solved once more for it."""
        if isinstance(self._handle, Kept) and self._tractions is not None:
            self._handle = _given(self.case, np.column_stack(self._tractions))._handle
        elif isinstance(self._handle, Kept):
            try:
                self._handle = self.case._solve(self._handle.purpose)._handle
            except Unsolved as error:
                self._handle = error.solution._handle
        return self._handle

    def _all(self, what: str, make: Any) -> Any:
        if what not in self._more:
            self._more[what] = make()
        return self._more[what]

    @property
    def _arrays(self) -> dict:
        return self._all("columns", lambda: self._handle.arrays("column"))

    @property
    def _numbers(self) -> dict:
        return self._all("numbers", lambda: self._handle.numbers("number"))

    @property
    def _system(self) -> str:
        return self._handle.value("units")

    @property
    def numbers(self) -> dict:
        """The numbers by name."""
        return dict(self._numbers)

    @property
    def errors(self) -> dict:
        """Error bars by name, of ``error=True`` and ``accuracy``; empty without."""
        found = self._handle.numbers("number", "error.")
        return {name: x for name, x in found.items() if x == x}

    @property
    def status(self) -> str:
        """ "solved", or how the run ended."""
        return self._handle.word("status")

    @property
    def formulation(self) -> Optional[str]:
        return self._handle.word("formulation")

    @property
    def solver(self) -> Optional[str]:
        """The one that gave the answer."""
        return self._handle.word("solver")

    @property
    def notes(self) -> list:
        """The program's notes on how the solution must be read; empty: there are none."""
        return self._all("notes", self._handle.notes)

    @property
    def patches(self) -> dict:
        """The parts of the contact: columns with an entry per part."""
        return self._handle.arrays("patch", "patch.")

    @property
    def friction_power(self) -> Array:
        """Friction power per area and unit speed, an entry per element (wear)."""
        return self._handle.array("friction_power")

    @property
    def history(self) -> Optional["History"]:
        """The steps of a history; None where there are none."""
        return History(self) if self._handle.array("history.distance") is not None else None

    def value(self, option: str) -> Union[bool, int, float, str]:
        """An option as it was resolved."""
        return _value(option, self._handle)

    @property
    def carter_holds(self) -> bool:
        """Whether Carter's law holds for this case."""
        return self._handle.number("carter") == 1.0

    @property
    def derivatives(self) -> Derivatives:
        """See :func:`rollbem.derivatives`."""
        from ._inverse import derivatives

        return self._all("derivatives", lambda: derivatives(self))

    @property
    def derivatives_over_x(self) -> "dict[str, dict[str, Array]]":
        """Derivatives of normal_load, tangential_load, approach and creepage with respect to the gap and to mu of every
        element: ``s.derivatives_over_x["tangential_load"]["gap"]``, an entry per element.  {}: there are none (friction
        that depends on the state, an element between two zones, 1500 elements and more)."""
        self.derivatives
        return self._all("over_x", dict)

    @property
    def smooth_derivatives(self) -> Derivatives:
        """See :func:`rollbem.derivatives`, with ``smooth=True``."""
        from ._inverse import derivatives

        return self._all("smooth_derivatives", lambda: derivatives(self, smooth=True))

    # What the solution is made of:

    @property
    def ends(self) -> Array:
        """Ends of the elements and of the one upstream."""
        return self._handle.array("ends")

    @property
    def F(self) -> Optional[Array]:
        """Displacements (w_N, w_T) by tractions (r_N, r_T); None where no matrix was formed."""
        return self._live().matrix("F")

    @property
    def H(self) -> Optional[Array]:
        """H u = G t on the boundary of a wheel; None of a half-plane."""
        return self._live().matrix("H")

    @property
    def G(self) -> Optional[Array]:
        """See H."""
        return self._live().matrix("G")

    @property
    def mesh(self) -> Optional[Array]:
        """Ends (x0, y0, x1, y1) of the boundary elements of a wheel."""
        ends = [self._live().array(f"mesh.{end}") for end in ("x0", "y0", "x1", "y1")]
        return None if ends[0] is None else np.column_stack(ends)

    def lcp(self) -> tuple:
        """M and q of the complementarity problem that Lemke's method tries first."""
        handle = self._live()
        with handle.lock:
            handle.check(handle.run("rb_api_pivots"))
            return handle.array("lcp.M").copy(), handle.array("lcp.q").copy()

    @property
    def proof(self) -> dict:
        """What a machine-checked proof says: whether the discrete problem has a solution with these zones (``proved``,
        else ``reason``), and the distances of p and q from it as parts of p0 (``bound_p``, ``bound_q``,
        ``stored_within``).  docs/proof.md."""
        if "proof" not in self._more:
            handle = self._live()
            with handle.lock:
                handle.check(handle.run("rb_api_prove"))
                found: dict = {name: handle.number(f"proof.{name}") for name in (
                    "proved", "undecided", "isolated", "bound_p", "bound_q", "stored_within", "nearby", "margin", "norm")}
                proved = found["proved"] == 1.0
                self._more["proof"] = {**found, "proved": proved, "isolated": found["isolated"] == 1.0,
                                       "undecided": int(found["undecided"]) if proved else 0,
                                       "unique": handle.word("proof.unique") or "not shown",
                                       "reason": "" if proved else handle.word("proof.reason")}
        return self._more["proof"]

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None, dimensionless: bool = False) -> Any:
        """The picture of the program: tractions, zones, slip.  Returns the figure.

        ``ax``: the axes of the tractions, or two, the second for the slip; ``label`` names the case where several
        stand in one figure: ``figure = a.plot(label="dry"); b.plot(figure, label="wet")``.  ``dimensionless``: x/a,
        p/p0, q/(mu p0).
        """
        return pictures.tractions(self, figure, ax, label, dimensionless)

    def __repr__(self) -> str:
        n = self._numbers
        load, stress = self._in("N/mm"), self._in("MPa")
        return (f"<Solution: {self.formulation}, {self.status}; P = {n['normal_load']:.6g} {load}, "
                f"Q = {n['tangential_load']:.6g} {load}, p0 = {n['max_pressure']:.6g} {stress}; "
                f"{n['stick']} stick, {n['slip']} slip>")


class History(_Named):
    """The steps of a history as arrays with an entry per step.

    ``x`` are the elements' midpoints; ``p``, ``q`` and ``zone`` have a row per step;
    ``solution`` is the last step's.
    """

    solution: Solution
    errors: dict
    tolerances: dict  # standard deviations, of tolerance=...
    derivatives: Derivatives  # of derivatives=..., an entry per step
    notes: "list[str]"  # on how the history and its derivatives must be read
    half_width: float
    steady_from: float  # the first step from which on nothing changes, counted from 0; nan: none
    cycle_work: float  # of friction in the last cycle [N]; nan: the rows do not end with a whole one
    cycle_rows: float  # its rows; 0: likewise
    jump_row: float  # in which the contact jumps to full sliding, counted from 1; nan: in none
    jump_shift: float  # from where
    jump_force: float
    x: Array
    p: Array
    q: Array
    zone: NDArray[np.int_]

    _tables = ("step",)

    def __init__(self, solution: Solution) -> None:
        handle = solution._handle
        self.solution, self._system = solution, solution._system
        self._arrays = handle.arrays("step", "history.")
        self._numbers = {name: handle.number(f"history.{name}") for name in HISTORY_NUMBERS}
        self.errors = handle.arrays("step", "history.error.")
        self.tolerances = handle.arrays("step", "history.tolerance.", copied=True)
        self.derivatives = Derivatives(handle, "history")
        self.notes = handle.notes()
        self.x = handle.array("step.x")
        self.p, self.q, zone = (np.atleast_2d(handle.array(f"step.{name}").T) for name in ("p", "q", "zone"))
        self.zone = zone.astype(int)

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None) -> Any:
        """Force and stick over the rolled distance.  Returns the figure; ``ax``, ``label`` as of a solution."""
        return pictures.history(self, figure, ax, label)

    def __repr__(self) -> str:
        way = f" over {self.distance[-1]:.5g} half-widths" if self.distance[-1] > 0.0 else " at rest"
        load = self._in("N/mm")
        return (f"<History: {len(self.residual)} steps{way}; at the end P = {self.normal_load[-1]:.6g} {load}, "
                f"Q = {self.tangential_load[-1]:.6g} {load}, {self.stick[-1]} stick, {self.slip[-1]} slip>")


class Curve(_Named):
    """A creep curve: arrays with an entry per creepage; ``free_creepage``, ``half_width``."""

    case: Case
    over: str
    errors: dict
    tolerances: dict  # standard deviations, of tolerance=...
    derivatives: Derivatives  # of derivatives=..., an entry per point
    notes: "list[str]"  # on how its derivatives must be read
    mu: float  # which force_ratio refers to: of a law that falls, that of rest
    carter_holds: bool
    free_creepage: float
    half_width: float

    _tables = ("point",)

    def __init__(self, case: Case, handle: Handle, over: str) -> None:
        self.case, self.over, self._system = case, over, handle.value("units")
        self._arrays = handle.arrays("point", "curve.")
        self._numbers = {name: handle.number(f"curve.{name}") for name in ("free_creepage", "half_width")}
        self.errors = handle.arrays("point", "curve.error.")
        self.tolerances = handle.arrays("point", "curve.tolerance.")
        self.derivatives = Derivatives(handle, "curve")
        self.notes = handle.notes()
        self.mu = handle.number("curve.mu")
        self.carter_holds = handle.number("carter") == 1.0

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None) -> Any:
        """The picture of the program: -Q/(mu P) over the creepage.  Returns the figure; ``ax``, ``label`` as of a
        solution."""
        return pictures.curves([self], figure, ax, label)

    def __repr__(self) -> str:
        over = self._arrays[self.over.replace("-", "_")]
        found = self.force_ratio[np.isfinite(self.force_ratio)]
        largest = f"; largest |Q|/(mu P) {np.abs(found).max():.5g}" if len(found) else ""
        return (f"<Curve: {len(over)} points, {self.over.replace('-', '_')} {over.min():.5g} ... {over.max():.5g}, "
                f"mu = {self.mu}{largest}>")


class Curves(list):
    """Creep curves of several coefficients of friction, as ``curve(mu=[0.1, 0.3])`` gives them."""

    def plot(self, figure: Any = None, ax: Any = None) -> Any:
        """-Q/P of all of them over the creepage, as the program draws them.  Returns the figure."""
        return pictures.curves(self, figure, ax)

    def to_pandas(self) -> Any:
        """Their columns below each other, behind a column ``mu``."""
        import pandas

        frames = [curve.to_pandas() for curve in self]
        for curve, frame in zip(self, frames):
            frame.insert(0, "mu", curve.mu)
        together = pandas.concat(frames, ignore_index=True)
        together.attrs = frames[0].attrs
        return together

    def __repr__(self) -> str:
        return f"<Curves: mu = {', '.join(str(curve.mu) for curve in self)}>"


# rb_rolling_place_name of the library, in the order of its numbers; behind them "layer 1", "layer 2" and so on
_MATERIALS = ("body", "layer", "base")


def _material(number: float) -> str:
    layer = int(number) - len(_MATERIALS)
    return _MATERIALS[int(number)] if layer < 0 else f"layer {layer + 1}"


class Extremum(tuple):
    """Value and place (x, y) of a largest stress.

    ``material`` says what lies there: ``body``, or of two materials ``layer`` (also the
    cover of a wheel) or ``base``, of several layers ``layer 1``, ``layer 2`` ...; on a bond the stress
    along it differs in both.
    """

    value, x, y = (property(lambda self, k=k: self[k]) for k in range(3))
    material: str

    def __new__(cls, numbers: Sequence[float]) -> "Extremum":
        extremum = super().__new__(cls, numbers[:3])
        extremum.material = _material(numbers[3]) if len(numbers) > 3 else "body"
        return extremum


class Stress(_Named):
    """Stress in a body: arrays of ny x nx (a row per depth, y increasing), or with an entry per point.

    Tension positive; ``szz`` is that of plane strain, 0 in plane stress.  ``maxima``
    holds value and place of the largest ``max_shear`` (in the plane), ``tresca_shear``
    (of all planes), ``von_mises``, ``orthogonal_shear``, ``tension`` (the largest principal
    stress) and ``compression``.
    """

    solution: Solution
    maxima: "dict[str, Extremum]"
    body: str
    whole: bool  #: of a whole wheel

    _tables = ("stress",)

    def __init__(self, solution: Solution, maxima: dict, body: str = "a", whole: bool = False) -> None:
        # copied: the next stress of the same solution is made in the same memory
        found = solution._live().arrays("stress", "stress.", copied=True)
        self.solution, self.maxima, self.body, self._system = solution, maxima, body, solution._system
        self.whole = whole
        self._arrays = {name: array.T for name, array in found.items()}
        self._numbers = {}

    def plot(self, figure: Any = None, field: str = "max_shear", ax: Any = None, dimensionless: bool = False) -> Any:
        """Contours of a field of a grid, ``dimensionless`` over x/a and depth/a in p0.  Returns the figure."""
        return pictures.contours(self, figure, field, ax, dimensionless)

    def __repr__(self) -> str:
        largest = self.maxima["max_shear"]
        return (f"<Stress in {self.body.upper()}: {' x '.join(map(str, self.max_shear.shape[::-1]))} points; largest max_shear "
                f"{largest.value:.6g} {self._in('MPa')} at ({largest.x:.4g}, {largest.y:.4g}) {self._in('mm')}>")


class Wear(_Named):
    """Steps of wear as arrays with an entry per step, the first before anything is worn.

    ``x`` and ``depth`` are what is worn off A at the end; ``errors`` the error bars of the arrays, with ``error=True``.
    """

    case: Case
    x: Optional[Array]
    depth: Optional[Array]
    errors: dict

    _tables = ("wear",)

    def __init__(self, case: Case, handle: Handle) -> None:
        self.case, self._system = case, handle.value("units")
        self._arrays = handle.arrays("wear", "wear.")
        self.errors = handle.arrays("wear", "wear.error.")
        self._numbers = {}
        self.x, self.depth = (handle.array(f"wear.profile.{name}") for name in ("x", "depth"))

    def plot(self, figure: Any = None, ax: Any = None, label: Optional[str] = None) -> Any:
        """Worn volume over the way, and the profile at the end.  Returns the figure; ``ax``, ``label`` as of a solution."""
        return pictures.wear(self, figure, ax, label)

    def __repr__(self) -> str:
        return (f"<Wear: {len(self.way) - 1} steps; worn {self.worn[-1]:.6g} {self._in('mm2')}, "
                f"deepest {self.max_depth[-1]:.4g} {self._in('mm')}>")


class Sweep(_Named):
    """A study: an array per result, with an axis per varied option, in the order given.

    ``axes`` holds the values of each; ``status`` is 0 where a case was solved, -1 where the combination is impossible.
    """

    axes: "dict[str, Array]"
    status: Array
    notes: "list[str]"  # on how the results must be read, each with the cases that it is true of
    derivatives: Derivatives  # of sweep(derivatives=...)
    tolerances: dict  # standard deviations, of sweep(tolerance=...)

    _tables = ("number", "crack")

    def __init__(self, axes: Mapping[str, Array], handle: Handle, system: str, at: "list[int]") -> None:
        shape = tuple(len(values) for values in axes.values())
        count = int(np.prod(shape))

        def placed(array: Array, missing: float = np.nan) -> Array:
            """Solved cases at their places; impossible combinations have no number."""
            if len(at) == count:
                return array.reshape(shape)
            whole = np.full(count, missing, dtype=float if missing != missing else array.dtype)
            whole[at] = array
            return whole.reshape(shape)

        self.axes, self._system = dict(axes), system
        found = {**handle.arrays("crack", "sweep."), **handle.arrays("number", "sweep.")}
        self._arrays = {"status": placed(handle.array("sweep.status").astype(int), REFUSED),
                        **{name: placed(array) for name, array in found.items()}}
        self._numbers = {}
        self.notes = handle.notes()
        self.derivatives = Derivatives(handle, "sweep", placed, system)
        self.tolerances = {name: placed(array) for name, array in handle.arrays("number", "sweep.tolerance.").items()
                           if np.isfinite(array).any()}

    def columns(self) -> dict:
        """A row per case: the varied options, the status and all results."""
        grid = np.meshgrid(*self.axes.values(), indexing="ij")
        found = {name: values.ravel() for name, values in zip(self.axes, grid)}
        return {**{name: array.ravel() for name, array in super().columns().items()}, **found}

    def plot(self, figure: Any = None, show: str = "force_ratio", over: Optional[str] = None,
             family: Optional[str] = None, map: bool = False, ax: Any = None) -> Any:
        """A result over one option, a curve for each value of another, as ``rollbem sweep --plot``;
        with ``map`` its contours over the two.  Returns the figure."""
        return pictures.study(self, show, over, family, map, figure, ax)

    def __repr__(self) -> str:
        over = " x ".join(f"{len(v)} {k}" for k, v in self.axes.items())
        return f"<Sweep: {over}; {np.count_nonzero(self.status == SOLVED)} of {self.status.size} solved>"


# ---- Questions ----------------------------------------------------------------------------


def solve(case: _CaseLike = None, *, progress: Progress = None,
          tolerance: Any = None, **options: Any) -> Solution:
    """Solves one case: ``solve(mu=0.3, creep=0.1)``, ``solve("rail.ini", load=800)``.

    Of a sequence of steps, ``progress(done, total)`` is called now and then.
    ``tolerance``, such as ``{"mu": 0.02, "radius": "1%"}``: standard deviations of inputs; those of the numbers are
    then ``tolerances`` of the solution, to first order; of a sequence of steps ``tolerances`` of its history.
    Raises :class:`Unsolved`, with what there is as its ``solution``, where the run ends
    without a full answer.
    """
    for name in {"derivatives", "smooth_derivatives"} & options.keys():
        raise InvalidInput(f"{name}=: solve() does not take them; every solution has them as solution.{name}")
    whole = _case(case, options)
    if tolerance is not None:
        _check(whole, None, _uncertain(tolerance))
    solution = whole.solve(progress)
    if tolerance is not None:
        from ._inverse import tolerances

        solution.tolerances = tolerances(solution, tolerance=tolerance)
    return solution


def curve(case: _CaseLike = None, start: float = 0.0, stop: float = 1.5,
          points: int = 61, over: str = "creep-ratio", *, derivatives: Any = None, tolerance: Any = None,
          progress: Progress = None, **options: Any) -> Union[Curve, Curves]:
    """Steady rolling at equally spaced creepage ratios, or over="creep" creepages.

    With several ``mu`` a list of curves, which has their ``plot``.  ``progress(done, total)`` is called with the number of points
    now and then, for each curve anew.
    ``derivatives``, as ``"tangential_load:mu,max_pressure"`` or a list of such names, or True for all: those of the numbers
    of each point by one or all options; ``derivatives["tangential_load"]["mu"]`` of the curve has an entry per point.
    ``tolerance`` as of :func:`solve`, per cent of each point's own numbers: standard deviations of the columns are
    ``tolerances`` of the curve.
    """
    case = _case(case, options)
    mu = case.options.get("mu")
    if mu is not None and np.ndim(mu) == 1:
        return Curves(curve(case.but(mu=value), start, stop, points, over, derivatives=derivatives, tolerance=tolerance,
                            progress=progress) for value in _values.vector("mu", mu))
    handle = case.handle("curve")
    range_ = (_values.word("over", over, "creep-ratio, creep or speed"), _values.number("start", start),
              _values.number("stop", stop), _values.whole("points", points))
    asked = [None if derivatives is None else _words(derivatives), None if tolerance is None else _uncertain(tolerance)]
    status = handle.run("rb_api_curve", *range_, *asked, progress=progress)
    if status < SOLVED:
        raise handle.error(status)
    found = Curve(case, handle, over)
    _warn(found.notes)
    return handle.kept(found, status)


def history(program: Optional[Table] = None, case: _CaseLike = None, *,
            progress: Progress = None, tolerance: Any = None, derivatives: Any = None, **options: Any) -> History:
    """Runs a case along a program, a dictionary of columns, or along its own distance.

    ``history({"distance": [0, 4], "creep": [0, 1e-3]}, load=500, support="halfplane")`` rolls
    over 4 half-widths; without ``distance`` the rows are increments of a static contact.
    ``progress(done, total)`` is called with the number of steps now and then.
    ``tolerance`` as of :func:`solve`: standard deviations after every step are ``tolerances`` of the history.
    ``derivatives`` as of :func:`curve`, of its columns: ``derivatives["tangential_load"]["mu"]`` of the history has an
    entry per step.
    """
    if program is not None:
        options = {**options, "history": program}
    whole = _case(case, options)
    if "formulation" not in whole.options and whole.file is None:
        rolls = program is None or "distance" in program
        whole = whole.but(formulation="transient" if rolls else "static")
    words = None if derivatives is None else _words(derivatives)
    inputs = None if tolerance is None else _uncertain(tolerance)
    if words is not None or inputs is not None:
        _check(whole, words, inputs)
    try:
        found = solve(whole, progress=progress).history
    except Exception as error:  # the finished steps are kept
        if getattr(error, "solution", None) is not None:
            error.solution = error.solution.history
        raise
    if found is None:
        raise InvalidInput("history: the case has no steps")
    if words is not None or inputs is not None:
        handle, before = found.solution._live(), found.notes
        with handle.lock:
            handle.check(handle.run("rb_api_step_derivatives", words, inputs))
            found = History(found.solution)
        _warn([note for note in found.notes if note not in before])
    return found


def _given(case: Case, tractions: Any) -> Solution:
    """Tractions in the place of a contact."""
    if isinstance(tractions, dict):
        unknown = set(tractions) - {"x", "p", "q"}
        if unknown or not {"x", "p"} <= set(tractions):
            raise InvalidInput(f"tractions=: expected x, p and q, got {', '.join(map(str, tractions))}")
        columns = [_values.array("tractions", tractions[name]) for name in ("x", "p", "q") if name in tractions]
    else:
        rows = _values.array("tractions", tractions)
        columns = list(rows.T) if rows.ndim == 2 else [rows]
    if len(columns) not in (2, 3) or len({column.shape for column in columns}) > 1 or columns[0].ndim != 1:
        raise InvalidInput("tractions=: expected x, p and q of as many places")
    x, p, q = [np.ascontiguousarray(column) for column in (*columns, np.zeros_like(columns[0]))[:3]]
    handle = case.handle("stress")
    solution = Solution(case, handle)
    solution._tractions = [x.copy(), p.copy(), q.copy()]
    return handle.kept(solution, handle.run("rb_api_tractions", len(x), doubles(x), doubles(p), doubles(q)))


def stress(case: Union[Solution, _CaseLike] = None, grid: "tuple[int, int]" = (61, 41),
           depth: Optional[float] = None, points: Any = None, body: str = "a", tractions: Any = None,
           whole: bool = False, **options: Any) -> Stress:
    """Stress below the surface of A, or with ``body="b"`` of B, on a grid or at points (n x 2: x, y > 0 inside A, y < 0
    inside B).

    ``whole``: on a grid around a whole wheel, from its surface inwards.
    ``case`` may be a :class:`Solution`, which is not solved again.  ``tractions`` are x, p and q (or x and p) as columns or
    as arrays of a dict, linear between places that increase, twice the same x a jump: on half-planes, and then no contact
    is solved; of ``solution`` the numbers normal_load, tangential_load, resistance_moment, max_pressure and half_width are
    theirs.
    """
    if body not in ("a", "b"):
        raise InvalidInput(f"body=: expected 'a' or 'b', got {body!r}")
    if tractions is not None:
        if isinstance(case, Solution):
            raise InvalidInput("tractions=: not together with a solution")
        solution = _given(_case(case, {"support": "halfplane", **options}), tractions)
    elif isinstance(case, Solution) and not options:
        solution = case
    else:
        given = case.case.but(**options) if isinstance(case, Solution) else _case(case, options)
        solution = given._solve("stress")
        _warn(solution.notes)
    handle = solution._live()
    if whole and (depth is not None or points is not None):
        raise InvalidInput(f"whole=: not together with {'depth' if points is None else 'points'}=")
    depth = 0.0 if depth is None else _values.number("depth", depth)
    with handle.lock:  # what the call has made is read before another thread calls
        handle.check(handle.run("rb_api_stress_of", int(body == "b")))
        handle.check(handle.run("rb_api_stress_maxima", depth))
        names = ["max_shear", "tresca_shear", "von_mises", "orthogonal_shear", "tension", "compression"]
        bonds = 0
        while handle.array(f"maxima.bond_{bonds + 1}_peel") is not None:
            bonds += 1
            names += (f"bond_{bonds}_{of}" for of in ("peel", "shear", "tension_above", "tension_below"))
        maxima = {name: Extremum(handle.array(f"maxima.{name}").tolist()) for name in names}
        # NaN: of a side of a bond that the body does not have, or deeper than was searched
        maxima = {name: of for name, of in maxima.items() if not np.isnan(of.value)}
        if points is None:
            if np.ndim(grid) != 1 or len(grid) != 2:
                raise InvalidInput(f"grid=: expected two whole numbers, got {grid!r}")
            handle.check(handle.run("rb_api_stress", *(_values.whole("grid", n, 2) for n in grid),
                                    float("inf") if whole else depth))
        else:
            xy = np.ascontiguousarray(_values.array("points", points))
            if xy.ndim != 2 or xy.shape[1] != 2 or len(xy) == 0:
                raise InvalidInput(f"points=: expected an array of n x 2, got {' x '.join(map(str, xy.shape))}")
            handle.check(handle.run("rb_api_stress_at", len(xy), doubles(xy)))
        return Stress(solution, maxima, body, whole)


def wear(case: _CaseLike = None, *, coefficient: float, slide: Optional[float] = None,
         cycles: Optional[float] = None, law: str = "archard", share: float = 0.0, steps: int = 20,
         quarter: int = 8, progress: Progress = None, **options: Any) -> Wear:
    """Wears A, and B by its ``share``, as ``rollbem wear`` does.

    ``coefficient`` (1/stress, by default 1/MPa) is the worn volume per load and way (or per work: law="dissipation"). A
    slides over B by ``slide`` (a length), or it frets (static) or rolls (steady) for so many ``cycles``.
    ``progress(done, total)`` is called with the number of steps now and then.
    """
    if (slide is None) == (cycles is None):
        raise InvalidInput("wear: expected slide= or cycles=, one of them")
    whole = _case(case, options)
    handle = whole.handle("wear")
    way = [float("nan") if value is None else _values.number(name, value)
           for name, value in (("slide", slide), ("cycles", cycles))]
    status = handle.run("rb_api_wear", _values.word("law", law, "archard or dissipation"),
                        _values.number("coefficient", coefficient), _values.number("share", share), *way,
                        _values.whole("steps", steps, 1), _values.whole("quarter", quarter, 1), progress=progress)
    if status < SOLVED:
        raise handle.error(status)
    return handle.kept(Wear(whole, handle), status)


def sweep(case: _CaseLike = None, workers: int = 0, progress: Progress = None,
          derivatives: Any = None, tolerance: Any = None, **options: Any) -> Sweep:
    """Solves every combination of the options given as lists or arrays, the last fastest.

    ``sweep(mu=[0.1, 0.3], creep_ratio=np.linspace(0, 1.5, 31), formulation="steady", ...)``.
    With options of a crack, given or as lists, the contact of each case passes over it, and the
    results are also those of :func:`crack`.  One process per processor, or ``workers``.  ``progress(done, total)`` is called with the number of
    cases now and then: with tqdm, ``progress=lambda done, total: bar.update(done - bar.n)``.
    ``derivatives`` as of :func:`curve`: those of each case, for a growing input where the two sides differ; then
    ``derivatives["tangential_load"]["mu"]`` of the study is an array like its results.
    ``tolerance`` as of :func:`curve`, per cent of each case's own numbers: standard deviations of the results are
    ``tolerances`` of the study.
    """
    workers = _values.whole("workers", workers)
    base = case if isinstance(case, Case) else Case(case)
    options = {crack_option(name) or name: value for name, value in options.items()}
    axes = {name: _values.axis(name, value) for name, value in options.items()
            if isinstance(value, (list, range)) or np.ndim(value) == 1 and hasattr(value, "__array__")}
    cracks = [name for name in options if name in CRACK_OPTIONS]
    base = base.but(**{name: value for name, value in options.items() if name not in (*axes, *cracks)})
    if not axes:
        raise InvalidInput("sweep: expected at least one option with a list of values, such as mu=[0.1, 0.3]")
    if cracks and (derivatives is not None or tolerance is not None):
        raise InvalidInput(f"sweep: {'tolerance' if derivatives is None else 'derivatives'}: not of cracks")
    combinations = [dict(zip(axes, values)) for values in itertools.product(*axes.values())]
    cases, words, at, refused = [], [], [], []
    for k, one in enumerate(combinations):
        try:
            handle = base.handle("crack" if cracks else "sweep",
                                 **{name: value for name, value in one.items() if name not in cracks})
            handle.check(handle.ask("rb_api_resolve"))
        except InvalidInput as error:  # an impossible combination is no end of the study
            refused.append((one, error))
            continue
        cases.append(handle)
        at.append(k)
        words += [_values.text(name, one.get(name, options[name])) for name in cracks]
    if not cases:
        raise refused[0][1]
    study = Handle("sweep")
    if cracks:
        names = texts([name.replace("_", "-") for name in cracks])
        status = study.run("rb_api_sweep_cracks", len(cases), handles(cases), len(cracks), names, texts(words), workers,
                           progress=progress)
    else:
        status = study.run("rb_api_sweep", len(cases), handles(cases),
                           None if derivatives is None else _words(derivatives),
                           None if tolerance is None else _uncertain(tolerance), workers, progress=progress)
    study.check(status)
    axes = {name: _numbers_of(name, values, combinations, at, cases) for name, values in axes.items()}
    found = Sweep(axes, study, cases[0].value("units"), at)
    if refused:
        one, error = refused[0]
        which = ", ".join(f"{name}={value}" for name, value in one.items())
        found.notes.insert(0, f"{len(refused)} of {len(combinations)} combinations {'is' if len(refused) == 1 else 'are'} "
                              f"impossible and not solved ({which}: {error})")
    _warn(found.notes)
    return found


def _numbers_of(name: str, values: Any, combinations: "list[dict]", at: "list[int]", cases: "list[Handle]") -> Array:
    """Values with units ("100kN/m") as the numbers that the program reads; words stay words."""
    if values.dtype.kind != "O" or name not in OPTIONS or OPTIONS[name].kind not in ("number", "integer"):
        return values
    read = {str(combinations[k][name]): _value(name, handle) for k, handle in zip(at, cases)}
    return np.array([read.get(str(value), np.nan) for value in values])


def crack_option(name: str) -> Optional[str]:
    """The option of a crack of that name, where a keyword of Python has a ``_`` behind it; None: there is none."""
    own = name.rstrip("_")
    return own if own in CRACK_OPTIONS else None


# ---- Documentation from the tables --------------------------------------------------------


def _options_text() -> Iterator[str]:
    section = None
    for name, option in OPTIONS.items():
        if option.section != section:
            section = option.section
            yield f"\n{GROUPS.get(section, section)}:\n"
        unit = f" [{option.unit}]" if option.unit not in ("", "-", "FILE") else ""
        default = f"; default {option.default}" if option.default else ""
        yield f"{name}: {option.help}{unit} ({option.expected}{default})"


def _results_text(table: str) -> Iterator[str]:
    for name, result in RESULTS[table].items():
        unit = f" [{result.unit}]" if result.unit not in ("", "1") else ""
        yield f"{name}: {result.meaning}{unit}"


def _document() -> None:
    """Options and results are described where they are defined: in the library's tables."""
    options = "\n".join(_options_text())
    named = {"number": float, "integer": int, "flag": bool}
    keywords = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None,
                                  annotation=Optional[named.get(option.kind, str)])
                for name, option in OPTIONS.items()]
    for function in (solve, curve, history, stress, sweep, wear, Case):
        target = function.__init__ if function is Case else function
        own = [p for p in inspect.signature(target).parameters.values()
               if p.kind is not inspect.Parameter.VAR_KEYWORD and p.name != "self"]
        new = [p for p in keywords if p.name not in {o.name for o in own}]
        function.__signature__ = inspect.Signature(own + new, return_annotation=inspect.signature(
            target).return_annotation)
        function.__doc__ = f"{inspect.getdoc(function)}\n\nOptions of a case\n{options}\n"
    for kind, tables in ((Solution, ("number", "column")), (History, ("step",)), (Curve, ("point",)),
                         (Stress, ("stress",)), (Sweep, ("number",)), (Wear, ("wear",))):
        text = "\n".join(line for table in tables for line in _results_text(table))
        kind.__doc__ = f"{inspect.getdoc(kind)}\n\n{text}\n"


_document()
