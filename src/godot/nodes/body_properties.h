// SPDX-License-Identifier: MIT
// Enumerations of SoftBody2D, and its properties that are one value each.
#pragma once

#include "godot/drawing/skin_style.h"
#include "godot/nodes/contact_reports.h"

#include <cstdint>

namespace softbody {

/// A base of the node, so that all of this has the names `SoftBody2D::…` that the class reference gives it.
struct BodyProperties : SkinChoices {
	/// Same values as Integrator.
	enum Integrator {
		INTEGRATOR_AUTOMATIC,
		INTEGRATOR_EXPLICIT_EULER,
		INTEGRATOR_SEMI_IMPLICIT_EULER,
		INTEGRATOR_MIDPOINT,
		INTEGRATOR_HEUN,
		INTEGRATOR_RUNGE_KUTTA_4,
		INTEGRATOR_VELOCITY_VERLET,
		INTEGRATOR_XPBD,
	};

	/// What makes the body elastic. Those after NETWORK are ElasticModel, in its order.
	enum ElasticModel {
		ELASTIC_MODEL_AUTOMATIC,
		ELASTIC_MODEL_NETWORK,
		ELASTIC_MODEL_SPRINGS,
		ELASTIC_MODEL_SPRINGS_AND_SHAPE,
		ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA,
		ELASTIC_MODEL_MODES,
		ELASTIC_MODEL_TRIANGLES,
	};
	static constexpr int ELASTIC_MODEL_COUNT = ELASTIC_MODEL_TRIANGLES + 1;

	/// What makes the mass: the area with a density, or what was set.
	enum MassMode {
		MASS_MODE_AUTO,
		MASS_MODE_CUSTOM,
	};

	/// As RigidBody2D.DampMode.
	enum DampMode {
		DAMP_MODE_COMBINE,
		DAMP_MODE_REPLACE,
	};

	/// As CollisionObject2D.DisableMode.
	enum DisableMode {
		DISABLE_MODE_REMOVE,
		DISABLE_MODE_MAKE_STATIC,
		DISABLE_MODE_KEEP_ACTIVE,
	};

	/// What becomes of a body whose motion is no longer finite.
	enum FailureMode {
		FAILURE_MODE_RESET,
		FAILURE_MODE_FREEZE,
	};

	/// Off and on are what the property was before it could choose: false and true.
	enum SelfCollision {
		SELF_COLLISION_OFF,
		SELF_COLLISION_ON,
		SELF_COLLISION_AUTOMATIC,
	};

	/// Strains that leave a dent, as `softbody::DentBy`.
	enum DentBy {
		DENT_BY_BOTH,
		DENT_BY_COMPRESSION,
		DENT_BY_TENSION,
	};

	/// Which points are simulated for the polygon that is drawn.
	enum DetailMode {
		DETAIL_MODE_AS_DRAWN,
		DETAIL_MODE_AUTOMATIC,
		DETAIL_MODE_POINT_COUNT,
	};

	/// `SoftBody2D::bind_properties` has their ranges.
	struct Values {
		MassMode mass_mode = MASS_MODE_AUTO;
		double mass = 1; ///< in MASS_MODE_CUSTOM
		bool firm_for_weight = true;
		double gravity_scale = 1;
		ElasticModel elastic_model = ELASTIC_MODEL_AUTOMATIC;
		double least_area = 0.5;
		double least_stretch = 0.2;
		double most_stretch = 3;
		double smallest_piece = 0.02;
		DentBy dent_by = DENT_BY_BOTH;
		Integrator integrator = INTEGRATOR_AUTOMATIC;
		int substeps = 0;
		uint32_t collision_layer = 1;
		uint32_t collision_mask = 1;
		SelfCollision self_collision = SELF_COLLISION_AUTOMATIC;
		bool collision_proxy_enabled = true;
		double collision_proxy_margin = -1;
		bool input_pickable = false;
		bool contact_monitor = false;
		int max_contacts_reported = ContactReports::DEFAULT_LIMIT;
		DampMode linear_damp_mode = DAMP_MODE_COMBINE;
		double linear_damp = 0;
		DampMode angular_damp_mode = DAMP_MODE_COMBINE;
		double angular_damp = 0;
		bool can_sleep = true;
		bool lock_rotation = false;
		DisableMode disable_mode = DISABLE_MODE_REMOVE;
		bool simulate_off_screen = true;
		bool important = false;
		FailureMode failure_mode = FAILURE_MODE_RESET;
	};

	/// A model of the elasticity and why: "chosen", "own_springs", "painted_springs", "network_values", "material", or "unfit"
	/// where the network takes the place of a model that the body cannot have.
	struct ModelChoice {
		ElasticModel model = ELASTIC_MODEL_MODES;
		const char *reason = "material";
	};
};

} // namespace softbody
