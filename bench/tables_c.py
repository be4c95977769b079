# SPDX-License-Identifier: MIT
"""Sums up and prints what table-4-1, pile, scaling and contact-accuracy measured, against what they must reach."""

import math
import os

import tables_books
import tables_fields
from tables_b import number, rounded, verdict

OVERLAP_LIMIT = 0.05  # of R, as the programs count overlapping pairs
LEAST_BODIES = {  # table-4-1: (method, collisions, threads) -> bodies
    ("default", True, 2): 13200,
    ("explicit_euler", True, 2): 13200,
    ("midpoint", True, 2): 7200,
    ("runge_kutta_4", True, 2): 3600,
    ("explicit_euler", False, 1): 353400,
    ("midpoint", False, 1): 181700,
    ("runge_kutta_4", False, 1): 91200,
}
MEAN_PENETRATION = 0.005  # of R
SLEEP_WITHIN = 20  # s
SLEEP_UP_TO = 3000  # bodies
ASLEEP_SHARE = 0.02  # of the awake cost
LARGEST_EXPONENT = 1.05
LEAST_SPEEDUP = 1.7


def load():
    """How busy the machine is: figures of a busy machine are worse than its own."""
    try:
        return {"cores": os.cpu_count(), "load": [round(value, 2) for value in os.getloadavg()]}
    except OSError:
        return {"cores": os.cpu_count(), "load": None}


def print_load(section):
    if section["load"]:
        print(f"  load of the machine at the end: {section['load'][0]:g} on {section['cores']} cores")


def print_targets(section):
    """Like those of the other benchmarks; None is what cannot be judged yet."""
    for name, met in section["targets"].items():
        print(f"  target {name.replace('_', ' ')}: {'not measured' if met is None else verdict(met)}")


def percent(value, digits=3):
    return "–" if value is None else f"{100 * value:.{digits}g} %"


def all_of(rows, holds):
    return bool(rows) and all(map(holds, rows))


# --- table-4-1


def behaves(row):
    """No counted body is folded, deep in another, under ground, or had to be reset. Without collisions they overlap."""
    return all(row[fault] == 0 for fault in ("folded", "overlapping", "escaped", "resets"))


def summarize_table_4_1(result):
    targets = {}
    for (method, collisions, threads), least in LEAST_BODIES.items():
        found = [r for r in result["rows"] if (r["method"], r["collisions"], r["threads"]) == (method, collisions, threads)]
        name = f"{method}_{'with' if collisions else 'without'}_collisions_{threads}_threads_{least}"
        targets[name] = all_of(found, lambda r: r["bodies"] is not None and r["bodies"] >= least and behaves(r))
    targets["all_counted_bodies_behave"] = all_of(result["rows"], behaves)
    return {"targets": targets, **load(), **rounded(result)}


def print_table_4_1(summary):
    print(f"Thesis bodies whose step takes {summary['frame_ms']:.4g} ms, half a second and more after they have settled")
    print(f"  {'method':<16} {'collisions':<10} {'threads':>7} {'bodies':>9} {'thesis':>7} {'by least':>9} {'scheduled':>9}"
          f" {'ns a body':>9} {'folded':>6} {'overlaps':>8} {'worst in R':>10} {'area':>6}")
    for row in summary["rows"]:
        with_collisions = row["collisions"]
        print(f"  {row['method']:<16} {'with' if with_collisions else 'without':<10} {row['threads']:>7}"
              f" {number(row['bodies'], 'd'):>9} {number(row['thesis_bodies'], 'd'):>7} {row['bodies_by_least']:>9} {number(row['bodies_by_schedule'], 'd'):>9}"
              f" {row['ns_per_body_step']:>9.4g} {row['folded']:>6} {row['overlapping'] if with_collisions else '–':>8}"
              f" {percent(row['worst_penetration']) if with_collisions else '–':>10}"
              f" {percent(row['mean_area']) if with_collisions else '–':>6}")
    print("  one thread by its processor time, two by the clock; 'by least': from the fastest step instead of the median;")
    print("  'scheduled': tasks timed one by one, then dealt to two threads that have the machine for themselves")
    print("  without collisions one substep a frame; the default decides itself")
    for method in dict.fromkeys(row["method"] for row in summary["rows"]):
        for row in (r for r in summary["rows"] if r["method"] == method and r["threads"] == 1):
            s = row["settings"]
            print(f"  {method}, {'with' if row['collisions'] else 'without'}: k {s['k']:g} N/m, c {s['c']:.3g} N s/m,"
                  f" shape matching {s['shape_k']:g} N/m and {s['shape_c']:.3g} N s/m")
    print_load(summary)
    print_targets(summary)


# --- pile


def summarize_pile(result):
    rows, heavy = result["rows"], result["heavy_on_light"]
    timed = [row for row in rows if row["bodies"] <= SLEEP_UP_TO]
    asleep = [row["seconds_to_sleep"] for row in timed]
    shares = [row["asleep_ns"] / row["settled_median_ns"] for row in rows if row["asleep_ns"] is not None]
    return {
        "targets": {
            "none_folded": all_of(rows, lambda r: r["folded"] == 0),
            "no_pair_deeper_than_5_percent": all_of(rows, lambda r: r["overlapping"] == 0),
            "mean_penetration_below_half_a_percent": all_of(rows, lambda r: r["mean_penetration"] < MEAN_PENETRATION),
            "slow_within_20_s_up_to_3000": all_of(
                timed, lambda r: r["seconds_to_rest"] is not None and r["seconds_to_rest"] <= SLEEP_WITHIN
            ),
            "asleep_within_20_s_up_to_3000": all_of(
                asleep, lambda seconds: seconds is not None and seconds <= SLEEP_WITHIN
            ),
            "asleep_at_most_2_percent_of_awake": all_of(shares, lambda share: share <= ASLEEP_SHARE) if shares else None,
            "a_hundredfold_mass_neither_explodes": not heavy["ever_folded"] and heavy["resets"] == 0
            and heavy["escaped"] == 0 and heavy["highest"] < 2.2,
            "nor_sinks_through": heavy["least_distance"] > 0.5 and heavy["deepest_ever"] < OVERLAP_LIMIT,
        },
        **load(),
        **rounded(result),
    }


def print_pile(summary):
    print("Piles between side walls, one thread; penetration in radii, at the end")
    print(f"  {'bodies':>6} {'rows':>4} {'mass':>5} {'k':>6} {'n':>3} {'ns mean':>8} {'settled':>8} {'least':>7} {'worst':>8}"
          f" {'mean in R':>10} {'worst in R':>10} {'folded':>6} {'overlaps':>8} {'area':>6} {'J a body':>9} {'slow after':>10}"
          f" {'asleep':>8} {'cost':>7}")
    for row in summary["rows"]:
        rest, slept, asleep = row["seconds_to_rest"], row["seconds_to_sleep"], row["asleep_ns"]
        share = None if asleep is None else asleep / row["settled_median_ns"]
        print(f"  {row['bodies']:>6} {row['rows']:>4} {row['mass_ratio']:>5g} {row['settings']['k']:>6.4g}"
              f" {row['contact_substeps']:>3} {row['ns_per_body_step']:>8.0f} {row['settled_median_ns']:>8.0f}"
              f" {row['settled_least_ns']:>7.0f} {row['worst_ns']:>8.0f} {percent(row['mean_penetration']):>10}"
              f" {percent(row['worst_penetration']):>10} {row['folded']:>6} {row['overlapping']:>8}"
              f" {percent(row['mean_area']):>6} {row['energy_at_rest']:>9.2g}"
              f" {'never' if rest is None else f'{rest:.1f} s':>10}"
              f" {'never' if slept is None else f'{slept:.1f} s':>8} {percent(share, 2):>7}")
    heavy = summary["heavy_on_light"]
    print(f"  {heavy['mass_ratio']:g} times the mass on one light body: never closer than {heavy['least_distance']:.2f} R,"
          f" {percent(heavy['deepest_ever'])} of R deep, fastest point {heavy['fastest']:.1f} m/s, highest"
          f" {heavy['highest']:.2f} m, folded: {'yes' if heavy['ever_folded'] else 'never'}")
    print(f"  n: contact substeps a step; slow: 99 % below {summary['slow']} m/s for half a second")
    print_load(summary)
    print_targets(summary)


# --- scaling


def slope(points):
    """Of the straight line through the logarithms, by least squares."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


PHASES = ("forces_ns", "broad_phase_ns", "contacts_ns", "rest_ns")


def summarize_scaling(result):
    rows, threads = result["rows"], result["threads"]
    exponents = {
        phase: slope(points)
        for phase in PHASES[:3]
        if len(points := [(r["bodies"], r["bodies"] * r[phase]) for r in rows if r[phase]]) > 2
    }
    exponent = slope([(row["bodies"], row["median_ms"]) for row in rows])
    return {
        "targets": {
            "exponent_at_most_1.05": exponent <= LARGEST_EXPONENT,
            "two_threads_at_least_1.7_times_one": threads["speedup_by_median"] >= LEAST_SPEEDUP,
        },
        "exponent": rounded(exponent),
        "exponent_by_least": rounded(slope([(row["bodies"], row["least_ms"]) for row in rows])),
        "phase_exponents": rounded(exponents),
        **load(),
        **rounded(result),
    }


def print_scaling(summary):
    print("A step of a settled pile ten high, one thread, processor time; ns a body and step")
    print(f"  {'bodies':>7} {'ms median':>10} {'ms least':>9} {'ns':>6} {'forces':>7} {'broad':>6} {'contacts':>8} {'rest':>5}"
          f" {'pairs':>6} {'contacts a body':>15} {'steps a rebuild':>15}")
    for row in summary["rows"]:
        print(f"  {row['bodies']:>7} {row['median_ms']:>10.4g} {row['least_ms']:>9.4g} {row['ns_per_body_step']:>6.0f}"
              f" {number(row['forces_ns'], '.0f'):>7} {number(row['broad_phase_ns'], '.0f'):>6}"
              f" {number(row['contacts_ns'], '.0f'):>8} {number(row['rest_ns'], '.0f'):>5} {row['pairs_per_body']:>6.2f}"
              f" {row['contacts_per_body']:>15.1f} {number(row['steps_per_rebuild'], '.1f'):>15}")
    print("  contacts: narrow phase and response between bodies; forces include contacts with the surroundings")
    exponents = ", ".join(f"{name.removesuffix('_ns').replace('_', ' ')} {value:.3f}"
                          for name, value in summary["phase_exponents"].items())
    print(f"  time grows with bodies to the power {summary['exponent']:.3f} ({summary['exponent_by_least']:.3f} by the fastest"
          f" steps); {exponents}")
    threads = summary["threads"]
    scheduled = next((r["scheduled_speedup"] for r in reversed(summary["rows"]) if r["bodies"] <= threads["bodies"]), None)
    print(f"  two threads, {threads['bodies']} bodies: {threads['one_thread_ms']:.2f} ms to {threads['two_threads_ms']:.2f} ms,"
          f" {threads['speedup_by_median']:.2f} times; fastest steps {threads['speedup_by_least']:.2f} times;"
          f" scheduled {number(scheduled, '.2f')} times;"
          f" plain arithmetic here: {threads['arithmetic_speedup_by_median']:.2f} and"
          f" {threads['arithmetic_speedup_by_least']:.2f} times")
    beside = summary["beside_stiff"]
    print(f"  {beside['bodies']} bodies alone {beside['alone_ms']:.3g} ms, with {beside['stiff_pairs']} stiff pairs"
          f" ({beside['stiff_substeps']} substeps) elsewhere {beside['beside_ms']:.3g} ms, {beside['times']:.2f} times;"
          f" {beside['substeps_a_body']:.1f} substeps a body")
    print_load(summary)
    print_targets(summary)


# --- contact-accuracy


def summarize_contacts(result):
    books = tables_books.summarize({"rows": result.pop("books")})
    slopes, bounces, rebounds = result["slopes"], result["bounces"], result["restitutions"]
    off = max(abs(row["measured_degrees"] - row["theory_degrees"]) for row in slopes)
    return {
        "targets": {},  # the figures are charted; contact-books has the bounds of those about energy
        "largest_slope_error_degrees": rounded(off),
        "largest_momentum_change": rounded(max(row["momentum_change"] for row in bounces)),
        "largest_angular_momentum_change": rounded(max(row["angular_momentum_change"] for row in bounces)),
        "largest_energy": rounded(max(row["highest_energy"] for row in bounces)),
        "largest_restitution_shortfall": rounded(
            max(row["restitution"] - row["effective_restitution"] for row in rebounds)
        ),
        **{key: value for key, value in books.items() if key not in ("rows", "targets")},
        **tables_fields.summarize(result["field_scenes"]),
        **load(),
        **rounded(result),
    }


def print_contacts(summary):
    print("Angle at which a block begins to slide, and how fast it then gets faster, 5 degrees steeper")
    for row in summary["slopes"]:
        print(f"  {row['ground']:<12} friction {row['friction']:<4g} {row['measured_degrees']:>6.2f}° (theory"
              f" {row['theory_degrees']:.2f}°), {row['acceleration_5_degrees_steeper']:.3f} m/s² (theory"
              f" {row['acceleration_theory']:.3f}), creep at nine tenths of it {1000 * row['creep_at_90_percent']:.3f} mm/s")
    print("Height to which a soft body bounces from 1 m")
    for row in summary["restitutions"]:
        print(f"  {row['ground']:<12} restitution {row['restitution']:<5g} {row['height']:.3f} m (a rigid body"
              f" {row['theory_height']:.3f}), as if {row['effective_restitution']:.2f}")
    print("Two bodies meet at 2 m/s each")
    print(f"  {'mass':>5} {'offset':>7} {'restitution':>11} {'momentum':>10} {'angular':>10} {'energy':>7} {'highest':>8} {'speed':>6}")
    for row in summary["bounces"]:
        print(f"  {row['mass_ratio']:>5g} {row['offset']:>7g} {row['restitution']:>11g} {row['momentum_change']:>10.1e}"
              f" {row['angular_momentum_change']:>10.1e} {row['energy_after']:>7.3f} {row['highest_energy']:>8.4f}"
              f" {row['separation_over_approach']:>6.2f}")
    print("  momentum: change over that of the first body; energy with the wobble, over the start; speed: apart over towards")
    print("Penetration of a falling and settling pile of 300, in radii, and what it costs")
    print(f"  {'method':<12} {'substeps':>8} {'ms a step':>10} {'mean':>10} {'worst':>10} {'mean at end':>12} {'folded':>7} {'overlaps':>8}")
    for row in summary["penetrations"]:
        print(f"  {row['integrator']:<12} {row['contact_substeps']:>8} {row['ms_per_step']:>10.3f}"
              f" {percent(row['mean_penetration']):>10} {percent(row['worst_penetration']):>10}"
              f" {percent(row['mean_penetration_at_end']):>12} {row['folded_ever']:>7} {row['overlapping_ever']:>8}")
    print_separation_force(summary["separation_force"])
    tables_fields.print_table(summary["field_scenes"])
    tables_fields.print_chart(summary["chart"])
    print_load(summary)


def print_separation_force(section):
    print("The thesis's separation force: two undamped bodies meet at 2 m/s each")
    print(f"  {'response':<16} {'offset':>7} {'substeps':>8} {'energy':>8} {'angular':>8}")
    for row in section["bounces"]:
        print(f"  {row['response']:<16} {row['offset']:>7g} {row['substeps']:>8} {row['energy_after']:>8.3f}"
              f" {row['angular_momentum_change']:>8.4f}")
    print("  energy: after over before; angular: change of angular momentum over m v R of one body")
    print("A pile of default bodies after some time")
    print(f"  {'response':<16} {'bodies':>7} {'s':>3} {'ms a step':>10} {'J a body':>9} {'mean':>9} {'worst':>9} {'overlaps':>8}"
          f" {'folded':>7} {'resets':>7}")
    for row in section["piles"]:
        print(f"  {row['response']:<16} {row['bodies']:>7} {row['seconds']:>3} {row['ms_per_step']:>10.3f}"
              f" {row['kinetic_energy_at_end']:>9.1e} {percent(row['mean_penetration_at_end']):>9}"
              f" {percent(row['worst_penetration_at_end']):>9} {row['overlapping_at_end']:>8} {row['folded_at_end']:>7}"
              f" {row['resets']:>7}")
