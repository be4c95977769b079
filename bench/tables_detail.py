# SPDX-License-Identifier: MIT
"""Sums up and prints what `detail` measured, against what it must reach."""

from tables_b import rounded
from tables_c import all_of, load, print_load, print_targets

TOLERANCE = 3  # %
MOST_POINTS = 24
LEAST_SPEEDUP = 6
MOST_OVER_MODELLING = 2


def summarize(result):
    rows = result["rows"]
    main = next(r for r in rows if r["outline"] == "character" and r["tolerance_percent"] == TOLERANCE)
    targets = {
        f"character_of_200_at_most_{MOST_POINTS}_points_at_{TOLERANCE}_percent":
            main["points_simulated"] <= MOST_POINTS and main["outline_error_percent"] <= TOLERANCE,
        f"character_at_least_{LEAST_SPEEDUP}_times_faster": main["speedup"] >= LEAST_SPEEDUP,
        f"over_modelling_at_most_{MOST_OVER_MODELLING}": all_of(rows, lambda r: r["over_modelling_ratio"] <= MOST_OVER_MODELLING),
        "every_outline_within_its_tolerance": all_of(rows, lambda r: r["outline_error_percent"] <= r["tolerance_percent"]),
        "area_and_centroid_kept": all_of(rows, lambda r: r["area_error"] <= 1e-5 and r["centroid_error"] <= 1e-5),
    }
    head = {
        "outline_error_percent": main["outline_error_percent"],
        "points_drawn": main["points_drawn"],
        "points_simulated": main["points_simulated"],
        "speedup_at_tolerance": main["speedup"],
        "over_modelling_ratio": max(r["over_modelling_ratio"] for r in rows),
        # What changes its detail by itself while it runs is still to come.
        "largest_jump_px": None,
        "momentum_error": None,
    }
    return rounded({"targets": targets, **load(), **head, "bodies": result["bodies"], "rows": rows}, 5)


def print_table(summary):
    print(f"Outlines simulated as drawn, and by few points; {summary['bodies']} bodies in two layers, awake, one thread")
    print(f"  {'outline':<12} {'tolerance':>9} {'drawn':>5} {'simulated':>9} {'error':>7} {'settled':>8} {'as drawn':>9}"
          f" {'simulated':>9} {'faster':>7} {'over':>5} {'placing':>8} {'simplifying':>11}")
    for row in summary["rows"]:
        print(f"  {row['outline']:<12} {row['tolerance_percent']:>7.1f} % {row['points_drawn']:>5} {row['points_simulated']:>9}"
              f" {row['outline_error_percent']:>5.2f} % {row['settled_error_percent']:>6.2f} % {row['as_drawn_us']:>6.1f} us"
              f" {row['simulated_us']:>6.1f} us {row['speedup']:>5.1f} × {row['over_modelling_ratio']:>5.2f} {row['place_us']:>5.1f} us {row['simplify_ms']:>8.1f} ms")
    print("  error: distance of drawn outline and hull at rest, in both directions, of the radius of a disk of the area;"
          " settled: of the drawn outline from that of the body simulated as drawn, dropped and come to rest;"
          " us: a body a tick; over: time over that of the cheapest hull of fewer points within the tolerance; placing: the drawn points of one body in a frame")
    print_load(summary)
    print_targets(summary)
