// SPDX-License-Identifier: MIT
// An elastic material, and the terms of the model that represent it.
#include "core/model/material.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>

namespace softbody {

Status check_material(const Material &material) {
	return first_error({ check_above("youngs_modulus", material.youngs_modulus, 0, "N/m"),
			check_between("poisson_ratio", material.poisson_ratio, 0, double(MOST_POISSON_RATIO), ""),
			check_at_least("damping_ratio", material.damping_ratio, 0, "") });
}

double spring_shear_modulus(const SoftBodyShape &shape) {
	double sum = 0;
	for (const Spring2D &spring : shape.springs()) {
		sum += double(spring.stiffness) * spring.rest_length * spring.rest_length;
	}
	return sum / (8 * double(shape.rest_area()));
}

namespace {

// The lowest frequency of a solid of unit shear modulus and unit mass, squared: a disk's, for shapes without modes.
constexpr double DISK_FREQUENCY_SQUARED = 17.3;

Status apply_solid(const Material &material, ElasticModel model, const SoftBodyShape &shape, BodySettings &settings) {
	if (model == ElasticModel::MODES && shape.modes() == nullptr) {
		return Error{ "elastic_model", "MODES", "needs a shape with elastic modes", "create the shape with the option elastic" };
	}
	if (model == ElasticModel::TRIANGLES && shape.triangles() == nullptr) {
		return Error{ "elastic_model", "TRIANGLES", "needs a shape with elastic triangles",
			"create the shape with the option elastic_triangles" };
	}
	settings.shear_modulus = material.shear_modulus();
	settings.area_stiffness = material.bulk_modulus();
	if (model == ElasticModel::MODES && shape.modes()->hull_compliance[0] > 0) { // with holes: nearly linear in ν, as 1 / K is
		const std::array<Real, 3> weights = mode_weights(material.poisson_ratio);
		const std::array<Real, 3> &compliance = shape.modes()->hull_compliance;
		settings.area_stiffness = settings.shear_modulus / (weights[0] * compliance[0] + weights[1] * compliance[1] + weights[2] * compliance[2]);
	}
	return {};
}

// The square of the solid's lowest frequency at unit shear modulus and mass.
double lowest_stiffness(const Material &material, const SoftBodyShape &shape) {
	if (shape.modes() == nullptr && shape.triangles() == nullptr) {
		return DISK_FREQUENCY_SQUARED;
	}
	const std::array<Real, 3> weights = mode_weights(material.poisson_ratio);
	const std::array<Real, 3> &first = shape.modes() != nullptr ? shape.modes()->stiffness[0] : shape.triangles()->lowest_stiffness;
	return weights[0] * first[0] + weights[1] * first[1] + weights[2] * first[2];
}

// Longest damping time of triangles, as the ratio of their damping rate to their frequency [1]. Both limit explicit
// substeps: at this ratio damping takes two thirds more of them.
constexpr double MOST_VISCOUS = 0.7;

// The damping time of triangles, shortened to the longest that their rate of shear allows.
double triangle_damping_time(double wanted, const Material &material, const SoftBodyShape &shape) {
	const double shear = material.shear_modulus() * double(shape.triangle_shear_inverse_mass());
	const double dilation = material.bulk_modulus() * double(shape.triangle_dilation_inverse_mass());
	return std::min(wanted, MOST_VISCOUS * std::sqrt(shear + dilation) / shear);
}

// Shape matching of k_s pulls with κ = k_s / mean(m) per mass. Under uniform strain both its moduli are κ J / (4 A),
// where J is the inertia.
Status apply_springs(const Material &material, ElasticModel model, const SoftBodyShape &shape, BodySettings &settings) {
	const double unit_shear = spring_shear_modulus(shape);
	if (!(unit_shear > 0)) {
		return Error{ "elastic_model", "springs", "needs a shape with springs of stiffness > 0", "add springs or choose MODES" };
	}
	double mean_stiffness = 0;
	for (const Spring2D &spring : shape.springs()) {
		mean_stiffness += double(spring.stiffness) / double(shape.springs().size());
	}
	const double share = model == ElasticModel::SPRINGS ? 0.0 : double(DEFAULT_SHAPE_MATCHING);
	const double per_stiffness = double(shape.point_count()) / shape.total_mass() * shape.rest_inertia() / (4 * double(shape.rest_area()));
	const double unit_shape = share * mean_stiffness * per_stiffness;
	const double scale = material.shear_modulus() / (unit_shear + unit_shape);
	settings.spring_stiffness_scale = Real(scale);
	settings.shape_stiffness = Real(scale * share * mean_stiffness);
	if (model == ElasticModel::SPRINGS_SHAPE_AND_AREA) {
		settings.area_stiffness = Real(std::max(0.0, material.bulk_modulus() - scale * (2 * unit_shear + unit_shape)));
	}
	return {};
}

} // namespace

Status apply_material(const Material &material, ElasticModel model, const SoftBodyShape &shape, BodySettings &settings) {
	if (Status status = check_material(material)) {
		return status;
	}
	BodySettings changed = settings;
	changed.spring_stiffness_scale = 0;
	changed.spring_damping_scale = 0;
	changed.shape_stiffness = 0;
	changed.shape_damping = 0;
	changed.shear_modulus = 0;
	changed.area_stiffness = 0;
	changed.poisson_ratio = material.poisson_ratio;
	const bool has_springs = model != ElasticModel::MODES && model != ElasticModel::TRIANGLES;
	if (Status status = has_springs ? apply_springs(material, model, shape, changed) : apply_solid(material, model, shape, changed)) {
		return status;
	}
	// Damping in proportion to stiffness: ζ = β ω / 2 for the lowest mode.
	const double frequency = std::sqrt(lowest_stiffness(material, shape) * material.shear_modulus() / shape.total_mass());
	const double time = 2 * double(material.damping_ratio) / frequency;
	changed.elastic_damping_time = Real(time);
	if (model == ElasticModel::TRIANGLES) {
		// Damping time beyond the limit of the highest frequencies becomes shape damping, with equal effect on the
		// lowest mode.
		const double shortened = triangle_damping_time(time, material, shape);
		changed.elastic_damping_time = Real(shortened);
		const double rate = (time - shortened) * frequency * frequency;
		changed.shape_damping = Real(rate * shape.total_mass() / double(shape.point_count()));
	}
	if (has_springs) {
		// Springs by their own stiffness; shape matching damps all that is not rigid motion.
		changed.shape_damping = Real(time * changed.shape_stiffness);
		double stiffness = 0;
		double damping = 0;
		for (const Spring2D &spring : shape.springs()) {
			stiffness += double(spring.stiffness);
			damping += double(spring.damping);
		}
		changed.spring_damping_scale = damping > 0 ? Real(time * changed.spring_stiffness_scale * stiffness / damping) : Real(0);
	}
	if (Status status = check_settings(changed)) {
		return status;
	}
	settings = changed;
	return {};
}

double softness_by_holes(const SoftBodyShape &shape) {
	Material material;
	material.poisson_ratio = Real(0.45);
	return std::max(1.0, DISK_FREQUENCY_SQUARED / lowest_stiffness(material, shape));
}

Status apply_network(const SpringNetwork &network, double mass, const SoftBodyShape &shape, BodySettings &settings) {
	const double point_mass = mass / double(shape.point_count());
	const double shape_stiffness = network.shape_matching * network.stiffness;
	settings.spring_stiffness_scale = Real(network.stiffness);
	settings.spring_damping_scale = Real(network.damping);
	settings.shape_stiffness = Real(shape_stiffness);
	// The shape-matching oscillator of one point has the frequency sqrt(k_s/m): c = 2 ζ sqrt(k_s m).
	settings.shape_damping = Real(2 * network.shape_damping_ratio * std::sqrt(shape_stiffness * point_mass));
	return check_spring_rates(settings, shape);
}

Status check_spring_rates(const BodySettings &settings, const SoftBodyShape &shape) {
	if (!std::isfinite(settings.spring_stiffness_scale * shape.spring_frequency_squared())) {
		return Error{ "stiffness", "too large for the masses", "must stay within the range of numbers", "give less stiffness or more mass" };
	}
	if (!std::isfinite(settings.spring_damping_scale * shape.spring_damping_rate())) {
		return Error{ "damping", "too large for the masses", "must stay within the range of numbers", "give less damping or more mass" };
	}
	return {};
}

} // namespace softbody
