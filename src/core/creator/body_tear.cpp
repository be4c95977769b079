// SPDX-License-Identifier: MIT
// Tears a soft body where strain is more than it bears.
#include "core/creator/body_tear.h"

#include "core/geometry/mean_value.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

namespace softbody {

namespace {

// Most places of the search along the longer side of the body.
constexpr int MOST_COLUMNS = 24;

// Distance of the places, of the mean distance of the hull's points [1].
constexpr double SPACING = 0.5;

// Distance by which the deformation is measured beside a place, of that of the places [1].
constexpr double DIFFERENCE = 0.05;

// Distance at which the middle of a spring has a quarter of its say in what a place bears, of the distance of the places [1].
constexpr double REACH = 0.5;

// Least part of what the mean bears that any place does [1].
constexpr double LEAST_STRENGTH = 1e-3;

// How far a way goes on beyond the outline, of the distance of the places [1].
constexpr double OVERSHOOT = 0.1;

// Resistance of what has failed, of that of what is not strained [1]: of two such ways the shorter one is taken.
constexpr double FAILED_RESISTANCE = 0.02;

// Mean of e/stretch along a way from which on it fails [1].
constexpr double FAILING_USE = 0.5;

// Strain of a line over what it bears from which on the body tears in any case [1].
constexpr Real HOPELESS_USE = 2;

// Ends of the way that are tried, the weakest way first. Others were refused for what they leave.
constexpr std::size_t MOST_TRIALS = 8;

// Share of the spacing by which bends of the way are straightened [1].
constexpr double STRAIGHTENED = 0.6;

struct Line {
	std::uint32_t a = 0;
	std::uint32_t b = 0;
	Real use = 0; ///< strain over what it bears [1]
};

// The most strained of the lines, by what each bears.
Line most_used_line(const SoftBodyData &body, Real stretch) {
	const SoftBodyShape &shape = *body.shared_shape();
	Real stiffness = 0;
	for (const Spring2D &spring : shape.springs()) {
		stiffness += spring.stiffness;
	}
	stiffness /= Real(std::max<std::size_t>(1, shape.springs().size()));
	Line most;
	for (const Spring2D &spring : shape.springs()) {
		const Real now = length(body.positions()[spring.b] - body.positions()[spring.a]);
		const Real strain = now / length(shape.rest_positions()[spring.b] - shape.rest_positions()[spring.a]) - 1;
		const Real bears = stiffness > 0 ? stretch * spring.stiffness / stiffness : stretch;
		if (strain > 0 && strain > most.use * bears) {
			most = { spring.a, spring.b, bears > 0 ? strain / bears : std::numeric_limits<Real>::max() };
		}
	}
	return most;
}

/// A place inside the body.
struct Place {
	int column = 0;
	int row = 0;
	Vec2 rest; ///< in the shape as it was made [length]
	Vec2 position; ///< in the world [length]
	/// Positions by rest positions: dx/dX and dx/dY [1].
	Vec2d stretch_x;
	Vec2d stretch_y;
	double bears = 1; ///< strain, of what the mean of the body bears [1]
	OutlinePlace exit; ///< on the outline at rest, beside it
	bool is_beside_outline = false;
};

/// Length at rest of a part of a way, and how much of it has failed.
struct Part {
	double length = 0; ///< at rest [length]
	double used = 0; ///< integral of min(1, e/stretch) along it [length]

	double cost() const { return length * (1 + FAILED_RESISTANCE) - used; }
	Part operator+(const Part &other) const { return { length + other.length, used + other.used }; }
};

/// A way from the start to the outline.
struct WayOut {
	std::size_t place = 0; ///< the last one
	Part part;
};

/// A search over places in rows and columns of the shape as it was made, which is never bent or folded.
class CrackSearch {
public:
	CrackSearch(const SoftBodyData &body, Real stretch) : body_(body), stretch_(double(stretch)) { make_places(); }

	/// Ways across the line, in the world and from outline to outline, the weakest first.
	std::vector<std::vector<Vec2>> across(const Line &line);
	/// Ways in the same direction, `step` distances of places from the line's middle towards the body's. None beyond that.
	std::vector<std::vector<Vec2>> beside(const Line &line, int step);

private:
	/// Ways from the start to one side, and their bends.
	struct Side {
		std::vector<WayOut> ways;
		std::vector<std::vector<Vec2>> traces;
	};
	static constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

	void make_places();
	void measure(Place &place) const;
	double strength(Vec2 place) const;
	Vec2 exit_position(const Place &place) const;
	std::size_t place_at(int column, int row) const;
	std::size_t nearest(Vec2 rest) const;
	Part part(const Place &place, Vec2d way) const;
	std::vector<std::vector<Vec2>> ways_through(Vec2 middle, Vec2 along, std::array<std::size_t, 2> own_edges, double least_use);
	bool leads(Vec2 way) const;
	void search(std::size_t start);
	std::vector<WayOut> exits() const;
	std::vector<Vec2> trace(std::size_t end) const;
	std::vector<Vec2> straightened(std::span<const Vec2> way) const;

	const SoftBodyData &body_;
	double stretch_ = 1;
	double h_ = 0; ///< distance of the places [length]
	int columns_ = 0;
	int rows_ = 0;
	std::vector<Place> places_;
	std::vector<std::size_t> grid_; ///< index of the place of each column and row, or NONE
	Vec2 direction_; ///< of the present search; unit
	std::vector<Part> parts_; ///< of the weakest way from the start to each place
	std::vector<std::size_t> before_; ///< the place before it on that way
};

void CrackSearch::make_places() {
	const std::span<const Vec2> hull = body_.shared_shape()->rest_hull();
	Vec2 low{ std::numeric_limits<Real>::max(), std::numeric_limits<Real>::max() };
	Vec2 high = -low;
	double around = 0;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 p = hull[i];
		low = { std::min(low.x, p.x), std::min(low.y, p.y) };
		high = { std::max(high.x, p.x), std::max(high.y, p.y) };
		around += double(length(hull[(i + 1) % hull.size()] - hull[i]));
	}
	const double width = double(high.x - low.x);
	const double height = double(high.y - low.y);
	h_ = std::max(SPACING * around / double(hull.size()), std::max(width, height) / MOST_COLUMNS);
	columns_ = std::max(1, int(std::ceil(width / h_)));
	rows_ = std::max(1, int(std::ceil(height / h_)));
	const Vec2 middle = (low + high) * Real(0.5);
	grid_.assign(std::size_t(columns_) * std::size_t(rows_), NONE);
	for (int row = 0; row < rows_; ++row) {
		for (int column = 0; column < columns_; ++column) {
			Place place;
			place.column = column;
			place.row = row;
			place.rest = middle + Vec2{ Real((column + 0.5 - 0.5 * columns_) * h_), Real((row + 0.5 - 0.5 * rows_) * h_) };
			if (point_in_polygon(place.rest, hull)) {
				measure(place);
				grid_[std::size_t(row * columns_ + column)] = places_.size();
				places_.push_back(place);
			}
		}
	}
	for (Place &place : places_) {
		for (const auto &[x, y] : { std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1) }) {
			place.is_beside_outline |= place_at(place.column + x, place.row + y) == NONE;
		}
		place.exit = nearest_place(hull, place.rest);
	}
}

// What the body bears at a place: the mean of its springs, by how near its middle is, of that of all.
double CrackSearch::strength(Vec2 place) const {
	const std::span<const Spring2D> springs = body_.shared_shape()->springs();
	const std::span<const Vec2> rest = body_.shared_shape()->rest_positions();
	const double near = REACH * h_;
	double sum = 0;
	double weights = 0;
	double mean = 0;
	for (const Spring2D &spring : springs) {
		const Vec2 middle = (rest[spring.a] + rest[spring.b]) * Real(0.5);
		const double share = 1 / (double(length_squared(middle - place)) + near * near);
		sum += share * share * double(spring.stiffness);
		weights += share * share;
		mean += double(spring.stiffness) / double(springs.size());
	}
	return mean > 0 ? sum / weights / mean : 1;
}

void CrackSearch::measure(Place &place) const {
	const std::span<const Vec2> hull = body_.hull();
	const auto carried = [&](Vec2 rest) {
		const std::vector<double> weights = mean_value_weights(body_.shared_shape()->rest_hull(), rest);
		Vec2d sum;
		for (std::size_t i = 0; i < weights.size(); ++i) {
			sum += Vec2d(hull[i] - hull[0]) * weights[i]; // relative to a point of the body, which keeps digits far from the origin
		}
		return sum;
	};
	const Vec2d here = carried(place.rest);
	const Real beside = Real(DIFFERENCE * h_);
	const Vec2 x = place.rest + Vec2{ beside, 0 };
	const Vec2 y = place.rest + Vec2{ 0, beside };
	place.position = hull[0] + Vec2{ Real(here.x), Real(here.y) };
	place.stretch_x = (carried(x) - here) * (1 / double(x.x - place.rest.x));
	place.stretch_y = (carried(y) - here) * (1 / double(y.y - place.rest.y));
	place.bears = strength(place.rest);
}

std::size_t CrackSearch::place_at(int column, int row) const {
	const bool is_on_grid = column >= 0 && column < columns_ && row >= 0 && row < rows_;
	return is_on_grid ? grid_[std::size_t(row * columns_ + column)] : NONE;
}

std::size_t CrackSearch::nearest(Vec2 rest) const {
	std::size_t found = NONE;
	Real least = std::numeric_limits<Real>::max();
	for (std::size_t i = 0; i < places_.size(); ++i) {
		const Real distance = length_squared(places_[i].rest - rest);
		if (distance < least) {
			least = distance;
			found = i;
		}
	}
	return found;
}

// The strain across a way at rest is that of a line that stands on it there.
Part CrackSearch::part(const Place &place, Vec2d way) const {
	const double size = std::sqrt(dot(way, way));
	if (!(size > 0) || !(cross(place.stretch_x, place.stretch_y) > 0)) {
		return { size, 0 };
	}
	const Vec2d normal = perpendicular(way) * (1 / size);
	const Vec2d now = place.stretch_x * normal.x + place.stretch_y * normal.y;
	const double strain = std::sqrt(dot(now, now)) - 1;
	const double bears = stretch_ * std::max(LEAST_STRENGTH, place.bears);
	return { size, size * std::clamp(strain / bears, 0.0, 1.0) };
}

Vec2 CrackSearch::exit_position(const Place &place) const {
	const std::span<const Vec2> hull = body_.hull();
	const Vec2 from = hull[place.exit.edge];
	return from + (hull[(place.exit.edge + 1) % hull.size()] - from) * place.exit.t;
}

// A way turns by at most 45 degrees from where it leads, so that it parts the body and does not peel it.
bool CrackSearch::leads(Vec2 way) const {
	const Real forward = dot(way, direction_);
	return forward > 0 && std::abs(cross(way, direction_)) <= forward * Real(1.001);
}

// Dijkstra 1959.
void CrackSearch::search(std::size_t start) {
	parts_.assign(places_.size(), { std::numeric_limits<double>::infinity(), 0 });
	before_.assign(places_.size(), NONE);
	parts_[start] = {};
	using Entry = std::pair<double, std::size_t>;
	std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
	open.push({ 0, start });
	while (!open.empty()) {
		const auto [cost, from] = open.top();
		open.pop();
		if (cost > parts_[from].cost()) {
			continue;
		}
		const Place &place = places_[from];
		for (int row = place.row - 1; row <= place.row + 1; ++row) {
			for (int column = place.column - 1; column <= place.column + 1; ++column) {
				const std::size_t to = place_at(column, row);
				if (to == NONE || to == from || !leads(places_[to].rest - place.rest)) {
					continue;
				}
				const Vec2d half = (Vec2d(places_[to].rest) - Vec2d(place.rest)) * 0.5;
				const Part way = parts_[from] + part(place, half) + part(places_[to], half);
				if (way.cost() < parts_[to].cost()) {
					parts_[to] = way;
					before_[to] = from;
					open.push({ way.cost(), to });
				}
			}
		}
	}
}

// The weakest way to each edge of the outline, the weakest first.
std::vector<WayOut> CrackSearch::exits() const {
	std::vector<WayOut> best(body_.hull().size(), { NONE, {} });
	for (std::size_t i = 0; i < places_.size(); ++i) {
		const Place &place = places_[i];
		const bool is_reached = std::isfinite(parts_[i].length);
		if (!is_reached || !place.is_beside_outline || !leads(place.exit.position - place.rest)) {
			continue;
		}
		const Part way = parts_[i] + part(place, Vec2d(place.exit.position) - Vec2d(place.rest));
		WayOut &other = best[place.exit.edge];
		if (other.place == NONE || way.cost() < other.part.cost()) {
			other = { i, way };
		}
	}
	std::erase_if(best, [](const WayOut &way) { return way.place == NONE; });
	std::ranges::stable_sort(best, {}, [](const WayOut &way) { return way.part.cost(); });
	best.resize(std::min(best.size(), MOST_TRIALS));
	return best;
}

// From the start to a little beyond the outline.
std::vector<Vec2> CrackSearch::trace(std::size_t end) const {
	const Place &last = places_[end];
	const Vec2 exit = exit_position(last);
	const Vec2 outwards = exit - last.position;
	const Real size = length(outwards);
	std::vector<Vec2> way{ exit + (size > 0 ? outwards * (Real(OVERSHOOT * h_) / size) : Vec2{}), exit };
	for (std::size_t i = end; i != NONE; i = before_[i]) {
		way.push_back(places_[i].position);
	}
	std::ranges::reverse(way);
	return way;
}

// Douglas and Peucker 1973.
std::vector<Vec2> CrackSearch::straightened(std::span<const Vec2> way) const {
	if (way.size() < 3) {
		return { way.begin(), way.end() };
	}
	const Vec2 along = way.back() - way.front();
	const Real size = length(along);
	std::size_t farthest = 0;
	Real most = 0;
	for (std::size_t i = 1; i + 1 < way.size(); ++i) {
		const Real distance = size > 0 ? std::abs(cross(along, way[i] - way.front())) / size : length(way[i] - way.front());
		if (distance > most) {
			most = distance;
			farthest = i;
		}
	}
	if (!(most > Real(STRAIGHTENED * h_))) {
		return { way.front(), way.back() };
	}
	std::vector<Vec2> bent = straightened(way.first(farthest + 1));
	bent.pop_back();
	std::ranges::copy(straightened(way.subspan(farthest)), std::back_inserter(bent));
	return bent;
}

std::vector<std::vector<Vec2>> CrackSearch::across(const Line &line) {
	const std::size_t hull_count = body_.hull().size();
	const std::span<const Vec2> rest = body_.shared_shape()->rest_positions();
	const Vec2 from = rest[line.a];
	const Vec2 along = rest[line.b] - from;
	const bool is_on_outline = line.a < hull_count && line.b < hull_count;
	// To the outer side of a line of the outline there is only its own middle.
	const std::size_t to_left = is_on_outline && (line.b + 1) % hull_count == line.a ? line.b : NONE;
	const std::size_t to_right = is_on_outline && (line.a + 1) % hull_count == line.b ? line.a : NONE;
	return ways_through(from + along * Real(0.5), along, { to_left, to_right }, FAILING_USE);
}

std::vector<std::vector<Vec2>> CrackSearch::beside(const Line &line, int step) {
	const std::span<const Vec2> rest = body_.shared_shape()->rest_positions();
	const Vec2 from = rest[line.a];
	const Vec2 along = rest[line.b] - from;
	const Vec2 inwards = -(from + along * Real(0.5));
	const Real way = length(inwards);
	if (!(Real(step * h_) < way)) {
		return {};
	}
	return ways_through(from + along * Real(0.5) + inwards * (Real(step * h_) / way), inwards, { NONE, NONE }, 0);
}

// Through the place nearest to `middle`, across `along`, both at rest. `own_edges` are the only ways out to its left and right, if they are given.
std::vector<std::vector<Vec2>> CrackSearch::ways_through(Vec2 middle, Vec2 along, std::array<std::size_t, 2> own_edges, double least_use) {
	const std::size_t start = nearest(middle);
	if (start == NONE || !(length(along) > 0)) {
		return {};
	}
	const Vec2 normal = perpendicular(along) * (1 / length(along));
	std::array<Side, 2> sides;
	for (std::size_t i = 0; i < sides.size(); ++i) {
		direction_ = i == 0 ? normal : -normal;
		if (own_edges[i] != NONE) {
			places_[start].exit = { own_edges[i], Real(0.5), middle, Real(0) };
			before_.assign(places_.size(), NONE);
			sides[i].ways.push_back({ start, part(places_[start], Vec2d(middle) - Vec2d(places_[start].rest)) });
		} else {
			search(start);
			sides[i].ways = exits();
		}
		for (const WayOut &way : sides[i].ways) {
			sides[i].traces.push_back(trace(way.place));
		}
	}
	struct Choice {
		Part part;
		std::size_t first = 0;
		std::size_t second = 0;
	};
	std::vector<Choice> choices;
	for (std::size_t i = 0; i < sides[0].ways.size(); ++i) {
		for (std::size_t j = 0; j < sides[1].ways.size(); ++j) {
			const Part whole = sides[0].ways[i].part + sides[1].ways[j].part;
			if (whole.used >= least_use * whole.length) {
				choices.push_back({ whole, i, j });
			}
		}
	}
	std::ranges::stable_sort(choices, {}, [](const Choice &choice) { return choice.part.cost(); });
	choices.resize(std::min(choices.size(), MOST_TRIALS));
	std::vector<std::vector<Vec2>> blades;
	for (const Choice &choice : choices) {
		std::vector<Vec2> blade = sides[0].traces[choice.first];
		std::ranges::reverse(blade);
		const std::vector<Vec2> &rest = sides[1].traces[choice.second];
		blade.insert(blade.end(), rest.begin() + 1, rest.end());
		blades.push_back(straightened(blade));
	}
	return blades;
}

Status check_tear_limits(const TearLimits &limits) {
	return check_above("stretch", limits.stretch, 0, "");
}

} // namespace

bool is_overstretched(const SoftBodyData &body, Real stretch) {
	return most_used_line(body, stretch).use > 1;
}

Result<BodyCut> plan_tear(const SoftBodyData &body, const StructureOptions &options, const TearLimits &limits) {
	if (Status status = check_tear_limits(limits)) {
		return *status;
	}
	const std::array<Vec2, 2> beside{ body.hull()[0], body.hull()[0] };
	const auto whole = plan_cut(body, options, beside, limits.pieces);
	const Line line = most_used_line(body, limits.stretch);
	if (!whole || !(line.use > 1)) {
		return whole;
	}
	CrackSearch cracks(body, limits.stretch);
	std::vector<std::vector<Vec2>> blades = cracks.across(line);
	for (int step = 1; step <= 2 * MOST_COLUMNS; ++step) {
		for (const std::vector<Vec2> &blade : blades) {
			auto cut = plan_cut(body, options, blade, limits.pieces);
			if (cut && cut.value().pieces.size() > 1) {
				return cut;
			}
		}
		if (!(line.use > HOPELESS_USE)) {
			break;
		}
		blades = cracks.beside(line, step);
	}
	return whole;
}

} // namespace softbody
