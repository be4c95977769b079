# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Reads a stability report (`SoftBody2D.get_stability_report`): what is green, amber or red, and what to do about it.
## Nothing is calculated here: all figures are the core's.

enum Level { GOOD, FAIR, BAD }

## Shares of a physics tick that one body may take.
const FAIR_SHARE := 0.01
const BAD_SHARE := 0.1
## Share of its height that a body may sag before a designer would see it.
const FAIR_SAG := 0.1
const FAIR_MARGIN := 1.5
const XPBD := 7
## As SoftBody2D.ELASTIC_MODEL_*.
const MODEL_NAMES: Array[String] = ["", "spring network", "springs", "springs, shape", "springs, shape, area", "elastic modes",
	"elastic triangles"]


## One figure of the panel.
class Row:
	var title: String
	var text: String
	var level: Level
	var hint: String

	func _init(p_title: String, p_text: String, p_level: Level, p_hint: String) -> void:
		title = p_title
		text = p_text
		level = p_level
		hint = p_hint


## Something to do: properties of the node (or of its material) and their new values.
class Advice:
	var text: String
	var changes: Dictionary

	func _init(p_text: String, p_changes: Dictionary) -> void:
		text = p_text
		changes = p_changes


## `say` translates; `tick` is the length of a physics tick in seconds.
static func rows(report: Dictionary, tick: float, say: Callable) -> Array[Row]:
	var found: Array[Row] = []
	if report.is_empty():
		return found
	var reason: String = report["reason"]
	var stiff := reason == "too_stiff"
	var unstable: bool = not report["safe"]
	found.append(Row.new(say.call("Frequency"), say.call("%s Hz") % number(report["frequency"] / TAU),
			Level.BAD if unstable else (Level.FAIR if stiff else Level.GOOD),
			say.call("An upper bound of the body's fastest oscillation. It grows with the square root of stiffness over the mass of a point.")))
	found.append(Row.new(say.call("Substeps"), say.call("%d (%s)") % [report["substeps"], say.call(reason_text(reason))],
			Level.BAD if unstable else (Level.FAIR if stiff
					or report["substeps"] > report["automatic_substeps"] else Level.GOOD),
			say.call("Into how many parts a physics tick is divided for this body.")))
	var margin: float = report["stability_margin"]
	found.append(Row.new(say.call("Margin"), say.call("unlimited") if is_inf(margin) else "%s ×" % number(margin),
			Level.BAD if margin <= 1 else (Level.FAIR if margin < FAIR_MARGIN else Level.GOOD),
			say.call("How much longer a substep could be before the body would explode. Strong deformations need 1.5.")))
	if report.has("sag"):
		var sag: float = report["sag"]
		var folds: bool = report["folds"]
		var text: String = say.call("%s %%") % number(100 * sag)
		if folds:
			text = say.call("%s %%, it folds") % number(100 * sag)
		elif report["folds_on_fall"]:
			text = say.call("%s %%, a fall ruins it") % number(100 * sag)
		elif not report["settled"]:
			text = say.call("about %s %%") % number(100 * sag)
		found.append(Row.new(say.call("Sag"), text,
				Level.BAD if folds or report["folds_on_fall"] else (Level.FAIR if sag > FAIR_SAG else Level.GOOD),
				say.call("Under its own weight: the share of its height that the body loses on flat ground, found by letting a copy of it settle.")))
		var microseconds: float = report["microseconds_per_tick"]
		var share := microseconds * 1e-6 / tick
		found.append(Row.new(say.call("Cost"), say.call("%s µs a tick") % number(microseconds),
				Level.BAD if share > BAD_SHARE else (Level.FAIR if share > FAIR_SHARE else Level.GOOD),
				say.call("What a tick of this body takes on this machine while it lies awake on flat ground: %s %% of a tick. Asleep it costs next to nothing.") % number(100 * share)))
	for of: Array in [["dent_drop", "Dents", "dents"], ["tear_drop", "Tears", "is overstretched and may tear"]]:
		var height: float = report.get(of[0], NAN)
		if not is_nan(height):
			found.append(Row.new(say.call(of[1]), drop_text(height, say), Level.BAD if height == 0 else Level.GOOD,
					say.call("The fall onto flat ground from which on the body %s, as it is turned now, found by letting copies of it land.") % say.call(of[2])))
	if report.has("points_drawn"):
		var drawn: int = report["points_drawn"]
		var simulated: int = report["points_simulated"]
		var saves: bool = could_save_points(report)
		found.append(Row.new(say.call("Points"), say.call("%d, as drawn") % drawn if simulated == drawn
				else say.call("%d of %d, error %s %%") % [simulated, drawn, number(100 * report["outline_error"])],
				Level.FAIR if saves else Level.GOOD,
				(say.call("Every point that is drawn is simulated. %d points would keep the outline within its tolerance: set Detail to Automatic.") % report["points_at_tolerance"]) if saves
				else say.call("How many points are simulated of those that are drawn. Contacts are those of the simulated outline, up to %s px from what is drawn.") % number(report["outline_error_px"])))
	var unfit: bool = report["elastic_reason"] == "unfit"
	found.append(Row.new(say.call("Elasticity"), say.call(MODEL_NAMES[report["elastic_model"]]),
			Level.BAD if unfit else Level.GOOD, elastic_text(report, say)))
	var factor: float = report.get("firm_factor", 1.0)
	if factor > 1:
		var decides: bool = report["weight_decides"]
		found.append(Row.new(say.call("Firmness"), say.call("%s × for its weight") % number(factor), Level.FAIR if decides else Level.GOOD,
				(say.call("Made %s times as firm for its weight. Young's modulus is so low that it has no effect: %s is used, without which the body would fold.")
				if decides else say.call("Made %s times as firm for its weight: a Young's modulus of %s is used, with which it sags like a light body of its material. Firm For Weight switches it off."))
				% [number(factor), number(report["youngs_modulus_in_use"])]))
	return found


## `own` holds the node's values, or its material's, of `youngs_modulus`, `stiffness`, `damping`, `substeps` and `integrator`.
static func advice(report: Dictionary, own: Dictionary, say: Callable) -> Array[Advice]:
	var found: Array[Advice] = []
	if report.is_empty():
		return found
	var fixed: int = own["substeps"]
	if not report["safe"]:
		if report["automatic_safe"] and fixed > 0:
			found.append(Advice.new(say.call("%d substeps are not stable: use %d") % [fixed, report["automatic_substeps"]],
					{&"substeps": int(report["automatic_substeps"])}))
		else:
			found.append(Advice.new(say.call("No number of substeps is stable with this integrator: leave it automatic"),
					{&"integrator": 0, &"substeps": 0}))
	elif fixed > report["automatic_substeps"]:
		found.append(Advice.new(say.call("%d substeps are enough") % report["automatic_substeps"],
				{&"substeps": int(report["automatic_substeps"])}))
	if report.has("sag"):
		var is_material: bool = report["youngs_modulus"] > 0
		var property := &"youngs_modulus" if is_material else &"stiffness"
		var present: float = own[property]
		var firm := rounded_up(report["firm_youngs_modulus" if is_material else "firm_stiffness"])
		if firm > present and (report["folds"] or report["sag"] > FAIR_SAG):
			var name: String = say.call("Young's modulus" if is_material else "Stiffness")
			var text: String = say.call("%s %s will fold under its own weight: use ≥ %s") if report["folds"] \
					else say.call("%s %s sags visibly: use ≥ %s to hold the shape")
			found.append(Advice.new(text % [name, number(present), number(firm)], {property: firm}))
	if could_save_points(report):
		found.append(Advice.new(say.call("%d points are simulated: %d look the same within the tolerance") % [report["points_drawn"], report["points_at_tolerance"]],
				{&"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC}))
	if report["damping"] < report["least_damping"]:
		var damping: float = own["damping"]
		# What is painted on single springs stays: the node's own value makes up for it.
		var least := rounded_up(report["least_damping"] * (damping / report["damping"] if report["damping"] > 0 else 1.0))
		found.append(Advice.new(say.call("Damping %s lets strong deformations ring: use ≥ %s") % [number(damping),
				number(least)],
				{&"damping": least}))
	return found


## What to do, in one line: the first advice, or the worst figure and where to change it, or that there is nothing to do.
static func headline(figures: Array[Row], advices: Array[Advice], say: Callable) -> Row:
	var worst: Row = null
	for row in figures:
		if row.level != Level.GOOD and (worst == null or row.level > worst.level):
			worst = row
	var level := Level.GOOD if worst == null else worst.level
	if not advices.is_empty():
		# What is not stable comes first, then what folds or sags.
		var first := advices[0]
		for advice in advices:
			if figures[0].level != Level.BAD and (advice.changes.has(&"youngs_modulus") or advice.changes.has(&"stiffness")):
				first = advice
		return Row.new("", say.call("To do: %s.") % first.text, maxi(level, Level.FAIR) as Level, "")
	if worst == null:
		return Row.new("", say.call("It holds: nothing to do."), Level.GOOD, "")
	return Row.new("", say.call("It works. %s: %s.") % [worst.title, worst.text] if level == Level.FAIR
			else say.call("To do: see %s: %s.") % [worst.title, worst.text], level, worst.hint)


## Whether a body that is simulated as drawn would need less than half of its points.
static func could_save_points(report: Dictionary) -> bool:
	return report.has("points_drawn") and report["points_simulated"] == report["points_drawn"] \
			and 2 * report["points_at_tolerance"] < report["points_drawn"]


static func drop_text(height: float, say: Callable) -> String:
	if height == 0:
		return say.call("under its own weight")
	return say.call("not from 100 m") if is_inf(height) else say.call("from %s px") % number(height)


static func reason_text(reason: String) -> String:
	match reason:
		"stability":
			return "as stability asks"
		"contacts":
			return "as contacts ask"
		"too_stiff":
			return "XPBD, as it is too stiff for springs"
		"fixed":
			return "as set"
	return "not stable"


static func elastic_text(report: Dictionary, say: Callable) -> String:
	match report["elastic_reason"]:
		"chosen":
			return say.call("The elastic model is chosen in the inspector.")
		"own_springs":
			return say.call("The body has springs of its own: a network with the raw values. Set the elastic model to use the material.")
		"painted_springs":
			return say.call("Springs have factors of their own: a network with the raw values. Set the elastic model to use the material.")
		"network_values":
			return say.call("Raw values of the network are set: Young's modulus, Poisson's ratio and damping ratio have no effect. Set the elastic model to Modes to use them.")
		"material":
			return say.call("Young's modulus, Poisson's ratio and damping ratio decide. This is the cheapest model whose outline no player can tell from an elastic solid's: within %s %% of the radius, in measurements with a disk.") % number(100 * report["elastic_error"])
	return say.call("The chosen elastic model does not fit the body; the network takes its place. The warnings say why.")


## Three digits, as one reads them.
static func number(value: float) -> String:
	if not is_finite(value):
		return "∞" if value > 0 else "–"
	var size := absf(value)
	if size >= 100 or is_zero_approx(value):
		return "%d" % roundi(value)
	if size >= 10:
		return ("%.1f" % value).trim_suffix(".0")
	return String.num(snappedf(value, 0.01 if size >= 1 else 0.0001), 4)


## To two digits, so that it can be read and remembered; never below.
static func rounded_up(value: float) -> float:
	if not is_finite(value) or value <= 0:
		return 0.0
	var step := pow(10, floorf(log(value) / log(10.0)) - 1)
	return snappedf(ceilf(value / step - 1e-6) * step, step * 0.01)
