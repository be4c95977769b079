// SPDX-License-Identifier: MIT
// Shares one shape among like bodies.
#include "godot/server/shape_cache.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace softbody {

namespace {

struct Known {
	std::vector<Vec2> hull;
	StructureOptions options;
	Real size = 1;
	std::weak_ptr<const SoftBodyShape> shape;
	std::shared_ptr<const SoftBodyShape> unit = nullptr; ///< the shape of mass 1 and size 1 that it was made from, or null
};

struct Cache {
	std::mutex mutex;
	std::unordered_multimap<std::uint64_t, Known> known;
	std::int64_t built = 0; ///< shapes in all
	std::size_t next_sweep = 64; ///< number of entries at which entries without users are dropped
};

Cache &cache() {
	static Cache instance;
	return instance;
}

// FNV-1a over words, good enough as equal hashes are compared in full.
class Hash {
public:
	void add(double value) {
		std::uint64_t bits;
		std::memcpy(&bits, &value, sizeof(bits));
		value_ = (value_ ^ (bits ^ bits >> 32)) * 0x100000001b3u;
	}
	void add(Vec2 value) {
		add(double(value.x));
		add(double(value.y));
	}
	void add(const SpringEnds &ends) { add(double(ends[0]) * 65536 + ends[1]); }
	template <class Value>
	void add(const std::vector<Value> &values) {
		add(double(values.size()));
		for (const Value &value : values) {
			add(value);
		}
	}
	std::uint64_t value() const { return value_; }

private:
	std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t hash_of(const std::vector<Vec2> &hull, const StructureOptions &options, Real size) {
	Hash hash;
	hash.add(hull);
	hash.add(double(size));
	hash.add(double(options.mass));
	hash.add(double(options.stiffness));
	hash.add(double(options.damping));
	hash.add(double(options.elastic));
	hash.add(double(options.elastic_triangles));
	hash.add(double(options.triangle_points));
	hash.add(double(options.center_point));
	hash.add(options.inner_points);
	hash.add(options.springs);
	hash.add(options.spring_stiffness_scales);
	hash.add(options.spring_damping_scales);
	hash.add(options.spring_length_scales);
	return hash.value();
}

std::shared_ptr<const SoftBodyShape> find_shape(const Cache &all, std::uint64_t hash, const std::vector<Vec2> &hull,
		const StructureOptions &options, Real size) {
	const auto [begin, end] = all.known.equal_range(hash);
	for (auto entry = begin; entry != end; ++entry) {
		const Known &known = entry->second;
		if (known.hull == hull && known.options == options && known.size == size) {
			if (std::shared_ptr<const SoftBodyShape> shape = known.shape.lock()) {
				return shape;
			}
		}
	}
	return nullptr;
}

// The modes of an outline take some milliseconds and depend neither on its mass nor on its size. A shape of another mass
// or size is always made from that of mass 1 and size 1, so its bits do not depend on earlier shapes.
Result<std::shared_ptr<const SoftBodyShape>> find_or_create(Cache &all, const std::vector<Vec2> &hull, const StructureOptions &options,
		Real size) {
	const std::uint64_t hash = hash_of(hull, options, size);
	if (std::shared_ptr<const SoftBodyShape> shape = find_shape(all, hash, hull, options, size)) {
		return shape;
	}
	Known made{ hull, options, size, {} };
	Result<std::shared_ptr<const SoftBodyShape>> shape = Error{};
	const bool is_solid = options.elastic || options.elastic_triangles;
	if (size != 1 || (is_solid && options.mass != 1)) {
		StructureOptions of_unit = options;
		of_unit.mass = 1;
		const auto unit = find_or_create(all, hull, of_unit, 1);
		if (!unit) {
			return unit;
		}
		made.unit = unit.value();
		shape = unit.value()->resized(size, options.mass);
	} else {
		++all.built;
		shape = SoftBodyCreator::create_polygon(hull, options);
	}
	if (!shape) {
		return shape;
	}
	made.shape = shape.value();
	all.known.insert({ hash, std::move(made) });
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
	return find_or_create(all, std::vector<Vec2>(hull.begin(), hull.end()), options, size);
}

std::int64_t built_shape_count() {
	Cache &all = cache();
	const std::lock_guard lock(all.mutex);
	return all.built;
}

} // namespace softbody
