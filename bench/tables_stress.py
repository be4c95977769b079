# SPDX-License-Identifier: MIT
"""Sums up and prints the stress scenes."""

from tables_b import print_targets


def summarize(results):
    (result,) = results.values()
    rows = result["rows"]
    methods = list(dict.fromkeys((row["integrator"], row["bodies"]) for row in rows))
    failed = [row for row in rows if not row["passed"]]
    return {
        "cases": len(rows),
        "passed": len(rows) - len(failed),
        "failed": [row["name"] for row in failed],
        "targets": {
            "automatic_choice_passes_all": all(
                row["passed"] for row in rows if row["integrator"] == "automatic" and row["bodies"] == "springs"
            ),
            "default_material_passes_all": all(row["passed"] for row in rows if row["bodies"] == "default_material"),
            "default_material_comes_back_from_every_seed": not any(
                row["failed"] for row in result["seeds"] if row["bodies"] == "default_material"
            ),
            "methods_keep_what_they_promise": not failed,
        },
        "methods": [
            {
                "integrator": method,
                "bodies": bodies,
                "cases": len(mine),
                "promised": sum(row["promised"] for row in mine),
                "passed": sum(row["passed"] for row in mine),
                "met_all": sum(row["met_all"] for row in mine),
            }
            for method, bodies in methods
            for mine in [[row for row in rows if (row["integrator"], row["bodies"]) == (method, bodies)]]
        ],
        "problems": [{"name": row["name"], "problems": row["problems"].rstrip("; ")} for row in failed],
        "seeds": result["seeds"],
        # Where a method promised no more than finite numbers, and more did not come of it.
        "not_promised": [
            {"name": row["name"], "problems": row["problems"].rstrip("; ")}
            for row in rows
            if row["passed"] and not row["met_all"]
        ],
    }


def print_table(summary):
    print("Stress scenes at 30, 60, 120 and 240 ticks a second")
    print(f"  {'':<20} {'bodies':<17} {'cases':>6} {'promised':>9} {'kept':>6} {'all claims met':>15}")
    for row in summary["methods"]:
        print(
            f"  {row['integrator']:<20} {row['bodies']:<17} {row['cases']:>6} {row['promised']:>9} {row['passed']:>6}"
            f" {row['met_all']:>15}"
        )
    print("Fresh starts under the automatic choice at 60 ticks a second: how many fail")
    for row in summary["seeds"]:
        print(f"  {row['scene']:<30} {row['bodies']:<17} {row['failed']:>4} of {row['seeds']}")
        for seed, problems in row["problems"].items():
            print(f"    seed {seed}: {problems.rstrip('; ')}")
    for row in summary["problems"]:
        print(f"  FAILED {row['name']}: {row['problems']}")
    print_targets(summary)


# --- soak

MOST_DRIFT = 0.1  # px
MOST_GROWTH = 16384  # bytes: lists of contacts may still find a new maximum


def summarize_soak(results):
    (result,) = results.values()
    return {
        "targets": {
            "no_drift_at_rest": result["drift_px"] < MOST_DRIFT and result["sleeping_drift_px"] == 0,
            "no_body_lost": result["lost"] == 0 and result["resets"] == 0,
            "no_growth": result["growth_bytes"] <= MOST_GROWTH,
        },
        **result,
    }


def print_soak(summary):
    print(
        f"{summary['hours']:.2g} simulated hours: drift {summary['drift_px']:.3g} px awake, {summary['sleeping_drift_px']:.3g}"
        f" px asleep, {summary['lost']} bodies lost, {summary['resets']} reset, {summary['growth_bytes']} bytes more"
    )
    print_targets(summary)
