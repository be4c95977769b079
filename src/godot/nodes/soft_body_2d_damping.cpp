// SPDX-License-Identifier: MIT
// The node's damping, its own and that of areas, and the gravity of areas.
#include "godot/nodes/soft_body_2d.h"

#include "godot/surroundings/area_effects.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/scene_tree.hpp>

namespace godot {

void SoftBody2D::stir_proxy() {
	if (proxy_.is_in_space()) {
		proxy_.stir();
	}
}

// What the engine has worked out holds from the second step on that it has seen the proxy in: its first one asks for gravity
// before it looks at areas. While the tree is paused the engine makes no steps, and what it last said goes on holding.
void SoftBody2D::feel_areas(const softbody::AreaEffects &p_space, bool p_engine_has_stepped) {
	softbody::SoftBodyData *found = body();
	if (found == nullptr || !found->is_active()) {
		return;
	}
	softbody::AreaEffects effects = p_space;
	if (proxy_.is_in_space()) {
		if (p_engine_has_stepped && !get_tree()->is_paused()) {
			engine_steps_++;
		}
		if (engine_steps_ > 1) {
			effects = softbody::read_area_effects(proxy_.rid());
		} else if (knows_areas_) {
			return; // It has just come back: until the engine knows, what held before it left.
		}
	}
	// A body that is made asleep is told of the project's damping for the first time; that is no reason to wake.
	const bool stays_asleep = !knows_areas_ && found->is_asleep();
	knows_areas_ = true;
	effects.linear_damp = softbody::DampChoice{ softbody::Real(values_.linear_damp), values_.linear_damp_mode == DAMP_MODE_REPLACE }.combined_with(effects.linear_damp);
	effects.angular_damp = softbody::DampChoice{ softbody::Real(values_.angular_damp), values_.angular_damp_mode == DAMP_MODE_REPLACE }.combined_with(effects.angular_damp);
	const softbody::Status refused = softbody::apply_area_effects(effects, p_space, *found);
	if (refused || !refused_.is_empty()) { // the engine looks up a name for each call
		accept("areas", refused);
	}
	if (stays_asleep) {
		found->put_to_sleep();
	}
}

} // namespace godot
