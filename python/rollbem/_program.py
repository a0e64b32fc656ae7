"""Questions that the program ``rollbem`` answers from files: certificates, CONTACT's cases, references."""

from __future__ import annotations

import html
import json
import os
import shutil
import subprocess
import tempfile
import warnings
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _values
from ._library import LIBRARY, Error, InvalidInput, MissingFile, Note, in_keywords

_Path = Union[str, os.PathLike]
SOLVED, UNSOLVED, USAGE, DATA, NO_INPUT = 0, 1, 64, 65, 66


def _find() -> str:
    """ROLLBEM_PROGRAM, the program beside the library, or that of the system."""
    beside = os.path.join(os.path.dirname(LIBRARY), "rollbem")
    found = os.environ.get("ROLLBEM_PROGRAM") or (
        beside if os.access(beside, os.X_OK) and not os.path.isdir(beside) else shutil.which("rollbem"))
    if not found:
        raise MissingFile("the program rollbem is neither beside the library nor on PATH; "
                          "name it by the variable ROLLBEM_PROGRAM")
    return found


def _run(command: str, *arguments: str) -> "tuple[int, str, str]":
    done = subprocess.run([_find(), command, *arguments], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, errors="replace")
    message = in_keywords(done.stderr.strip().removeprefix("rollbem: "))
    if done.returncode not in (SOLVED, UNSOLVED):
        kind = {USAGE: InvalidInput, DATA: InvalidInput, NO_INPUT: MissingFile}.get(done.returncode, Error)
        raise kind(message or f"rollbem {command} ended with {done.returncode}")
    return done.returncode, done.stdout, message


class Check(NamedTuple):
    """What :func:`check` found; true where the result is valid."""

    file: str
    valid: bool
    findings: "list[str]"

    def __bool__(self) -> bool:
        return self.valid

    def to_pandas(self) -> Any:
        """A row per line of what was found."""
        import pandas

        return pandas.DataFrame({"file": self.file, "valid": self.valid, "finding": self.findings or [""]})

    def __repr__(self) -> str:
        return f"<Check: {self.file}: {'valid' if self.valid else 'violated'}; {'; '.join(self.findings)}>"


def check(file: _Path, any_folder: bool = False) -> Check:
    """Verifies a result that ``rollbem`` wrote (JSON or a table) without solving, by ``rollbem check``.

    Files that the result names are read only below its own folder, unless ``any_folder``.
    """
    path = _values.path("file", file)
    code, printed, _ = _run("check", *["--any-folder"] * bool(any_folder), "--", path)
    lines = [line.removeprefix(f"{path}: ") for line in printed.splitlines()]
    return Check(path, code == SOLVED, lines)


class Reference(NamedTuple):
    """A closed form or published value, and what the program finds."""

    what: str
    wanted: float
    got: float
    error: float
    bound: float
    holds: bool


class References(list):
    """The list that :func:`verify` gives; true where all hold."""

    def __bool__(self) -> bool:
        return all(row.holds for row in self)

    def to_pandas(self) -> Any:
        """A row per reference."""
        import pandas

        return pandas.DataFrame(list(self), columns=Reference._fields)

    def __repr__(self) -> str:
        return f"<References: {sum(row.holds for row in self)} of {len(self)} hold>"

    def _repr_html_(self) -> str:
        cells = "".join(f"<tr><td>{html.escape(row.what)}</td><td>{row.wanted:.6g}</td><td>{row.got:.6g}</td>"
                        f"<td>{row.error:.2g}</td><td>{row.bound:.2g}</td><td>{'ok' if row.holds else 'FAILS'}</td></tr>"
                        for row in self)
        return ("<table><tr><th>reference</th><th>wanted</th><th>got</th><th>error</th><th>bound</th><th></th></tr>"
                f"{cells}</table>")


def verify() -> References:
    """Computes every closed-form and published reference: takes some seconds."""
    return References(Reference(row["what"], *(_number(row[name]) for name in ("wanted", "got", "error", "bound")),
                                row["holds"]) for row in json.loads(_run("verify", "--json")[1])["references"])


def _number(value: Optional[float]) -> float:
    return float("nan") if value is None else float(value)


class ContactCases(list):
    """What :func:`contact` gives: a dictionary for each case, in CONTACT's names and units."""

    def to_pandas(self) -> Any:
        """A row per case; tractions, where they were asked for, are left out."""
        import pandas

        return pandas.DataFrame([{k: v for k, v in case.items() if k != "table"} for case in self])

    def __repr__(self) -> str:
        solved = sum(case.get("status") == "solved" for case in self)
        return f"<ContactCases: {solved} of {len(self)} solved>"


def contact(file: _Path, tractions: bool = False) -> ContactCases:
    """Runs the two-dimensional cases of an input file of CONTACT (module 3).

    With ``tractions`` each case has its ``table``: columns over the elements.
    """
    arguments = ["--json", "--quiet", *["--tractions"] * bool(tractions), "--", _values.path("file", file)]
    code, printed, message = _run("contact", *arguments)
    if not printed:
        raise InvalidInput(message)
    return ContactCases(json.loads(printed)["cases"])


def examples() -> "dict[str, str]":
    """The built-in examples: their names, for ``--example``, and what they are."""
    return {row["name"]: row["about"] for row in json.loads(_run("examples", "--json")[1])["examples"]
            if row["kind"] == "case"}


class Hardness(NamedTuple):
    """What :func:`rubber` gives: Young's modulus by the first relation, and the least and the largest one of all."""

    scale: str
    hardness: float
    young: float
    young_least: float
    young_largest: float
    relations: "dict[str, float]"
    notes: "list[str]"

    def to_pandas(self) -> Any:
        """A row per relation."""
        import pandas

        return pandas.DataFrame(list(self.relations.items()), columns=["relation", "young"])


def rubber(shore: Union[str, float, None] = None, pj: Optional[float] = None, units: str = "mm") -> Hardness:
    """The modulus of a hardness, ``shore="60A"`` or ``pj=100``, by each published relation."""
    given = [] if shore is None else ["--shore", shore if isinstance(shore, str) else repr(_values.number("shore", shore))]
    given += [] if pj is None else ["--pj", repr(_values.number("pj", pj))]
    found = json.loads(_run("rubber", "--json", "--quiet", "--units", units, *given)[1])
    return Hardness(found["scale"], found["hardness"], found["young"], found["young_least"], found["young_largest"],
                    {row["relation"]: row["young"] for row in found["relations"]}, found["notes"])


class Prony:
    """What :func:`prony` gives: a material that relaxes, and how far it is from the measured moduli.

    ``material`` are the options of a case, as in ``rollbem.solve(**series.material, poisson=0.5)``; ``points`` holds columns
    over the frequencies.
    """

    material: "dict[str, Any]"
    young_slow: float
    rms: float
    largest: float
    largest_at: float
    per_decade: float
    joined: int
    notes: "list[str]"
    points: "dict[str, NDArray[np.float64]]"

    def __init__(self, found: "dict[str, Any]") -> None:
        self.__dict__.update({name: found[name] for name in ("young_slow", "rms", "largest", "largest_at", "per_decade",
                                                             "joined", "notes")})
        self.material = {"young": found["young"], "units": found["units"]["system"]}
        if found["relaxation_time"]:
            self.material.update(relaxation_time=found["relaxation_time"], relaxation_ratio=found["relaxation_ratio"])
        self.points = {name: np.array([row[name] for row in found["points"]], dtype=float) for name in found["points"][0]}

    def to_pandas(self) -> Any:
        """A row per frequency."""
        import pandas

        return pandas.DataFrame(self.points)

    def __repr__(self) -> str:
        return (f"<Prony: {len(self.material.get('relaxation_time', []))} terms, E {self.material['young']:.6g}, "
                f"slow {self.young_slow:.6g}; deviation {self.rms:.2g} (rms)>")


def prony(moduli: Union[_Path, Mapping[str, Sequence[float]]], per_decade: Optional[float] = None,
          units: str = "mm") -> Prony:
    """Relaxation times from E' and tan delta over the frequency, by ``rollbem prony``.

    ``moduli``: a file, or columns as ``{"frequency_Hz": ..., "storage_modulus_MPa": ..., "tan_delta": ...}``.
    """
    given = [] if per_decade is None else ["--per-decade", repr(_values.number("per_decade", per_decade))]
    with tempfile.TemporaryDirectory(prefix="rollbem-") as folder:
        if _values.is_table(moduli):
            path = os.path.join(folder, "moduli.txt")
            with open(path, "w") as file:
                _values.write_columns(_values.columns("moduli", moduli), file)
        else:
            path = _values.path("moduli", moduli)
        found = json.loads(_run("prony", "--json", "--quiet", "--units", units, *given, "--", path)[1])
    for note in found["notes"]:
        warnings.warn(note, Note, stacklevel=2)
    return Prony(found)
