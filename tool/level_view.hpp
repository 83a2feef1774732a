#pragma once

// A level as it stands at the first moment: what the checks of a level look at, whatever it was read from.

#include "level_objects.hpp"
#include "scene_objects.hpp"
#include <abut/math/vec.hpp>
#include <abut/shape/view.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

/// The flat pieces that bound things: segments of the plane, triangles in space. In front of a piece, which is where
/// things are free to be, is to the right of a segment, and where a triangle's corners go round counter-clockwise.
template <int D>
struct Surface {
    using Facet = std::array<std::uint32_t, static_cast<std::size_t>(D)>;

    std::vector<Vec<D>> points;  ///< in the world, no position twice
    std::vector<Facet> facets;
    std::vector<bool> two_sided;  ///< of each piece: it is free behind it too; empty: behind none

    bool is_two_sided(std::size_t facet) const { return !two_sided.empty() && two_sided[facet]; }
};

template <int D>
struct StandingObject {
    std::string path;
    std::string name;       ///< the last part of it
    std::size_t model = 0;  ///< objects of one model have the same facets, each in its place
    View<D> shape;          ///< where it stands
    Aabb<D> box = Aabb<D>::empty();
    float radius = 0;     ///< its size
    bool filled = false;  ///< its inside belongs to it
    bool convex = false;  ///< filled, and nothing but the hull of its corners
    Surface<D> surface;
};

/// A place with a name: any node of a scene, also one without geometry; in the plane any point, and the middle of the
/// box of any object.
template <int D>
struct NamedPlace {
    std::string path;
    std::string name;
    Vec<D> position{};
    std::string type;  ///< the class that its author gave it, where files have such
};

template <int D>
struct LevelView {
    std::vector<StandingObject<D>> objects;  ///< in the order of their paths
    std::vector<NamedPlace<D>> places;       ///< the same
};

/// Refers to the objects, which are at the time that is given. Objects that are left out then are left out.
LevelView<3> level_view(const Scene& scene, const SceneObjects& objects, double time);
LevelView<2> level_view(const Level& level, const LevelObjects& objects, double time);

}  // namespace abut::tool
