// SPDX-License-Identifier: MIT
// Signals of a step, kept until every node is up to date.
#pragma once

#include <godot_cpp/variant/vector2.hpp>

#include <cstdint>
#include <vector>

namespace softbody {

/// Signals of one step. A listener may free any node, change any property, add and remove bodies: nodes are known by
/// instance id, and looked up only when their signal is emitted.
class BodySignals {
public:
	/// Place and strength of a contact when two things met.
	struct Impact {
		godot::Vector2 point; ///< in the world [px]
		godot::Vector2 normal; ///< unit, towards the body that gets the signal
		double impulse = 0; ///< [kg·px/s]
	};

	void add_entered(uint64_t p_body, uint64_t p_collider, const Impact &p_impact) {
		pending_.push_back({ Kind::ENTERED, p_body, p_collider, p_impact });
	}
	void add_exited(uint64_t p_body, uint64_t p_collider) { pending_.push_back({ Kind::EXITED, p_body, p_collider, {} }); }
	void add_broken(uint64_t p_joint) { pending_.push_back({ Kind::BROKEN, p_joint, 0, {} }); }
	void add_failed(uint64_t p_body) { pending_.push_back({ Kind::FAILED, p_body, 0, {} }); }
	void add_sleep_changed(uint64_t p_body) { pending_.push_back({ Kind::SLEEP_CHANGED, p_body, 0, {} }); }

	/// Emits the signals in the order in which they were added. Signals of, or about, a node that is gone are dropped.
	void emit();

private:
	enum class Kind {
		ENTERED,
		EXITED,
		SLEEP_CHANGED,
		BROKEN,
		FAILED,
	};
	struct Pending {
		Kind kind;
		uint64_t body; ///< or joint; instance ids
		uint64_t collider;
		Impact impact;
	};
	std::vector<Pending> pending_;
};

} // namespace softbody
