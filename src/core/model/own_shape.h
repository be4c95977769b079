// SPDX-License-Identifier: MIT
// A shape that belongs to one body.
#pragma once

#include "core/model/soft_body_shape.h"

#include <memory>

namespace softbody {

/// A shape that one body owns and may change, or none. A copy owns a copy.
class OwnShape {
public:
	OwnShape() = default;
	explicit OwnShape(const SoftBodyShape &shape) : shape_(std::make_unique<SoftBodyShape>(shape)) {}
	OwnShape(const OwnShape &other) : shape_(other.shape_ ? std::make_unique<SoftBodyShape>(*other.shape_) : nullptr) {}
	OwnShape(OwnShape &&) = default;
	OwnShape &operator=(const OwnShape &other) { return *this = OwnShape(other); }
	OwnShape &operator=(OwnShape &&) = default;
	~OwnShape() = default;

	bool has_value() const { return shape_ != nullptr; }
	SoftBodyShape &operator*() { return *shape_; }
	const SoftBodyShape &operator*() const { return *shape_; }
	SoftBodyShape *operator->() { return shape_.get(); }
	const SoftBodyShape *operator->() const { return shape_.get(); }

private:
	std::unique_ptr<SoftBodyShape> shape_;
};

} // namespace softbody
