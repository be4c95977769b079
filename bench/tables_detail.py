# SPDX-License-Identifier: MIT
"""Sums up and prints what `detail` measured, against what it must reach."""

from tables_b import rounded
from tables_c import all_of, load, print_load, print_targets

TOLERANCE = 3  # %
MOST_POINTS = 24
LEAST_SPEEDUP = 6
MOST_OVER_MODELLING = 2
LEAST_CROWD_SPEEDUP = 3
MOST_JUMP = 0.25  # px at a switch that the core makes by itself
MOST_SWITCH_US = 5
MOST_MOMENTUM_ERROR = 1e-4  # the sums of a tick of a soft body are rounded by a tenth of that


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
    # Of the ways within the tolerance the fastest, with sleep as a node has it.
    crowd = [r for r in result["crowd"] if r["sleep"] and r["outline_error_percent"] <= TOLERANCE]
    crowd_speedup = max(r["speedup"] for r in crowd)
    # What the core changes by itself; what a script asks for is listed beside it.
    own = [r for r in result["levels"] if r["by"] == "the core"]
    largest_jump = max(r["jump_px"] for r in own)
    momentum_error = max(max(r["linear_momentum_error"], r["angular_momentum_error"]) for r in own)
    targets[f"crowd_at_least_{LEAST_CROWD_SPEEDUP}_times_faster"] = crowd_speedup >= LEAST_CROWD_SPEEDUP
    targets["jump_at_most_a_quarter_pixel"] = largest_jump <= MOST_JUMP
    targets["momentum_kept"] = momentum_error <= MOST_MOMENTUM_ERROR
    targets[f"switch_at_most_{MOST_SWITCH_US}_us"] = all_of(own, lambda r: r["switch_us"] <= MOST_SWITCH_US)
    head = {
        "outline_error_percent": main["outline_error_percent"],
        "points_drawn": main["points_drawn"],
        "points_simulated": main["points_simulated"],
        "speedup_at_tolerance": main["speedup"],
        "over_modelling_ratio": max(r["over_modelling_ratio"] for r in rows),
        "largest_jump_px": largest_jump,
        "momentum_error": momentum_error,
        "crowd_speedup": crowd_speedup,
    }
    lists = {"rows": rows, "levels": result["levels"], "refinement": result["refinement"], "crowd": result["crowd"]}
    return rounded({"targets": targets, **load(), **head, "bodies": result["bodies"], **lists}, 5)


def print_levels(rows):
    print("Changes of the level in motion")
    print(f"  {'outline':<12} {'from':<16} {'to':<16} {'points':>9} {'error':>8} {'jump':>9} {'momentum':>9} {'spin':>9} {'a switch':>10}")
    for row in rows:
        print(f"  {row['outline']:<12} {row['from']:<16} {row['to']:<16} {row['points_from']:>4}→{row['points_to']:<4}"
              f" {row['outline_error_percent']:>6.2f} % {row['jump_px']:>6.2f} px {row['linear_momentum_error']:>9.1e}"
              f" {row['angular_momentum_error']:>9.1e} {row['switch_us']:>7.2f} us")
    print("  error: of the new hull at rest; jump: of a drawn point at the switch; momentum and spin: what changes of them; a switch by the core is"
          " the work of a first tick beyond that of a soft one")


def print_refinement(rows):
    print("A stamp pressed into the middle of a body: drawn outline against that of 128 points")
    print(f"  {'outline':<12} {'simulated':<24} {'points':>6} {'error':>8} {'a tick':>9} {'changes':>8} {'they took':>10}")
    for row in rows:
        print(f"  {row['outline']:<12} {row['way']:<24} {row['points']:>6} {row['error_percent']:>6.2f} % {row['us']:>6.1f} us"
              f" {row['switches']:>8} {row['switch_ms']:>7.2f} ms")


def print_crowd(rows):
    print(f"A crowd of {rows[0]['bodies']} mixed bodies, a tenth near and tossed about, most of the others on shelves, a third of them drifting")
    print(f"  {'simulated':<24} {'sleep':<6} {'points a body':>13} {'error':>8} {'a tick':>10} {'faster':>8} {'flying':>7}")
    for row in rows:
        print(f"  {row['way']:<24} {'yes' if row['sleep'] else 'no':<6} {row['points_a_body']:>13.1f} {row['outline_error_percent']:>6.2f} %"
              f" {row['tick_ms']:>7.2f} ms {row['speedup']:>6.2f} × {row['flying']:>7.0f}")


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
    print_levels(summary["levels"])
    print_refinement(summary["refinement"])
    print_crowd(summary["crowd"])
    print_load(summary)
    print_targets(summary)
