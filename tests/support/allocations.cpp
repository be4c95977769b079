// SPDX-License-Identifier: MIT
// Counts what the program takes from the heap.
#include "support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocated = 0;

// In front of each block: its size, in as much room as keeps the block aligned.
constexpr std::size_t HEADER = alignof(std::max_align_t) > sizeof(std::size_t) ? alignof(std::max_align_t) : sizeof(std::size_t);

} // namespace

void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
	void *block = std::malloc(size + HEADER);
	if (block == nullptr) {
		return nullptr;
	}
	*static_cast<std::size_t *>(block) = size;
	allocated += size;
	return static_cast<char *>(block) + HEADER;
}

void *operator new(std::size_t size) {
	void *block = operator new(size, std::nothrow);
	if (block == nullptr) {
		throw std::bad_alloc();
	}
	return block;
}

void operator delete(void *pointer) noexcept {
	if (pointer == nullptr) {
		return;
	}
	void *block = static_cast<char *>(pointer) - HEADER;
	allocated -= *static_cast<std::size_t *>(block);
	std::free(block);
}

void operator delete(void *pointer, std::size_t) noexcept {
	operator delete(pointer);
}

void operator delete(void *pointer, const std::nothrow_t &) noexcept {
	operator delete(pointer);
}

std::size_t softbody::testing::allocated_bytes() {
	return allocated;
}
