// SPDX-License-Identifier: MIT
// The coefficients of a body's forces, in which bodies side by side may differ.
#pragma once

#include "core/base/pack.h"
#include "core/model/body_settings.h"

#include <cstddef>

namespace softbody {

/// Values of `BodySettings` that make a body soft or firm: of one body (T = `Real`), or one in each lane. Units as there.
template <class T>
struct ForceCoefficients {
	T spring_stiffness_scale = T(1);
	T spring_damping_scale = T(1);
	T shear_modulus = T(0);
	T area_stiffness = T(0);
	T elastic_damping_time = T(0);
	T shape_stiffness = T(0);
	T shape_damping = T(0);
};

/// Calls `visit(coefficient, setting)` for each coefficient and the member of `BodySettings` that it is the value of.
template <class T, class Visit>
void for_each_coefficient(ForceCoefficients<T> &coefficients, const Visit &visit) {
	visit(coefficients.spring_stiffness_scale, &BodySettings::spring_stiffness_scale);
	visit(coefficients.spring_damping_scale, &BodySettings::spring_damping_scale);
	visit(coefficients.shear_modulus, &BodySettings::shear_modulus);
	visit(coefficients.area_stiffness, &BodySettings::area_stiffness);
	visit(coefficients.elastic_damping_time, &BodySettings::elastic_damping_time);
	visit(coefficients.shape_stiffness, &BodySettings::shape_stiffness);
	visit(coefficients.shape_damping, &BodySettings::shape_damping);
}

/// The coefficients of a body, equal in all lanes.
template <class T>
ForceCoefficients<T> coefficients_of(const BodySettings &settings) {
	ForceCoefficients<T> coefficients;
	for_each_coefficient(coefficients, [&](T &value, Real BodySettings::*setting) { value = T(settings.*setting); });
	return coefficients;
}

/// The coefficients of bodies side by side; `settings` has an entry for each lane.
template <class T>
ForceCoefficients<T> coefficients_of(const BodySettings *const *settings) {
	ForceCoefficients<T> coefficients;
	for_each_coefficient(coefficients, [&](T &value, Real BodySettings::*setting) {
		for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
			value.set(lane, settings[lane]->*setting);
		}
	});
	return coefficients;
}

/// Whether bodies of one shape with these settings may be stepped side by side: all but the coefficients is equal, and the
/// same terms are off.
inline bool can_stand_side_by_side(const BodySettings &a, const BodySettings &b) {
	BodySettings alike = a;
	bool are_same_off = true;
	ForceCoefficients<Real> of_b;
	for_each_coefficient(of_b, [&](Real &, Real BodySettings::*setting) {
		are_same_off = are_same_off && (a.*setting > 0) == (b.*setting > 0);
		alike.*setting = b.*setting;
	});
	return are_same_off && alike == b;
}

} // namespace softbody
