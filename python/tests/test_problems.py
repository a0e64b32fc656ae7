"""Complementarity problems, games and friction problems by themselves, and files of other programs."""

import itertools
import random
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import rollbem
from conftest import ROOT, is_in_turn, run

sparse = pytest.importorskip("scipy.sparse")


def check(M, q, s, lower=0.0, upper=np.inf):
    """The conditions, recomputed from z alone."""
    w = M @ s.z + q
    assert np.allclose(w, s.w, atol=1e-12)
    assert np.all(s.z >= lower) and np.all(s.z <= upper)
    between = (s.z > lower) & (s.z < upper)
    assert np.abs(w[between]).max(initial=0) < 1e-9
    assert np.all(w[(s.z == lower) & (s.z < upper)] >= -1e-9) and np.all(w[(s.z == upper) & (s.z > lower)] <= 1e-9)


@pytest.mark.parametrize("lower, upper", [(None, None), (-1.0, 1.0), (-np.inf, np.inf), (0.0, [0.5, 1.0, 2.0] * 10)])
def test_bounds(lower, upper):
    rng = np.random.default_rng(1)
    A = rng.normal(size=(30, 30))
    M, q = A @ A.T + np.eye(30), rng.normal(size=30)
    bounds = {} if lower is None else dict(lower=lower, upper=upper)
    s = rollbem.lcp(M, q, **bounds)
    check(M, q, s, *((0.0, np.inf) if lower is None else (lower, np.asarray(upper))))
    again = rollbem.lcp(sparse.csr_matrix(M), q, start=s.z, **bounds)
    assert np.allclose(again.z, s.z) and again.iterations <= s.iterations


def test_sparse_matrices_stay_sparse():
    """99856 unknowns in less than 200 MB, NumPy and SciPy among them; dense they would take 80 GB."""
    program = """
import rollbem, numpy as np, scipy.sparse as sp
k = 316
line = sp.diags([-1, 2, -1], [-1, 0, 1], shape=(k, k))
x = np.linspace(0, 1, k)
q = -1e-3 * np.sin(5 * np.add.outer(x, x)).ravel()
s = rollbem.lcp((sp.kron(sp.eye(k), line) + sp.kron(line, sp.eye(k))).tocoo(), q)
print(s.status, int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0]) // 1024)  # since exec
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=ROOT / "python")
    status, megabytes = done.stdout.split()
    assert status == "solved" and int(megabytes) < 200


def test_sparse_friction_is_dense_friction():
    W = sparse.block_diag([np.eye(3) + 0.1] * 20).tolil()
    W[0, 5] = W[5, 0] = 0.2
    q = np.random.default_rng(2).normal(size=60)
    q[::3] = -1.0
    one, other = (rollbem.friction(matrix, q, 0.5) for matrix in (W, W.toarray()))
    assert np.allclose(one.r, other.r, atol=1e-7)
    frame = pytest.importorskip("pandas") and one.to_pandas()
    assert list(frame.columns) == ["r_N", "r_T1", "r_T2", "u_N", "u_T1", "u_T2"] and len(frame) == 20


def test_all_solutions():
    M = np.array([[1.0, 3.0], [3.0, 1.0]])
    found = rollbem.lcp(M, [-2, -3], all=True)
    assert sorted(map(tuple, np.round(found, 12))) == [(0, 3), (0.875, 0.375), (2, 0)]
    assert found.bases == 4 and found.undecided == 0
    with pytest.raises(rollbem.Unsolved, match="no solution") as none:
        rollbem.lcp(np.zeros((2, 2)), [-1, 1], all=True)
    assert none.value.solution == []
    four = [line.split() for line in run("lcp", "--all", "--solution", ROOT / "examples/lcp/murty.txt").stdout.splitlines()
            if line and not line.startswith("#")]
    assert len(four) > 1  # what the program lists it lists as well


def test_games():
    prisoners = rollbem.game([[3, 0], [5, 1]], [[3, 5], [0, 1]])
    assert prisoners.x.tolist() == [0, 1] and prisoners.payoff == (1, 1)
    coins = rollbem.game([[1, -1], [-1, 1]], all=True)
    assert len(coins) == 1 and np.allclose(coins[0], 0.5)
    assert len(rollbem.game(np.eye(3), np.eye(3), all=True)) == 7  # three pure ones, three of pairs, one of all
    assert rollbem.game(np.eye(3), np.eye(3), label=2).x.tolist() == [0, 1, 0]


NFG = {"payoffs": 'NFG 1 R "Prisoner\\"s" { "P1" "P2" } { 2 3 } "a comment"\n1 -1 4 1/2\n2, 0 5 0.25\n3 7 6 1e1\n',
       "names": 'NFG 1 D "" { "P1" "P2" } { { "a" "b" } { "c" "d" "e" } }\n1 -1 4 1/2 2 0 5 0.25 3 7 6 10',
       "outcomes": 'NFG 1 R "x" { "P1" "P2" } { 2 3 }\n{ { "" 1, -1 } { "" 4, 1/2 } { "" 2, 0 } { "" 5, .25 } { "" 3 7 } '
                   '{ "" 6, 10 } }\n1 2 3 4 5 6\n'}


@pytest.mark.parametrize("kind", NFG)
def test_games_of_gambit(kind, tmp_path):
    from rollbem._files import gambit

    path = tmp_path / "game.nfg"
    path.write_text(NFG[kind])
    A, B = gambit(str(path))
    assert A.tolist() == [[1, 2, 3], [4, 5, 6]] and B.tolist() == [[-1, 0, 7], [0.5, 0.25, 10]]
    assert rollbem.game(path).payoff == (6, 10)
    assert run("lcp", "--game", path).returncode == 65


@pytest.mark.parametrize("text, words", [
    ('NFG 1 R "x" { "P1" "P2" "P3" } { 2 2 2 }\n1', "3 players, expected 2"), ('EFG 2 R "x" { "P1" }', "extensive form"),
    ('NFG 1 R "x" { "P1" "P2" } { 2 2 }\n1 2 3', "expected 4 profiles"), ("2 2\n1 2", "expected NFG 1 R"),
    ('NFG 1 R "x" { "P1" "P2" } { 2 2 }\n1 2 3 4 5 6 7 x', "got 'x'"), ('NFG 1 R "x" { "P1"', "not closed"),
    ('NFG 1 R "x" { "P1" "P2" } { 1 1 } { { "" 1 } }\n1', "expected 2 payoffs"), ("", "expected NFG 1 R")])
def test_what_is_no_game_of_two(text, words, tmp_path):
    path = tmp_path / "game.nfg"
    path.write_text(text)
    with pytest.raises(rollbem.InvalidInput, match=words):
        rollbem.game(path)


def test_archives(tmp_path):
    io = pytest.importorskip("scipy.io")
    M, q, want = sparse.csr_matrix([[2.0, 1.0], [1.0, 2.0]]), [-5.0, -6.0], [4 / 3, 7 / 3]
    sparse.save_npz(tmp_path / "sparse.npz", M)
    sparse.save_npz(tmp_path / "triplets.npz", M.tocoo())
    np.savez(tmp_path / "arrays.npz", M=M.toarray(), q=q, upper=[1.0, 9.0])
    np.save(tmp_path / "array.npy", M.toarray())
    io.savemat(tmp_path / "matlab.mat", dict(A=M, b=q, name="x"))
    io.savemat(tmp_path / "two.mat", dict(C=M, D=M))
    io.mmwrite(str(tmp_path / "market.mtx"), M)
    for name in ("sparse.npz", "triplets.npz", "array.npy", "market.mtx"):
        assert np.allclose(rollbem.lcp(tmp_path / name, q).z, want)
    assert np.allclose(rollbem.lcp(tmp_path / "matlab.mat").z, want)
    assert np.allclose(rollbem.lcp(tmp_path / "arrays.npz").z, [1.0, 2.5])
    with pytest.raises(rollbem.InvalidInput, match="got C, D"):
        rollbem.lcp(tmp_path / "two.mat")
    with pytest.raises(rollbem.MissingFile):
        rollbem.lcp(tmp_path / "none.npz")
    for name, words in (("sparse.npz", ".npz"), ("array.npy", ".npy"), ("matlab.mat", "MATLAB")):
        said = run("lcp", tmp_path / name)
        assert said.returncode == 65 and words in said.stderr and "Python" in said.stderr


@pytest.mark.parametrize("call, words", [
    (lambda: rollbem.lcp(np.eye(2), [1.0], lower=[1, 2]), "2 x 2|lower="),
    (lambda: rollbem.lcp(np.eye(2), [1.0, 2.0], lower=[1, 2, 3]), "lower=: expected a number or one per row"),
    (lambda: rollbem.lcp(np.eye(2), [1.0, 2.0], lower=2, upper=1), "bound"),
    (lambda: rollbem.lcp(sparse.eye(3), [1.0, 2.0]), "M=: expected a matrix of 2 x 2, got 3 x 3"),
    (lambda: rollbem.lcp(sparse.eye(2) * 1j, [1.0, 2.0]), "M=: expected numbers"),
    (lambda: rollbem.lcp(np.eye(2), [1.0, 2.0], tol=1e-12), "tol="),
    (lambda: rollbem.lcp(np.eye(2), [1.0, 2.0], seconds=0), "seconds="),
    (lambda: rollbem.lcp(np.eye(2)), "q="),
    (lambda: rollbem.game([[1, 2]], [[1], [2]]), "B=: expected 1 x 2 payoffs, got 2 x 1"),
    (lambda: rollbem.game([[1, 2]], label=9), "label=: expected a whole number from 1 to 3"),
    (lambda: rollbem.game([1, 2]), "A=: expected a matrix")])
def test_what_is_no_problem(call, words):
    with pytest.raises(rollbem.InvalidInput, match=words):
        call()


def test_a_list_of_equilibria_ends_in_time():
    A, B = np.random.default_rng(3).standard_normal((2, 11, 11))
    with pytest.raises(rollbem.Unsolved, match="bases of the two polytopes in") as ended:
        rollbem.game(A, B, all=True, seconds=1e-4)
    assert ended.value.solution.bases < 1e5  # of 1.4 million


def test_problems_without_unknowns_are_solved():
    """A contact search that finds nothing, and LCPs of no rows."""
    none = np.zeros((0, 0))
    for M in (none, sparse.csc_matrix((0, 0))):
        found = rollbem.lcp(M, [])
        assert found.status == "solved" and found.z.shape == found.w.shape == (0,)
        assert len(rollbem.lcp(M, [], all=True)) == 1
        found = rollbem.friction(M, [], [], dimension=2)
        assert found.r.shape == found.u.shape == (0, 2) and found.residual == 0.0


def test_answers_are_proved():
    M, q = np.array([[2.0, 1.0], [1.0, 2.0]]), [-5.0, -6.0]
    proof = rollbem.lcp(M, q, prove=True).proof
    assert proof["proved"] and proof["isolated"] and proof["undecided"] == 0 and proof["bound"] < 1e-14
    assert rollbem.lcp(M, q).proof is None
    assert rollbem.lcp(M, q, all=True, prove=True).number == (1, 1)
    assert rollbem.lcp(M, q, all=True).number is None
    A = np.array([[2.0, 0.0], [0.0, 1.0]])
    assert rollbem.game(A, A, prove=True).proof["proved"]
    assert rollbem.game(A, A, all=True, prove=True).number == (3, 3)
    W = np.array([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    proof = rollbem.friction(W, [-4.0, 3.0, 4.0], 0.5, prove=True).proof
    assert proof["proved"] and proof["slip"] == 1 and proof["bound"] < 1e-12
    proof = rollbem.friction(W, [-4.0, 0.3, 0.4], 0.5, prove=True).proof
    assert proof["stick"] == 1 and proof["nearby"] < 1e-12


def test_absence_is_proved():
    with pytest.raises(rollbem.Unsolved) as none:
        rollbem.lcp(np.array([[0.0, 1.0], [-1.0, 0.0]]), [-1.0, -1.0], prove=True)
    assert none.value.solution.proof["least_sum"] == np.inf


def test_status_and_proof_agree():
    found = rollbem.lcp(np.array([[-1.0, 1.0], [2.0, 0.0]]), [-1.0, -2.0], "lemke", prove=True)
    assert found.status == "solved" and found.proof["proved"]  # Lemke's method ends on a ray
    np.testing.assert_array_equal(found.z, [1.0, 2.0])
    np.testing.assert_array_equal(found.w, [0.0, 0.0])
    assert found.residual == found.scaled_residual == 0.0
    M, q = np.array([[1.0, -1.0], [-1.0, 1.0]]), [-1.0, -1.0]
    for solver in "lemke", "newton":
        with pytest.raises(rollbem.Unsolved) as none:
            rollbem.lcp(M, q, solver, prove=True)
        assert none.value.solution.status == "no solution", solver


def only_solution(A, b):
    """Of A x = b in fractions; None: there is none, or more than one."""
    rows, n = [[*row, x] for row, x in zip(A, b)], len(A[0]) if A else 0
    for c in range(n):
        k = next((i for i in range(c, len(rows)) if rows[i][c]), None)
        if k is None:
            return None
        rows[c], rows[k] = rows[k], rows[c]
        rows[c] = [x / rows[c][c] for x in rows[c]]
        for i in range(len(rows)):
            if i != c and rows[i][c]:
                rows[i] = [x - rows[i][c] * y for x, y in zip(rows[i], rows[c])]
    return None if any(row[n] for row in rows[n:]) else [row[n] for row in rows[:n]]


def exact_solutions(M, q):
    """Those of regular bases, and those of independent columns of any basis, in fractions."""
    n = len(q)
    regular, vertices = set(), set()
    for S in itertools.product((False, True), repeat=n):
        columns = [j for j in range(n) if S[j]]
        others = [i for i in range(n) if not S[i]]
        for left_out in itertools.chain.from_iterable(itertools.combinations(others, k) for k in range(len(others) + 1)):
            rows = [i for i in range(n) if i not in left_out]
            x = only_solution([[M[i][j] for j in columns] for i in rows], [-q[i] for i in rows])
            if x is None:
                continue
            z = [x[columns.index(j)] if S[j] else Fraction(0) for j in range(n)]
            w = [q[i] + sum(M[i][j] * z[j] for j in range(n)) for i in range(n)]
            if min(*z, *w) >= 0:
                vertices.add(tuple(z))
                if len(left_out) == len(others):
                    regular.add(tuple(z))
    return regular, vertices


def nearly_singular(k):
    """Small integers with a singular block, of which a few are changed by 1e-15 to 1e-12."""
    r, n = random.Random(k), 2 + k % 3
    M = [[Fraction(r.randint(-3, 3)) for _ in range(n)] for _ in range(n)]
    q = [Fraction(r.randint(-3, 3)) for _ in range(n)]
    S = r.sample(range(n), r.randint(2, n))
    c = [r.randint(-1, 1) for _ in S[:-1]]
    for j in S:
        M[S[-1]][j] = sum(a * M[i][j] for a, i in zip(c, S[:-1]))
    if r.random() < 0.5:
        q[S[-1]] = sum(a * q[i] for a, i in zip(c, S[:-1]))
    for _ in range(r.randint(1, 2)):
        row = r.choice([M[r.choice(S)], q])
        i = r.choice(S)
        row[i] = Fraction(float(row[i] + Fraction(r.choice([-1, 1]) * r.randint(1, 7), 2 ** r.randint(40, 51))))
    return M, q


def test_lists_next_to_singular_bases():
    """Of 600 problems, a third in every run: proved solutions are solutions, and none is missing where no basis is undecided."""
    undecided, nearby, several, checked = 0, 0, 0, 0
    for k in range(600):
        if not is_in_turn(k // 3, 3):
            continue
        checked += 1
        M, q = nearly_singular(k)
        regular, vertices = exact_solutions(M, q)
        A, b = (np.array(x, dtype=float) for x in (M, q))
        try:
            found = rollbem.lcp(A, b, all=True)
        except rollbem.Unsolved as error:
            assert "undecided" in str(error) or not vertices, k
            undecided += "undecided" in str(error)
            continue
        proved = [z for z, near in zip(found, found.nearby) if not near]
        for z in proved:
            apart = [max(abs(float(x) - y) / max(abs(y), 1e-9 * max(z)) if y else float(x) for x, y in zip(v, z))
                     for v in vertices]
            assert apart and min(apart) < 1e-9, (k, z)
        assert found.undecided or len(proved) >= len(regular), k
        assert len(proved) <= len(vertices), k
        for z, near in zip(found, found.nearby):
            assert np.abs(np.minimum(z, A @ z + b)).max() < 1e-10 * max(1.0, z.max()), k
        undecided += found.undecided > 0
        nearby += sum(found.nearby) > 0
        several += len(regular) > 1
    assert undecided < 0.1 * checked and nearby > 10 and several > 20
