// SPDX-License-Identifier: MIT
// Which bodies are stepped side by side.
#include "core/dynamics/roster.h"

#include <unordered_map>

namespace softbody {

namespace {

// Lanes share inverse masses, XPBD bodies differ in how long their passes take, and a bounce is remembered by
// each body for itself.
bool can_share_a_crew(const SoftBodyData &body) {
	return !body.has_pins() && body.settings().integrator != Integrator::XPBD && body.settings().restitution == 0;
}

} // namespace

void Roster::update(const WorldData &world) {
	if (version_ > 0 && seen_change_count_ == world.change_count()) {
		return;
	}
	seen_change_count_ = world.change_count();
	++version_;
	crews_.clear();
	active_.clear();
	// The crew being filled for each shape, and the next one for the same shape with other settings.
	struct Opening {
		Crew crew;
		const BodySettings *settings;
	};
	std::unordered_map<const SoftBodyShape *, std::vector<Opening>> openings;
	std::vector<const SoftBodyShape *> shapes; // in order of appearance: the map's own order is no order
	const std::span<const SoftBodyData> bodies = world.soft_bodies();
	for (std::uint32_t i = 0; i < bodies.size(); ++i) {
		const SoftBodyData &body = bodies[i];
		if (!body.is_active()) {
			continue;
		}
		active_.push_back(i);
		if (!can_share_a_crew(body)) {
			crews_.push_back({ { i }, 1 });
			continue;
		}
		std::vector<Opening> &of_shape = openings[&body.shape()];
		if (of_shape.empty()) {
			shapes.push_back(&body.shape());
		}
		Opening *opening = nullptr;
		for (Opening &candidate : of_shape) {
			opening = *candidate.settings == body.settings() ? &candidate : opening;
		}
		if (!opening) {
			opening = &of_shape.emplace_back(Opening{ { {}, 0 }, &body.settings() });
		}
		opening->crew.bodies[opening->crew.count++] = i;
		if (opening->crew.count == PACK_WIDTH) {
			crews_.push_back(opening->crew);
			opening->crew.count = 0;
		}
	}
	for (const SoftBodyShape *shape : shapes) {
		for (const Opening &opening : openings[shape]) {
			for (std::uint32_t lane = 0; lane < opening.crew.count; ++lane) {
				crews_.push_back({ { opening.crew.bodies[lane] }, 1 });
			}
		}
	}
}

} // namespace softbody
