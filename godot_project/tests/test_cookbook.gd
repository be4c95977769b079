# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Every answer of the cookbook names a scene that is there; test_scenes.gd runs them.

const PAGE := "res://../docs/cookbook.md"


func test_each_of_twenty_answers_is_backed_by_a_scene() -> void:
	var path := ProjectSettings.globalize_path(PAGE)
	if not FileAccess.file_exists(path):
		skip("there is no folder docs beside the project")
		return
	var answers := FileAccess.get_file_as_string(path).split("\n## ")
	check_equal(answers.size() - 1, 20, "answers")
	var scenes := RegEx.create_from_string("`([a-z_0-9/]+\\.tscn)`")
	for answer in answers.slice(1):
		var title := answer.get_slice("\n", 0)
		var named := scenes.search_all(answer)
		check(not named.is_empty(), "'%s' names a scene" % title)
		for found in named:
			var scene := "res://" + found.get_string(1)
			check(ResourceLoader.exists(scene), "%s, of '%s', is there" % [scene, title])
