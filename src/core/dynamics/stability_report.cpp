// SPDX-License-Identifier: MIT
// Whether a body will hold: what its step rule chose, and how its springs compare with its weight. For those who set values.
#include "core/dynamics/stability_report.h"

#include "core/base/constants.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace softbody {

StabilityReport report_stability(const SoftBodyShape &shape, const BodySettings &settings, Vec2 gravity, Real dt,
		bool has_contacts) {
	StabilityReport report;
	report.plan = plan_substeps(shape, settings, dt, has_contacts);
	report.automatic = report.plan;
	if (settings.substeps != 0) {
		BodySettings open = settings;
		open.substeps = 0;
		report.automatic = plan_substeps(shape, open, dt, has_contacts);
	}

	double stiffness = 0;
	double damping = 0;
	for (const Spring2D &spring : shape.springs()) {
		stiffness += double(spring.stiffness);
		damping += double(spring.damping);
	}
	const double count = double(shape.springs().size());
	if (count > 0) {
		stiffness /= count;
		damping /= count;
	}
	report.stiffness = Real(stiffness);
	report.damping = Real(damping);
	const double mean_mass = double(shape.total_mass()) / double(shape.point_count());
	report.least_damping = Real(double(DAMPING_FLOOR) * std::sqrt(stiffness * mean_mass));

	const double weight = double(shape.total_mass()) * double(length(gravity)) * std::abs(double(settings.gravity_scale));
	const double radius = std::sqrt(double(shape.rest_area()) / std::numbers::pi);
	const double unit_stiffness = 8 * weight / (radius * double(shape.hull_count()));
	report.strength = unit_stiffness > 0 ? Real(stiffness / unit_stiffness) : std::numeric_limits<Real>::infinity();
	report.folding_stiffness = Real(double(FOLDING_STRENGTH) * unit_stiffness);
	report.firm_stiffness = Real(double(FIRM_STRENGTH) * unit_stiffness);
	return report;
}

} // namespace softbody
