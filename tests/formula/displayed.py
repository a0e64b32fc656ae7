"""Displayed formulas of docs/theory*.md that the other chapters leave out, each as it is printed."""
import numpy as np
import rollbem
from printed import close, printed, run, value
from scipy import integrate, special

BODIES, ROLLING, SOLVERS = "theory-bodies.md", "theory-rolling.md", "theory-solvers.md"
STEEL = dict(similar=True, support="halfplane", young=210000, poisson=0.3, radius=100, gap="parabola")
quad = lambda f, a, b, **more: integrate.quad(f, a, b, limit=400, **more)[0]


def right(page, text, **names):
    """The value of what stands behind the = of a printed formula."""
    return value(printed(page, text).split("=", 1)[1], **names)


def tag_slip_of_the_paper():
    text = printed("theory.md", r"s^*_i = \xi + \operatorname{sgn}(V)\,\frac{w_T(i+1) - w_T(i)}{x_{i+1} - x_i}").split("=")[1]
    printed("theory.md", r"\operatorname{sgn}(V) = -1 \text{ here}")
    for old, new in [("x_{i+1}", "x_1"), ("x_i", "x_0"), ("w_T(i+1)", "w_1"), ("w_T(i)", "w_0")]:
        text = text.replace(old, new)
    s = rollbem.solve(**STEEL, load=500, mu=0.3, formulation="static", shift=1e-3, creep=2e-3, contact_elements=40)
    close(value(text, xi=2e-3, V=-1.0, w_1=s.ut[1:], w_0=s.ut[:-1], x_1=s.x[1:], x_0=s.x[:-1]), s.slip[:-1], 1e-9)


def tag_borders():
    schur = printed(SOLVERS, r"(T - W A^{-1} V)\,y = g - W A^{-1} f, \qquad x = A^{-1}(f - V y)")
    left, of_y, of_x = (t.replace("A^{-1}(", "B*(").replace("A^{-1}", "B") for t in (
        schur.split(r"\,y =")[0], schur.split("= ")[1].split(r", \qquad")[0], schur.split("x = ")[1]))
    rng = np.random.default_rng(1)
    A, V, W, T, x, y = (np.matrix(rng.standard_normal(size)) for size in ((4, 4), (4, 2), (2, 4), (2, 2), (4, 1), (2, 1)))
    names = dict(B=A.I, V=V, W=W, T=T, f=A*x + V*y, g=W*x + T*y, y=y)
    close(value(left, **names)*y, value(of_y, **names)), close(value(of_x, **names), x)


def tag_V1():
    printed(BODIES, r"w(x) = w_e(x) + \sum_k f_k\,(E_k w_e)(x)")
    text = printed(BODIES, r"(E u)(x) = \frac1L\int_0^\infty e^{-r/L}\,u(x+r)\,dr, \qquad L = V\tau")
    assert r"\frac1L\int_0^\infty e^{-r/L}" in text
    e = lambda u, x, L: quad(lambda r: np.exp(-r/L)/L*u(x + r), 0, 60*L)  # what is ahead, x + r, was here
    close([e(lambda x: 1, 0.3, 0.7), e(lambda x: x, 0.3, 0.7)], [1, 0.3 + 0.7])
    jump = printed(BODIES, r"\left[\,2L\,(e^{y/L}-1) \text{ for } y < 0, \text{ else } 0\,\right]").split(r"\text")[0].split(r"\,", 1)[1]
    printed(BODIES, r"(E-1)\int\operatorname{sgn}(x-s)\,ds &="), printed(BODIES, r"(E-1)\int\ln|x-s|\,ds &= [\Phi(y)]")
    at = lambda y: value(jump, L=0.7, y=y, e=np.e) if y < 0 else 0.0
    whole = lambda x: abs(x + 1) - abs(x - 1)  # int sgn(x - s) ds over -1 ... 1
    for x in (-1.7, -0.2, 1.4):
        points = [p - x for p in (-1, 1) if p > x]
        moved = quad(lambda r: np.exp(-r/0.7)/0.7*whole(x + r), 0, 40, points=points or None)
        close(moved - whole(x), at(x + 1) - at(x - 1), 1e-6)


def tag_V2_datum():
    printed(BODIES, r"f\left(E\,g - h\ln d\right) \;\to\; f\left(E\,g - h\left[\ln d + G(d/L)\right]\right)")
    text = printed(BODIES, r"\operatorname{Re}\left[e^{iz}E_1(iz)\right]")
    inside = printed(BODIES, r"G(z) = \int_0^\infty e^{-u}\,\tfrac12\ln\left(1 + \frac{u^2}{z^2}\right)du").split(r"e^{-u}\,")[1][:-2]
    for z in (0.3, 2.0):
        got = value(text.replace("e^{iz}", "turn").replace("E_1(iz)", "tail"), turn=np.exp(1j*z), tail=special.exp1(1j*z))
        close(got, quad(lambda u: np.exp(-u)*value(inside, u=u, z=z), 0, 60), 1e-8)


def tag_V4():
    H = printed(BODIES, r"H = -\int\left(p\,w_N' + q\,w_T'\right)dx \ge 0")
    printed(BODIES, r"H_b = -\int\left(p\,u_N' + q\,u_T'\right)dx + \frac{1}{R_b}\int\left(p\,u_T - q\,u_N\right)dx")
    printed(BODIES, r"-\xi Q + \frac{M}{R} = D + H, \qquad H = -"), printed(BODIES, r"dx = H + \int\left(p\,w_N' + q\,w_T'\right)dx")
    s = rollbem.solve(support="halfplane", similar=True, radius=100, young=10, poisson=0.4, load=1, mu=0.3, creep_ratio=0.3, gap="parabola",
                      formulation="steady", relaxation_time="0.01", relaxation_ratio="1", speed=200, contact_elements=200)
    x, p, q = (np.array(v) for v in (s.x, s.p, s.q))
    slope = lambda w: np.gradient(np.array(w), x)
    inside = value(H.split(r"\left(")[1].split(r"\right)")[0].replace("w_N'", "v").replace("w_T'", "w"), p=p, q=q, v=slope(s.un), w=slope(s.ut))
    close(-(inside*np.array(s.h)).sum(), s.hysteresis, 2e-2)
    powers = printed(BODIES, r"-\xi Q + \frac{M}{R} + L = D + H").split("=")
    wheel = rollbem.solve(support="hub", hub_ratio=0.6, radius=50, young=1000, poisson=0.3, load=20, mu=0.3, creep_ratio=0.5, gap="parabola",
                          formulation="steady")
    names = dict(xi=wheel.creepage, Q=wheel.tangential_load, M=wheel.resistance_moment, R=50, L=wheel.lever_power, D=wheel.dissipation, H=0.0)
    terms = sum(abs(t) for t in (wheel.creepage*wheel.tangential_load, wheel.resistance_moment/50, wheel.dissipation, wheel.lever_power))
    assert abs(value(powers[0], **names) - value(powers[1], **names)) < 2e-3*terms
    levers = printed(BODIES, r"L = \sum_b \frac{1}{R_b}\int\left(p\,u_T - q\,u_N\right)dx").split(r"\left(")[1].split(r"\right)")[0]
    arms = value(levers, p=np.array(wheel.p), q=np.array(wheel.q), u_T=np.array(wheel.ut), u_N=np.array(wheel.un))
    close((arms*np.array(wheel.h)).sum()/50, wheel.lever_power, 5e-2)


def tag_torques():
    text = printed(BODIES, r"T_A = M + Q R_A, \qquad T_B = M - Q R_B \;(\text{of a bore, } R_B < 0, \text{ with the sign changed})")
    both = printed(BODIES, r"\frac{T_A}{R_A} + \frac{T_B}{|R_B|} = \frac{M}{R}").split("=")
    s = rollbem.solve("examples/roll/case.ini", force_ratio=-0.3)
    names = dict(M=s.resistance_moment, Q=s.tangential_load, R_A=150.0, R_B=100.0, T_A=s.torque_a, T_B=s.torque_b, R=60.0)
    close(value(text.split("=")[1].split(",")[0], **names), s.torque_a), close(value(text.split("T_B = ")[1].split(r" \;")[0], **names), s.torque_b)
    close(value(both[0], **names), value(both[1], **names))


def tag_L9():
    fix = lambda t: t.replace(r"\sinh^2\alpha", "s^2").replace(r"\cosh^2\alpha", "c^2").replace(r"\sinh\alpha\cosh\alpha", "s c ")
    N, T, C = (printed(BODIES, t).split("=")[1] for t in (
        r"L_N = \frac{\sinh^2\alpha}{\sinh\alpha\cosh\alpha+\alpha}", r"L_T = \frac{\cosh^2\alpha}{\sinh\alpha\cosh\alpha+\alpha}",
        r"L_C = \beta - \frac{\alpha}{\sinh\alpha\cosh\alpha+\alpha}"))
    L = lambda t, a: value(fix(t), s=np.sinh(a), c=np.cosh(a), alpha=a, beta=0.2)
    close([L(N, 30.0), L(T, 30.0), L(C, 30.0)], [1, 1, 0.2])  # the half-plane
    close([L(N, 1e-3), L(T, 1e-3)*2e-3, L(C, 1e-6) - 0.2], [5e-4, 1, -0.5], 1e-5)  # a pillar, a membrane, Poisson
    s = rollbem.solve(support="halfplane", layer_thickness=1, layer_base="smooth", young=1.0, poisson=0.3, radius=1000, gap="parabola",
                      half_width=1, mu=0.3, formulation="steady", creep=1e-4, mesh="uniform", zone=2.5, contact_elements=24)
    F, h, x = np.array(s.F), s.h[0], np.array(s.x)
    al = (np.arange(400000) + 0.5)*5e-4
    both = [(2*0.91/al*L(N, np.minimum(al, 300))*np.cos(al*(x[j] - x[0]))*np.sinc(al*h/(2*np.pi))).sum()*5e-4*h/np.pi for j in (0, 7)]
    close(both, [F[0, 0], F[7, 0]], 2e-3)


def tag_A1():
    text = printed(ROLLING, r"a^3 = a_H^2\,(1 + m)\,\left(1 + \frac{0.162\,t\,(t + 0.052)}{(t + 0.0174)\,(t + 0.364)}\right) a + B").split("= ")[1]
    B, t = printed(ROLLING, r"B = \tfrac32 R L_N P").split("=")[1], printed(ROLLING, "t = B/a^3").split("=")[1]
    m = printed(ROLLING, r"\frac{f_k}{1 + z_k + 1.15\,z_k^2/(1 + \sum f)^{0.6}}").replace(r"\sum f", "f")
    z = printed(ROLLING, r"z_k = V\tau_k/a").split("=")[1].replace(r"\tau_k", "*tau_k")
    for case, more in [(dict(interlayer_normal=2e-5), {}), (dict(speed=100, relaxation_time="0.01", relaxation_ratio="4"), dict(V=100, f=4.0))]:
        s = rollbem.solve(**STEEL, load=1000, mu=0.0, formulation="steady", creep=0.0, **case)
        a, squared = s.hertz_half_width, 4*1000*100/(np.pi*210000/0.91/2)
        b = value(B, R=100.0, L_N=case.get("interlayer_normal", 0.0), P=1000.0)
        mean = value(m, f_k=4.0, f=4.0, z_k=value(z, V=100.0, tau_k=0.01, a=a)) if more else 0.0
        names = dict(a_H=np.sqrt(squared), m=mean, t=value(t, B=b, a=a), a=a, B=b)
        close(value(text, **names), a**3, 1e-6)


def tag_T3():
    text = printed(ROLLING, r"\theta(x) = \frac{2\sqrt{c/(\pi V)}}{e_1 + e_2}\sum_k H_k(x + kc)\left[\sqrt{k+1} - \sqrt{k}\right]").split("=")[1]
    factor, step = text.split(r"\sum")[0], text.split(r"\left[")[1].split(r"\right]")[0]
    fix = lambda t: t
    got = sum(value(fix(factor), c=0.01, V=3.0, e_1=0.5, e_2=0.7)*value(fix(step), k=k) for k in range(100))
    close(got, 2*np.sqrt(1/(np.pi*3.0))/1.2)  # a unit of heat over the way 1


def tag_T4():
    text = printed(ROLLING, r"\theta(x, y) = \frac{1}{\pi k}\int H(s)\,e^{Pd}\,K_0\!\left(P\sqrt{d^2 + y^2}\right)ds, \qquad d = s - x")
    assert text.endswith("d = s - x")
    shown = printed(ROLLING, "2.084438, 0.768439, 0.168066, 0.016784").split(", ")
    kernel = lambda d, P: np.exp(P*d)*special.k0(P*np.hypot(d, 0.1))/np.pi
    for word, P in zip(shown, (0.1, 1.0, 10.0, 100.0)):  # Pe = P a
        close(quad(lambda d: kernel(d, P), -1, 1, points=[0.0]), float(word), 3e-5)


def tag_memory_at_rest():
    text = printed(ROLLING, r"\mu_i = \mu + (\mu_{before} - \mu)\, e^{-|\lambda_i|/d}").split("= ")[1]
    text = text.replace(r"\mu_{before}", "m").replace(r"\mu", "n").replace(r"e^{-|\lambda_i|/d}", "exp(-abs(l)/d)")
    close([value(text, m=0.5, n=0.3, l=l, d=0.1) for l in (0.0, -0.1, 0.1, 50.0)], [0.5, 0.3 + 0.2/np.e, 0.3 + 0.2/np.e, 0.3])


def tag_punch():
    p = printed(ROLLING, r"p = \frac{P/\pi + E^* X x/2}{\sqrt{a^2-x^2}}").split("=")[1]
    M = printed(ROLLING, r"M = \frac{\pi a^2 E^* X}{4}").split("=")[1]
    most = printed(ROLLING, r"|X| \le \frac{2P}{\pi E^* a}").split(r"\le")[1]
    names = dict(P=3.0, Es=40.0, X=0.02, a=1.5)
    at = lambda x: value(p, x=x, **names)*np.sqrt(names["a"]**2 - x*x)
    over = lambda f: quad(lambda t: at(1.5*np.sin(t))*f(1.5*np.sin(t)), -np.pi/2, np.pi/2)
    close([over(lambda x: 1), over(lambda x: x)], [3.0, value(M, **names)])
    assert abs(value(p, x=-1.49999, **{**names, "X": value(most, **names)})) < 1e-2*value(p, x=0.0, **names)


def tag_waves():
    a = printed(ROLLING, r"\frac{2a}{L} = \frac{2}{\pi} \arcsin\sqrt f").split("=")[1].replace(r"\arcsin\sqrt f", "*asin(sqrt(f))")
    p0 = printed(ROLLING, r"p_0 = \frac{2 P/L}{\sin(\pi a/L)}").split("=")[1].replace(r"\sin(\pi a/L)", "S")
    delta = printed(ROLLING, r"\frac{\delta}{D} = f (1 - \ln f)").split("=")[1]
    Es, D, L = 210000/0.91/2, 0.001, 1.0
    f = 0.4
    s = rollbem.solve(support="halfplane", similar=True, young=210000, poisson=0.3, gap="wave", amplitude=D, period=L, load=f*np.pi*Es*D, mu=0,
                      contact_elements=512)
    half = value(a, f=f)*L/2
    close([s.half_width, s.max_pressure, s.approach], [half, value(p0, P=f*np.pi*Es*D, L=L, S=np.sin(np.pi*half/L)), value(delta, f=f)*D], 5e-3)


def tag_Q1():
    printed(ROLLING, r"W = \int |q|\, |ds|, \quad D = \max s - \min s, \quad R_1 = D \max |q|")
    printed(ROLLING, r"R_2 = \langle\max \sigma_{xx}\rangle R_1, \quad S = \langle\max \sigma_{xx}\rangle \frac{\max \varepsilon - \min \varepsilon}{2}")
    D = printed(ROLLING, r"D = \frac{2 \mu p_0}{E^* a} \left( |x| \sqrt{x^2 - c^2} - c^2 \operatorname{arcosh} \frac{|x|}{c} \right)").split("= ")[1]
    D = D.replace(r"\sqrt{x^2 - c^2}", "*sqrt(x^2-c^2)").replace(r"\operatorname{arcosh} \frac{|x|}{c}", "*acosh(abs(x)/c)")
    work = printed(ROLLING, r"W = 2 \mu p D").split("=")[1]
    pull = printed(ROLLING, r"\max \sigma_{xx} = -p + \frac{2 \mu p_0}{a} \sqrt{x^2 - c^2}").split("= ")[1].replace(r"\sqrt{x^2 - c^2}", "*sqrt(x^2-c^2)")
    printed(ROLLING, "W and R_1 are largest at 0.9138 a, R_2 at 0.9681 a")
    Es, E, mu, a = 210000/0.91/2, 210000, 0.5, np.sqrt(4*500*100/(np.pi*210000/0.91/2))
    p_0, c = 2*500/(np.pi*a), a*np.sqrt(0.4)
    x = np.linspace(c, a, 200001)
    names = dict(mu=mu, p_0=p_0, Es=Es, a=a, c=c, x=x, p=p_0*np.sqrt(1 - x*x/a**2))
    slip, tension = value(D, **names), value(pull, **names)
    total = value(work, D=slip, **names)
    largest = lambda y: x[y.argmax()]/a
    close([largest(total), largest(slip*names["p"]), largest(slip*names["p"]*np.maximum(tension, 0))], [0.9138, 0.9138, 0.9681], 1e-4)
    close(2*np.trapezoid(total, x) if hasattr(np, "trapezoid") else 2*np.trapz(total, x), float(printed(ROLLING, "the work is 0.0368862").split()[-1]), 1e-5)


def tag_Somigliana():
    """The half belongs to the diagonal: a translation moves every midpoint by itself."""
    printed("theory.md", r"\tfrac12 u_i(p) + \mathrm{PV}\!\int T_{ij}\,u_j\,ds = \int U_{ij}\,t_j\,ds")
    s = rollbem.solve("examples/by-hand/case.ini")
    H = np.array(s.H)
    assert max(abs(H[:, 0::2].sum(1)).max(), abs(H[:, 1::2].sum(1)).max()) < 1e-12
    close(np.diag(H), 0.5 + 0*H[0], 1e-9)


def tag_complementary():
    printed("theory.md", r"z = (r_N, \lambda) \ge 0, \qquad w = (y_N, \gamma) = Mz + b \ge 0, \qquad z'w = 0, \qquad \text{size } 3n")
    printed("theory.md", r"\text{column of } \delta' &: \quad -1 \text{ in every gap row}")
    printed(ROLLING, r"0 \le \lambda_s \perp \mu p - |q| \ge 0, \qquad 0 \le \lambda_p \perp \tau - |q| \ge 0")
    s = rollbem.solve(**STEEL, load=500, mu=0.3, formulation="steady", creep_ratio=0.5, contact_elements=40)
    p, q, gap, slip = (np.array(v) for v in (s.p, s.q, s.gap, s.shift))
    assert min(p.min(), gap.min(), (0.3*p - abs(q)).min()) > -1e-9*p.max()
    assert abs(p*gap).max() < 1e-12*p.max() and abs(slip*(0.3*p - abs(q))).max() < 1e-12*p.max()


def tag_W5():
    """What is worn off at A's place x lies under B's place X = x + u."""
    printed(ROLLING, r"h_A(x) \leftarrow h_A + K_A 4SN \sum_j w_j p_j(x), \qquad h_B(X) \leftarrow h_B + K_B 4SN \sum_j w_j p_j(X - u_j)")
    at = printed(ROLLING, "the\ngap is g(x) + h_A(x) + h_B(x + u)").split("h_B(")[1][:-1]
    p = lambda x: np.exp(-x*x)
    h_B = lambda X, u: p(X - u)
    close([h_B(value(at, x=x, u=0.4), 0.4) for x in (-0.3, 0.0, 0.8)], [p(x) for x in (-0.3, 0.0, 0.8)])


def tag_V8_logarithm():
    text = printed(BODIES, r"\ell = -\ln(1-e^{ix})").split("=")[1].replace("(1-e^{ix})", "(1-E)")
    close(value(text, E=0.9*np.exp(0.7j)), sum((0.9*np.exp(0.7j))**m/m for m in range(1, 2000)))


def tag_L1_waves():
    """The half-plane (B6), whose logarithm and sign have the transforms -pi/abs(k) and 2/(i k)."""
    N, T = (printed(BODIES, t).split("=")[1] for t in (
        r"w_N = \frac{2}{E^*|k|}\left[L_N\,p - i\operatorname{sgn}(k)\,L_C\,q\right]",
        r"w_T = \frac{2}{E^*|k|}\left[L_T\,q + i\operatorname{sgn}(k)\,L_C\,p\right]"))
    Es, c = 3.0, 0.1
    for k in (-1.7, 0.4):
        names = dict(Es=Es, k=k, i=1j, L_N=1.0, L_T=1.0, L_C=c*Es)
        direct, coupled = -2/(np.pi*Es)*(-np.pi/abs(k)), 2*c/(1j*k)
        close([value(N, p=1.0, q=0.0, **names), value(N, p=0.0, q=1.0, **names)], [direct, coupled])
        close([value(T, p=0.0, q=1.0, **names), value(T, p=1.0, q=0.0, **names)], [direct, -coupled])


def tag_period():
    printed(ROLLING, r"w_N(x) = -\frac{2}{\pi E^*} \int_0^L p(s) \ln\left|2 \sin\frac{\pi (x-s)}{L}\right| ds, \qquad "
                     r"\operatorname{sgn} u \;\to\; 1 - \frac{2u}{L}, \quad 0 < u < L")
    s = rollbem.solve(support="halfplane", young=1.0, poisson=0.3, radius=100, gap="parabola", period=3.0, load=1e-3, mu=0.3,
                      mesh="uniform", zone=0.8, contact_elements=16)
    F, x, h, n = np.array(s.F), np.array(s.x), s.h[0], 16
    over = lambda f, j: quad(lambda u: f(x[j] - u), x[0] - h/2, x[0] + h/2)
    for j in (3, 9):
        close(F[j, 0], -2*0.91/np.pi*over(lambda d: np.log(abs(2*np.sin(np.pi*d/3.0))), j), 1e-7)
        close(F[j, n], 0.4*1.3/2*over(lambda d: 1 - 2*d/3.0, j), 1e-7)


def tag_shakedown():
    printed(BODIES, r"k(y) = \min_c \max_x \sqrt{\left(\frac{s_{xx}-s_{yy}}{2} + c\right)^2 + s_{xy}^2}, \qquad 2c \text{ the residual stress}")
    x = np.linspace(-8, 8, 401)
    below = rollbem.stress(**STEEL, half_width=1, mu=0, points=np.column_stack([x, np.full(401, 0.5)]))
    half, sxy = (np.array(below.sxx) - np.array(below.syy))/2, np.array(below.sxy)
    k = min((np.sqrt((half + c)**2 + sxy**2)).max() for c in -np.linspace(0, 1, 2001)*half.max())
    p0 = below.solution.max_pressure
    close(k, p0/4, 5e-3)  # the largest orthogonal shear


if __name__ == "__main__":
    raise SystemExit(run(globals()))
