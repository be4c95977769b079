// SPDX-License-Identifier: MIT
// Warns of Godot's own joints that name a SoftBody2D.
#pragma once

namespace godot {
class SceneTree;
}

namespace softbody {

/// Godot's joints take physics bodies only, and join a soft body to nothing without a word while the game runs. From now on such a
/// joint in the tree is warned of, with the node to use instead. Debug builds only.
void watch_engine_joints(godot::SceneTree *tree);

} // namespace softbody
