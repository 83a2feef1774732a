// CGAL: closest points with a tree of boxes, and shortest paths over triangles (Chen and Han 1990, as modified by Xin
// and Wang 2009).

#include "walk.hpp"
#include <abut/math/dvec.hpp>

#include <cmath>
#include <vector>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

namespace abut::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;
using Shortest = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Surface>>;

Surface surface_of(const WalkScene& scene) {
    Surface result;
    using Index = CGAL::SM_Vertex_index;
    for (const Vec3& p : scene.points) result.add_vertex({p.x, p.y, p.z});
    for (const glm::uvec3& t : scene.triangles) result.add_face(Index(t.x), Index(t.y), Index(t.z));
    return result;
}

struct TreeOfSurface {
    Surface surface;
    Tree tree;

    explicit TreeOfSurface(const WalkScene& scene)
        : surface(surface_of(scene)), tree(faces(surface).first, faces(surface).second, surface) {
        tree.accelerate_distance_queries();
    }
};

/// A face stores its last vertex first: its half-edge starts there.
Shortest::Face_location location(const WalkPoint& place) {
    return {CGAL::SM_Face_index(place.triangle), {place.weights.z, place.weights.x, place.weights.y}};
}

}  // namespace

Side cgal_nearest(const SharedWalkPoints& points) {
    return {"CGAL", [points, tree = std::make_shared<const TreeOfSurface>(*points->scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const Vec3& p = points->points[i];
                    values[i] = std::sqrt(tree->tree.squared_distance({p.x, p.y, p.z}));
                }
            }};
}

Side cgal_paths(const SharedWalkPaths& paths_to_find) {
    return {"CGAL, shortest", [paths_to_find, surface = std::make_shared<const Surface>(
                                                  surface_of(*paths_to_find->scene))](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    Shortest shortest(*surface);
                    shortest.add_source_point(location(paths_to_find->from[i]));
                    const Shortest::Face_location to = location(paths_to_find->to[i]);
                    values[i] = shortest.shortest_distance_to_source_points(to.first, to.second).first;
                }
            }};
}

}  // namespace abut::bench
