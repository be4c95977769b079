# SPDX-License-Identifier: MIT
"""Sums up and prints how a pile fares in other engines, against what our own must reach."""

from tables_b import print_targets, rounded

OURS = "Soft Body 2D"
FACTOR = 8  # times fewer nanoseconds than the fastest of the others


def holds(row):
    """Whether the pile is one: no body folded, gone, or inside another."""
    return row["folded"] == row["overlapping"] == row["escaped"] == 0


def is_as_good(row, other):
    """Whether a pile is held and no worse by any measure: bodies no flatter, depths no greater."""
    return (
        holds(row)
        and row["mean_area"] >= other["mean_area"]
        and row["mean_penetration"] <= other["mean_penetration"]
        and row["worst_penetration"] <= other["worst_penetration"]
    )


def fastest_of(rows):
    return min(rows, key=lambda row: row["ns_per_body_step"], default=None)


def compare(rows):
    """The fastest of ours that is as good as the fastest of the others that hold the pile, against that one."""
    theirs = fastest_of(row for row in rows if row["engine"] != OURS and holds(row))
    ours = theirs and fastest_of(row for row in rows if row["engine"] == OURS and is_as_good(row, theirs))
    ratio = ours and theirs["ns_per_body_step"] / ours["ns_per_body_step"]
    return {
        "bodies": rows[0]["bodies"],
        "ours": ours and ours["settings"],
        "fastest": theirs and f"{theirs['engine']} {theirs['version']}, {theirs['settings']}",
        "ratio": ratio,
        "met": ratio is not None and ratio >= FACTOR,
    }


def summarize(results):
    (result,) = results.values()
    counts = dict.fromkeys(row["bodies"] for row in result["rows"])
    compared = [compare([row for row in result["rows"] if row["bodies"] == count]) for count in counts]
    return {
        "targets": {f"{FACTOR}_times_the_fastest_peer_at_{one['bodies']}_bodies": one["met"] for one in compared},
        "steps": result["steps"],
        "compared": rounded(compared),
        "rows": rounded(result["rows"]),
    }


def print_table(summary):
    print(f"A pile ten bodies high, one thread, {summary['steps']} steps of 1/60 s; areas and depths at the end")
    print(
        f"  {'':<13} {'bodies':>6} {'ns/body-step':>12} {'mean':>7} {'whole':>7} {'folded':>6} {'overlap':>7} {'gone':>4}"
        f" {'depth/R':>8} {'worst':>6} {'area':>5}"
    )
    for row in summary["rows"]:
        print(
            f"  {row['engine']:<13} {row['bodies']:>6} {row['ns_per_body_step']:>12.0f} {row['mean']:>7.0f}"
            f" {row['mean_whole']:>7.0f} {row['folded']:>6} {row['overlapping']:>7} {row['escaped']:>4}"
            f" {row['mean_penetration']:>8.4f} {row['worst_penetration']:>6.3f} {row['mean_area']:>5.2f}  {row['settings']}"
        )
    for one in summary["compared"]:
        if one["ratio"] is None:
            print(f"  {one['bodies']} bodies: none of the others holds the pile, or none of ours as well")
        else:
            print(f"  {one['bodies']} bodies: {one['ours']}: {one['ratio']:.1f} times fewer ns than {one['fastest']}")
    print_targets(summary)
