// SPDX-License-Identifier: MIT
// Bodies made alike share one shape.
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
	std::weak_ptr<const SoftBodyShape> shape;
};

struct Cache {
	std::mutex mutex;
	std::unordered_multimap<std::uint64_t, Known> known;
	std::size_t next_sweep = 64; ///< entries at which those that nobody holds any more are dropped
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

std::uint64_t hash_of(const std::vector<Vec2> &hull, const StructureOptions &options) {
	Hash hash;
	hash.add(hull);
	hash.add(double(options.mass));
	hash.add(double(options.stiffness));
	hash.add(double(options.damping));
	hash.add(double(options.centre_point));
	hash.add(options.inner_points);
	hash.add(options.springs);
	hash.add(options.spring_stiffness_scales);
	hash.add(options.spring_damping_scales);
	hash.add(options.spring_length_scales);
	return hash.value();
}

} // namespace

Result<std::shared_ptr<const SoftBodyShape>> find_or_create_shape(std::span<const Vec2> hull, const StructureOptions &options) {
	std::vector<Vec2> key(hull.begin(), hull.end());
	const std::uint64_t hash = hash_of(key, options);
	Cache &all = cache();
	const std::lock_guard lock(all.mutex);
	const auto [begin, end] = all.known.equal_range(hash);
	for (auto entry = begin; entry != end; ++entry) {
		const Known &known = entry->second;
		if (known.hull == key && known.options == options) {
			if (std::shared_ptr<const SoftBodyShape> shape = known.shape.lock()) {
				return shape;
			}
		}
	}
	auto shape = SoftBodyCreator::create_polygon(hull, options);
	if (!shape) {
		return shape;
	}
	all.known.insert({ hash, { std::move(key), options, shape.value() } });
	if (all.known.size() >= all.next_sweep) {
		std::erase_if(all.known, [](const auto &entry) { return entry.second.shape.expired(); });
		all.next_sweep = std::max<std::size_t>(64, 2 * all.known.size());
	}
	return shape;
}

} // namespace softbody
