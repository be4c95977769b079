// SPDX-License-Identifier: MIT
// The forces on a body's points.
#include "core/dynamics/forces.h"

#include "core/dynamics/forces_lanes.h"

namespace softbody {

#define SOFTBODY_INSTANTIATE(T)                                                                                      \
	template void add_spring_forces<T>(const BodyModel<T> &, std::span<const BasicVec2<T>>,                          \
			std::span<const BasicVec2<T>>, std::span<BasicVec2<T>>);                                                 \
	template void add_shape_forces<T>(const BodyModel<T> &, std::span<const BasicVec2<T>>,                           \
			std::span<const BasicVec2<T>>, std::span<BasicVec2<T>>);                                                 \
	template void evaluate_forces<T>(const BodyModel<T> &, Vec2, std::span<const BasicVec2<T>>,                      \
			std::span<const BasicVec2<T>>, std::span<const BasicVec2<T>>, std::span<BasicVec2<T>>);
SOFTBODY_INSTANTIATE(Real)
SOFTBODY_INSTANTIATE(RealPack)
#undef SOFTBODY_INSTANTIATE

} // namespace softbody
