// SPDX-License-Identifier: MIT
// Shares one shape among like bodies.
#include "godot/server/shape_cache.h"

#include "core/base/hash.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace softbody {

namespace {

/// What a shape is made from.
struct Design {
	std::vector<Vec2> hull;
	StructureOptions options;
	Real size = 1;

	friend bool operator==(const Design &, const Design &) = default;
};

struct Known {
	std::weak_ptr<const SoftBodyShape> shape;
	std::shared_ptr<const SoftBodyShape> unit; ///< the shape of mass 1 and size 1 that it was made from, or null
};

struct HashOfDesign {
	std::size_t operator()(const Design &design) const {
		const StructureOptions &options = design.options;
		Hash hash;
		add_list(hash, design.hull);
		for (const Real value : { design.size, options.mass, options.stiffness, options.damping }) {
			hash.add(value);
		}
		for (const int value : { int(options.elastic), int(options.elastic_triangles), options.triangle_points, int(options.center_point) }) {
			hash.add(std::uint64_t(value));
		}
		add_list(hash, options.inner_points);
		for (const std::vector<Vec2> &hole : options.holes) {
			add_list(hash, hole);
		}
		for (const SpringEnds &ends : options.springs) {
			hash.add(std::uint64_t(ends[0]) << 32 | ends[1]);
		}
		add_list(hash, options.spring_stiffness_scales);
		add_list(hash, options.spring_damping_scales);
		add_list(hash, options.spring_length_scales);
		return std::size_t(hash.value());
	}

private:
	template <class Value>
	static void add_list(Hash &r_hash, const std::vector<Value> &values) {
		r_hash.add(std::uint64_t(values.size()));
		for (const Value &value : values) {
			r_hash.add(value);
		}
	}
};

// Shapes that were built last and are kept without users. A game frees its last body of a kind and makes the next a moment
// later, which would take the milliseconds of its modes again. Each has some kilobytes.
constexpr std::size_t KEPT_SHAPES = 64;

struct Cache {
	std::mutex mutex;
	std::array<std::shared_ptr<const SoftBodyShape>, KEPT_SHAPES> kept; ///< the oldest gives way
	std::size_t next_kept = 0;
	std::unordered_map<Design, Known, HashOfDesign> known;
	std::int64_t built = 0; ///< shapes in all
	std::size_t next_sweep = 64; ///< number of entries at which entries without users are dropped
};

Cache &cache() {
	static Cache instance;
	return instance;
}

// The modes of an outline take some milliseconds and depend neither on its mass nor on its size. A shape of another mass
// or size is always made from that of mass 1 and size 1, so its bits do not depend on earlier shapes.
Result<std::shared_ptr<const SoftBodyShape>> find_or_create(Cache &all, const Design &design) {
	if (const auto found = all.known.find(design); found != all.known.end()) {
		if (std::shared_ptr<const SoftBodyShape> shape = found->second.shape.lock()) {
			return shape;
		}
	}
	Known made;
	Result<std::shared_ptr<const SoftBodyShape>> shape = Error{};
	const bool is_solid = design.options.elastic || design.options.elastic_triangles;
	if (design.size != 1 || (is_solid && design.options.mass != 1)) {
		Design of_unit{ design.hull, design.options, 1 };
		of_unit.options.mass = 1;
		const auto unit = find_or_create(all, of_unit);
		if (!unit) {
			return unit;
		}
		made.unit = unit.value();
		shape = unit.value()->resized(design.size, design.options.mass);
	} else {
		++all.built;
		shape = SoftBodyCreator::create_polygon(design.hull, design.options);
	}
	if (!shape) {
		return shape;
	}
	made.shape = shape.value();
	if (made.unit == nullptr) {
		all.kept[all.next_kept] = shape.value();
		all.next_kept = (all.next_kept + 1) % KEPT_SHAPES;
	}
	all.known.insert_or_assign(design, std::move(made));
	if (all.known.size() >= all.next_sweep) {
		std::erase_if(all.known, [](const auto &entry) { return entry.second.shape.expired(); });
		all.next_sweep = std::max<std::size_t>(64, 2 * all.known.size());
	}
	return shape;
}

} // namespace

Result<std::shared_ptr<const SoftBodyShape>> find_or_create_shape(std::span<const Vec2> hull, const StructureOptions &options,
		Real size) {
	Cache &all = cache();
	const std::lock_guard lock(all.mutex);
	return find_or_create(all, { std::vector<Vec2>(hull.begin(), hull.end()), options, size });
}

std::shared_ptr<const SoftBodyShape> prepare_shape(std::span<const Vec2> hull, StructureOptions options) {
	options.mass = 1;
	const Design design{ std::vector<Vec2>(hull.begin(), hull.end()), options, 1 };
	Cache &all = cache();
	{
		const std::lock_guard lock(all.mutex);
		if (const auto found = all.known.find(design); found != all.known.end()) {
			if (std::shared_ptr<const SoftBodyShape> shape = found->second.shape.lock()) {
				return shape;
			}
		}
	}
	const auto made = SoftBodyCreator::create_polygon(design.hull, design.options);
	if (!made) {
		return nullptr;
	}
	const std::lock_guard lock(all.mutex);
	++all.built;
	all.known.insert_or_assign(design, Known{ made.value(), nullptr });
	return made.value();
}

std::int64_t built_shape_count() {
	Cache &all = cache();
	const std::lock_guard lock(all.mutex);
	return all.built;
}

} // namespace softbody
