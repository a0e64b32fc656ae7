"""Questions that the program ``rollbem`` answers from files: certificates, CONTACT's cases, references."""

from __future__ import annotations

import html
import json
import os
import shutil
import subprocess
from typing import Any, NamedTuple, Optional, Union

from . import _values
from ._library import LIBRARY, Error, InvalidInput, MissingFile, in_keywords

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
