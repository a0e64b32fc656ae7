"""What callers hand over, checked before the library sees it; refusals name the keyword."""

from __future__ import annotations

import difflib
import os
from typing import Any, Mapping

import numpy as np
from numpy.typing import NDArray

from ._library import InvalidInput

MOST = 2**31 - 1  # the library's sizes are C's int


def _one(value: Any) -> Any:
    """An array without axes is its number."""
    return value.item() if isinstance(value, (np.ndarray, np.generic)) and np.ndim(value) == 0 else value


def shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) < 60 else f"{text[:56]} ..."


def number(name: str, value: Any) -> float:
    """float, int, NumPy's numbers, Decimal, Fraction."""
    value = _one(value)
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidInput(f"{name}=: expected a number, got {shown(value)}")


def whole(name: str, value: Any, least: int = 0, most: int = MOST) -> int:
    value = _one(value)
    if hasattr(value, "__index__") and least <= int(value) <= most:
        return int(value)
    raise InvalidInput(f"{name}=: expected a whole number from {least} to {most}, got {shown(value)}")


def word(name: str, value: Any, expected: str) -> bytes:
    if isinstance(value, str) and "\0" not in value:
        return value.encode(errors="surrogateescape")
    raise InvalidInput(f"{name}=: expected {expected}, got {shown(value)}")


def texts(name: str, value: Any, expected: str) -> "list[str]":
    """One text or a list of them."""
    found = [value] if isinstance(value, str) else list(value) if np.ndim(value) == 1 else [None]
    if not all(isinstance(text, str) for text in found):
        raise InvalidInput(f"{name}=: expected {expected}, got {shown(value)}")
    return found


def path(name: str, value: Any) -> str:
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise InvalidInput(f"{name}=: expected the name of a file, got {shown(value)}")
    found = os.fsdecode(value)
    if "\0" in found:
        raise InvalidInput(f"{name}=: a NUL character is in {shown(found)}")
    return found


def names(name: str, value: Mapping[str, Any]) -> dict[str, Any]:
    """Options by their names as keywords are."""
    for key in value.keys():
        if not isinstance(key, str):
            raise InvalidInput(f"{name}=: expected names of options, got {shown(key)}")
    return {key.replace("-", "_"): value[key] for key in value.keys()}


def vector(name: str, value: Any, least: int = 1) -> NDArray[np.float64]:
    """Numbers in one row, at least one."""
    found = array(name, value)
    if found.size < least:
        raise InvalidInput(f"{name}=: expected at least one number, got {shown(value)}")
    if found.size != max(found.shape, default=1):
        raise InvalidInput(f"{name}=: expected numbers in one row, got {' x '.join(map(str, found.shape))}")
    return np.ascontiguousarray(found.ravel())


def array(name: str, value: Any) -> NDArray[np.float64]:
    try:
        if value is not None and np.asarray(value).dtype.kind not in "USc":
            return np.asarray(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidInput(f"{name}=: expected numbers, got {shown(value)}")


def matrix(name: str, value: Any, rows: int) -> NDArray[np.float64]:
    """Column by column, also from SciPy's sparse ones."""
    found = array(name, value.toarray() if hasattr(value, "toarray") else value)
    if found.shape != (rows, rows):
        raise InvalidInput(f"{name}=: expected a matrix of {rows} x {rows}, got "
                           f"{' x '.join(map(str, found.shape)) or 'a number'}")
    return np.asfortranarray(found)


def compressed(name: str, value: Any, rows: int) -> "tuple[NDArray[np.intc], NDArray[np.intc], NDArray[np.float64]]":
    """Compressed columns of a square matrix, dense or one of SciPy's, which is not made dense."""
    if hasattr(value, "tocsc"):
        shape = tuple(value.shape)
        if shape == (rows, rows):
            found = value.tocsc(copy=True)
            if found.dtype.kind not in "biuf":
                raise InvalidInput(f"{name}=: expected numbers, got {shown(value)}")
            found.sum_duplicates()
            found.sort_indices()
            if found.nnz > MOST:
                raise InvalidInput(f"{name}=: {found.nnz} entries, expected at most {MOST}")
            return (np.ascontiguousarray(found.indptr, dtype=np.intc), np.ascontiguousarray(found.indices, dtype=np.intc),
                    np.ascontiguousarray(found.data, dtype=float))
    else:
        dense = array(name, value.toarray() if hasattr(value, "toarray") else value)
        shape = dense.shape
        if shape == (rows, rows):
            column, row = np.nonzero(dense.T)
            counts = np.bincount(column, minlength=rows)
            begins = np.concatenate([[0], np.cumsum(counts)]).astype(np.intc)
            return begins, row.astype(np.intc), np.ascontiguousarray(dense.T[column, row])
    raise InvalidInput(f"{name}=: expected a matrix of {rows} x {rows}, got {' x '.join(map(str, shape)) or 'a number'}")


def each(name: str, value: Any, rows: int) -> NDArray[np.float64]:
    """A number for each row, or one for all of them."""
    found = vector(name, value, min(rows, 1))
    if len(found) not in (1, rows):
        raise InvalidInput(f"{name}=: expected a number or one per row ({rows}), got {len(found)}")
    return np.ascontiguousarray(np.broadcast_to(found, rows))


def table(name: str, value: Any) -> NDArray[np.float64]:
    """Numbers in rows and columns."""
    found = array(name, value.toarray() if hasattr(value, "toarray") else value)
    if found.ndim != 2 or found.size == 0:
        raise InvalidInput(f"{name}=: expected a matrix, got {' x '.join(map(str, found.shape)) or 'a number'}")
    return found


def axis(name: str, value: Any) -> NDArray[Any]:
    """Values of an option that varies: numbers, or texts as a case has them."""
    values = list(value) if not isinstance(value, range) else value
    if any(isinstance(_one(one), (str, bool)) for one in values):
        found = np.empty(len(values), dtype=object)
        found[:] = [_one(one) for one in values]
        return found
    return vector(name, value)


def flag(name: str, value: Any) -> str:
    """Yes or no: also 0 and 1."""
    one = _one(value)
    return text(name, bool(one) if isinstance(one, (int, float)) and one in (0, 1) else one)


# What people call results.
_ALSO = {"Q": "tangential_load", "P": "normal_load", "p0": "max_pressure", "a": "half_width", "xi": "creepage",
         "delta": "approach", "friction_force": "tangential_load", "tangential_force": "tangential_load",
         "force": "tangential_load", "normal_force": "normal_load", "load": "normal_load", "peak_pressure": "max_pressure",
         "pmax": "max_pressure", "pressure": "p", "traction": "q", "shear": "q", "traction_coefficient": "force_ratio",
         "friction_coefficient": "force_ratio", "width": "half_width", "power": "dissipation", "slip_zone": "zone"}


def guess(name: Any, known: Any) -> str:
    """ " (did you mean 'tangential_load'?)", or nothing."""
    if not isinstance(name, str):
        return ""
    names = [one for one in known if isinstance(one, str)]
    lower = name.lower().replace("-", "_").replace(" ", "_")
    found = [other for key, other in _ALSO.items() if key.lower() == lower and other in names]
    found += difflib.get_close_matches(lower, names, 1, 0.7)
    return f" (did you mean '{found[0]}'?)" if found else ""


def _rows(name: str, value: Any) -> dict:
    """The columns of an array of N x 2 or more, by their numbers: most have no names."""
    found = array(name, value)
    if found.ndim != 2 or found.shape[1] < 2 or len(found) == 0:
        raise InvalidInput(f"{name}=: expected columns, an array of N x 2, got {' x '.join(map(str, found.shape))}")
    names = ("x", "gap") if name == "gap" and found.shape[1] == 2 else map(str, range(found.shape[1]))
    return {column: found[:, k] for k, column in enumerate(names)}


def is_table(value: Any) -> bool:
    """Columns by name, or an array of them, and no number or text."""
    return isinstance(value, Mapping) or np.ndim(value) == 2


def columns(name: str, table: Any) -> dict:
    """Columns of a table, of one length."""
    named = table if hasattr(table, "keys") else _rows(name, table)
    found = {str(key): vector(f"{name}[{key!r}]", values) for key, values in named.items()}
    lengths = {key: len(values) for key, values in found.items()}
    if len(set(lengths.values())) != 1:
        raise InvalidInput(f"{name}=: expected columns of one length, got "
                           + (", ".join(f"{n} of {key}" for key, n in lengths.items()) or "no column"))
    return found


def write_columns(found: dict, file: Any) -> None:
    """A table that the program reads."""
    # A name may have blanks, as "x [mm]"; numbers are those of columns without names.
    print("\t".join(found) if not all(map(str.isdigit, found)) else "#", file=file)
    for row in zip(*found.values()):
        print(*(repr(float(x)) for x in row), file=file)


def text(name: str, value: Any) -> str:
    """An option as a case file has it; the shortest digits that read back as the same number."""
    value = _one(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, (str, bytes, os.PathLike)):
        return path(name, value)
    if hasattr(value, "__float__") and np.ndim(value) == 0:  # a Series has it too
        return repr(number(name, value))
    return ",".join(map(repr, vector(name, value).tolist()))
