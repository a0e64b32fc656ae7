"""Sentences on signs, in the pages and in help, against torques, forces and speeds that the program computes."""
import subprocess

import numpy as np
import rollbem
from printed import close, printed, run, value

STEEL = dict(support="halfplane", gap="parabola", young=210000, poisson=0.3, mu=0.3, radius=500, radius_b=300, load=1000)


def rolls(**options):
    s = rollbem.solve(**{"similar": True, **STEEL, "formulation": "steady", **options})
    return s, np.sign(s.creepage), np.sign(s.tangential_load), np.sign(s.torque_a), np.sign(s.torque_b)


def says(command, text):
    words = subprocess.run(["build/rollbem", *command.split()], capture_output=True, text=True).stdout
    assert " ".join(text.split()) in " ".join(words.split()), f"rollbem {command} does not say {text!r}"


def tag_braked():
    """xi > 0: A slides towards +x, is pulled to -x, and its axle brakes while that of B drives."""
    printed("cookbook.md", "Creepage xi > 0 means a braked wheel: the friction on the wheel points to -x, and Q < 0")
    printed("getting-started.md", "Creepage > 0 means a braked wheel: the friction on A points to -x, and Q")
    printed("faq.md", "At xi > 0 the wheel A is braked: the surface of A slides towards +x over the ground, the friction on A points to -x, and Q < 0")
    printed("theory.md", "xi > 0: A's surface slides towards +x over B, a braked wheel")
    printed("derivatives.md", "a braked wheel has xi > 0 and Q < 0")
    printed("contact.md", "CKSI < 0 is a driven wheel, with FX > 0")
    printed("glossary.md", "braked: `--creep` > 0, the friction on A points backwards, Q < 0; driven (tractive): `--creep` < 0, Q > 0")
    printed("tables.md", "> 0 where an axle drives in the direction in which its body rolls, < 0 where it brakes")
    printed("course/kinematics.md", "The wheel that drives turns faster than it rolls, whichever of the two it is")
    printed("course/kinematics.md", "The first one brakes (xi > 0, Q < 0), the second one rolls freely, the third one drives")
    says("--help", "A's surface slides towards +x over the ground (a braked wheel) and the friction q on A points to -x, Q < 0")
    says("--help", "> 0: braked wheel, Q < 0; 2: locked wheel")
    says("fit --help", "braked wheel has xi > 0 and Q < 0")
    for xi in (1e-4, 5e-4, 5e-3):
        braked, driven = rolls(creep=xi), rolls(creep=-xi)
        assert braked[1:] == (1, -1, -1, 1) and driven[1:] == (-1, 1, 1, -1)
        slides = np.array(braked[0].zone) > 1
        assert (np.array(braked[0].slip)[slides] > 0).all() and (np.array(braked[0].q)[slides] < 0).all()


def tag_force():
    """The friction on A drives or brakes; a roll that the other one drives has a torque below zero."""
    printed("cookbook.md", "an axle drives if its torque is > 0. The next command gives the force as a part of mu P; with Q < 0 the roll B drives A")
    printed("cookbook.md", "it is braked where xi exceeds the creepage of free rolling")
    says("--help", "Q and --force are the friction on A")
    assert rolls(force=-100)[1:] == (1, -1, -1, 1) and rolls(force=100)[1:] == (-1, 1, 1, -1)
    roll = [rollbem.solve("examples/roll/case.ini", force=f) for f in (-1, 0, 1)]
    assert roll[0].torque_a < 0 < roll[0].torque_b and roll[2].torque_b < 0 < roll[2].torque_a
    assert roll[0].creepage > roll[1].creepage > roll[2].creepage


def tag_bond():
    """Torques of a covered roll, and what pulls at its bond, with the radius of the bond."""
    torques = printed("cookbook.md", "`torque_a` = M + Q R_A and `torque_b` = M - Q R_B").replace("`", "").split(" and ")
    slope, tension, shear = (printed("cookbook.md", text) for text in ("t = x/138", "its tension is syy - 2 t sxy", "its shear sxy + t (syy - sxx)"))
    case = rollbem.Case("examples/roll/case.ini", force_ratio=-0.3)
    s = rollbem.solve(case)
    for text, torque, R in zip(torques, (s.torque_a, s.torque_b), (150, 100)):
        close(value(text.split("=")[1].replace("Q R", "Q*R"), M=s.resistance_moment, Q=s.tangential_load, R_A=R, R_B=R), torque, 2e-3)
    x = np.array([-8.0, 5.0, 8.0])
    at = rollbem.stress(case, points=np.column_stack([x, 150 - np.sqrt(138**2 - x*x) - 0.02]))
    sxx, syy, sxy = (np.ravel(part) for part in (at.sxx, at.syy, at.sxy))
    n, along = np.array([x, -np.sqrt(138**2 - x*x)])/138, np.array([np.sqrt(138**2 - x*x), x])/138
    t = value(slope.split("=")[1], x=x)
    names = dict(sxx=sxx, syy=syy, sxy=sxy, t=t)
    size = abs(np.array([sxx, syy, sxy])).max()
    normal = sxx*n[0]**2 + syy*n[1]**2 + 2*sxy*n[0]*n[1]
    tangential = sxx*n[0]*along[0] + syy*n[1]*along[1] + sxy*(n[0]*along[1] + n[1]*along[0])
    assert abs(value(tension.split("is ")[1].replace("2 t sxy", "2*t*sxy"), **names) - normal).max() < 2*(t*t).max()*size
    assert abs(value(shear.split("shear ")[1].replace("t (", "t*("), **names) + tangential).max() < 2*(t*t).max()*size


def tag_speeds():
    """V (1 - xi/2) and V (1 + xi/2): the surface of the slower roll passes the contact slower."""
    printed("cookbook.md", "xi > 0 means that A is the slower one: its surface passes the nip at V (1 - xi/2), that of B at V (1 + xi/2)")
    printed("faq.md", "V (1 - xi/2) and V (1 + xi/2): a locked wheel has xi = 2, and V is half its forward speed")
    printed("glossary.md", "a faster A has xi < 0")
    V, xi = 2.0, 0.3
    a, b = V*(1 - xi/2), V*(1 + xi/2)
    assert a < b and abs((b - a)/V - xi) < 1e-15 and abs(V*(1 - 2/2)) == 0 and V*(1 + 2/2) == 2*V
    # A as the faster roll of two is pulled back by B, and drives
    assert rolls(creep=-xi/100)[2:] == (1, 1, -1)


def tag_free():
    """Who turns faster where no force acts: the softer one of two cylinders, not a covered roll, not a rim."""
    printed("theory-solvers.md", "With the softer cylinder as A, xi < 0")
    printed("course/08-bodies.md", "The wheel of the softer material turns faster: xi < 0")
    printed("course/solutions/08-bodies.md", "now the harder wheel is A, and it turns slower")
    printed("cookbook.md", "xi0 > 0: without any force the wheel turns as a braked wheel would on half-planes")
    printed("cookbook.md", "xi = 0.0373, that is, the surface is 3.7 % faster in the nip than outside it")
    soft, steel = dict(young=60260, poisson=0.31), dict(young=209920, poisson=0.28)
    pair = dict(support="halfplane", gap="parabola", radius=50, radius_b=50, load=500, mu=0.3, formulation="steady", force=0)
    own = lambda of: {f"{name}_b": x for name, x in of.items()}
    assert rollbem.solve(**pair, **soft, **own(steel)).free_creepage < 0 < rollbem.solve(**pair, **steel, **own(soft)).free_creepage
    assert rollbem.solve(support="hub", similar=True, hub_ratio=0.9, gap="exact", young=210000, poisson=0.3, radius=50, load=500, mu=0.3,
                         formulation="steady", creep=0.001).free_creepage > 0
    roll = lambda **options: rollbem.solve("examples/roll/case.ini", force=0, **options).free_creepage
    assert abs(roll() - 0.0373) < 5e-5
    printed("cookbook.md", "Compressible covers (foam) do the opposite, here below nu = 0.29")
    printed("cookbook.md", "nu = 0.41 at 2 N/mm")
    assert roll(poisson=0.285) < 0 < roll(poisson=0.295) and roll(poisson=0.405, load=2) < 0 < roll(poisson=0.415, load=2)


def tag_beside():
    """Where friction pulls at the surfaces, and where a driven wheel opens a crack."""
    printed("theory-bodies.md", "friction q > 0 pulls at the -x side of A and at the +x side of B")
    printed("crack.md", "A driven wheel (friction on A forwards, on B backwards) opens the mouth before the wheel arrives")
    printed("course/11-breaks.md", "The wheel pulls the mouth of the crack open before it arrives")
    case = rollbem.Case(similar=True, **{**STEEL, "radius_b": "plane"}, formulation="steady", creep_ratio=-5)
    a = rollbem.solve(case).contact_to
    behind, before = -1.05*a, 1.05*a
    in_a = rollbem.stress(case, points=[(behind, 0.02*a), (before, 0.02*a)]).sxx
    in_b = rollbem.stress(case, points=[(behind, -0.02*a), (before, -0.02*a)], body="b").sxx
    assert in_a[0] > 0 > in_a[1] and in_b[0] < 0 < in_b[1]  # Q > 0: behind the contact in A, before it in B


if __name__ == "__main__":
    raise SystemExit(run(globals()))
