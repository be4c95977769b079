// SPDX-License-Identifier: MIT
// Traits of a shape that its node tells and the physics server does not.
#include "godot/surroundings/shape_traits.h"

#include <godot_cpp/classes/collision_object2d.hpp>
#include <godot_cpp/classes/physics_server2d.hpp>
#include <godot_cpp/classes/tile_data.hpp>
#include <godot_cpp/classes/tile_map_layer.hpp>
#include <godot_cpp/classes/tile_set.hpp>

using namespace godot;

namespace softbody {

std::vector<ShapeTraits> read_shape_traits(Object *p_owner, int p_count) {
	std::vector<ShapeTraits> traits;
	traits.resize(std::size_t(p_count));
	CollisionObject2D *object = Object::cast_to<CollisionObject2D>(p_owner);
	if (object == nullptr) {
		return traits;
	}
	for (const int64_t id : object->get_shape_owners()) {
		const uint32_t owner = uint32_t(id);
		ShapeTraits of_owner;
		of_owner.disabled = object->is_shape_owner_disabled(owner);
		if (object->is_shape_owner_one_way_collision_enabled(owner)) {
			of_owner.one_way_margin = object->get_shape_owner_one_way_collision_margin(owner);
		}
		const int32_t count = object->shape_owner_get_shape_count(owner);
		for (int32_t i = 0; i < count; i++) {
			const int32_t index = object->shape_owner_get_shape_index(owner, i);
			if (index >= 0 && index < p_count) {
				traits[std::size_t(index)] = of_owner;
			}
		}
	}
	return traits;
}

uint64_t describe_shape_owners(Object *p_owner) {
	uint64_t hash = 0;
	if (CollisionObject2D *object = Object::cast_to<CollisionObject2D>(p_owner)) {
		for (const int64_t owner : object->get_shape_owners()) {
			const uint64_t value = uint64_t(owner) << 1 | uint64_t(object->is_shape_owner_disabled(uint32_t(owner)));
			hash = (hash ^ (value + 1)) * 0x9e3779b97f4a7c15u;
		}
	}
	return hash;
}

// One body may hold several tiles, and a tile several polygons. The engine does not mix ordinary and one-way polygons
// in a body, and nothing else that can be read separates bodies of one layer of the tile set. So the tile in the middle
// of the shape decides, by its polygons on layers like the body's.
std::optional<double> find_tile_margin(Object *p_layer, const RID &p_body, const Vector2 &p_middle) {
	TileMapLayer *map = Object::cast_to<TileMapLayer>(p_layer);
	if (map == nullptr) {
		return {};
	}
	const Ref<TileSet> tile_set = map->get_tile_set();
	const TileData *tile = map->get_cell_tile_data(map->local_to_map(map->to_local(p_middle)));
	if (tile_set.is_null() || tile == nullptr) {
		return {};
	}
	const uint32_t body_layers = PhysicsServer2D::get_singleton()->body_get_collision_layer(p_body);
	for (int32_t layer = 0; layer < tile_set->get_physics_layers_count(); layer++) {
		if (tile_set->get_physics_layer_collision_layer(layer) != body_layers) {
			continue;
		}
		for (int32_t polygon = 0; polygon < tile->get_collision_polygons_count(layer); polygon++) {
			if (tile->is_collision_polygon_one_way(layer, polygon)) {
				return tile->get_collision_polygon_one_way_margin(layer, polygon);
			}
		}
	}
	return {};
}

} // namespace softbody
