"""docs/theory-bodies.md: relaxing bodies, wheels, layers, stress."""
import numpy as np
import rollbem
from scipy import integrate
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
    text = printed(PAGE, r"F(z)\,\Lambda - F'\,h")
    z, lo, hi = 0.3 + 0.4j, -0.5, 1.2
    F = lambda s: 0.7 + 0.9*s
    x, w = np.polynomial.legendre.leggauss(80)
    s, w = (lo + hi)/2 + (hi - lo)/2*x, (hi - lo)/2*w
    printed(PAGE, r"\Lambda = \ln\frac{a}{b}")
    names = {"F": F, "z": z, "Lambda": np.log((z - lo)/(z - hi)), "h": hi - lo, "slope": 0.9}
    close(value(text.replace("F'", "slope"), **names), (F(s)/(z - s)*w).sum())


def tag_B16():
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


def tag_V4_and_torques():
    balance = printed(PAGE, r"-\xi Q + \frac{M}{R} = D + H").split("=")
    s = rollbem.solve(support="halfplane", similar=True, radius=100, young=10, poisson=0.4, load=1, mu=0.3, creep_ratio=0.3,
                      formulation="steady", relaxation_time="0.01", relaxation_ratio="1", speed=200, gap="parabola")
    names = dict(xi=s.creepage, Q=s.tangential_load, M=s.resistance_moment, R=100, D=s.dissipation, H=s.hysteresis)
    close(value(balance[0], **names), value(balance[1], **names), 2e-3)
    rolls = rollbem.solve("examples/roll/case.ini", force_ratio=-0.3)
    names = dict(M=rolls.resistance_moment, Q=rolls.tangential_load, R_A=150, R_B=100)
    for name in "AB":
        text = printed(PAGE, f"T_{name} = M {'+' if name == 'A' else '-'} Q R_{name}").split("=")[1]
        close(value(text, **names), getattr(rolls, f"torque_{name.lower()}"), 1e-9)


def tag_V6():
    c_0 = printed(PAGE, r"c_0 = \frac{1-e^{-r}}{r} - e^{-r}").split("=")[1]
    c_1 = printed(PAGE, r"c_1 = 1 - \frac{1-e^{-r}}{r}").split("=")[1]
    for r in [0.1, 1.3]:  # a traction 1 - u, or u, faded over the step
        fade = lambda u: r*np.exp(-r*(1 - u))
        close(value(c_0, r=r, e=np.e), integrate.quad(lambda u: fade(u)*(1 - u), 0, 1)[0])
        close(value(c_1, r=r, e=np.e), integrate.quad(lambda u: fade(u)*u, 0, 1)[0])


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


def tag_S1():
    k = printed(PAGE, r"\sqrt{\left(\frac{s_{xx}-s_{yy}}{2} + c\right)^2 + s_{xy}^2}")
    limit = printed(PAGE, "p0/k = 1/(mu sqrt(4 s (1 - s) + s^3))").split("= ")[1].replace("s (1", "s*(1").replace("sqrt(4 s", "sqrt(4*s")
    s, mu = 0.4, 0.3
    x = np.linspace(-1, 1, 20001)
    y, b = x - s, 1 - s  # Carter's friction: a half-ellipse less a smaller one at the leading edge, and their slopes
    beyond = np.sqrt(np.maximum(y*y - b*b, 0))
    shear = mu*(np.sqrt(1 - x*x) - np.sqrt(np.maximum(b*b - y*y, 0)))
    half = mu*(x - y + np.sign(y)*beyond)
    radius = min(value(k.replace("s_{xx}-s_{yy}", "2*half").replace("s_{xy}", "shear"), half=half, shear=shear, c=c).max()
                 for c in np.linspace(-1, 1, 4001))
    close(1/radius, value(limit, mu=mu, s=s), 2e-3)


if __name__ == "__main__":
    raise SystemExit(run(globals()))
