# SPDX-License-Identifier: MIT
"""Draws the error of every elastic model over the time of a tick, one panel a scene. `charts.py` calls it."""

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from tables_model import MODEL_LABELS, is_unsettled, of_start

TITLES = {
    "rest": "rest under its own weight",
    "press_0.9": "pressed to 0.9",
    "press_0.75": "pressed to 0.75",
    "press_0.5": "pressed to half",
    "press_0.3": "pressed to 0.3",
    "hang": "hung from its top",
    "wobble": "free wobble: frequency",
    "drop": "drop, when most squashed",
    "arm_light": "bent arm of an L, light",
    "arm": "bent arm of an L, full gravity",
    "column": "column of three boxes",
    "unseen": "an egg pressed to 0.6 (unseen)",
}
# Colors of Okabe and Ito; markers besides, for prints without color.
LOOKS = (
    {"color": "#E69F00", "marker": "v"},
    {"color": "#56B4E9", "marker": "s"},
    {"color": "#009E73", "marker": "^"},
    {"color": "#CC79A7", "marker": "D"},
    {"color": "#D55E00", "marker": "P"},
    {"color": "#882255", "marker": "*"},
)
DEFAULT_LOOK = {"color": "#0072B2", "marker": "o", "lw": 2.4, "zorder": 4}
OLD_LOOK = {"color": "#777777", "marker": "X", "ls": (0, (3, 2))}
LOWEST, HIGHEST = 0.05, 60.0  # percent
STRIP = 200.0  # what failed stands between HIGHEST and this
COLUMNS = 4
NAMED = (8, 16, 32, 128)  # points whose number stands at the curve


def looks_of(models, default):
    free = iter(LOOKS)
    looks = {}
    for model in models:
        look = DEFAULT_LOOK if model == default else OLD_LOOK if "old" in model else next(free)
        looks[model] = {"lw": 1.4, "ls": "-", "zorder": 3, **look}
    return looks


def failed(row):
    return row["error_percent"] is None or row["error_percent"] > HIGHEST or is_unsettled(row)


def draw_model(axes, curve, look, labeled):
    """One model's points, joined where they are good; what failed stands in the strip above."""
    times = [row["us_per_tick"] for row in curve]
    heights = [(HIGHEST * STRIP) ** 0.5 if failed(row) else max(row["error_percent"], LOWEST) for row in curve]
    for i in range(len(curve) - 1):
        if not failed(curve[i]) and not failed(curve[i + 1]):
            axes.plot(times[i : i + 2], heights[i : i + 2], color=look["color"], lw=look["lw"], ls=look["ls"],
                      zorder=look["zorder"])
    for row, time, height in zip(curve, times, heights):
        marker = "x" if failed(row) else look["marker"]
        axes.plot(time, height, ls="", marker=marker, ms=5, color=look["color"], zorder=look["zorder"])
        if labeled and row["points"] in NAMED and not failed(row):
            axes.annotate(f"{row['points']}", (time, height), xytext=(0, -11), textcoords="offset points", fontsize=7,
                          color=look["color"], ha="center")


def figure_of(section):
    rows = of_start(section["rows"])
    scenes = [scene for scene in TITLES if any(row["scene"] == scene for row in rows)]
    models = list(dict.fromkeys(row["model"] for row in rows))
    default = section["default_model"]
    looks = looks_of(models, default)
    count = -(-len(scenes) // COLUMNS)
    figure, grid = plt.subplots(count, COLUMNS, figsize=(13, 2.9 * count + 1.3), sharex=True, sharey=True, squeeze=False,
                                layout="constrained")
    for axes, scene in zip(grid.flat, scenes):
        for model in models:
            curve = sorted((r for r in rows if (r["scene"], r["model"]) == (scene, model)), key=lambda r: r["points"])
            draw_model(axes, curve, looks[model], model == default)
        axes.set_title(TITLES[scene])
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(LOWEST * 0.8, STRIP)
        axes.axhspan(HIGHEST, STRIP, color="#F1F1F1", zorder=0)
        axes.axhline(5, color="#999999", lw=0.8, ls=(0, (2, 2)), zorder=1)
        ticks = [0.1, 0.3, 1, 3, 10, 30]
        axes.set_yticks(ticks + [(HIGHEST * STRIP) ** 0.5], [f"{tick:g}" for tick in ticks] + ["failed"])
        axes.set_xticks([0.1, 1, 10, 100, 1000], ["0.1", "1", "10", "100", "1000"])
        axes.minorticks_off()
        axes.tick_params(labelbottom=True)
    times = [row["us_per_tick"] for row in rows]
    axes.set_xlim(min(times) / 1.5, max(times) * 1.5)
    for row in grid:
        row[0].set_ylabel("error [%]")
    for axes in list(grid.flat)[len(scenes):]:
        axes.axis("off")
    for axes in grid[-1]:
        axes.set_xlabel("time of a body's tick [µs]")
    handles = [Line2D([], [], color=looks[m]["color"], marker=looks[m]["marker"], ls=looks[m]["ls"], lw=looks[m]["lw"], ms=5,
                      label=MODEL_LABELS.get(m, m) + (" (default)" if m == default else "")) for m in models]
    handles += [Line2D([], [], color="#333333", ls="", marker="x", label=f"not at rest, reset, or off by over {HIGHEST:g} %"),
                Line2D([], [], color="#999999", lw=0.8, ls=(0, (2, 2)), label="5 %")]
    counts = sorted({row["points"] for row in rows})
    figure.legend(handles=handles, loc="outside upper center", ncols=4,
                  title="Bodies against finite elements: RMS distance of the outlines over the radius. Lower is more accurate,"
                  f" further left is cheaper.\nA curve is a model with {counts[0]} to {counts[-1]} hull points, from left to right;"
                  " figures at the default's curve")
    return figure
