# SPDX-License-Identifier: MIT
"""Judges the runs of `work_precision.cpp` by the reference: errors, orders, and which method reaches an error soonest."""

import math
import multiprocessing
import os
from pathlib import Path

import numpy as np

import reference

CACHE = Path(__file__).resolve().parent.parent / "build" / "bench" / "reference"

EXPECTED_ORDERS = {
    "explicit_euler": 1,
    "semi_implicit_euler": 1,
    "midpoint": 2,
    "heun": 2,
    "runge_kutta_4": 4,
    "velocity_verlet": 2,
    "xpbd": 1,
}
# What the automatic rule runs while it can afford to: the first where there is nothing to touch, as here, the second
# beside surroundings.
DEFAULTS = ("velocity_verlet", "semi_implicit_euler")
ORDER_TOLERANCE = 0.15
# XPBD comes to its order only once its step resolves the fastest spring; it is measured and held to nothing.
WITHOUT_TARGET = ("xpbd",)
AGREEMENT = 1e-9

# Orders are fitted to the finest runs whose error is truncation alone: below LARGEST_FITTED the method's next order
# hardly bends the curve, and far above the best error that any method reaches for this body neither rounding nor the
# reference itself counts.
LARGEST_FITTED, SMALLEST_FITTED, ABOVE_BEST = 1e-2, 1e-10, 10
MOST_FITTED, LEAST_FITTED = 5, 4

BLOWN_UP = 10  # an error of so many radii is no motion of this body any more
LEVELS = [10.0**-exponent for exponent in range(1, 12)]


def errors_of(run, truth, radius):
    """Error of a run, and when it blew up. The error is the root mean square of the points' distance from the
    reference over all points and samples, in radii."""
    samples = run["samples"]
    distances = [
        math.sqrt(np.mean(np.sum((np.array(sample) - truth[i]) ** 2, axis=1))) / radius
        if np.max(np.abs(sample)) < 1e100
        else math.inf
        for i, sample in enumerate(samples)
    ]
    for i, distance in enumerate(distances):
        if not distance <= BLOWN_UP:
            return None, (i + 1) / len(truth)
    if run["blown_up_at"] is not None:
        return None, run["blown_up_at"]
    return math.sqrt(np.mean(np.square(distances))), None


def rounded(value, digits=4):
    return value if value is None else float(f"{value:.{digits}g}")


def solve_case(case_and_times):
    case, times = case_and_times
    return reference.solve_cached(case["description"], times, CACHE)


def solve_all(result):
    """The reference of every body, in as many processes as there are processors."""
    times = [(i + 1) / result["samples"] * result["simulated_seconds"] for i in range(result["samples"])]
    # The slowest first: an idle process takes the next.
    order = sorted(range(len(result["cases"])), key=lambda i: -result["cases"][i]["frequency_bound"])
    with multiprocessing.Pool(os.cpu_count()) as pool:
        solved = pool.map(solve_case, [(result["cases"][i], times) for i in order], chunksize=1)
    return {(result["cases"][i]["body"], result["cases"][i]["k"]): truth for i, truth in zip(order, solved)}


def points_of(result, truths):
    """One flat entry a run."""
    for case in result["cases"]:
        truth = truths[case["body"], case["k"]]
        for run in case["runs"]:
            error, blown_up_at = errors_of(run, truth, case["radius"])
            yield {
                "body": case["body"],
                "k": case["k"],
                "precision": result["precision"],
                "integrator": run["integrator"],
                **({"method": run["method"]} if run["method"] != run["integrator"] else {}),
                "steps": run["steps"],
                "evaluations": run["evaluations"],
                "us": rounded(run["cpu_us"]),
                "spread": rounded((run["cpu_us_most"] - run["cpu_us_least"]) / run["cpu_us"], 2),
                "error": rounded(error, 6),
                "blown_up": blown_up_at is not None,
                **({"blown_up_at": rounded(blown_up_at)} if blown_up_at is not None else {}),
            }


def curves_of(points, precision):
    """{(body, k, integrator): points by ascending steps}."""
    curves = {}
    for point in points:
        if point["precision"] == precision:
            curves.setdefault((point["body"], point["k"], point["integrator"]), []).append(point)
    return {key: sorted(curve, key=lambda point: point["steps"]) for key, curve in curves.items()}


def fitted_order(curve, best_error):
    """Least-squares slope of log error over log step, or nothing if too few points are fit for it."""
    lowest = max(SMALLEST_FITTED, ABOVE_BEST * best_error)
    good = [p for p in curve if not p["blown_up"] and lowest <= p["error"] <= LARGEST_FITTED][-MOST_FITTED:]
    if len(good) < LEAST_FITTED:
        return None
    slope, _ = np.polyfit([math.log(p["steps"]) for p in good], [math.log(p["error"]) for p in good], 1)
    return -slope


def orders_of(points):
    """Orders in double precision: of every body and stiffness, and their median."""
    curves = curves_of(points, "double")
    best_errors = {}
    for (body, k, _), curve in curves.items():
        errors = [point["error"] for point in curve if not point["blown_up"]]
        best_errors[body, k] = min([best_errors.get((body, k), math.inf), *errors])
    orders = {}
    for integrator, expected in EXPECTED_ORDERS.items():
        fits = {
            key[:2]: fitted_order(curve, best_errors[key[:2]]) for key, curve in curves.items() if key[2] == integrator
        }
        found = sorted(fit for fit in fits.values() if fit is not None)
        if not found:
            continue
        measured = float(np.median(found))
        orders[integrator] = {
            "measured": rounded(measured),
            "expected": expected,
            "least": rounded(found[0]),
            "most": rounded(found[-1]),
            "fits": len(found),
            "too_few_points": len(fits) - len(found),
            "met": None if integrator in WITHOUT_TARGET else abs(measured - expected) <= ORDER_TOLERANCE,
        }
    return orders


def cost_at(curve, level, key="us"):
    """Least cost at which the method's error is down to the level, between two runs along a straight line in
    logarithms; nothing if it never gets there."""
    last = None
    for point in curve:
        if point["blown_up"]:
            last = None
            continue
        if point["error"] <= level:
            if last is None or last["error"] <= point["error"]:
                return point[key]
            share = math.log(last["error"] / level) / math.log(last["error"] / point["error"])
            return last[key] * (point[key] / last[key]) ** share
        last = point
    return None


def front_of(points, precision):
    """For every body, stiffness and error the cheapest method, and how the defaults stand to explicit Euler."""
    curves = curves_of(points, precision)
    rows = []
    for body, k in dict.fromkeys(key[:2] for key in curves):
        for level in LEVELS:
            costs = {
                method: cost
                for method in EXPECTED_ORDERS
                if (cost := cost_at(curves.get((body, k, method), []), level)) is not None
            }
            if not costs:
                continue
            best = min(costs, key=costs.get)
            row = {"body": body, "k": k, "precision": precision, "error": level, "integrator": best}
            row["us"] = rounded(costs[best])
            row["defaults_us"] = [rounded(costs.get(method)) for method in DEFAULTS]
            if "explicit_euler" in costs:
                row["explicit_euler_over_default"] = [
                    rounded(costs["explicit_euler"] / costs.get(method, math.inf)) for method in DEFAULTS
                ]
            rows.append(row)
    return rows


def automatic_of(points):
    """What the automatic rule chose, and what explicit Euler would have to pay for the same error."""
    rows = []
    for precision in ("double", "float"):
        curves = curves_of(points, precision)
        for (body, k, integrator), (point, *_) in curves.items():
            if integrator != "automatic":
                continue
            row = {key: point[key] for key in ("body", "k", "precision", "method", "steps", "us", "error")}
            if point["error"] is not None:
                other = cost_at(curves[body, k, "explicit_euler"], point["error"])
                row["explicit_euler_us"] = rounded(other)
            rows.append(row)
    return rows


def finest_agreement(points):
    """Worst error of Runge-Kutta 4 at its finest step, over bodies and stiffnesses, in double precision."""
    finest = [curve[-1] for key, curve in curves_of(points, "double").items() if key[2] == "runge_kutta_4"]
    worst = max(finest, key=lambda point: math.inf if point["blown_up"] else point["error"])
    return {key: worst[key] for key in ("body", "k", "steps", "error")}


def summarize(results):
    """The section of the result file, from {precision: what the program measured}."""
    truths = solve_all(results["double"])
    # The float program's errors are taken against the same reference: they contain the rounding of the body itself.
    points = [point for result in results.values() for point in points_of(result, truths)]
    orders = orders_of(points)
    front = front_of(points, "double") + front_of(points, "float")
    automatic = automatic_of(points)
    agreement = finest_agreement(points)
    advantages = [row["explicit_euler_over_default"] for row in front if "explicit_euler_over_default" in row]
    least = [min(of_method) for of_method in zip(*advantages)]
    rule = [row["explicit_euler_us"] / row["us"] for row in automatic if row.get("explicit_euler_us")]
    unreached = [row for row in automatic if row["error"] is not None and row["explicit_euler_us"] is None]
    return {
        "orders": orders,
        "runge_kutta_4_at_its_finest": agreement,
        "default_against_explicit_euler": {
            "compared": len(advantages),
            "least_advantage": dict(zip(DEFAULTS, least)),
            "automatic_least_advantage": rounded(min(rule)) if rule else None,
            "automatic_where_euler_never_gets": len(unreached),
        },
        "blown_up": sum(point["blown_up"] for point in points),
        "targets": {
            "orders": all(order["met"] is not False for order in orders.values()),
            "reference": agreement["error"] is not None and agreement["error"] <= AGREEMENT,
            "default_beats_explicit_euler": min(least) >= 1 and all(ratio >= 1 for ratio in rule),
        },
        "bodies": {case["body"]: case["text"] for case in results["double"]["cases"]},
        "reference": {
            "method": "SciPy solve_ivp DOP853",
            "rtol": reference.RELATIVE_TOLERANCE,
            "atol": reference.ABSOLUTE_TOLERANCE,
        },
        "automatic": automatic,
        "front": front,
        "points": points,
    }


def text_of(value, form):
    return "–" if value is None else format(value, form)


def print_orders(section):
    print("Order of convergence in double precision (median over bodies and stiffnesses)")
    print(f"  {'integrator':<20} {'measured':>8} {'expected':>8} {'least':>7} {'most':>7} {'fits':>5}")
    for name, order in section["orders"].items():
        verdict = {None: "", True: "met", False: "MISSED"}[order["met"]]
        print(
            f"  {name:<20} {order['measured']:>8.3f} {order['expected']:>8} {order['least']:>7.3f}"
            f" {order['most']:>7.3f} {order['fits']:>5}  {verdict}"
        )


def print_costs(section, precision):
    """What an error of 1 % of the radius costs."""
    curves = curves_of(section["points"], precision)
    print(f"\nAn error of 1 % of the radius, {precision}: µs CPU and force evaluations for a simulated second")
    cases = list(dict.fromkeys(key[:2] for key in curves))
    for body in dict.fromkeys(case[0] for case in cases):
        stiffnesses = [k for name, k in cases if name == body]
        print(f"  {body + ', k =':<20}" + "".join(f"{k:>20.0e}" for k in stiffnesses))
        for method in EXPECTED_ORDERS:
            cells = []
            for k in stiffnesses:
                cost = cost_at(curves[body, k, method], 1e-2)
                work = cost_at(curves[body, k, method], 1e-2, "evaluations")
                cells.append("–" if cost is None else f"{cost:.0f} ({work:.0f})")
            print(f"  {method:<20}" + "".join(f"{cell:>20}" for cell in cells))


def print_automatic(section):
    print("\nThe automatic rule at 60 steps a second")
    print(
        f"  {'body':<16} {'k':>6} {'precision':<9} {'method':<20} {'steps':>6}"
        f" {'µs':>7} {'error/R':>9} {'explicit Euler µs':>18}"
    )
    for row in section["automatic"]:
        print(
            f"  {row['body']:<16} {row['k']:>6.0e} {row['precision']:<9} {row['method']:<20} {row['steps']:>6}"
            f" {row['us']:>7.0f} {text_of(row['error'], '9.1e'):>9} {text_of(row.get('explicit_euler_us'), '.0f'):>18}"
        )


def print_front(section):
    """Who is cheapest how often, by error."""
    print("\nCheapest method by error, as a count of bodies and stiffnesses (double)")
    rows = [row for row in section["front"] if row["precision"] == "double"]
    for level in sorted({row["error"] for row in rows}, reverse=True):
        winners = [row["integrator"] for row in rows if row["error"] == level]
        counts = sorted(((winners.count(name), name) for name in set(winners)), reverse=True)
        print(f"  {level:.0e} R  " + ", ".join(f"{name} {count}" for count, name in counts))


def print_table(section):
    print_orders(section)
    for precision in dict.fromkeys(point["precision"] for point in section["points"]):
        print_costs(section, precision)
    print_automatic(section)
    print_front(section)
    worst, default = section["runge_kutta_4_at_its_finest"], section["default_against_explicit_euler"]
    met = {True: "met", False: "MISSED"}
    print(f"\nRunge-Kutta 4 at its finest step: error {text_of(worst['error'], '.1e')} R at worst"
          f" ({worst['body']}, k = {worst['k']:.0e}); target {AGREEMENT:.0e}: {met[section['targets']['reference']]}")
    for method, advantage in default["least_advantage"].items():
        print(f"Explicit Euler needs at least {advantage:.2f} times the time of {method} for the same error,"
              f" in {default['compared']} comparisons")
    print(f"  default beats explicit Euler: {met[section['targets']['default_beats_explicit_euler']]}")
    print(f"{section['blown_up']} of {len(section['points'])} runs blew up")
