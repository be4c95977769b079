// SPDX-License-Identifier: MIT
// A body, or several bodies of one shape side by side, as forces and integrators see them.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/model/body_settings.h"
#include "core/model/force_coefficients.h"
#include "core/model/soft_body_data.h"
#include "core/model/soft_body_shape.h"

#include <span>

namespace softbody {

/// What the forces on a body depend on besides its points: for one body (T = `Real`), or for PACK_WIDTH bodies of one
/// shape side by side (T = `RealPack`). Settings hold for all lanes but for the coefficients of forces, which are read
/// from `coefficients` alone. A view: its sources must outlive it.
template <class T>
struct BodyModel {
	const SoftBodyShape &shape;
	const BodySettings &settings;
	BasicRotation<T> rotation_memory; ///< last well-defined orientation, see `measure_frame`
	ForceCoefficients<T> coefficients;
};

/// A model with the state of its points, for integrators and constraints. Positions, velocities and inverse masses have
/// one entry a point; the inverse masses are those of every lane.
template <class T>
struct BodyLanes {
	BodyModel<T> model;
	std::span<const Real> inverse_masses; ///< [1/mass], 0 = pinned
	std::span<BasicVec2<T>> positions;
	std::span<BasicVec2<T>> velocities;
};

/// Whether the shape's elastic triangles take part.
inline bool has_triangles(const SoftBodyShape &shape, const BodySettings &settings) {
	return settings.is_elastic() && shape.triangles() != nullptr;
}

/// Whether the hull's area is held as a whole (`hold_area`); elastic triangles each hold their own.
inline bool holds_area(const SoftBodyShape &shape, const BodySettings &settings) {
	return settings.area_stiffness > 0 && !has_triangles(shape, settings);
}

inline BodyModel<Real> model_of(const SoftBodyData &body) {
	return { body.shape(), body.settings(), body.rotation_memory(), coefficients_of<Real>(body.settings()) };
}
inline BodyLanes<Real> lanes_of(SoftBodyData &body) {
	return { model_of(body), body.inverse_masses(), body.mutable_positions(), body.mutable_velocities() };
}

} // namespace softbody
