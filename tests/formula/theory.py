"""docs/theory.md: kernels, half-plane, slip and the two forms of the complementarity problem."""
import numpy as np
import rollbem
from printed import close, printed, run, value

PAGE = "theory.md"
wheel = rollbem.solve("examples/by-hand/case.ini")
G_, nu = 94500/2.2, 0.1
mesh = np.array(wheel.mesh)[:, :4]
nodes, weights = np.polynomial.legendre.leggauss(60)


def element(k):
    """Axes and points of element k, seen from the midpoint of element 0."""
    begin, end = mesh[k, 0:2], mesh[k, 2:4]
    m, e, p = (begin + end)/2, (end - begin)/2, (mesh[0, 0:2] + mesh[0, 2:4])/2
    a = np.linalg.norm(e)
    return m - p, e/a, np.array([e[1], -e[0]])/a, a


def tag_B2():
    U = printed(PAGE, r"\frac{1}{8\pi G(1-\nu)}\left[-(3-4\nu)\,\ln r\;\delta_{ij} + r_{,i}\,r_{,j}\right]")
    T = printed(PAGE, r"\frac{-1}{4\pi(1-\nu)\,r}\left[\frac{dr}{dn}\left((1-2\nu)\,\delta_{ij} + 2\,r_{,i}\,r_{,j}\right) - "
                r"(1-2\nu)\left(r_{,i}\,n_j - r_{,j}\,n_i\right)\right]")
    U, T = (t.replace(r"\frac{dr}{dn}", "drdn").replace(r"\ln r", "ln(r)").replace("r_{,i}", "e_i").replace("r_{,j}", "e_j").replace(r"\delta_{ij}", "d_ij")
            for t in (U, T))
    unit = printed(PAGE, "sqrt(2)/pi times its longest contour").split(" times")[0]
    r0 = value(unit)*np.linalg.norm(mesh[:, 2:] - mesh[:, :2], axis=1).sum()
    for k in [1, 3, 6]:
        m, t, n, a = element(k)
        blocks = np.zeros((2, 2, 2))
        for x, w in zip(nodes, weights):
            d = m + a*x*t
            r = np.hypot(*d)
            e = d/r
            for i in range(2):
                for j in range(2):
                    names = dict(nu=nu, G=G_, e_i=e[i], e_j=e[j], d_ij=float(i == j), n_i=n[i], n_j=n[j], drdn=e @ n)
                    blocks[:, i, j] += a*w*np.array([value(T, r=r, **names), value(U, r=r/r0, **names)])
        close(blocks[0], np.array(wheel.H)[0:2, 2*k:2*k + 2], 1e-6)
        close(blocks[1], np.array(wheel.G)[0:2, 2*k:2*k + 2], 1e-6)


def tag_B3():
    m, t, n, a = element(1)
    names = dict(X=m @ t, d=m @ n, a=a)
    names["S"] = value(printed(PAGE, "S &= X^2 + d^2 + a^2").split("=")[1], **names)
    names["W"] = value(printed(PAGE, "W = (X^2 + d^2 - a^2)^2 + (2ad)^2").split("=")[1], **names)
    names["Lam"] = value(printed(PAGE, r"\operatorname{atanh}\frac{2aX}{S}"), **names)
    names["Th"] = value(printed(PAGE, r"\operatorname{atan2}(2ad,\; X^2 + d^2 - a^2)"), **names)
    L = value(printed(PAGE, r"L &= X\,\mathrm{Lam} + \tfrac{a}{2}\ln W - 2a + d\,\mathrm{Th} && \textstyle(= \int \ln r\,ds)").split("=")[1].split("&&")[0], **names)
    ends = [np.hypot(*(m + s*a*t)) for s in (-1, 1)]
    close(names["Lam"], np.log(ends[1]/ends[0]))
    close(L, sum(a*w*np.log(np.hypot(*(m + a*x*t))) for x, w in zip(nodes, weights)))


def tag_B6():
    s = rollbem.solve(support="halfplane", young=210000, poisson=0.3, radius=100, gap="parabola", approach=0.03, zone=2,
                      mesh="uniform", contact_elements=4, mu=0.3)
    c = value(printed(PAGE, r"\frac{(1-2\nu)(1+\nu)}{2E}"), nu=0.3, E=210000)
    of = value(printed(PAGE, r"w_N(x) &= -\frac{2(1-\nu^2)}{\pi E}\int p(s)\,\ln\frac{|x-s|}{d}\,ds + c\int q(s)\,\operatorname{sgn}(x-s)\,ds")
               .split("&= ")[1].split(r"\int")[0], nu=0.3, E=210000)
    printed(PAGE, r"w_T(x) &= -\frac{2(1-\nu^2)}{\pi E}\int q(s)\,\ln\frac{|x-s|}{d}\,ds - c\int p(s)\,\operatorname{sgn}(x-s)\,ds")
    d, n = value(printed(PAGE, "d = 2R/e, the default").split("=")[1].split(",")[0], R=100, e=np.e), 4
    x = np.array(s.x)
    log = lambda y: y*np.log(abs(y)/d) - y
    for j in range(n):
        lo, hi = x[j] - 0.5, x[j] + 0.5
        direct = of*(log(x - lo) - log(x - hi))
        coupled = c*(abs(x - lo) - abs(x - hi))
        F = np.array(s.F)
        close(F[:n, j], direct, 1e-9), close(F[n + 1:2*n + 1, n + j], direct, 1e-9)
        close(F[:n, n + j], coupled, 1e-9), close(F[n + 1:2*n + 1, j], -coupled, 1e-9)


def problem():
    """The example by hand in steady rolling: all letters of (K1) to (K5), and its solution."""
    s = rollbem.solve("examples/by-hand/case.ini", formulation="steady", creep=0.01)
    n, F = 4, np.matrix(s.F)
    A = np.matrix(np.eye(n, n + 1) - np.eye(n, n + 1, 1))
    mu, p, q, step = 0.2, np.matrix(s.p).T, np.matrix(s.q).T, np.matrix(s.shift).T
    names = dict(F_NN=F[:n, :n], F_NT=F[:n, n:], A=A, F_TN=F[n + 1:, :n], F_TT=F[n + 1:, n:], mu=mu, I=np.matrix(np.eye(n)))
    names["d_N"] = np.matrix(s.gap).T - names["F_NN"]*p - names["F_NT"]*q
    names["d_T"] = 0.01*np.matrix(np.diff(np.append(s.x, 24.4704))).T
    plus, minus = np.maximum(step, 0), np.maximum(-step, 0)
    return s, names, p, q, plus, minus


def blocks(text, names, zero):
    rows = [[value(entry, **names) if entry.strip() != "0" else zero for entry in row.split("&")] for row in text.split(r"\\")]
    return np.block([[np.asarray(e) for e in row] for row in rows])


def tag_K5():
    M = printed(PAGE, r"F_{NN} - \mu F_{NT} & F_{NT} & 0 \\ A(F_{TN} - \mu F_{TT}) & A F_{TT} & I \\ 2\mu I & -I & 0")
    b = printed(PAGE, r"d_N \\ d_T \\ 0 \end{bmatrix}").split(r" \end")[0]
    printed(PAGE, r"z = (r_N, \gamma_+, \lambda_-), \qquad w = (y_N, \lambda_+, \gamma_-)")
    s, names, p, q, plus, minus = problem()
    M = blocks(M, names, np.zeros((4, 4)))
    w = M @ np.vstack([p, q + 0.2*p, minus]) + blocks(b, names, np.zeros((4, 1)))
    close(w[:4], np.matrix(s.gap).T, 1e-8), close(w[4:8], plus, 1e-4), close(w[8:], 0.2*p - q, 1e-8)


def tag_K4():
    M = printed(PAGE, r"F_{NN} - F_{NT}B^{-1}A F_{TN} & F_{NT}B^{-1}T_T \\ T_N^T - T_T^T B^{-1} A F_{TN} & T_T^T B^{-1} T_T")
    b = printed(PAGE, r"d_N - F_{NT}B^{-1}d_T \\ -T_T^T B^{-1} d_T")
    s, names, p, q, plus, minus = problem()
    assert "T_T = [1 -1]" in printed(PAGE, "T_T = [1 -1] per element") and printed(PAGE, "T_N = [mu mu]")
    pair = np.kron(np.eye(4), [[1, -1]])
    names.update(B=names["A"]*names["F_TT"], T_T=np.matrix(pair), T_Nt=np.matrix(0.2*abs(pair)).T, T_Tt=np.matrix(pair).T)
    M, b = (blocks(t.replace("T_T^T", "T_Tt").replace("T_N^T", "T_Nt"), names, None) for t in (M, b))
    w = M @ np.vstack([p, np.hstack([plus, minus]).reshape(-1, 1)]) + b
    gamma = np.asarray(w[4:]).reshape(4, 2)
    close(w[:4], np.matrix(s.gap).T, 1e-4), close(gamma, np.hstack([0.2*p + q, 0.2*p - q]), 1e-4)


def tag_slip():
    text = printed(PAGE, r"\xi\,(x_{i+1} - x_i) + w_T(i) - w_T(i+1)")
    for old, new in [("x_{i+1}", "x_1"), ("x_i", "x_0"), ("w_T(i+1)", "w_1"), ("w_T(i)", "w_0")]:
        text = text.replace(old, new)
    s = rollbem.solve("examples/carter/case.ini")
    close(value(text, xi=s.creepage, x_0=s.x[:-1], x_1=s.x[1:], w_0=s.ut[:-1], w_1=s.ut[1:])/1e-5, s.shift[:-1]/1e-5, 1e-6)
    braked = rollbem.solve("examples/rail/case.ini", creep_ratio=0.4)
    printed(PAGE, "friction on A points to -x, Q < 0")
    assert braked.creepage > 0 > braked.tangential_load


def tag_K1_K2_K3_D1_B5():
    s, names, p, q, plus, minus = problem()
    R = 50.0
    g_0 = np.matrix(value(printed(PAGE, "y = x^2/(R + sqrt(R^2 - x^2))").split("=")[1], x=np.array(s.x), R=R)).T
    printed(PAGE, "which avoids cancellation down to a/R = 1e-8"), printed(PAGE, "instead of R - R cos")
    names.update(g_0=g_0, delta=s.approach, w_0N=0.0, r_N=p, r_T=q)
    names["d_N"] = value(printed(PAGE, "d_N = g_0 - delta + w_0N").split("=")[1], **names)
    y_N = value(printed(PAGE, "y_N = d_N + F_NN r_N + F_NT r_T >= 0").split("=")[1].rstrip(" >"), **names)
    close(y_N, np.matrix(s.gap).T, 1e-8)
    pressed, sticks, slides = np.array(s.zone) > 0, np.array(s.zone) == 1, np.array(s.zone) > 1
    on_C = value(printed("theory-solvers.md", "g_0 - delta + w_0N + F_NN r_N + F_NT r_T = 0").split("=")[0], **names)
    slip = value(printed(PAGE, "d_T + A (F_TN r_N + F_TT r_T), T_T = [1 -1]").split(", T_T")[0], **names)
    on_S = value(printed("theory-solvers.md", "d_T + A (F_TN r_N + F_TT r_T) = 0").split("=")[0], **names)
    close(slip, np.matrix(s.shift).T, 1e-6), close(on_S, slip)
    assert abs(on_C[pressed]).max() < 1e-9*s.approach and (abs(slip[sticks]) < 1e-9*abs(slip).max()).all()
    gamma = {sign: value(printed(PAGE, f"gamma{sign} = mu r_N {sign} r_T").split("=")[1], **names) for sign in "+-"}
    printed(PAGE, "sliding of A towards +x (lambda+ > 0) requires gamma+ = 0, r_T = -mu r_N")
    assert min(gamma["+"].min(), gamma["-"].min()) > -1e-9 and slides.any() and (slip[slides] > 0).all() and abs(gamma["+"][slides]).max() < 1e-9
    close(value("-mu r_N", **names)[slides], q[slides])
    printed("theory-solvers.md", "in slip: r_T - sg mu_i r_N = 0")
    both = printed(PAGE, "gamma = T_N^T r_N + T_T^T r_T").split("=")[1].replace("T_N^T", "T_Nt").replace("T_T^T", "T_Tt")
    pair = value(both, T_Nt=np.matrix([[0.2], [0.2]]), T_Tt=np.matrix([[1], [-1]]), r_N=p[1, 0], r_T=q[1, 0])
    close(pair.ravel(), [[gamma["+"][1, 0], gamma["-"][1, 0]]])
    names.update(B=names["A"]*names["F_TT"], lam=slip, gp=gamma["+"], gm=gamma["-"])
    text = printed(PAGE, "r_T = B^-1 (T_T lambda - A F_TN r_N - d_T)").split("=")[1].replace("T_T lambda", "lam")
    close(value(text, **names), q, 1e-8)
    close(value(printed(PAGE, "r_T = gamma+ - mu r_N").split("=")[1].replace("gamma+", "gp"), **names), q)
    close(value(printed(PAGE, "r_T = mu r_N - gamma-").split("=")[1].replace("gamma-", "gm"), **names), q)
    printed(PAGE, "the tractions on A are r = +C t_c and w = w_0 + F r with F positive definite"), printed(PAGE, "gives u_c = w_0 + F t_c")
    close(np.array(s.un), np.array(names["F_NN"]*p + names["F_NT"]*q).ravel(), 1e-8)


def tag_K6():
    printed(PAGE, r"\text{column of } \xi' &: \quad s\,e_T \text{ in every slip row} \quad (e_T\text{: slip per unit of } \xi, \text{ 4.2})")
    load = printed(PAGE, r"w_\delta = \sum p\,h - P \ge 0").split("=")[1].split(r"\ge")[0].replace(r"\sum", "")
    force = printed(PAGE, r"w_\xi = -s\left(\sum q\,h - Q\right) \ge 0").split("=")[1].split(r"\ge")[0].replace(r"\sum", "")
    slides = printed(PAGE, "sum q h = s mu P and w_xi = -(mu P - s Q) <= 0").split(" and w_xi =")
    s = rollbem.solve("examples/by-hand/case.ini", formulation="steady", load=300, force=30)
    p, q, h = (np.matrix(x) for x in (s.p, s.q, s.h))
    assert abs(value(load, p=p, h=h.T, P=300.0)[0, 0]) < 1e-8 and abs(value(force, q=q, h=h.T, Q=30.0, s=1.0)[0, 0]) < 1e-8
    for sg in (-1.0, 1.0):
        names = dict(mu=0.2, P=300.0, Q=30.0, s=sg)
        names["q"] = value(slides[0].split("=")[1], **names)
        close(value(force, h=1.0, **names), value(slides[1].split(" <=")[0], **names))


def tag_B6_datum():
    text = printed(PAGE, "P(1-nu^2)/(pi E) (2 ln(2d/a) + 1)")
    s = rollbem.solve(support="halfplane", gap="parabola", young=210000, poisson=0.3, radius=100, load=500, mu=0, datum=70, contact_elements=160)
    close(s.approach, value(text, P=500.0, nu=0.3, E=210000.0, d=70.0, a=s.half_width), 1e-3)


if __name__ == "__main__":
    raise SystemExit(run(globals()))
