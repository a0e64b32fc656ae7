"""Builds wheel and source archive (PEP 517) with what Python brings along: nothing is fetched.

The wheel holds the C library, made by the project's Makefile, from the checkout around this
folder or from the sources inside the archive, and the page for browsers where it has been built
(make page).  The same sources give the same bytes.
"""

import base64
import gzip
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE / "library" if (HERE / "library").is_dir() else HERE.parent
OF_LIBRARY = ("Makefile", "LICENSE", "include", "src", "tools/scripts")
OF_PACKAGE = ("README.md", "pyproject.toml", "build_backend.py", "rollbem", "tests", "examples")

VERSION = re.search(r'RB_VERSION "(.*)"', (SOURCE / "include/rollbem/base.h").read_text()).group(1)
INFO = f"rollbem-{VERSION}.dist-info"


def _metadata():
    return f"""Metadata-Version: 2.1
Name: rollbem
Version: {VERSION}
Summary: Rolling contact with friction in two dimensions, by boundary elements
License: GPL-3.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: pictures
Requires-Dist: matplotlib; extra == 'pictures'
Description-Content-Type: text/markdown

{(HERE / "README.md").read_text()}"""


def _tag(pure=False):
    return "py3-none-any" if pure else f"py3-none-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _library():
    """The bytes of librollbem.so, without what only debuggers read."""
    made = os.environ.get("ROLLBEM_LIBRARY")
    if not made:
        made = str(SOURCE / "build/librollbem.so")
        subprocess.run(["make", "-C", str(SOURCE), f"-j{os.cpu_count()}", "build/librollbem.so"],
                       check=True, stdout=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        stripped = Path(folder) / "librollbem.so"
        try:
            subprocess.run(["strip", "--strip-unneeded", "-o", str(stripped), made], check=True)
        except FileNotFoundError:
            shutil.copy(made, stripped)
        return stripped.read_bytes()


def _files(folder, names):
    """(path relative to folder, bytes) of all files below the names, in a fixed order."""
    for name in names:
        top = folder / name
        below = sorted(top.rglob("*")) if top.is_dir() else [top]
        for path in below:
            if path.is_file() and path.suffix not in (".pyc", ".so") and path.name != "_version.py":
                yield path.relative_to(folder).as_posix(), path


def _pack_wheel(folder, files, pure=False):
    files = {**files, f"{INFO}/METADATA": _metadata().encode(), f"{INFO}/WHEEL":
             f"Wheel-Version: 1.0\nGenerator: rollbem\nRoot-Is-Purelib: {str(pure).lower()}\nTag: {_tag(pure)}\n".encode(),
             f"{INFO}/LICENSE": (SOURCE / "LICENSE").read_bytes()}
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{INFO}/RECORD"] = f"{record}{INFO}/RECORD,,\n".encode()
    wheel = f"rollbem-{VERSION}-{_tag(pure)}.whl"
    with zipfile.ZipFile(Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name)  # of 1980: the same whenever it is made
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return wheel


def _page():
    """The page for browsers as it is built, or as an archive of sources brings it along; None where it is neither."""
    places = (Path(os.environ.get("ROLLBEM_LIBRARY") or SOURCE / "build/librollbem.so").with_name("rollbem.html"),
              SOURCE / "build/rollbem.html", SOURCE / "rollbem.html")
    found = next((place for place in places if place.is_file()), None)
    return found and found.read_bytes()


def _stubs():
    """Types for editors, made by the package itself: empty where NumPy is absent, which it needs."""
    made = subprocess.run([sys.executable, "-m", "rollbem._stubs"], capture_output=True, cwd=HERE,
                          env={**os.environ, "PYTHONPATH": str(HERE), "PYTHONDONTWRITEBYTECODE": "1"})
    return made.stdout if made.returncode == 0 else b""


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    files = {name: path.read_bytes() for name, path in _files(HERE, ["rollbem"])}
    files["rollbem/_version.py"] = f'VERSION = "{VERSION}"\n'.encode()
    files["rollbem/librollbem.so"] = _library()
    for name, data in (("__init__.pyi", _stubs()), ("rollbem.html", _page())):
        if data:
            files[f"rollbem/{name}"] = data
    return _pack_wheel(wheel_directory, files)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Python looks into this folder; the library is that of the checkout's build/."""
    return _pack_wheel(wheel_directory, {"rollbem.pth": f"{HERE}\n".encode()}, pure=True)


def build_sdist(sdist_directory, config_settings=None):
    root = f"rollbem-{VERSION}"
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        def add(name, data, executable=False):
            entry = tarfile.TarInfo(f"{root}/{name}")
            entry.size, entry.mode = len(data), 0o755 if executable else 0o644
            archive.addfile(entry, io.BytesIO(data))

        add("PKG-INFO", _metadata().encode())
        for prefix, folder, names in (("", HERE, OF_PACKAGE), ("library/", SOURCE, OF_LIBRARY)):
            for name, path in _files(folder, names):
                add(prefix + name, path.read_bytes(), os.access(path, os.X_OK))
        page = _page()
        if page:
            add("library/rollbem.html", page)
    with open(Path(sdist_directory) / f"{root}.tar.gz", "wb") as file:
        with gzip.GzipFile(filename="", mode="wb", fileobj=file, mtime=0) as archive:
            archive.write(packed.getvalue())
    return f"{root}.tar.gz"
