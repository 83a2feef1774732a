#pragma once

// All of abut::recast: walk meshes from levels.

#include <abut/recast/bake_walk_mesh.hpp>
