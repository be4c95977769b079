// SPDX-License-Identifier: MIT
// Pressure: a body that holds its area.
#include "core/dynamics/pressure.h"

#include "core/dynamics/pressure_lanes.h"

namespace softbody {

Real area_and_gradient(std::span<const Vec2> hull, std::span<Vec2> gradient) {
	for (std::size_t i = 0; i < hull.size(); ++i) {
		gradient[i] = area_derivative<Real>(hull, i);
	}
	return hull_area<Real>(hull);
}

template void add_pressure_forces<Real>(const SoftBodyShape &, const BodySettings &, std::span<const Vec2>,
		std::span<Vec2>);
template void add_pressure_forces<RealPack>(const SoftBodyShape &, const BodySettings &,
		std::span<const BasicVec2<RealPack>>, std::span<BasicVec2<RealPack>>);

} // namespace softbody
