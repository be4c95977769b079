# SPDX-License-Identifier: MIT
extends RefCounted
## What a body says of its own steps and of how it will stand, in words.

const METHODS: Array[String] = [
	"automatic", "explicit Euler", "semi-implicit Euler", "midpoint", "Heun", "Runge-Kutta 4", "velocity Verlet", "XPBD",
]
const REASONS := {
	"stability": "the springs ask for it",
	"contacts": "contacts ask for more than the springs",
	"too_stiff": "too stiff for explicit steps",
	"fixed": "you have fixed it",
	"unstable": "NOT STABLE: lower stiffness or damping",
}


## Of [method SoftBody2D.get_substep_plan].
static func describe_plan(body: SoftBody2D) -> String:
	var plan := body.get_substep_plan()
	if plan.is_empty():
		return ""
	return "%s, %d substeps: %s\nmargin %.1f · frequency %d rad/s · cost %d" % [
		METHODS[plan["integrator"]], plan["substeps"], REASONS.get(plan["reason"], plan["reason"]),
		plan["stability_margin"], roundi(plan["frequency"]), roundi(plan["cost"])]


## Of [code]get_stability_report[/code], for which a copy of the body settles under its weight: not for every frame.
## Without that method, of the warnings that the scene dock shows.
static func describe_stability(body: SoftBody2D) -> String:
	if not body.has_method(&"get_stability_report"):
		var warnings := body.get_warnings()
		return "no warnings" if warnings.is_empty() else "\n".join(warnings)
	var report: Dictionary = body.call(&"get_stability_report")
	if report.is_empty():
		return ""
	var text := "lies %.1f %% lower and has lost %.1f %% of its area; %.1f µs a tick" % [
		100 * report.get("sag", 0.0), 100 * report.get("area_loss", 0.0), report.get("microseconds_per_tick", 0.0)]
	if report.get("folds", false):
		text += "\nFOLDS under its weight: at least %d N/m" % ceili(report.get("firm_stiffness", 0.0))
	return text
