# SPDX-License-Identifier: MIT
"""Sums up and prints how many nodes the engine holds at 60 ticks per second, and where their time goes."""

from tables_b import print_targets, rounded

BUDGET_USEC = 1e6 / 60
HELD_HEADLESS = 4000  # awake, colliding
HELD_DRAWN = 1000
FACTOR = 20  # times what rigid points and spring joints hold
CROWD_USEC = 10_000  # in which 1,000 nodes are added, or freed
PARTS = ("prepare", "surroundings", "simulate", "finish", "proxies")
NAMES = {
    "soft": "as it comes",
    "soft_unseen": "without proxy",
    "soft_apart": "without soft-soft collisions",
    "soft_alone": "without collisions",
    "soft_monitored": "with contact monitor",
    "soft_asleep": "asleep",
    "soft_resting": "asleep from the start",
    "soft_off_screen": "off-screen",
    "soft_off_screen_still": "off-screen, not simulated",
    "rigid": "rigid points and spring joints",
}


def held(rows, load, drawn):
    """How many of that load one tick holds, or None where it was not measured."""
    return next((row["bodies"] for row in rows if row.get("hold") == load and row["drawn"] == drawn), None)


def best_held(rows, drawn):
    """Of the colliding loads, seen by the engine or not."""
    return max((held(rows, load, drawn) or 0 for load in ("soft", "soft_unseen")), default=0)


def cost(row):
    """Where a node's time goes in a tick [µs]: the parts of the step, and what the engine does besides, drawing included."""
    count = row["bodies"]
    parts = {part: row.get(part, 0) / count for part in PARTS}
    return {
        "load": row["cost"],
        "drawn": row["drawn"],
        "bodies": count,
        "awake": row["awake"],
        "usec_a_node": row["tick"] / count,
        **parts,
        "engine": (row["tick"] - row["step"]) / count,
    }


def drawing(row):
    """What our part of drawing costs a frame [µs]: for each body that was brought up to date, or for each that rests."""
    count = row["draw_count"] if row["draw_count"] >= 1 else row["bodies"]
    return {
        "load": row["cost"],
        "bodies": row["bodies"],
        "updated": row["draw_count"],
        "usec_a_frame": row["draw"],
        "usec_a_body": row["draw"] / count,
    }


def summarize(results):
    """The section of the result file."""
    (result,) = results.values()
    rows = result["rows"]
    loads = [load for load in NAMES if held(rows, load, False) is not None]
    counts = [{"load": load, "headless": held(rows, load, False), "drawn": held(rows, load, True)} for load in loads]
    rigid = held(rows, "rigid", False) or 0
    targets = {
        f"{HELD_HEADLESS}_awake_colliding_headless": best_held(rows, False) >= HELD_HEADLESS,
        f"{HELD_DRAWN}_drawn": best_held(rows, True) >= HELD_DRAWN,
        f"{FACTOR}_times_rigid_points": rigid > 0 and best_held(rows, False) >= FACTOR * rigid,
    }
    for row in rows:
        if loads and row.get("crowd") == 1000:
            targets["1000_nodes_added_in_10_ms"] = row["add_usec"] <= CROWD_USEC
            targets["1000_nodes_freed_in_10_ms"] = row["free_usec"] <= CROWD_USEC
    return {
        "targets": targets if loads else {},
        "threads": max((row.get("threads", 0) for row in rows), default=0),
        "held": counts,
        "costs": rounded([cost(row) for row in rows if "cost" in row]),
        "drawing": rounded([drawing(row) for row in rows if "cost" in row and row["drawn"]]),
        "crowds": [row for row in rows if "crowd" in row],
    }


def print_table(summary):
    """Prints both tables and the targets."""
    print(f"Nodes that hold 60 ticks per second, piled four high on a floor, {summary['threads']} threads")
    print(f"  {'':<32} {'headless':>9} {'drawn':>9}")
    for row in summary["held"]:
        print(f"  {NAMES[row['load']]:<32} {row['headless']:>9} {row['drawn'] if row['drawn'] is not None else '':>9}")
    print("\nMicroseconds a node and tick")
    columns = "".join(f" {part:>12}" for part in (*PARTS, "engine"))
    print(f"  {'':<32} {'':>8} {'nodes':>6} {'awake':>6} {'all':>7}{columns}")
    for row in summary["costs"]:
        parts = "".join(f" {row[part]:>12.3f}" for part in (*PARTS, "engine"))
        print(
            f"  {NAMES[row['load']]:<32} {'drawn' if row['drawn'] else 'headless':>8} {row['bodies']:>6} {row['awake']:>6}"
            f" {row['usec_a_node']:>7.2f}{parts}"
        )
    print("\nOur part of drawing: microseconds a frame, and a body of it")
    for row in summary["drawing"]:
        print(
            f"  {NAMES[row['load']]:<32} {row['bodies']:>6} bodies, {row['updated']:>6.0f} updated: {row['usec_a_frame']:>8.1f}"
            f" {row['usec_a_body']:>8.4f}"
        )
    for row in summary["crowds"]:
        print(
            f"{row['crowd']} nodes: added in {row['add_usec'] / 1000:.1f} ms (the first time {row['first_add_usec'] / 1000:.1f}),"
            f" their first two ticks {row['first_ticks_usec'] / 1000:.1f} ms, freed in {row['free_usec'] / 1000:.1f} ms,"
            f" {row['bytes_a_node'] / 1024:.1f} KiB each"
        )
    print_targets(summary)
