# SPDX-License-Identifier: MIT
"""Sums up and prints what `rollback` measured of states of whole worlds, against what it must reach."""

from tables_b import rounded
from tables_c import load, print_load, print_targets

MOST_US = 500
LEAST_ROLLBACKS = 10


def summarize(result):
    awake, network = result["awake"], result["network"]
    targets = {
        f"saved_and_restored_within_{MOST_US}_us": awake["save_us"] + awake["restore_us"] <= MOST_US,
        f"{LEAST_ROLLBACKS}_rollbacks": network["rollbacks"] >= LEAST_ROLLBACKS,
        "no_mismatch": network["mismatches"] == 0,
        "sleepers_take_no_bytes": result["asleep_on_base"]["snapshot_bytes"] < awake["snapshot_bytes"] / 8,
    }
    last = {key: awake[key] for key in ("bodies", "save_us", "restore_us", "snapshot_bytes")}
    last |= {key: network[key] for key in ("ticks", "rollbacks", "mismatches")}
    return rounded({"targets": targets, **load(), **result, **last}, 4)


def print_table(summary):
    print("State of a world [µs]: saved, put back after 8 ticks; a step, and the one after it was put back")
    for name in ("awake", "asleep_on_base"):
        row = summary[name]
        print(f"  {row['bodies']} bodies {name:<15} {row['save_us']:>7.1f} {row['restore_us']:>7.1f}   {row['step_us']:>8.1f}"
              f" {row['step_after_restore_us']:>8.1f}   {row['snapshot_bytes']} bytes")
    network = summary["network"]
    print(f"Two peers over a bad network: {network['ticks']} ticks, {network['rollbacks']} rollbacks of up to {network['deepest']} ticks,"
          f" {network['replayed_ticks']} ticks stepped again, {network['stalls']} waited, {network['mismatches']} mismatches")
    print_load(summary)
    print_targets(summary)
