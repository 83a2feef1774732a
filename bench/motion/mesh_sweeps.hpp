#pragma once

// Linear sweeps of one shape at a mesh, and the peers' answers. One value per motion: the distance, or -1 for a miss.

#include "rays.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>

#include <variant>

namespace abut::bench {

/// A shape about the origin.
using SweptShape = std::variant<Sphere, Capsule3, Box3>;

/// A shape that moves along each ray of the scene.
struct MeshSweeps {
    SharedRayMesh scene;
    SweptShape shape;
};

/// btCollisionWorld::objectQuerySingle at a btBvhTriangleMeshShape.
Side bullet_mesh_sweeps(const MeshSweeps& sweeps);

}  // namespace abut::bench
