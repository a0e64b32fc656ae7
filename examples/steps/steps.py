"""Rolling contact from first principles in one file, as steps.c beside it does it, with NumPy.

    python3 steps.py MU CREEP [static|steady [wheel|halfplane [LOAD [ZONE]]]]

Tags (B1), (K5) are those of docs/theory.md.  Units mm, N, MPa.  Signs: x to the right, y up, the
wheel A rolls towards +x; pressure p >= 0; q: friction on A, positive towards +x; creepage > 0 brakes.
"""
import sys

import numpy as np

R, E, NU, ARC, N = 50.0, 94500.0, 0.1, np.radians(30.0), 60  # N elements may touch
SHEAR, M = E / (2 * (1 + NU)), N + 1                          # and one more, upstream of them


def circle(x):
    """Height of the circle over the plane before it is loaded (B9)."""
    return x**2 / (R + np.sqrt(R**2 - x**2))


def mesh(zone, growth=0.15, largest=np.radians(5.0)):
    """Ends of the elements (x + iy, counter-clockwise), which of them are clamped (B4, B7)."""
    half = np.arcsin(zone / R)
    h = 2 * half / N
    bend = (largest - h) / growth  # up to here they grow with the distance, then no more

    def count(s):
        return np.log1p(growth * min(s, bend) / h) / growth + max(s - bend, 0) / largest

    def reach(c):
        graded = count(bend)
        return h * np.expm1(growth * np.minimum(c, graded)) / growth + np.maximum(c - graded, 0) * largest

    side = np.pi - half - h
    free, top = count(side - ARC), count(side) - count(side - ARC)
    free_n, top_n = int(free + 0.5), int(top + 0.5)
    counts = np.r_[free * np.arange(free_n + 1) / free_n, free + top * np.arange(1, top_n + 1) / top_n]
    at = half + h + reach(counts)
    angle = np.r_[-half + h * np.arange(M), at, -at[-2::-1], -half]
    ends = R * np.sin(angle) + 2j * R * np.sin(angle / 2) ** 2
    clamped = np.zeros(len(angle) - 1, bool)
    clamped[M + free_n : M + free_n + 2 * top_n] = True
    return ends, clamped


def influence(ends):
    """H and G of H u = G t (B1): Kelvin's solution over elements in closed form (B2, B3)."""
    ex = np.diff(ends)
    a, t, mid = abs(ex) / 2, ex / abs(ex), (ends[1:] + ends[:-1]) / 2
    n, unit = len(a), np.sqrt(2) / np.pi * abs(ex).sum()
    D = mid - mid[:, None]  # row: where the load is, column: element
    Z = D * t.conj()
    X, d, self_ = Z.real, -Z.imag, np.eye(n, dtype=bool)
    dot, cross = X**2 + d**2 - a**2, 2 * a * d
    W = dot**2 + cross**2
    lam = np.where(self_, 0, np.log(((X + a) ** 2 + d**2) / ((X - a) ** 2 + d**2)) / 2)
    th = np.where(self_, 0, np.arctan2(cross, dot))
    L = X * lam + a / 2 * np.log(W) - 2 * a + d * th - 2 * a * np.log(unit)
    near = (a - d * th) * t**2 - 1j * d * lam * t**2  # (cos2 + i sin2)(s11 - i s12)
    C, kappa = 1 / (8 * np.pi * SHEAR * (1 - NU)), 3 - 4 * NU
    square = np.where(self_, 0, cross / W) * (D**2 - (a * t) ** 2)
    c, s = -1 / (4 * np.pi * (1 - NU)), 1 - 2 * NU
    H, G = np.empty((n, 2, n, 2)), np.empty((n, 2, n, 2))
    G[:, 0, :, 0], G[:, 1, :, 1] = C * (a - kappa * L + near.real), C * (a - kappa * L - near.real)
    G[:, 0, :, 1] = G[:, 1, :, 0] = C * near.imag
    H[:, 0, :, 0] = c * (2 * (1 - NU) * th + square.real) + self_ / 2
    H[:, 1, :, 1] = c * (2 * (1 - NU) * th - square.real) + self_ / 2
    H[:, 0, :, 1], H[:, 1, :, 0] = c * (square.imag + s * lam), c * (square.imag - s * lam)
    return H.reshape(2 * n, 2 * n), G.reshape(2 * n, 2 * n)


def flexibility_wheel(ends, clamped):
    """F_NN, F_NT, F_TN, F_TT (M x N): condensed onto the contact (B5)."""
    H, G = influence(ends)
    A = np.where(np.repeat(clamped, 2), -E * G, H)
    U = np.linalg.solve(A, G[:, : 2 * N]).reshape(-1, 2, N, 2)[:M]
    return U[:, 1, :, 1], U[:, 1, :, 0], U[:, 0, :, 1], U[:, 0, :, 0]


def flexibility_halfplane(h):
    """The same of a half-plane: Flamant's solution over elements, datum 2R/e (B6)."""
    r = (np.arange(M)[:, None] - np.arange(N) + 0.5) * h
    l, datum = r - h, 2 * R / np.e
    w = -2 * (1 - NU**2) / (np.pi * E) * (r * np.log(abs(r) / datum) - l * np.log(abs(l) / datum) - h)
    b = (1 - 2 * NU) * (1 + NU) / (2 * E) * (abs(r) - abs(l))
    return w, b, -b, w


def contact_lcp(F, x, mu, approach, slide, sense, steady):
    """M and b of Kwak's problem in the unknowns pressure, friction beyond sliding, back slip (K5)."""
    NN, NT, TN, TT = F
    upstream = (lambda B: B[:N] - B[1:]) if steady else (lambda B: B[:N])  # A = I - S, or I
    NN, NT, TN, TT, one = NN[:N], NT[:N], upstream(TN), upstream(TT), np.eye(N)
    Mat = np.block([[E / R * (NN - sense * mu * NT), E / R * sense * NT, 0 * one],
                    [E / R * (sense * TN - mu * TT), E / R * TT, one],
                    [2 * mu * one, -one, 0 * one]])
    return Mat, np.r_[(circle(x[:N]) - approach) / R, sense * slide / R, np.zeros(N)]


def lemke(Mat, b):
    """z >= 0 with w = M z + b >= 0 and z'w = 0; the number of pivots (< 0: a ray)."""
    n = len(b)
    T = np.c_[Mat, np.ones(n), b]  # basic = T nonbasic + last column; w_i is i, z_i n + i, z0 2n
    basic, column = np.arange(n), n + np.arange(n + 1)
    enters, row, pivots, solved = 2 * n, int(b.argmin()), 0, b.min() >= 0
    while not solved and pivots < 50 * n:
        c = int(np.flatnonzero(column == enters)[0])
        if pivots:  # ratio test; where z0 is among those that fall to zero first, z0 leaves
            falls = T[:, c] < -1e-11
            ratio = np.where(falls, -T[:, -1] / np.where(falls, T[:, c], 1), np.inf)
            tied = np.flatnonzero(ratio <= ratio.min() + 1e-13)
            row = next((i for i in tied if basic[i] == 2 * n), int(ratio.argmin()))
            if not falls.any():
                break
        exchange = -T[row] / T[row, c]
        exchange[c] = 1 / T[row, c]
        entering = T[:, c].copy()
        T[:, c] = 0
        T += np.outer(entering, exchange)
        T[row] = exchange
        leaves, basic[row], column[c] = basic[row], enters, basic[row]
        enters = leaves + n if leaves < n else leaves - n
        solved, pivots = leaves == 2 * n, pivots + 1
    z = np.zeros(2 * n + 1)
    z[basic] = T[:, -1]
    return z[n : 2 * n], pivots if solved else -pivots


def main(mu=0.3, creep=0.1, formulation="static", body="wheel", load=0.0, zone=35.0):
    mu, creep, load, zone, steady = float(mu), float(creep), float(load), float(zone), formulation == "steady"
    ends, clamped = mesh(zone)
    x, h = ((ends[1:] + ends[:-1]) / 2).real[:M], abs(np.diff(ends))[:M]
    if body == "halfplane":
        h = np.full(M, 2 * zone / N)
        x = -zone + (np.arange(M) + 0.5) * h
    F = flexibility_halfplane(h[0]) if body == "halfplane" else flexibility_wheel(ends, clamped)
    approach, before, P_before = (1e-3 * R if load else R / 2), 0.0, 0.0
    slide = creep * np.diff(x) if steady else np.full(N, 0.0 if load else 0.05 * R)
    sense = -1.0 if slide[0] < 0 else 1.0
    for _ in range(50):  # under a given load: secants over the approach
        z, pivots = lemke(*contact_lcp(F, x, mu, approach, slide, sense, steady))
        p, g, back = E * z[:N], E * z[N : 2 * N], z[2 * N :]
        P = p @ h[:N]
        if not load or abs(P - load) < 1e-14 * load:
            break
        before, P_before, approach = approach, P, approach + (load - P) * (approach - before) / (P - P_before)
    q = sense * (g - mu * p)
    wN, wT = F[0] @ p + F[1] @ q, F[2] @ p + F[3] @ q
    stick = (p > 0) & (g > 0) & (back == 0)
    stretch, dx = np.diff(wT), np.diff(x)
    shift = np.where(stick, 0, slide - stretch if steady else slide + wT[:N])
    slip = shift / dx if steady else creep - stretch / dx  # (12)
    zones = np.where(p == 0, 0, np.where(stick, 1, np.where((back > 0) != (sense < 0), 3, 2)))
    print("x_mm\tgap_mm\tp_MPa\tq_MPa\tshift_mm\tslip\tzone")
    for row in zip(x, circle(x[:N]) + wN[:N] - approach, p, q, shift, slip, zones):
        print("\t".join(f"{v:.13g}" for v in row))
    print(f"{'solved' if pivots >= 0 else 'not solved'}, {abs(pivots)} pivots: P = {P:.12g}, "
          f"Q = {q @ h[:N]:.12g} N/mm, approach {approach:.12g} mm", file=sys.stderr)
    return int(pivots < 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
