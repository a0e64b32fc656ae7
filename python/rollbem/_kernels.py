"""The kernels of OpenBLAS, chosen before it is loaded.

An OpenBLAS older than the processor takes slow kernels unless OPENBLAS_CORETYPE, which it
reads while it is loaded, names better ones.  A child process loads the library and asks it
which.  Where OpenBLAS is in this process already (NumPy may have brought it) its choice stays.
"""

import ctypes
import os


def choose(library: str) -> None:
    if "OPENBLAS_CORETYPE" in os.environ or not hasattr(os, "fork") or _is_loaded():
        return
    answer, question = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            better = ctypes.CDLL(library).rb_blas_better_core
            better.restype = ctypes.c_char_p
            os.write(question, better() or b"")
        finally:
            os._exit(0)
    os.close(question)
    with os.fdopen(answer, "rb") as pipe:
        core = pipe.read().decode()
    os.waitpid(child, 0)
    if core:
        os.environ["OPENBLAS_CORETYPE"] = core


def _is_loaded() -> bool:
    try:
        with open("/proc/self/maps") as maps:
            return "openblas" in maps.read()
    except OSError:
        return True
