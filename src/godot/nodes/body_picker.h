// SPDX-License-Identifier: MIT
// Tells a SoftBody2D of the mouse and of touches, as the engine's picking tells a CollisionObject2D.
#pragma once

#include <godot_cpp/classes/input_event.hpp>
#include <godot_cpp/classes/node.hpp>
#include <godot_cpp/variant/vector2.hpp>

#include <optional>

namespace godot {

class SoftBody2D;

/// An internal child of a body that is pickable, so that a script of the body may have an `_unhandled_input` of its own. The
/// engine's picking finds nodes of the class CollisionObject2D only.
class SoftBodyPicker : public Node {
	GDCLASS(SoftBodyPicker, Node)

public:
	SoftBodyPicker();
	void _unhandled_input(const Ref<InputEvent> &p_event) override;
	/// The mouse no longer counts as being over the body.
	void forget_mouse();

protected:
	static void _bind_methods() {}
	void _notification(int p_what);

private:
	SoftBody2D *soft_body() const;
	bool is_asked() const;
	/// Whether the body is at that place of its viewport.
	bool is_at(const Vector2 &p_place) const;
	void set_over(bool p_over);

	std::optional<Vector2> mouse_; ///< where it was last seen in the viewport
	bool is_over_ = false;
};

} // namespace godot
