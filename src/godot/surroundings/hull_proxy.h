// SPDX-License-Identifier: MIT
// A body of Godot's physics server in the place of a soft body, so that the engine's own queries find it.
#pragma once

#include "core/model/body_frame.h"
#include "core/model/soft_body_data.h"
#include "godot/surroundings/hull_parts.h"
#include "godot/surroundings/rider.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// The soft body as rays, shape queries, areas and the motion of characters see it: a kinematic body without mask, of
/// convex polygons that follow the hull at once, within OUTLINE_TOLERANCE. A part with a dent (`HullParts::convex`) is
/// shown as its convex hull; a dent deeper than DENT_TOLERANCE is shown in wedges, at many times the cost, if the
/// caller allows it or a kinematic body is near. Near kinematic bodies (`begin_near`) the outline is drawn in by
/// `inset`, so that they press the hull. Under characters with a mass (`set_riders`) it is the hull, cut so that they find
/// a floor where the step has left them. Collision exceptions leave near rigid bodies to the core. A sleeping body
/// costs nothing. RIDs stay constant for the life of the proxy. See docs/decisions/engine-proxy.md.
class HullProxy {
public:
	HullProxy() = default;
	~HullProxy();
	HullProxy(const HullProxy &) = delete;
	HullProxy &operator=(const HullProxy &) = delete;

	/// The engine's body; made by the first call.
	godot::RID rid();
	bool is_in_space() const { return in_space_; }

	/// Sets the instance id of the node, which queries return.
	void set_collider(std::uint64_t instance_id);
	void set_layer(std::uint32_t layer);
	/// Adds the proxy to `space`, at the body's present place.
	void enter(const godot::RID &space, const SoftBodyData &body, Real inset);
	void leave();
	/// Called after the body got another hull: the next `follow` divides it anew.
	void forget_shape() { division_ = nullptr; }
	/// Makes the engine work out anew the effects of areas on a sleeping body.
	void stir();
	/// Called after a step. `inset` >= 0 [px], limited to a quarter of the body's width. If it returns true,
	/// `flush_hull_proxies` must be called before any query.
	bool follow(const SoftBodyData &body, Real inset, bool may_detail);
	/// Whether it is shown in wedges.
	bool is_detailed() const { return division_ != nullptr && slots_.size() > parts().convex.size() && !has_cuts_; }

	/// Encloses the reports of bodies near this one; a body not reported in between is no longer near.
	void begin_near();
	void note_near(const godot::RID &body, godot::PhysicsServer2D::BodyMode mode);
	void end_near();
	/// Whether a kinematic body is near.
	bool is_pressed() const { return pressed_; }
	/// Whether characters find it hard: its outline is not drawn in for them.
	bool is_hard() const { return !(asked_inset_ > 0); }
	/// Characters on it or above it after a step, until the next call. Under them the outline is the hull, and it moves
	/// with those that stand on it. True if they differ from those before.
	bool set_riders(const std::vector<Rider> &riders);
	/// Whether `follow` has nothing to do until the body moves, or `is_pressed` or the riders change.
	bool is_still() const { return !in_space_ || still_; }

	void add_exception(const godot::RID &body);
	void remove_exception(const godot::RID &body);

private:
	/// What follows from the hull at rest, one for like bodies.
	struct Division {
		std::vector<Vec2> rest_hull;
		HullParts parts;
		std::vector<Vec2> rest_normals; ///< outward, one a hull point
	};
	static std::shared_ptr<const Division> division_of(std::span<const Vec2> rest_hull);

	/// One shape of the engine's body. A single shape is changed in place. Of several, each change would make the
	/// engine process all, so the next polygon goes into a spare shape, and the two are exchanged, which the engine
	/// processes later.
	struct Slot {
		godot::RID shape;
		godot::RID spare;
	};

	const HullParts &parts() const { return division_->parts; }
	void divide(const SoftBodyData &body);
	void trace(const SoftBodyData &body, const BodyFrame &frame, Real inset);
	bool place(const BodyFrame &frame, bool exactly);
	bool has_moved(const std::vector<std::uint32_t> &part, std::size_t first, std::size_t count) const;
	void show(bool may_detail);
	void gather_riders(std::span<const Vec2> hull);
	bool is_filled(Vec2 place) const;
	void show_wedges();
	void show_cuts();
	void show_whole(bool is_new);
	void show_slot(std::size_t index, const std::vector<Vec2> &outline);
	void drop_slots(std::size_t count);
	void send_velocity(const SoftBodyData &body, BodyFrame frame);

	godot::RID rid_;
	godot::RID space_;
	std::vector<Slot> slots_;
	std::shared_ptr<const Division> division_; ///< null until `follow` divides the body

	std::vector<Vec2> shown_; ///< place of each point when it was last shown
	Vec2 origin_;
	Vec2 velocity_;
	Real angular_velocity_ = 0;
	Real asked_inset_ = 0; ///< that of the last `follow`
	Real inset_ = 0;
	std::vector<Rider> riders_;
	bool has_new_riders_ = false;
	bool has_cuts_ = false; ///< the slots behind the parts show pieces
	bool in_space_ = false;
	bool still_ = false; ///< the body rests, and all of it has been shown
	bool divided_ = false; ///< the first slots show wedges or pieces, not parts
	int smooth_follows_ = 0; ///< ticks without a deep dent
	bool placed_ = false;
	bool is_new_ = false; ///< the engine's body has had no transform yet

	bool pressed_ = false; ///< a kinematic body is near
	std::vector<godot::RID> near_;
	std::vector<godot::RID> kept_apart_; ///< rigid bodies near, sorted
	std::vector<godot::RID> exceptions_; ///< the user's

	/// Scratch memory of one `follow`, of all proxies.
	struct Scratch {
		std::vector<Vec2> outline; ///< to be shown, relative to the origin
		std::vector<bool> moved; ///< points that are elsewhere now
		std::vector<bool> under_rider; ///< hull points at riders
		std::vector<Rider> sinking; ///< riders that sink in, relative to the origin
		std::vector<Vec2> workspace;
		std::vector<std::vector<Vec2>> polygons; ///< one a convex part
		std::vector<std::vector<std::vector<Vec2>>> pieces; ///< of each convex part
		std::vector<Vec2> polygon;
	};
	static Scratch scratch_;
};

/// Whether this body of the physics server is a soft body's proxy. The environment reader leaves proxies out.
bool is_hull_proxy(const godot::RID &body);
/// Number of proxies, and all of them.
std::size_t hull_proxy_count();
void append_hull_proxies(godot::TypedArray<godot::RID> &list);
/// Number of proxies ever made.
std::uint64_t hull_proxies_made();

/// Makes the engine process all polygons changed since the last call. `any` is the RID of any proxy.
void flush_hull_proxies(const godot::RID &any);

/// Waits until a physics server on a thread of its own has done what it was told, so that queries in this tick find
/// proxies where they are now. `any` is the RID of any proxy.
void await_hull_proxies(const godot::RID &any);

} // namespace softbody
