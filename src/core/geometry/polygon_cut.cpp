// SPDX-License-Identifier: MIT
// Cuts a simple polygon along a line of straight parts into smaller simple polygons.
#include "core/geometry/polygon_cut.h"

#include "core/geometry/mean_value.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace softbody {

namespace {

using Ring = std::vector<std::uint32_t>;

// Share of a segment by which it counts as longer at both ends when meetings are looked for. A meeting found twice does no harm.
constexpr double END_SLACK = 1e-9;

double size_of(Vec2d v) {
	return std::sqrt(dot(v, v));
}

Vec2 between(Vec2 from, Vec2 to, double t) {
	return { Real(from.x + (double(to.x) - from.x) * t), Real(from.y + (double(to.y) - from.y) * t) };
}

// Whether point lies inside, by the even-odd rule in double: the place may be no float.
bool is_inside(Vec2d p, std::span<const Vec2> polygon) {
	bool inside = false;
	for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
		const Vec2d a(polygon[j]);
		const Vec2d b(polygon[i]);
		if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) {
			inside = !inside;
		}
	}
	return inside;
}

// Where the straight ways from a to b and from c to d meet, as a share of each; nothing where they are parallel.
std::optional<std::pair<double, double>> meeting(Vec2d a, Vec2d b, Vec2d c, Vec2d d) {
	const Vec2d along = b - a;
	const Vec2d across = d - c;
	const double turn = cross(along, across);
	const double t = cross(c - a, across) / turn;
	const double u = cross(c - a, along) / turn;
	const bool meets = t >= -END_SLACK && t <= 1 + END_SLACK && u >= -END_SLACK && u <= 1 + END_SLACK; // false for NaN
	return meets ? std::optional(std::pair(std::clamp(t, 0.0, 1.0), std::clamp(u, 0.0, 1.0))) : std::nullopt;
}

// A place where the blade meets an outline.
struct Crossing {
	double at = 0; ///< index of the blade's point before it, plus the share of the way to the next
	std::uint32_t edge = 0; ///< from this place of the ring to the next
	double t = 0; ///< of the way along that edge
};

// A part of the blade between two crossings.
struct Span {
	Crossing from;
	Crossing to;
};

// An end of a cut: a corner of the ring, or a place on an edge.
struct End {
	std::uint32_t edge = 0; ///< of the ring; for a corner the edge that begins there
	double t = 0; ///< 0 for a corner
	bool is_corner() const { return t == 0; }
};

class Cutter {
public:
	Cutter(std::span<const Vec2> polygon, std::span<const Vec2> twin, std::span<const Vec2> blade, const CutLimits &limits) :
			polygon_(polygon), twin_(twin), blade_(blade), limits_(limits) {
		Ring whole;
		for (std::uint32_t i = 0; i < polygon.size(); ++i) {
			cut_.points.push_back({ polygon[i], twin[i], i, i });
			whole.push_back(i);
		}
		waiting_.push_back({ std::move(whole), {} });
	}

	PolygonCut cut() {
		while (!waiting_.empty()) {
			Part part = std::move(waiting_.back());
			waiting_.pop_back();
			divide(std::move(part));
		}
		std::ranges::stable_sort(cut_.pieces, std::greater(), [&](const Ring &ring) { return std::abs(signed_area(places(ring, &CutPoint::twin))); });
		return std::move(cut_);
	}

private:
	// A piece that may be cut further, and the parts of the blade that have cut it free.
	struct Part {
		Ring ring;
		std::vector<std::pair<double, double>> used;
	};

	std::vector<Vec2> places(const Ring &ring, Vec2 CutPoint::*place) const {
		std::vector<Vec2> found;
		found.reserve(ring.size());
		for (const std::uint32_t point : ring) {
			found.push_back(cut_.points[point].*place);
		}
		return found;
	}

	// The blade's place `at`.
	Vec2d blade_at(double at) const {
		const std::size_t i = std::min(std::size_t(at), blade_.size() - 2);
		return Vec2d(blade_[i]) + (Vec2d(blade_[i + 1]) - Vec2d(blade_[i])) * (at - double(i));
	}

	std::vector<Crossing> crossings(std::span<const Vec2> outline) const;
	std::vector<Vec2d> path(const Span &span, Vec2d from, Vec2d to) const;
	void erase_loops(std::vector<Vec2d> &path) const;
	void thin_bends(std::vector<Vec2d> &path) const;
	bool goes_inside(const std::vector<Vec2d> &path, std::span<const Vec2> outline) const;
	End snapped(const Crossing &crossing, const Ring &ring) const;
	Vec2d place_of(const End &end, std::span<const Vec2> outline) const;
	bool follows_outline(const End &a, const End &b, std::size_t count) const;
	std::uint32_t add_between(std::uint32_t a, std::uint32_t b, double t);
	std::uint32_t add_bend(Vec2d place);
	void add_path(std::uint32_t from, std::uint32_t to, const std::vector<Vec2d> &path, Ring &added);
	std::optional<RefusedSpan> problem_of(const Ring &ring) const;
	bool try_span(const Part &part, std::span<const Vec2> outline, const Span &span, std::vector<RefusedSpan> &refused);
	void divide(Part part);

	std::span<const Vec2> polygon_;
	std::span<const Vec2> twin_;
	std::span<const Vec2> blade_;
	CutLimits limits_;
	PolygonCut cut_;
	std::vector<Part> waiting_;
};

std::vector<Crossing> Cutter::crossings(std::span<const Vec2> outline) const {
	std::vector<Crossing> found;
	const auto count = std::uint32_t(outline.size());
	for (std::size_t s = 0; s + 1 < blade_.size(); ++s) {
		const Vec2d p(blade_[s]);
		const Vec2d q(blade_[s + 1]);
		const double squared = dot(q - p, q - p);
		if (!(squared > 0)) {
			continue;
		}
		const double reach = limits_.snap / 1024;
		const double left = std::min(p.x, q.x) - reach, right = std::max(p.x, q.x) + reach;
		const double low = std::min(p.y, q.y) - reach, high = std::max(p.y, q.y) + reach;
		for (std::uint32_t i = 0; i < count; ++i) {
			const Vec2d a(outline[i]);
			const Vec2d b(outline[i + 1 < count ? i + 1 : 0]);
			if (std::max(a.x, b.x) < left || std::min(a.x, b.x) > right || std::max(a.y, b.y) < low || std::min(a.y, b.y) > high) {
				continue;
			}
			if (const auto met = meeting(p, q, a, b)) {
				found.push_back({ double(s) + met->first, i, met->second });
			}
			// A blade along an edge meets its corners, whatever rounding makes of it.
			const double t = dot(a - p, q - p) / squared;
			if (t >= 0 && t <= 1 && size_of(p + (q - p) * t - a) <= reach) {
				found.push_back({ double(s) + t, i, 0 });
			}
		}
	}
	std::ranges::stable_sort(found, {}, &Crossing::at);
	return found;
}

// The blade's way from one end to the other, with the bends between them.
std::vector<Vec2d> Cutter::path(const Span &span, Vec2d from, Vec2d to) const {
	std::vector<Vec2d> path = { from };
	for (double bend = std::floor(span.from.at) + 1; bend < span.to.at; ++bend) {
		path.push_back(Vec2d(blade_[std::size_t(bend)]));
	}
	path.push_back(to);
	return path;
}

// Where the path meets itself it goes on as if it had not gone round.
void Cutter::erase_loops(std::vector<Vec2d> &path) const {
	for (std::size_t i = 0; i + 3 < path.size(); ++i) {
		for (std::size_t j = path.size() - 2; j > i + 1; --j) {
			const auto met = meeting(path[i], path[i + 1], path[j], path[j + 1]);
			if (met) {
				path[i + 1] = path[i] + (path[i + 1] - path[i]) * met->first;
				path.erase(path.begin() + std::ptrdiff_t(i) + 2, path.begin() + std::ptrdiff_t(j) + 1);
				break;
			}
		}
	}
}

// Bends closer to the last one, or to the end, than this make no corner.
void Cutter::thin_bends(std::vector<Vec2d> &path) const {
	const double least = std::max(limits_.snap, limits_.spacing / 2);
	std::vector<Vec2d> kept = { path.front() };
	for (std::size_t i = 1; i + 1 < path.size(); ++i) {
		if (size_of(path[i] - kept.back()) >= least && size_of(path[i] - path.back()) >= least) {
			kept.push_back(path[i]);
		}
	}
	kept.push_back(path.back());
	path = std::move(kept);
}

bool Cutter::goes_inside(const std::vector<Vec2d> &path, std::span<const Vec2> outline) const {
	Vec2d sample = path[0];
	double longest = 0;
	for (std::size_t i = 0; i + 1 < path.size(); ++i) {
		if (const double size = size_of(path[i + 1] - path[i]); size > longest) {
			longest = size;
			sample = (path[i] + path[i + 1]) * 0.5;
		}
	}
	return longest > limits_.snap / 1024 && is_inside(sample, outline);
}

End Cutter::snapped(const Crossing &crossing, const Ring &ring) const {
	const std::uint32_t next = crossing.edge + 1 < ring.size() ? crossing.edge + 1 : 0;
	const CutPoint &a = cut_.points[ring[crossing.edge]];
	const CutPoint &b = cut_.points[ring[next]];
	const double size = std::min(size_of(difference(b.position, a.position)), size_of(difference(b.twin, a.twin)));
	const double share = size > 0 ? limits_.snap / size : 1;
	const bool is_first = crossing.t <= 0.5;
	if (is_first ? crossing.t <= share : 1 - crossing.t <= share) {
		return { is_first ? crossing.edge : next, 0 };
	}
	return { crossing.edge, crossing.t };
}

Vec2d Cutter::place_of(const End &end, std::span<const Vec2> outline) const {
	const Vec2 a = outline[end.edge];
	return end.is_corner() ? Vec2d(a) : Vec2d(between(a, outline[end.edge + 1 < outline.size() ? end.edge + 1 : 0], end.t));
}

// Whether the straight way from one end to the other is a part of an edge.
bool Cutter::follows_outline(const End &a, const End &b, std::size_t count) const {
	const auto is_next = [&](const End &from, const End &to) { return to.is_corner() && (from.edge + 1) % count == to.edge; };
	return a.edge == b.edge || is_next(a, b) || is_next(b, a);
}

std::uint32_t Cutter::add_between(std::uint32_t a, std::uint32_t b, double t) {
	const CutPoint &from = cut_.points[a];
	const CutPoint &to = cut_.points[b];
	cut_.points.push_back({ between(from.position, to.position, t), between(from.twin, to.twin, t), a, b, t });
	return std::uint32_t(cut_.points.size() - 1);
}

std::uint32_t Cutter::add_bend(Vec2d place) {
	CutPoint bend;
	bend.position = Vec2(place);
	bend.weights = mean_value_weights(polygon_, bend.position);
	Vec2d twin;
	for (std::size_t i = 0; i < twin_.size(); ++i) {
		twin += difference(twin_[i], twin_[0]) * bend.weights[i];
	}
	bend.twin = Vec2(twin + Vec2d(twin_[0]));
	cut_.points.push_back(std::move(bend));
	return std::uint32_t(cut_.points.size() - 1);
}

// The points of a cut between its ends, which are points already.
void Cutter::add_path(std::uint32_t from, std::uint32_t to, const std::vector<Vec2d> &path, Ring &added) {
	std::uint32_t last = from;
	for (std::size_t i = 1; i < path.size(); ++i) {
		const bool is_end = i + 1 == path.size();
		const std::uint32_t next = is_end ? to : add_bend(path[i]);
		const double parts = limits_.spacing > 0 ? std::round(size_of(path[i] - path[i - 1]) / limits_.spacing) : 1;
		for (double k = 1; k < std::min(parts, 256.0); ++k) {
			added.push_back(add_between(last, next, k / std::min(parts, 256.0)));
		}
		if (!is_end) {
			added.push_back(next);
		}
		last = next;
	}
}

// What keeps a ring from being a piece.
std::optional<RefusedSpan> Cutter::problem_of(const Ring &ring) const {
	using Reason = RefusedSpan::Reason;
	const std::vector<Vec2> here = places(ring, &CutPoint::position);
	const std::vector<Vec2> there = places(ring, &CutPoint::twin);
	if (ring.size() < 3) {
		return RefusedSpan{ Reason::SMALL, {}, {}, 0 };
	}
	const double area = signed_area(there);
	if (!(area > 0) || !(area >= limits_.least_area)) {
		return RefusedSpan{ Reason::SMALL, {}, {}, std::max(area, 0.0) };
	}
	if (const double width = 2 * area / double(perimeter(there)); !(width >= limits_.least_width)) {
		return RefusedSpan{ Reason::THIN, {}, {}, width };
	}
	if (is_folded(here) || is_folded(there)) {
		return RefusedSpan{ Reason::CROSSING, {}, {}, 0 };
	}
	return {};
}

bool Cutter::try_span(const Part &part, std::span<const Vec2> outline, const Span &span, std::vector<RefusedSpan> &refused) {
	const Ring &ring = part.ring;
	End from = snapped(span.from, ring);
	End to = snapped(span.to, ring);
	std::vector<Vec2d> way = path(span, place_of(from, outline), place_of(to, outline));
	if (!goes_inside(path(span, blade_at(span.from.at), blade_at(span.to.at)), outline)) {
		return false;
	}
	erase_loops(way);
	thin_bends(way);
	if ((from.edge == to.edge && from.t == to.t) || (way.size() == 2 && follows_outline(from, to, ring.size()))) {
		return false; // along the outline, or a loop that would cut out a hole
	}
	const std::size_t kept_points = cut_.points.size();
	const auto refuse = [&](RefusedSpan problem) {
		cut_.points.resize(kept_points);
		problem.from = Vec2(blade_at(span.from.at));
		problem.to = Vec2(blade_at(span.to.at));
		refused.push_back(problem);
		return false;
	};
	if (cut_.pieces.size() + waiting_.size() + 2 > limits_.most_pieces) {
		return refuse({ RefusedSpan::Reason::MANY, {}, {}, double(limits_.most_pieces) });
	}
	if (size_of(way.back() - way.front()) < limits_.snap && way.size() == 2) {
		return refuse({ RefusedSpan::Reason::THIN, {}, {}, size_of(way.back() - way.front()) });
	}
	// The ring once more with the ends of the cut as corners, from one end to the other and back.
	const bool is_swapped = std::pair(to.edge, to.t) < std::pair(from.edge, from.t);
	if (is_swapped) {
		std::swap(from, to);
		std::ranges::reverse(way);
	}
	const auto point_at = [&](const End &end) {
		return end.is_corner() ? ring[end.edge] : add_between(ring[end.edge], ring[end.edge + 1 < ring.size() ? end.edge + 1 : 0], end.t);
	};
	const std::uint32_t first = point_at(from);
	const std::uint32_t last = point_at(to);
	Ring added;
	add_path(first, last, way, added);
	Ring inner = { first };
	for (std::size_t i = from.edge + 1; i <= to.edge; ++i) {
		if (ring[i] != last) {
			inner.push_back(ring[i]);
		}
	}
	inner.push_back(last);
	Ring outer = { last };
	for (std::size_t i = to.edge + 1; i < ring.size(); ++i) {
		outer.push_back(ring[i]);
	}
	for (std::size_t i = 0; i <= from.edge; ++i) {
		if (ring[i] != first) {
			outer.push_back(ring[i]);
		}
	}
	outer.push_back(first);
	inner.insert(inner.end(), added.rbegin(), added.rend());
	outer.insert(outer.end(), added.begin(), added.end());
	// A blade that follows the outline through several corners leaves a sliver of rounding.
	double way_size = 0;
	for (std::size_t i = 0; i + 1 < way.size(); ++i) {
		way_size += size_of(way[i + 1] - way[i]);
	}
	const double sliver = limits_.snap / 64 * way_size;
	if (std::abs(double(signed_area(places(inner, &CutPoint::position)))) < sliver || std::abs(double(signed_area(places(outer, &CutPoint::position)))) < sliver) {
		cut_.points.resize(kept_points);
		return false;
	}
	for (const Ring *side : { &inner, &outer }) {
		if (const auto problem = problem_of(*side)) {
			return refuse(*problem);
		}
	}
	std::vector<std::pair<double, double>> used = part.used;
	used.push_back({ span.from.at, span.to.at });
	waiting_.push_back({ std::move(outer), used });
	waiting_.push_back({ std::move(inner), std::move(used) });
	return true;
}

void Cutter::divide(Part part) {
	const std::vector<Vec2> outline = places(part.ring, &CutPoint::position);
	std::vector<RefusedSpan> refused;
	const std::vector<Crossing> found = blade_.size() > 1 ? crossings(outline) : std::vector<Crossing>();
	for (std::size_t i = 0; i + 1 < found.size(); ++i) {
		const Span span{ found[i], found[i + 1] };
		const double middle = (span.from.at + span.to.at) / 2;
		const bool is_used = std::ranges::any_of(part.used, [&](const auto &range) { return middle >= range.first && middle <= range.second; });
		if (span.to.at > span.from.at && !is_used && try_span(part, outline, span, refused)) {
			return;
		}
	}
	cut_.refused.insert(cut_.refused.end(), refused.begin(), refused.end());
	cut_.pieces.push_back(std::move(part.ring));
}

} // namespace

// A corner lies on two edges, a point of the outline on one, and others on none.
std::vector<std::optional<std::uint32_t>> source_edges(const PolygonCut &cut, std::size_t corner_count, std::span<const std::uint32_t> piece) {
	using Edges = std::array<std::optional<std::uint32_t>, 2>;
	const auto shared = [](const Edges &a, const Edges &b) {
		Edges both;
		std::size_t count = 0;
		for (const auto &edge : a) {
			if (edge && std::ranges::find(b, edge) != b.end()) {
				both[count++] = edge;
			}
		}
		return both;
	};
	std::vector<Edges> edges_of;
	for (const CutPoint &point : cut.points) {
		const std::size_t i = edges_of.size();
		if (i < corner_count) {
			edges_of.push_back({ std::uint32_t((i + corner_count - 1) % corner_count), std::uint32_t(i) });
		} else {
			edges_of.push_back(point.weights.empty() ? shared(edges_of[point.a], edges_of[point.b]) : Edges{});
		}
	}
	std::vector<std::optional<std::uint32_t>> sources;
	for (std::size_t i = 0; i < piece.size(); ++i) {
		sources.push_back(shared(edges_of[piece[i]], edges_of[piece[(i + 1) % piece.size()]])[0]);
	}
	return sources;
}

PolygonCut cut_polygon(std::span<const Vec2> polygon, std::span<const Vec2> twin, std::span<const Vec2> blade, const CutLimits &limits) {
	return Cutter(polygon, twin, blade, limits).cut();
}

} // namespace softbody
