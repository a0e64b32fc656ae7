"""docs/theory-solvers.md: edges, pairs of elements, reference solutions."""
import numpy as np
import rollbem
from scipy import integrate, optimize, special
from printed import close, printed, run, value

PAGE = "theory-solvers.md"


def slope(f, x, n=4000):
    """PV int f(s)/(x - s) ds over -1 ... 1."""
    t = np.pi*(np.arange(n) + 0.5)/n
    s = -np.cos(t)
    return f(x)*np.log((x + 1)/(1 - x)) + ((f(s) - f(x))/(x - s)*np.sin(t)).sum()*np.pi/n


def tag_E1():
    right = value(printed(PAGE, "1/2 + atan(beta kappa)/pi"), beta=0.4, kappa=0.5)
    left = value(printed(PAGE, "1/2 - atan(beta kappa)/pi"), beta=0.4, kappa=0.5)
    printed(PAGE, r"PV int p(s)/(x - s) ds = pi beta kappa p(x)")
    p = lambda s: (1 - s)**right*(1 + s)**left  # its slope less pi beta kappa p is a straight line
    rest = [slope(p, x, 40000) - np.pi*0.2*p(x) for x in (-0.5, 0.1, 0.7)]
    close((rest[1] - rest[0])/0.6, (rest[2] - rest[1])/0.6, 1e-4)


def tag_pairs():
    weights = [value(x) for x in printed(PAGE, "twice the means with weights 1/4, 1/2, 1/4 of three slips").split("weights ")[1].split(" of")[0].split(",")]
    w = np.array([0.3, 1.1, -0.4, 2.0])
    close(w[:2].mean() - w[2:].mean(), 2*(np.array(weights) @ -np.diff(w)))


def tag_Hertz_Carter_Cattaneo():
    P = printed(PAGE, r"P = pi E\* a^2/(4R)").split("=")[1]
    s = rollbem.solve("examples/carter/case.ini", mesh="aligned", contact_elements=200)
    R, Es, mu = 500, 210000/0.91/2, 0.3
    a = optimize.brentq(lambda a: value(P, Es=Es, a=a, R=R) - 1000, 1, 4)
    close([s.half_width, s.max_pressure], [a, value(printed(PAGE, "p0 = 2P/(pi a)").split("=")[1], P=1000, a=a)], 1e-3)
    close(-s.force_ratio, value(printed(PAGE, "s(2-s)"), s=0.4), 1e-4)
    close(s.stick_from, a - 2*value(printed(PAGE, "a' = a(1-s)").split("=")[1], a=a, s=0.4), 5e-2)
    text = printed(PAGE, "abs(q) = mu p0 [sqrt(1-x^2/a^2) - (a'/a) sqrt(1-((x-(a-a'))/a')^2)]").split("= ")[1].replace("a'", "b")
    inside = (s.zone == 1) & (abs(s.x - s.stick_from) > 0.1) & (s.x < 0.95*a)
    close(-s.q[inside], value(text, mu=mu, p0=s.max_pressure, x=s.x[inside], a=a, b=a*0.6), 5e-3)
    c = value(printed(PAGE, "c = a sqrt(1 - abs(Q)/(mu P))").split("=")[1], a=1.0, Q=-0.64, mu=1, P=1)
    q = value(printed(PAGE, "q = mu p0 [sqrt(1-x^2/a^2) - (c/a) sqrt(1-x^2/c^2)]").split("= ")[1], mu=1, p0=1, a=1.0, c=c, x=0.0)
    close([c, q], [0.6, 0.4])


def tag_Bentall_Johnson():
    free = rollbem.solve("examples/two-bodies/case.ini", mesh="fitted", contact_elements=200)
    eta = printed(PAGE, "ln((1+beta)/(1-beta))/(2 pi)")
    E, nu = np.array([60260, 209920]), np.array([0.31, 0.28])
    Es = 1/((1 - nu**2)/E).sum()
    c = (1 - 2*nu)*(1 + nu)/(2*E)
    beta = Es*(c[0] - c[1])
    e = value(eta, beta=beta)
    a = value(printed(PAGE, "a = a_h/sqrt(1+4 eta^2)").split("= ")[1], a_h=0.1, eta=e)
    close(-free.creepage, value(printed(PAGE, "abs(xi) = 2 eta a/R").split("= ")[1], eta=e, a=a, R=25.0), 2e-3)
    p = printed(PAGE, r"p(0) = E\* a/(2R sqrt(1-beta^2))").split("= ")[1]
    f = lambda s: (1 + s)**(0.5 + 1j*e)*(1 - s)**(0.5 - 1j*e)  # both equations of docs/course/half-plane.md
    at = [-2/np.pi*slope(f, x, 40000).real + 2*beta*f(x).imag for x in (-0.5, 0.4)]
    close(at, [x*at[1]/0.4 for x in (-0.5, 0.4)], 1e-6)
    close(1/abs(at[1]/0.4), value(p, Es=1.0, a=1.0, R=1.0, beta=beta), 1e-6)
    x0 = optimize.brentq(lambda x0: value(printed(PAGE, "asin x0 + x0 sqrt(1-x0^2)").replace("asin x0", "asin(x0)"), x0=x0) - np.pi/4, 0, 1)
    close(value(printed(PAGE, "sqrt(1-x0^2)/2"), x0=x0), value(printed(PAGE, "k = 0.457386").split("=")[1]), 2e-6)


def tag_half_cylinder():
    text = printed(PAGE, "P(1-nu^2)/(pi E) [2 ln(4R/a) - 1]")
    s = rollbem.solve("examples/hertz/case.ini", contact_elements=160)
    close(s.approach, value(text, P=90.6229, nu=0.3, E=210000, R=500, a=0.5), 1e-5)


def tag_below():
    for text, of in [("largest shear 0.30028 p0 at 0.78615 a", lambda sx, sy: abs(sx - sy)/2),
                     ("von Mises\n  0.55752 p0 at 0.70429 a", lambda sx, sy: np.sqrt(sx**2 + sy**2 + (0.3*(sx + sy))**2 - sx*sy - 0.3*(sx + sy)**2))]:
        size, depth = (value(x.split()[-1]) for x in printed(PAGE, text)[:-2].split(" p0 at "))
        y = np.linspace(0.5, 1, 500001)
        r = np.hypot(1, y)
        stress = of(-((1 + 2*y*y)/r - 2*y), -1/r)
        close([stress.max(), y[stress.argmax()]], [size, depth], 2e-5)


def tag_D6():
    text = printed(PAGE, "x' = (x - c)/b b' + c'").split("x' =")[1].replace("b b'", "b*e").replace("c'", "f")
    close([value(text, x=x, c=2.0, b=0.5, e=0.8, f=2.3) for x in (1.5, 2.5)], [1.5, 3.1])  # the edges go with the contact
    load = printed(PAGE, "P = 2 a^3/(3 R L_N)").split("=")[1]
    s = rollbem.solve(support="halfplane", similar=True, young=1e9, poisson=0, radius=50, gap="parabola", load=10, mu=0, interlayer_normal=1e-4)
    close(10, value(load, a=s.half_width, R=50.0, L_N=1e-4), 2e-2)
    hertz = printed("theory-rolling.md", r"a_H^2 = 4PR/(pi E\*)").split("=")[1]
    close(rollbem.solve("examples/hertz/case.ini", contact_elements=160).half_width**2, value(hertz, P=90.6229, R=500.0, Es=210000/0.91), 1e-3)


if __name__ == "__main__":
    raise SystemExit(run(globals()))
