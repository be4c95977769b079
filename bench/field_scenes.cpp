// SPDX-License-Identifier: MIT
// The scenes by which the field judges solvers (Solver2D by Erin Catto; AVBD), built of soft bodies: an arch, a house of
// cards, a pyramid, chains, a bridge, dominoes, heavy loads, a grid of joints, a box that is too small. Bodies are new
// nodes; each row also says what a player expects of the scene, and whether it is so.
#include "bench.h"
#include "field_stage.h"

#include "core/model/body_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace bench {

namespace {

using nlohmann::json;
using softbody::BodyId;
using softbody::JointAnchor;
using softbody::Real;
using softbody::Vec2;

constexpr double SIDE = 100; // px, of a square block: as wide as a new node
constexpr double DEGREE = std::numbers::pi / 180;
constexpr double NO_GAP = 1; // px that a rigid joint may be open before it is seen
constexpr double DEEP = 0.1; // R that bodies may be in one another before it is seen

json judged(json row, const char *must_be, bool is_met) {
	row["must_be"] = must_be;
	row["verdict"] = is_met ? "holds" : "fails";
	std::fprintf(stderr, "  %s\n", row.dump().c_str());
	return row;
}

bool is_intact(const json &row) {
	return row["folded"] == 0 && row["resets"] == 0;
}

// Eleven blocks along a hanging chain turned over, in which a load presses along the arch alone. A rigid one stands with a
// friction above 1/3, as its feet press outward with a third of its weight.
json arch(const Firmness &firmness, bool quick) {
	constexpr int BLOCKS = 11;
	constexpr double SCALE = 200; // px, of the catenary y = a cosh(x/a)
	constexpr double SLOPE = 3; // at the feet
	constexpr double THICKNESS = 120;
	const double rise = SCALE * (std::sqrt(1 + SLOPE * SLOPE) - 1);
	const auto joint = [&](int i, double side) { // of the two ends of the i-th joint
		const double along = SLOPE * SCALE * (2.0 * i / BLOCKS - 1); // from the top
		const double x = SCALE * std::asinh(along / SCALE);
		const double y = -rise + SCALE * (std::cosh(x / SCALE) - 1);
		const double angle = i == 0 || i == BLOCKS ? (i == 0 ? -90 : 90) * DEGREE : std::atan(along / SCALE);
		return Vec2{ Real(x + side * THICKNESS / 2 * std::sin(angle)), Real(y - side * THICKNESS / 2 * std::cos(angle)) };
	};
	Stage stage(firmness);
	stage.add_floor();
	std::vector<BodyId> blocks;
	for (int i = 0; i < BLOCKS; ++i) {
		Points outline = divided({ joint(i, 1), joint(i + 1, 1), joint(i + 1, -1), joint(i, -1) }, 16);
		const Vec2 at = center_outline(outline);
		blocks.push_back(stage.add(outline, at));
	}
	const BodyId keystone = blocks[BLOCKS / 2];
	const Vec2 start = stage.center(keystone);
	const double whole = quick ? 6 : 30;
	const auto has_fallen = [&] { return stage.center(keystone).y > start.y / 2; };
	stage.run(whole / 2, has_fallen);
	const Vec2 half = stage.center(keystone);
	stage.run(has_fallen() ? 0 : whole / 2, has_fallen);
	const Vec2 end = stage.center(keystone);
	json row = stage.row("arch");
	row.update({ { "stands_s", has_fallen() ? json(stage.seconds()) : json(whole) }, { "keystone_drop_px", end.y - start.y },
			{ "sideways_px", std::abs(end.x - start.x) }, { "late_drift_px", length(end - half) } });
	return judged(row, "stands to the end, the keystone drops by less than half a block and drifts less than 1 px late",
			!has_fallen() && end.y - start.y < THICKNESS / 2 && length(end - half) < 1 && is_intact(row));
}

// Pairs of cards that lean on each other, with flat ones between the storeys: 3, 2 and 1 pairs. Rigid cards lean safely at
// that angle with a friction of 0.4.
json card_house(const Firmness &firmness, bool quick) {
	constexpr int STOREYS = 3;
	constexpr double LONG = 120;
	constexpr double THICK = 12;
	constexpr double LEAN = 20 * DEGREE;
	const double wide = LONG * std::sin(LEAN) + THICK * std::cos(LEAN);
	const double tall = LONG * std::cos(LEAN) + THICK * std::sin(LEAN);
	const double pitch = std::max(2 * wide, LONG) + 1;
	const Points upright = rectangle(THICK, LONG);
	const Points flat = rectangle(LONG, THICK);
	Stage stage(firmness);
	stage.add_floor();
	double base = 0;
	BodyId top;
	for (int storey = 0; storey < STOREYS; ++storey) {
		const int pairs = STOREYS - storey;
		for (int i = 0; i < pairs; ++i) {
			const double x = (i - (pairs - 1) / 2.0) * pitch;
			top = stage.add(upright, { Real(x - wide / 2), Real(-base - tall / 2) }, 1, LEAN);
			stage.add(upright, { Real(x + wide / 2), Real(-base - tall / 2) }, 1, -LEAN);
		}
		for (int i = 0; i + 1 < pairs; ++i) {
			stage.add(flat, { Real((i - (pairs - 2) / 2.0) * pitch), Real(-base - tall - THICK / 2) });
		}
		base += tall + THICK;
	}
	const Vec2 start = stage.center(top);
	const double whole = quick ? 5 : 30;
	const auto has_fallen = [&] { return stage.center(top).y > 0.8 * double(start.y); };
	stage.run(whole, has_fallen);
	const double stands = has_fallen() ? stage.seconds() : whole;
	json row = stage.row("card_house");
	row.update({ { "stands_s", stands }, { "top_drift_px", length(stage.center(top) - start) } });
	return judged(row, "stands to the end, the top moves by less than a card is thick",
			!has_fallen() && double(length(stage.center(top) - start)) < THICK && is_intact(row));
}

json pyramid(int base, const Firmness &firmness, bool quick) {
	constexpr double PITCH = SIDE + 4;
	const Points square = rectangle(SIDE, SIDE);
	Stage stage(firmness);
	stage.add_floor();
	BodyId top;
	for (int level = 0; level < base; ++level) {
		for (int i = 0; i < base - level; ++i) {
			top = stage.add(square, { Real((i - (base - level - 1) / 2.0) * PITCH), Real(-(level + 0.5) * SIDE) });
		}
	}
	const Vec2 start = stage.center(top);
	stage.run(quick ? 5 : 40);
	const Vec2 end = stage.center(top);
	json row = stage.row("pyramid");
	const bool stands = double(end.y) < 0.6 * double(start.y);
	row.update({ { "base", base }, { "stands", stands }, { "top_drift_px", std::abs(end.x - start.x) },
			{ "top_sinks_px", end.y - start.y } });
	return judged(row, "the top keeps 60 % of its height and drifts by less than a tenth of a block, bodies are at most "
					   "0.1 R in one another, and all sleep within 20 s",
			stands && std::abs(double(end.x - start.x)) < SIDE / 10 && row["worst_penetration_R"] <= DEEP &&
					row["asleep_after_s"].is_number() && row["asleep_after_s"] <= 20 && is_intact(row));
}

// Links of 1 kg from a hook to a ball of so many times that; all is level at the start, and swings. `elastic`: by how much
// the chain hangs longer by its material alone, for small strain.
json ball_and_chain(double ratio, const Firmness &firmness, bool quick) {
	constexpr int LINKS = 20;
	constexpr double LINK = 60;
	constexpr double BALL = 100; // radius
	constexpr double THICK = 20;
	const Points link = rectangle(LINK, THICK);
	Stage stage(firmness);
	JointAnchor last = JointAnchor::at_place({ 0, 0 });
	for (int i = 0; i <= LINKS; ++i) {
		const bool is_ball = i == LINKS;
		const double half = is_ball ? BALL : LINK / 2;
		const BodyId id = is_ball ? stage.add(circle(BALL, 16, false), { Real(i * LINK + half), 0 }, ratio)
								  : stage.add(link, { Real(i * LINK + half), 0 });
		stage.join(last, stage.anchor(id, { Real(i * LINK), 0 }));
		last = stage.anchor(id, { Real((i + 1) * LINK), 0 });
	}
	const softbody::Joint held = stage.world().joints().back();
	double longest = 0;
	const auto reach = [&] {
		const double far = double(length(softbody::position_of(held.second, stage.body(held.second.body))));
		longest = std::max(longest, far);
		return far;
	};
	stage.run(quick ? 4 : 20, [&] {
		reach();
		return false;
	});
	json row = stage.row("ball_and_chain");
	const double whole = LINKS * LINK;
	const double youngs_modulus = double(softbody::Material{}.youngs_modulus) * firmness.times;
	const double elastic = (ratio + LINKS / 2.0) * FIELD_GRAVITY / (youngs_modulus * THICK);
	row.update({ { "mass_ratio", ratio }, { "elastic_stretch_percent", 100 * elastic },
			{ "widest_gap_px", stage.widest_gap() }, { "gap_at_end_px", stage.gap() },
			{ "most_stretch_percent", 100 * (longest / whole - 1) }, { "stretch_at_end_percent", 100 * (reach() / whole - 1) } });
	return judged(row, "no joint opens by more than 1 px, and the chain is never stretched by more than a tenth",
			stage.widest_gap() <= NO_GAP && longest <= 1.1 * whole && is_intact(row));
}

// Planks joined end to end between two places; bodies fall onto them.
json bridge(const Firmness &firmness, bool quick) {
	constexpr int PLANKS = 20;
	constexpr double PLANK = 100;
	constexpr int BODIES = 5;
	const Points plank = rectangle(PLANK, 25);
	Stage stage(firmness);
	std::vector<BodyId> planks;
	JointAnchor last = JointAnchor::at_place({ 0, 0 });
	for (int i = 0; i < PLANKS; ++i) {
		planks.push_back(stage.add(plank, { Real((i + 0.5) * PLANK), 0 }));
		stage.join(last, stage.anchor(planks.back(), { Real(i * PLANK), 0 }));
		last = stage.anchor(planks.back(), { Real((i + 1) * PLANK), 0 });
	}
	stage.join(last, JointAnchor::at_place({ Real(PLANKS * PLANK), 0 }));
	std::vector<BodyId> loads;
	for (int i = 0; i < BODIES; ++i) {
		loads.push_back(stage.add(circle(SIDE / 2, 16, false), { Real(PLANKS * PLANK * (i + 1) / (BODIES + 1)), -150 }));
	}
	stage.run(quick ? 5 : 30);
	double sag = 0;
	for (const BodyId id : planks) {
		sag = std::max(sag, double(stage.center(id).y));
	}
	const auto on = std::ranges::count_if(loads, [&](BodyId id) { return double(stage.center(id).y) < sag; });
	json row = stage.row("bridge");
	row.update({ { "widest_gap_px", stage.widest_gap() }, { "gap_at_end_px", stage.gap() }, { "sag_px", sag },
			{ "still_on_it", on }, { "fell_on_it", BODIES } });
	return judged(row, "no joint opens by more than 1 px, all bodies stay on it, it sags by less than a quarter of its span",
			stage.widest_gap() <= NO_GAP && on == BODIES && sag < PLANKS * PLANK / 4 && is_intact(row));
}

// A row of dominoes a meter apart, the first pushed at its top by 0.8 kg m/s.
json double_domino(const Firmness &firmness, bool quick) {
	constexpr int COUNT = 15;
	constexpr double PUSH = 80; // kg px/s
	const Points domino = rectangle(25, SIDE);
	Stage stage(firmness);
	stage.add_floor();
	std::vector<BodyId> dominoes;
	for (int i = 0; i < COUNT; ++i) {
		dominoes.push_back(stage.add(domino, { Real((i - COUNT / 2) * SIDE), Real(-SIDE / 2) }));
	}
	softbody::SoftBodyData &first = *stage.world().find(dominoes[0]);
	const auto hull = first.hull();
	const auto is_left_of = [](Vec2 a, Vec2 b) { return a.x + a.y < b.x + b.y; }; // the corner at the upper left
	const auto corner = std::uint32_t(std::ranges::min_element(hull, is_left_of) - hull.begin());
	check(first.apply_impulse(corner, { Real(PUSH), 0 }));
	const auto leans = [&](BodyId id) { return softbody::measure_frame(stage.body(id)).rotation; };
	const auto stands = [&](BodyId id) { return double(leans(id).c) > std::cos(45 * DEGREE); };
	json all_after = nullptr;
	std::size_t reached = 0;
	bool in_turn = true; // one that buckles under its own weight does not wait for its neighbor
	stage.run(quick ? 6 : 20, [&] {
		for (std::size_t i = reached; i < dominoes.size(); ++i) {
			if (!stands(dominoes[i])) {
				in_turn &= i == reached && leans(dominoes[i]).s > 0;
				reached = i + 1;
			}
		}
		if (all_after.is_null() && std::ranges::none_of(dominoes, stands)) {
			all_after = stage.seconds();
		}
		return false;
	});
	const auto standing = std::ranges::count_if(dominoes, stands);
	json row = stage.row("double_domino");
	row.update({ { "all_fallen_after_s", all_after }, { "left_standing", standing }, { "fell_in_turn", in_turn } });
	return judged(row, "all fall, one after the other and away from the push", standing == 0 && in_turn && is_intact(row));
}

// A block of 1 kg under an equal one of so many times its mass, in a shaft: free, any solid this soft tips over with more
// than E w² / (12 g h) on it, which is 2.5 kg.
json resting_load(double ratio, const Firmness &firmness, bool quick) {
	constexpr double PLAY = 5; // px, on either side
	const Points square = rectangle(SIDE, SIDE);
	Stage stage(firmness);
	stage.add_floor();
	stage.add_wall({ Real(-SIDE / 2 - PLAY), 0 }, { 1, 0 });
	stage.add_wall({ Real(SIDE / 2 + PLAY), 0 }, { -1, 0 });
	const BodyId lower = stage.add(square, { 0, Real(-SIDE / 2) });
	const BodyId upper = stage.add(square, { 0, Real(-SIDE * 1.5) }, ratio);
	const double whole = quick ? 4 : 20;
	stage.run(whole - 2);
	constexpr int LATE = int(2 / TICK);
	double sum = 0;
	for (int i = 0; i < LATE; ++i) {
		stage.step();
		sum += stage.speed() * stage.speed();
	}
	const double jitter = std::sqrt(sum / LATE);
	const bool is_on = stage.center(upper).y < stage.center(lower).y;
	json row = stage.row("resting_load");
	row.update({ { "mass_ratio", ratio }, { "is_on_top", is_on }, { "area_under_load", stage.area(lower) },
			{ "jitter_px_s", jitter } });
	return judged(row, "stays on top, at most 0.1 R inside; the lower body keeps half of its area; jitter below 1 px/s",
			is_on && row["worst_penetration_R"] <= DEEP && stage.area(lower) >= 0.45 && jitter < 1 && is_intact(row));
}

// Discs, each joined with its neighbors where they touch; seven in the middle of the top row hang from places.
json joint_grid(const Firmness &firmness, bool quick) {
	constexpr int COUNT = 25;
	constexpr int HELD = 3; // on either side of the middle
	const double radius = SIDE / 2;
	const Points disc = circle(radius, 16, false);
	Stage stage(firmness);
	std::vector<BodyId> discs;
	for (int row = 0; row < COUNT; ++row) {
		for (int column = 0; column < COUNT; ++column) {
			const Vec2 at{ Real(column * SIDE), Real(row * SIDE) };
			const BodyId id = stage.add(disc, at);
			if (column > 0) {
				const Vec2 between = at - Vec2{ Real(radius), 0 };
				stage.join(stage.anchor(discs.back(), between), stage.anchor(id, between));
			}
			const Vec2 above = at - Vec2{ 0, Real(radius) };
			if (row > 0) {
				stage.join(stage.anchor(discs[discs.size() - COUNT], above), stage.anchor(id, above));
			} else if (std::abs(column - COUNT / 2) <= HELD) {
				stage.join(JointAnchor::at_place(above), stage.anchor(id, above));
			}
			discs.push_back(id);
		}
	}
	const double whole = quick ? 1 : 30;
	stage.run(whole / 2);
	double late = 0;
	stage.run(whole / 2, [&] {
		late = std::max(late, stage.gap());
		return false;
	});
	double lowest = 0;
	for (const BodyId id : discs) {
		lowest = std::max(lowest, double(stage.center(id).y));
	}
	json row = stage.row("joint_grid");
	row.update({ { "joints", stage.world().joints().size() }, { "widest_gap_px", stage.widest_gap() }, { "late_gap_px", late },
			{ "hangs_px", lowest - (COUNT - 1) * SIDE }, { "ms_per_step", double(row["us_per_body_step"]) * 1e-3 * COUNT * COUNT } });
	return judged(row, "no joint opens by more than 1 px, and at the end the grid hangs still: less than 0.01 J a body",
			stage.widest_gap() <= NO_GAP && row["energy_at_end_J"] < 0.01 && is_intact(row));
}

// Discs in a box whose four walls close in two seconds, until rest areas fill 97 % of it.
json confined(const Firmness &firmness, bool quick) {
	constexpr int COUNT = 10;
	constexpr double FILL = 0.97;
	constexpr double CLOSING = 2; // s
	Stage stage(firmness);
	for (int i = 0; i < COUNT * COUNT; ++i) {
		const double x = (i % COUNT - (COUNT - 1) / 2.0) * (SIDE + 1);
		const double y = (i / COUNT - (COUNT - 1) / 2.0) * (SIDE + 1);
		stage.add(circle(SIDE / 2, 16, false), { Real(x), Real(y) });
	}
	const double wide = COUNT * (SIDE + 1) / 2.0;
	const double area = COUNT * COUNT * double(stage.world().soft_bodies()[0].shape().rest_area());
	const double narrow = std::sqrt(area / FILL) / 2;
	const auto close_to = [&](double half, double speed) {
		stage.world().clear_environment();
		for (const Vec2 inward : { Vec2{ 1, 0 }, Vec2{ -1, 0 }, Vec2{ 0, 1 }, Vec2{ 0, -1 } }) {
			stage.add_wall(inward * Real(-half), inward, inward * Real(speed));
		}
	};
	close_to(wide, 0);
	while (stage.seconds() < CLOSING) {
		const double share = std::min(1.0, (stage.seconds() + TICK) / CLOSING);
		close_to(wide + (narrow - wide) * share, (wide - narrow) / CLOSING);
		stage.step();
	}
	close_to(narrow, 0);
	stage.run(quick ? 2 : 30);
	json row = stage.row("confined");
	row.update({ { "fill", FILL }, { "speed_at_end_px_s", stage.speed() } });
	return judged(row, "none folded, at most 0.1 R in one another, and at rest: less than 0.001 J a body",
			row["worst_penetration_R"] <= DEEP && row["energy_at_end_J"] < 1e-3 && is_intact(row));
}

} // namespace

json field_scenes(const Options &options) {
	const bool quick = options.quick;
	json rows = json::array();
	std::vector<Firmness> materials = { {} };
	if (!quick) {
		materials.push_back({ "firm", 10 });
		materials.push_back({ "hard", 100 }); // hardly deformed: what is left is the solver's
	}
	for (const Firmness &firmness : materials) {
		rows.push_back(arch(firmness, quick));
		rows.push_back(card_house(firmness, quick));
		for (const int base : quick ? std::vector{ 10 } : std::vector{ 10, 12, 15 }) {
			rows.push_back(pyramid(base, firmness, quick));
		}
		for (const double ratio : quick ? std::vector{ 1e3 } : std::vector{ 10.0, 100.0, 1e3 }) {
			rows.push_back(ball_and_chain(ratio, firmness, quick));
		}
		rows.push_back(bridge(firmness, quick));
		rows.push_back(double_domino(firmness, quick));
		for (const double ratio : quick ? std::vector{ 10.0, 1e3, 5e4 } : std::vector{ 10.0, 100.0, 1e3, 1e4, 5e4 }) {
			rows.push_back(resting_load(ratio, firmness, quick));
		}
		rows.push_back(joint_grid(firmness, quick));
		rows.push_back(confined(firmness, quick));
	}
	return rows;
}

} // namespace bench
