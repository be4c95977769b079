// SPDX-License-Identifier: MIT
// What a node's body is made of, at one scale of the node.
#pragma once

#include "core/base/error.h"
#include "core/model/soft_body_shape.h"
#include "godot/nodes/body_properties.h"

#include <godot_cpp/variant/packed_string_array.hpp>
#include <godot_cpp/variant/transform2d.hpp>

#include <memory>

namespace softbody {

/// Points and springs at one scale of the node. Its springs have stiffness and damping 1 times what is painted on them; how
/// stiff they are is a setting.
struct BodyDesign {
	std::shared_ptr<const SoftBodyShape> shape;
	godot::Transform2D scale;
	double area = 0; ///< inside the polygon less its holes at that scale [px²]
	bool has_holes = false;
	double mass = 0; ///< [kg]
	BodyProperties::ModelChoice wanted; ///< model by the node's properties
	BodyProperties::ModelChoice used;
	Status model_problem; ///< why `used` is not `wanted`
	bool is_reversed = false; ///< whether the core holds the hull in reverse
	bool has_deep_dents = false; ///< see `softbody::has_deep_dents`
	godot::PackedStringArray problems; ///< parts of the structure that do not fit the others and were left out
};

} // namespace softbody
