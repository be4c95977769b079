// SPDX-License-Identifier: MIT
// Finds places with more shapes than one query of the engine takes.
#include "godot/surroundings/crowd_watch.h"

#include "godot/convert.h"

#include <godot_cpp/classes/physics_server2d.hpp>

#include <algorithm>

using namespace godot;

namespace softbody {

namespace {

// Contacts from which on a box counts as crowded; a shape inside of it has one or two. Larger: closer to the limit of
// 2048 shapes. Smaller: boxes are divided for nothing.
constexpr int32_t CROWD = 512;

// Most quarterings that are looked into.
constexpr int MAX_DEPTH = 4;

// Most places that are remembered.
constexpr std::size_t MAX_CROWDS = 64;

} // namespace

CrowdWatch::CrowdWatch() {
	shape_ = PhysicsServer2D::get_singleton()->rectangle_shape_create();
	query_.instantiate();
	query_->set_shape_rid(shape_);
	query_->set_collide_with_areas(true);
}

CrowdWatch::~CrowdWatch() {
	query_.unref();
	if (PhysicsServer2D *server = PhysicsServer2D::get_singleton()) {
		server->free_rid(shape_);
	}
}

void CrowdWatch::watch(const Aabb &box) {
	watched_ = box;
	deepest_ = 0;
	waiting_.assign(1, { box, 0 });
}

// Contacts are counted, not results of `intersect_shape`, which cost ten times as much each.
bool CrowdWatch::is_crowded(PhysicsDirectSpaceState2D *state, const Aabb &box) {
	PhysicsServer2D *server = PhysicsServer2D::get_singleton();
	server->shape_set_data(shape_, to_godot(box.half_size()));
	server->shape_get_type(shape_); // Commands wait in a queue where the server has a thread; the answer comes after them.
	query_->set_transform(transform_to(box.center()));
	return state->collide_shape(query_, CROWD).size() >= 2 * CROWD; // two ends each
}

void CrowdWatch::look(PhysicsDirectSpaceState2D *state) {
	if (waiting_.empty()) {
		return;
	}
	const Part part = waiting_.back();
	waiting_.pop_back();
	if (is_crowded(state, part.box)) {
		deepest_ = std::max(deepest_, part.depth + 1);
		if (deepest_ == MAX_DEPTH) { // there is no finer division
			waiting_.clear();
		} else {
			const Vec2 center = part.box.center();
			const Aabb &box = part.box;
			// The way down goes into one crowded quarter, another one the next time.
			waiting_ = { { { box.min, center }, part.depth + 1 }, { { { center.x, box.min.y }, { box.max.x, center.y } }, part.depth + 1 },
				{ { center, box.max }, part.depth + 1 }, { { { box.min.x, center.y }, { center.x, box.max.y } }, part.depth + 1 } };
			std::ranges::rotate(waiting_, waiting_.begin() + std::ptrdiff_t(turn_++ % 4));
		}
	}
	if (waiting_.empty()) {
		remember();
	}
}

void CrowdWatch::remember() {
	const Vec2 center = watched_.center();
	std::erase_if(crowds_, [&](const Crowd &crowd) { return crowd.box.overlaps({ center, center }); });
	if (deepest_ == 0) {
		return;
	}
	if (crowds_.size() == MAX_CROWDS) {
		crowds_.erase(crowds_.begin());
	}
	crowds_.push_back({ watched_, watched_.extent() / Real(1 << deepest_) });
}

int CrowdWatch::splits(const Aabb &box, int most) const {
	Real width = box.extent();
	for (const Crowd &crowd : crowds_) {
		width = crowd.box.overlaps(box) ? std::min(width, crowd.width) : width;
	}
	int splits = 0;
	// Boxes of groups grow and shrink a little from tick to tick.
	for (Real part = box.extent(); splits < most && part > width * Real(1.25); ++splits) {
		part /= 2;
	}
	return splits;
}

} // namespace softbody
