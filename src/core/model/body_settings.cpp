// SPDX-License-Identifier: MIT
// The one validator of per-body settings.
#include "core/model/body_settings.h"

#include "core/base/constants.h"

namespace softbody {

Status check_settings(const BodySettings &settings) {
	const double most_stretch = settings.most_stretch != std::numeric_limits<Real>::infinity() ? double(settings.most_stretch) : 1;
	const double axial_stiffness = settings.axial_stiffness != std::numeric_limits<Real>::infinity() ? double(settings.axial_stiffness) : 1;
	return first_error({
			check_at_least("spring_stiffness_scale", settings.spring_stiffness_scale, 0, ""),
			check_at_least("spring_damping_scale", settings.spring_damping_scale, 0, ""),
			check_at_least("shear_modulus", settings.shear_modulus, 0, "N/m"),
			check_between("poisson_ratio", settings.poisson_ratio, 0, double(MOST_POISSON_RATIO), ""),
			check_at_least("area_stiffness", settings.area_stiffness, 0, "N/m"),
			check_at_least("elastic_damping_time", settings.elastic_damping_time, 0, "s"),
			check_between("least_area", settings.least_area, 0, 1, ""),
			check_between("least_stretch", settings.least_stretch, 0, 1, ""),
			check_at_least("most_stretch", most_stretch, 1, ""),
			check_at_least("yield_strain", settings.yield_strain, 0, ""),
			check_at_least("flow_rate", settings.flow_rate, 0, "1/s"),
			check_between("max_dent", settings.max_dent, 0, double(MOST_DENT), ""),
			check_between("dent_by", int(settings.dent_by), 0, DENT_BY_COUNT - 1, ""),
			check_at_least("shape_stiffness", settings.shape_stiffness, 0, "N/m"),
			check_at_least("shape_damping", settings.shape_damping, 0, "N·s/m"),
			check_at_least("pressure_stiffness", settings.pressure_stiffness, 0, "N/m"),
			check_at_least("inflation", settings.inflation, 0, ""),
			check_above("axial_stiffness", axial_stiffness, 0, "N"),
			check_at_least("bending_stiffness", settings.bending_stiffness, 0, "N·m²"),
			check_at_least("chain_damping_time", settings.chain_damping_time, 0, "s"),
			check_between("rest_bend", settings.rest_bend, 0, 1, ""),
			check_at_least("friction", settings.friction, 0, ""),
			check_at_least("rolling_resistance", settings.rolling_resistance, 0, ""),
			check_between("restitution", settings.restitution, 0, 1, ""),
			check_finite("gravity_scale", settings.gravity_scale, ""),
			check_at_least("linear_damp", settings.linear_damp, 0, "1/s"),
			check_at_least("angular_damp", settings.angular_damp, 0, "1/s"),
			check_between("integrator", int(settings.integrator), 0, INTEGRATOR_COUNT - 1, ""),
			check_between("failure_response", int(settings.failure_response), 0, FAILURE_RESPONSE_COUNT - 1, ""),
			check_between("substeps", settings.substeps, 0, MAX_SUBSTEPS, ""),
	});
}

} // namespace softbody
