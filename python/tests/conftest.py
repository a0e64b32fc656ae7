"""Verdicts as tests/run reads them, and the program to compare with."""

import collections
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


def is_in_turn(k, parts):
    """Is the k-th item run, of so many parts one in each run, as tests/check.h has it?  All are where no turn is given."""
    turn = os.environ.get("ROLLBEM_TEST_TURN")
    return turn is None or "ROLLBEM_TEST_ALL" in os.environ or -(k + int(turn)) % parts < int(os.environ.get("ROLLBEM_TEST_TURNS", 1))


TURNS = 8  # of the tests of each file one in so many, and those marked @smoke in every run
smoke = pytest.mark.smoke


def pytest_configure(config):
    config.addinivalue_line("markers", "smoke: in every run of the suite")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    met, chosen = collections.Counter(), []
    for item in items:
        if is_in_turn(met[item.path], TURNS) or item.get_closest_marker("smoke"):
            chosen.append(item)
        met[item.path] += 1
    if len(chosen) < len(items):
        print(f"[  SKIPPED ] tests of other turns: {len(items) - len(chosen)} of {len(items)}", flush=True)
    items[:] = chosen


def pytest_sessionfinish(session, exitstatus):
    if exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:  # under sanitizers it may be no turn of the few
        session.exitstatus = pytest.ExitCode.OK


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
