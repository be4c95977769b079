# SPDX-License-Identifier: MIT
"""Sums up and prints how contacts keep their books: energy, heights, ways and rest, each beside what it must be."""

from tables_b import print_targets, rounded

# Of each figure: the scenes it is the worst of, the key in their rows, and its bound.
WORST = {
    "energy_gain_worst": (("one_in_a_box", "closed_box", "row_of_five", "two_meet"), "energy_highest", 1.01),
    "cradle_energy_worst": (("cradle",), "energy_highest", 1.01),
    "method_bounce_gap_percent": (("method_bounce",), "gap_percent", 5),
    "method_rest_gap_percent": (("method_rest",), "gap_percent", 5),
    "method_wobble_gap_percent": (("method_wobble",), "gap_percent", 5),
    "tick_bounce_gap_percent": (("tick_bounce",), "gap_percent", 3),
    "turned_scene_error_R": (("turned",), "error_R", 1e-9),
    "rolling_error_percent": (("rolling",), "error_percent", 2),
    "rolling_step_error_percent": (("rolling",), "step_error_percent", 2),
    "long_floor_leaks": (("long_floor",), "leaks", 0),
}


def counts(row):
    """Whether a bound of WORST is meant for that row: rolling polygons of 16 points have a wider one."""
    if row["scene"] == "rolling":
        return row["points"] >= 32
    return row["scene"] != "tick_bounce" or row["restitution"] == 0.8


def summarize(result):
    """The section of the result file: the worst of each kind, and all rows."""
    rows = result["rows"]
    worst = {
        name: max(row[key] for row in rows if row["scene"] in scenes and counts(row)) for name, (scenes, key, _) in WORST.items()
    }
    pulled = [row for row in rows if row["scene"].startswith("slow_") and row["friction"] == 0]
    worst["slow_start_least_way"] = min(row["way"] / row["theory"] for row in pulled)
    worst["stack_20_stands_s"] = min(row["stands_s"] for row in rows if row["scene"] == "stack" and row["high"] == 20)
    worst["collapsed_awake"] = sum(row["asleep_after_s"] is None for row in rows if row["scene"] == "collapsed")
    targets = {name: worst[name] <= bound for name, (_, _, bound) in WORST.items()}
    targets["slow_start_least_way"] = worst["slow_start_least_way"] >= 0.95
    targets["stack_20_stands_s"] = worst["stack_20_stands_s"] >= 60
    targets["collapsed_awake"] = worst["collapsed_awake"] == 0
    return {"targets": targets, **rounded(worst), "rows": rounded(rows)}


def print_table(summary):
    """Prints the worst of each kind, the rows with what they must be, and the targets."""
    for row in summary["rows"]:
        figures = {key: value for key, value in row.items() if key not in ("scene", "must_be")}
        print(f"  {row['scene']:<14} {', '.join(f'{key} {value}' for key, value in figures.items())}; must be: {row['must_be']}")
    print("\nThe worst of each kind")
    for name in (*WORST, "slow_start_least_way", "stack_20_stands_s", "collapsed_awake"):
        print(f"  {name:<28} {summary[name]}")
    print_targets(summary)
