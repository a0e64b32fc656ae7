"""docs/theory-bodies.md: relaxing bodies, wheels, layers, stress."""
import re

import numpy as np
import rollbem
from scipy import integrate, optimize, special
from scipy.linalg import expm
from printed import close, printed, run, value

PAGE = "theory-bodies.md"


def tag_B8():
    formula = printed(PAGE, r"\Phi(z) &= \frac{1}{2\pi i}\int\frac{f(s)}{s-z}\,ds, \qquad s_{xx} + s_{yy} = 4\operatorname{Re}\Phi(z)")
    printed(PAGE, r"s_{yy} - i\,s_{xy} &= \Phi(z) - \Phi(\bar z) + (z-\bar z)\,\overline{\Phi'(z)}")
    assert printed(PAGE, "f = syy - i sxy = -p + i q on the surface") and formula
    t = np.pi*(np.arange(20000) + 0.5)/20000
    s, ds, p = -np.cos(t), np.sin(t)*np.pi/20000, np.sin(t)
    f = -p + 0.2j*p
    phi = lambda z: (f/(s - z)*ds).sum()/(2j*np.pi)
    slope = lambda z: (f/(s - z)**2*ds).sum()/(2j*np.pi)
    points = np.array([[0.3, 0.7], [-0.6, 0.5]])
    for x, y in points:
        z = x + 1j*y
        both, syy = 4*phi(z).real, phi(z) - phi(np.conj(z)) + (z - np.conj(z))*np.conj(slope(z))
        half = rollbem.stress(similar=True, support="halfplane", half_width=1, radius=100, mu=0.2, formulation="static",
                              force_ratio=1, gap="parabola", contact_elements=400, points=points)
        i = list(points[:, 0]).index(x)
        p0 = half.solution.max_pressure
        close([syy.real, -syy.imag, both - syy.real], np.array([half.syy[i], half.sxy[i], half.sxx[i]])/p0, 3e-3)


def tag_B10():
    text = printed(PAGE, r"\int\frac{F(s)}{z-s}\,ds = F(z)\,\Lambda - F'\,h, \qquad \Lambda = \ln\frac{a}{b}, \qquad F(s) = F_0 + F'\,s")
    text = text.split("= ")[1].split(r", \qquad")[0]
    z, lo, hi = 0.3 + 0.4j, -0.5, 1.2
    F = lambda s: 0.7 + 0.9*s
    x, w = np.polynomial.legendre.leggauss(80)
    s, w = (lo + hi)/2 + (hi - lo)/2*x, (hi - lo)/2*w
    names = {"F": F, "z": z, "Lambda": np.log((z - lo)/(z - hi)), "h": hi - lo, "slope": 0.9}
    close(value(text.replace("F'", "slope"), **names), (F(s)/(z - s)*w).sum())


def tag_B16():
    printed(PAGE, "with Carter's tractions, s = xi R/(mu a)")
    A, B = printed(PAGE, "2 mu p0 s in A"), printed(PAGE, "2 mu p0 (2 sqrt(s) - s)")
    for body, text in [("a", A.split(" in")[0]), ("b", B)]:
        below = rollbem.stress("examples/rail/case.ini", creep_ratio=0.4, contact_elements=100, body=body)
        close(below.maxima["tension"].value, value(text, mu=0.3, p0=below.solution.max_pressure, s=0.4), 1e-2)


def tag_V2():
    phi = printed(PAGE, r"L\left(\ln|y| + S(y/L)\right)")
    ahead, behind = printed(PAGE, r"e^z E_1(z)"), printed(PAGE, r"-e^z \operatorname{Ei}(-z)")
    L = 0.7
    S = lambda z: value(ahead if z > 0 else behind, z=z, e=np.e)
    Phi = lambda y: value(phi.replace(r"\ln|y|", "ln(abs(y))"), L=L, y=y, S=S)
    log = lambda x: (lambda g: g(x + 1) - g(x - 1))(lambda y: y*np.log(abs(y)) - y)  # int ln abs(x - s) ds over -1 ... 1
    for x in [-2.5, 1.7]:
        average = integrate.quad(lambda r: np.exp(-r/L)/L*log(x + r), 0, 60*L, points=[abs(x) - 1, abs(x) + 1], limit=400)[0]
        close(Phi(x + 1) - Phi(x - 1), average - log(x), 1e-6)


def tag_V4():
    balance = printed(PAGE, r"-\xi Q + \frac{M}{R} = D + H").split("=")
    s = rollbem.solve(support="halfplane", similar=True, radius=100, young=10, poisson=0.4, load=1, mu=0.3, creep_ratio=0.3,
                      formulation="steady", relaxation_time="0.01", relaxation_ratio="1", speed=200, gap="parabola")
    names = dict(xi=s.creepage, Q=s.tangential_load, M=s.resistance_moment, R=100, D=s.dissipation, H=s.hysteresis)
    close(value(balance[0], **names), value(balance[1], **names), 2e-3)


def tag_V6():
    c_0 = printed(PAGE, r"c_0 = \frac{1-e^{-r}}{r} - e^{-r}").split("=")[1]
    c_1 = printed(PAGE, r"c_1 = 1 - \frac{1-e^{-r}}{r}").split("=")[1]
    step = printed(PAGE, r"\pi_k^{\text{new}} = e^{-r}\pi_k + c_0\,t^{\text{before}} + c_1\,t^{\text{new}}").split("= ")[1]
    step = step.replace(r"\pi_k", "a").replace(r"t^{\text{before}}", "b").replace(r"t^{\text{new}}", "d").replace("e^{-r}", "E*")
    for r in [0.1, 1.3]:  # the traction runs from b to d and fades
        got = value(step, E=np.exp(-r), a=0.4, b=2.0, d=5.0, c_0=value(c_0, r=r, e=np.e), c_1=value(c_1, r=r, e=np.e))
        close(got, 0.4*np.exp(-r) + integrate.quad(lambda u: r*np.exp(-r*(1 - u))*(2.0 + 3.0*u), 0, 1)[0])


def tag_V8():
    printed(PAGE, r"N = \operatorname{Re}(\kappa A + B), \quad C = \operatorname{Im}(\kappa A - B)")
    A, B = printed(PAGE, r"e^{-ix}\ell - 1 - \tfrac12 e^{ix}"), printed(PAGE, r"B = e^{ix}\ell").split("=")[1]
    kappa = 1.8
    def disc(x):
        fix = lambda t: t.replace("e^{-ix}", "back").replace("e^{ix}", "forth").replace(r"\ell", "l").replace(r"\tfrac12", "0.5")
        names = dict(back=np.exp(-1j*x), forth=np.exp(1j*x), l=-np.log(1 - np.exp(1j*x)))
        a, b = value(fix(A), **names), value(fix(B), **names)
        N, C = (kappa*a + b).real, (kappa*a - b).imag
        more_N, more_C = printed(PAGE, "N + (kappa + 1) ln abs(x)"), printed(PAGE, "C - (pi/2)(kappa - 1) sgn x")
        return (value(more_N, N=N, kappa=kappa, x=x), value(more_C.replace("sgn x", "sgn(x)"), C=C, kappa=kappa, x=x)), (N, C)
    near, far = disc(1e-6)[0], disc(1e-3)[0]  # over the half-plane: smooth
    assert abs(near[0] - far[0]) < 2e-2 and abs(near[1]) < 1e-4 and abs(far[1]) < 5e-2, (near, far)
    waves = sum(kappa*np.cos(m*0.8)/(m + 1) + np.cos(m*0.8)/(m - 1) for m in range(2, 200001))
    close(disc(0.8)[1][0], waves, 1e-3)


def tag_L1():
    D = printed(PAGE, "D = 2 ka cosh 2al + 4 al^2 + 1 + ka^2").split("=")[1]
    forms = {"N": "(2 ka sinh 2al - 4 al)/D", "T": "(2 ka sinh 2al + 4 al)/D", "C": "[2 ka (ka - 1)(cosh 2al - 1) - 8 al^2]/((ka + 1) D)"}
    nu, E, d = 0.3, 1.0, 1.0
    ka, Es, c = 3 - 4*nu, E/(1 - nu**2), (1 - 2*nu)*(1 + nu)/(2*E)
    def L(name, al):
        fix = lambda t: t.replace("sinh 2al", "sinh(2 al)").replace("cosh 2al", "cosh(2 al)")
        return value(fix(printed(PAGE, forms[name])), ka=ka, al=al, D=value(fix(D), ka=ka, al=al))
    close([L("N", 40.0), L("T", 40.0), L("C", 40.0)], [1, 1, c*Es], 1e-9)  # the half-plane
    s = rollbem.solve(support="halfplane", layer_thickness=d, young=E, poisson=nu, radius=1000, gap="parabola", half_width=1,
                      mu=0.3, mesh="uniform", zone=2.5, contact_elements=24)
    h, x, F = s.h[0], np.array(s.x), np.array(s.F)
    al = np.arange(1, 400001)*1e-3*0.5
    for name, at in [("N", 0), ("T", 25)]:
        for j in [0, 7]:  # the inverse transform of 2 L/(E* k), over an element
            got = (2/(Es*al)*np.array(L(name, np.minimum(al, 200)))*np.cos(al*(x[j] - x[0]))*np.sinc(al*h/(2*np.pi))).sum()*0.5e-3*h/np.pi
            close(got, F[at + j, (0 if name == "N" else 24)], 2e-3)


def tag_L3():
    factor = printed(PAGE, r"\text{half-plane with datum } d + \frac{2h}{\pi E^*}\int_0^\infty\left[").split("d + ")[1].split(r"\int")[0]
    inside = printed(PAGE, r"m\,e^{-\alpha} + \operatorname{Re}\left(Z_N e^{ikx}\right)\operatorname{sinc}\frac{kh}{2}\right]\frac{d\alpha}{\alpha}")
    inside = inside.replace(r"\operatorname{Re}\left(Z_N e^{ikx}\right)\operatorname{sinc}\frac{kh}{2}\right]\frac{d\alpha}{\alpha}", "Z*S")
    printed(PAGE, "Z = c L - c (1, 1, beta)")
    nu, E, d = 0.3, 1.0, 1.0
    ka, Es = 3 - 4*nu, E/(1 - nu**2)
    case = dict(support="halfplane", young=E, poisson=nu, radius=1000, gap="parabola", half_width=1, mu=0.3, mesh="uniform", zone=2.5,
                contact_elements=24)
    layer, half = rollbem.solve(layer_thickness=d, **case), rollbem.solve(datum=d, **case)
    h, x = layer.h[0], np.array(layer.x)
    L_N = lambda al: (2*ka*np.sinh(2*al) - 4*al)/(2*ka*np.cosh(2*al) + 4*al**2 + 1 + ka**2)  # (L1)
    def integrand(al, r):
        return value(inside, m=1.0, e=np.e, alpha=al, Z=(L_N(al) - 1)*np.cos(al*r/d), S=np.sinc(al*h/(2*np.pi*d)))/al
    for j in [0, 3, 9]:
        got = value(factor, h=h, Es=Es)*integrate.quad(lambda al: integrand(al, x[j] - x[0]), 1e-6, 60, limit=200)[0]
        close(got, np.array(layer.F)[j, 0] - np.array(half.F)[j, 0], 1e-4)


def ring(m, nu):
    """The matrix M_m of (B20) in d/d ln r for u_r = U cos, u_theta = V sin, s_rr = S cos, s_rt = T sin: Hooke and equilibrium."""
    around = np.array([1, m, nu, 0])/(1 - nu)  # r s_tt
    return np.array([[-nu/(1 - nu), -nu*m/(1 - nu), (1 - 2*nu)/(1 - nu), 0], [m, 1, 0, 2], around - [0, 0, 0, m], m*around - [0, 0, 0, 1]])


def tag_B20():
    text = printed(PAGE, r"y &= (2GU, 2GV, rS, rT), \qquad \frac{dy}{d\ln r} = M_m\,y, \qquad y(\tau) = \sum_{\lambda = \pm m \pm 1} e^{-\lambda\tau} "
                   r"\prod_{\lambda' \ne \lambda} \frac{M_m - \lambda'}{\lambda - \lambda'}\,y(0)")
    fade, part = text.split(r"\pm 1} ")[1].split(r" \prod")[0].replace("e^{-", "exp(-").replace("}", ")"), text.split(r"\ne \lambda} ")[1].split(r"\,y")[0]
    m, nu, tau = 3, 0.3, 0.7
    M, roots = ring(m, nu), [m + 1, m - 1, 1 - m, -m - 1]
    close(np.sort(np.linalg.eigvals(M).real), sorted(roots))
    whole = 0
    for a in roots:
        term = np.eye(4)*value(fade.replace(r"\lambda", "l"), l=a, tau=tau)
        for b in roots:
            if b != a:
                term = term @ value(part.replace("M_m - \\lambda'", "N").replace(r"\lambda - \lambda'", "l-k"), N=M - b*np.eye(4), l=a, k=b)
        whole = whole + term
    close(whole, expm(-M*tau))
    around = printed(PAGE, r"\sigma_{rr} &= S, \qquad \sigma_{\theta\theta} = \frac{\nu S + (2GU + m\,2GV)/r}{1-\nu}, \qquad \sigma_{r\theta} = T").split("= ")[2].split(r", \qquad")[0]
    y, r = np.array([0.3, -0.2, 0.7, 0.4]), 1.7  # r d(rS)/dr = r s_tt - m r T
    close(value(around.replace("2GU", "u").replace("2GV", "v"), nu=nu, S=y[2]/r, u=y[0], v=y[1], m=m, r=r)*r, (M @ y)[2] + m*y[3])
    plane = printed(PAGE, r"\text{plane:}\quad \sigma_{rr} &= -f, \qquad \sigma_{\theta\theta} = f'', \qquad \sigma_{r\theta} = i f', \qquad f = (p + (p - iq)\,m\tau)\,e^{-m\tau}")
    f = plane.split("f = ")[1].replace("e^{-m\\tau}", "E").replace("m\\tau", "t")
    p, q, h = 0.7, 0.3, 1e-4
    of = lambda t: value(f, p=p, q=q, i=1j, t=t, E=np.exp(-t))
    d = lambda t: (of(t + h) - of(t - h))/(2*h)
    along, across = (plane.split("= ")[k].split(r", \qquad")[0] for k in (1, 3))
    close([value(along.replace("f", "v"), v=of(0)), value(across.replace("f'", "v"), v=d(0), i=1j)], [-p, q], 1e-6)  # the load
    large, away = 4000, 2.0  # a ring is a half-plane to waves that are short beside R; T sin: q = -i T
    M = ring(large, nu)
    w, v = np.linalg.eig(M)
    v = v[:, np.argsort(-w.real)[:2]].real
    y = v @ np.linalg.solve(v[2:], [-p, q])
    inner = expm(-M*away/large) @ y
    close(inner[2], -value(f, p=p, q=-1j*q, i=1j, t=away, E=np.exp(-away)).real, 2e-3)


def tag_B11_B12():
    text = printed(PAGE, r"u = -C\,t + u_s(\text{core}) - u_s(\text{cover}) - W\,u_s(\text{core, at the hub})").split("= ")[1]
    for old, new in [(r"u_s(\text{core})", "a"), (r"u_s(\text{cover})", "b"), (r"u_s(\text{core, at the hub})", "d")]:
        text = text.replace(old, new)
    C, W, t, a, b, d = 0.7, 0.4, 1.3, 0.2, 0.5, 0.3  # what is left of both after the strips: u - a = -C t + W (0 - d), the hub is at rest
    close(value(text, C=C, t=t, a=a, b=b, W=W, d=d), -C*t + W*(0 - d) + a - b)
    sum_text = printed(PAGE, r"\sum_{m=0}^{20/\ln(R/r)} (K_m - K_m^{\text{disc}})\, e^{imx}")
    last, term = sum_text.split("^{")[1].split("} (")[0], sum_text.split("} (")[1].split(")\\,")[0].replace(r"K_m^{\text{disc}}", "D").replace("K_m", "K")
    nu, deep = 0.3, 3.0  # ln(R/r)
    m = int(np.ceil(value(last.replace(r"\ln(R/r)", "l"), l=deep)))
    def K(m):  # no displacement at the bond: u_r at R by s = 1, t = 0
        inside = expm(ring(m, nu)*deep)[:, 2:]
        return (inside[0] @ np.linalg.solve(inside[2:], [1.0, 0.0]))
    disc = lambda m: ((3 - 4*nu)/(m + 1) + 1/(m - 1))/2
    rest = [abs(value(term, K=K(k), D=disc(k))) for k in (2, m)]
    assert 1e-6 < rest[0] < 0.1 and rest[1] < 1e-12*disc(m), rest


def tag_S1_axis():
    left, right = printed(PAGE, r"4\,k(y) \ge \max_x (s_1 - s_{zz}) - \min_x (s_2 - s_{zz})").replace(r"\max_x (s_1 - s_{zz})", "a").replace(r"\min_x (s_2 - s_{zz})", "b").split(r"\ge")
    rng = np.random.default_rng(2)
    one = rng.standard_normal(50) + 2
    two, z = one - 3*rng.random(50), rng.standard_normal(50)
    least = min(max((one - z - c).max(), (z + c - two).max()) for c in np.linspace(-9, 9, 36001))/2  # Tresca beside the axis, its stress free
    close(value(left.replace("k(y)", "k"), k=least), value(right, a=(one - z).max(), b=(two - z).min()), 1e-3)


def tag_B9():
    text = printed("theory.md", "x^2/(R + sqrt(R^2 - x^2))")
    close([value(text, x=x, R=1.0) for x in (0.5, 0.9)], [1 - np.sqrt(1 - x*x) for x in (0.5, 0.9)])
    close(value(text, x=1e-8, R=1.0), 5e-17)


def tag_B14():
    factor = printed(PAGE, "1 + (4/3) e (1 - e)/k^2")
    node = printed(PAGE, "d_k = D (k/32)^4").split("=")[1]
    d = np.array([value(node, k=k, D=1.0) for k in range(33)])
    for e in (0.5, 0.4):
        p = np.array([0.0] + [d[k]**e*value(factor, e=e, k=k) for k in range(1, 33)])
        close(((p[1:] + p[:-1])/2*np.diff(d)).sum(), 1/(1 + e), 2e-5)


def tag_E2():
    printed("theory-rolling.md", "1/R_x = 1/R_xA + 1/R_xB")
    along, steep, strip = (printed("theory-rolling.md", t) for t in (
        r"\frac{C_l}{C_s} = \frac{R_D(0,k^2,1)}{R_D(0,1,k^2)}", r"C_s = \frac{p_0\, s\, R_D(0,1,k^2)}{3 E^* l^2}", "R_eq = E\\* a/(2 p_0)"))
    along, steep, strip = along.split("=")[1], steep.split("=")[1], strip.split("=")[1]
    printed("theory-rolling.md", "R_eq/R_x is 0.989, 0.896, 0.785, 0.630, 0.271 at a/b = 0.1, 0.5, 1, 2, 10")
    R_D = special.elliprd
    for shown, slender in zip([0.989, 0.896, 0.785, 0.630, 0.271], [0.1, 0.5, 1, 2, 10]):
        k = min(slender, 1/slender)
        names = dict(k=k, s=k, l=1.0, R_D=R_D, Es=1.0, p_0=1.0, a=slender if slender < 1 else 1.0)
        C_s = value(steep, **names)
        C_x = C_s if slender < 1 else C_s*value(along, **names)
        close(round(value(strip, **names)*2*C_x, 3), shown)
    s = rollbem.solve(similar=True, support="halfplane", young=210000, poisson=0.3, radius=460, transverse_radius=300, gap="parabola",
                      wheel_load=1e5, mu=0)
    l, short = max(s.ellipse_a, s.ellipse_b), min(s.ellipse_a, s.ellipse_b)
    p_0 = value(printed("theory-rolling.md", r"p_0 = \frac{3W}{2\pi s l}").split("=")[1], W=1e5, s=short, l=l)
    Es = 210000/(1 - 0.09)/2
    names = dict(k=short/l, s=short, l=l, R_D=R_D, Es=Es, p_0=p_0, a=s.ellipse_a)
    close(s.normal_load, value(printed("faq.md", "3 P/(4 b)"), P=1e5, b=s.ellipse_b), 1e-6)
    close([s.ellipse_pressure, s.strip_radius], [p_0, value(strip, **names)], 1e-6)
    close([value(steep, **names), value(along, **names)*value(steep, **names)], sorted([1/600, 1/920], reverse=True), 1e-6)
    delta = printed("theory-rolling.md", r"\frac{p_0\, s}{E^*} K\!\left(\sqrt{1-k^2}\right)").replace(r"K\!\left(\sqrt{1-k^2}\right)", "K")
    close(s.ellipse_approach, value(delta, K=special.ellipk(1 - (short/l)**2), **names), 1e-6)


def tag_U1_U2():
    printed("theory-rolling.md", "eps = eps_A - eps_B"), printed("theory-rolling.md", "r = Q/(mu P)")
    X, nu, E, mu, R, a = 200.0, 0.3, 210000.0, 0.4, 100.0, 1.0
    eps = value(printed("theory-rolling.md", "eps = X (1-nu^2)/E").split("=")[1], X=X, nu=nu, E=E)
    case = dict(similar=True, support="halfplane", gap="parabola", young=E, poisson=nu, radius=R, half_width=a, mu=mu)
    strained = rollbem.solve(**case, formulation="steady", bulk_stress=X, creep=2e-3)
    close(strained.tangential_load, rollbem.solve(**case, formulation="steady", creep=2e-3 - eps).tangential_load, 1e-9)
    close(strained.free_creepage, eps, 1e-6)
    q = printed("theory-rolling.md", r"\left[ H\!\left(\frac{x}{a}\right) - \frac{c}{a} H\!\left(\frac{x-x_0}{c}\right) \right]").replace(r"\!", "")
    Es, r = E/(1 - nu**2)/2, -0.5
    p_0 = Es*a/(2*R)
    c = value(printed("theory-rolling.md", r"c = a \sqrt{1-|r|}").split("=")[1].replace(r"a \sqrt{1-|r|}", "a*sqrt(1-abs(r))"), a=a, r=r)
    shift, root = printed("theory-rolling.md", r"x_0 = \mathrm{sgn}\,Q \frac{(\epsilon_A-\epsilon_B) E^* a}{2 \mu p_0}, \quad H(t) = \sqrt{1-t^2}").split(r", \quad H(t) = ")
    shift = shift.split("=")[1].replace(r"\mathrm{sgn}\,Q", "turn").replace(r"\epsilon_A-\epsilon_B", "eps").replace(r"\mu", "m")
    s = rollbem.solve(**case, formulation="static", bulk_stress=60, force_ratio=r, contact_elements=400)
    x_0 = value(shift, turn=np.sign(r), eps=60*(1 - nu**2)/E, Es=Es, a=a, m=mu, p_0=p_0)
    H = lambda t: value(root.replace(r"\sqrt{1-t^2}", "sqrt(max0(1-t^2))"), t=t, max0=lambda y: np.maximum(y, 0))
    got = -value(q, H=H, x=np.array(s.x), a=a, c=c, x_0=x_0)*mu*p_0
    close(np.array(s.q)[np.abs(s.x) < 0.97], got[np.abs(s.x) < 0.97], 2e-2)


def tag_U3():
    X, R = 2e-3, 100.0
    case = dict(similar=True, support="halfplane", gap="parabola", young=210000, poisson=0.3, radius=R, load=500, mu=0)
    flat, tilted = rollbem.solve(**case), rollbem.solve(**case, tilt=X)
    x_0 = value(printed("theory-rolling.md", "x_0 = M/P = X R").split("=")[2], X=X, R=R)
    close((np.array(tilted.x)*tilted.p*tilted.h).sum()/500, x_0, 1e-3)
    close(flat.approach - tilted.approach, value(printed("theory-rolling.md", "delta falls by X^2 R/2").split("by")[1], X=X, R=R), 2e-2)


def tag_V1_V5():
    J = printed(PAGE, "J(t) = J_g [1 + sum f_k (1 - exp(-t/tau_k))]").split("=")[1]
    wave = printed(PAGE, "c(k) = 1 + sum f_k/(1 - i k L_k)").split("=")[1].replace("sum", "").replace("- i k L_k", "- 1j_*k*L_k")
    printed(PAGE, r"(E u)(x) = \frac1L\int_0^\infty e^{-r/L}\,u(x+r)\,dr")
    k, L, f, tau = 3.0, 0.7, 0.8, 2.0
    E = [integrate.quad(lambda r: np.exp(-r/L)/L*part(k*r), 0, 60*L, limit=500)[0] for part in (np.cos, np.sin)]  # of exp(ikx), at x = 0
    close(1 + f*(E[0] + 1j*E[1]), 1 + f/(1 - 1j*k*L), 1e-8)
    assert "f_k/(1 - 1j_*k*L_k)" in wave
    printed(PAGE, r"w = w_e + \sum_k f_k v_k, \qquad \tau_k\,\frac{dv_k}{dt} = w_e - v_k")
    v = integrate.solve_ivp(lambda t, v: (1 - v)/tau, [0, 3], [0], rtol=1e-10, atol=1e-12).y[0, -1]
    close(1 + f*v, value(J.replace("sum f_k (", "f_k*("), J_g=1.0, f_k=f, t=3.0, tau_k=tau), 1e-8)


def tag_conventions():  # what a half-plane remembers of loads that have passed
    d, L, P, compliance = 1000.0, 2000.0, 600.0, 2*(1 - 0.16)/(2*1143*1.4)  # CONTACT's visc_cylindr
    rows = [printed("getting-started.md", text).split("|") for text in (
        "ln(sqrt(r^2 + d^2)/r): positive, decreasing | 1.43536", "asinh(d/(2r)): a strip of width d of a half-space that rests far away | 1.45465",
        "ln(d/r), as in the elastic displacement | negative beyond d: under a given load the approach would fall without bound as the speed grows | 1.30047")]
    def remembered(text):
        text = re.split("[:,]", text)[0]
        f = lambda r: np.exp(-r/L)/L*value(text, r=r, d=d, asinh=np.arcsinh)
        return 2*P*compliance/np.pi*sum(integrate.quad(f, a, b, limit=300)[0] for a, b in [(0, d), (d, 40*L)])
    start = [float(row[-1]) - remembered(row[0]) for row in rows]  # the elastic part: one and the same
    close(start, 3*start[:1], 2e-5)
    of = re.search(r"datum (\d+).*?load (\d+)", open("tests/test_rolling_memory.c").read(), re.S)
    close([float(x) for x in of.groups()], [d, P])


def tag_V3():
    P_text, m_1, m_2 = (printed(PAGE, t).split("=")[1] for t in (
        r"m_0 &= \frac{(1+f)P}{\pi a}", r"m_1 = -\frac{E^*(x_0-L)}{2R}", r"m_2 = -\frac{E^* a}{4R}"))
    trailing = printed(PAGE, "m_0 I_0(k) - m_1 I_1(k) + m_2 I_2(k)")
    edge, leading = printed(PAGE, r"\frac{x_0+a}{R} &= \frac{2a}{E^* L}\left[m_0 J_0 + m_1 J_1 + m_2 J_2\right]").split("&=")
    moment = printed(PAGE, r"x_0 P + \frac{a^2}{1+f}\left[\frac{\pi m_1}{2} - \frac{LP}{a^2}\right]")
    J_1, J_2 = printed(PAGE, r"J_1 = K_1 - \frac1\kappa").split("=")[1], printed(PAGE, r"J_2 = K_2 - 2\left(\frac1\kappa + \frac1{\kappa^2}\right)").split("=")[1]
    J_1, J_2 = (t.replace(r"\frac1{\kappa^2}", "1/kap^2").replace(r"\frac1\kappa", "1/kap").replace(r"2\left", "2*") for t in (J_1, J_2))
    printed(PAGE, "k = (1 + f) a/L, kap = a/L")
    f, R, V, tau, P = 1.0, 100.0, 100.0, 0.01, 1.0
    s = rollbem.solve(support="halfplane", young=10, poisson=0.5, radius=R, gap="parabola", load=P, mu=0, formulation="steady", force=0,
                      relaxation_time=[tau], relaxation_ratio=[f], speed=V, contact_elements=200, mesh="fitted")
    L, Es = V*tau, 10/(1 - 0.25)
    def state(a, x_0):
        kap, k = a/L, (1 + f)*a/L
        names = dict(f=f, P=P, a=a, Es=Es, x_0=x_0, L=L, R=R, kap=kap, k=k)
        names.update(m_0=value(P_text, **names), m_1=value(m_1, **names), m_2=value(m_2, **names), J_0=special.kve(0, kap))
        names.update({f"I_{n}": (lambda z, n=n: special.ive(n, z)) for n in range(3)})
        for n, text in [(1, J_1), (2, J_2)]:
            names[f"J_{n}"] = value(text, **{f"K_{n}": special.kve(n, kap)}, kap=kap)
        return names
    def off(z):
        names = state(*z)
        return [value(trailing, **names)/names["m_0"], value(leading, **names) - value(edge, **names)]
    a, x_0 = optimize.fsolve(off, [(s.contact_to - s.contact_from)/2, (s.contact_to + s.contact_from)/2], xtol=1e-13)
    close([a, x_0], [(s.contact_to - s.contact_from)/2, (s.contact_to + s.contact_from)/2], 2e-3)
    close(value(moment, **state(a, x_0)), s.resistance_moment, 2e-3)


def tag_L2():
    stiff, soft = printed(PAGE, r"(1-\nu)f''' - (2-\nu)f' = \rho\,(f + \beta_2 f')"), printed(PAGE, r"(1-\nu)f'' + \nu f = -\rho\,(f' + \beta_2 f)")
    rho_text, beta_text = printed(PAGE, "rho = 4 G/E\\*_2"), printed(PAGE, "beta_2 = (1 - 2 nu_2)/(2 (1 - nu_2))").split("= ")[1]
    printed(PAGE, "Then p = 1, s = 0 gives L_N = D, L_C = -C - 1/(2 (1 - nu)), and s = 1, p = 0 gives L_T = -C")
    assert stiff and soft and rho_text
    h = lambda x, n: np.cosh(x) if n % 2 == 0 else np.sinh(x)
    def slope(kind, n, e):  # n-th derivative of cosh, sinh, eta sinh eta, eta cosh eta - sinh eta
        if kind < 2:
            return h(e, n + kind)
        return e*h(e, n + 1 + kind - 2) + n*h(e, n + kind - 2) - (kind - 2)*h(e, n + 1)
    def layer(al, nu, rho, beta_2, p, s):
        rows, right = np.zeros((2, 2)), np.zeros(2)
        for kind, weight in [(0, p), (1, s), (2, None), (3, None)]:
            d = [slope(kind, n, al) for n in range(4)]
            a = [(1 - nu)*d[3] - (2 - nu)*d[1] - rho*(d[0] + beta_2*d[1]), (1 - nu)*d[2] + nu*d[0] + rho*(d[1] + beta_2*d[0])]
            if weight is None:
                rows[:, kind - 2] = a
            else:
                right -= weight*np.array(a)
        return np.linalg.solve(rows, right)  # C, D
    nu, al = 0.3, 0.8
    ka = 3 - 4*nu
    den = 2*ka*np.cosh(2*al) + 4*al**2 + 1 + ka**2
    C, D = layer(al, nu, 0.0, 0.0, 1, 0)
    close([D, -C - 1/(2*(1 - nu)), -layer(al, nu, 0.0, 0.0, 0, 1)[0]],
          [(2*ka*np.sinh(2*al) - 4*al)/den, (2*ka*(ka - 1)*(np.cosh(2*al) - 1) - 8*al**2)/((ka + 1)*den), (2*ka*np.sinh(2*al) + 4*al)/den])  # (L1)
    E, beta_2 = 1.0, value(beta_text, nu_2=nu)
    C, D = layer(al, nu, 4*E/(2*(1 + nu))/(E/(1 - nu**2)), beta_2, 1, 0)  # a base of the same material: the half-plane
    close([D, -C - 1/(2*(1 - nu))], [1, (1 - 2*nu)/(2*(1 - nu))])


def tag_S1():
    k = printed(PAGE, r"\sqrt{\left(\frac{s_{xx}-s_{yy}}{2} + c\right)^2 + s_{xy}^2}")
    limit = printed(PAGE, "p0/k = 1/(mu sqrt(4 s (1 - s) + s^3))").split("= ")[1]
    s, mu = 0.4, 0.3
    x = np.linspace(-1, 1, 20001)
    y, b = x - s, 1 - s  # Carter's friction: a half-ellipse less a smaller one at the leading edge, and their slopes
    beyond = np.sqrt(np.maximum(y*y - b*b, 0))
    shear = mu*(np.sqrt(1 - x*x) - np.sqrt(np.maximum(b*b - y*y, 0)))
    half = mu*(x - y + np.sign(y)*beyond)
    radius = min(value(k.replace("s_{xx}-s_{yy}", "2*half").replace("s_{xy}", "shear"), half=half, shear=shear, c=c).max()
                 for c in np.linspace(-1, 1, 4001))
    close(1/radius, value(limit, mu=mu, s=s), 2e-3)


def tag_B17():
    P = value(printed(PAGE, "P = pi R X^2/E*").split("=")[1].replace("E*", "Es"), R=500, X=800.0, Es=210000/0.91/2)
    s = rollbem.solve(similar=True, support="halfplane", gap="parabola", young=210000, poisson=0.3, radius=500, mu=0, max_pressure=800)
    close(s.normal_load, P, 1e-3)


def tag_B18():
    piece, slope, surface = (printed(PAGE, text) for text in ("g(z) Lambda + g' h", "g' Lambda", "sxx = -p - (2/pi) PV int q/(x - s) ds"))
    printed(PAGE, "g = -p + i q on a piece of length h and Lambda = ln(s_2 - z) - ln(s_1 - z)")
    printed(PAGE, "a jump [g] at s adds [g]/(s - z)")
    lo, hi, z, a, b = -0.5, 1.2, 0.3 - 0.4j, 0.7 + 0.1j, 0.9 - 0.3j
    x, w = np.polynomial.legendre.leggauss(80)
    s, w = (lo + hi)/2 + (hi - lo)/2*x, (hi - lo)/2*w
    g = lambda s: a + b*s
    names = dict(gz=g(z), Lambda=np.log(hi - z) - np.log(lo - z), dg=b, h=hi - lo)
    close(value(piece.replace("g(z)", "gz").replace("g'", "dg"), **names), (g(s)/(s - z)*w).sum())
    close(value(slope.replace("g'", "dg"), **names) + g(lo)/(lo - z) - g(hi)/(hi - z), (g(s)/(s - z)**2*w).sum())
    near = 1e-7j  # q = 1 over -1 ... 1, p = 0: 4 Re Phi = sxx on the surface
    phi = lambda z: 1j*(np.log(1 - z) - np.log(-1 - z))/(2j*np.pi)
    close(4*phi(0.4 - near).real, value("-p - (2/pi)*pv", p=0.0, pv=np.log(1.4/0.6)), 1e-5)
    assert surface


def tag_V8_waves():
    c_m = printed(PAGE, "c_m = 1 + sum f_k/(1 - i m L_k/R)").split("=")[1].replace("sum", "").replace("i m", "j*m")
    for m in (1, 7):
        L, R = 3.0, 2.0
        E = [integrate.quad(lambda r: np.exp(-r/L)/L*part(m*r/R), 0, 60*L, limit=900)[0] for part in (np.cos, np.sin)]
        close(value(c_m, f_k=1.0, j=1j, m=m, L_k=L, R=R), 1 + E[0] + 1j*E[1], 1e-7)


def tag_L1_coupling():
    """The signs of L_C in w_N and w_T, and (L6) for one layer on a rigid base."""
    w_N, w_T = printed(PAGE, r"\left[L_N\,p - i\operatorname{sgn}(k)\,L_C\,q\right]"), printed(PAGE, r"\left[L_T\,q + i\operatorname{sgn}(k)\,L_C\,p\right]")
    assert w_N and w_T
    nu, d, n = 0.3, 1.0, 24
    ka, Es, G = 3 - 4*nu, 1/(1 - nu**2), 1/(2*(1 + nu))
    s = rollbem.solve(support="halfplane", layer_thickness=d, young=1.0, poisson=nu, radius=1000, gap="parabola", half_width=1, mu=0.3,
                      mesh="uniform", zone=2.5, contact_elements=n)
    h, x, F = s.h[0], np.array(s.x), np.array(s.F)
    k = np.arange(1, 400001)*0.5e-3
    al = np.minimum(k*d, 200)
    D = 2*ka*np.cosh(2*al) + 4*al**2 + 1 + ka**2
    L_C = (2*ka*(ka - 1)*(np.cosh(2*al) - 1) - 8*al**2)/((ka + 1)*D)
    for j in (3, 7):  # -i sgn(k) L_C: the sine
        got = (2*L_C/(Es*k)*np.sin(k*(x[j] - x[0]))*np.sinc(k*h/(2*np.pi))).sum()*0.5e-3*h/np.pi
        close([got, -got], [F[j, n], F[n + 1 + j, 0]], 5e-3)
    A = [[value(cell.replace("nu", "v") if cell.strip() != "0" else "0*v", G=G, c=value(printed(PAGE, "c = nu/(1 - nu)").split("=")[1], nu=nu), v=nu)
          for cell in row.replace(r"\nu", " v ").split("&")]
         for row in printed(PAGE, r"0 & -1 & 1/G & 0 \\ c & 0 & 0 & \frac{1-2\nu}{2(1-\nu)G} \\ \frac{2G}{1-\nu} & 0 & 0 & -c \\ 0 & 0 & 1 & 0").split(r"\\")]
    A = np.array(A, float)
    square = A @ A - np.eye(4)
    assert abs(square @ square).max() < 1e-12
    parts = printed(PAGE, "a2 = eta sinh(eta)/2, a3 = (eta cosh eta - sinh eta)/2, a0 = cosh eta - a2, a1 = sinh eta - a3").replace("cosh eta", "cosh(eta)").replace("sinh eta", "sinh(eta)")
    known = dict(eta=1.3)
    for part in parts.split(","):
        name, text = part.split("=")
        known[name.strip()] = value(text, **known)
    T = value(printed(PAGE, "exp(-A eta) = a0 - a1 A + a2 A^2 - a3 A^3").split("=")[1].replace("A^2", "A2").replace("A^3", "A3"), A=A, A2=A @ A, A3=A @ A @ A, **known) \
        + known["a0"]*(np.eye(4) - 1)
    close(T, expm(-1.3*A), 1e-9)
    C = -T[:2, 2:] @ np.linalg.inv(T[2:, 2:])  # on a rigid base
    printed(PAGE, "-(T12 - T11 C)(T22 - T21 C)^-1"), printed(PAGE, "L_N = C_WW, L_T = C_UU, L_C = C_UW, over (1 - nu)/G")
    at = lambda f: f/(2*ka*np.cosh(2.6) + 4*1.69 + 1 + ka**2)*(1 - nu)/G
    close([abs(C[1, 1]), abs(C[0, 0])], [at(2*ka*np.sinh(2.6) - 5.2), at(2*ka*np.sinh(2.6) + 5.2)], 1e-9)


def tag_L2_L5():
    """The stress function: biharmonic, p and s at the surface, in equilibrium."""
    f = printed(PAGE, "p cosh eta + s sinh eta + C eta sinh eta + D (eta cosh eta - sinh eta)").replace("cosh eta", "cosh(eta)").replace("sinh eta", "sinh(eta)")
    of = lambda eta: value(f, p=0.7, s=-0.3, C=1.1, D=0.4, eta=eta)
    at, step = 0.9, 1e-2
    v = [of(at + k*step) for k in range(-3, 4)]
    second = (-v[1] + 16*v[2] - 30*v[3] + 16*v[4] - v[5])/(12*step**2)
    fourth = (-v[0] + 12*v[1] - 39*v[2] + 56*v[3] - 39*v[4] + 12*v[5] - v[6])/(6*step**4)
    close(fourth + v[3], 2*second, 1e-4)
    close([of(0.0), (of(1e-6) - of(-1e-6))/2e-6], [0.7, -0.3], 1e-6)
    half = printed(PAGE, "(1 + eta) exp(-eta) p^ - i eta exp(-eta) q^").replace("p^", "p").replace("q^", "q")
    near = [value(half, eta=e, p=0.7, q=-0.3j, i=1j) for e in (0.0, 1e-6, -1e-6)]  # q = i s: f'(0) = s
    close([near[0], (near[1] - near[2])/2e-6], [0.7, -0.3], 1e-6)
    text = printed(PAGE, "s_xx = f'', s_yy = -f, s_xy = -i f' times exp(ikx)")
    stress = dict(part.split(" = ") for part in text.replace(" times exp(ikx)", "").replace("f''", "f2").replace("f'", "f1").split(", "))
    names = dict(f=v[3], f1=(v[1] - 8*v[2] + 8*v[4] - v[5])/(12*step), f2=second, i=1j)
    along = {name: value(of, **names) for name, of in stress.items()}
    down = {name: value(of.replace("f1", "f2") if "f1" in of else of.replace("f", "f1"), **names) for name, of in stress.items() if name != "s_xx"}
    close([1j*along["s_xx"], 1j*along["s_xy"]], [-down["s_xy"], -down["s_yy"]])


def tag_V3_pressure():
    """Hunter's equation for the pressure, in the contact that the program finds."""
    left, right = printed(PAGE, "(1 + f) p - L p' = [m_0 + m_1 T_1(t) + m_2 T_2(t)]/sqrt(1 - t^2)").replace("p'", "dp").split(" = ")
    f, R, V, tau, P = 1.0, 100.0, 100.0, 0.01, 1.0
    s = rollbem.solve(support="halfplane", young=10, poisson=0.5, radius=R, gap="parabola", load=P, mu=0, formulation="steady", force=0,
                      relaxation_time=[tau], relaxation_ratio=[f], speed=V, contact_elements=400, mesh="fitted")
    a, x_0, L, Es = (s.contact_to - s.contact_from)/2, (s.contact_to + s.contact_from)/2, V*tau, 10/0.75
    x, p = np.array(s.x), np.array(s.p)
    t = (x - x_0)/a
    inner = abs(t) < 0.9
    names = dict(f=f, L=L, p=p[inner], dp=np.gradient(p, x)[inner], t=t[inner], T_1=lambda t: t, T_2=lambda t: 2*t*t - 1,
                 m_0=(1 + f)*P/(np.pi*a), m_1=-Es*(x_0 - L)/(2*R), m_2=-Es*a/(4*R))
    printed(PAGE, "t = (x - x0)/a, k = (1 + f) a/L, kap = a/L")
    close(value(left, **names), value(right, **names), 1e-2)


def tag_L3_elastic_base():
    printed(PAGE, r"With Z = c L - c (1, 1, beta), m = 1 + sum f - E\*/E\*_2 (rigid base: 1 + sum f)")
    more = printed(PAGE, r"2h/(pi E\*) E\*/E\*_2 ln(datum/d)").replace("E\\*_2", "Es_2")
    case = dict(support="halfplane", layer_thickness=1.0, young=1.0, poisson=0.3, base_young=0.5, base_poisson=0.3, radius=1000,
                gap="parabola", half_width=1, mu=0.3, mesh="uniform", zone=2.5, contact_elements=24)
    solved = [rollbem.solve(datum=datum, **case) for datum in (20.0, 50.0)]
    near, far = (np.array(s.F)[0, :24:6] for s in solved)
    h, Es = solved[0].h[0], 1/0.91
    of = lambda datum: value(more, h=h, Es=Es, Es_2=0.5/0.91, datum=datum, d=1.0)
    close(far - near, 0*far + of(50.0) - of(20.0), 1e-3)


if __name__ == "__main__":
    raise SystemExit(run(globals()))
