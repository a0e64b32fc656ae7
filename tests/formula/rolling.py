"""docs/theory-rolling.md: second-order slip, heat, wear, third bodies, friction laws."""
import tempfile

import numpy as np
import rollbem
from scipy import integrate, special
from printed import close, printed, run, value

PAGE = "theory-rolling.md"


def tag_K7():
    text = printed(PAGE, r"\frac{1-t}{4}w_{i-1} + \frac{3+3t}{4}w_i - \frac{5+3t}{4}w_{i+1} + \frac{1+t}{4}w_{i+2}")
    for k, name in [("{i-1}", "w"), ("i ", "v "), ("{i+1}", "y"), ("{i+2}", "z")]:
        text = text.replace("w_" + k, " " + name + " ")
    t = value(printed(PAGE, "t = 0.0740956").split("=")[1])
    A = lambda f, t=t: value(text, t=t, w=f(-1.0), v=f(0.0), y=f(1.0), z=f(2.0))
    close([A(lambda x: 1 + 0*x), A(lambda x: x), A(lambda x: x**2) + 1], [0, -1, 1])  # second order at x_i
    printed(PAGE, r"\eta = -\frac{1}{4\pi}\int_0^\pi \frac{\ln\left(|\hat A|\,\hat F\right)}{\sin^2(\theta/2)}\,d\theta "
            r"\qquad (\text{upstream: with } 2\sin(\theta/2) \text{ for } \hat A, \text{ and } \tfrac14 \text{ more})")
    def F(th):  # the symbol of -ln abs(x - s) over elements: that of the transform pi/abs(k), wrapped
        k = th + 2*np.pi*np.arange(-200, 201)
        return (np.pi/abs(k)*np.sin(k/2)/(k/2)).sum()
    def eta(t):
        hat = lambda th: 2*np.sin(th/2) if t is None else abs((1 - t)/4*np.exp(-1j*th) + (3 + 3*t)/4 - (5 + 3*t)/4*np.exp(1j*th) + (1 + t)/4*np.exp(2j*th))
        return -integrate.quad(lambda th: np.log(hat(th)*F(th)/np.pi)/np.sin(th/2)**2, 1e-4, np.pi, limit=200)[0]/(4*np.pi)
    printed(PAGE, "| operator | upstream | t = -0.5 | 0 | 0.0740956 | 1 |")
    row = printed(PAGE, "| eta | 0.325347 | 0.142334 | 0.016330 | 0 | -0.174653 |").split("|")[2:7]
    close([eta(None) + 1/4, eta(-0.5), eta(0), eta(t), eta(1)], [float(x) for x in row], 2e-3)


def tag_T1():
    G = printed(PAGE, r"z\,e^z\left[K_0|z| + \operatorname{sgn}(z)\,K_1|z|\right] - 1")
    G = G.replace("|z|", "(abs(z))")
    theta = printed(PAGE, r"\frac{G(Pd_2) - G(Pd_1)}{\pi k P}").replace("Pd_2", "P*u").replace("Pd_1", "P*v")
    P, k = 2.0, 0.05
    for lo, hi in [(0.3, 0.9), (-0.8, -0.2)]:
        got = value(theta, G=lambda z: value(G, z=z, e=np.e), P=P, k=k, u=hi, v=lo)
        line = integrate.quad(lambda r: np.exp(P*r)*special.k0(abs(P*r))/(np.pi*k), lo, hi)[0]
        close(got, line, 1e-8)


def tag_T2():
    largest = printed(PAGE, "2.1883067 H_0 sqrt(a)/((e_1 + e_2) sqrt(pi V))")
    x = np.linspace(0.3, 1, 200) - 0.3  # -0.65223 a is among the depths into the contact
    rise = [integrate.quad(lambda u: 2*np.sqrt(max(1 - (at + u*u)**2, 0)), 0, np.sqrt(1 - at))[0] for at in np.linspace(-0.66, -0.64, 21)]
    close(max(rise)*1/np.sqrt(np.pi), value(largest, H_0=1, a=1, e_1=0.5, e_2=0.5, V=1), 1e-6)


def tag_W1():
    text = printed(PAGE, "4.66 h/(pi E\\*)")
    s = rollbem.solve(support="halfplane", young=1.0, poisson=0, radius=100, gap="parabola", half_width=1, mu=0, mesh="uniform",
                      zone=1.3, contact_elements=200)
    F = np.array(s.F)[:200, :200]
    close(2*np.linalg.eigvalsh((F + F.T)/2)[0], value(text, h=s.h[0], Es=1.0), 2e-3)


def tag_W1_gap():
    """An implicit step of wear is a contact with K dS on the diagonal; the gap of a tilted body."""
    names = lambda s, **more: dict(g=np.array(s.x)**2/200, g_0=np.array(s.x)**2/200, K=1e-6, dS=1.0, p=np.array(s.p), x=np.array(s.x),
                                   delta=s.approach, **more)
    case = dict(similar=True, support="halfplane", young=210000, poisson=0.3, radius=100, gap="parabola", load=500, mu=0, contact_elements=40, mesh="uniform")
    text = printed(PAGE, "y = g + K p dS - delta + F_NN p + F_NT q >= 0").split("=")[1].rstrip(" >")
    s = rollbem.solve(interlayer_normal=1e-6, **case)
    own = np.array(rollbem.solve(**case, zone=s.h.sum()).F)
    n = len(s.p)
    close(value(text.replace("F_NN p + F_NT q", "w"), w=np.array(s.un) - 1e-6*np.array(s.p), **names(s)), s.gap, 1e-6)
    assert own.shape[1] >= n
    tilted = rollbem.solve(tilt=2e-3, **case)
    text = printed(PAGE, "has the gap g_0 - delta - X x: X > 0").split("gap ")[1].split(":")[0]
    close(value(text, X=2e-3, **names(tilted)) + np.array(tilted.un), tilted.gap, 1e-6)


def tag_W4():
    gamma = value(printed(PAGE, "gamma = 1 - 1/sqrt(2)").split("=")[1])
    text = printed(PAGE, r"(1 - \gamma) k p_1")
    printed(PAGE, r"p_1: g + \gamma k p_1, \quad g_2 = g + (1 - \gamma) k p_1, \quad p_2: g_2 + \gamma k p_2, \quad g \leftarrow g_2 + \gamma k p_2")
    def step(g, k):  # p = -g: g' = -g
        p_1 = -g/(1 + gamma*k)
        g_2 = g + value(text, gamma=gamma, k=k, p_1=p_1)
        return g_2 + gamma*k*(-g_2/(1 + gamma*k))
    errors = [abs(step(1.0, k) - np.exp(-k)) for k in (0.02, 0.01)]
    close(errors[0]/errors[1], 8, 0.05)


def tag_I2_Y2():
    text = printed(PAGE, "1 - (1 - s)^3")
    x = np.linspace(-1, 1, 200001)
    q = np.minimum(0.4*2*(1 - x)*0.5, (1 - x*x)*0.5)  # s = 0.4: xi (a - x)/L_T up to mu p
    close(value(text, s=0.4), q.mean()*2/(2/3), 1e-5)
    first, second = printed(PAGE, "abs(q) = abs(xi) s/L_T up to tau_c").split("= ")[1].split(" up")[0], printed(PAGE, "tau_c + (s - s_1) abs(xi)/(L_T + 1/k)")
    p = printed(PAGE, "under p = (a^2 - x^2)/(2R L_N), s = a - x").split("=")[1].split(",")[0]
    close(value(p, a=1.0, x=0.0, R=50.0, L_N=1e-4), 100)
    s_1 = printed(PAGE, "s_1 = tau_c L_T/abs(xi)").split("=")[1]
    names = dict(xi=1e-3, L_T=2e-5, tau_c=20.0, k=3e4)
    names["s_1"] = value(s_1, **names)
    close(value(first, s=names["s_1"], **names), value(second, s=names["s_1"], **names))


def tag_F6():
    text = printed(PAGE, r"1 - c^2 + 2 \sqrt{\frac{2 c (\mu_s/\mu - 1) d \sqrt{1 - c^2}}{\pi}}").replace(r"\sqrt", "sqrt").replace(r"\mu_s", "m").replace(r"\mu", "u")
    row = printed(PAGE, "| by the formula | 1.0162 | 1.0407 | 1.0747 | 1.1860 |").split("|")[2:6]
    c = np.linspace(1e-6, 1 - 1e-6, 20001)
    close([value(text, c=c, m=1.5, u=1.0, d=d).max() for d in (0.005, 0.02, 0.05, 0.2)], [float(x) for x in row], 5e-5)


def tag_F1_F2_F3():
    printed(PAGE, "mu_s = mu + m1 + m2"), printed(PAGE, "G = (mu_s - mu) p d")
    for text in [r"\text{exponential} \quad & \mu(v) = \mu + m_1 2^{-v/s_1} + m_2 2^{-v/s_2}",
                 r"\text{rational} \quad & \mu(v) = \mu + \frac{m_1}{1 + v/s_1} + \frac{m_2}{1 + (v/s_2)^2}",
                 r"\text{linear} \quad & \mu(v) = \mu + m_1\max\left(0,\, 1 - \frac{v}{2s_1}\right) + m_2\max\left(0,\, 1 - \frac{v}{2s_2}\right)"]:
        at = [value(printed(PAGE, text).split("=")[1], mu=0.2, m_1=0.1, m_2=0.04, s_1=8.0, s_2=8.0, v=v) for v in (0.0, 8.0)]
        close(at, [0.34, 0.27])  # a slip scale is where half of the fall is lost
    text = printed(PAGE, "mu(v_i) + (mu_before - mu(v_i)) exp(-max(v_i, s0) c_i/(V d))").replace("mu(v_i)", "m")
    names = dict(m=0.2, mu_before=0.3, v_i=5.0, s0=1.0, c_i=0.01, V=100.0, d=1e-3)
    rate = printed(PAGE, "-(max(v, s0)/d)(mu - mu(v))").replace("mu(v)", "m")
    mu, steps = 0.3, 500
    for _ in range(steps):
        mu += value(rate, v=5.0, s0=1.0, d=1e-3, mu=mu, m=0.2)*names["c_i"]/names["V"]/steps
    close(value(text, **names), mu, 1e-3)
    s = rollbem.solve(support="halfplane", similar=True, half_width=1, mu=0.3, mesh="uniform", contact_elements=20)
    Es, F = 94500/0.99/2, np.array(s.F)
    close((F[21, 20] - F[22, 20])/s.h[0], value(printed(PAGE, "(3 ln 3/pi)").replace("3 ln 3", "3*ln(3)"))/Es, 1e-6)
    printed(PAGE, "= 1.0491/E\\*")
    close(value("(3*ln(3)/pi)"), 1.0491, 5e-5)


def tag_I1_Y1():
    text = printed(PAGE, r"\frac{1-t}{4}w_{i-1} + \frac{3+3t}{4}w_i - \frac{5+3t}{4}w_{i+1} + \frac{1+t}{4}w_{i+2}")
    for k, name in [("{i-1}", "w"), ("i ", "v "), ("{i+1}", "y"), ("{i+2}", "z")]:
        text = text.replace("w_" + k, " " + name + " ")
    A_1 = [value(text, t=1.0, **dict(zip("wvyz", row))) for row in np.eye(4)]
    close(A_1, [value(x) for x in printed(PAGE, "A_1 = (0, 3/2, -2, 1/2)").split("(")[1].rstrip(")").split(",")])
    hardens = printed(PAGE, "u_i = (4 u_(i+1) - u_(i+2) + 2 abs(lambda_p,i))/3").split("=")[1]
    for old, new in [("u_(i+1)", "y"), ("u_(i+2)", "z"), ("lambda_p,i", "l")]:
        hardens = hardens.replace(old, new)
    y, z, l = 0.7, 1.1, -0.4
    close(A_1[1]*value(hardens, y=y, z=z, l=l) + A_1[2]*y + A_1[3]*z, abs(l))  # A_1 u = abs(lambda_p)


def tag_I2():
    load = value(printed(PAGE, "P = 2 a^3/(3R L_N)").split("=")[1], a=1.3, R=50.0, L_N=1e-4)
    p = printed(PAGE, "p = (a^2 - x^2)/(2R L_N), and with").split("=")[1].split(",")[0]
    close(integrate.quad(lambda x: value(p, a=1.3, x=x, R=50.0, L_N=1e-4), -1.3, 1.3)[0], load)
    s, stick = printed(PAGE, "s = xi R L_N/(mu L_T a)").split("=")[1], printed(PAGE, "stick from the leading edge to -a + 2 a s").split("to ")[1]
    names = dict(xi=1e-3, R=50.0, L_N=1e-4, L_T=8e-5, mu=0.3, a=1.3)
    x = value(stick, s=value(s, **names), **names)  # there xi (a - x)/L_T = mu p
    close(names["xi"]*(1.3 - x)/8e-5, 0.3*value(p, x=x, **names))


def tag_T2_contact():
    T_m = printed(PAGE, "T_m = (e_1 T_1 + e_2 T_2)/(e_1 + e_2)").split("=")[1]
    behind = printed(PAGE, "T_1 + (T_m - T_1) (2/pi) asin sqrt(2a/(a + X))").replace("asin sqrt(2a/(a + X))", "asin(sqrt(2*a/(a + X)))")
    assert value(printed(PAGE, "V_A = V (1 - xi/2)").split("=")[1], V=3.0, xi=2.0) == 0
    printed(PAGE, "V_B = V (1 + xi/2)"), printed(PAGE, "a body takes the fraction e/(e_1 + e_2)"), printed(PAGE, "For H = H_0 sqrt(1 - x^2/a^2)"), printed(PAGE, "T_A + K_A H_A = T_B + K_B (H - H_A)"), printed(PAGE, "e = sqrt(k c abs(V_A)/V)"), printed(PAGE, "G(z) = sqrt(2 pi z)")
    names = dict(e_1=3.0, e_2=1.0, T_1=10.0, T_2=90.0)
    names["T_m"] = value(T_m, **names)
    close(3*(names["T_m"] - 10), 90 - names["T_m"])  # what one gives the other takes: e (T - T_m)
    for X in (1.5, 4.0):  # flux 1/sqrt(pi t) until 2a, none behind
        kept = integrate.quad(lambda u: 2/np.sqrt(1 + X - u*u), 0, np.sqrt(2))[0]/np.pi
        close(value(behind, X=X, a=1.0, **names), 10 + (names["T_m"] - 10)*kept)
    G = lambda z: z*(special.kve(0, z) + special.kve(1, z)) - 1
    close(G(1e6), np.sqrt(2*np.pi*1e6), 2e-3)


def tag_fretted():
    p = printed(PAGE, r"p = (E\*/2R) sqrt(c^2 - x^2) + E\* (a^2 - c^2)/(4R)/sqrt(c^2 - x^2)").split("p =")[1].replace("E\\*/2R", "Es/(2*R)").replace("E\\* ", "Es*")
    depth = printed(PAGE, "(1/2R) (a^2 acosh(x/c) - x sqrt(x^2 - c^2))").replace("(1/2R) ", "(1/(2*R))*")
    middle = printed(PAGE, "p0 (1 + k^2)/(2k)")
    names = dict(Es=2.0, R=50.0, a=1.0, c=value(printed(PAGE, "c = a sqrt(1 - Q/(mu P))").split("=")[1], a=1.0, Q=0.64, mu=1.0, P=1.0))
    c = names["c"]
    t = np.pi*(np.arange(4000) + 0.5)/4000
    at = -c*np.cos(t)
    weighed = value(p, x=at, **names)*c*np.sin(t)*np.pi/4000
    close(weighed.sum(), np.pi*2*1/(4*50), 1e-6)
    close(value(p, x=0.0, **names), value(middle, p0=2.0/(2*50), k=c), 1e-9)
    for x in (0.7, 0.9):  # it just touches from c to a: g' + worn' + w' = 0
        w = -2/(np.pi*2.0)*(weighed/(x - at)).sum()
        worn = (value(depth, x=x + 1e-6, **names) - value(depth, x=x - 1e-6, **names))/2e-6
        close(x/50 + w, -worn, 1e-4)


def tag_U1_U2_power():
    s = rollbem.solve(similar=True, support="halfplane", gap="parabola", young=210000, poisson=0.3, radius=100, half_width=1, mu=0.4,
                      formulation="steady", bulk_stress=200, creep=3e-3)
    names = dict(xi=s.creepage, eps=s.free_creepage, Q=s.tangential_load, M=s.resistance_moment, R=100.0)
    left, right = printed(PAGE, "-(xi - eps) Q + M/R = D").split("=")
    close(value(left, **names), s.dissipation, 2e-3)
    bound, r = printed(PAGE, "abs(X)/(mu p0) <= 4 (1 - sqrt(1-abs(r)))").split("<= ")[1], 0.6
    X = value(bound, r=r)  # in mu p0: abs(x_0) + c = a
    close(X/4 + np.sqrt(1 - r), 1)


def tag_U3_edges():
    first = printed(PAGE, r"\int_l^r \frac{g'(x)\,dx}{\sqrt{(x-l)(r-x)}} = 0")
    second = printed(PAGE, r"\frac{E^*}{2} \int_l^r \frac{g'(x) (x-m)\,dx}{\sqrt{(x-l)(r-x)}} = P")
    assert first and second
    b, R, Es, a = 0.5, 50.0, 2.0, 1.0
    t = np.pi*(np.arange(4000) + 0.5)/4000
    x = -a*np.cos(t)
    P = Es/2*(np.maximum(abs(x) - b, 0)*abs(x)/R).mean()*np.pi
    table = np.linspace(-2, 2, 4001)
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as gap:
        gap.write("# x gap\n" + "\n".join(f"{u:.9g} {max(abs(u) - b, 0)**2/(2*R):.12g}" for u in table) + "\n"), gap.flush()
        s = rollbem.solve(similar=True, support="halfplane", young=4.0, poisson=0, gap=gap.name, load=P, mu=0, contact_elements=200)
    close(s.contact_to, a, 3e-3)


def tag_E3():
    text = printed(PAGE, r"\frac{\lvert Q \rvert}{\mu W} = 1 + \tfrac{3}{2} \left[ s \arccos s - t + \tfrac{1}{3} t^3 \right]").split("=")[1].replace(r"\tfrac{3}{2} \left[ s \arccos s", r"(3/2)*\left[ s*acos(s)").replace(r"\tfrac{1}{3}", "(1/3)")
    printed(PAGE, r"s = abs(xi) R_eq/(mu a) < 1")
    for s in (0.1, 0.5, 0.9):  # strips: a sin(phi), p_0 sin(phi)
        of = lambda phi: np.sin(phi)**3*(1 - max(0, 1 - s/np.sin(phi))**2)
        strips = integrate.quad(of, 0, np.pi, limit=200, points=[np.arcsin(s), np.pi - np.arcsin(s)])[0]/(4/3)
        close(value(text, s=s, t=value(printed(PAGE, r"t = \sqrt{1-s^2}").split("=")[1], s=s), acos=np.arccos), strips, 1e-6)
    C_11 = value(printed(PAGE, "C_11 = pi^2/(4(1-nu))").split("=")[1], nu=0.25)
    slope = 3*np.pi/4*(2*np.pi/3)/2/(1 - 0.25)  # of mu W s: W = 2 pi a b p_0/3, R_eq = E* a/(2 p_0), E* = G/(1 - nu)
    close(C_11, slope)


def tag_P1():
    printed(PAGE, r"w_N(x) = -\frac{2}{\pi E^*} \int_0^L p(s) \ln\left|2 \sin\frac{\pi (x-s)}{L}\right| ds")
    L, x, m = 3.0, 0.8, np.arange(-200000, 200001)
    sines = lambda x: np.log(abs(2*np.sin(np.pi*x/L)))
    close(np.log(abs(x - m*L)/abs(1.3 - m*L)).sum(), sines(x) - sines(1.3), 1e-4)
    saw = printed(PAGE, r"1 - \frac{2u}{L}")
    close(value(saw, u=x, L=L), 2*sum(np.sin(2*np.pi*k*x/L)/(np.pi*k) for k in range(1, 200001)), 1e-4)


if __name__ == "__main__":
    raise SystemExit(run(globals()))
