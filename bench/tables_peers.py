# SPDX-License-Identifier: MIT
"""Sums up and prints how piles fare in other engines and in ours: first of all as users get it, under the automatic choice."""

from tables_b import print_targets, rounded

OURS = "Soft Body 2D"
PEERS = ("Box2D", "Box2D 3", "Chipmunk", "Chipmunk in floats")
FACTOR = 3  # times fewer nanoseconds than the fastest of the others, by the automatic choice
MOST_NS = {100: 700, 1000: 800, 3000: 850}  # of the equal pile, one thread
MOST_RATIO = {"mixed": 1.15, "bounce": 1.3, "rigid": 1.3}  # to the equal pile
LEAST_GAIN, LEAST_WORST_GAIN = 1.85, 1.7  # of two threads
DEEPEST = 0.001  # R


def holds(row):
    """Whether the pile is one: no body folded, gone, or inside another. Of a peer's, one in a hundred may be."""
    allowed = 0 if row["engine"] == OURS else row["bodies"] / 100
    return row["folded"] == row["escaped"] == 0 and row["overlapping"] <= allowed


def fastest_of(rows):
    return min(rows, key=lambda row: row["ns_per_body_step"], default=None)


def find(rows, setting, scene, bodies):
    """Our row under that setting, one thread."""
    return next(
        row
        for row in rows
        if (row["engine"], row["setting"], row["scene"], row["bodies"]) == (OURS, setting, scene, bodies)
        and "clock" not in row
    )


def compare(rows, scene, bodies):
    """Ours against the fastest of the others that hold the pile."""
    theirs = fastest_of(
        row
        for row in rows
        if (row["scene"], row["bodies"]) == (scene, bodies) and row["engine"] != OURS and "clock" not in row and holds(row)
    )
    automatic, tuned = (find(rows, setting, scene, bodies) for setting in ("automatic", "tuned"))
    ns = automatic["ns_per_body_step"]
    return {
        "scene": scene,
        "bodies": bodies,
        "automatic": ns,
        "tuned": tuned["ns_per_body_step"],
        "fastest_peer": theirs and f"{theirs['engine']} {theirs['version']}, {theirs['settings']}",
        "peer": theirs and theirs["ns_per_body_step"],
        "peer_over_automatic": theirs and theirs["ns_per_body_step"] / ns,
        "peer_over_tuned": theirs and theirs["ns_per_body_step"] / tuned["ns_per_body_step"],
        "to_equal": ns / find(rows, "automatic", "equal", bodies)["ns_per_body_step"],
    }


def targets_of(rows, compared):
    targets = {}
    for one in compared:
        name = f"{one['scene']}_pile_of_{one['bodies']}"
        ahead = one["peer_over_automatic"]
        targets[f"automatic_{FACTOR}_times_ahead_in_the_{name}"] = ahead is not None and ahead >= FACTOR
        if one["scene"] == "equal":
            most = MOST_NS[one["bodies"]]
            targets[f"automatic_{most}_ns_in_the_{name}"] = one["automatic"] <= most
        else:
            most = MOST_RATIO[one["scene"]]
            targets[f"{name}_at_most_{most}_times_the_equal_pile"] = one["to_equal"] <= most
    ours = [row for row in rows if row["engine"] == OURS and row["setting"] == "automatic"]
    targets["automatic_holds_all_piles"] = all(holds(row) and row["worst_penetration"] <= DEEPEST for row in ours)
    for row in ours:
        if row["threads"] == 2:
            name = f"{row['bodies']}_bodies_gain_{LEAST_GAIN}_by_a_second_thread_at_worst_{LEAST_WORST_GAIN}"
            targets[name] = row["gain"] >= LEAST_GAIN and row["worst_gain"] >= LEAST_WORST_GAIN
    return targets


def summarize(results):
    (result,) = results.values()
    rows = result["rows"]
    scenes = dict.fromkeys((row["scene"], row["bodies"]) for row in rows if "clock" not in row)
    compared = [compare(rows, scene, bodies) for scene, bodies in scenes]
    built = {row["engine"] for row in rows}
    missing = [{"engine": engine, "setting": "not built"} for engine in PEERS if engine not in built]
    return {
        "targets": targets_of(rows, compared),
        "steps": result["steps"],
        "compared": rounded(compared),
        "rows": rounded(rows) + missing,
    }


def print_table(summary):
    print(f"Piles ten bodies high, {summary['steps']} steps of 1/60 s; ns a body-step once settled, one thread, processor time")
    print("  (from a tenth to nine tenths of the steps); areas and depths at the end")
    print(
        f"  {'':<18} {'setting':<13} {'pile':<6} {'bodies':>6} {'ns':>6} {'spread':>13} {'folded':>6} {'overlap':>7}"
        f" {'gone':>4} {'worst/R':>7} {'area':>5}"
    )
    for row in summary["rows"]:
        if row["setting"] == "not built":
            print(f"  {row['engine']:<18} not built")
        elif "clock" not in row:
            spread = f"{row['low']:.0f}..{row['high']:.0f}"
            print(
                f"  {row['engine']:<18} {row['setting']:<13} {row['scene']:<6} {row['bodies']:>6}"
                f" {row['ns_per_body_step']:>6.0f} {spread:>13} {row['folded']:>6} {row['overlapping']:>7}"
                f" {row['escaped']:>4} {row['worst_penetration']:>7.4f} {row['mean_area']:>5.2f}"
            )
    print("By the clock: median of the runs (best..worst run), gain by the second thread (worst)")
    for row in summary["rows"]:
        if "clock" in row:
            gain = f"{row['gain']:.2f} ({row['worst_gain']:.2f})" if row["threads"] > 1 else ""
            spread = f"({row['low']:.0f}..{row['high']:.0f})"
            print(
                f"  {row['engine']:<18} {row['setting']:<13} {row['bodies']:>6} bodies, {row['threads']} threads,"
                f" {row['runs']} runs: {row['ns_per_body_step']:>6.0f} {spread} {gain}"
            )
    for one in summary["compared"]:
        name = f"{one['scene']} pile of {one['bodies']}"
        ahead = (
            f"{one['peer_over_automatic']:.1f} times (tuned {one['peer_over_tuned']:.1f}) fewer ns than {one['fastest_peer']}"
            if one["peer"]
            else "none of the others holds it"
        )
        print(f"  {name}: automatic {one['automatic']:.0f} ns, {one['to_equal']:.2f} times the equal pile; {ahead}")
    print_targets(summary)
