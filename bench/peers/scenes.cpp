// SPDX-License-Identifier: MIT
// Piles as games have them.
#include "scenes.h"

#include "../bodies.h"

namespace bench {

namespace {

constexpr std::uint64_t SEED = 21;
constexpr double LEAST_FIRM = 0.9; // below that, peers' bodies begin to fold
constexpr double MOST_FIRM = 1.2; // explicit springs as stiff as the peers' go no further
constexpr double RESTITUTION = 0.2;
constexpr std::size_t EVERY = 5; // body is rigid

// Rigid disks must not meet each other, the ground or a wall: in our core, as in an engine, other parts see to that.
// In a pile of shifted rows the places of one color of three are no neighbors.
void make_disks(PileScene &scene) {
	const std::size_t columns = (scene.bodies.size() + std::size_t(scene.rows) - 1) / std::size_t(scene.rows);
	std::vector<std::size_t> places;
	for (std::size_t i = columns; i < scene.bodies.size(); ++i) {
		const std::size_t row = i / columns;
		const std::size_t column = i % columns;
		const std::size_t color = (column + 6 * std::size_t(scene.rows) - row / 2 - row) % 3;
		if (column > 0 && column + 1 < columns && color == 0) {
			places.push_back(i);
		}
	}
	const std::size_t wanted = std::min(places.size(), scene.bodies.size() / EVERY);
	for (std::size_t i = 0; i < wanted; ++i) {
		scene.bodies[places[i * places.size() / wanted]].is_rigid = true;
	}
}

} // namespace

PileScene pile_of(std::string_view kind, std::size_t bodies) {
	PileScene scene = pile_scene(bodies);
	if (kind == "mixed") {
		Random random(SEED);
		for (PileScene::Place &place : scene.bodies) {
			place.firmness = random.uniform(LEAST_FIRM, MOST_FIRM);
		}
	} else if (kind == "bounce") {
		scene.restitution = RESTITUTION;
	} else if (kind == "rigid") {
		make_disks(scene);
	}
	return scene;
}

} // namespace bench
