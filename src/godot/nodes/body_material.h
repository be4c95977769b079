// SPDX-License-Identifier: MIT
// What a node is made of, and how its surface grips.
#pragma once

#include "core/base/error.h"
#include "godot/resources/soft_body_material_2d.h"

#include <godot_cpp/classes/physics_material.hpp>
#include <godot_cpp/variant/callable.hpp>

#include <optional>

namespace softbody {

/// Holds the material that the node shares with others, and one of the node's own, which counts without a shared one. All
/// values are in these resources. A PhysicsMaterial counts instead of the friction and bounce of either.
class BodyMaterial {
public:
	/// Friction and bounce as contacts use them.
	struct Surface {
		double friction = 0; ///< [1], >= 0
		double bounce = 0; ///< [1], 0..1
		bool rough = false;
		bool absorbent = false;
		/// Whether it has these values and is neither rough nor absorbent.
		bool is_plain(double p_friction, double p_bounce) const;
	};

	/// The values in use.
	const MaterialValues &values() const;
	const godot::Ref<godot::SoftBodyMaterial2D> &shared() const { return shared_; }
	bool is_shared() const { return shared_.is_valid(); }
	/// `p_changed` is called from now on when a value of it changes. The node's own material stops to be its own when it
	/// is shared.
	void share(const godot::Ref<godot::SoftBodyMaterial2D> &p_material, const godot::Callable &p_changed);
	/// The resource in use, for scripts. `p_changed` is called from now on when one changes the node's own.
	godot::Ref<godot::SoftBodyMaterial2D> in_use(const godot::Callable &p_changed);

	/// Replaces the values of the node's own material, without a word to its listeners. Returns the old ones.
	MaterialValues exchange_own(const MaterialValues &p_values);
	/// Tells the listeners of the node's own material that its values are others.
	void tell_own() { own_->emit_changed(); }

	const godot::Ref<godot::PhysicsMaterial> &surface_override() const { return surface_material_; }
	void set_surface_override(const godot::Ref<godot::PhysicsMaterial> &p_material, const godot::Callable &p_changed);
	/// Takes over the present values of the override. Refuses values that are not finite; the old ones stay.
	Status read_surface_override();
	/// Of the override where there is one, else of the material in use.
	Surface surface() const;
	static godot::Ref<godot::PhysicsMaterial> make_physics_material(const Surface &p_surface);

	/// The preset with the values and the surface in use, or PRESET_CUSTOM.
	MaterialPresets::Preset preset() const;
	/// The override that gives these values their friction and bounce: perhaps the present one, perhaps none. One that
	/// other nodes may share is replaced, never changed.
	godot::Ref<godot::PhysicsMaterial> override_for(double p_friction, double p_bounce) const;

private:
	godot::Ref<godot::SoftBodyMaterial2D> shared_;
	godot::Ref<godot::SoftBodyMaterial2D> own_; ///< made when it is needed; until then it has the default values
	godot::Ref<godot::PhysicsMaterial> surface_material_;
	std::optional<Surface> surface_; ///< of `surface_material_` when its values last were finite
};

/// Puts a resource in the place of another. `p_changed` is called from now on when it changes.
template <class Kind>
void replace_resource(godot::Ref<Kind> &r_held, const godot::Ref<Kind> &p_resource, const godot::Callable &p_changed) {
	if (r_held.is_valid() && r_held->is_connected("changed", p_changed)) {
		r_held->disconnect("changed", p_changed);
	}
	r_held = p_resource;
	if (r_held.is_valid() && !r_held->is_connected("changed", p_changed)) {
		r_held->connect("changed", p_changed);
	}
}

} // namespace softbody
