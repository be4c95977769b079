# SPDX-License-Identifier: MIT
"""Sums up and prints what `heap` measured, against what it must reach."""

from tables_b import number, rounded
from tables_c import all_of, load, print_load, print_targets

LEAST_AREA = 0.5
SLEEP_WITHIN = 20  # s
MOST_OVER_FIRM = 1.3
MOST_CRUSHED_OVER_FIRM = 4
CRUSHED_BODIES = 1000
CRUSHED_ROWS = 25


def mean_of(rows, value):
    return sum(row[value] for row in rows) / len(rows) if rows else None


def over_firm(rows):
    """Of each size of heap: the mean step of other firmnesses over that of firm bodies, over all seeds."""
    found = []
    heaps = [row for row in rows if row["scene"] == "heap"]
    for bodies, high in dict.fromkeys((row["bodies"], row["rows_high"]) for row in heaps):
        def steps(firmness):
            return mean_of([r for r in heaps if (r["bodies"], r["rows_high"], r["firmness"]) == (bodies, high, firmness)],
                           "mean_step_ms")

        firm = steps("firm")
        for firmness in ("default", "soft"):
            if firm and steps(firmness):
                found.append({"bodies": bodies, "rows_high": high, "firmness": firmness,
                              "step_over_firm": steps(firmness) / firm})
    return found


def summarize(result):
    rows = result["rows"]
    ratios = over_firm(rows)
    default = [row for row in rows if row["scene"] == "heap" and row["firmness"] == "default"]
    shaped = [row for row in rows if row["scene"].startswith(("concave", "mixed"))]
    soft = [r for r in ratios if r["firmness"] == "soft" and (r["bodies"], r["rows_high"]) == (CRUSHED_BODIES, CRUSHED_ROWS)]
    targets = {
        "default_none_folded": all_of(default, lambda r: r["folded"] == 0),
        f"default_least_area_{LEAST_AREA}": all_of(default, lambda r: r["least_area"] >= LEAST_AREA),
        f"default_asleep_within_{SLEEP_WITHIN}_s": all_of(
            default, lambda r: r["asleep_after_s"] is not None and r["asleep_after_s"] <= SLEEP_WITHIN),
        f"default_step_at_most_{MOST_OVER_FIRM}_times_firm": all_of(
            [r for r in ratios if r["firmness"] == "default"], lambda r: r["step_over_firm"] <= MOST_OVER_FIRM),
        f"crushed_{CRUSHED_BODIES}_at_most_{MOST_CRUSHED_OVER_FIRM}_times_firm":
            soft[0]["step_over_firm"] <= MOST_CRUSHED_OVER_FIRM if soft else None,
        "concave_and_mixed_none_folded": all_of(shaped, lambda r: r["folded"] == 0),
        "trial_none_ruined": all_of([r for r in rows if r["scene"] == "trial"], lambda r: r["ruined"] == 0),
        "no_body_reset": all_of(rows, lambda r: r["resets"] == 0),
    }
    return rounded({"targets": targets, **load(), **{k: v for k, v in result.items() if k != "rows"},
                    "over_firm": ratios, "rows": rows}, 5)


def print_table(summary):
    print(f"Heaps of nodes at their defaults between walls, one thread; a seed moves each by up to {summary['jitter_px']:g} px")
    print(f"  {'scene':<13} {'bodies':>6} {'high':>4} {'firmness':<8} {'seed':>4} {'folded':>6} {'crossed':>7} {'ruined':>6}"
          f" {'least area':>10}"
          f" {'ever':>6} {'mean':>5} {'asleep':>8} {'ms a step':>9} {'worst':>7} {'px high':>7} {'resets':>6}")
    for row in (row for row in summary["rows"] if not row["scene"].startswith("model ")):
        asleep = row["asleep_after_s"]
        asleep = f"not in {row['simulated_s']:.0f}" if asleep is None else f"{asleep:.1f} s"
        print(f"  {row['scene']:<13} {row['bodies']:>6} {row['rows_high']:>4} {row['firmness']:<8} {row['seed'] or '–':>4}"
              f" {row['folded']:>6} {row['crossed']:>7} {row['ruined']:>6} {row['least_area']:>10.2f}"
              f" {row['least_area_ever']:>6.2f}"
              f" {row['mean_area']:>5.2f} {asleep:>9} {row['mean_step_ms']:>8.3f} {row['worst_step_ms']:>7.2f}"
              f" {row['height_px']:>7.0f} {row['resets']:>6}")
    print(f"  folded: crossed, or below {summary['crushed']:g} of its area; crossed: its outline meets itself; ruined: below 0.6;"
          " ms a step: until all sleep;"
          f" firm: {summary['firm_times']:g} times the default's modulus; soft: the old network, 100 N/m")
    print("What models cost a body a tick in a heap of 100, ten high, awake [µs]; default material, and ten times as firm")
    costs = {(r["scene"], r["points"], r["firmness"]): 1e3 * r["mean_step_ms"] / r["bodies"]
             for r in summary["rows"] if r["scene"].startswith("model ")}
    for scene, points in dict.fromkeys((scene, points) for scene, points, _ in costs):
        print(f"  {scene.removeprefix('model '):<24} {points:>3} points"
              + "".join(f" {costs[scene, points, firmness]:>7.2f}" for firmness in ("default", "firm")))
    for r in summary["over_firm"]:
        print(f"  {r['bodies']} bodies {r['rows_high']} high: a step of {r['firmness']} ones takes"
              f" {number(r['step_over_firm'], '.2f')} times that of firm ones")
    print_load(summary)
    print_targets(summary)
