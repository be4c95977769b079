# SPDX-License-Identifier: MIT
"""Sums up and prints what `dents` measured, of dents and of cuts, against what it must reach."""

from tables_b import rounded
from tables_c import load, print_load, print_targets

MOST_SPREAD = 5  # %
MOST_TWIN_ERROR = 1  # %
MOST_UNDENTED_RATIO = 1.01
MOST_REST_AREA_ERROR = 1e-5
LEAST_CUTS = 1000
MOST_AREA_ERROR = 1e-5
MOST_MOMENTUM_ERROR = 1e-6
MOST_US = {16: 100, 256: 2000}


def summarize(result):
    targets = {
        f"dents_within_{MOST_SPREAD}_percent_over_ticks": result["dent_spread_over_ticks_percent"] <= MOST_SPREAD,
        f"elastic_twins_within_{MOST_TWIN_ERROR}_percent": result["elastic_twin_error_percent"] <= MOST_TWIN_ERROR,
        "undented_bodies_pay_nothing": result["undented_step_ratio"] <= MOST_UNDENTED_RATIO,
        "no_dented_body_folded": all(row["folded"] == 0 for row in result["drops"]),
        "dents_keep_area": all(row["rest_area_error"] <= MOST_REST_AREA_ERROR for row in result["drops"]),
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
    print("Dents of a disc of 100 px after a drop, at 30, 60, 120 and 240 ticks per second")
    for row in summary["drops"]:
        spread = f"{row['spread_percent']:>6.1f} %" if "spread_percent" in row else "  small"
        print(f"  {row['model']:<24} yield {row['yield']:<5g} {row['height_px']:>5.0f} px  "
              + " ".join(f"{dent:.4f}" for dent in row["dents"]) + spread)
    print("Elastic twins, off their shape [% of the radius]")
    for row in summary["elastic_twins"]:
        print(f"  {row['model']:<24} {row['height_px']:>5.0f} px  {row['error_percent']:.3g}")
    undented = summary["undented"]
    print(f"Undented: {undented['questions_us']:.2f} of {undented['step_us']:.0f} µs a step of {undented['bodies']} bodies ask about dents;"
          f" strained below the yield, a step takes {summary['unreached_step_ratio']:.3f} of one that asks nothing")
    print(f"{summary['random_cuts']} random cuts of random outlines into {summary['pieces']} pieces: {summary['violations']} violations;"
          f" {summary['refused']} more refused, {summary['missed']} missed")
    print(f"  largest error of area {summary['worst_area_error']:.2g}, of momentum {summary['worst_momentum_error']:.2g},"
          f" of mass {summary['worst_mass_error']:.2g}")
    print("Median time of a cut in two [µs]: where it goes, and with the pieces' bodies")
    for row in summary["times"]:
        print(f"  {row['points']:>4} points  {row['model']:<8} {row['plan_us']:>8.1f} {row['cut_us']:>9.1f}")
    print("Median time of a tear in two: the check before it, and where it goes [µs]")
    for row in summary["tears"]:
        print(f"  {row['points']:>4} points  {row['check_us']:>8.2f} {row['tear_us']:>9.1f}")
    print_load(summary)
    print_targets(summary)
