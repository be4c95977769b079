# SPDX-License-Identifier: MIT
# Ends with status 0 if the engine has loaded the extension of this addon, with 1 if not.
extends SceneTree


func _initialize() -> void:
	var loaded := GDExtensionManager.is_extension_loaded("res://addons/soft_body_2d/soft_body_2d.gdextension")
	quit(0 if loaded else 1)
