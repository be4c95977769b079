# SPDX-License-Identifier: MIT
"""Draws the error of the drawn outline over the time of a tick for every level of detail, scene by scene. `charts.py` calls it."""

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

# Colors of Okabe and Ito; markers besides, for prints without color.
REST, PRESSED, AWAKE, ASLEEP = (
    {"color": "#0072B2", "marker": "o"},
    {"color": "#D55E00", "marker": "s"},
    {"color": "#009E73", "marker": "^"},
    {"color": "#CC79A7", "marker": "D"},
)
LOWEST = 0.3  # percent; less is drawn there
TOLERANCE = 3.0  # percent, the default
MOST_RATIO = 2.0  # of over-modelling that is aimed at
COLUMNS = 4


def draw_points(axes, points, look, aside=6):
    """Points (time, error, label), joined from left to right."""
    points = sorted(points)
    axes.plot([p[0] for p in points], [max(p[1], LOWEST) for p in points], ms=5, lw=1.1, **look)
    for i, (time, error, label) in enumerate(points):
        axes.annotate(label, (time, max(error, LOWEST)), xytext=(0, aside if i % 2 else -aside - 6), textcoords="offset points",
                      fontsize=6.5, color=look["color"], ha="center")


def style(axes, title, unit):
    axes.set_title(title)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(LOWEST * 0.6, 90)
    axes.axhline(TOLERANCE, color="#999999", lw=0.8, ls=(0, (2, 2)), zorder=1)
    axes.set_yticks([LOWEST, 1, 3, 10, 30], [f"< {LOWEST:g}", "1", "3", "10", "30"])
    axes.margins(x=0.12)
    axes.minorticks_off()
    axes.set_xlabel(f"time of a tick [{unit}]")


def draw_outline(axes, section, outline):
    """One outline: lying in two layers against the same as drawn, and under a stamp against 128 points."""
    rest = [r for r in section["rows"] if r["outline"] == outline]
    points = [(r["simulated_us"], r["settled_error_percent"], f"{r['tolerance_percent']:g} %") for r in rest]
    points.append((rest[0]["as_drawn_us"], 0.0, "as drawn"))
    draw_points(axes, points, REST)
    pressed = [r for r in section["refinement"] if r["outline"] == outline]
    short = {"3 %, finer where bent": "bent", "128 points": "128"}
    draw_points(axes, [(r["us"], r["error_percent"], short.get(r["way"], r["way"])) for r in pressed], PRESSED)
    style(axes, outline, "µs")


def draw_crowd(axes, section):
    for may_sleep, look in ((True, ASLEEP), (False, AWAKE)):
        rows = [r for r in section["crowd"] if r["sleep"] == may_sleep]
        short = {"automatic, rigid flight": "rigid", "half the points": "half", "a quarter": "quarter"}
        draw_points(axes, [(r["tick_ms"], r["outline_error_percent"], short.get(r["way"], r["way"])) for r in rows], look)
    style(axes, f"a crowd of {section['crowd'][0]['bodies']:,}: hulls at rest", "ms")


def draw_over_modelling(axes, section):
    rows = section["rows"]
    names = [f"{r['outline']}, {r['tolerance_percent']:g} %" for r in rows]
    axes.barh(range(len(rows)), [r["over_modelling_ratio"] for r in rows], color=REST["color"])
    axes.set_yticks(range(len(rows)), names)
    axes.invert_yaxis()
    axes.axvline(MOST_RATIO, color="#999999", lw=0.8, ls=(0, (2, 2)))
    axes.set_xlim(0, MOST_RATIO * 1.05)
    axes.set_title("over-modelling")
    axes.set_xlabel("time over that of the cheapest hull within the tolerance")


def figure_of(section):
    outlines = list(dict.fromkeys(r["outline"] for r in section["rows"]))
    figure = plt.figure(figsize=(13, 7.4), layout="constrained")
    grid = figure.add_gridspec(2, COLUMNS)
    first = None
    for column, outline in enumerate(outlines[:COLUMNS]):
        axes = figure.add_subplot(grid[0, column], sharey=first)
        first = first or axes
        draw_outline(axes, section, outline)
    first.set_ylabel("error of the drawn outline [%]")
    crowd = figure.add_subplot(grid[1, :2])
    draw_crowd(crowd, section)
    crowd.set_ylabel("error of the drawn outline [%]")
    draw_over_modelling(figure.add_subplot(grid[1, 2:]), section)
    labels = (
        (REST, f"{section['bodies']} bodies at rest in two layers, against the same as drawn; number: tolerance"),
        (PRESSED, "pressed by a stamp, against 128 points; \"bent\": finer where it bends"),
        (ASLEEP, "crowd, bodies may sleep; \"rigid\": automatic with rigid flight"),
        (AWAKE, "crowd, nothing sleeps"),
    )
    handles = [Line2D([], [], ms=5, label=label, **look) for look, label in labels]
    handles.append(Line2D([], [], color="#999999", lw=0.8, ls=(0, (2, 2)), label=f"{TOLERANCE:g} %, the default tolerance; {MOST_RATIO:g}, the ratio aimed at"))
    figure.legend(handles=handles, loc="outside upper center", ncols=2,
                  title="Levels of detail: distance of the drawn outlines over the radius. Lower is more accurate, further left is cheaper")
    return figure
