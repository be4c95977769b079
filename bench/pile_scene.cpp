// SPDX-License-Identifier: MIT
// A pile of thesis bodies, and how well and how fast an engine holds it.
#include "pile_scene.h"

#include "bodies.h"

#include "core/geometry/polygon.h"
#include "thesis/polygon_overlap.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

namespace bench {

namespace {

using softbody::Aabb;
using softbody::Real;
using softbody::Vec2;

constexpr std::uint64_t SEED = 20150703;
constexpr double GAP = 0.05; // between neighbors at the start, over R; a body is out of place by a sixth of it at most, in x and y
constexpr double OVERLAP_LIMIT = 0.05; // over R
constexpr int DISK_CORNERS = 32;
constexpr int TURN = 20; // steps of one engine before the next has its turn

double depth_in_environment(const PileScene &scene, const Hull &hull) {
	double depth = 0;
	for (const Vec2 p : hull) {
		depth = std::max(depth, -double(p.y));
		if (scene.has_walls) {
			depth = std::max({ depth, scene.left - double(p.x), double(p.x) - scene.left - scene.width });
		}
	}
	return depth;
}

// Pairs of bodies whose boxes meet, by sweeping along x.
template <typename Visit>
void for_each_near_pair(const std::vector<Aabb> &boxes, Visit visit) {
	std::vector<std::size_t> order(boxes.size());
	for (std::size_t i = 0; i < order.size(); ++i) {
		order[i] = i;
	}
	std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return boxes[a].min.x < boxes[b].min.x; });
	for (std::size_t i = 0; i < order.size(); ++i) {
		const Aabb &box = boxes[order[i]];
		for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min.x <= box.max.x; ++j) {
			if (box.overlaps(boxes[order[j]])) {
				visit(order[i], order[j]);
			}
		}
	}
}

// The value that the share `rank` of all values lies below.
double quantile(std::vector<double> values, double rank) {
	const std::size_t index = std::min(values.size() - 1, std::size_t(rank * double(values.size())));
	std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(index), values.end());
	return values[index];
}

double seconds_of(PileClock clock) {
	if (clock == PileClock::PROCESSOR) {
		return double(std::clock()) / CLOCKS_PER_SEC;
	}
	return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double mean(const std::vector<double> &values) {
	double sum = 0;
	for (const double value : values) {
		sum += value;
	}
	return sum / double(values.size());
}

} // namespace

PileScene pile_scene(std::size_t bodies, int rows) {
	PileScene scene;
	scene.rows = rows;
	Random random(SEED);
	const double pitch = (2 + GAP) * scene.radius;
	const std::size_t columns = (bodies + std::size_t(rows) - 1) / std::size_t(rows);
	// Half a body more than the columns need, for the shifted rows.
	scene.width = (double(columns) + 0.5) * pitch;
	for (std::size_t i = 0; i < bodies; ++i) {
		const std::size_t row = i / columns;
		const double shift = row % 2 == 0 ? 0.5 : 1.0;
		const auto jitter = [&] { return random.uniform(-1, 1) * GAP * scene.radius / 6; };
		const double x = (double(i % columns) + shift) * pitch + jitter();
		const double y = (double(row) + 0.5) * pitch + jitter();
		scene.bodies.push_back({ { Real(x), Real(y) }, random.uniform(0, 2 * std::numbers::pi) });
	}
	return scene;
}

Hull disk_outline(const PileScene &scene, Vec2 center) {
	Hull hull;
	for (int i = 0; i < DISK_CORNERS; ++i) {
		const double angle = 2 * std::numbers::pi * i / DISK_CORNERS;
		hull.push_back(center + Vec2{ Real(scene.radius * std::cos(angle)), Real(scene.radius * std::sin(angle)) });
	}
	return hull;
}

PileQuality judge_pile(const PileScene &scene, const std::vector<Hull> &hulls) {
	PileQuality quality;
	std::vector<Aabb> boxes;
	std::vector<double> deepest;
	const double n = scene.hull_points;
	const double whole_area = n / 2 * scene.radius * scene.radius * std::sin(2 * std::numbers::pi / n);
	std::size_t soft_bodies = 0;
	for (std::size_t i = 0; i < hulls.size(); ++i) {
		const Hull &hull = hulls[i];
		const double area = double(softbody::signed_area(hull));
		const Vec2 center = softbody::area_centroid(hull);
		const bool between = double(center.x) >= scene.left && double(center.x) <= scene.left + scene.width;
		const bool inside = center.y >= 0 && (between || (!scene.has_walls && std::isfinite(center.x)));
		quality.escaped += inside ? 0 : 1; // one that is not finite is not inside either
		quality.folded += softbody::is_folded(hull) ? 1 : 0;
		if (!scene.bodies[i].is_rigid) {
			quality.mean_area += area / whole_area;
			++soft_bodies;
		}
		boxes.push_back(softbody::bounding_box(hull));
		quality.height = std::max(quality.height, double(boxes.back().max.y));
		deepest.push_back(depth_in_environment(scene, hull));
	}
	quality.mean_area /= double(soft_bodies);
	for_each_near_pair(boxes, [&](std::size_t a, std::size_t b) {
		const double depth = softbody::penetration_depth(hulls[a], hulls[b]);
		quality.overlapping += depth > OVERLAP_LIMIT * scene.radius ? 1 : 0;
		deepest[a] = std::max(deepest[a], depth);
		deepest[b] = std::max(deepest[b], depth);
	});
	quality.mean_penetration = mean(deepest) / scene.radius;
	quality.worst_penetration = *std::max_element(deepest.begin(), deepest.end()) / scene.radius;
	return quality;
}

std::vector<PileRun> run_piles(const PileScene &scene, const std::vector<PileEngine *> &engines, int steps, PileClock clock) {
	std::vector<std::vector<double>> times(engines.size());
	for (int done = 0; done < steps; done += TURN) {
		for (std::size_t e = 0; e < engines.size(); ++e) {
			for (int i = done; i < std::min(done + TURN, steps); ++i) {
				const double begin = seconds_of(clock);
				engines[e]->step();
				times[e].push_back(1e9 * (seconds_of(clock) - begin) / double(scene.bodies.size()));
			}
		}
	}
	std::vector<PileRun> runs;
	for (std::size_t e = 0; e < engines.size(); ++e) {
		const std::vector<double> settled(times[e].begin() + steps / 2, times[e].end());
		PileRun run;
		run.median = quantile(settled, 0.5);
		run.low = quantile(settled, 0.1);
		run.high = quantile(settled, 0.9);
		run.mean = mean(settled);
		run.median_whole = quantile(times[e], 0.5);
		run.mean_whole = mean(times[e]);
		run.worst = *std::max_element(times[e].begin(), times[e].end());
		run.hulls = engines[e]->hulls();
		run.quality = judge_pile(scene, run.hulls);
		runs.push_back(std::move(run));
	}
	return runs;
}

} // namespace bench
