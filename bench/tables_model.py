# SPDX-License-Identifier: MIT
"""Judges the outlines that `model` made by the finite elements' of bench/fem, sums up and prints them."""

import json
from pathlib import Path

import numpy as np

from tables_b import number, rounded
from tables_c import load, print_load, print_targets

REFERENCES = Path(__file__).resolve().parent / "fem" / "references.json"
DEFAULT_POINTS = 16  # of a node
SAMPLES_A_SIDE = 32  # of an outline that is compared as a line
TICK = 1 / 60
FREE_SIDEWAYS = ("rest", "press_0.9", "press_0.75", "press_0.5", "press_0.3", "drop", "column", "unseen")
MOST_RMS_PERCENT = {"rest": 2, "press_0.75": 5, "press_0.5": 8}
MOST_FREQUENCY_ERROR = 5  # percent
MOST_MESH_SPREAD = 5  # percent
LEAST_PEAK = 0.003  # of the greatest, for a frequency to count; a square's lowest mode hardly shows in low polynomials
LEAST_FREQUENCY = 0.5  # Hz; below is drift
MOVING = ("wobble", "drop")  # scenes that never come to rest
STILL = 10  # px/s, a sixth of a pixel a tick, beyond the motion of the body as a whole
MODEL_LABELS = {
    "springs": "springs",
    "springs_and_shape": "springs, shape matching",
    "springs_shape_and_area": "springs, shape, area",
    "modes": "elastic modes",
    "triangles": "elastic triangles, 1.5 points inside for each of the hull",
    "triangles, dense": "elastic triangles, 4 points inside",
}


def distances(points, outline):
    """From each point to the closed polygon."""
    start, side = outline, np.roll(outline, -1, axis=0) - outline
    share = ((points[:, None] - start) * side).sum(-1) / np.maximum((side**2).sum(-1), 1e-30)
    nearest = start + np.clip(share, 0, 1)[..., None] * side
    return np.sqrt(((points[:, None] - nearest) ** 2).sum(-1).min(axis=1))


def sampled(outline):
    """Points along every side."""
    shares = np.arange(SAMPLES_A_SIDE)[:, None, None] / SAMPLES_A_SIDE
    return (outline + shares * (np.roll(outline, -1, axis=0) - outline)).reshape(-1, 2)


def area(outline):
    x, y = outline.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def middle(outline):
    """The x of the center of area; of the points where there is no area."""
    x, y = outline.T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    if abs(cross.sum()) < 1e-6 * np.ptp(x) * np.ptp(y):
        return float(x.mean())
    return float(((x + np.roll(x, -1)) * cross).sum() / (3 * cross.sum()))


def compare(outline, reference, free_sideways):
    """Squared distances of hull points, of the line to the reference and back, and the largest distance."""
    if free_sideways:
        outline = outline + (middle(reference) - middle(outline), 0)
    points = distances(outline, reference)
    there, back = distances(sampled(outline), reference), distances(reference, outline)
    return (points**2).mean(), (there**2).mean(), (back**2).mean(), max(there.max(), back.max())


def outline_errors(row, scene, radius):
    """Of all bodies of a scene together, in percent of R; None where a body is no longer finite."""
    references = [box["outline"] for box in scene["boxes"]] if "boxes" in scene else [scene["outline"]]
    try:
        outlines = [np.array(outline, dtype=float) for outline in row["outlines"]]
    except TypeError:
        return dict.fromkeys(("rms_percent", "outline_rms_percent", "hausdorff_percent"))
    found = [compare(outline, np.array(reference), row["scene"] in FREE_SIDEWAYS)
             for outline, reference in zip(outlines, references)]
    points, there, back, largest = zip(*found)
    percent = 100 / radius
    return {
        "rms_percent": percent * float(np.sqrt(np.mean(points))),
        "outline_rms_percent": percent * float(np.sqrt((np.mean(there) + np.mean(back)) / 2)),
        "hausdorff_percent": percent * float(max(largest)),
    }


def lowest_frequency(series):
    """The lowest peak of the power summed over all parts of the motion [Hz], to a thousandth of the lines' distance."""
    parts = np.array(series, dtype=float)
    time = np.linspace(-1, 1, len(parts))
    drift = np.polynomial.polynomial.polyfit(time, parts, 2)
    parts = (parts - np.polynomial.polynomial.polyval(time, drift).T) * np.hanning(len(parts))[:, None]
    padded = 16 * len(parts)
    power = (np.abs(np.fft.rfft(parts, padded, axis=0)) ** 2).sum(axis=1)
    spacing = 1 / (padded * TICK)
    first = int(LEAST_FREQUENCY / spacing)
    high = LEAST_PEAK * power[first:].max()
    for k in range(max(first, 1), len(power) - 1):
        if power[k] >= high and power[k - 1] < power[k] >= power[k + 1]:
            a, b, c = np.log(power[k - 1 : k + 2])
            return float((k + 0.5 * (a - c) / (a - 2 * b + c)) * spacing)
    return None


def percent_off(value, truth):
    return None if value is None else 100 * (value / truth - 1)


def judged_row(row, reference):
    scene = reference["scenes"][row["scene"]]
    radius = reference["disc"]["radius"]
    kept = {key: row[key] for key in ("scene", "model", "points", "start")}
    if row["scene"] == "wobble":
        frequency = lowest_frequency(row["series"])
        kept.update(rms_percent=None, frequency=frequency,
                    frequency_error_percent=percent_off(frequency, scene["frequency"]))
        kept["error_percent"] = None if frequency is None else abs(kept["frequency_error_percent"])
    else:
        kept.update(outline_errors(row, scene, radius))
        # A body that lies flat on a plate has all its points on the reference's outline; the line between them tells.
        kept["error_percent"] = kept["outline_rms_percent"]
    if len(row["outlines"]) == 1 and kept["rms_percent"] is not None:
        outline = np.array(row["outlines"][0])
        kept["area_ratio"] = area(outline) / row["rest_area"]
        kept["width_off_percent"] = percent_off(np.ptp(outline[:, 0]), np.ptp(np.array(scene["outline"])[:, 0]))
    if row["scene"] == "drop":
        for name in ("contact_time", "greatest_squash", "rebound_speed_ratio"):
            kept[name] = row[name]
            kept[name + "_off_percent"] = percent_off(row[name], scene[name])
    kept.update({key: row[key] for key in ("us_per_tick", "integrator", "substeps", "speed", "resets")})
    return kept


def judged_mesh(row, reference):
    truth = next(one for one in reference["mesh"] if (one["kind"], one["points"]) == (row["kind"], row["points"]))
    frequency = lowest_frequency(row["series"])
    judged = {"kind": row["kind"], "points": row["points"], "frequency": frequency / truth["frequency"]}
    # Where the reference was held upright, or rolls when pressed, there is nothing to compare.
    judged["sag"] = None if truth["topples"] else row["sag"] / truth["sag"]
    judged["width"] = None if truth["topples"] or truth["rolls_over"] else row["width"] / truth["width"]
    return judged


MESH_VALUES = ("sag", "width", "frequency")


def mesh_spreads(mesh):
    """Of each kind and value: (largest - least) / mean over the numbers of points, and the ratio farthest from 1."""
    spreads = []
    for kind in dict.fromkeys(row["kind"] for row in mesh):
        for value in MESH_VALUES:
            ratios = [row[value] for row in mesh if row["kind"] == kind and row[value] is not None]
            if ratios:
                spread = 100 * (max(ratios) - min(ratios)) / (sum(ratios) / len(ratios))
                farthest = max(ratios, key=lambda ratio: abs(ratio - 1))
                spreads.append({"kind": kind, "value": value, "spread_percent": spread, "counts": len(ratios),
                                "farthest_from_reference_percent": 100 * (farthest - 1)})
    return spreads


def worst(values):
    """None if one is missing: what broke is no good value."""
    values = list(values)
    return None if not values or None in values else max(values)


def within(value, most):
    return value is not None and value <= most


EXPECTED_SCENES = ("rest", "press_0.9", "press_0.75", "hang", "drop")  # of core/model/model_choice.h, and the wobble
MOST_EXPECTED_OFF = 0.2  # of what is measured, or a percent of R


def with_measured(expected, rows):
    """Errors that the automatic choice of a model goes by, and the same measured."""
    def measured(model, points):
        own = [row for row in rows if (row["model"], row["points"]) == (model, points)]
        return worst([row["rms_percent"] for row in own if row["scene"] in EXPECTED_SCENES]
                     + [row["error_percent"] for row in own if row["scene"] == "wobble"])

    return [{**one, "measured_percent": measured(one["model"], one["points"])} for one in expected]


def is_as_measured(one):
    expected, measured = one["expected_percent"], one["measured_percent"]
    return measured is not None and abs(expected - measured) <= max(1, MOST_EXPECTED_OFF * measured)


def summarize(result):
    reference = json.loads(REFERENCES.read_text(encoding="utf-8"))
    rows = [judged_row(row, reference) for row in result["rows"]]
    mesh = [judged_mesh(row, reference) for row in result["mesh"]]
    spreads = mesh_spreads(mesh)
    default = [row for row in rows if row["model"] == result["default_model"] and row["points"] == DEFAULT_POINTS]
    rms = {scene: worst(row["rms_percent"] for row in default if row["scene"] == scene) for scene in MOST_RMS_PERCENT}
    frequency = worst(row["error_percent"] for row in default if row["scene"] == "wobble")
    spread = {value: worst(s["spread_percent"] for s in spreads if s["value"] == value) for value in MESH_VALUES}
    off = {value: worst(abs(s["farthest_from_reference_percent"]) for s in spreads if s["value"] == value)
           for value in MESH_VALUES}
    targets = {f"{scene}_at_most_{most}_percent": within(rms[scene], most) for scene, most in MOST_RMS_PERCENT.items()}
    targets[f"frequency_within_{MOST_FREQUENCY_ERROR}_percent"] = within(frequency, MOST_FREQUENCY_ERROR)
    for value in MESH_VALUES:
        targets[f"mesh_{value}_spread_at_most_{MOST_MESH_SPREAD}_percent"] = within(spread[value], MOST_MESH_SPREAD)
    expected = with_measured(result["expected"], rows)
    targets["automatic_choice_expects_what_is_measured"] = all(is_as_measured(one) for one in expected)
    return rounded({
        "targets": targets,
        "default_worst_rms_percent": rms,
        "frequency_error_percent": frequency,
        "mesh_spread_percent": spread,
        "mesh_off_reference_percent": off,
        "material": {key: reference["material"][key] for key in ("E", "nu", "mass", "gravity")},
        "default_model": result["default_model"],
        "default_points": DEFAULT_POINTS,
        "company": result["company"],
        **load(),
        "expected": expected,
        "mesh_spreads": spreads,
        "mesh": mesh,
        "rows": rows,
    }, 5)


def of_start(rows):
    """One row a scene, model and number of points: where there are two starts, the worse."""
    found = {}
    for row in rows:
        key = (row["scene"], row["model"], row["points"])
        error = float("inf") if row["error_percent"] is None else row["error_percent"]
        if key not in found or error > found[key][0]:
            found[key] = (error, row)
    return [row for _, row in found.values()]


def is_unsettled(row):
    """Still moving where it should lie still, or reset on the way."""
    return row["resets"] > 0 or (row["scene"] not in MOVING and row["speed"] > STILL)


def mark_of(row):
    return "*" if is_unsettled(row) else ""


def print_table(summary):
    rows = of_start(summary["rows"])
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    for title, value in (
        ("RMS over R of the line and back, in %; wobble: frequency off, in %", "error_percent"),
        ("RMS distance of hull points alone over R, in %: the polygon's own difference left out", "rms_percent"),
    ):
        print("Outlines against the finite elements': " + title)
        print(f"  {'model':<24} {'points':>6}" + "".join(f" {scene.replace('press_', 'p. '):>9}" for scene in scenes)
              + f" {'µs at rest':>10} {'method':>20} {'n':>3}")
        for model, points in dict.fromkeys((row["model"], row["points"]) for row in rows):
            own = {row["scene"]: row for row in rows if (row["model"], row["points"]) == (model, points)}
            print(f"  {model:<24} {points:>6}"
                  + "".join(f" {number(own[scene][value], '.2f') + mark_of(own[scene]):>9}" for scene in scenes)
                  + f" {own['rest']['us_per_tick']:>10.2f} {own['rest']['integrator']:>20} {own['rest']['substeps']:>3}")
    print("  *: not at rest at the end, or had to be reset")
    print(f"  {summary['default_model']} with {summary['default_points']} points is the default; the worse of two starts, on an"
          f" edge and on a corner; time of one body among {summary['company']}, one thread")
    print("Drop: contact time, greatest squash and rebound speed off the reference's, in %")
    for row in (row for row in rows if row["scene"] == "drop"):
        values = "".join(f" {number(row[name + '_off_percent'], '+.1f'):>8}"
                         for name in ("contact_time", "greatest_squash", "rebound_speed_ratio"))
        print(f"  {row['model']:<24} {row['points']:>6}{values}")
    print(f"The same polygons, {summary['default_model']} over finite elements: the spread over numbers of points, and the"
          " farthest")
    for s in summary["mesh_spreads"]:
        ratios = " ".join(f"{row['points']}:{row[s['value']]:.3f}" for row in summary["mesh"]
                          if row["kind"] == s["kind"] and row[s["value"]] is not None)
        print(f"  {s['kind']:<8} {s['value']:<9} spread {s['spread_percent']:>6.2f} %, farthest"
              f" {s['farthest_from_reference_percent']:>+7.2f} %   {ratios}")
    print("  left out: sag and width of stars that stand on a tip, width of the L, which rolls over when pressed")
    print("What the automatic choice expects of a model, worst of its scenes in % of R (and measured)")
    for model in dict.fromkeys(one["model"] for one in summary["expected"]):
        print(f"  {model:<24}" + "".join(
            f"  {one['points']}: {one['expected_percent']:.1f} ({number(one['measured_percent'], '.1f')})"
            for one in summary["expected"] if one["model"] == model))
    print_load(summary)
    rms = ", ".join(f"{scene} {number(value, '.2f')} %" for scene, value in summary["default_worst_rms_percent"].items())
    print(f"  default: {rms}, frequency off by {number(summary['frequency_error_percent'], '.2f')} %")
    print_targets(summary)
