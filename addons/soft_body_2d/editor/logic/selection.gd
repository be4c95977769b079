# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Which points or springs of which bodies are selected.

var _chosen := {} # instance id -> {index: true}


func clear() -> void:
	_chosen.clear()


func is_empty() -> bool:
	return _chosen.is_empty()


func size() -> int:
	var count := 0
	for indices: Dictionary in _chosen.values():
		count += indices.size()
	return count


func has(body: Object, index: int) -> bool:
	return _chosen.has(body.get_instance_id()) and _chosen[body.get_instance_id()].has(index)


## Ascending.
func of(body: Object) -> PackedInt32Array:
	var indices := PackedInt32Array(_chosen.get(body.get_instance_id(), {}).keys())
	indices.sort()
	return indices


func add(body: Object, indices: PackedInt32Array) -> void:
	if indices.is_empty():
		return
	var chosen: Dictionary = _chosen.get_or_add(body.get_instance_id(), {})
	for index in indices:
		chosen[index] = true


func remove(body: Object, index: int) -> void:
	var id := body.get_instance_id()
	if _chosen.has(id):
		_chosen[id].erase(index)
		if _chosen[id].is_empty():
			_chosen.erase(id)


func toggle(body: Object, index: int) -> void:
	if has(body, index):
		remove(body, index)
	else:
		add(body, [index])


## Forgets bodies that are not in the list, and indices that are not below their counts.
func keep_to(bodies: Array, counts: PackedInt32Array) -> void:
	var kept := {}
	for i in bodies.size():
		var indices := of(bodies[i])
		for index in indices:
			if index < counts[i]:
				kept.get_or_add(bodies[i].get_instance_id(), {})[index] = true
	_chosen = kept
