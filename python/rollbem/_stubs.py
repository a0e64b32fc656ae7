"""Types for editors, from the library's tables: python3 -m rollbem._stubs > rollbem/__init__.pyi."""

from __future__ import annotations

import inspect
import keyword
from typing import Any, Iterator

import rollbem
from rollbem._library import OPTIONS, RESULTS

_HEAD = """# Made from the tables of the library by rollbem._stubs.
import os
from typing import (Any, Callable, Dict, Iterator, List, Literal, Mapping, NamedTuple, Optional, Protocol, Sequence,
                    SupportsFloat, SupportsIndex, Tuple, Union)
import numpy as np
from numpy.typing import NDArray
from . import pictures as pictures

Array = NDArray[np.float64]
Table = Union[Mapping[str, Union[Sequence[float], NDArray[Any]]], NDArray[Any], "_Frame"]
Progress = Optional[Callable[[int, int], object]]
Value = Union[bool, int, SupportsFloat, str, os.PathLike, Sequence[Any], Table]
_Path = Union[str, os.PathLike]
_CaseLike = Union["Case", str, os.PathLike, Mapping[str, Optional[Value]], None]
_Numbers = Union[float, Sequence[float], Array]

class _Frame(Protocol):  # such as pandas.DataFrame
    def keys(self) -> Any: ...
    def __getitem__(self, name: Any) -> Any: ...
"""

# The tables whose columns are arrays, and those of single numbers, of each result.
_RESULTS: "dict[str, tuple[tuple, tuple]]" = {
    "Solution": (("column",), ("number",)), "History": (("step",), ()), "Curve": (("point",), ()),
    "Stress": (("stress",), ()), "Sweep": (("number", "crack"), ()), "Wear": (("wear",), ()), "Crack": (("position",), ("crack",)), "Fit": ((), ()),
    "Design": ((), ())}
# What these options take besides their words: files with a table, other solvers.
_ALSO = {"gap": "str, os.PathLike, Table", "friction_law": "str, os.PathLike, Table", "solver": "str"}
# What of a class is used by its signs: s["mu"], len(c), bool(check).
_SPECIAL = ("__getitem__", "__len__", "__iter__", "__bool__", "__contains__", "__eq__", "__hash__")


def _option_type(name: str, many: bool) -> str:
    row = OPTIONS[name]
    words = ", ".join(repr(word) for word in row.choices.split()) if row.kind == "choice" else ""
    one = {"flag": "Union[bool, Literal[0, 1]]", "integer": "SupportsIndex", "number": "Union[SupportsFloat, str]"}.get(row.kind, "Union[str, os.PathLike, Table]")
    one = f"Literal[{words}]" if words else one
    one = f"Union[{one}, {_ALSO[name]}]" if name in _ALSO else one
    return f"Union[{one}, Sequence[Any]]" if many or row.kind == "number" else one


def _type(annotation: Any) -> str:
    """An annotation as a stub for Python 3.9 has it."""
    if annotation is inspect.Parameter.empty:
        return "Any"
    text = getattr(annotation, "__forward_arg__", str(annotation)).strip("'").replace('"', "")
    return text.replace("list[", "List[").replace("dict[", "Dict[").replace("tuple[", "Tuple[").replace("Handle", "Any")


def _parameter(p: inspect.Parameter, many: bool) -> str:
    if p.name in OPTIONS:
        return f"{p.name}: Optional[{_option_type(p.name, many)}] = ..."
    annotation = "" if p.annotation is p.empty else f": {_type(p.annotation)}"
    return f"{p.name}{annotation}{'' if p.default is p.empty else ' = ...'}"


def _function(name: str, function: Any, indent: str = "", own: str = "") -> Iterator[str]:
    signature = inspect.signature(function)
    words, star = [own] if own else [], False
    for p in signature.parameters.values():
        if p.name == "self" and own:
            continue
        if p.kind is p.KEYWORD_ONLY and not star:
            words, star = words + ["*"], True
        mark = {p.VAR_KEYWORD: "**", p.VAR_POSITIONAL: "*"}.get(p.kind, "")
        words.append(mark + _parameter(p, name == "sweep"))
    result = "None" if name == "__init__" else _type(signature.return_annotation)
    yield f"{indent}def {name}({', '.join(words)}) -> {result}: ..."


def _attributes(name: str, kind: type) -> Iterator[str]:
    columns, numbers = _RESULTS.get(name, ((), ()))
    own = {*vars(kind), *getattr(kind, "__annotations__", {})}
    arrays = {result for table in columns for result in RESULTS[table]}
    for field, of in getattr(kind, "__annotations__", {}).items():
        if not field.startswith("_"):
            yield f"    {field}: {_type(of)}"
    for result in sorted(arrays - own):
        yield f"    {result}{'_' * keyword.iskeyword(result)}: Array"
    for result, row in ((result, row) for table in numbers for result, row in RESULTS[table].items()):
        if result not in arrays | own:
            yield f"    {result}{'_' * keyword.iskeyword(result)}: {'int' if row.kind == 'whole' else 'float'}"


def _class(name: str, kind: type) -> Iterator[str]:
    bases = [base.__name__ for base in kind.__bases__ if base is not object and not base.__name__.startswith("_")]
    named = issubclass(kind, tuple) and hasattr(kind, "_fields")
    bases = ["NamedTuple"] if named else bases
    yield f"class {name}({', '.join(bases)}):" if bases else f"class {name}:"
    lines = list(_attributes(name, kind))
    if name == "Case":
        lines += _function("__init__", kind, "    ", "self")
    inherited = {member: value for base in reversed(kind.__mro__[:-1]) if base.__module__.startswith("rollbem")
                 for member, value in vars(base).items()}
    for member, value in inherited.items():
        if isinstance(value, property) and not member.startswith("_"):
            lines += ["    @property", f"    def {member}(self) -> {_type(inspect.signature(value.fget).return_annotation)}: ..."]
        elif inspect.isfunction(value) and (not member.startswith("_") or member in _SPECIAL) and not named:
            lines += _function(member, value, "    ", "self")
    if name in _RESULTS:  # error bars and results of later versions
        lines.append("    def __getattr__(self, name: str) -> Any: ...")
    yield from lines or ["    ..."]


def lines() -> Iterator[str]:
    yield _HEAD
    yield "__version__: str"
    for name in rollbem.__all__:
        value = getattr(rollbem, name)
        if inspect.isclass(value):
            yield from _class(name, value)
        elif inspect.isfunction(value):
            yield from _function(name, value)
        elif name != "pictures":
            yield f"{name}: Dict[str, Any]"


if __name__ == "__main__":
    print("\n".join(lines()))
