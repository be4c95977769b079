# SPDX-License-Identifier: MIT
"""Computes every scene at several mesh sizes and writes `references.json`, the truth that the models are judged by.

    OMP_NUM_THREADS=1 python bench/fem/make_references.py [--only NAME ...]

NAME is one of rest, press, hang, wobble, arm, column, drop, unseen, mesh, law; the rest of the file is kept.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np

import scenes

OUTPUT = Path(__file__).resolve().parent / "references.json"
DISC_LEVELS = (64, 96, 128)  # border vertices; multiples of 32, so that the held part of `hang` ends at vertices
PRESS_LEVELS = (64, 96, 128)
DROP_LEVELS = ((64, 1 / 4000), (64, 1 / 8000), (96, 1 / 4000))  # border vertices, time step; the last one counts
HANG_LEVELS = ((64, 0.4), (96, 0.2), (128, 0.1))  # border vertices, edge length at the ends of the held part
ARM_LEVELS = (8.0, 5.0, 3.3)
ARM_LIGHT_LEVELS = ((8.0, 2.0), (5.0, 1.0), (4.0, 0.5))
COLUMN_LEVELS = (10.0, 6.25, 4.0)
UNSEEN_LEVELS = ((64, 5.0), (96, 3.4), (128, 2.5))  # border vertices, edge length inside
MESH_SPACING = 5.0
MESH_CHECK_SPACING = 3.5
MESH_CHECK_COUNTS = (8, 16)

CONVENTIONS = {
    "units": "px, kg, s; E in N/m of a plane (kg/s^2); frequencies in Hz",
    "axes": "x to the right, y down",
    "rest": "floor at y = 0, body above it (y < 0), centered at x = 0",
    "press": "plates at y = -+ share * R, body centered at the origin",
    "hang": "origin at the disc's center at rest; held: border nodes whose rest angle is within pi/16 of the top",
    "wobble": "lowest flexible frequencies of the free disc at rest; they come in pairs",
    "drop": "floor at y = 0; time 0 is touch-down; history rows are time, center of mass y, height / 2R, width / 2R, "
            "floor force; outline is at `time`, near the greatest squash",
    "arm": "outline as given: (0,0) (100,0) (100,40) (40,40) (40,100) (0,100); x = 0 held; its inner corner creases, "
           "which no mesh resolves: see crease_uncertainty_percent",
    "arm_light": "the arm under a quarter of gravity, where the crease does not matter",
    "column": "floor at y = 0; boxes from the lowest to the highest, centered at x = 0",
    "unseen": "an egg on its side, plates at y = -+ pressed_to * rest_height / 2, free along x; used to tune nothing",
    "mesh": "polygon as simulated; frequency of the free polygon; width: x extent over that at rest, pressed to 0.75 "
            "of its height between frictionless plates; sag: height lost over height, on a frictionless floor; "
            "topples: stands on a tip and is held upright; rolls_over: pressed below 0.88, L rolls onto its corner",
    "law_difference": "the same scenes with U(J) = -mu ln J + lambda/2 (ln J)^2 instead; outline_percent: RMS over R "
                      "between the two laws",
    "outline": "200 material points, evenly along the rest perimeter; rest_outline: the same points at rest",
    "mesh_error_percent": "finest mesh against the next coarser one: RMS of outline points over R = 50 px, in percent; "
                          "values named *_percent are differences of that value in percent of it",
}


def rms_percent(a, b):
    """Returns the RMS distance of matching outline points in percent of R."""
    return 100.0 * float(np.sqrt(((a - b) ** 2).sum(axis=1).mean())) / scenes.RADIUS


def percent(a, b):
    """Returns the relative difference in percent."""
    return 100.0 * abs(float(a) / float(b) - 1.0)


def judge(results):
    """Returns the finest result with its `mesh_error_percent` and those of the coarser meshes."""
    errors = [rms_percent(coarse["outline"], fine["outline"]) for coarse, fine in zip(results, results[1:])]
    return {**results[-1], "mesh_error_percent": errors[-1], "coarser_errors_percent": errors[:-1]}


def make_press():
    """Computes all press scenes."""
    levels = [scenes.press(n) for n in PRESS_LEVELS]
    return {name: judge([level[name] for level in levels]) for name in levels[0]}


def make_wobble():
    """Computes the frequencies and compares the lowest."""
    levels = [scenes.wobble(n)["frequencies"] for n in DISC_LEVELS]
    errors = [percent(coarse[0], fine[0]) for coarse, fine in zip(levels, levels[1:])]
    return {"frequency": levels[-1][0], "frequencies": levels[-1], "mesh_error_percent": errors[-1],
            "coarser_errors_percent": errors[:-1]}


def make_drop():
    """Computes the drop; judged by a coarser mesh, and by half the time step on the coarser mesh."""
    coarse, half, fine = (scenes.drop(n, step) for n, step in DROP_LEVELS)
    values = ("contact_time", "greatest_squash", "rebound_speed_ratio")
    result = {name: fine[name] for name in values + ("greatest_squash_time", "energy_lost_percent")}
    result.update(border_vertices=DROP_LEVELS[-1][0], step=DROP_LEVELS[-1][1])
    result["mesh_error_percent"] = rms_percent(coarse["squashed"]["outline"], fine["squashed"]["outline"])
    result["step_error_percent"] = rms_percent(coarse["squashed"]["outline"], half["squashed"]["outline"])
    for name in values:
        result[name + "_mesh_error_percent"] = percent(coarse[name], fine[name])
        result[name + "_step_error_percent"] = percent(coarse[name], half[name])
    result.update(fine["squashed"])
    result["history"] = [row for k, row in enumerate(fine["history"], 1) if k % 20 == 0]
    return result


def make_arm():
    """Computes the arm under full and under quarter gravity, and how much the crease of the first is worth."""
    result = judge([scenes.arm(spacing) for spacing in ARM_LEVELS])
    others = {"inner corner refined to 0.5 px": scenes.arm(5.0, 0.5),
              "inner corner rounded by 2 px, refined to 0.4 px": scenes.arm(5.0, 0.4, fillet=2.0),
              "inner corner rounded by 4 px, refined to 0.4 px": scenes.arm(5.0, 0.4, fillet=4.0)}
    result["tip_drop_of_variants"] = {name: other["tip_drop"] for name, other in others.items()}
    # The outline of a rounded L has other material points; the tip's share of the difference stands for the outline's.
    sharp = others["inner corner refined to 0.5 px"]
    per_px = rms_percent(result["outline"], sharp["outline"]) / abs(result["tip_drop"] - sharp["tip_drop"])
    result["crease_uncertainty_percent"] = per_px * max(abs(result["tip_drop"] - other["tip_drop"])
                                                        for other in others.values())
    light = judge([scenes.arm(spacing, least, scenes.LIGHT_GRAVITY) for spacing, least in ARM_LIGHT_LEVELS])
    return {"arm": {"gravity": scenes.GRAVITY, **result}, "arm_light": {"gravity": scenes.LIGHT_GRAVITY, **light}}


def make_column():
    """Computes the three boxes."""
    levels = [scenes.column(spacing) for spacing in COLUMN_LEVELS]
    whole = [np.concatenate([box["outline"] for box in level["boxes"]]) for level in levels]
    errors = [rms_percent(coarse, fine) for coarse, fine in zip(whole, whole[1:])]
    return {**levels[-1], "mesh_error_percent": errors[-1], "coarser_errors_percent": errors[:-1],
            "method": "conforming meshes; matching nodes pressed along the deformed face's normal, sliding freely"}


def make_mesh():
    """Computes the outlines, and some of them on a finer mesh."""
    rows, errors = [], {"frequency": 0.0, "width": 0.0, "sag": 0.0}
    for kind in scenes.KINDS:
        for count in scenes.COUNTS:
            row = scenes.outline_case(kind, count, MESH_SPACING)
            if count in MESH_CHECK_COUNTS:
                fine = scenes.outline_case(kind, count, MESH_CHECK_SPACING)
                row["mesh_error_percent"] = {name: percent(row[name], fine[name]) for name in errors}
                errors = {name: max(errors[name], row["mesh_error_percent"][name]) for name in errors}
            rows.append(row)
            numbers = (row["frequency"], row["width"], row["sag"])
            print("  %-8s %4d  %.5f Hz  width %.5f  sag %.5f" % ((kind, count) + numbers), flush=True)
    return rows, errors


def make_law():
    """Computes how much the choice of the volume energy matters: differences of "log" from "stable"."""
    result = {}
    stable, log = scenes.press(64), scenes.press(64, "log")
    for name in stable:
        result[name] = {"outline_percent": rms_percent(stable[name]["outline"], log[name]["outline"]),
                        "width_ratio": log[name]["width_ratio"], "area_ratio": log[name]["area_ratio"],
                        "outline": log[name]["outline"]}
    stable, log = scenes.rest(64), scenes.rest(64, "log")
    result["rest"] = {"outline_percent": rms_percent(stable["outline"], log["outline"]),
                      "width_ratio": log["width_ratio"], "area_ratio": log["area_ratio"], "outline": log["outline"]}
    return result


def rounded(value):
    """Returns a copy for JSON: outlines to 1e-3 px, other numbers to seven digits."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.ndim == 2:
        return [[round(float(c), 3) + 0.0 for c in row] for row in value]
    if isinstance(value, (list, tuple, np.ndarray)):
        return [rounded(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float("%.7g" % value)
    return int(value) if isinstance(value, np.integer) else value


def dump(data):
    """Returns JSON text with one line per array of numbers or points."""
    def text(value, indent):
        pad = "  " * indent
        if isinstance(value, dict):
            inner = ",\n".join('%s  %s: %s' % (pad, json.dumps(key), text(item, indent + 1))
                               for key, item in value.items())
            return "{\n%s\n%s}" % (inner, pad)
        if isinstance(value, list) and value and isinstance(value[0], dict):
            return "[\n%s\n%s]" % (",\n".join(pad + "  " + text(item, indent + 1) for item in value), pad)
        return json.dumps(value, separators=(",", ":"))
    return text(data, 0) + "\n"


MAKERS = {
    "rest": lambda: {"rest": judge([scenes.rest(n) for n in DISC_LEVELS])},
    "press": make_press,
    "hang": lambda: {"hang": judge([scenes.hang(n, least) for n, least in HANG_LEVELS])},
    "wobble": lambda: {"wobble": make_wobble()},
    "arm": make_arm,
    "column": lambda: {"column": make_column()},
    "drop": lambda: {"drop": make_drop()},
    "unseen": lambda: {"unseen": judge([scenes.egg(n, spacing) for n, spacing in UNSEEN_LEVELS])},
}
SCENE_ORDER = ("rest", "press_0.9", "press_0.75", "press_0.5", "press_0.3", "hang", "wobble", "drop", "arm",
               "arm_light", "column", "unseen")


def main():
    names = list(MAKERS) + ["mesh", "law"]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=names, default=names)
    only = parser.parse_args().only
    data = json.loads(OUTPUT.read_text()) if OUTPUT.exists() else {}
    seconds = dict(data.get("seconds", {}))
    results = dict(data.get("scenes", {}))
    for name in names:
        if name not in only:
            continue
        print(name, flush=True)
        start = time.perf_counter()
        if name == "mesh":
            rows, errors = make_mesh()
            data["mesh"], data["mesh_family_error_percent"] = rounded(rows), rounded(errors)
        elif name == "law":
            data["law_difference"] = rounded(make_law())
        else:
            results.update(rounded(MAKERS[name]()))
        seconds[name] = round(time.perf_counter() - start, 1)
        print("  %.1f s" % seconds[name], flush=True)

        material = scenes.Material(scenes.YOUNG, scenes.POISSON)
        head = {"made_by": "bench/fem/make_references.py", "conventions": CONVENTIONS,
                "material": {"E": scenes.YOUNG, "nu": scenes.POISSON, "mass": scenes.MASS, "gravity": scenes.GRAVITY,
                             "mu": material.mu, "lambda": material.lame, "bulk": material.bulk,
                             "law": "mu/2 (F:F - 2) - mu (J - 1) + bulk/2 (J - 1)^2"},
                "disc": {"radius": scenes.RADIUS, "drop_speed": scenes.DROP_SPEED}}
        data = {**head, "scenes": {key: results[key] for key in SCENE_ORDER if key in results},
                **{key: data[key] for key in ("mesh", "mesh_family_error_percent", "law_difference") if key in data},
                "seconds": seconds}
        OUTPUT.write_text(dump(rounded(data)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
