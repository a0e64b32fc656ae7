"""The page for browsers, which the wheel and installations bring along, opened with a case."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path
from typing import Union

from ._case import Case, Value, _case, _CaseLike
from ._library import LIBRARY, OPTIONS, InvalidInput, MissingFile

_CASE, _LIMITS = '<script type="application/json" id="carried">', '<script type="application/json" id="limits">'


def _built() -> str:
    """The text of the page: the wheel's, the checkout's, or that of an installation."""
    beside = Path(LIBRARY).parent
    places = [Path(__file__).with_name("rollbem.html"), beside / "rollbem.html",
              *(root / "share/rollbem/rollbem.html" for root in (beside.parent, Path(sys.prefix), Path("/usr/local"), Path("/usr")))]
    found = next((place for place in places if place.is_file()), None)
    if not found:
        raise MissingFile("page: rollbem.html is neither in the package nor in share/rollbem; `make page` builds it")
    text = found.read_text(encoding="utf-8")
    if f"{_CASE}null" not in text or _LIMITS not in text:
        raise InvalidInput(f"{found}: expected the page of `make page`")
    return text


def _words(case: Case) -> "dict[str, str]":
    """What is given, name by name, as text of a case file: numbers in the case's system of units."""
    if case.file is not None:
        raise InvalidInput("page: give options by their names; the program's `rollbem page CASE.ini` takes a case file")
    resolved, words = case._resolved(), {}
    for name, row in OPTIONS.items():
        if name not in case._texts:
            continue
        words[row.name] = text = resolved.value(row.name)
        if row.kind == "text" or (row.kind == "choice" and text not in row.choices.split()):
            raise InvalidInput(f"{name}=: names a file, which the page cannot contain")
    return words


def _above(value: str, most: "float | None") -> bool:
    try:
        return most is not None and float(value) > most
    except ValueError:  # auto
        return False


def page(file: Union[str, os.PathLike], case: _CaseLike = None, **options: Value) -> str:
    """Writes the page for browsers, one HTML file that opens without a network, so that it opens with this case.

    ``rollbem.page("lecture.html", mu=0.2, load=500)``.  Returns the path.
    """
    text, words = _built(), _words(_case(case, options))
    limits = json.loads(re.search(f"{_LIMITS}(.*?)</script>", text).group(1))
    for name, value in words.items():
        option = name.replace("-", "_")
        if name in limits["left_out"]:
            raise InvalidInput(f"{option}=: not in the page, use rollbem.solve")
        if _above(value, limits["largest"].get(name)):
            raise InvalidInput(f"{option}=: the page goes up to {limits['largest'][name]}, use rollbem.solve for {value}")
    carried = json.dumps(words, separators=(",", ":")).replace("<", "\\u003c")  # no text may end the element that holds it
    Path(file).write_text(text.replace(f"{_CASE}null", _CASE + carried, 1), encoding="utf-8")
    return os.fspath(file)
