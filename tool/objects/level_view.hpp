#pragma once

// A uniform view of a scene or level at its first time, for the checks of levels.

#include "tool/objects/level_objects.hpp"
#include "tool/objects/scene_objects.hpp"
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/view/view.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// Boundary facets: segments in 2D, triangles in 3D. The front of a facet faces free space: it is to the right of a
/// segment, and where the corners of a triangle are counter-clockwise.
template <int D>
struct Surface {
    using Facet = std::array<std::uint32_t, static_cast<std::size_t>(D)>;

    std::vector<Vec<D>> points;  ///< in world space, without duplicates
    std::vector<Facet> facets;
    std::vector<bool> two_sided;  ///< per facet: free space on both sides; empty: no facet is two-sided

    bool is_two_sided(std::size_t facet) const { return !two_sided.empty() && two_sided[facet]; }
};

template <int D>
struct ViewedObject {
    std::string path;
    std::string name;       ///< last component of the path
    std::string type;       ///< class assigned by the author, if the format has classes
    std::size_t model = 0;  ///< objects of one model have the same facets under different transforms
    View<D> shape;          ///< in world space
    Aabb<D> box = Aabb<D>::empty();
    float radius = 0;     ///< bounding radius
    bool filled = false;  ///< it has an interior
    bool convex = false;  ///< filled, and equal to the convex hull of its vertices
    Surface<D> surface;
};

/// A named point: any node of a scene, with or without geometry; in 2D any point, and the centre of any object's box.
template <int D>
struct NamedPlace {
    std::string path;
    std::string name;
    Vec<D> position{};
    std::string type;                            ///< class assigned by the author, if the format has classes
    std::optional<Aabb<D>> area = std::nullopt;  ///< of an object that doesn't collide: the whole area is meant
};

template <int D>
struct LevelView {
    std::vector<ViewedObject<D>> objects;  ///< sorted by path
    std::vector<NamedPlace<D>> places;     ///< sorted by path
    std::optional<Problem> problem = {};   ///< an object whose outline is beyond the limits
};

/// Refers to the objects, which must be at the given time. Objects that are not present are left out.
LevelView<3> level_view(const Scene& scene, const SceneObjects& objects, double time);
LevelView<2> level_view(const Level& level, const LevelObjects& objects, double time);

}  // namespace abut::tool
