// SPDX-License-Identifier: MIT
// Which bodies are stepped side by side.
#include "core/dynamics/roster.h"

#include <unordered_map>
#include <utility>

namespace softbody {

namespace {

// Lanes share inverse masses, XPBD bodies differ in how long their passes take, and a bounce is remembered by
// each body for itself, like contacts with itself. Nothing here may depend on how bodies move: whole crews are coupled,
// so that who shares one shows in the result.
bool can_share_a_crew(const SoftBodyData &body) {
	return body.is_free() && body.ignored_tags().empty() && body.settings().integrator != Integrator::XPBD &&
			body.settings().restitution == 0 && !body.settings().self_collision;
}

// A body that is monitored must move as if it were not, and so stay in its crew.
bool move_alike(const BodySettings &a, BodySettings b) {
	b.contact_monitor = a.contact_monitor;
	return a == b;
}

void join(Crew &crew, std::uint32_t place, SoftBodyData &body) {
	if (crew.count == 0) {
		crew.shape = &body.shape();
		crew.settings = &body.settings();
	}
	crew.touching |= std::uint32_t(body.touch_memory().touching) << crew.count;
	crew.monitored |= std::uint32_t(body.settings().contact_monitor) << crew.count;
	crew.bodies[crew.count] = place;
	crew.positions[crew.count] = body.mutable_positions().data();
	crew.velocities[crew.count] = body.mutable_velocities().data();
	crew.count++;
}

Crew alone(std::uint32_t place, SoftBodyData &body) {
	Crew crew;
	join(crew, place, body);
	return crew;
}

/// The crews that are being filled: of each shape as many as there are different settings.
class Openings {
public:
	Crew &find(SoftBodyData &body) {
		const auto [entry, is_new] = of_shape_.try_emplace(&body.shape(), crews_.size());
		std::size_t *link = &entry->second;
		while (!is_new && *link != NONE) {
			Entry &candidate = crews_[*link];
			if (move_alike(*candidate.settings, body.settings())) {
				return candidate.crew;
			}
			link = &candidate.next;
		}
		*link = crews_.size();
		return crews_.emplace_back(Entry{ {}, &body.settings(), NONE }).crew;
	}

	/// In the order in which they were opened; that of the map would differ from run to run.
	template <class Work>
	void for_each(const Work &work) const {
		for (const Entry &entry : crews_) {
			work(entry.crew);
		}
	}

private:
	static constexpr std::size_t NONE = SIZE_MAX;
	struct Entry {
		Crew crew;
		const BodySettings *settings;
		std::size_t next; ///< another of the same shape
	};
	std::unordered_map<const SoftBodyShape *, std::size_t> of_shape_;
	std::vector<Entry> crews_;
};

} // namespace

bool move_alike(const Crew &a, const Crew &b) {
	return a.count == PACK_WIDTH && b.count == PACK_WIDTH && a.shape == b.shape && move_alike(*a.settings, *b.settings);
}

void Roster::update(WorldData &world) {
	if (version_ > 0 && seen_arrangement_ == world.change_counts().arrangement) {
		return;
	}
	seen_arrangement_ = world.change_counts().arrangement;
	++version_;
	crews_.clear();
	inactive_.clear();
	Openings openings;
	const std::span<SoftBodyData> bodies = world.soft_bodies();
	for (std::uint32_t i = 0; i < bodies.size(); ++i) {
		SoftBodyData &body = bodies[i];
		if (!body.is_active()) {
			inactive_.push_back(i);
			continue;
		}
		if (!can_share_a_crew(body)) {
			crews_.push_back(alone(i, body));
			continue;
		}
		Crew &crew = openings.find(body);
		join(crew, i, body);
		if (crew.count == PACK_WIDTH) {
			if (!crews_.empty() && move_alike(crews_.back(), crew)) {
				crew.settings = crews_.back().settings; // one place to read for all of them, which stays in the cache
			}
			crews_.push_back(std::exchange(crew, {}));
		}
	}
	openings.for_each([&](const Crew &crew) {
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			crews_.push_back(alone(crew.bodies[lane], bodies[crew.bodies[lane]]));
		}
	});
}

} // namespace softbody
