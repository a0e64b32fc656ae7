"""Rolling contact with friction in two dimensions, by boundary elements.

>>> import rollbem
>>> s = rollbem.solve(mu=0.3, creep=0.1)
>>> s.tangential_load, s.p.max(), s.zone

``solve``, ``curve``, ``history``, ``stress``, ``wear``, ``sweep``, ``crack``, ``derivatives``,
``fit`` and ``design`` take the options of the program (``help(rollbem.solve)`` lists them, ``_``
for ``-``); ``lcp``, ``game`` and ``friction`` take matrices; ``check``, ``contact``, ``verify``,
``examples``, ``rubber`` and ``prony`` ask the program itself.
Units are mm, N/mm (per length of the axis) and MPa; with ``units="si"`` or ``"inch"`` all numbers, given
and found, are in m, N/m, Pa or inch, lbf/inch, psi. Creepage > 0 brakes A, then Q < 0.
"""

from . import _library, pictures  # _library first: see _kernels
from ._case import (Case, Curve, Curves, Derivatives, Extremum, History, Solution, Stress, Sweep, Wear, curve, history, solve,
                    stress, sweep, wear)
from ._inverse import (Crack, Design, Fit, Parameter, crack, curve_derivatives, derivatives, design, fit,
                       history_derivatives, tolerances)
from ._library import (OPTIONS, RESULTS, VERSION as __version__, Error, InvalidInput, MissingFile,
                       Note, OutOfMemory, Unsolved)
from ._page import page
from ._problems import Answer, Complementarity, Friction, Game, Solutions, friction, game, lcp
from ._program import (Check, ContactCases, Hardness, Prony, Reference, References, check, contact, examples, prony,
                       rubber, verify)

__all__ = ["Answer", "Case", "Check", "Complementarity", "ContactCases", "Crack", "Curve", "Curves", "Derivatives",
           "Design",
           "Error", "Extremum", "Fit", "Friction", "Game", "Hardness", "History", "InvalidInput", "MissingFile", "Note",
           "OPTIONS", "OutOfMemory", "Parameter", "Prony", "RESULTS", "Reference", "References", "Solution", "Solutions",
           "Stress", "Sweep",
           "Unsolved", "Wear", "check", "contact", "crack", "curve", "curve_derivatives", "derivatives",
           "design", "examples", "fit", "friction", "game", "history", "history_derivatives",
           "lcp", "page", "pictures", "prony", "rubber", "solve", "stress", "sweep", "tolerances", "verify", "wear"]
