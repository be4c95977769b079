# SPDX-License-Identifier: MIT
"""Prints the scenes by which the field judges solvers, each with its figures, its cost, and whether a player gets what is
expected of it; and what more contact substeps buy."""

from tables_b import number

# What every row has; the rest are the figures of its scene.
COMMON = {
    "scene", "material", "bodies", "seconds", "us_per_body_step", "worst_penetration_R", "penetration_at_end_R",
    "least_area", "folded", "resets", "asleep_after_s", "energy_at_end_J", "must_be", "verdict",
}


def summarize(rows):
    """How many scenes hold, for each material."""
    materials = dict.fromkeys(row["material"] for row in rows)
    return {
        f"field_scenes_hold_{material}": "{} of {}".format(
            sum(row["verdict"] == "holds" for row in rows if row["material"] == material),
            sum(row["material"] == material for row in rows),
        )
        for material in materials
    }


def text(value):
    if value is None:
        return "never"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return number(value) if isinstance(value, float) else str(value)


def print_table(rows):
    """One line a scene with what all have, and below it its own figures."""
    print("Scenes by which the field judges solvers, of default nodes; firm, hard: with ten and a hundred times Young's modulus")
    print(f"  {'scene':<15} {'material':<8} {'bodies':>6} {'s':>5} {'µs':>6} {'deepest':>8} {'at end':>8} {'area':>6}"
          f" {'folded':>6} {'asleep':>7} {'J a body':>9}  verdict")
    for row in rows:
        print(f"  {row['scene']:<15} {row['material']:<8} {row['bodies']:>6} {row['seconds']:>5.1f}"
              f" {row['us_per_body_step']:>6.1f} {row['worst_penetration_R']:>8.4f} {row['penetration_at_end_R']:>8.4f}"
              f" {row['least_area']:>6.2f} {row['folded']:>6} {text(row['asleep_after_s']):>7}"
              f" {row['energy_at_end_J']:>9.2g}  {row['verdict']}")
        own = ", ".join(f"{key.replace('_', ' ')} {text(value)}" for key, value in row.items() if key not in COMMON)
        print(f"    {own}; must be: {row['must_be']}")
    print("  µs: a body and step while any is awake; deepest: in R, ever and at the end; area: least share of that at rest")
    for name, held in summarize(rows).items():
        print(f"  {name.replace('_', ' ')}: {held}")


def print_chart(rows):
    """Each error over contact substeps: its size, and the time of a body and step."""
    print("Errors of contacts of default nodes over contact substeps: the error, and in brackets µs a body and step")
    for kind, unit in dict.fromkeys((row["error"], row["unit"]) for row in rows):
        print(f"  {kind} [{unit}]")
        for name in dict.fromkeys(row["integrator"] for row in rows):
            curve = [row for row in rows if row["integrator"] == name and row["error"] == kind]
            points = (f"{row['contact_substeps']}: {number(row['value'], '.3g')} ({row['us_per_body_step']:.1f})" for row in curve)
            print(f"    {name:<20} {', '.join(points)}")
