"""Pictures in the style of the program's, by matplotlib; each returns its figure."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy as np

from ._library import CRACK_OPTIONS, OPTIONS, RESULTS, InvalidInput
from ._values import guess

if TYPE_CHECKING:
    from ._case import Curve, History, Solution, Stress, Sweep, Wear

PRESSURE, FRICTION, BOUND, SLIP = "#1f4e79", "#c0392b", "#7a7a7a", "#6c3483"
CURVES = ["#1f4e79", "#c0392b", "#b9770e", "#6c3483", "#117864", "#5d6d7e", "#7b241c", "#2e86c1"]
ZONES = {0: ("separated", "#f3f3f3"), 1: ("stick", "#d9ebe2"), 2: ("slip →", "#fae3d6"), 3: ("← slip", "#ecdff1"),
         4: ("yield →", "#f3ecd0"), 5: ("← yield", "#f6dde6")}
STYLE = {"axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "#444444",
         "axes.linewidth": 0.7, "lines.linewidth": 1.8, "font.size": 9.5, "legend.frameon": False,
         "axes.titlesize": 10, "svg.fonttype": "none"}


def _figure(figure: Any, rows: int = 1, ax: Any = None, **keywords: Any) -> Any:
    """The figure and its axes: those of the caller, of a figure that has as many, or new ones.

    Of several rows the caller may give the axes of the first alone: the others are None then.
    """
    from matplotlib import pyplot

    if ax is not None:
        given = list(np.ravel(np.asarray(ax, dtype=object)))
        if len(given) > rows or not all(hasattr(axes, "plot") for axes in given):
            raise InvalidInput(f"ax=: expected axes of matplotlib, {'one' if rows == 1 else f'one or {rows}'}, got {ax!r}")
        return given[0].figure, [*given, *[None] * (rows - len(given))]
    with pyplot.rc_context(STYLE):
        figure = figure or pyplot.figure(figsize=(6.4, 4.4), constrained_layout=True)
        there = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
        if len(there) == rows and all(hasattr(axes, "rollbem") for axes in there):
            return figure, there  # a second case in the picture of the first
        made = np.atleast_1d(figure.subplots(rows, 1, **keywords))
        for axes in made:
            axes.rollbem = True
        return figure, made


def _named_line(axes: Any, label: "Optional[str]", what: "Optional[str]") -> "Optional[str]":
    """What stands in the legend: the case behind the column, and nothing twice."""
    text = what if label is None or what is None else f"{what}, {label}"
    known = {line.get_label() for line in axes.get_lines()}
    return None if text in known else text


def _again(axes: Any) -> bool:
    """Whether the axes have lines of another case."""
    return any(not line.get_label().startswith("_") for line in axes.get_lines())


def _stress_unit(of: Any, largest: float) -> "tuple[float, str]":
    return (1000.0, "GPa") if of._in("MPa") == "MPa" and largest >= 1e4 else (1.0, of._in("MPa"))


def _zones(axes: Any, solution: "Solution", labelled: bool) -> None:
    left, right = solution.x - solution.h / 2, solution.x + solution.h / 2
    low, high = axes.get_xlim()
    for zone, run in groupby(range(len(left)), key=lambda i: solution.zone[i]):
        run = list(run)
        name, colour = ZONES[zone]
        start, stop = max(left[run[0]], low), min(right[run[-1]], high)
        if stop <= start:
            continue
        axes.axvspan(start, stop, color=colour, linewidth=0, zorder=0)
        if labelled and stop - start > 0.09 * (high - low):
            axes.text((start + stop) / 2, 0.97, name, transform=axes.get_xaxis_transform(),
                      ha="center", va="top", color="#555555", fontsize=8)


def _limits(solution: "Solution") -> "tuple[float, float]":
    low, high = solution.x[0] - solution.h[0] / 2, solution.x[-1] + solution.h[-1] / 2
    if solution.contact:
        margin = 0.15 * (solution.contact_to - solution.contact_from)
        low, high = max(low, solution.contact_from - margin), min(high, solution.contact_to + margin)
    return low, high


def bounds(solution: "Solution") -> Any:
    """What friction may be at each element: mu p by the friction law, or the yield stress of the interface."""
    s, columns = solution, solution._arrays
    bound = columns.get("mu", s.value("mu")) * s.p
    if "plastic" in columns:
        yields = s.value("yield-stress") + s.value("hardening") * columns["plastic"]
        bound = bound.clip(max=yields.clip(min=0))
    return bound


class _InHalfWidths:
    """A solution whose places along x are counted in its half-width."""

    def __init__(self, solution: "Solution") -> None:
        if not solution.half_width > 0 or not solution.max_pressure > 0:
            raise InvalidInput("dimensionless=: nothing touches, so there is neither a nor p0")
        self._of = solution
        for name in ("x", "h", "contact_from", "contact_to"):
            setattr(self, name, getattr(solution, name) / solution.half_width)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._of, name)


def tractions(solution: "Solution", figure: Any = None, ax: Any = None, label: "Optional[str]" = None,
              dimensionless: bool = False) -> Any:
    """Pressure, friction between its bounds, zones, and the slip below; in units, or x/a, p/p0 and q/(mu p0).

    A second case in the same axes is dashed, with zones of its own left out.
    """
    s: Any = _InHalfWidths(solution) if dimensionless else solution
    mu, bound = solution.value("mu"), bounds(solution)
    figure, (upper, lower) = _figure(figure, 2, ax, sharex=True, gridspec_kw={"height_ratios": [2, 1]})
    again = _again(upper)
    unit, unit_name = _stress_unit(s, s.max_pressure)
    if again and not dimensionless:  # in the unit of the first
        unit, unit_name = getattr(upper, "rollbem_unit", (unit, unit_name))
    upper.rollbem_unit = (unit, unit_name)
    of_friction = unit
    if dimensionless:
        unit, of_friction = s.max_pressure, (mu or 1.0) * s.max_pressure
    low, high = _limits(s)
    below = max(1.2 * min(mu, 1.0) * s.max_pressure / of_friction, 0.08 * s.max_pressure / unit)
    bottom, top = -below, 1.14 * s.max_pressure / unit + 0.13 * below
    if again:
        low, high = min(low, upper.get_xlim()[0]), max(high, upper.get_xlim()[1])
        bottom, top = min(bottom, upper.get_ylim()[0]), max(top, upper.get_ylim()[1])
    upper.set_xlim(low, high)
    for axes in (upper, lower) if not again else ():
        if axes is not None:
            _zones(axes, s, labelled=axes is upper)
            axes.axhline(0, color="#999999", linewidth=0.6)
    dashes = "--" if again else "-"
    for sign, text in ((1, "±μp"), (-1, None)):
        upper.plot(s.x, sign * bound / of_friction, "--", color=BOUND, linewidth=0.9, label=_named_line(upper, None, text))
    upper.plot(s.x, s.p / unit, dashes, color=PRESSURE, label=_named_line(upper, label, "pressure p"))
    upper.plot(s.x, s.q / of_friction, dashes, color=FRICTION, label=_named_line(upper, label, "friction q"))
    upper.set_ylim(bottom, top)
    upper.set_ylabel(f"traction [{unit_name}]" if not dimensionless else
                     "$p/p_0$,  $q/(\\mu p_0)$" if mu else "$p/p_0$,  $q/p_0$")
    if not again and ax is None:
        upper.set_title(f"{s.formulation} contact: μ = {mu:g}, P = {s.normal_load:.5g} {s._in('N/mm')}, "
                        f"Q = {s.tangential_load:.5g} {s._in('N/mm')}")
    elif ax is None:
        upper.set_title("")
    upper.legend(loc="upper right", bbox_to_anchor=(1.0, 0.93), fontsize=8)
    along = ("x / a" if dimensionless else f"x [{s._in('mm')}]") + ("" if s.formulation == "static" else "   (rolling towards +x →)")
    if lower is None:
        upper.set_xlabel(along)
        return figure
    touches = np.asarray(s.zone) != 0 if s.contact else np.full(len(s.x), True)
    lower.plot(s.x, np.where(touches, s.slip, np.nan), dashes, color=SLIP, label=label)
    lower.set_ylabel("slip")
    lower.set_xlabel(along)
    lower.ticklabel_format(axis="y", scilimits=(-2, 3))
    return figure


def curves(of: "Sequence[Curve]", figure: Any = None, ax: Any = None, label: "Optional[str]" = None) -> Any:
    """-Q/(mu P) over the creepage ratio; of several mu, -Q/P over the creepage; over the speed the resistance to
    rolling, or where no body relaxes the friction, of a given force the creepage."""
    figure, (axes,) = _figure(figure, 1, ax)
    if of[0].over == "speed":
        for curve in of:
            name, title = _over_speed(curve, len(of) > 1, axes, label)
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_xlabel(f"speed [{of[0]._in('mm/s')}]")
        axes.set_ylabel(name)
        if ax is None:
            axes.set_title(f"{title}: P = {of[0].normal_load[-1]:.5g} {of[0]._in('N/mm')}")
        axes.legend()
        return figure
    before = sum(not line.get_label().startswith("_") and line.get_label() != "Carter" for line in axes.get_lines())
    several, over_creep = len(of) > 1, len(of) > 1 or of[0].over == "creep"
    for curve, colour in zip(of, (CURVES * (2 + (before + len(of)) // len(CURVES)))[before:]):
        scale = curve.mu if several else 1.0
        x = curve.creepage if over_creep else curve.creep_ratio
        if "force_ratio" in curve.errors:
            bar = np.abs(curve.errors["force_ratio"])
            axes.fill_between(x, scale * (-curve.force_ratio - bar), scale * (-curve.force_ratio + bar),
                              color=colour, alpha=0.25, linewidth=0, label="error")
        axes.plot(x, -scale * curve.force_ratio, color=colour,
                  label=f"μ = {curve.mu:g}" if label is None else label)
        if curve.carter_holds:
            ratio = np.linspace(curve.creep_ratio[0], curve.creep_ratio[-1], 25)
            share = np.minimum(np.abs(ratio), 1.0)
            carter = np.sign(ratio) * share * (2.0 - share)
            axes.plot(np.linspace(x[0], x[-1], 25), scale * carter, "o", markersize=4, markerfacecolor="none",
                      color="#111111", label=_named_line(axes, None, "Carter"))
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_xlabel("creepage ξ" if over_creep else "creepage ratio ξR/(μa)")
    axes.set_ylabel("braking force −Q/P" if several else "braking force −Q/(μP)")
    if ax is None:
        axes.set_title("Creep curves" if before else
                       f"Creep curve: P = {of[0].normal_load[-1]:.5g} {of[0]._in('N/mm')}, "
                       f"a = {of[0].half_width:.4g} {of[0]._in('mm')}")
    axes.legend(loc="lower right")
    return figure


def _over_speed(curve: "Curve", several: bool, axes: Any, label: "Optional[str]") -> "tuple[str, str]":
    """What the program draws over the speed, one of several mu or alone, into axes: its name, and that of the picture."""
    columns, scale = curve.columns(), curve.mu if several else 1.0
    if np.nanmax(curve.hysteresis) > 0.0:  # bodies relax
        name, y, key, title = "resistance to rolling  M/(PR)", curve.resistance_ratio, "resistance_ratio", "Rolling resistance"
    elif np.nanmax(curve.creepage) > np.nanmin(curve.creepage):  # the force is given
        name, y, key, title = "creepage ξ", curve.creepage, "creepage", "Rolling friction"
    else:
        name, y, key, title = f"braking force −Q/{'P' if several else '(μP)'}", -scale * curve.force_ratio, "force_ratio", "Rolling friction"
    if key in curve.errors:
        bar = np.abs((scale if key == "force_ratio" else 1.0) * curve.errors[key])
        axes.fill_between(curve.speed, y - bar, y + bar, alpha=0.25, linewidth=0, label="error")
    axes.plot(curve.speed, y, label=f"μ {'≤' if 'branch' in columns else '='} {curve.mu:g}" if label is None else label)
    if np.floor(np.log10(curve.speed.max())) > np.ceil(np.log10(curve.speed.min())):
        axes.set_xscale("log")
    return name, title


def history(of: "History", figure: Any = None, ax: Any = None, label: "Optional[str]" = None) -> Any:
    """Q/(mu P) and the stick over the rolled distance, or over the increments."""
    figure, (upper, lower) = _figure(figure, 2, ax, sharex=True)
    rolls = of.distance[-1] > 0
    x = of.distance if rolls else np.arange(1, len(of.residual) + 1)
    again = bool(upper.get_lines())
    dashes, along = "--" if again else "-", "rolled distance / a" if rolls else "increment"
    upper.plot(x, of.force_ratio, dashes, color=FRICTION, label=label)
    upper.set_ylabel("Q/(μP)")
    if label is not None:
        upper.legend()
    if lower is None:
        upper.set_xlabel(along)
        return figure
    for values, colour, name in ((of.stick, PRESSURE, "stick"), (of.slip, SLIP, "slip")):
        lower.step(x, values, dashes, where="mid", color=colour, label=_named_line(lower, label, name))
    lower.set_ylabel("elements")
    lower.set_xlabel(along)
    lower.legend()
    return figure


def wear(of: "Wear", figure: Any = None, ax: Any = None, label: "Optional[str]" = None) -> Any:
    """What is worn off over the way (the cycles), and the profile at the end."""
    figure, (upper, lower) = _figure(figure, 2, ax)
    again = bool(upper.get_lines())
    dashes = "--" if again else "-"
    upper.plot(of.way, of.worn, dashes, color=PRESSURE, label=label)
    length = of._in("mm")
    upper.set_ylabel(f"worn / {length}²")
    upper.set_xlabel(f"way / {length}, or cycles")
    if label is not None:
        upper.legend()
    if lower is None:
        return figure
    if of.x is not None:
        scale, depth = {"mm": (1e3, "µm"), "m": (1e6, "µm")}.get(length, (1e3, f"10⁻³ {length}"))
        lower.plot(of.x, np.asarray(of.depth) * scale, dashes, color=FRICTION)
        if not lower.yaxis_inverted():
            lower.invert_yaxis()
        lower.set_ylabel(f"depth / {depth}")
    lower.set_xlabel(f"x / {length}")
    return figure


def close(figure: Any) -> None:
    """Frees a figure that nobody shows."""
    from matplotlib import pyplot

    pyplot.close(figure)


def _last_shown(of: Any, values: np.ndarray) -> float:
    """Of a whole wheel three times the mean over its area, as in the program's pictures."""
    x, y = of.x, of.y
    cell = np.abs((x[:-1, 1:] - x[:-1, :-1]) * (y[1:, :-1] - y[:-1, :-1])
                  - (y[:-1, 1:] - y[:-1, :-1]) * (x[1:, :-1] - x[:-1, :-1]))
    there = np.isfinite(values[:-1, :-1])
    return 3.0 * float(np.average(np.abs(values[:-1, :-1][there]), weights=cell[there]))


def contours(of: "Stress", figure: Any = None, field: str = "max_shear", ax: Any = None,
             dimensionless: bool = False) -> Any:
    """Contours of a field below the contact, its largest value marked; in units, or over x/a and depth/a, in p0."""
    if field not in of._arrays or field in ("x", "y"):
        raise InvalidInput(f"field=: expected a stress, got '{field}'{guess(field, of._arrays)}")
    values = getattr(of, field)
    if values.ndim != 2 or 1 in values.shape:
        raise ValueError("contours need a stress on a grid")
    unit, label = _stress_unit(of, np.nanmax(np.abs(values)))
    length, down = 1.0, 1.0  # of the axes
    if dimensionless:
        unit, label, length = of.solution.max_pressure, "p0", of.solution.half_width
        down = -1.0 if of.body == "b" else 1.0
    x, y = of.x / length, down * of.y / length
    figure, (axes,) = _figure(figure, 1, ax)
    levels = np.linspace(0.0, _last_shown(of, values) / unit, 13) if of.whole else 12
    filled = axes.contourf(x, y, np.ma.masked_invalid(values) / unit, levels, cmap="viridis",
                           extend="both" if of.whole else "neither")
    lines = axes.contour(x, y, np.ma.masked_invalid(values) / unit, filled.levels,
                         colors="white", linewidths=0.4)
    axes.clabel(lines, fontsize=7)
    figure.colorbar(filled, ax=axes, label=f"{field.replace('_', ' ')}{' / p0' if dimensionless else f' [{label}]'}")
    if field in of.maxima:
        largest = of.maxima[field]
        axes.plot(largest.x / length, down * largest.y / length, "+", color="white", markersize=9)
        if ax is None:
            axes.set_title(f"largest {field.replace('_', ' ')} {largest.value / unit:.5g} {label} "
                           f"at ({largest.x / length:.4g}, {down * largest.y / length:.4g}) "
                           f"{'a' if dimensionless else of._in('mm')}")
    axes.set(xlabel="x / a" if dimensionless else f"x [{of._in('mm')}]", aspect="equal",
             ylabel="depth / a" if dimensionless else f"{'depth ' if of.body == 'a' else ''}y [{of._in('mm')}]")
    if (of.body == "a" or dimensionless) and not axes.yaxis_inverted():
        axes.invert_yaxis()
    return figure


def _named(name: str, unit: str) -> str:
    words = name.replace("_", " ")
    return words if unit in ("", "1", "-") else f"{words} [{unit}]"


def _axis(of: "Sweep", name: "Optional[str]", but: "Optional[str]" = None) -> "Optional[str]":
    """The option that is asked for, or else the last that has several values."""
    free = [axis for axis, values in of.axes.items() if len(values) > 1 and axis != but]
    if name is not None and name not in free:
        raise InvalidInput(f"expected an option that varies ({', '.join(free)}), got '{name}'{guess(name, free)}")
    return name or (free[-1] if free else None)


def study(of: "Sweep", show: str = "force_ratio", over: "Optional[str]" = None, family: "Optional[str]" = None,
          map: bool = False, figure: Any = None, ax: Any = None) -> Any:
    """A result over one option, a curve for each value of another; or a map over the two.

    Cases that were not solved leave holes.
    """
    results = {**RESULTS["crack"], **RESULTS["number"]}
    options = {**CRACK_OPTIONS, **OPTIONS}
    if show not in results or not hasattr(of, show):
        raise InvalidInput(f"expected a result of the study, got '{show}'{guess(show, of._arrays)}")
    over = _axis(of, over)
    if over is None:
        raise InvalidInput("no option varies")
    family = _axis(of, family, but=over)
    others = [name for name, values in of.axes.items() if len(values) > 1 and name not in (over, family)]
    if others:
        raise InvalidInput(f"{', '.join(others)}: more options vary than the picture shows")
    if map and family is None:
        raise InvalidInput("a map needs two options that vary")
    if map and any(of.axes[name].dtype.kind == "O" for name in (over, family)):
        raise InvalidInput("a map needs two options with numbers")
    names = list(of.axes)
    values = np.where(of.status == 0, getattr(of, show), np.nan)
    shape = (len(of.axes[family]) if family else 1, len(of.axes[over]))
    if family and names.index(family) > names.index(over):
        values = values.squeeze().T
    values = values.reshape(shape)
    figure, (axes,) = _figure(figure, 1, ax)
    before = len(axes.get_lines())
    label = _named(show, of._in(results[show].unit))
    axes.set_xlabel(_named(over, of._in(options[over].unit)))
    # curves and maps go along ascending values
    order = np.argsort(of.axes[over]) if of.axes[over].dtype.kind != "O" else np.arange(len(of.axes[over]))
    x, values = of.axes[over][order], values[:, order]
    if map:
        rows = np.argsort(of.axes[family])
        field = np.ma.masked_invalid(values[rows])
        filled = axes.contourf(x, of.axes[family][rows], field, 12, cmap="viridis")
        lines = axes.contour(x, of.axes[family][rows], field, filled.levels, colors="white", linewidths=0.4)
        axes.clabel(lines, fontsize=7)
        figure.colorbar(filled, ax=axes, label=label)
        axes.set_ylabel(_named(family, of._in(options[family].unit)))
        return figure
    colours = (CURVES * (2 + (before + len(values)) // len(CURVES)))[before:]
    for row, value, colour in zip(values, of.axes[family] if family else [None], colours):
        axes.plot(x, row, color=colour, marker="o", markersize=2.5,
                  label=None if value is None else
                  f"{family.replace('_', ' ')} = {value if isinstance(value, str) else format(value, 'g')}")
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_ylabel(label)
    if family:
        axes.legend()
    return figure
