# SPDX-License-Identifier: MIT
"""Sums up and prints what `cuts` measured, against what it must reach."""

from tables_b import rounded
from tables_c import load, print_load, print_targets

LEAST_CUTS = 1000
MOST_AREA_ERROR = 1e-5
MOST_MOMENTUM_ERROR = 1e-6
MOST_US = {16: 100, 256: 2000}


def summarize(result):
    targets = {
        f"{LEAST_CUTS}_random_cuts": result["random_cuts"] >= LEAST_CUTS,
        "no_violation": result["violations"] == 0,
        f"area_within_{MOST_AREA_ERROR:g}": result["worst_area_error"] <= MOST_AREA_ERROR,
        f"momentum_within_{MOST_MOMENTUM_ERROR:g}": result["worst_momentum_error"] <= MOST_MOMENTUM_ERROR,
    }
    for points, most in MOST_US.items():
        for model in ("springs", "modes"):
            time = next(row["cut_us"] for row in result["times"] if (row["points"], row["model"]) == (points, model))
            targets[f"{points}_points_of_{model}_within_{most}_us"] = time <= most
    return rounded({"targets": targets, **load(), **result}, 4)


def print_table(summary):
    print(f"{summary['random_cuts']} random cuts of random outlines into {summary['pieces']} pieces: {summary['violations']} violations;"
          f" {summary['refused']} more refused, {summary['missed']} missed")
    print(f"  largest error of area {summary['worst_area_error']:.2g}, of momentum {summary['worst_momentum_error']:.2g},"
          f" of mass {summary['worst_mass_error']:.2g}")
    print("Median time of a cut in two [µs]: where it goes, and with the pieces' bodies")
    for row in summary["times"]:
        print(f"  {row['points']:>4} points  {row['model']:<8} {row['plan_us']:>8.1f} {row['cut_us']:>9.1f}")
    print_load(summary)
    print_targets(summary)
