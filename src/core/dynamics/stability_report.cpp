// SPDX-License-Identifier: MIT
// Judges whether a body will hold: its substep plan, and its springs compared with its weight. For editor tools.
#include "core/dynamics/stability_report.h"

#include "core/base/constants.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace softbody {

namespace {

// For a body whose elastic modes or triangles take part: E = 2 μ (1 + ν). 0 for others.
Real youngs_modulus_of(const SoftBodyShape &shape, const BodySettings &settings) {
	const bool is_elastic = settings.is_elastic() && (shape.modes() != nullptr || shape.triangles() != nullptr);
	return is_elastic ? 2 * settings.shear_modulus * (1 + settings.poisson_ratio) : Real(0);
}

} // namespace

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
		stiffness += double(spring.stiffness) * settings.spring_stiffness_scale;
		damping += double(spring.damping) * settings.spring_damping_scale;
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
	const Real young = youngs_modulus_of(shape, settings);
	if (young > 0) {
		const double unit_young = weight / radius;
		report.youngs_modulus = young;
		report.strength = unit_young > 0 ? Real(young / unit_young) : std::numeric_limits<Real>::infinity();
		report.folding_youngs_modulus = Real(double(FOLDING_STRENGTH) * unit_young);
		report.firm_youngs_modulus = Real(double(FIRM_STRENGTH) * unit_young);
		report.damping = report.least_damping = 0; // springs take no part
		return report;
	}
	report.strength = unit_stiffness > 0 ? Real(stiffness / unit_stiffness) : std::numeric_limits<Real>::infinity();
	report.folding_stiffness = Real(double(FOLDING_STRENGTH) * unit_stiffness);
	report.firm_stiffness = Real(double(FIRM_STRENGTH) * unit_stiffness);
	return report;
}

} // namespace softbody
