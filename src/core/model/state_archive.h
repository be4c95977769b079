// SPDX-License-Identifier: MIT
// States as bytes: values one after the other, little-endian on every machine.
#pragma once

#include "core/base/vec2.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace softbody {

/// The unsigned integer of a number's bits.
template <class Number>
using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint8_t>>;

/// Whether a list of points lies in memory as it does in the bytes.
constexpr bool POINTS_ARE_BYTES = std::endian::native == std::endian::little && sizeof(Vec2) == 2 * sizeof(Real);

/// Collects values as bytes.
class StateWriter {
public:
	/// Continues a list of bytes, whose memory is used.
	explicit StateWriter(std::vector<std::uint8_t> bytes = {}) :
			bytes_(std::move(bytes)), size_(bytes_.size()) {}

	template <class Number>
	void visit(Number number) {
		Bits<Number> bits = std::bit_cast<Bits<Number>>(number);
		std::uint8_t *to = reserve(sizeof(bits));
		if constexpr (std::endian::native == std::endian::little) {
			std::memcpy(to, &bits, sizeof(bits));
		} else {
			for (std::size_t i = 0; i < sizeof(bits); ++i) {
				to[i] = std::uint8_t(bits >> (8 * i));
			}
		}
	}
	void visit(Vec2 value) {
		visit(value.x);
		visit(value.y);
	}
	void visit_points(std::span<const Vec2> points) {
		visit(std::uint32_t(points.size()));
		if constexpr (POINTS_ARE_BYTES) {
			write(points.data(), points.size_bytes());
		} else {
			std::ranges::for_each(points, [this](Vec2 point) { visit(point); });
		}
	}
	/// The size is the least number of bytes of an item, for the reader.
	void visit_list(const auto &items, std::size_t, const auto &visit_item) {
		visit(std::uint32_t(items.size()));
		std::ranges::for_each(items, visit_item);
	}
	void write(std::span<const std::uint8_t> more) { write(more.data(), more.size()); }

	std::size_t size() const { return size_; }
	/// Forgets what was written beyond that size.
	void shrink(std::size_t size) { size_ = size; }
	/// Replaces an earlier number. Precondition: it was written at that place.
	template <class Number>
	void put(std::size_t at, Number number) {
		const std::size_t end = size_;
		size_ = at;
		visit(number);
		size_ = end;
	}
	std::span<const std::uint8_t> written(std::size_t from = 0) const { return { bytes_.data() + from, size_ - from }; }
	/// The bytes; the writer is empty then.
	std::vector<std::uint8_t> take() {
		bytes_.resize(size_);
		size_ = 0;
		return std::move(bytes_);
	}

private:
	std::uint8_t *reserve(std::size_t more) {
		if (size_ + more > bytes_.size()) {
			bytes_.resize(std::max({ size_ + more, bytes_.capacity(), 2 * bytes_.size() }));
		}
		std::uint8_t *const place = bytes_.data() + size_;
		size_ += more;
		return place;
	}
	void write(const void *from, std::size_t size) {
		if (size > 0) {
			std::memcpy(reserve(size), from, size);
		}
	}

	std::vector<std::uint8_t> bytes_; ///< those beyond `size_` mean nothing
	std::size_t size_ = 0;
};

/// Past the end, or after invalid data, everything reads as 0 and `is_valid` stays false.
class StateReader {
public:
	explicit StateReader(std::span<const std::uint8_t> bytes = {}) :
			rest_(bytes) {}

	template <class Number>
	void visit(Number &number) {
		Bits<Number> bits = 0;
		if (rest_.size() < sizeof(bits)) {
			fail();
		} else {
			if constexpr (std::endian::native == std::endian::little) {
				std::memcpy(&bits, rest_.data(), sizeof(bits));
			} else {
				for (std::size_t i = 0; i < sizeof(bits); ++i) {
					bits = Bits<Number>(bits | Bits<Number>(rest_[i]) << (8 * i));
				}
			}
			rest_ = rest_.subspan(sizeof(bits));
		}
		if constexpr (std::is_same_v<Number, bool>) {
			is_valid_ &= bits <= 1;
			number = bits == 1;
		} else {
			number = std::bit_cast<Number>(bits);
		}
	}
	void visit(Vec2 &value) {
		visit(value.x);
		visit(value.y);
	}
	void visit_points(std::vector<Vec2> &points) {
		const std::size_t count = read_count(2 * sizeof(Real));
		points.resize(count);
		if constexpr (POINTS_ARE_BYTES) {
			if (count > 0) {
				std::memcpy(points.data(), rest_.data(), count * sizeof(Vec2));
				rest_ = rest_.subspan(count * sizeof(Vec2));
			}
		} else {
			std::ranges::for_each(points, [this](Vec2 &point) { visit(point); });
		}
	}
	/// Every item has at least `item_size` bytes: a count beyond the remaining bytes is refused before any allocation.
	template <class Item>
	void visit_list(std::vector<Item> &items, std::size_t item_size, const auto &visit_item) {
		items.resize(read_count(item_size));
		std::ranges::for_each(items, visit_item);
	}
	template <class Number>
	Number read() {
		Number number;
		visit(number);
		return number;
	}
	/// The next bytes as they are; none if there are fewer.
	std::span<const std::uint8_t> read_bytes(std::size_t size) {
		if (size > rest_.size()) {
			fail();
			return {};
		}
		const std::span<const std::uint8_t> bytes = rest_.first(size);
		rest_ = rest_.subspan(size);
		return bytes;
	}
	void fail() {
		is_valid_ = false;
		rest_ = {};
	}
	bool is_valid() const { return is_valid_; }
	bool is_at_end() const { return rest_.empty(); }
	std::span<const std::uint8_t> rest() const { return rest_; }

private:
	std::size_t read_count(std::size_t item_size) {
		const auto count = read<std::uint32_t>();
		if (count > rest_.size() / item_size) {
			fail();
			return 0;
		}
		return count;
	}

	std::span<const std::uint8_t> rest_;
	bool is_valid_ = true;
};

} // namespace softbody
