// SPDX-License-Identifier: MIT
// Registers the extension's classes and its singleton with Godot.
#include "godot/editor/soft_body_preview_2d.h"
#include "godot/nodes/body_picker.h"
#include "godot/nodes/soft_body_2d.h"
#include "godot/nodes/soft_body_attachment_2d.h"
#include "godot/nodes/soft_body_fluid_2d.h"
#include "godot/nodes/soft_body_joint_2d.h"
#include "godot/nodes/soft_body_skin_2d.h"
#include "godot/nodes/soft_rope_2d.h"
#include "godot/resources/soft_body_material_2d.h"
#include "godot/server/soft_body_simulation_2d.h"
#include "godot/server/step_settings.h"

#include <gdextension_interface.h>
#include <godot_cpp/classes/engine.hpp>
#include <godot_cpp/core/class_db.hpp>
#include <godot_cpp/godot.hpp>

using namespace godot;

static SoftBodySimulation2D *simulation = nullptr;

static void initialize_soft_body_2d_module(ModuleInitializationLevel p_level) {
	if (p_level != MODULE_INITIALIZATION_LEVEL_SCENE) {
		return;
	}
	GDREGISTER_CLASS(SoftBodySimulation2D);
	GDREGISTER_CLASS(SoftBodyMaterial2D);
	GDREGISTER_INTERNAL_CLASS(SoftBodyPicker);
	GDREGISTER_CLASS(SoftBody2D);
	GDREGISTER_CLASS(SoftRope2D);
	GDREGISTER_CLASS(SoftBodyAttachment2D);
	GDREGISTER_CLASS(SoftBodySkin2D);
	GDREGISTER_CLASS(SoftBodyFluid2D);
	GDREGISTER_CLASS(SoftBodyJoint2D);
	GDREGISTER_CLASS(SoftBodyPreview2D);
	softbody::register_step_settings();
	simulation = memnew(SoftBodySimulation2D);
	Engine::get_singleton()->register_singleton("SoftBodySimulation2D", simulation);
}

// The editor takes a library that it loads anew up from the level we ask for, but down to the lowest one. There godot-cpp
// gives back what it holds of the engine's singletons, if it has counted that level; else the engine, when it ends, calls
// into a library that is gone.
static void count_lowest_level() {
	int &count = GDExtensionBinding::level_initialized[MODULE_INITIALIZATION_LEVEL_CORE];
	count = MAX(count, 1);
}

static void uninitialize_soft_body_2d_module(ModuleInitializationLevel p_level) {
	if (p_level == MODULE_INITIALIZATION_LEVEL_CORE) {
		count_lowest_level();
	}
	if (p_level != MODULE_INITIALIZATION_LEVEL_SCENE) {
		return;
	}
	Engine::get_singleton()->unregister_singleton("SoftBodySimulation2D");
	memdelete(simulation);
	simulation = nullptr;
}

extern "C" GDExtensionBool GDE_EXPORT soft_body_2d_library_init(GDExtensionInterfaceGetProcAddress p_get_proc_address,
		GDExtensionClassLibraryPtr p_library, GDExtensionInitialization *r_initialization) {
	GDExtensionBinding::InitObject init(p_get_proc_address, p_library, r_initialization);
	init.register_initializer(initialize_soft_body_2d_module);
	init.register_terminator(uninitialize_soft_body_2d_module);
	init.set_minimum_library_initialization_level(MODULE_INITIALIZATION_LEVEL_SCENE);
	return init.init();
}
