// SPDX-License-Identifier: MIT
// Bodies and deformations that several benches share, made from a seed and alike on every machine.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace bench {

/// Random numbers from a seed (SplitMix64, Steele et al. 2014). The distributions of the standard library
/// differ between its implementations, and a result that names its seed must be repeatable.
class Random {
public:
	explicit Random(std::uint64_t seed) : state_(seed) {}
	std::uint64_t next();
	double uniform(double low, double high);
	/// Every factor equally likely: the logarithm is uniform. 0 < low <= high.
	double log_uniform(double low, double high);
	/// low..high, both included.
	int integer(int low, int high);

private:
	std::uint64_t state_;
};

/// What the core made; a refusal is a fault of the bench and ends it with the core's own sentence.
template <typename T>
T take(softbody::Result<T> result) {
	if (!result) {
		throw std::runtime_error(result.error().message());
	}
	return std::move(result.value());
}

/// Ends the bench likewise if the core refused.
inline void check(const softbody::Status &status) {
	if (status) {
		throw std::runtime_error(status->message());
	}
}

using Shape = std::shared_ptr<const softbody::SoftBodyShape>;
using Points = std::vector<softbody::Vec2>;

/// `hull_points` on a circle of radius 0.5, with or without a center point, 1 kg in equal shares, every spring of
/// stiffness k and damping c = damping_ratio sqrt(k m). Eight points and the center are the thesis's test body.
Shape circle_shape(int hull_points, bool center_point, double stiffness, double damping_ratio);

/// k_s and its damping as a fraction of the springs' k: 2·0.25 sqrt(k_s m), a quarter of the critical damping.
void set_shape_matching(softbody::BodySettings &settings, const softbody::SoftBodyShape &shape, double stiffness);

/// Ways to ruin a shape.
enum class Deformation {
	FLATTENED, ///< squeezed to 0..10 % along a random direction, stretched up to 30 % across it
	POINT_THROUGH_CENTER, ///< one hull point pulled through the center to the far side, 0.3..1.2 of the way
	FOLDED, ///< the part beyond a random line reflected onto the rest
	CRUMPLED, ///< every point anywhere in the disk of the body's radius
	MIRRORED, ///< turned over, with 2 % of noise
};
inline constexpr std::array<Deformation, 5> DEFORMATIONS = { Deformation::FLATTENED, Deformation::POINT_THROUGH_CENTER,
	Deformation::FOLDED, Deformation::CRUMPLED, Deformation::MIRRORED };
const char *deformation_name(Deformation deformation);

/// The shape's points, deformed, then turned by a random angle.
Points deformed(const softbody::SoftBodyShape &shape, Deformation deformation, Random &random);

/// A body at rest with its points there. The rotation that it remembers is the identity.
softbody::SoftBodyData body_at(const Shape &shape, const softbody::BodySettings &settings, const Points &points);

/// Which terms a random body has.
enum class Model { SPRINGS, SHAPE_MATCHING, PRESSURE, BOTH };
inline constexpr std::array<Model, 4> MODELS = { Model::SPRINGS, Model::SHAPE_MATCHING, Model::PRESSURE, Model::BOTH };
const char *model_name(Model model);

/// A random structure: a star-shaped hull of 3..64 points, a center point in three of four, chords in half; masses
/// of a ratio up to 1e4 and spring stiffnesses of a ratio up to 1e6 within the body, both drawn anew for each body,
/// on a scale from jelly to rubber (mean k 10..1e5 N/m at 1 kg). Each spring has c = r sqrt(k min(m_a, m_b)) with one r
/// of `least_damping`..0.3 a body.
struct RandomBody {
	Shape shape;
	softbody::BodySettings settings; ///< integrator AUTOMATIC, substeps by the rule
	Model model = Model::SPRINGS;
	double mass_ratio = 1;
	double stiffness_ratio = 1;
	double damping_ratio = 0;
};
RandomBody random_body(Random &random, double least_damping);

} // namespace bench
