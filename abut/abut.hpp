#pragma once

// All that a game links: abut::abut. Each header can be included by itself as well.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/early_out.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/minkowski_sum.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/polytope.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/world/world.hpp>
