// SPDX-License-Identifier: MIT
// A body of Godot's physics server that lies where a soft body lies, so that the engine's own queries find it.
#pragma once

#include "core/model/body_frame.h"
#include "core/model/soft_body_data.h"
#include "godot/surroundings/hull_parts.h"

#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/variant/rid.hpp>
#include <godot_cpp/variant/typed_array.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace softbody {

/// What rays, shape queries, areas and the motion of characters see of a soft body: a kinematic body of convex polygons
/// that follow the hull. It has no mask, so it looks for nothing itself; areas look for it, and as it is kinematic, the
/// engine works out their gravity and damping for it (`read_area_effects`).
///
/// Its place and its polygons change at once, not with the engine's next step as is usual for kinematic bodies: what a
/// script asks in `_physics_process` is answered by the hull as it is. Polygons are within OUTLINE_TOLERANCE of the
/// hull, but dents: a part (`HullParts::convex`) is shown as its convex hull until a dent in it is deeper than
/// DENT_TOLERANCE; then the hull is shown in wedges, until it has been smooth for a while. Wedges cost many times as
/// much, and in a pile nearly all bodies are dented by their neighbors. So the caller says which may have them; one
/// with a kinematic body near has them anyway, as a character in a dent that is filled would be stuck.
///
/// **Characters.** A kinematic character would be stopped at the hull and so never press it. Where the near ones are
/// known (`begin_near`), the outline is drawn in by `inset`: they come that far in, the core's contact presses the hull
/// under them by as much, and further they do not get. The depth counts from the rest shape fitted to the body, or
/// the outline would give way again and again to who stands on it.
///
/// **Rigid bodies** that the soft body meets are the core's to answer. The engine is kept from answering them as well by
/// collision exceptions with those that are near.
///
/// A body that sleeps costs nothing. RIDs stay the same for the life of the proxy.
class HullProxy {
public:
	HullProxy() = default;
	~HullProxy();
	HullProxy(const HullProxy &) = delete;
	HullProxy &operator=(const HullProxy &) = delete;

	/// The engine's body; made by the first call.
	godot::RID rid();
	bool is_in_space() const { return in_space_; }

	/// What queries find: instance id of the node.
	void set_collider(std::uint64_t instance_id);
	void set_layer(std::uint32_t layer);
	/// Shows itself in `space`, where the body is now.
	void enter(const godot::RID &space, const SoftBodyData &body, Real inset);
	void leave();
	/// The body has another hull: the next `follow` divides it anew.
	void forget_shape() { parts_ = {}; }
	/// Has the engine work out anew what areas do to a body that sleeps.
	void stir();
	/// After a step. `inset` >= 0 [px], of which at most a quarter of the body's width is used.
	/// If it returns true, `flush_hull_proxies` must be called before anybody asks.
	bool follow(const SoftBodyData &body, Real inset, bool may_detail);
	/// Whether it is shown in wedges.
	bool is_detailed() const { return !parts_.convex.empty() && slots_.size() > parts_.convex.size(); }

	/// Around what the surroundings reader found near the body: who is not noted between the two is no longer near.
	void begin_near();
	void note_near(const godot::RID &body, godot::PhysicsServer2D::BodyMode mode);
	void end_near();

	void add_exception(const godot::RID &body);
	void remove_exception(const godot::RID &body);

private:
	/// One shape of the engine's body. A shape that is alone is changed where it is. Of several each change would make the
	/// engine look at all, so the next polygon goes into a spare shape, and those are exchanged, which it notes for later.
	struct Slot {
		godot::RID shape;
		godot::RID spare;
	};

	void divide(const SoftBodyData &body);
	void trace(const SoftBodyData &body, const BodyFrame &frame, Real inset);
	bool place(const BodyFrame &frame, bool exactly);
	bool has_moved(const std::vector<std::uint32_t> &part, std::size_t first, std::size_t count) const;
	void show(bool may_detail);
	void show_slot(std::size_t index, const std::vector<Vec2> &outline);
	void drop_slots(std::size_t count);
	void send_velocity(const BodyFrame &frame, bool asleep);

	godot::RID rid_;
	std::vector<Slot> slots_;
	HullParts parts_;
	std::vector<Vec2> rest_normals_; ///< outward, one a hull point

	std::vector<Vec2> outline_; ///< to be shown, relative to the origin
	std::vector<Vec2> shown_; ///< where each point was when it was last shown
	std::vector<bool> moved_; ///< which are elsewhere now
	Vec2 origin_;
	Vec2 velocity_;
	Real angular_velocity_ = 0;
	Real inset_ = 0;
	bool in_space_ = false;
	bool still_ = false; ///< the body sleeps, and all that has been shown
	bool wedged_ = false; ///< the first slots show wedges
	int smooth_follows_ = 0; ///< for how long no dent was deep
	bool placed_ = false;

	bool pressed_ = false; ///< a kinematic body is near
	std::vector<godot::RID> near_;
	std::vector<godot::RID> kept_apart_; ///< rigid bodies near, sorted
	std::vector<godot::RID> exceptions_; ///< the user's

	std::vector<Vec2> workspace_;
	std::vector<std::vector<Vec2>> polygons_; ///< one a convex part
	std::vector<Vec2> polygon_;
};

/// Whether this body of the physics server is a soft body's proxy: who reads surroundings leaves it out.
bool is_hull_proxy(const godot::RID &body);
/// How many there are, and all of them.
std::size_t hull_proxy_count();
void append_hull_proxies(godot::TypedArray<godot::RID> &list);
/// How many there have ever been.
std::uint64_t hull_proxies_made();

/// Has the engine take note of all polygons changed since. `any` is the RID of any proxy.
void flush_hull_proxies(const godot::RID &any);

} // namespace softbody
