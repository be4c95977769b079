// SPDX-License-Identifier: MIT
// Cuts a soft body, as it is deformed, into smaller ones that go on where it was.
#include "core/creator/body_cut.h"

#include "core/creator/structure.h"
#include "core/geometry/mean_value.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace softbody {

namespace {

// Least distance of a new corner from the next one, as a share of the mean hull edge and of the side of a square of the body's
// area; the smaller counts. Larger: cuts go beside where they were drawn. Smaller: short edges, which take more substeps.
constexpr double SNAP_OF_EDGE = 0.1;
constexpr double SNAP_OF_SIZE = 0.02;

// Least distance of new corners in units of the last digit of a place [1]: far from the origin rounding would cross them.
constexpr double SNAP_DIGITS = 64;

Status check_limits(const BodyCutLimits &limits) {
	return first_error({ check_between("smallest_piece", double(limits.smallest_piece), 0, 0.5, ""),
			check_at_least("least_width", double(limits.least_width), 0, "px"),
			check_between("most_pieces", limits.most_pieces, 1, MAX_CUT_PIECES, "") });
}

Status check_blade(std::span<const Vec2> blade) {
	if (blade.size() < 2 || blade.size() > MAX_BLADE_POINTS) {
		return Error{ "blade", std::to_string(blade.size()) + " points", "must have between 2 and " + std::to_string(MAX_BLADE_POINTS) + " points",
			blade.size() < 2 ? "give the places where it begins and ends" : "leave out points" };
	}
	return check_all_finite("blade", blade);
}

Error refusal_of(const RefusedSpan &span, double area, const BodyCutLimits &limits) {
	switch (span.reason) {
		case RefusedSpan::Reason::SMALL:
			return { "smallest_piece", number_text(span.value / area), "must be at least " + number_text(double(limits.smallest_piece)) + " of the area",
				"cut farther from the border, or allow smaller pieces" };
		case RefusedSpan::Reason::THIN:
			return { "least_width", number_text(span.value), "must be at least " + number_text(double(limits.least_width)) + " wide",
				"cut farther from the border" };
		case RefusedSpan::Reason::MANY:
			return { "most_pieces", std::to_string(limits.most_pieces) + " pieces", "must be at most that many", "cut in several strokes" };
		case RefusedSpan::Reason::CROSSING:
			break;
	}
	return { "cut", "a way through the body that its rest shape does not have", "must part it into pieces that do not cross themselves",
		"cut where the body is less bent" };
}

double mean_edge(std::span<const Vec2> hull) {
	return double(perimeter(hull)) / double(hull.size());
}

CutLimits geometric_limits(const SoftBodyData &body, const BodyCutLimits &limits) {
	CutLimits result;
	result.least_area = double(limits.smallest_piece) * double(body.shape().rest_area());
	result.least_width = double(limits.least_width);
	result.spacing = mean_edge(body.shape().rest_hull());
	double reach = 0;
	for (const Vec2 p : body.hull()) {
		reach = std::max({ reach, double(std::abs(p.x)), double(std::abs(p.y)) });
	}
	result.snap = std::max(std::min(SNAP_OF_EDGE * result.spacing, SNAP_OF_SIZE * std::sqrt(double(body.shape().rest_area()))), SNAP_DIGITS * double(std::numeric_limits<Real>::epsilon()) * reach);
	result.most_pieces = std::size_t(limits.most_pieces);
	return result;
}

// Index of the center point, or nothing.
std::optional<std::uint32_t> center_of(const SoftBodyShape &shape, const StructureOptions &options) {
	const bool has_center = options.center_point && !options.elastic_triangles;
	return has_center ? std::optional(std::uint32_t(shape.point_count() - 1)) : std::nullopt;
}

// Factors on the springs of the whole, by the points that they join.
class PaintedFactors {
public:
	PaintedFactors(const SoftBodyShape &shape, const StructureOptions &options) {
		is_painted_ = !options.spring_stiffness_scales.empty() || !options.spring_damping_scales.empty() || !options.spring_length_scales.empty();
		if (!is_painted_) {
			return;
		}
		for (const Spring2D &spring : shape.springs()) {
			const Real size = length(shape.rest_positions()[spring.b] - shape.rest_positions()[spring.a]);
			factors_[std::minmax(spring.a, spring.b)] = { options.stiffness > 0 ? spring.stiffness / options.stiffness : Real(1),
				options.damping > 0 ? spring.damping / options.damping : Real(1), size > 0 ? spring.rest_length / size : Real(1) };
		}
	}
	bool is_painted() const { return is_painted_; }
	std::array<Real, 3> of(std::uint32_t a, std::uint32_t b) const {
		const auto found = factors_.find(std::minmax(a, b));
		return found != factors_.end() ? found->second : std::array<Real, 3>{ 1, 1, 1 };
	}

private:
	std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<Real, 3>> factors_;
	bool is_painted_ = false;
};

// The springs that the piece will have keep the factors of those they come from: of the same two points, or of the edge
// of which they are a part. All others are plain.
void paint(const SoftBodyShape &shape, const StructureOptions &options, const BodyCut &cut, const PaintedFactors &factors, BodyPiece &piece) {
	const std::size_t hull_count = piece.outline.size();
	std::optional<Vec2> center;
	if (options.center_point && !options.elastic_triangles) {
		Vec2 sum;
		for (const Vec2 p : piece.hull) {
			sum += p;
		}
		center = sum * (1 / Real(hull_count));
	}
	// The point of the whole that a point of the piece is; for a new one on an edge of the whole, that edge's ends.
	const auto origin = [&](std::uint32_t point) -> std::pair<std::uint32_t, std::uint32_t> {
		if (point >= hull_count + piece.inner_points.size()) {
			const std::uint32_t whole_center = center_of(shape, options).value_or(0);
			return { whole_center, whole_center };
		}
		if (point >= hull_count) {
			const std::uint32_t inner = std::uint32_t(shape.hull_count()) + piece.inner_points[point - hull_count];
			return { inner, inner };
		}
		const CutPoint &corner = cut.polygon.points[piece.outline[point]];
		return corner.weights.empty() ? std::pair(corner.a, corner.b) : std::pair(piece.outline[point], piece.outline[point]);
	};
	for (const auto [a, b] : automatic_springs(piece.hull, piece.options.inner_points, center)) {
		const auto [a_from, a_to] = origin(a);
		const auto [b_from, b_to] = origin(b);
		std::array<Real, 3> values = { 1, 1, 1 };
		if (a_from == a_to && b_from == b_to) {
			values = factors.of(a_from, b_from);
		} else if (a_from == a_to && (a_from == b_from || a_from == b_to)) {
			values = factors.of(b_from, b_to);
		} else if (b_from == b_to && (b_from == a_from || b_from == a_to)) {
			values = factors.of(a_from, a_to);
		} else if (std::minmax(a_from, a_to) == std::minmax(b_from, b_to)) {
			values = factors.of(a_from, a_to);
		}
		piece.options.spring_stiffness_scales.push_back(values[0]);
		piece.options.spring_damping_scales.push_back(values[1]);
		piece.options.spring_length_scales.push_back(values[2]);
	}
}

// The pins of the body go with their points; the pin of a point that no piece has goes to the nearest one there.
void assign_pins(const SoftBodyData &body, const StructureOptions &options, BodyCut &cut) {
	if (!body.has_pins()) {
		return;
	}
	const std::size_t hull_count = body.shape().hull_count();
	for (std::uint32_t point = 0; point < body.point_count(); ++point) {
		if (!body.is_pinned(point)) {
			continue;
		}
		bool is_found = false;
		for (BodyPiece &piece : cut.pieces) {
			const auto &list = point < hull_count ? piece.outline : piece.inner_points;
			const std::uint32_t wanted = point < hull_count ? point : point - std::uint32_t(hull_count);
			const auto found = std::ranges::find(list, wanted);
			if (found != list.end()) {
				const std::size_t place = std::size_t(found - list.begin()) + (point < hull_count ? 0 : piece.outline.size());
				piece.pins.push_back({ std::uint32_t(place), point });
				is_found = true;
			}
		}
		if (is_found) {
			continue;
		}
		BodyPiece *nearest = nullptr;
		std::uint32_t nearest_point = 0;
		double least = HUGE_VAL;
		for (BodyPiece &piece : cut.pieces) {
			std::vector<Vec2> outline;
			for (const std::uint32_t corner : piece.outline) {
				outline.push_back(cut.polygon.points[corner].position);
			}
			const bool holds = point_in_polygon(body.positions()[point], outline);
			const bool is_center = center_of(body.shape(), options) == point;
			for (std::uint32_t i = 0; i < outline.size(); ++i) {
				const double distance = double(length_squared(outline[i] - body.positions()[point])) * (holds ? 1e-6 : 1);
				if (distance < least) {
					least = distance;
					nearest = &piece;
					nearest_point = is_center && holds ? std::uint32_t(piece.outline.size() + piece.inner_points.size()) : i;
				}
			}
		}
		const std::pair<std::uint32_t, std::uint32_t> pin{ nearest_point, point };
		if (std::ranges::find(nearest->pins, pin.first, &std::pair<std::uint32_t, std::uint32_t>::first) == nearest->pins.end()) {
			nearest->pins.push_back(pin);
		}
	}
}

struct Momentum {
	double mass = 0;
	Vec2d first; ///< mass times place
	Vec2d linear;
	double angular = 0;
	double second = 0; ///< mass times place squared

	// Places are relative to `base`, near the bodies.
	void add(const SoftBodyData &body, Vec2 base) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const double m = double(body.shape().masses()[i]);
			const Vec2d arm = difference(body.positions()[i], base);
			const Vec2d velocity(body.velocities()[i]);
			mass += m;
			first += arm * m;
			linear += velocity * m;
			angular += m * cross(arm, velocity);
			second += m * dot(arm, arm);
		}
	}
};

} // namespace

Result<BodyCut> plan_cut(const SoftBodyData &body, const StructureOptions &options, std::span<const Vec2> blade, const BodyCutLimits &limits) {
	if (Status status = first_error({ check_limits(limits), check_blade(blade) })) {
		return *status;
	}
	if (is_folded(body.hull())) {
		return Error{ "shape", "folded over itself", "must not cross itself where it is cut", "cut it when it has its shape back" };
	}
	const SoftBodyShape &shape = *body.shared_shape(); // without dents, as `options` describe it
	std::vector<Vec2> rest;
	for (const Vec2 p : shape.rest_hull()) {
		rest.push_back(p + shape.origin_offset());
	}
	BodyCut cut;
	cut.polygon = cut_polygon(body.hull(), rest, blade, geometric_limits(body, limits));
	if (cut.polygon.pieces.size() == 1 && !cut.polygon.refused.empty()) {
		return refusal_of(cut.polygon.refused.front(), double(shape.rest_area()), limits);
	}
	const PaintedFactors factors(shape, options);
	double whole_area = 0;
	for (const std::vector<std::uint32_t> &outline : cut.polygon.pieces) {
		BodyPiece piece;
		piece.outline = outline;
		for (const std::uint32_t corner : outline) {
			piece.hull.push_back(cut.polygon.points[corner].twin);
		}
		piece.share = signed_area(piece.hull);
		whole_area += piece.share;
		cut.pieces.push_back(std::move(piece));
	}
	std::vector<std::uint32_t> free_points(options.inner_points.size());
	for (std::uint32_t i = 0; i < free_points.size(); ++i) {
		free_points[i] = i;
	}
	for (BodyPiece &piece : cut.pieces) {
		piece.share /= whole_area;
		piece.options = options;
		piece.options.mass = Real(double(shape.total_mass()) * piece.share);
		piece.options.triangle_points = int(std::lround(options.triangle_points * piece.share));
		piece.options.inner_points.clear();
		std::erase_if(free_points, [&](std::uint32_t i) {
			// A point on the cut itself would be a corner beside the cut's own.
			const bool is_inside = point_in_polygon(options.inner_points[i], piece.hull) &&
					double(nearest_place(piece.hull, options.inner_points[i]).distance_squared) > 0;
			if (is_inside) {
				piece.inner_points.push_back(i);
				piece.options.inner_points.push_back(options.inner_points[i]);
			}
			return is_inside;
		});
		piece.options.springs.clear();
		piece.options.spring_stiffness_scales.clear();
		piece.options.spring_damping_scales.clear();
		piece.options.spring_length_scales.clear();
		if (factors.is_painted()) {
			paint(shape, options, cut, factors, piece);
		}
	}
	assign_pins(body, options, cut);
	return cut;
}

namespace {

// Dents are carried as places are. A piece that they would fold does without.
void place_dents(const SoftBodyData &body, SoftBodyData &placed, const auto &fill) {
	std::vector<Vec2> dents(body.point_count());
	for (std::size_t i = 0; i < dents.size(); ++i) {
		dents[i] = body.shape().rest_positions()[i] - body.shared_shape()->rest_positions()[i];
	}
	std::vector<Vec2> places(placed.point_count());
	fill(dents, places);
	Vec2 center;
	for (std::size_t i = 0; i < places.size(); ++i) {
		places[i] += placed.shape().rest_positions()[i];
		center += places[i] * (placed.shape().masses()[i] / placed.shape().total_mass());
	}
	for (Vec2 &place : places) {
		place -= center;
	}
	static_cast<void>(placed.set_rest_positions(places));
}

} // namespace

void place_piece(const SoftBodyData &body, const BodyCut &cut, std::size_t piece_index, SoftBodyData &placed) {
	const BodyPiece &piece = cut.pieces[piece_index];
	const std::size_t hull_count = piece.outline.size();
	const std::size_t known = hull_count + piece.inner_points.size();
	// New points inside are carried by the piece's hull.
	std::vector<std::vector<double>> weights;
	for (std::size_t i = known; i < placed.point_count(); ++i) {
		weights.push_back(mean_value_weights(placed.shape().rest_hull(), placed.shape().rest_positions()[i]));
	}
	const auto fill = [&](std::span<const Vec2> of_whole, std::span<Vec2> of_piece) {
		const std::vector<Vec2> corners = carried<Vec2>(cut.polygon, of_whole);
		for (std::size_t i = 0; i < hull_count; ++i) {
			of_piece[i] = corners[piece.outline[i]];
		}
		for (std::size_t i = hull_count; i < known; ++i) {
			of_piece[i] = of_whole[body.shape().hull_count() + piece.inner_points[i - hull_count]];
		}
		for (std::size_t i = known; i < of_piece.size(); ++i) {
			Vec2d sum;
			for (std::size_t k = 0; k < hull_count; ++k) {
				sum += difference(of_piece[k], of_piece[0]) * weights[i - known][k];
			}
			of_piece[i] = Vec2(sum + Vec2d(of_piece[0]));
		}
	};
	if (body.is_dented()) {
		place_dents(body, placed, fill);
	}
	placed.pause_damage();
	placed.set_placed(false); // its points are where those of the whole were
	fill(body.positions(), placed.mutable_positions());
	for (std::size_t i = 0; i < hull_count; ++i) {
		placed.mutable_positions()[i] = cut.polygon.points[piece.outline[i]].position; // pieces that were found simple are
	}
	fill(body.previous_positions(), placed.mutable_previous_positions());
	fill(body.velocities(), placed.mutable_velocities());
}

void keep_momentum(const SoftBodyData &body, std::span<SoftBodyData *const> pieces) {
	const Vec2 base = body.positions()[0];
	Momentum before;
	before.add(body, base);
	Momentum after;
	for (const SoftBodyData *piece : pieces) {
		after.add(*piece, base);
	}
	// A rigid motion about the pieces' common center c: M v0 is the missing momentum, I ω what then is missing of the spin.
	const Vec2d center = after.first * (1 / after.mass);
	const double inertia = after.second - after.mass * dot(center, center);
	const Vec2d missing = before.linear - after.linear;
	const Vec2d shift = missing * (1 / after.mass);
	const double spin = inertia > 0 ? (before.angular - after.angular - cross(center, missing)) / inertia : 0;
	if (!std::isfinite(spin) || !std::isfinite(shift.x) || !std::isfinite(shift.y)) {
		return;
	}
	for (SoftBodyData *piece : pieces) {
		const std::span<Vec2> velocities = piece->mutable_velocities();
		for (std::size_t i = 0; i < velocities.size(); ++i) {
			if (piece->inverse_masses()[i] != 0) {
				const Vec2d arm = difference(piece->positions()[i], base) - center;
				velocities[i] = Vec2(Vec2d(velocities[i]) + shift + perpendicular(arm) * spin);
			}
		}
	}
}

Result<std::vector<SoftBodyData>> cut_body(const SoftBodyData &body, const StructureOptions &options, std::span<const Vec2> blade,
		const BodyCutLimits &limits) {
	const auto cut = plan_cut(body, options, blade, limits);
	if (!cut) {
		return cut.error();
	}
	return make_pieces(body, cut.value());
}

Result<std::vector<SoftBodyData>> make_pieces(const SoftBodyData &body, const BodyCut &cut) {
	std::vector<SoftBodyData> made;
	for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
		const BodyPiece &piece = cut.pieces[i];
		const auto shape = SoftBodyCreator::create_polygon(piece.hull, piece.options);
		if (!shape) {
			return shape.error();
		}
		auto fresh = SoftBodyData::create(shape.value(), body.settings());
		if (!fresh) {
			return fresh.error();
		}
		place_piece(body, cut, i, fresh.value());
		fresh.value().set_rotation_memory(body.rotation_memory());
		for (const auto &[point, source] : piece.pins) {
			if (Status status = fresh.value().set_pinned(point, true)) {
				return *status;
			}
		}
		made.push_back(std::move(fresh.value()));
	}
	std::vector<SoftBodyData *> pieces;
	for (SoftBodyData &piece : made) {
		pieces.push_back(&piece);
	}
	keep_momentum(body, pieces);
	return made;
}

} // namespace softbody
