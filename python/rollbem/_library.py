"""The C library behind the package: found, checked, declared (include/rollbem/api.h)."""

from __future__ import annotations

import ctypes
import _thread
import os
import re
import threading
from pathlib import Path
from typing import Any, Callable, NamedTuple, Optional

from . import _kernels

_HERE = Path(__file__).resolve().parent
_CHECKOUT = _HERE.parent.parent


def _find() -> str:
    """ROLLBEM_LIBRARY, the library of the wheel, of the checkout, or of the system."""
    beside = [_HERE / "librollbem.so", _CHECKOUT / "build/librollbem.so"]
    return os.environ.get("ROLLBEM_LIBRARY") or next(
        (str(path) for path in beside if path.exists()), "librollbem.so.0")


_kernels.choose(_find())  # before NumPy, which may load the same OpenBLAS

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

_Handle, _Int, _Double, _Text = ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_char_p
_Doubles, _Ints = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_int)

FUNCTIONS = {
    "rb_version": (_Text,),
    "rb_api_create_for": (_Handle, _Text),
    "rb_api_free": (None, _Handle),
    "rb_api_set": (_Int, _Handle, _Text, _Text),
    "rb_api_read": (_Int, _Handle, _Text),
    "rb_api_resolve": (_Int, _Handle),
    "rb_api_solve": (_Int, _Handle),
    "rb_api_stop_until": (None, _Handle, _Ints),
    "rb_api_progress": (None, _Handle, ctypes.POINTER(_Int), ctypes.POINTER(_Int)),
    "rb_api_message": (_Text, _Handle),
    "rb_api_option": (_Text, _Int, _Text, _Text, _Int),
    "rb_api_crack_option": (_Text, _Int, _Text, _Text, _Int),
    "rb_api_result": (_Text, _Text, _Int, _Text, _Text, _Int),
    "rb_api_value": (_Text, _Handle, _Text, _Text, _Int),
    "rb_api_unit": (_Text, _Text, _Text, _Text, _Int),
    "rb_api_number": (_Double, _Handle, _Text),
    "rb_api_word": (_Text, _Handle, _Text),
    "rb_api_note": (_Text, _Handle, _Int, _Text, _Int),
    "rb_api_array": (_Handle, _Handle, _Text, _Ints, _Ints),
    "rb_api_stress_of": (_Int, _Handle, _Int),
    "rb_api_tractions": (_Int, _Handle, _Int, _Doubles, _Doubles, _Doubles),
    "rb_api_stress": (_Int, _Handle, _Int, _Int, _Double),
    "rb_api_stress_at": (_Int, _Handle, _Int, _Doubles),
    "rb_api_stress_maxima": (_Int, _Handle, _Double),
    "rb_api_crack": (_Int, _Handle, _Int, ctypes.POINTER(_Text), ctypes.POINTER(_Text)),
    "rb_api_derivatives": (_Int, _Handle),
    "rb_api_smooth_derivatives": (_Int, _Handle),
    "rb_api_curve": (_Int, _Handle, _Text, _Double, _Double, _Int, _Text, _Text),
    "rb_api_step_derivatives": (_Int, _Handle, _Text, _Text),
    "rb_api_check_derivatives": (_Int, _Handle, _Text, _Text),
    "rb_api_derivative": (_Text, _Handle, _Text, _Int, _Text, _Text, _Int),
    "rb_api_tolerances": (_Int, _Handle, _Text),
    "rb_api_input": (_Text, _Handle, _Int, _Text, _Text, _Int),
    "rb_api_fit": (_Int, _Handle, _Int, ctypes.POINTER(_Text), _Int, _Doubles, _Text, _Text, _Text, _Double, _Double),
    "rb_api_fit_file": (_Int, _Handle, _Text, _Text, _Text, _Text, _Double, _Double),
    "rb_api_design": (_Int, _Handle, _Text, _Int, _Text, _Text, _Double, _Int),
    "rb_api_pivots": (_Int, _Handle),
    "rb_api_prove": (_Int, _Handle),
    "rb_api_prove_problems": (_Int, _Handle, _Int),
    "rb_api_variable": (_Text, _Handle, _Int, _Text, _Int),
    "rb_api_lcp_sparse": (_Int, _Handle, _Int, _Ints, _Ints, _Doubles, _Doubles, _Doubles, _Doubles, _Doubles, _Text, _Int,
                          _Double),
    "rb_api_lcp_all": (_Int, _Handle, _Int, _Doubles, _Doubles, _Doubles, _Doubles, _Double),
    "rb_api_game": (_Int, _Handle, _Int, _Int, _Doubles, _Doubles, _Int, _Int, _Int, _Double),
    "rb_api_friction_measure": (_Int, _Handle, _Text),
    "rb_api_friction": (_Int, _Handle, _Int, _Int, _Doubles, _Doubles, _Doubles, _Text, _Double, _Int),
    "rb_api_friction_sparse": (_Int, _Handle, _Int, _Int, _Ints, _Ints, _Doubles, _Doubles, _Doubles, _Text, _Double, _Int),
    "rb_api_friction_file": (_Int, _Handle, _Text, _Text, _Double, _Int),
    "rb_api_wear": (_Int, _Handle, _Text, _Double, _Double, _Double, _Double, _Int, _Int),
    "rb_api_sweep": (_Int, _Handle, _Int, ctypes.POINTER(_Handle), _Text, _Text, _Int),
    "rb_api_sweep_cracks": (_Int, _Handle, _Int, ctypes.POINTER(_Handle), _Int, ctypes.POINTER(_Text),
                            ctypes.POINTER(_Text), _Int),
}


def _version_of_package() -> str:
    """What the wheel was built with; of a checkout, what its header says."""
    try:
        from ._version import VERSION

        return VERSION
    except ImportError:
        header = (_CHECKOUT / "include/rollbem/base.h").read_text()
        return re.search(r'RB_VERSION "(.*)"', header).group(1)


def _load() -> ctypes.CDLL:
    """The library with its functions declared, of the version that the package is made for."""
    found = _find()
    # OpenMP reads this once; its threads would wait for work in a loop, longer than most cases take
    waits = "OMP_WAIT_POLICY" not in os.environ
    if waits:
        os.environ["OMP_WAIT_POLICY"] = "passive"
    try:
        library = ctypes.CDLL(found)
    except OSError as error:
        raise ImportError(f"rollbem: the library does not load: {error}; in a checkout, run make first, "
                          "or name it in ROLLBEM_LIBRARY") from None
    finally:
        if waits:
            del os.environ["OMP_WAIT_POLICY"]
    for name, (result, *arguments) in FUNCTIONS.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(f"rollbem: {found} has no {name}: it is older than the package") from None
        function.restype, function.argtypes = result, arguments
    has, wants = library.rb_version().decode(), _version_of_package()
    if has != wants:
        raise ImportError(f"rollbem: {found} has version {has}, the package has {wants}")
    return library


lib = _load()
LIBRARY = os.path.abspath(_find())
VERSION = lib.rb_version().decode()

# ---- Errors -------------------------------------------------------------------------------


class Error(Exception):
    """A refusal or a failure, in the program's words.

    ``status`` is the library's number for it: negative where nothing ran, positive where a
    run ended without a full answer.
    """

    status: int = 0


class InvalidInput(Error, ValueError):
    """An option, a file or an array that does not say what it should."""


class MissingFile(Error, FileNotFoundError):
    """There is no such input file."""

    def __str__(self) -> str:
        return str(self.args[0])


class OutOfMemory(Error, MemoryError):
    """The case needs more memory than there is."""


class Unsolved(Error):
    """A run that ended without a full answer; ``solution`` holds what there is."""

    solution: Any = None


class Note(UserWarning):
    """What must be known to read a solution rightly, as ``Solution.notes`` has it."""


_KINDS = {-1: InvalidInput, -2: OutOfMemory, -3: MissingFile, -4: InvalidInput}
SOLVED = 0

# ---- Tables -------------------------------------------------------------------------------


class Option(NamedTuple):
    """A row of the table of options."""

    name: str
    section: str
    kind: str
    unit: str
    expected: str
    default: str
    choices: str
    help: str


class Result(NamedTuple):
    """A row of one of the tables of results."""

    name: str
    unit: str
    kind: str
    meaning: str


def _rows(row: Any, ask: Callable[..., Optional[bytes]], *first: Any) -> list:
    room = ctypes.create_string_buffer(4096)
    rows, k = [], 0
    while ask(*first, k, b"name", room, len(room)) is not None:
        fields = (ask(*first, k, field.encode(), room, len(room)).decode() for field in row._fields)
        rows.append(row(*fields))
        k += 1
    return rows


def _keyword(name: str) -> str:
    return name.replace("-", "_")


# What functions call otherwise than the program, which needs longer names.
_SHORTER = {"fit": "names", "wear_coefficient": "coefficient", "wear_law": "law", "wear_share": "share",
            "wear_steps": "steps"}


_all_options = _rows(Option, lib.rb_api_option)
GROUPS = {option.name: option.help for option in _all_options if option.kind == "group"}
OPTIONS = {_keyword(option.name): option for option in _all_options if option.kind != "group"}
CRACK_OPTIONS = {_keyword(option.name): option for option in _rows(Option, lib.rb_api_crack_option)
                 if option.kind != "group"}
RESULTS = {table: {result.name: result for result in _rows(Result, lib.rb_api_result, table.encode())}
           for table in ("number", "column", "step", "point", "patch", "wear", "stress", "crack", "position",
                                                            "growth")}


def unit_of(system: str, unit: str) -> str:
    """What stands for a unit of mm, N, MPa in a system, ``units`` of a case: "Pa" for "MPa" in "si"."""
    room = ctypes.create_string_buffer(80)
    return lib.rb_api_unit(system.encode(), unit.encode(), room, len(room)).decode()


# ---- Messages -----------------------------------------------------------------------------

# text of the user, options of the program with the value that a message proposes, bare names with "-"
_NAMES = re.compile(r"'(?P<quoted>[^']*)'|--(?P<option>[a-z][a-z0-9-]*[a-z0-9])(?:[ =](?P<value>[\w.+-]*\w))?"
                    r"|\b(?P<bare>[a-z]+(?:-[a-z]+)+)\b")


# The tables that were given as columns, by the files that the library reads them from.
written_tables: "dict[str, str]" = {}
_WRITTEN = re.compile(r"(?P<path>[^\s:]*rollbem-\w+\.txt)(?::(?P<line>\d+)|: (?P<again>[\w-]+)(?=:))?")


def _in_tables(found: "re.Match") -> str:
    """``layers=, row 2`` for the third line of a file that nobody has seen."""
    name = written_tables.get(found["path"])
    if name is None:
        return found[0]
    if found["line"]:
        return f"{name}=, row {int(found['line']) - 1}"
    again = found["again"]
    return f"{name}=" if not again or _keyword(again) == name else f"{name}=: {again}"


def in_keywords(text: str) -> str:
    """A message or note of the program with Python's keywords: ``mu=`` for ``--mu``."""

    def replaced(found: "re.Match") -> str:
        if found["quoted"] is not None:  # 'did you mean' names an option, all else is the user's
            return f"'{_keyword(found['quoted'][2:])}'" if found["quoted"].startswith("--") else found[0]
        if found["bare"]:
            name = _keyword(found[0])
            return name if name in OPTIONS else f"{_SHORTER[name]}=" if name in _SHORTER else found[0]
        name, value = _keyword(found["option"]), found["value"]
        option = OPTIONS.get(name)
        if option and option.kind == "flag":
            return f"{name}=True" + (f" {value}" if value else "")
        if value is None:
            return f"{_SHORTER.get(name, name)}="
        if option and value in option.choices.split():
            return f"{name}='{value}'"
        is_value = re.fullmatch(r"[-+.\d][-+.\de]*|[A-Z]", value)
        return f"{name}={value}" if is_value else f"{name}= {value}"

    return _NAMES.sub(replaced, _WRITTEN.sub(_in_tables, text))


# ---- Handles ------------------------------------------------------------------------------


class Slope(NamedTuple):
    """An array of derivatives in columns: its name, and what it is of."""

    name: str
    result: str
    input: str
    unit: str  # of the input


class _Answers:
    """What the tables of results name, read from what answers to a single name."""

    number: Callable[[str], float]
    array: "Callable[[str], Optional[NDArray[np.float64]]]"
    slopes: "Callable[[str], list[Slope]]"

    def numbers(self, table: str, prefix: str = "") -> dict:
        """The numbers of a table by name, whole ones as int; NaN where there is none."""
        values = {name: self.number(prefix + name) for name in RESULTS[table]}
        return {name: int(x) if RESULTS[table][name].kind == "whole" and x == x else x
                for name, x in values.items()}

    def arrays(self, table: str, prefix: str = "", copied: bool = False) -> dict:
        """The arrays of a table by name, whole numbers as int unless some are missing."""
        found = {}
        for name, result in RESULTS[table].items():
            array = self.array(prefix + name)
            if array is not None:
                whole = result.kind == "whole" and bool(np.isfinite(array).all())
                found[name] = array.astype(int) if whole else array.copy() if copied else array
        return found


# of a history, besides the columns of its table
HISTORY_NUMBERS = ("half_width", "steady_from", "cycle_work", "cycle_rows", "jump_row", "jump_shift", "jump_force")

# what a solution answers, besides the options: the names in include/rollbem/api.h
_NUMBERS = ([prefix + name for prefix in ("", "error.") for name in RESULTS["number"]]
            + ["carter", "radius", "modulus", "hertz_load"]
            + [f"history.{name}" for name in HISTORY_NUMBERS])
_WORDS = ("status", "formulation", "solver", "lcp-form")
_ARRAYS = (list(RESULTS["column"]) + [f"patch.{name}" for name in RESULTS["patch"]]
           + [prefix + name for prefix in ("history.", "history.error.", "history.tolerance.")
              for name in RESULTS["step"]]
           + ["step.x", "step.p", "step.q", "step.zone", "friction_power", "ends", "gap0"])


Progress = Optional[Callable[[int, int], object]]
_LOOK = 0.05  # s between two looks at how far a call is


class Handle(_Answers):
    """An ``rb_api``: freed with the last array that looks into it.

    It belongs to its process: a copy is the same handle, and what is pickled is a
    :class:`Kept` with all that the handle answers.
    """

    def __init__(self, purpose: str) -> None:
        self.purpose = purpose
        self.lock = threading.RLock()  # around a call and the reading of what it has made
        self.at = lib.rb_api_create_for(purpose.encode())
        if not self.at:
            raise OutOfMemory("out of memory")

    def __del__(self) -> None:
        if getattr(self, "at", None):
            lib.rb_api_free(self.at)

    def __copy__(self) -> "Handle":
        return self

    def __deepcopy__(self, memo: dict) -> "Handle":
        return self

    def __reduce__(self) -> tuple:
        slopes = {"history": self.slopes("history")}
        arrays = {name: self.array(name)
                  for name in [*_ARRAYS, *(f"history.derivative.{slope.name}" for slope in slopes["history"])]}
        return Kept, (self.purpose, {name: self.number(name) for name in _NUMBERS},
                      {name: self.word(name) for name in _WORDS}, self.notes(),
                      {option.name: self.value(option.name) for option in OPTIONS.values()},
                      {name: array for name, array in arrays.items() if array is not None}, slopes)

    @property
    def message(self) -> str:
        return in_keywords(lib.rb_api_message(self.at).decode(errors="replace"))

    def error(self, status: int) -> Error:
        error = _KINDS.get(status, Error if status < 0 else Unsolved)(self.message)
        error.status = status
        return error

    def check(self, status: int) -> None:
        if status != SOLVED:
            raise self.error(status)

    def kept(self, solution: Any, status: int) -> Any:
        """The solution; what ended without a full answer is raised, with what there is."""
        if status == SOLVED:
            return solution
        error = self.error(status)
        if status > SOLVED:
            error.solution = solution
        raise error

    def ask(self, function: str, *arguments: Any) -> int:
        """Calls a function that is over at once."""
        return getattr(lib, function)(self.at, *arguments)

    def set(self, option: str, text: str) -> None:
        if "\0" in option:
            raise InvalidInput(f"unknown option {option!r}")
        name = option.replace("_", "-").encode(errors="replace")
        self.check(self.ask("rb_api_set", name, text.encode(errors="surrogateescape")))

    def progress(self) -> "tuple[int, int]":
        """Steps or cases that the running call has done, and of how many; 0: it does not know."""
        done, total = _Int(), _Int()
        lib.rb_api_progress(self.at, done, total)
        return done.value, total.value

    def run(self, function: str, *arguments: Any, progress: Progress = None) -> int:
        """Calls a function that may take long; Control-C ends it, and so does an error of ``progress``.

        Python sees signals between its own instructions only, so that the call runs in a
        thread of its own while the main thread waits for it.
        """
        if progress is not None and not callable(progress):
            raise InvalidInput(f"progress=: expected a function of done and total, got {progress!r}")
        with self.lock:
            return self._run(getattr(lib, function), arguments, progress)

    def _run(self, call: Any, arguments: tuple, progress: Progress) -> int:
        if progress is None and threading.current_thread() is not threading.main_thread():
            return call(self.at, *arguments)
        status: list = []
        handle = self  # held until the call is over, also where nobody waits for it
        ended, over = _thread.allocate_lock(), ctypes.c_int(0)  # Event is not safe from signals
        ended.acquire()

        def work() -> None:
            try:
                status.append(call(handle.at, *arguments))
            finally:
                over.value = 1
                ended.release()

        try:
            try:
                _thread.start_new_thread(work, ())  # one call of C: there is a thread, or none
            except RuntimeError:
                over.value = 1
                raise
            seen = (0, 0)
            runs = True
            while runs:
                runs = not ended.acquire(True, -1 if progress is None else _LOOK)
                now = self.progress() if progress is not None else seen
                if now != seen and any(now):
                    seen = now
                    progress(*now)
        finally:
            # until its end the call uses the handle; nothing breaks in on C, also no second Control-C
            lib.rb_api_stop_until(self.at, over)
        return status[0]

    @staticmethod
    def text_room() -> Any:
        """Where the library writes a text."""
        return ctypes.create_string_buffer(4096)

    def number(self, name: str) -> float:
        return lib.rb_api_number(self.at, name.encode())

    def word(self, name: str) -> Optional[str]:
        text = lib.rb_api_word(self.at, name.encode())
        return text.decode() if text is not None else None

    def notes(self) -> list:
        """What must be known to read the solution rightly."""
        room, found = ctypes.create_string_buffer(640), []
        while (text := lib.rb_api_note(self.at, len(found), room, len(room))) is not None:
            found.append(in_keywords(text.decode()))
        return found

    def slopes(self, of: str) -> "list[Slope]":
        """The derivatives in columns of a "curve", of "history" or of a "sweep"."""
        return _rows(Slope, lib.rb_api_derivative, self.at, of.encode())

    def value(self, name: str) -> str:
        room = ctypes.create_string_buffer(4096)
        return lib.rb_api_value(self.at, name.encode(), room, len(room)).decode()

    def array(self, name: str) -> Optional[NDArray[np.float64]]:
        """The library's own memory as a read-only array, rows x columns; None: there is none.

        Valid until the handle's case changes or the array is made anew: what lives longer
        is to be copied.
        """
        rows, columns = ctypes.c_int(), ctypes.c_int()
        with self.lock:
            at = lib.rb_api_array(self.at, name.encode(), rows, columns)
        return self._look_into(at, rows, columns)

    def matrix(self, name: str) -> Optional[NDArray[np.float64]]:
        """The same of an array that takes long to make."""
        rows, columns = ctypes.c_int(), ctypes.c_int()
        return self._look_into(self.run("rb_api_array", name.encode(), rows, columns), rows, columns)

    def _look_into(self, at: Optional[int], rows: ctypes.c_int, columns: ctypes.c_int) -> Optional[NDArray[np.float64]]:
        if not at:
            return None
        memory = (ctypes.c_double * (rows.value * columns.value)).from_address(at)
        memory.handle = self
        array = np.frombuffer(memory, dtype=np.float64).reshape((rows.value, columns.value), order="F")
        array.flags.writeable = False
        return array[:, 0] if columns.value == 1 else array


class Kept(_Answers):
    """What a handle answered, without the library: of a result that was pickled."""

    def __init__(self, purpose: str, numbers: dict, words: dict, notes: list, values: dict, arrays: dict,
                 slopes: Optional[dict] = None) -> None:
        self.purpose, self._all = purpose, (numbers, words, notes, values, arrays, slopes or {})
        self._numbers, self._words, self._notes, self._values, self._arrays, self._slopes = self._all
        for array in arrays.values():
            array.flags.writeable = False

    def __reduce__(self) -> tuple:
        return Kept, (self.purpose, *self._all)

    def number(self, name: str) -> float:
        return self._numbers.get(name, float("nan"))

    def word(self, name: str) -> Optional[str]:
        return self._words[name]

    def notes(self) -> list:
        return list(self._notes)

    def slopes(self, of: str) -> "list[Slope]":
        return list(self._slopes.get(of, []))

    def value(self, name: str) -> str:
        return self._values[name]

    def array(self, name: str) -> Optional[NDArray[np.float64]]:
        return self._arrays.get(name)


def doubles(array: "Optional[NDArray[np.float64]]") -> Any:
    return None if array is None else array.ctypes.data_as(_Doubles)


def ints(array: "NDArray[np.intc]") -> Any:
    return array.ctypes.data_as(_Ints)


def texts(of: "list[str]") -> Any:
    return (_Text * max(len(of), 1))(*(os.fsencode(text) for text in of))


def handles(of: "list[Handle]") -> Any:
    """Their addresses; the handles live as long as these."""
    addresses = (_Handle * len(of))(*(handle.at for handle in of))
    addresses.of = of
    return addresses
