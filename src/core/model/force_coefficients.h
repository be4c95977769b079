// SPDX-License-Identifier: MIT
// The coefficients of a body's forces, in which bodies side by side may differ.
#pragma once

#include "core/base/pack.h"
#include "core/model/body_settings.h"

#include <array>

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

/// Each coefficient with the setting that it is the value of.
inline constexpr std::array<Real BodySettings::*, 7> COEFFICIENT_SETTINGS = { &BodySettings::spring_stiffness_scale,
	&BodySettings::spring_damping_scale, &BodySettings::shear_modulus, &BodySettings::area_stiffness, &BodySettings::elastic_damping_time,
	&BodySettings::shape_stiffness, &BodySettings::shape_damping };
template <class T>
inline constexpr std::array<T ForceCoefficients<T>::*, 7> COEFFICIENTS = { &ForceCoefficients<T>::spring_stiffness_scale,
	&ForceCoefficients<T>::spring_damping_scale, &ForceCoefficients<T>::shear_modulus, &ForceCoefficients<T>::area_stiffness,
	&ForceCoefficients<T>::elastic_damping_time, &ForceCoefficients<T>::shape_stiffness, &ForceCoefficients<T>::shape_damping };

/// The coefficients of a body, equal in all lanes.
template <class T>
ForceCoefficients<T> coefficients_of(const BodySettings &settings) {
	ForceCoefficients<T> coefficients;
	for (std::size_t i = 0; i < COEFFICIENT_SETTINGS.size(); ++i) {
		coefficients.*COEFFICIENTS<T>[i] = T(settings.*COEFFICIENT_SETTINGS[i]);
	}
	return coefficients;
}

/// The coefficients of bodies side by side; `settings` has an entry for each lane.
template <class T>
ForceCoefficients<T> coefficients_of(const BodySettings *const *settings) {
	ForceCoefficients<T> coefficients;
	for (std::size_t i = 0; i < COEFFICIENT_SETTINGS.size(); ++i) {
		for (std::size_t lane = 0; lane < LANES<T>; ++lane) {
			(coefficients.*COEFFICIENTS<T>[i]).set(lane, settings[lane]->*COEFFICIENT_SETTINGS[i]);
		}
	}
	return coefficients;
}

/// Whether bodies of one shape with these settings may be stepped side by side: all but the coefficients is equal, and the
/// same terms are off.
inline bool can_stand_side_by_side(const BodySettings &a, const BodySettings &b) {
	BodySettings alike = a;
	for (const auto coefficient : COEFFICIENT_SETTINGS) {
		if ((a.*coefficient > 0) != (b.*coefficient > 0)) {
			return false;
		}
		alike.*coefficient = b.*coefficient;
	}
	return alike == b;
}

} // namespace softbody
