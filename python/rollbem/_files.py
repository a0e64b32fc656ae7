"""Files of other programs: NumPy's and SciPy's archives, MATLAB's, Matrix Market, Gambit's games."""

from __future__ import annotations

import os
import re
from typing import Any, Iterator

import numpy as np

from ._library import InvalidInput, MissingFile

_PARTS = ("M", "q", "lower", "upper", "start")


def _exists(path: str) -> None:
    if not os.path.exists(path):
        raise MissingFile(f"{path}: No such file or directory")


def _scipy(what: str, path: str) -> Any:
    try:
        import scipy.io
        import scipy.sparse
    except ImportError:
        raise InvalidInput(f"{path}: {what} need SciPy, which is not installed") from None
    return scipy


def _chosen(path: str, found: "dict[str, Any]") -> "dict[str, Any]":
    """M (or A) and q (or b, where there is no M), and what else belongs to a problem."""
    parts = {name: found[name] for name in _PARTS if name in found}
    if "M" not in parts:
        matrices = ["A"] if "A" in found else [
            name for name, value in found.items() if np.ndim(value) == 2 and min(np.shape(value)) > 1]
        if len(matrices) != 1:
            raise InvalidInput(f"{path}: expected a matrix M or A, got " + (", ".join(sorted(found)) or "no array"))
        parts["M"] = found[matrices[0]]
        if "q" not in parts and "b" in found:
            parts["q"] = found["b"]
    return {name: value if name == "M" else np.ravel(value.toarray() if hasattr(value, "toarray") else value)
            for name, value in parts.items()}


def _npz(path: str) -> "dict[str, Any]":
    with np.load(path, allow_pickle=False) as archive:
        found = {name: archive[name] for name in archive.files}
    if {"format", "shape"} <= found.keys():
        return {"M": _scipy("sparse matrices", path).sparse.load_npz(path)}
    return _chosen(path, found)


def _mat(path: str) -> "dict[str, Any]":
    scipy = _scipy("files of MATLAB", path)
    try:
        found = scipy.io.loadmat(path)
    except NotImplementedError:  # version 7.3 is HDF5
        return _mat73(path)
    return _chosen(path, {name: value for name, value in found.items() if not name.startswith("__")})


def _mat73(path: str) -> "dict[str, Any]":
    try:
        import h5py
    except ImportError:
        raise InvalidInput(f"{path}: a file of MATLAB 7.3 needs h5py, which is not installed; "
                           "in MATLAB, save(..., '-v7') writes one that does not") from None
    found = {}
    with h5py.File(path, "r") as file:
        for name, value in file.items():
            if name.startswith("#"):
                continue
            if isinstance(value, h5py.Group) and {"data", "ir", "jc"} <= set(value):  # sparse, by columns
                rows = int(value.attrs.get("MATLAB_sparse", 0))
                sparse = _scipy("sparse matrices", path).sparse
                found[name] = sparse.csc_matrix((value["data"][:], value["ir"][:], value["jc"][:]),
                                                shape=(rows, len(value["jc"]) - 1))
            elif isinstance(value, h5py.Dataset) and value.dtype.kind in "fiu":
                found[name] = np.asarray(value).T
    return _chosen(path, found)


def problem(path: str) -> "dict[str, Any]":
    """M, and as far as the file has them q, lower, upper, start."""
    _exists(path)
    kind = os.path.splitext(path)[1].lower()
    try:
        if kind == ".npz":
            return _npz(path)
        if kind == ".npy":
            return {"M": np.load(path, allow_pickle=False)}
        if kind == ".mat":
            return _mat(path)
        if kind == ".mtx":
            return {"M": _scipy("files of Matrix Market", path).io.mmread(path)}
    except InvalidInput:
        raise
    except (ValueError, KeyError, OSError, EOFError, TypeError) as error:
        raise InvalidInput(f"{path}: cannot be read: {error}") from None
    raise InvalidInput(f"{path}: expected a file .npz, .npy, .mat or .mtx; rollbem lcp reads others")


# ---- Gambit ---------------------------------------------------------------------------------

_TOKEN = re.compile(r'\s*(?:"((?:[^"\\]|\\.)*)"|([{}])|([^\s{}",]+)|,)')


def _tokens(path: str, text: str) -> "Iterator[tuple[str, str]]":
    """("text", ...), ("sign", "{"), ("word", "3/2"); commas are blanks."""
    at, text = 0, text.rstrip()
    while at < len(text):
        token = _TOKEN.match(text, at)
        if not token:
            line = text.count("\n", 0, at) + 1
            raise InvalidInput(f"{path}:{line}: expected a number, a name in quotes or a brace, got {text[at:at + 20]!r}")
        at = token.end()
        if token[1] is not None:
            yield "text", token[1].replace('\\"', '"')
        elif token[2]:
            yield "sign", token[2]
        elif token[3]:
            yield "word", token[3]


def _payoff(path: str, word: str) -> float:
    numerator, slash, denominator = word.partition("/")
    try:
        value = float(numerator) / float(denominator) if slash else float(numerator)
    except (ValueError, ZeroDivisionError):
        value = np.nan
    if not np.isfinite(value):
        raise InvalidInput(f"{path}: expected a payoff, got '{word}'")
    return value


def _braces(path: str, tokens: "Iterator[tuple[str, str]]") -> list:
    """What stands between a brace that is open and its end; lists in lists."""
    found: list = []
    for kind, word in tokens:
        if (kind, word) == ("sign", "}"):
            return found
        found.append(_braces(path, tokens) if (kind, word) == ("sign", "{") else (kind, word))
    raise InvalidInput(f"{path}: a brace is not closed")


def gambit(path: str) -> "tuple[np.ndarray, np.ndarray]":
    """Payoffs A and B of a strategic game of two players (NFG 1), payoffs or outcomes."""
    _exists(path)
    with open(path, encoding="utf-8", errors="replace") as file:
        tokens = _tokens(path, file.read())
    head = [word for _, word in (next(tokens, ("", "")), next(tokens, ("", "")), next(tokens, ("", "")))]
    if head[0] == "EFG":
        raise InvalidInput(f"{path}: a game in extensive form (EFG); expected a strategic one (NFG), "
                           "as gambit-convert writes it")
    if head[0] != "NFG" or head[1] != "1" or head[2] not in ("R", "D"):
        raise InvalidInput(f"{path}: expected NFG 1 R, got {' '.join(head).strip() or 'nothing'}")
    rest: list = []
    for kind, word in tokens:
        if (kind, word) == ("sign", "}"):
            raise InvalidInput(f"{path}: a brace that was not opened")
        rest.append(_braces(path, tokens) if (kind, word) == ("sign", "{") else (kind, word))
    lists = [part for part in rest if isinstance(part, list)]
    if len(lists) < 2:
        raise InvalidInput(f"{path}: expected the players and their strategies in braces")
    if len(lists[0]) != 2:
        raise InvalidInput(f"{path}: {len(lists[0])} players, expected 2")
    counts = [len(of) if isinstance(of, list) else int(of[1]) if of[1].isdigit() else 0 for of in lists[1]]
    if len(counts) != 2 or min(counts) < 1:
        raise InvalidInput(f"{path}: expected the strategies of 2 players, got {len(counts)}")
    m, n = counts
    words = [part[1] for part in rest[rest.index(lists[1]) + 1:] if isinstance(part, tuple) and part[0] == "word"]
    if len(lists) > 2:  # outcomes { { "name" 3, 1 } ... }, and one of them per profile; 0: payoffs zero
        outcomes = [[0.0, 0.0]]
        for of in lists[2]:
            numbers = [_payoff(path, word) for kind, word in of if kind == "word"] if isinstance(of, list) else []
            if len(numbers) != 2:
                raise InvalidInput(f"{path}: outcome {len(outcomes)}: expected 2 payoffs, got {len(numbers)}")
            outcomes.append(numbers)
        if not all(word.isdigit() and int(word) < len(outcomes) for word in words):
            raise InvalidInput(f"{path}: expected numbers of outcomes from 0 to {len(outcomes) - 1}")
        numbers = [x for word in words for x in outcomes[int(word)]]
    else:
        numbers = [_payoff(path, word) for word in words]
    if len(numbers) != 2 * m * n:
        raise InvalidInput(f"{path}: expected {m * n} profiles of {m} x {n} strategies with 2 payoffs each, "
                           f"got {len(numbers)} payoffs")
    both = np.reshape(numbers, (n, m, 2))  # the first player's strategy is the fastest
    return both[:, :, 0].T.copy(), both[:, :, 1].T.copy()
