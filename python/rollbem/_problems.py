"""Problems by themselves: complementarity, games, friction."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _files, _values
from ._library import SOLVED, Handle, InvalidInput, Note, doubles, ints

Array = NDArray[np.float64]
_INACCURATE = 6


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, bytes, os.PathLike))


class Answer:
    """What a solver of :func:`lcp`, :func:`game` or :func:`friction` gave."""

    status: str
    solver: str
    iterations: int
    residual: float
    #: With ``prove=True``: ``proved``, ``isolated``, ``bound``, ``stored_within``, ``nearby`` and more.
    proof: Optional[dict] = None

    def __init__(self, handle: Handle, **arrays: Any) -> None:
        self.status = handle.word("status")
        self.solver = handle.word("task.solver")
        self.iterations = int(handle.number("task.iterations"))
        self.residual = handle.number("task.residual")
        self.__dict__.update(arrays)

    def columns(self) -> dict:
        """The arrays by name, as ``pandas.DataFrame(...)`` takes them."""
        return {name: array for name, array in self.__dict__.items() if isinstance(array, np.ndarray) and array.ndim == 1}

    def to_pandas(self) -> Any:
        """The columns as a ``pandas.DataFrame``."""
        import pandas

        return pandas.DataFrame(self.columns())

    def __repr__(self) -> str:
        return (f"<{type(self).__name__}: {self.status} by {self.solver}, {self.iterations} iterations, "
                f"residual {self.residual:.2g}>")


class Complementarity(Answer):
    """``z`` and ``w = M z + q``; ``residual`` is max \\|min(z, w)\\|, from z alone.

    ``scaled_residual``, each row's as a part of its own terms, decides whether the problem is solved.
    """

    z: Array
    w: Array
    scaled_residual: float


class Solutions(list):
    """All solutions of a small problem: their ``z``, or of a game its pairs (x, y), one after the other.

    ``of_singular_basis[k]``: other solutions may lie next to solution k. ``nearby[k]``: it is one within rounding only;
    with these numbers exactly there may be none. ``bases`` is how many were tried, ``singular`` of them have a singular
    matrix, and of ``undecided`` ones nobody knows; without any, the list is complete.
    """

    of_singular_basis: "list[bool]"
    nearby: "list[bool]"
    bases: int
    singular: int
    undecided: int
    #: With ``prove=True``: how many solutions are proved to exist, and how many at most (None: no largest number).
    number: "Optional[tuple[int, Optional[int]]]" = None

    def to_pandas(self) -> Any:
        """A row per solution."""
        import pandas

        return pandas.DataFrame([np.concatenate(one) if isinstance(one, tuple) else one for one in self])

    def __repr__(self) -> str:
        return f"<Solutions: {len(self)}; {self.bases} bases, {self.singular} singular, {self.undecided} undecided>"


class Game(Answer):
    """Mixed strategies ``x`` and ``y`` of an equilibrium; ``payoff`` is what each player receives."""

    x: Array
    y: Array
    payoff: "tuple[float, float]"

    def to_pandas(self) -> Any:
        """A row per strategy: ``player``, ``strategy``, ``probability``."""
        import pandas

        rows = [(player, k + 1, p) for player, mixed in ((1, self.x), (2, self.y)) for k, p in enumerate(mixed)]
        return pandas.DataFrame(rows, columns=["player", "strategy", "probability"])

    def __repr__(self) -> str:
        return f"<Game: {self.status}, {self.iterations} pivots; payoffs {self.payoff[0]:.6g}, {self.payoff[1]:.6g}>"


class Friction(Answer):
    """Reactions ``r`` and velocities ``u``, contacts x dimension, the normal ones first.

    ``scaled_residual`` decides whether the problem is solved.
    """

    r: Array
    u: Array
    scaled_residual: float
    notes: list

    def columns(self) -> dict:
        """A row per contact: ``r_N``, ``r_T`` (in 3D ``r_T1``, ``r_T2``), and ``u`` likewise."""
        tangential = ["T"] if self.r.shape[1] == 2 else ["T1", "T2"]
        return {f"{of}_{name}": getattr(self, of)[:, k] for of in "ru" for k, name in enumerate(["N", *tangential])}


def _made(handle: Handle, name: str, rows: int = 0) -> Array:
    """An array of the library; without unknowns there is none."""
    array = handle.array(name)
    return np.zeros((rows, 0) if rows else 0) if array is None else array


_OF_LCP = ("proved", "undecided", "isolated", "bound", "stored_within", "nearby", "margin", "norm", "least_sum")
_OF_FRICTION = ("proved", "touching", "isolated", "bound", "stored_within", "nearby", "margin", "norm", "condensed",
                "separated", "stick", "slip", "frictionless")


def _proof(handle: Handle, what: str, names: tuple) -> Optional[dict]:
    """What was proved, by name; None: nobody asked."""
    numbers = handle.array(f"{what}.proof")
    if numbers is None:
        return None
    found: dict = dict(zip(names, numbers.tolist()))
    for name in names:
        if name in ("proved", "isolated", "condensed"):
            found[name] = found[name] == 1.0
        elif name in ("undecided", "touching", "separated", "stick", "slip", "frictionless"):
            found[name] = int(found[name])
    return {**found, "reason": handle.word("task.proof.reason")}


def _list(handle: Handle, what: str, split: Optional[int] = None) -> Solutions:
    z = handle.array(f"{what}.all")
    columns = [] if z is None or z.size == 0 else list(np.atleast_2d(z.reshape(-1, order="F").reshape(
        (-1, len(z)) if z.ndim == 1 else z.shape[::-1])))
    found = Solutions((column[:split].copy(), column[split:].copy()) if split else column.copy() for column in columns)
    bases = handle.array(f"{what}.bases")
    found.of_singular_basis, found.nearby = (
        [] if flags is None else [one == 1.0 for one in np.atleast_1d(flags)]
        for flags in (handle.array(f"{what}.{name}") for name in ("singular_basis", "nearby")))
    found.bases, found.singular, found.undecided = (0, 0, 0) if bases is None else (int(x) for x in bases)
    number = handle.array(f"{what}.number")
    if number is not None:
        found.number = int(number[0]), None if np.isnan(number[1]) else int(number[1])
    return found


def lcp(M: Any, q: Any = None, solver: str = "auto", max_pivots: int = 0, *, lower: Any = None, upper: Any = None,
        start: Any = None, tol: float = 1e-10, seconds: Optional[float] = None,
        all: bool = False, prove: bool = False) -> Union[Complementarity, Solutions]:
    """Solves z >= 0, w = M z + q >= 0, z'w = 0 by "lemke", "lemke-sparse" or "newton" (P-matrices).

    "auto" takes turns between them; the ``solver`` of the answer says which of them gave it.  ``M`` is dense or a sparse
    matrix of SciPy, which stays sparse; or the name of a file, ``.npz``, ``.npy``, ``.mat`` or ``.mtx``, with M and what
    else is not given here (``q``, ``lower``, ``upper``, ``start``).
    ``lower`` and ``upper``, a number or one per row, are bounds of z, infinite where there is none (0 and infinity): w is
    >= 0 at a lower bound, <= 0 at an upper one, 0 between.  ``start`` is the z of a similar problem.  Solved is what leaves
    at most ``tol`` of ``scaled_residual``, 1e-10 or more; after ``seconds`` a run ends.
    ``all=True``: the list of all solutions of up to 22 unknowns.
    ``prove=True``: ``proof`` says what is proved of the answer, of a list ``number`` how many solutions there are.
    """
    if _is_path(M):
        given = dict(q=q, lower=lower, upper=upper, start=start)
        read = _files.problem(_values.path("M", M))
        M = read["M"]
        q, lower, upper, start = (read.get(name) if value is None else value for name, value in given.items())
    if q is None:
        raise InvalidInput("q=: expected numbers in one row, got None")
    q = _values.vector("q", q, 0)
    n = len(q)
    columns = _values.compressed("M", M, n)
    bounds = [None if bound is None and other is None else
              _values.each(name, missing if bound is None else bound, n)
              for name, bound, other, missing in (("lower", lower, upper, 0.0), ("upper", upper, lower, np.inf))]
    begin = None if start is None else _values.each("start", start, n)
    tol = _values.number("tol", tol)
    if not tol >= 1e-10:
        raise InvalidInput(f"tol=: expected a number >= 1e-10, got {_values.shown(tol)}")
    limit = 0.0 if seconds is None else _values.number("seconds", seconds)
    if not limit >= 0.0 or (seconds is not None and limit == 0.0):
        raise InvalidInput(f"seconds=: expected a number > 0, got {_values.shown(seconds)}")
    handle = Handle("solve")
    handle.check(handle.run("rb_api_prove_problems", int(prove)))
    if all and n:
        dense = np.asfortranarray(M.toarray() if hasattr(M, "toarray") else M, dtype=float)
        status = handle.run("rb_api_lcp_all", n, doubles(dense), doubles(q), *map(doubles, bounds), limit)
        if status < SOLVED:
            raise handle.error(status)
        return handle.kept(_list(handle, "lcp"), status)
    status = handle.run("rb_api_lcp_sparse", n, ints(columns[0]), ints(columns[1]), doubles(columns[2]), doubles(q),
                        *map(doubles, bounds), doubles(begin),
                        _values.word("solver", solver, "auto, lemke, lemke-sparse or newton"),
                        _values.whole("max_pivots", max_pivots), limit)
    if status < SOLVED:
        raise handle.error(status)
    if all:  # of no unknowns
        only = Solutions([np.zeros(0)])
        only.of_singular_basis, only.nearby, only.bases, only.singular, only.undecided = [False], [False], 1, 0, 0
        return handle.kept(only, status)
    found = Complementarity(handle, z=_made(handle, "lcp.z"), w=_made(handle, "lcp.w"), scaled_residual=handle.number("task.scaled_residual"),
                            proof=_proof(handle, "lcp", _OF_LCP))
    if status == _INACCURATE and found.scaled_residual <= tol:
        found.status, status = "solved", SOLVED
    return handle.kept(found, status)


def game(A: Any, B: Any = None, label: Optional[int] = None, *, max_pivots: int = 0, seconds: Optional[float] = None,
         all: bool = False, prove: bool = False) -> Union[Game, Solutions]:
    """An equilibrium of a game of two players by the method of Lemke and Howson.

    ``A`` and ``B`` are the payoffs of the row and of the column player (``B`` None: -A); or ``A`` names a file of Gambit,
    ``.nfg``.  ``label`` 1, 2, ...: the strategy, rows first, that the path begins with; other labels may lead elsewhere.
    ``all=True``: the list of all extreme equilibria, pairs (x, y), of games with 22 strategies at most.
    ``prove=True``: ``proof``, of a list ``number``, as of :func:`lcp`.
    """
    if _is_path(A):
        if B is not None:
            raise InvalidInput("B=: the file of the game has it")
        A, B = _files.gambit(_values.path("A", A))
    A = _values.table("A", A)
    B = -A if B is None else _values.table("B", B)
    if A.shape != B.shape:
        raise InvalidInput(f"B=: expected {A.shape[0]} x {A.shape[1]} payoffs, got {B.shape[0]} x {B.shape[1]}")
    m, n = A.shape
    first = -1 if label is None else _values.whole("label", label, 1, m + n) - 1
    limit = 0.0 if seconds is None else _values.number("seconds", seconds)
    handle = Handle("solve")
    handle.check(handle.run("rb_api_prove_problems", int(prove)))
    status = handle.run("rb_api_game", m, n, doubles(np.asfortranarray(A)), doubles(np.asfortranarray(B)), first, int(all),
                        _values.whole("max_pivots", max_pivots), limit)
    if status < SOLVED:
        raise handle.error(status)
    if all:
        return handle.kept(_list(handle, "game", m), status)
    z = handle.array("game.z")
    return handle.kept(Game(handle, x=z[:m], y=z[m:], payoff=tuple(x + 0.0 for x in handle.array("game.payoff").tolist()),
                            proof=_proof(handle, "game", _OF_LCP)), status)


def friction(W: Any, q: Any = None, mu: Any = None, dimension: int = 3, solver: str = "auto",
             tol: float = 1e-8, max_iters: int = 0, measure: str = "scaled", prove: bool = False) -> Friction:
    """Solves u = W r + q under Coulomb's law; per contact the normal row comes first.

    ``W`` is dense or a sparse matrix of SciPy, which stays sparse; ``mu`` is a number or one per contact.
    ``friction("file.hdf5")`` reads FCLib or Siconos.
    ``measure="acary"``: (13) of Acary, ``residual``, decides instead of ``scaled_residual``; where a
    problem is solved in the scaled measure alone, a warning (:class:`Note`) says so.
    ``prove=True``: ``proof`` says whether a solution with these zones is proved to exist, and how near it is.
    """
    handle = Handle("solve")
    handle.check(handle.run("rb_api_prove_problems", int(prove)))
    handle.check(handle.run("rb_api_friction_measure", _values.word("measure", measure, "scaled or acary")))
    how = (_values.word("solver", solver, "a name of rollbem friction or auto"), _values.number("tol", tol),
           _values.whole("max_iters", max_iters))
    if q is None:
        if not _is_path(W):
            raise InvalidInput("q=: expected numbers with a matrix W; alone, W names a file")
        if mu is not None:
            raise InvalidInput("mu=: the file of the problem has its own")
        status = handle.run("rb_api_friction_file", os.fsencode(_values.path("W", W)), *how)
    else:
        dimension, q = _values.whole("dimension", dimension, 2, 3), _values.vector("q", q, 0)
        if len(q) % dimension:
            raise InvalidInput(f"q=: expected a multiple of dimension={dimension} numbers, got {len(q)}")
        contacts = len(q) // dimension
        mu = _values.vector("mu", mu, min(contacts, 1))
        if len(mu) not in (1, contacts):
            raise InvalidInput(f"mu=: expected a number or one per contact ({contacts}), got {len(mu)}")
        mu = np.ascontiguousarray(np.broadcast_to(mu, contacts))
        if hasattr(W, "tocsc"):
            columns = _values.compressed("W", W, len(q))
            status = handle.run("rb_api_friction_sparse", dimension, contacts, ints(columns[0]), ints(columns[1]),
                                doubles(columns[2]), doubles(q), doubles(mu), *how)
        else:
            W = _values.matrix("W", W, len(q))
            status = handle.run("rb_api_friction", dimension, contacts, doubles(W), doubles(q), doubles(mu), *how)
    if status < SOLVED:
        raise handle.error(status)
    r, u = (_made(handle, f"friction.{name}", dimension) for name in "ru")
    found = Friction(handle, r=np.atleast_2d(r.T), u=np.atleast_2d(u.T))
    found.scaled_residual = handle.number("task.scaled_residual")
    found.notes, found.proof = handle.notes(), _proof(handle, "friction", _OF_FRICTION)
    for note in found.notes:
        warnings.warn(note, Note, stacklevel=2)
    return handle.kept(found, status)
