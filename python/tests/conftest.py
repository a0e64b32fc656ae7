"""Verdicts as tests/run reads them, and the program to compare with."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = str((ROOT / os.environ.get("B", "build") / "rollbem").resolve())

sys.path.insert(0, str(ROOT / "python"))
os.environ.setdefault("MPLBACKEND", "Agg")

import rollbem  # noqa: E402, F401  before NumPy, so that both sides run the same kernels of OpenBLAS


def pytest_addoption(parser):
    parser.addoption("--verbose", type=int, default=0)  # asked for also where nothing is printed by pytest


def pytest_runtest_logreport(report):
    name = report.nodeid.split("::")[-1]
    if report.failed:
        print(f"[  FAILED  ] {name}\n{report.longreprtext}", flush=True)
    elif report.skipped and report.when != "teardown":
        print(f"[  SKIPPED ] {name}: {report.longrepr[2]}", flush=True)
    elif report.when == "call":
        print(f"[       OK ] {name}", flush=True)


def pytest_collectreport(report):
    if report.failed:
        print(f"[  FAILED  ] {report.nodeid}\n{report.longreprtext}", flush=True)


def in_turn(k, parts):
    """For tests too long for every run: k-th of those that take turns, as tests/check.h has them."""
    turn = os.environ.get("ROLLBEM_TEST_TURN")
    return pytest.mark.skipif(turn is not None and "ROLLBEM_TEST_ALL" not in os.environ and (k + int(turn)) % parts != 0,
                              reason=f"its turn comes every {parts} days")


def words(options):
    """Options of Python as those of the program."""
    for name, value in options.items():
        name = f"--{name.replace('_', '-')}"
        if isinstance(value, bool):
            yield f"{name}={'yes' if value else 'no'}"
        else:
            yield f"{name}={','.join(map(repr, value)) if isinstance(value, list) else value}"


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments), *words(options)], capture_output=True, text=True)


def run_json(*arguments, **options):
    return json.loads(run(*arguments, "--json", **options).stdout)


@pytest.fixture
def in_root(monkeypatch):
    monkeypatch.chdir(ROOT)
