# SPDX-License-Identifier: MIT
"""Sums up and prints what stability, energy, recovery and auto measured, against what they must reach."""

import math

LIMIT_TOLERANCE = 0.01  # of the undamped stability limit in hω
HELD_TO_LIMIT = ("semi_implicit_euler", "velocity_verlet", "runge_kutta_4")
MOST_OVER_MODELLING = 2.0  # mean ratio of chosen to cheapest safe substeps


def rounded(value, digits=6):
    """Numbers as a result file needs them; other values stay."""
    if isinstance(value, float) and math.isfinite(value):
        return float(f"{value:.{digits}g}")
    if isinstance(value, dict):
        return {key: rounded(item, digits) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item, digits) for item in value]
    return value


def verdict(met):
    return "met" if met else "MISSED"


def print_targets(section):
    for name, met in section["targets"].items():
        print(f"  target {name.replace('_', ' ')}: {verdict(met)}")


def number(value, form=".4g"):
    return "–" if value is None else format(value, form)


# --- stability


def deviation(limit):
    """How far the measured undamped limit in hω lies from theory, as a share; hω goes with the root of k."""
    return abs(math.sqrt(limit["k_measured"] / limit["k_theory"]) - 1)


def agrees(limit):
    """Within the tolerance of theory; where theory has no stable step or no limit, none must be measured either."""
    if limit["unbounded"] or not limit["k_theory"]:
        return limit["k_measured"] == limit["k_theory"]
    return limit["k_measured"] is not None and deviation(limit) <= LIMIT_TOLERANCE


def wrong_cells(result):
    """Cells of the map that measured and theoretical growth put on different sides of stability."""
    return [cell for cell in result["map"] if cell["stable"] != (cell["growth_theory"] <= 1.001)]


def summarize_stability(result):
    limits = result["limits"]
    held = [limit for limit in limits if limit["integrator"] in HELD_TO_LIMIT]
    xpbd = [entry for entry in result["theory"] + limits if entry["integrator"] == "xpbd"]
    return {
        "targets": {
            "undamped_limits_within_1_percent": all(map(agrees, held)),
            "unstable_methods_found_unstable": all(agrees(limit) for limit in limits if not limit["k_theory"]),
            # A single spring. That a whole body stays bounded is for `auto` to show: its springs are swept in turn.
            "xpbd_bounded_for_every_k_of_one_spring": all(entry["unbounded"] for entry in xpbd),
        },
        "largest_deviation": rounded(max(deviation(limit) for limit in held)),
        "cells_against_theory": len(wrong_cells(result)),
        **rounded(result),
    }


def print_stability(summary):
    print("Largest stable stiffness without damping, two masses of 1 and 0.25 kg on one spring")
    print(f"  {'integrator':<20} {'step':>8} {'k measured':>12} {'k theory':>12}")
    for limit in summary["limits"]:
        step = f"1/{round(1 / limit['dt'])} s"
        if limit["unbounded"]:
            print(f"  {limit['integrator']:<20} {step:>8} {'every':>12} {'every':>12}")
        elif not limit["k_theory"]:
            print(f"  {limit['integrator']:<20} {step:>8} {number(limit['k_measured']):>12} {'none':>12}")
        else:
            print(
                f"  {limit['integrator']:<20} {step:>8} {limit['k_measured']:>12.6g} {limit['k_theory']:>12.6g}"
                f"  {100 * deviation(limit):.3f} % in hω"
            )
    zetas = sorted({limit["zeta"] for limit in summary["theory"]})
    print("\nLargest stable hω by damping ratio ζ: measured (theory)")
    print(f"  {'integrator':<20}" + "".join(f"{f'ζ = {zeta:g}':>16}" for zeta in zetas))
    for name in dict.fromkeys(limit["integrator"] for limit in summary["theory"]):
        cells = {limit["zeta"]: limit for limit in summary["theory"] if limit["integrator"] == name}
        texts = (
            "every" if cells[zeta]["unbounded"]
            else f"{cells[zeta]['h_omega_measured']:.3f} ({cells[zeta]['h_omega_limit']:.3f})"
            for zeta in zetas
        )
        print(f"  {name:<20}" + "".join(f"{text:>16}" for text in texts))
    print(f"\n  {summary['cells_against_theory']} of {len(summary['map'])} cells of the map contradict theory")
    print_targets(summary)


# --- energy


def drift(run):
    """Energy at the end over the start; infinite when the run blew up."""
    return math.inf if run["blown_up"] else run["series"][-1][1]


def summarize_energy(result):
    runs = result["runs"]
    undamped = [run for run in runs if not run["damped"]]
    kept = {
        name: {
            "runs": len(of_name),
            "blown_up": sum(run["blown_up"] for run in of_name),
            "largest_drift": rounded(
                max((abs(drift(run) - 1) for run in of_name if not run["blown_up"]), default=None)
            ),
        }
        for name in dict.fromkeys(run["integrator"] for run in undamped)
        if (of_name := [run for run in undamped if run["integrator"] == name])
    }
    return {
        "targets": {},  # drift is charted; no figure is prescribed for it
        "undamped": kept,
        "blown_up": sum(run["blown_up"] for run in runs),
        **rounded(result),
    }


def print_energy(summary):
    runs = summary["runs"]
    rates = sorted({round(1 / run["dt"]) for run in runs})
    for damped in (False, True):
        for stiffness in sorted({run["k"] for run in runs}):
            what = "light damping" if damped else "no damping"
            print(f"Energy after {summary['seconds']} s over its start, k = {stiffness:g} N/m, {what}; steps a second:")
            print(f"  {'integrator':<20}" + "".join(f"{rate:>12}" for rate in rates))
            for name in dict.fromkeys(run["integrator"] for run in runs):
                texts = []
                for rate in rates:
                    (run,) = (
                        r for r in runs
                        if (r["integrator"], r["damped"], r["k"], round(1 / r["dt"])) == (name, damped, stiffness, rate)
                    )
                    blown = f"up {run['series'][-1][0]:.1f} s"
                    texts.append(blown if run["blown_up"] else number(drift(run), ".3g"))
                print(f"  {name:<20}" + "".join(f"{text:>12}" for text in texts))
            print()
    print(f"  {summary['blown_up']} of {len(runs)} runs blew up")


# --- recovery


def summarize_recovery(result):
    rows = result["rows"]
    default = [row for row in rows if row["model"] == result["default_model"]]
    models = {
        model: {
            "starts": sum(row["starts"] for row in rows if row["model"] == model),
            "recovered": sum(row["recovered"] for row in rows if row["model"] == model),
        }
        for model in dict.fromkeys(row["model"] for row in rows)
    }
    return {
        "targets": {
            "default_model_always_recovers": bool(default) and all(row["recovered"] == row["starts"] for row in default)
        },
        "models": models,
        "non_finite": sum(row["non_finite"] for row in rows),
        **rounded(result),
    }


def print_recovery(summary):
    rows = summary["rows"]
    counts = sorted({row["hull_points"] for row in rows})
    starts = rows[0]["starts"]
    print(f"Bodies of {starts} that found back to their shape within {summary['seconds']:g} s; (m: left mirrored)")
    width = max(len(row["model"]) for row in rows)
    print(f"  {'hull points':<{width}}" + "".join(f"{count:>13}" for count in counts))
    for model in dict.fromkeys(row["model"] for row in rows):
        texts = []
        for count in counts:
            (row,) = (r for r in rows if r["model"] == model and r["hull_points"] == count)
            mirrored = f" (m {row['mirrored_left']})" if row["mirrored_left"] else ""
            texts.append(f"{row['recovered']}{mirrored}")
        mark = "  default" if model == summary["default_model"] else ""
        print(f"  {model:<{width}}" + "".join(f"{text:>13}" for text in texts) + mark)
    print(f"  {summary['non_finite']} runs became non-finite")
    print_targets(summary)


# --- auto


def summarize_auto(result):
    """Every seed for itself: a mean over seeds could hide one that fails."""
    seeds = result["seeds"]
    ratios = [seed["over_modelling_ratio"]["mean"] for seed in seeds]
    return {
        "targets": {
            "none_non_finite": all(seed["free"]["non_finite"] == 0 for seed in seeds),
            "none_above_twice_the_energy": all(seed["free"]["energy_above_2x"] == 0 for seed in seeds),
            "safe_plans_are_safe_near_rest": all(row["failed_near_rest"] == 0 for row in result["safety"]),
            "mean_over_modelling_at_most_2": all(ratio is not None and ratio <= MOST_OVER_MODELLING for ratio in ratios),
        },
        "bodies": sum(seed["bodies"] for seed in seeds),
        **{
            f"{scene}_{count}": sum(seed[scene][count] for seed in seeds)
            for scene in ("free", "ground")
            for count in ("non_finite", "energy_above_2x")
        },
        "worst_over_modelling_ratio": rounded(max(ratios, default=None, key=lambda ratio: ratio or math.inf)),
        **rounded(result),
    }


def print_statistics(name, values):
    print(
        f"  {name:<44} {values['count']:>6} {number(values['mean'], '.2f'):>7} {number(values['median'], '.2f'):>7}"
        f" {number(values['p95'], '.2f'):>7}"
    )


def print_auto(summary):
    print(f"{summary['bodies']} random bodies, crumpled, {summary['seconds']:g} s at 60 steps a second")
    for seed in summary["seeds"]:
        print(f"Seed {seed['seed']}{', by which the budget was chosen' if seed['tuned'] else ''}: {seed['bodies']} bodies")
        for scene, name in (("free", "free"), ("ground", "on the ground")):
            tally = seed[scene]
            models = ", ".join(f"{model} {count['failed']}" for model, count in tally["by_model"].items())
            print(
                f"  {name + ', above twice their energy':<44} {tally['energy_above_2x']:>6}   ({models};"
                f" {tally['non_finite']} non-finite)"
            )
            for failure in tally["failures"][:10]:
                print(
                    f"    body {failure['body']}: {failure['model']}, {failure['hull_points']} hull points,"
                    f" {'XPBD' if failure['xpbd'] else 'explicit'}, {failure['substeps']:.3g} substeps,"
                    f" energy × {number(failure['highest'])}"
                )
        print(f"  {'':<44} {'bodies':>6} {'mean':>7} {'median':>7} {'p95':>7}")
        print_statistics("substeps chosen", seed["substeps"])
        print_statistics("cheapest safe substeps", seed["cheapest_substeps"])
        print_statistics("over-modelling: chosen / cheapest", seed["over_modelling_ratio"])
        print_statistics("over-modelling of bodies that went to XPBD", seed["xpbd_over_modelling_ratio"])
    print("Bodies whose plan is called safe, of which passed twice their energy: nudged, crumpled")
    for row in summary["safety"]:
        print(
            f"  {row['integrator']:<20} damping ratio from {row['least_damping']:g}: {row['called_safe']:>5} of"
            f" {row['bodies']}, {row['failed_near_rest']}, {row['failed_crumpled']}"
        )
    print("Jellies dropped on flat ground and into a funnel, of which came to rest within 12 s, after a mean of")
    for row in summary["rest"]:
        print(
            f"  {row['integrator']:<20} {row['at_rest']:>4} of {row['bodies']}, {number(row['mean_time'], '.2f')} s;"
            f" then moving at {number(row['mean_speed'], '.3f')} px/s on average"
        )
    print_targets(summary)
