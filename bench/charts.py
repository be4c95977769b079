# SPDX-License-Identifier: MIT
"""Draws docs/charts from a result file. `scripts/charts.sh` calls it; the same results give the same bytes."""

import itertools
import json
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import charts_detail
import charts_model
import machine
import work_precision

ROOT = Path(__file__).resolve().parent.parent
CHARTS = ROOT / "docs" / "charts"

# Colors of Okabe and Ito, told apart by everybody; shapes and dashes besides, for prints without color.
STYLES = {
    "explicit_euler": {"label": "explicit Euler", "color": "#D55E00", "marker": "v", "ls": "-"},
    "semi_implicit_euler": {"label": "semi-implicit Euler (default)", "color": "#0072B2", "marker": "o", "ls": "-"},
    "midpoint": {"label": "midpoint", "color": "#E69F00", "marker": "s", "ls": "-"},
    "heun": {"label": "Heun", "color": "#7A5C00", "marker": "D", "ls": (0, (4, 2))},
    "runge_kutta_4": {"label": "Runge–Kutta 4", "color": "#009E73", "marker": "^", "ls": "-"},
    "velocity_verlet": {"label": "velocity Verlet (default)", "color": "#CC79A7", "marker": "P", "ls": "-"},
    "xpbd": {"label": "XPBD", "color": "#555555", "marker": "X", "ls": (0, (1, 1))},
}
DEFAULTS = work_precision.DEFAULTS
BODIES = {
    "thesis": "8-point body,\nlight damping",
    "thesis_undamped": "8-point body,\nno damping",
    "thesis_shape": "8-point body,\nshape matching",
    "circle32": "32-point body, shape\nmatching, pressure",
}

plt.rcParams.update(
    {
        "svg.hashsalt": "soft_body_2d",
        "svg.fonttype": "path",
        "font.family": "DejaVu Sans",
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.grid": True,
        "grid.color": "#E4E4E4",
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "figure.facecolor": "white",
    }
)


def width_of(name):
    return {"lw": 2.4, "zorder": 4} if name in DEFAULTS else {"lw": 1.3, "zorder": 3}


def method_handles(names, markers=True):
    return [
        Line2D([], [], ls=s["ls"], color=s["color"], marker=s["marker"] if markers else "", ms=5, label=s["label"],
               lw=width_of(name)["lw"])
        for name, s in STYLES.items()
        if name in names
    ]


def power_of_ten(value):
    return rf"$10^{{{round(math.log10(value))}}}$"


def save(figure, name):
    CHARTS.mkdir(parents=True, exist_ok=True)
    file = CHARTS / f"{name}.svg"
    figure.savefig(file, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    # matplotlib leaves blanks at line ends, which no text file of this repository has.
    lines = file.read_text(encoding="utf-8").split("\n")
    file.write_text("\n".join(line.rstrip() for line in lines), encoding="utf-8")
    print(f"==> {file.relative_to(ROOT)}")


def source_note(figure, section):
    """Where the figures come from, small, at the foot."""
    commit, day = f"commit {section['commit']}", section["date"][:10]
    text = " · ".join((section["command"], commit, section["cpu"], section["compiler"], day))
    foot = 0.17 / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, foot, 1, 1 - foot))
    figure.text(0.995, foot / 3, text, ha="right", va="bottom", fontsize=7, color="#666666")


# --- Work and precision

LOWEST, HIGHEST = 1e-14, 10.0  # errors in radii; above HIGHEST a run counts as blown up
FLOAT_RESOLUTION = 6e-8
STRIP = 1e5  # the blown-up runs stand between HIGHEST and this, one row a method


def strip_height(name):
    rows = list(STYLES)
    share = (len(rows) - rows.index(name) - 0.5) / len(rows)
    return HIGHEST * (STRIP / HIGHEST) ** share


def draw_runs(axes, curve, name, x, **look):
    """One method's runs: a line through the good ones, a cross in the strip above for each that blew up."""
    style = STYLES[name]
    good = [point for point in curve if not point["blown_up"]]
    axes.plot([x(p) for p in good], [max(p["error"], LOWEST) for p in good], color=style["color"], **look)
    bad = [point for point in curve if point["blown_up"]]
    axes.plot([x(p) for p in bad], [strip_height(name)] * len(bad), ls="", marker="x", ms=3.6, mew=1.1,
              color=style["color"], zorder=3)


def finish_error_axes(axes, labeled):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(LOWEST, STRIP)
    axes.axhspan(HIGHEST, STRIP, color="#F1F1F1", zorder=0)
    axes.axhline(1e-2, color="#999999", lw=0.8, ls=(0, (2, 2)), zorder=1)
    ticks = [10.0**exponent for exponent in range(-12, 1, 3)]
    blown = math.sqrt(HIGHEST * STRIP)
    axes.set_yticks(ticks + [blown], [power_of_ten(tick) for tick in ticks] + ["blown\nup"] if labeled else [""] * 6)
    axes.minorticks_off()


def draw_slopes(axes, start, orders, span):
    """How fast the error falls with the work, for the orders in question."""
    x, y = start
    for order in orders:
        axes.plot([x, x * span], [y, y * span**-order], color="#999999", lw=1)
        axes.annotate(f"{order}", (x * span, y * span**-order), xytext=(2, -1), textcoords="offset points",
                      fontsize=8, color="#666666", va="top")
    axes.annotate("order", (x, y), xytext=(-2, 2), textcoords="offset points", fontsize=8, color="#666666", ha="center")


def chart_work_precision(section):
    curves = work_precision.curves_of(section["points"], "double")
    bodies = [body for body in BODIES if any(key[0] == body for key in curves)]
    stiffnesses = sorted({key[1] for key in curves})
    figure, grid = plt.subplots(len(bodies), len(stiffnesses), sharex="row", figsize=(13, 2.75 * len(bodies) + 1.4),
                                squeeze=False, layout="constrained")
    for row, body in zip(grid, bodies):
        for axes, k in zip(row, stiffnesses):
            first = axes is row[0]
            if body == bodies[0]:
                axes.set_title(f"k = {power_of_ten(k)} N/m")
            if body == bodies[-1]:
                axes.set_xlabel("CPU time for a simulated second [µs]")
            for name, style in STYLES.items():
                draw_runs(axes, curves.get((body, k, name), []), name, lambda p: p["us"], marker=style["marker"],
                          ms=3.2, ls=style["ls"], **width_of(name))
            for point in curves.get((body, k, "automatic"), []):
                style = STYLES[point["method"]]
                height = strip_height(point["method"]) if point["blown_up"] else point["error"]
                axes.plot(point["us"], height, marker="*", ms=15, mfc="#FFD700", mec=style["color"], mew=1.4, zorder=6)
            finish_error_axes(axes, first)
            if first:
                axes.set_ylabel(f"{BODIES[body]}\n\nerror / radius")
    left, right = grid[0][0].get_xlim()
    draw_slopes(grid[0][0], (left * (right / left) ** 0.08, 1e-7), (1, 2, 4), 8)
    names = {key[2] for key in curves}
    star = Line2D([], [], ls="", marker="*", ms=14, mfc="#FFD700", mec=STYLES[DEFAULTS[0]]["color"],
                  label="what the automatic rule picks (rim: the method)")
    cross = Line2D([], [], ls="", marker="x", color="#333333", label="blew up: gray strip, one row a method")
    dotted = Line2D([], [], ls=(0, (2, 2)), color="#999999", lw=1, label="1 % of the radius")
    figure.legend(handles=[*method_handles(names), star, cross, dotted], loc="outside upper center", ncols=4,
                  title="Work and precision in double: lower and further left is better")
    source_note(figure, section)
    save(figure, "work-precision")


def chart_rounding(section):
    """The same runs over the step, in both precisions: where the float curve leaves the other it is rounding."""
    curves = {precision: work_precision.curves_of(section["points"], precision) for precision in ("double", "float")}
    bodies = [body for body in ("thesis", "thesis_shape") if any(key[0] == body for key in curves["double"])]
    stiffnesses = sorted({key[1] for key in curves["double"] if key[0] == bodies[0]})
    names = ["semi_implicit_euler", "velocity_verlet", "midpoint", "runge_kutta_4"]
    figure, grid = plt.subplots(len(bodies), len(stiffnesses), sharex=True, figsize=(13, 3.0 * len(bodies) + 1.3),
                                squeeze=False, layout="constrained")
    for row, body in zip(grid, bodies):
        for axes, k in zip(row, stiffnesses):
            for name in names:
                def step(point):
                    return 1000 / point["steps"]

                draw_runs(axes, curves["double"].get((body, k, name), []), name, step, ls="-", lw=1.3, alpha=0.85)
                draw_runs(axes, curves["float"].get((body, k, name), []), name, step, ls="", ms=5, mfc="none", mew=1.2,
                          marker=STYLES[name]["marker"])
            finish_error_axes(axes, axes is row[0])
            axes.axhspan(LOWEST, FLOAT_RESOLUTION, color="#56B4E9", alpha=0.13, zorder=0, lw=0)
            if body == bodies[0]:
                axes.set_title(f"k = {power_of_ten(k)} N/m")
            if body == bodies[-1]:
                axes.set_xlabel("step [ms]")
        row[0].set_ylabel(f"{BODIES[body]}\n\nerror / radius")
    grid[0][0].invert_xaxis()
    handles = [
        Line2D([], [], color=style["color"], marker=style["marker"], mfc="none", label=style["label"])
        for style in (STYLES[name] for name in names)
    ]
    handles += [Line2D([], [], color="#333333", label="double: line"),
                Line2D([], [], color="#333333", ls="", marker="o", mfc="none", label="float: marker"),
                Patch(color="#56B4E9", alpha=0.2, label="below float's relative resolution")]
    figure.legend(handles=handles, loc="outside upper center", ncols=4,
                  title="Truncation and rounding: smaller steps to the right")
    source_note(figure, section)
    save(figure, "rounding")


# --- Stability

# By how much a step multiplies the motion: color and words up to each bound, the first of which is no growth at all.
GROWTH = (
    (None, "#CCE3F2", "does not grow (below 0.1 % a step)"),
    (1.1, "#FEE08B", "grows by up to a tenth a step"),
    (2.0, "#F79A3E", "up to twofold"),
    (math.inf, "#A63603", "more than twofold"),
)


def growth_class(cell):
    if cell["stable"]:
        return 0
    growth = math.inf if cell["growth"] is None else cell["growth"]
    return next(i for i, (bound, *_) in enumerate(GROWTH) if bound is not None and growth <= bound)


def chart_stability(section):
    """One column a damping ratio, colored by measured steps; the limit by theory as a bar across its column."""
    names = [name for name in STYLES if any(cell["integrator"] == name for cell in section["map"])]
    zetas = sorted({cell["zeta"] for cell in section["map"]})
    steps = sorted({cell["h_omega"] for cell in section["map"]})
    half = (steps[1] - steps[0]) / 2
    top = steps[-1] + half
    columns = 4
    rows = -(-len(names) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(13, 3.3 * rows + 0.9), sharex=True, sharey=True, squeeze=False,
                                layout="constrained")
    for axes, name in zip(grid.flat, names):
        for x, zeta in enumerate(zetas):
            column = sorted((c for c in section["map"] if (c["integrator"], c["zeta"]) == (name, zeta)),
                            key=lambda cell: cell["h_omega"])
            # Neighbors of one class are drawn as one rectangle.
            for kind, run in itertools.groupby(column, key=growth_class):
                run = list(run)
                bottom = run[0]["h_omega"] - half
                axes.bar(x, run[-1]["h_omega"] + half - bottom, bottom=bottom, width=1, color=GROWTH[kind][1], lw=0)
        for limit in section["theory"]:
            if limit["integrator"] == name and limit["h_omega_limit"] is not None and limit["h_omega_limit"] <= top:
                x = zetas.index(limit["zeta"])
                axes.plot([x - 0.5, x + 0.5], [limit["h_omega_limit"]] * 2, color="black", lw=2.6, clip_on=False,
                          solid_capstyle="butt", zorder=5)
        if all(t["unbounded"] for t in section["theory"] if t["integrator"] == name):
            axes.text(0.5, 0.5, "no limit, in theory\nor measured", transform=axes.transAxes, ha="center", va="center")
        axes.set_title(STYLES[name]["label"])
        axes.set_xticks(range(len(zetas)), [f"{zeta:g}" for zeta in zetas], fontsize=8.5)
        axes.set_xlim(-0.5, len(zetas) - 0.5)
        axes.set_ylim(0, top)
        axes.grid(False)
    for axes in grid[:, 0]:
        axes.set_ylabel("step · frequency, hω")
    for i, axes in enumerate(grid.flat):
        if i >= len(names):
            axes.axis("off")
        elif i + columns >= len(names):
            axes.set_xlabel("damping ratio ζ")
            axes.tick_params(labelbottom=True)
    key = [Patch(color=color, label=words) for _, color, words in GROWTH]
    key.append(Line2D([], [], color="black", lw=2.6, label="limit by theory"))
    figure.legend(handles=key, loc="outside upper center", ncols=5,
                  title="Stability of a damped oscillator, measured in the simulator, with theory drawn over it")
    source_note(figure, section)
    save(figure, "stability")


# --- Energy

SHOWN_RATES = (60, 240, 960)  # steps a second of the energy chart; the results hold more


def chart_energy(section):
    runs = [run for run in section["runs"] if round(1 / run["dt"]) in SHOWN_RATES]
    kinds = sorted({(run["damped"], run["k"]) for run in runs})
    steps = sorted({run["dt"] for run in runs}, reverse=True)
    figure, grid = plt.subplots(len(kinds), len(steps), figsize=(13, 2.6 * len(kinds) + 1.1), sharex=True, sharey="row",
                                squeeze=False, layout="constrained")
    for row, (damped, k) in zip(grid, kinds):
        for axes, dt in zip(row, steps):
            draw_energy(axes, [run for run in runs if (run["damped"], run["k"], run["dt"]) == (damped, k, dt)], damped)
            if (damped, k) == kinds[0]:
                axes.set_title(f"step 1/{round(1 / dt)} s")
            if (damped, k) == kinds[-1]:
                axes.set_xlabel("time [s]")
        row[0].set_ylabel(("light damping" if damped else "no damping") + f",\nk = {k:g} N/m\n\nenergy / initial")
    handles = method_handles({run["integrator"] for run in runs}, markers=False)
    figure.legend(handles=handles, loc="outside upper center", ncols=4,
                  title="Energy of a wobbling body without contact; a cross marks where a run blew up")
    source_note(figure, section)
    save(figure, "energy")


def draw_energy(axes, runs, damped):
    """One panel. What leaves it at the bottom has come to rest; what leaves it at the top blows up soon after."""
    low, high, top = (1e-6, 1e2, 1e5) if damped else (1e-2, 1e2, 1e4)
    names = list(STYLES)
    for run in runs:
        style = STYLES[run["integrator"]]
        times, ratios = np.array(run["series"], dtype=float).T
        ratios[~(ratios < high)] = high
        ratios = np.maximum(ratios, low / 1e3)  # the line goes on below the panel
        axes.plot(times, ratios, color=style["color"], ls=style["ls"], **width_of(run["integrator"]))
        if run["blown_up"]:
            place = high * (top / high) ** ((names.index(run["integrator"]) + 0.5) / len(names))
            axes.plot(times[-1], place, ls="", marker="x", ms=6, mew=1.8, color=style["color"], zorder=5)
    axes.set_yscale("log")
    axes.set_ylim(low, top)
    axes.axhspan(high, top, color="#F1F1F1", zorder=0)
    ticks = [low * 10.0**i for i in range(0, round(math.log10(high / low)), 2 if damped else 1)]
    axes.set_yticks(ticks + [math.sqrt(high * top)], [power_of_ten(tick) for tick in ticks] + ["blown\nup"])
    axes.minorticks_off()


# --- Recovery

def chart_recovery(section):
    rows = section["rows"]
    models = list(dict.fromkeys(row["model"] for row in rows))
    counts = sorted({row["hull_points"] for row in rows})
    colors = dict(zip(counts, ("#B5DDF5", "#56B4E9", "#0072B2", "#003554")))
    figure, axes = plt.subplots(figsize=(11, 0.2 * len(models) * len(counts) + 1.4),
                                layout="constrained")
    thickness = 0.8 / len(counts)
    for row in rows:
        place = models.index(row["model"]) + (counts.index(row["hull_points"]) - (len(counts) - 1) / 2) * thickness
        share = 100 * row["recovered"] / row["starts"]
        axes.barh(place, share, height=thickness * 0.92, color=colors[row["hull_points"]])
        axes.text(share + 0.6, place, f"{row['recovered']} of {row['starts']}", va="center", fontsize=8)
    default = section.get("default_model")
    axes.set_yticks(range(len(models)), [f"{model}  (default)" if model == default else model for model in models])
    for label, model in zip(axes.get_yticklabels(), models):
        label.set_fontweight("bold" if model == default else "normal")
    axes.set_ylim(len(models) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    axes.set_xlim(0, 112)
    axes.set_xticks(range(0, 101, 20))
    axes.set_xlabel("bodies that found back to their shape [%]")
    figure.legend(handles=[Patch(color=colors[count], label=f"{count} hull points") for count in counts],
                  loc="outside upper center", ncols=len(counts), title="Recovery from strong deformations, by model")
    source_note(figure, section)
    save(figure, "recovery")


# --- Contacts

STEPPED_BY_DEFAULT = "semi_implicit_euler"  # beside others
CONTACT_LABELS = {"automatic": "automatic: as many as the springs need, and more", "xpbd": "XPBD"}
CONTACT_PANELS = (
    ("while it falls and settles", "mean_penetration", "worst_penetration"),
    ("after that", "mean_penetration_at_end", "worst_penetration_at_end"),
)


def chart_contacts(section):
    """How deep bodies are in one another over what that costs, one point a number of contact substeps."""
    rows = section["penetrations"]
    figure, grid = plt.subplots(1, len(CONTACT_PANELS), figsize=(13, 4.9), sharex=True, sharey=True, layout="constrained")
    for axes, (title, mean, worst) in zip(grid, CONTACT_PANELS):
        for name in dict.fromkeys(row["integrator"] for row in rows):
            style = STYLES[STEPPED_BY_DEFAULT if name == "automatic" else name]
            curve = sorted((row for row in rows if row["integrator"] == name), key=lambda row: row["contact_substeps"])
            times = [row["ms_per_step"] for row in curve]
            axes.plot(times, [100 * row[mean] for row in curve], color=style["color"], marker=style["marker"], ms=5, lw=1.6)
            axes.plot(times, [100 * row[worst] for row in curve], color=style["color"], marker=style["marker"], ms=5,
                      lw=1.2, ls=(0, (2, 2)), mfc="white")
            for row in curve:
                axes.annotate(f"{row['contact_substeps']}", (row["ms_per_step"], 100 * row[worst]), xytext=(4, 4),
                              textcoords="offset points", fontsize=8, color=style["color"])
            bad = [row for row in curve if row["folded_ever"]]
            axes.plot([row["ms_per_step"] for row in bad], [100 * row[worst] for row in bad], ls="", marker="x", ms=11,
                      mew=1.6, color="#333333", zorder=5)
        axes.axhline(5, color="#999999", lw=0.8, ls=(0, (2, 2)), zorder=1)
        axes.set_xscale("log")
        axes.set_yscale("log")
        ticks = [tick for tick in (0.2, 0.5, 1, 2, 5, 10, 20, 50) if axes.get_xlim()[0] <= tick <= axes.get_xlim()[1]]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.minorticks_off()
        axes.set_title(title)
        axes.set_xlabel(f"time of a step of {rows[0]['bodies']} bodies, one thread [ms]")
    grid[0].set_ylabel("penetration / radius [%]")
    names = dict.fromkeys(row["integrator"] for row in rows)
    styles = {name: STYLES[STEPPED_BY_DEFAULT if name == "automatic" else name] for name in names}
    handles = [Line2D([], [], color=styles[name]["color"], marker=styles[name]["marker"], ms=5, label=CONTACT_LABELS[name])
               for name in names]
    handles += [Line2D([], [], color="#333333", marker="o", ms=5, label="mean over bodies"),
                Line2D([], [], color="#333333", marker="o", mfc="white", ls=(0, (2, 2)), ms=5,
                       label="worst; number: contact substeps a step"),
                Line2D([], [], color="#999999", lw=0.8, ls=(0, (2, 2)), label="5 %: counts as overlapping")]
    if any(row["folded_ever"] for row in rows):
        handles.append(Line2D([], [], color="#333333", ls="", marker="x", ms=9, label="bodies folded on the way"))
    figure.legend(handles=handles, loc="outside upper center", ncols=3,
                  title="A pile ten bodies high: how far bodies are in one another, and what keeping them out costs")
    source_note(figure, section)
    save(figure, "contacts")


ERROR_FLOOR = 1e-4  # smaller ones are drawn there: rounding


def chart_contact_errors(section):
    """Each error of contacts that a player sees over the time of a step, one point a number of contact substeps."""
    rows = section["chart"]
    kinds = list(dict.fromkeys((row["error"], row["unit"]) for row in rows))
    figure, grid = plt.subplots(2, (len(kinds) + 1) // 2, figsize=(13, 7.6), sharex=True, layout="constrained")
    names = list(dict.fromkeys(row["integrator"] for row in rows))
    for axes, (kind, unit) in zip(grid.flat, kinds):
        for name in names:
            curve = [row for row in rows if row["integrator"] == name and row["error"] == kind]
            times = [row["us_per_body_step"] for row in curve]
            errors = [max(row["value"], ERROR_FLOOR) for row in curve]
            style = STYLES[name]
            axes.plot(times, errors, color=style["color"], marker=style["marker"], ms=5, lw=1.6)
            for row, time, error in zip(curve, times, errors):
                below = name == "xpbd"
                axes.annotate(f"{row['contact_substeps']}", (time, error), xytext=(3, -11 if below else 5),
                              textcoords="offset points", fontsize=8, color=style["color"])
        axes.set_xscale("log")
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, high / 30) / 1.6, high * 1.6)
        ticks = [tick for tick in (2, 5, 10, 20, 50, 100) if axes.get_xlim()[0] <= tick <= axes.get_xlim()[1]]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.minorticks_off()
        axes.set_title(kind)
        axes.set_ylabel(f"error [{unit}]")
    for axes in grid[-1]:
        axes.set_xlabel("time of a body and step, one thread [µs]")
    labels = {"semi_implicit_euler": "forces: semi-implicit Euler", "xpbd": "constraints: XPBD"}
    handles = [Line2D([], [], color=STYLES[name]["color"], marker=STYLES[name]["marker"], ms=5, label=labels[name])
               for name in names]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(names),
                  title="Default nodes: errors of contacts over their cost; number: contact substeps a step")
    source_note(figure, section)
    save(figure, "contact-errors")


# --- Models


def chart_model(section):
    figure = charts_model.figure_of(section)
    source_note(figure, section)
    save(figure, "model")


# --- Detail


def chart_detail(section):
    figure = charts_detail.figure_of(section)
    source_note(figure, section)
    save(figure, "detail")


CHARTS_OF = {
    "work-precision": (chart_work_precision, chart_rounding),
    "stability": (chart_stability,),
    "energy": (chart_energy,),
    "recovery": (chart_recovery,),
    "contact-accuracy": (chart_contacts, chart_contact_errors),
    "model": (chart_model,),
    "detail": (chart_detail,),
}


def newest_date(file):
    return max(section["date"] for section in json.loads(file.read_text(encoding="utf-8")).values())


def result_file():
    """The file to draw: the one asked for, else this machine's, else the newest."""
    if len(sys.argv) > 1:
        return Path(sys.argv[1])
    folder = ROOT / "bench" / "results"
    files = sorted(folder.glob("*.json"), key=newest_date)
    own = folder / f"{machine.machine_name()}.json"
    if not files:
        sys.exit("error: no results to draw in bench/results; run scripts/bench.sh work-precision and the others first")
    return own if own in files else files[-1]


def main():
    file = result_file()
    results = json.loads(file.read_text(encoding="utf-8"))
    for name, charts in CHARTS_OF.items():
        if name not in results:
            print(f"==> no {name} in {file.name}: run scripts/bench.sh {name}")
            continue
        for chart in charts:
            chart(results[name])


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError) as problem:
        sys.exit(f"error: {problem}")
