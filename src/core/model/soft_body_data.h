// SPDX-License-Identifier: MIT
// The state of one soft body: positions, velocities, loads.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/geometry/aabb.h"
#include "core/model/body_settings.h"
#include "core/model/body_state.h"
#include "core/model/own_shape.h"
#include "core/model/pose.h"
#include "core/model/soft_body_shape.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

template <class T>
struct BasicBodyFrame;
using BodyFrame = BasicBodyFrame<Real>;

/// Point mass (thesis 4.4.2, "Point2D"). A value: bodies store their points as parallel arrays, because the step reads
/// positions without masses and masses without forces.
struct Point2D {
	Vec2 position; ///< [length]
	Vec2 velocity; ///< [length/s]
	Vec2 force; ///< external force queued for the next step [mass·length/s²]
	Real mass = 1; ///< [mass], > 0
	Real inverse_mass = 1; ///< 1 / mass, or 0 while the point is pinned
};

/// Identifies bodies that fell asleep together. A body that was put back into an island since the last step does not
/// belong to the bodies that were in it before.
struct WokenIsland {
	std::uint64_t island = 0;
	std::uint32_t restored = 0;
	friend auto operator<=>(const WokenIsland &, const WokenIsland &) = default;
};

/// Counts of changes from outside, so that a step need not check each body.
struct ChangeCounts {
	std::uint64_t arrangement = 0; ///< shape, settings, pins, activity: what the order of stepping depends on
	std::uint64_t forces = 0; ///< external forces queued, accelerations changed
	std::uint64_t pin_targets = 0; ///< set
	std::uint64_t joints = 0; ///< added, changed, removed
	std::uint64_t restores = 0; ///< states put back
	std::vector<Aabb> disturbed_boxes; ///< boxes in which a frozen body was, came to be or went, until a step takes note
	std::vector<WokenIsland> woken_islands; ///< of sleeping bodies that were woken, until a step takes note
	std::uint64_t put_to_sleep = 0; ///< number of bodies put to sleep; each is an island of its own
};

/// One soft body of the world: a shared shape, its settings, and the state that a step advances. Spans stay valid until
/// the body's shape is replaced or the body is removed.
class SoftBodyData {
public:
	/// At rest at `pose`, which places the coordinates of the shape's description.
	/// Refuses settings outside their range and a pose that is not finite.
	static Result<SoftBodyData> create(std::shared_ptr<const SoftBodyShape> shape, const BodySettings &settings,
			const Pose &pose = {});

	/// The shape as it is now: dented, or the shared one.
	const SoftBodyShape &shape() const { return own_shape_.has_value() ? *own_shape_ : *shape_; }
	/// The shape as it was given, without dents.
	const std::shared_ptr<const SoftBodyShape> &shared_shape() const { return shape_; }
	const BodySettings &settings() const { return settings_; }
	Status set_settings(const BodySettings &settings);
	/// Replaces springs and masses; the state stays, and dents with it. Refuses another number of points or hull points.
	Status set_shape(std::shared_ptr<const SoftBodyShape> shape);

	std::size_t point_count() const { return memory_.previous_positions.size(); }
	std::span<const Vec2> positions() const { return { state_.data(), point_count() }; }
	std::span<const Vec2> velocities() const { return { state_.data() + point_count(), point_count() }; }
	std::span<const Vec2> hull() const { return { state_.data(), shape_->hull_count() }; }
	/// Inverse masses for contacts and integrators [1/mass]: 0 for pinned points, and for all while frozen.
	std::span<const Real> inverse_masses() const {
		if (memory_.frozen) {
			return frozen_inverse_masses_;
		}
		return pinned_inverse_masses_.empty() ? shape_->inverse_masses() : pinned_inverse_masses_;
	}
	/// Positions at the start of the last step, for interpolated drawing.
	std::span<const Vec2> previous_positions() const { return memory_.previous_positions; }
	/// All values of one point. Precondition: index < point_count().
	Point2D point(std::size_t index) const;

	/// Queues a force for the next step; several on one point add up. Refuses an index out of range or a non-finite
	/// force.
	Status add_external_force(std::uint32_t point, Vec2 force);
	/// Changes a velocity at once by impulse / mass; a pinned point stays. Refuses like `add_external_force`.
	Status apply_impulse(std::uint32_t point, Vec2 impulse);
	/// Replaces one point's state. Refuses an index out of range or values that are not finite.
	Status set_point(std::uint32_t point, Vec2 position, Vec2 velocity);
	/// Pins the point in place (infinite mass, no velocity) or releases it.
	Status set_pinned(std::uint32_t point, bool pinned);
	bool is_pinned(std::uint32_t point) const { return has_pins() && pinned_inverse_masses_[point] == 0; }
	/// Moves a pinned point straight to `position` during the next step, felt by springs, contacts and friction; then
	/// it rests there. Wakes the body if `position` is another place. A target that the body cannot follow tears at it
	/// until it is reset (StepReport::reset_bodies). Refuses a point that is not pinned and non-finite positions. A
	/// frozen body ignores it. O(pins that move).
	Status set_pin_target(std::uint32_t point, Vec2 position);
	/// Moves every point by the map p -> pose(reference⁻¹(p)) without changing velocities. Previous positions follow,
	/// so that nothing is drawn in between. The body keeps its size to rounding, however often it is turned. Refuses
	/// non-finite poses and rotations that are not of unit length (to 1e-3).
	Status teleport(const Pose &reference, const Pose &pose);

	/// Hides surfaces with one of these tags (Surface::tag) from this body, from the next step on. Tag 0 is dropped.
	/// Such a body is stepped on its own. Wakes it. Default none: costs nothing. O(n log n).
	void set_ignored_tags(std::span<const std::uint64_t> tags);
	std::span<const std::uint64_t> ignored_tags() const { return ignored_tags_; } ///< ascending
	bool ignores_tag(std::uint64_t tag) const;

	/// Largest change of the length of a spring's line at rest, as a share of the first [1]: 0 without a dent. O(springs).
	Real dent() const;
	bool is_dented() const;
	/// Gives the body its first shape back, as `set_rest_positions` does.
	void reset_dents();
	/// Dents the body: its points rest at `places` about the center of mass from now on, and are moved along, so that its strain
	/// stays. Refuses another number of points, non-finite places and a hull that is folded. Wakes it.
	Status set_rest_positions(std::span<const Vec2> places);
	/// For a quarter of a second of steps no strain dents or tears the body. One whose shape was set may lie partly inside its
	/// surroundings, and one that was torn springs back.
	void pause_damage();
	/// Whether strain may dent or tear the body now.
	bool takes_damage() const { return memory_.damage_pause == 0; }
	/// Counts the time of a pause, after a step of `dt` [s].
	void count_damage_pause(Real dt) { memory_.damage_pause = std::max(Real(0), memory_.damage_pause - dt); }
	/// Takes over the dents of a body of the same structure, which may be of another size.
	void adopt_dents(const SoftBodyData &other);

	/// The whole state as a value. O(points).
	BodyState save_state() const;
	/// Restores a state of this body or of one like it. Bodies that had fallen asleep with this one wake, unless they
	/// are restored as well before the next step. Refuses a state of another number of points or hull points, or with
	/// non-finite values (see `check_body_state`). O(points), and the next step checks all bodies.
	Status restore_state(const BodyState &state);
	/// What the body remembers besides the places and speeds of its points.
	const BodyMemory &memory() const { return memory_; }
	/// For the restoring of whole worlds: takes a state over and tells no one; the world does (`WorldData::put_back`). `state` gets
	/// memory of the body that may be used again. Precondition: `check_body_state` accepts it.
	void put_back(BodyState &state);
	/// The rest positions of a dented body, else none.
	std::span<const Vec2> dents() const { return is_dented() ? own_shape_->rest_positions() : std::span<const Vec2>(); }

	/// An inactive body is left out of the step: it keeps its state and queued forces, and nothing collides with it.
	/// Default true.
	bool is_active() const { return memory_.active; }
	void set_active(bool active);

	/// A frozen body keeps its shape and place, as if of infinite mass, and others collide with it. It is not stepped,
	/// does not count as asleep, and ignores forces, impulses and pin targets; its queue is emptied. It may be
	/// teleported, its points set, its pins changed: bodies near it wake. After release it goes on at rest. A rigid
	/// body that lies on it is stopped, not moved out. Default false.
	bool is_frozen() const { return memory_.frozen; }
	void set_frozen(bool frozen);

	const std::vector<ExternalForce> &external_forces() const { return memory_.external_forces; }
	/// Adds to the load on the body as a whole during the next step, unchecked. Callers of the core use
	/// `add_rigid_force` and `add_torque`.
	void queue_load(const RigidLoad &load);
	const RigidLoad &queued_load() const { return memory_.load; }
	/// Acceleration of all its points [length/s²], added to gravity times `gravity_scale` until it is changed, such as
	/// wind or an area's gravity. A change wakes the body and rearranges nothing. A body with an acceleration is
	/// stepped alone. Refuses non-finite values. Default 0.
	Vec2 acceleration() const { return memory_.acceleration; }
	Status set_acceleration(Vec2 acceleration);
	/// A number that stands for the fluids that bear the body: their values and where they are; 0 for none. Another number than before
	/// wakes the body. A body that floats sleeps as long as the number stays. Default 0.
	std::uint64_t fluids() const { return memory_.fluids; }
	void set_fluids(std::uint64_t fluids);
	/// Adds a force of a fluid [mass·length/s²], which acts during the next step only. Unlike `add_external_force` it does not wake the
	/// body: a fluid pushes all the time. Does nothing to a sleeping or frozen body. Refuses the same values.
	Status add_fluid_force(std::uint32_t point, Vec2 force);
	/// Gravity plus acceleration [length/s²]; exactly 0 where they cancel up to rounding.
	Vec2 total_acceleration(Vec2 gravity) const;
	/// Whether queued forces or an acceleration act on the body in the next step.
	bool is_pushed() const { return !memory_.external_forces.empty() || memory_.load != RigidLoad{} || memory_.acceleration != Vec2{}; }

	/// A sleeping body is at rest and left out of the step. It wakes with its island when an awake body touches it, and
	/// when a force, an impulse or any other change is applied to it.
	bool is_asleep() const { return memory_.rest.asleep; }
	Real rest_time() const { return memory_.rest.rest_time; } ///< time for which it has hardly moved [s]
	void wake();
	/// Called before a body is moved or removed: wakes it, or, if it is frozen, the bodies near it.
	void disturb();
	/// Stops the body and puts it to sleep at once, in any place, whether or not its settings let it fall asleep. It
	/// sleeps alone: bodies that touch it go on, and may wake it. A frozen body does not sleep.
	void put_to_sleep();

	/// Whether any point is pinned.
	bool has_pins() const { return !pinned_inverse_masses_.empty(); }
	/// Whether the body can be moved as a whole: it is neither pinned nor frozen.
	bool is_free() const { return !has_pins() && !memory_.frozen; }
	/// `WorldData` gives its bodies a common count of changes.
	void set_change_counts(std::shared_ptr<ChangeCounts> counts) { changes_ = std::move(counts); }

	// State access of the step (dynamics and collision); not for users of the core.
	/// Lets the body rest at `places` (`SoftBodyShape::move_rest`). Precondition: `settings().can_dent()`. Other bodies may be
	/// stepped meanwhile.
	void move_rest(std::span<const Vec2> places) { own_shape_->move_rest(places, *shape_); }
	/// Called after a step of `move_rest`: bounds of frequencies are found anew.
	void renew_bounds() { own_shape_->renew_bounds(); }
	/// Called after that, between steps: the body is planned anew.
	void note_dent() { count(&ChangeCounts::arrangement); }
	std::span<Vec2> mutable_positions() { return { state_.data(), point_count() }; }
	std::span<Vec2> mutable_velocities() { return { state_.data() + point_count(), point_count() }; }
	std::span<Vec2> mutable_previous_positions() { return memory_.previous_positions; }
	const std::vector<PinTarget> &pin_targets() const { return memory_.pin_targets; }
	void clear_pin_targets() { memory_.pin_targets.clear(); }
	void clear_external_forces() {
		memory_.external_forces.clear();
		memory_.load = {};
	}
	/// Last well-defined orientation; see `measure_frame`. The step keeps it for bodies whose forces depend on it; for
	/// other bodies any caller that measures the frame may set it.
	Rotation rotation_memory() const { return { state_.back().x, state_.back().y }; }
	void set_rotation_memory(Rotation rotation) { state_.back() = { rotation.c, rotation.s }; }
	TouchMemory &touch_memory() { return memory_.touch; }
	std::vector<PairMemory> &pair_memories() { return memory_.pair_touches; }
	/// The few one-way colliders that hold the body or that it passes through.
	std::vector<OneWayMemory> &one_ways() { return memory_.one_ways; }
	std::span<const OneWayMemory> one_ways() const { return memory_.one_ways; }
	RestState &rest_state() { return memory_.rest; }
	/// The hull at its last contacts with colliders, if other bodies, or the body itself, may have pushed it since.
	/// Otherwise empty.
	std::vector<Vec2> &last_valid_hull() { return memory_.last_valid_hull; }
	/// Whether the body was made, sent or resized since its contacts with colliders were last solved. Then no path tells on which side
	/// of a thin collider its points belong: they belong on that of its center.
	bool is_placed() const { return memory_.placed; }
	void set_placed(bool placed) { memory_.placed = placed; }

private:
	SoftBodyData() = default;
	Status check_point(std::uint32_t point, const char *what, Vec2 value) const;
	void note_change();
	void own_shape();
	void restore_dents(std::span<const Vec2> rest_positions);
	void follow_rest(std::span<const Vec2> before, const BodyFrame &frame);
	/// Counts a change, if the body is in a world.
	void count(std::uint64_t ChangeCounts::*changes) const {
		if (changes_) {
			++(*changes_.*changes);
		}
	}

	std::shared_ptr<const SoftBodyShape> shape_;
	OwnShape own_shape_; ///< of a body that is or may be dented
	BodySettings settings_;
	/// Positions, then velocities, then the rotation memory: the only data that a step reads and writes.
	std::vector<Vec2> state_;
	std::vector<Real> pinned_inverse_masses_; ///< empty while nothing is pinned: then the shape's hold
	std::vector<Real> frozen_inverse_masses_; ///< zeros, while the body is frozen
	BodyMemory memory_;
	std::vector<std::uint64_t> ignored_tags_;
	std::shared_ptr<ChangeCounts> changes_;
};

} // namespace softbody
