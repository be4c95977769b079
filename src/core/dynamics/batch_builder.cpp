// SPDX-License-Identifier: MIT
// Which bodies are stepped side by side.
#include "core/dynamics/batch_builder.h"

#include <unordered_map>
#include <utility>

namespace softbody {

namespace {

// Lanes share inverse masses, XPBD bodies differ in how long their passes take, and a bounce is remembered by
// each body for itself, like contacts with itself. Nothing here may depend on how bodies move: whole batches are coupled,
// so that who shares one shows in the result.
bool can_share_a_batch(const SoftBodyData &body) {
	return body.is_free() && body.ignored_tags().empty() && body.settings().integrator != Integrator::XPBD &&
			body.settings().restitution == 0 && !body.settings().self_collision;
}

// A body that is monitored must move as if it were not, and so stay in its batch.
bool move_alike(const BodySettings &a, BodySettings b) {
	b.contact_monitor = a.contact_monitor;
	return a == b;
}

void join(Batch &batch, std::uint32_t body_index, SoftBodyData &body) {
	if (batch.count == 0) {
		batch.shape = &body.shape();
		batch.settings = &body.settings();
	}
	batch.touching |= std::uint32_t(body.touch_memory().touching) << batch.count;
	batch.monitored |= std::uint32_t(body.settings().contact_monitor) << batch.count;
	batch.bodies[batch.count] = body_index;
	batch.positions[batch.count] = body.mutable_positions().data();
	batch.velocities[batch.count] = body.mutable_velocities().data();
	batch.count++;
}

Batch alone(std::uint32_t body_index, SoftBodyData &body) {
	Batch batch;
	join(batch, body_index, body);
	return batch;
}

/// The batches that are being filled: of each shape as many as there are different settings.
class Openings {
public:
	Batch &find(SoftBodyData &body) {
		const auto [entry, is_new] = of_shape_.try_emplace(&body.shape(), batches_.size());
		std::size_t *link = &entry->second;
		while (!is_new && *link != NONE) {
			Entry &candidate = batches_[*link];
			if (move_alike(*candidate.settings, body.settings())) {
				return candidate.batch;
			}
			link = &candidate.next;
		}
		*link = batches_.size();
		return batches_.emplace_back(Entry{ {}, &body.settings(), NONE }).batch;
	}

	/// In the order in which they were opened; that of the map would differ from run to run.
	template <class Work>
	void for_each(const Work &work) const {
		for (const Entry &entry : batches_) {
			work(entry.batch);
		}
	}

private:
	static constexpr std::size_t NONE = SIZE_MAX;
	struct Entry {
		Batch batch;
		const BodySettings *settings;
		std::size_t next; ///< another of the same shape
	};
	std::unordered_map<const SoftBodyShape *, std::size_t> of_shape_;
	std::vector<Entry> batches_;
};

} // namespace

bool move_alike(const Batch &a, const Batch &b) {
	return a.count == PACK_WIDTH && b.count == PACK_WIDTH && a.shape == b.shape && move_alike(*a.settings, *b.settings);
}

void BatchBuilder::update(WorldData &world) {
	if (version_ > 0 && seen_arrangement_ == world.change_counts().arrangement) {
		return;
	}
	seen_arrangement_ = world.change_counts().arrangement;
	++version_;
	batches_.clear();
	inactive_.clear();
	Openings openings;
	const std::span<SoftBodyData> bodies = world.soft_bodies();
	for (std::uint32_t i = 0; i < bodies.size(); ++i) {
		SoftBodyData &body = bodies[i];
		if (!body.is_active()) {
			inactive_.push_back(i);
			continue;
		}
		if (!can_share_a_batch(body)) {
			batches_.push_back(alone(i, body));
			continue;
		}
		Batch &batch = openings.find(body);
		join(batch, i, body);
		if (batch.count == PACK_WIDTH) {
			if (!batches_.empty() && move_alike(batches_.back(), batch)) {
				batch.settings = batches_.back().settings; // one body index to read for all of them, which stays in the cache
			}
			batches_.push_back(std::exchange(batch, {}));
		}
	}
	openings.for_each([&](const Batch &batch) {
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			batches_.push_back(alone(batch.bodies[lane], bodies[batch.bodies[lane]]));
		}
	});
}

} // namespace softbody
