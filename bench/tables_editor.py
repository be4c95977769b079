# SPDX-License-Identifier: MIT
"""Sums up and prints how long the editor addon's handlers take."""

from tables_b import print_targets, rounded

DRAG_POINTS = 256
DRAG_LIMIT_MS = 5
TRACED_SIDE = 1024
TRACE_LIMIT_MS = 500


def median(rows, what, size):
    """Of that measurement [ms], or infinity where it is missing."""
    return next((row["median_ms"] for row in rows if row["what"] == what and row["size"] == size), float("inf"))


def summarize(results):
    """The section of the result file."""
    (result,) = results.values()
    rows = result["rows"]
    drag = max(median(rows, f"{part}, {mode}", DRAG_POINTS) for part in ("mouse", "drawing") for mode in ("hull", "brush"))
    return {
        "targets": {
            f"handlers_of_{DRAG_POINTS}_points_below_{DRAG_LIMIT_MS}_ms": drag < DRAG_LIMIT_MS,
            f"tracing_{TRACED_SIDE}_below_{TRACE_LIMIT_MS}_ms": median(rows, "tracing", TRACED_SIDE) < TRACE_LIMIT_MS,
        },
        "rows": rounded(rows),
    }


def print_table(summary):
    """Prints the rows and the targets."""
    print("What the editor addon takes, in a real editor [ms]")
    print(f"  {'':<24} {'size':>6} {'median':>9} {'worst':>9}")
    for row in summary["rows"]:
        print(f"  {row['what']:<24} {row['size']:>6} {row['median_ms']:>9.2f} {row['worst_ms']:>9.2f}")
    print_targets(summary)
