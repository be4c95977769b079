// SPDX-License-Identifier: MIT
// Every tolerance and default of the core, each with its unit and what changing it does.
#pragma once

#include "core/base/real.h"

namespace softbody {

/// Smallest number of hull points. Two points enclose no area.
inline constexpr int MIN_HULL_POINTS = 3;

/// Largest number of hull points accepted [1]. The check for self-intersection is quadratic:
/// 4096 points take about 50 ms once, at creation.
inline constexpr int MAX_HULL_POINTS = 4096;

/// Share of the squared distance of two points by which a third point must lie inside the circle over them to count as
/// between them [1]. Larger: points are joined past others. Smaller: rounding decides which diagonals a lattice gets.
inline constexpr Real CIRCLE_TOLERANCE = Real(1e-4);

/// Tangent of half the largest turn between two edges of an outline that count as one round line in contacts (34
/// degrees), and the largest ratio of the lengths of such edges. Larger: the corners of an octagon are rounded. Smaller:
/// a circle of twelve points rolls like a polygon.
inline constexpr double MOST_ROUND_HALF_TURN = 0.31;
inline constexpr double MOST_ROUND_RATIO = 1.5;

/// Share of its bulge at rest below which a round edge counts as pressed flat, so that only its ends touch. Larger: soft
/// bodies roll over corners. Smaller: rounding decides where a flat edge touches.
inline constexpr Real LEAST_BULGE = Real(0.01);

/// Largest Poisson's ratio of a material [1]. At 1/2 the area cannot change and the moduli are infinite.
inline constexpr Real MOST_POISSON_RATIO = Real(0.49);

/// Largest substep count accepted or chosen [1]. A body that needs more cannot be stepped explicitly in real time; its
/// plan then reports itself as unsafe.
inline constexpr int MAX_SUBSTEPS = 64;

/// Length of a step [s] for which the substep counts below are meant. A longer step takes proportionally more;
/// otherwise contacts and XPBD would get worse at 30 ticks a second.
inline constexpr Real USUAL_STEP = Real(1) / 60;

/// Fewest substeps the automatic rule gives a body that can touch something [1]. Contacts are found once a substep;
/// below four a resting body visibly sinks and creeps.
inline constexpr int MIN_CONTACT_SUBSTEPS = 4;

/// Most contact substeps that touching bodies take because one of them needs as many force substeps [1]. Stiffer bodies
/// take several force substeps in each.
inline constexpr int MAX_CONTACT_SUBSTEPS = 32;

/// Speed [length/s, times WorldData::length_unit] below which a body counts as at rest, for its center of mass. Its
/// points, root mean square weighted by mass, may be SLEEP_WOBBLE times as fast. Larger: bodies stop in the middle of a
/// slow roll or wobble. Smaller: piles in which a light body trembles between heavy ones never sleep.
inline constexpr Real SLEEP_SPEED = Real(0.05);
inline constexpr Real SLEEP_WOBBLE = 3;
/// Multiple of both speeds for a pressed body (`pressed_area`) [1]. Larger: such bodies stop before
/// they have sunk. Smaller: piles of bodies that are far too soft never sleep.
inline constexpr Real SLEEP_AT_LIMITS = 3;

/// Speed [length/s, times WorldData::length_unit] below which the center of mass and the points of a body without
/// gravity count as at rest. Drifting bodies do not rest. In pixels, the default of Godot's own bodies.
inline constexpr Real SLEEP_SPEED_WEIGHTLESS = Real(0.02);

/// Time [s] after which a body that has hardly moved is drowsy, and time in which its velocities then fall to 1/e.
/// Without it tremors let a pile creep and wake itself. Longer: piles sleep later. Shorter: slow bodies stick.
inline constexpr Real DROWSY_TIME = Real(0.1);
inline constexpr Real DROWSY_DECAY = Real(0.1);

/// Acceleration [length/s², times WorldData::length_unit] from which a slow body is about to move, as the mean over its
/// drowsy time; and that along their weight from which bodies that touch are about to move together. Larger: bodies in low gravity or on
/// smooth slopes fall asleep before they move. Smaller: what is meant to float never sleeps, nor does a pile while it
/// settles (up to 0.09).
inline constexpr Real FREE_PULL = Real(0.025);
inline constexpr Real FREE_PULL_OF_MANY = Real(0.2);

/// Time [s] that a contact island must have been at rest before it falls asleep.
inline constexpr Real SLEEP_TIME = Real(0.5);

/// Share of the smaller body's radius by which bodies may overlap before they are moved apart as wholes, and by which
/// they are moved at most in a substep [1]. Smaller: piles are moved instead of pressed. Larger: bodies that start
/// inside one another strain their springs and jump apart.
inline constexpr Real DEEP_OVERLAP = Real(0.1);

/// Share of the smaller body's radius by which a contact of one substep pushes points out of an overlap older than the
/// substep [1]. Larger: the rest of a deep overlap jumps apart. Smaller: points stay inside for longer.
inline constexpr Real OLD_OVERLAP_PUSH = Real(0.02);

/// Share of the thinner body's width that two bodies may move towards each other in a substep before their contacts are
/// swept [1]. Larger: fast points may be taken for points that came from the other side.
inline constexpr Real SWEEP_SHARE = Real(0.25);

/// Distance that a hull with self-collision keeps from itself, as a share of its shortest edge at rest [1]. Larger:
/// folds stay visibly apart. Smaller: rounding may cross them, above all far from the world's origin.
inline constexpr Real SELF_GAP = Real(1) / 32;

/// Share of its convex hull that an outline without deep dents fills [1]. Larger: bodies that cannot meet themselves
/// are tested for it, which takes two to four times as long. Smaller: arms and lips pass through each other.
inline constexpr Real LEAST_SOLIDITY = Real(0.95);

/// Passes over the contacts of a hull with itself in a substep, before remaining crossings are moved as one piece [1].
/// Fewer: a body folded onto itself stiffens. More: proportional cost where it is folded.
inline constexpr int SELF_CONTACT_PASSES = 4;

/// Stability budget S of the substep rule h²Ω² + 2hΓ <= S² [1]. 2 is the limit of the linear theory and fails for
/// crumpled bodies. Figures: docs/accuracy.md, "The automatic choice".
inline constexpr Real STABILITY_BUDGET = Real(1.3);

/// Distance of points from their places at rest up to which a body is near its rest shape, over its radius [1]. There
/// STABILITY_BUDGET is spent on the frequency at rest. Larger: springs may line up and be faster than planned for.
/// Smaller: pressed bodies take substeps that they do not need.
inline constexpr Real CALM_STRAIN = Real(0.15);

/// Least damping ratio of the fastest vibration with which a body may have the plan for its rest shape [1]. Smaller: in crowds
/// that bounce, energy grows. Larger: bodies with little damping take substeps that they do not need.
inline constexpr double CALM_DAMPING = 0.02;

/// Most substeps the automatic choice spends on explicit springs [1]. A body that needs more gets XPBD, which gains no
/// energy with any stiffness, but damps wobbles far too fast for its substeps.
inline constexpr int EXPLICIT_SUBSTEP_CAP = 32;

/// Substeps of a body whose automatic choice is XPBD [1]. More make it stiffer and livelier.
inline constexpr int XPBD_SUBSTEPS = 16;

/// Angle Ωh [rad] by which the fastest wobble turns in a substep of XPBD at which the method is half way from the
/// implicit midpoint rule to implicit Euler. Larger: stiffer bodies keep their wobble, and ring on where they are
/// pressed. Smaller: they lose their bounce.
inline constexpr Real XPBD_FAST_WOBBLE = 20;

/// Damping rate Γ as a share of the fastest wobble Ω from which XPBD is implicit Euler [1]: twice the damping ratio of
/// that wobble. Such a body does not wobble. Larger: strongly damped thin bodies let fast ones through. Smaller: discs of many points lose way.
inline constexpr Real XPBD_STRONG_DAMPING = 1;

/// Damping ratio c / sqrt(k m) below which large deformations ring for long [1]. Nothing is clamped to it; the node
/// warns.
inline constexpr Real DAMPING_FLOOR = Real(0.02);

/// Default shape-matching stiffness as a fraction of the springs' stiffness [1]. Below about 0.4 some strongly deformed
/// bodies stay folded forever.
inline constexpr Real DEFAULT_SHAPE_MATCHING = Real(0.4);

/// Half thickness given to a line segment [length, times WorldData::length_unit]. A point rests this far from the line,
/// so that rounding can never put it on the other side. Larger: visible gap. Smaller: leaks far from the origin.
inline constexpr Real LINEAR_SLOP = Real(0.001);

/// Depth up to which a one-way collider still holds a body, if it sets none [length, times WorldData::length_unit].
/// Larger: bodies that have hardly come through from behind are held. Smaller: pressed bodies may fall through.
inline constexpr Real ONE_WAY_MARGIN = Real(0.01);

/// Least cosine between a contact's normal and the direction in which a one-way collider holds [1]. Larger: bodies slip
/// off round ends and slopes. Smaller: steep sides hold, too.
inline constexpr Real ONE_WAY_FACING = Real(0.1);

/// Distance between points of a joined body, in radii, beyond which it counts as blown up and is reset; also the
/// farthest flight in a step that outlasts a reset [1]. Larger: a body that blows up over several steps reappears away
/// from its place. Smaller: a stretched body is taken for lost.
inline constexpr Real CREDIBLE_REACH = 1000;

/// Correction of a stretch or area out of bounds in a substep, as a share of the rest size or area [1]. Larger: crushed
/// bodies jump up. Smaller: they are out of bounds for longer, and high heaps of soft bodies fold.
inline constexpr Real LIMIT_PUSH = Real(0.1);

/// Multiple of its least area below which a body is smoothed [1]. Larger: bodies under load keep fewer dents. Smaller:
/// single points fold in before the area is lost.
inline constexpr Real LIMIT_ONSET = Real(1.5);

/// Largest speed at which limits restore a body that is crumpled, out of bounds by more than LIMIT_FAR, or that nothing
/// can press on [radii/s]. Larger: ruined bodies burst. A body that a load presses out of bounds has no such bound.
inline constexpr Real LIMIT_SPEED = 4;
inline constexpr Real LIMIT_FAR = Real(0.3);

/// Largest share of the way to its place in the affine map that a point of a crumpled body goes in a substep [1].
inline constexpr Real LIMIT_SMOOTHING = Real(0.25);

/// Rate at which the motion within a crumpled body, or one out of bounds, dies away [1/s]. Smaller: piles of bodies that
/// are too soft tremble for ever. Larger: ruined bodies rise more slowly.
inline constexpr Real LIMIT_DAMPING = 24;

/// Rigid flight (`WorldData::set_rigid_flight`): largest distance of a point from its place in the rigid copy of the rest shape, over
/// the radius [1], and largest speed of a point relative to that copy, over the radius [1/s], with which a body flies as a rigid one.
/// Larger: bodies stop wobbling in the air, visibly. Smaller: bodies wobble for longer before they save anything.
inline constexpr Real FLIGHT_STRAIN = Real(0.005);
inline constexpr Real FLIGHT_STRAIN_RATE = Real(0.15);

/// Gap to the environment, beyond the way of a step and over the radius [1], below which a body does not fly as a rigid one. Larger: bodies
/// near the ground save nothing. Smaller: a body may meet the ground in the step in which it is first stepped in full.
inline constexpr Real FLIGHT_GAP = Real(0.125);

/// Largest difference of the length of a spring at rest and of its line in the rest shape [1] with which a body may fly as a rigid one.
/// Larger: bodies that are tense by design keep a wrong shape. Smaller: rounding decides.
inline constexpr Real SLACK_SPRING = Real(1e-3);

/// Fraction of its rest length below which a spring has no usable direction and exerts no force in that evaluation [1].
inline constexpr Real DEGENERATE_LENGTH = Real(1e-6);

/// Approach speeds below this many substeps of free fall do not bounce [1]. A resting point gains one substep of
/// gravity between contacts; without the threshold restitution would keep it alive.
inline constexpr Real RESTITUTION_SUBSTEPS = 2;

/// Time [s] over which a body that hardly moves forgets its landing speed. Longer: a body at rest leaps when it is
/// nudged. Shorter: the turning point of a slow landing costs it its bounce.
inline constexpr Real BOUNCE_MEMORY = Real(0.3);

/// Time [s] without a contact after which a monitored touch has ended. Longer: ends are reported late. Shorter: the
/// trembling of bodies that come to rest is reported as ends and beginnings.
inline constexpr Real TOUCH_MEMORY = Real(0.05);

/// Share of the smaller body's radius by which a body and the surface it touched must also have parted for their touch
/// to end [1]. Smaller: neighbors in a creeping pile, or a body that hops as it comes to rest, touch and part again and
/// again. Larger: bodies count as touching that are visibly apart.
inline constexpr Real TOUCH_GAP = Real(0.02);

/// Passes over the contacts with dynamic rigid bodies in each substep [1]. Fewer: a box on several bodies rocks longer.
inline constexpr int RIGID_CONTACT_PASSES = 4;

/// Passes over the joints in each substep [1]. Fewer: several joints on one point or body give way to one another.
inline constexpr int JOINT_PASSES = 4;

/// Speed at which a rigid joint closes an old gap, beyond what it opens meanwhile, as a multiple of the smaller body's
/// radius [1/s]: 240 px/s for 50 px. Larger: bodies are snatched together. Smaller: they are drawn slowly.
inline constexpr Real JOINT_GAP_SPEED = Real(4.8);

/// Share of its gap that a rigid joint closes in a step where only the rigid body can move [1]. Larger: it overshoots,
/// as its engine moves the body once a step. Smaller: the gap closes slowly.
inline constexpr Real JOINT_PULL = Real(0.2);

/// Share of its rest area below which a joined body does not collide with the bodies that it is tied to, directly or
/// through others [1]. Larger: bodies that are merely pressed pass through their structure. Smaller: a knotted chain stays a knot.
inline constexpr Real CRUSHED_AREA = Real(0.25);

/// Least inverse mass of a place on a hull edge, as a share of its lighter end's [1]. An end is moved by at most 1 /
/// sqrt of this, 5 times the motion of the place.
inline constexpr Real LEAST_EDGE_INVERSE_MASS = Real(0.04);

/// Largest `max_dent` [1]. Larger: the points of a dented body may coincide.
inline constexpr Real MOST_DENT = Real(0.9);

} // namespace softbody
