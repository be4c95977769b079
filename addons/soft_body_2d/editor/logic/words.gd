# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Every text that a user reads goes through here, so that it can be translated: into the editor's language, by
## `editor/translations/*.po` (or .translation) of this addon, in a domain of their own where the engine has those (4.4).

const DOMAIN := &"soft_body_2d_editor"
const FOLDER := "res://addons/soft_body_2d/editor/translations"


static func say(text: String) -> String:
	if TranslationServer.has_method(&"get_or_add_domain"):
		var domain: Object = TranslationServer.call(&"get_or_add_domain", DOMAIN)
		return domain.call(&"translate", StringName(text))
	return TranslationServer.translate(text)


## When the plugin is switched on.
static func load_translations() -> void:
	if not TranslationServer.has_method(&"get_or_add_domain") or not DirAccess.dir_exists_absolute(FOLDER):
		return
	var domain: Object = TranslationServer.call(&"get_or_add_domain", DOMAIN)
	for file in DirAccess.get_files_at(FOLDER):
		if file.get_extension() in ["po", "translation"]:
			domain.call(&"add_translation", load(FOLDER.path_join(file)))
	if domain.has_method(&"set_locale_override"): # 4.6; the locale is that of the game otherwise
		domain.call(&"set_locale_override", TranslationServer.get_tool_locale())


static func unload_translations() -> void:
	if TranslationServer.has_method(&"remove_domain"):
		TranslationServer.call(&"remove_domain", DOMAIN)
