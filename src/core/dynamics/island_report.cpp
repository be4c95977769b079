// SPDX-License-Identifier: MIT
// What the contact substeps of each island buy: the contact error that a step leaves.
#include "core/dynamics/island_report.h"

#include "core/collision/environment_contact_solver.h"
#include "core/collision/hull_overlap.h"
#include "core/dynamics/islands.h"

#include <algorithm>
#include <utility>

namespace softbody {

namespace {

Islands find_islands(const SteppedBodies &stepped) {
	Islands islands;
	islands.reset(stepped.bodies.count());
	for (std::size_t i = 0; i < stepped.pairs.size(); ++i) {
		if (stepped.touched[i] != 0) {
			islands.join(stepped.pairs[i].a, stepped.pairs[i].b);
		}
	}
	for (const auto [a, b] : stepped.joined) {
		islands.join(a, b);
	}
	for (const std::uint32_t i : stepped.beside_dynamic) {
		islands.join(stepped.beside_dynamic[0], i);
	}
	return islands;
}

} // namespace

std::vector<IslandReport> report_islands(const SteppedBodies &stepped) {
	const ActiveBodies &bodies = stepped.bodies;
	Islands islands = find_islands(stepped);
	std::vector<IslandReport> reports(bodies.count()); // by island name, which is the first of its active indices
	const auto id_of = [&](std::uint32_t i) { return stepped.world.id_at(bodies.body_indices()[i]); };
	const auto note = [&](IslandReport &island, std::uint32_t i, Real depth) {
		if (depth > std::max(island.overlap, island.penetration)) {
			island.deepest = id_of(i);
		}
	};
	const auto add = [&](std::uint32_t i, int substeps) {
		IslandReport &island = reports[islands.find(i)];
		if (island.bodies == 0) {
			island.first = island.deepest = id_of(islands.find(i));
		}
		island.bodies += 1;
		island.contact_substeps = std::max(island.contact_substeps, substeps);
		const Real depth = measure_penetration(stepped.world, bodies.data(i));
		note(island, i, depth);
		island.penetration = std::max(island.penetration, depth);
	};
	for (const std::uint32_t i : stepped.free) {
		add(i, bodies.plan(i).substeps);
	}
	for (const std::uint32_t i : stepped.coupled) {
		add(i, stepped.substeps.of(i));
	}
	for (const BodyPair &pair : stepped.pairs) { // also those whose contact the step has missed
		const Real depth = measure_overlap(bodies.data(pair.a).hull(), bodies.data(pair.b).hull());
		IslandReport &island = reports[islands.find(pair.a)];
		note(island, pair.a, depth);
		island.overlap = std::max(island.overlap, depth);
	}
	std::erase_if(reports, [](const IslandReport &island) { return island.bodies == 0; });
	return reports;
}

} // namespace softbody
