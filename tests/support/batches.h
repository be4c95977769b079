// SPDX-License-Identifier: MIT
// How the bodies of a world are divided into batches.
#pragma once

#include "core/dynamics/active_bodies.h"

#include <vector>

namespace softbody::testing {

/// All batches of the awake bodies, as one thread would step them.
inline std::vector<Batch> batches_of(ActiveBodies &bodies) {
	std::vector<Batch> batches;
	for (std::size_t at = 0; at < bodies.awake().size(); at += batches.back().count) {
		batches.push_back(bodies.batch_at(bodies.awake().subspan(at)));
	}
	return batches;
}

/// Numbers of bodies of these batches.
inline std::vector<std::uint32_t> batch_sizes(WorldData &world) {
	ActiveBodies bodies(world);
	bodies.update(Real(1) / 60);
	bodies.plan_pressure(Real(1) / 60);
	std::vector<std::uint32_t> sizes;
	for (const Batch &batch : batches_of(bodies)) {
		sizes.push_back(batch.count);
	}
	return sizes;
}

} // namespace softbody::testing
