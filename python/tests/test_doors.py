"""Doors besides solve: wear, the program's own commands, tables, notebooks, types for editors."""

import ast
import importlib
import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from conftest import PROGRAM, ROOT, words

import rollbem

ROLLED = dict(support="halfplane", similar=True, formulation="steady", load=500.0, creep_ratio=0.5)
PRESSED = dict(support="halfplane", similar=True, gap="parabola", load=200.0, contact_elements=40)


def module(name):
    return pytest.importorskip(name)


@pytest.fixture(autouse=True)
def program(monkeypatch):
    monkeypatch.setenv("ROLLBEM_PROGRAM", PROGRAM)


# ---- Wear ---------------------------------------------------------------------------------


def test_wear_is_that_of_the_program():
    found = rollbem.wear(coefficient=1e-10, slide=1e6, steps=5, share=0.25, **PRESSED)
    command = [PROGRAM, "wear", *words(PRESSED), "--wear-coefficient", "1e-10", "--slide", "1e6", "--wear-steps", "5",
               "--wear-share", "0.25", "--json", "--quiet"]
    printed = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["wear"]
    for name, column in found.columns().items():
        key = next(k for k in printed if k == name or k.startswith(f"{name}_mm") or k.startswith(f"{name}_N")
                   or k.startswith(f"{name}_MPa") or k.startswith(f"{name}_cycles"))
        assert np.allclose(column, printed[key], rtol=1e-12, atol=0.0), name
    # Archard: K P per slid length, of which A loses three quarters
    assert found.worn[-1] == pytest.approx(0.75 * 1e-10 * 200.0 * 1e6, rel=1e-9)
    assert len(found.x) == len(found.depth) and max(found.depth) == pytest.approx(found.max_depth[-1])
    assert "5 steps" in repr(found)


def test_wear_refuses_in_keywords():
    for wrong, said in ((dict(), "slide= or cycles="), (dict(slide=1.0, cycles=2.0), "slide= or cycles="),
                        (dict(slide=1.0, law="abrasion"), "archard or dissipation"),
                        (dict(slide="long"), "slide=: expected a number"),
                        (dict(slide=1.0, steps=0), "steps=: expected a whole number")):
        with pytest.raises(rollbem.InvalidInput, match=said):
            rollbem.wear(coefficient=1e-10, **wrong, **PRESSED)


# ---- The program's commands ---------------------------------------------------------------


def test_check_finds_a_changed_number(tmp_path):
    file = tmp_path / "result.json"
    subprocess.run([PROGRAM, *words(ROLLED), "--json", "--quiet", "--output", str(file)], check=True)
    found = rollbem.check(file)
    assert found and found.valid and "numbers computed again" in found.findings[0]
    result = json.loads(file.read_text())
    result["summary"]["tangential_load"] *= 1.0001
    file.write_text(json.dumps(result))
    found = rollbem.check(file)
    assert not found and "tangential_load" in " ".join(found.findings) and "violated" in repr(found)
    with pytest.raises(rollbem.MissingFile):
        rollbem.check(tmp_path / "nowhere.json")
    with pytest.raises(rollbem.InvalidInput):
        rollbem.check(ROOT / "LICENSE")
    with pytest.raises(rollbem.InvalidInput, match="file=: expected the name of a file"):
        rollbem.check(3)


def test_contact_runs_the_cases_of_a_file(tmp_path):
    file = tmp_path / "carter.inp"
    shutil.copy(ROOT / "tests/fuzz/contact/steady", file)
    cases = rollbem.contact(file, tractions=True)
    assert cases[0]["status"] == "solved" and "1 of 1 solved" in repr(cases)
    assert len(cases[0]["table"]["x_mm"]) == cases[0]["NPOT"]


def test_verify_gives_every_reference():
    found = rollbem.verify()
    printed = (ROOT / "tests/recorded/verify").read_text()  # what the program prints, by tests/test_recorded.c
    assert len(found) == sum("wanted" in line for line in printed.splitlines()) > 100
    assert found and all(row.error <= row.bound for row in found)
    assert "<table>" in found._repr_html_()


def test_examples_have_names_and_whole_sentences():
    found = rollbem.examples()
    assert {"carter", "rail", "hertz"} <= set(found)
    assert all(text.endswith((".", ")")) for text in found.values())


def test_hardness_by_each_relation():
    found = rollbem.rubber(shore="60A")
    assert [round(E, 3) for E in found.relations.values()] == [3.605, 3.489, 5.884]
    assert (found.young_least, found.young_largest) == (found.relations["BS 903"], found.relations["Qi, Joyce and Boyce"])
    assert rollbem.rubber(shore=60) == found and len(found.to_pandas()) == 3
    assert rollbem.rubber(pj=100, units="si").young == pytest.approx(3.7685e6, rel=1e-4)
    with pytest.raises(rollbem.InvalidInput, match="one of shore= 60A and pj=100"):
        rollbem.rubber()
    with pytest.raises(rollbem.InvalidInput, match="20 to 90"):
        rollbem.rubber(shore="95A")


def test_moduli_become_a_material():
    omega = np.logspace(-2, 4, 31)
    E = 10 / (1 + sum(f / (1 + 1j * omega * tau) for f, tau in ((0.5, 1e-3), (1.5, 0.1), (0.8, 5))))
    columns = {"omega_rad/s": omega, "storage_modulus_MPa": E.real, "tan_delta": E.imag / E.real}
    found = rollbem.prony(columns, per_decade=2)
    assert np.allclose(found.material["relaxation_ratio"], [0.499, 1.5, 0.804], atol=6e-4)
    assert found.rms == pytest.approx(1.2e-3, abs=5e-5) and len(found.points["omega"]) == 31
    rolled = rollbem.solve(**found.material, poisson=0.5, support="halfplane", formulation="steady", load=1.0, speed=100.0)
    assert rolled.hysteresis > 0
    with pytest.warns(rollbem.Note, match="largest deviation"):
        coarse = rollbem.prony(columns, per_decade=0.5)
    assert len(coarse.to_pandas()) == 31 and "terms" in repr(coarse)
    with pytest.raises(rollbem.InvalidInput, match="Hz or rad/s"):
        rollbem.prony({**{k: v for k, v in columns.items() if k != "omega_rad/s"}, "omega": omega})
    file = str(ROOT / "examples/roll/rubber.tsv")
    printed = subprocess.run([PROGRAM, "prony", file, "--json", "--quiet"], capture_output=True, check=True).stdout
    assert rollbem.prony(file).material["young"] == json.loads(printed)["young"]


def test_without_the_program_the_line_says_so(monkeypatch, tmp_path):
    monkeypatch.delenv("ROLLBEM_PROGRAM")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(importlib.import_module("rollbem._program"), "LIBRARY", str(tmp_path / "librollbem.so"))
    with pytest.raises(rollbem.MissingFile, match="ROLLBEM_PROGRAM"):
        rollbem.verify()


# ---- What is shown of a result ----------------------------------------------------------------


def test_results_say_what_they_are():
    rolled = {k: v for k, v in ROLLED.items() if k != "creep_ratio"}
    for result, said in (
            (rollbem.curve(points=5, **rolled), "5 points, creep_ratio 0 ... 1.5, mu = 0.3; largest |Q|/(mu P) 1>"),
            (rollbem.history({"distance": [0, 1], "creep_ratio": [0, 0.4]}, support="halfplane", load=500.0, steps=4),
             "5 steps over 1 half-widths; at the end P = 500 N/mm, Q = -"),
            (rollbem.sweep(mu=[0.1, 0.3], **ROLLED), "2 mu; 2 of 2 solved")):
        assert said in repr(result) and "\n" not in repr(result) and len(repr(result)) < 140


# ---- Progress -----------------------------------------------------------------------------


def test_progress_is_told_while_it_runs():
    seen = []
    rollbem.sweep(mu=[0.1 + k / 1e3 for k in range(60)], contact_elements=60, progress=lambda *at: seen.append(at))
    assert seen[-1] == (60, 60) and seen == sorted(seen) and {total for _, total in seen} == {60}
    for call, total in ((lambda p: rollbem.history({"distance": [0, 2], "creep_ratio": [0, 0.4]}, steps=50, load=500.0,
                                                   support="halfplane", progress=p), 51),
                        (lambda p: rollbem.curve(points=40, support="halfplane", load=500.0, progress=p), 40),
                        (lambda p: rollbem.curve(points=10, support="halfplane", load=500.0, error=True, progress=p), 30),
                        (lambda p: rollbem.wear(coefficient=1e-10, slide=1e6, steps=6, progress=p, **PRESSED), 6)):
        seen.clear()
        call(lambda *at: seen.append(at))
        assert seen[-1] == (total, total)


def test_progress_for_tqdm():
    tqdm = module("tqdm")
    with tqdm.tqdm(total=20, disable=None) as bar:
        rollbem.sweep(mu=[0.1 + k / 1e3 for k in range(20)], contact_elements=30,
                      progress=lambda done, total: bar.update(done - bar.n))
        assert bar.disable or bar.n == 20


def test_an_error_of_progress_ends_the_run():
    def full(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        rollbem.sweep(mu=[0.1 + k / 1e5 for k in range(2000)], contact_elements=60, progress=full)
    with pytest.raises(rollbem.InvalidInput, match="progress=: expected a function of done and total, got 3"):
        rollbem.solve(mu=0.3, progress=3)


# ---- Tables, notebooks, types -------------------------------------------------------------


def test_tables_for_pandas():
    module("pandas")
    frame = rollbem.solve(**ROLLED).to_pandas()
    assert {"x", "p", "q", "zone"} <= set(frame.columns) and frame.attrs["units"]["p"] == "MPa"
    study = rollbem.sweep(mu=[0.1, 0.3], creep_ratio=[0.2, 0.4, 0.6],
                          **{k: v for k, v in ROLLED.items() if k != "creep_ratio"}).to_pandas()
    assert len(study) == 6 and list(study["mu"]) == [0.1] * 3 + [0.3] * 3
    stress = rollbem.stress(grid=(5, 3), **ROLLED).to_pandas()
    assert len(stress) == 15 and {"x", "y", "von_mises"} <= set(stress.columns)
    wear = rollbem.wear(coefficient=1e-10, slide=1e6, steps=3, **PRESSED).to_pandas()
    assert len(wear) == 4 and wear["worn"].is_monotonic_increasing


def test_notebooks_show_pictures():
    module("matplotlib")
    from matplotlib import pyplot

    open_before = pyplot.get_fignums()  # of tests before this one

    results = [rollbem.solve(**ROLLED), rollbem.curve(points=5, **{k: v for k, v in ROLLED.items() if k != "creep_ratio"}),
               rollbem.stress(grid=(9, 7), **ROLLED), rollbem.wear(coefficient=1e-10, slide=1e6, steps=3, **PRESSED),
               rollbem.sweep(mu=[0.1, 0.3], **ROLLED), rollbem.history({"distance": [0, 1], "creep_ratio": [0, 0.4]},
                                                                     support="halfplane", load=500.0, steps=4)]
    for result in results:
        shown = result._repr_html_()
        assert "<svg" in shown and type(result).__name__ in shown
    assert pyplot.get_fignums() == open_before  # nothing more is left open
    assert "<pre>" in rollbem.stress(points=[[0.0, 0.5]], **ROLLED)._repr_html_()  # no picture of points


def test_a_notebook_runs_through():
    nbformat, nbclient = module("nbformat"), module("nbclient")
    module("ipykernel"), module("matplotlib"), module("pandas")
    cells = ["import sys; sys.path.insert(0, %r)\nimport rollbem" % str(ROOT / "python"),
             "s = rollbem.solve(support='halfplane', similar=True, formulation='steady', load=500, creep_ratio=.4)\ns",
             "s.to_pandas().head()", "rollbem.curve(points=5, support='halfplane', similar=True, load=500)"]
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3",
                            resources={"metadata": {"path": str(ROOT)}}).execute()
    shown = [output["data"] for cell in book.cells for output in cell.outputs if "data" in output]
    assert "<svg" in shown[0]["text/html"] and "-0.64" not in shown[1]["text/plain"] and "<svg" in shown[2]["text/html"]


def test_types_for_editors():
    stub = subprocess.run([sys.executable, "-m", "rollbem._stubs"], cwd=ROOT / "python", capture_output=True,
                          text=True, check=True).stdout
    tree = ast.parse(stub)
    names = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    assert {name for name in rollbem.__all__ if name[0].islower() and name != "pictures"} <= names
    solve = next(node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == "solve")
    assert {argument.arg for argument in solve.args.kwonlyargs} >= set(rollbem.OPTIONS)
    solution = next(node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == "Solution")
    fields = {node.target.id for node in solution.body if isinstance(node, ast.AnnAssign)}
    assert {"p", "q", "normal_load", "yield_"} <= fields
    assert "Literal['arc', 'hub', 'halfplane']" in stub


def test_types_are_those_of_a_checker(tmp_path):
    if not shutil.which("mypy"):
        pytest.skip("no mypy")
    package = tmp_path / "rollbem"
    shutil.copytree(ROOT / "python/rollbem", package, ignore=shutil.ignore_patterns("__pycache__"))
    stub = subprocess.run([sys.executable, "-m", "rollbem._stubs"], cwd=ROOT / "python", capture_output=True, check=True).stdout
    (package / "__init__.pyi").write_bytes(stub)
    (tmp_path / "use.py").write_text(
        "import rollbem\n"
        "s = rollbem.solve(mu=0.3, creep=0.1, progress=lambda done, total: None)\n"
        "largest: float = s.p.max() + s.normal_load\n"
        "value: float = rollbem.fit({'creep': [1.0], 'force': [2.0]}, 'mu')['mu'].value\n"
        "held: bool = bool(rollbem.verify())\n"
        "about: str = rollbem.examples()['rail']\n"
        "rollbem.sweep(mu=[0.1, 0.2], progress=print)\n"
        "import numpy as np\n"
        "from decimal import Decimal\n"
        "x = np.linspace(-1, 1, 5)\n"
        "rollbem.solve(gap=np.column_stack([x, x * x]), mu=Decimal('0.3'), load='1kN/mm', similar=0)\n"
        "rollbem.solve(gap={'x': x, 'gap': x * x}, load=np.float32(3), contact_elements=np.int64(20), solver='nsgs-ac')\n"
        "rollbem.sweep(rollbem.Case(load=3), mu=x, load=['100kN/m'], support=['arc', 'hub'])\n"
        "rollbem.history({'distance': [0, 4], 'creep': x}, load=500, support='halfplane').q\n"
        "K: float = rollbem.crack(crack_angle=30, fluid='trapped').K_I_max\n"
        "rollbem.curve(mu=[0.1, 0.3])\n"
        "z: float = rollbem.game([[1, -1], [-1, 1]])\n"
        "rollbem.solve(support='banana')\n"
        "rollbem.solve(progres=3)\n")
    told = subprocess.run(["mypy", "--follow-imports=silent", "--cache-dir", str(ROOT / os.environ.get("B", "build") / "mypy"), "use.py",
                           "rollbem/__init__.pyi"], cwd=tmp_path, capture_output=True, text=True).stdout
    errors = [line for line in told.splitlines() if "error:" in line]
    assert len(errors) == 3 and all(line.startswith("use.py") for line in errors), told
    assert "Game" in errors[0] and "'banana'" in errors[1] and "progres" in errors[2]
