// Polytopes: hulls, overlaps, Minkowski sums, and the decompositions of outlines and meshes into them.

#include "../../scenes/outlines.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "../query/whole_numbers.hpp"
#include "sections.hpp"
#include <abut/bake/decompose.hpp>
#include <abut/bake/decompose_outline.hpp>
#include <abut/bake/fit.hpp>
#include <abut/bake/repair.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/minkowski_sum.hpp>

namespace abut::everywhere {
namespace {

void add_polytope(Hash& hash, const Polygon& polygon) {
    for (const Vec2& point : polygon.points()) hash.add<2>(point);
    hash.add<2>(polygon.centroid());
    hash.add(static_cast<float>(polygon.area()));
}
void add_polytope(Hash& hash, const Polyhedron& polyhedron) {
    for (const Vec3& point : polyhedron.points()) hash.add<3>(point);
    hash.add<3>(polyhedron.centroid());
    hash.add(static_cast<float>(polyhedron.volume()));
}

template <int D>
void add_overlaps_and_sums(Hash& hash, std::uint64_t seed) {
    WholeNumbers<D> make(seed, seed % 4 == 3);
    const Vec<D> center = make.point(), half = make.half();
    const Box<D> box{center, half, make.rotation()};
    const PolytopeOf<D> hull = *PolytopeOf<D>::build(make.points(12));
    const Vec<D> a = make.point(), b = make.point(), c = make.point();
    const Triangle<D> triangle{a, b, c};
    if (const auto overlap = intersection(box, hull)) add_polytope(hash, *overlap);
    if (const auto overlap = intersection(hull, triangle)) add_polytope(hash, *overlap);
    add_polytope(hash, minkowski_sum(box, triangle));
    add_polytope(hash, minkowski_difference(hull, box));
    const Vec<D> middle = make.point();
    const Ball<D> ball{middle, make.size()};
    add_polytope(hash, polytope(ball, ball.radius / 4));
}

template <int D>
void add_hulls(Hash& hash) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        WholeNumbers<D> make(seed, seed % 2 == 1);
        const std::vector<Vec<D>> points = make.points(seed < 2 ? 2000 : 100);
        add_polytope(hash, *PolytopeOf<D>::build(points));
        double added = 0;
        add_polytope(hash, *PolytopeOf<D>::build(points, {.max_vertices = 8, .added = &added}));
        hash.add(static_cast<float>(added));
    }
}

void add_outline(Hash& hash, const scenes::Outline& outline) {
    for (const double concavity : {0.0, 0.1}) {
        const auto parts = decompose(outline.ring, outline.holes, {.concavity = concavity});
        for (const Polygon& part : *parts) add_polytope(hash, part);
    }
}

void add_solid(Hash& hash, const scenes::SolidMesh& mesh, std::uint32_t max_parts) {
    const auto parts = decompose(mesh.points, mesh.triangles, {.max_parts = max_parts, .max_vertices = 24});
    for (const Polyhedron& part : *parts) {
        add_polytope(hash, part);
        if (const auto simple = fit(part, {.tolerance = 0.5})) hash.add(static_cast<float>(simple->error));
    }
}

}  // namespace

void add_polytopes(Hash& hash) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        add_overlaps_and_sums<2>(hash, seed);
        add_overlaps_and_sums<3>(hash, seed);
    }
    add_hulls<2>(hash);
    add_hulls<3>(hash);
}

void add_decompositions(Hash& hash) {
    add_outline(hash, {scenes::spiky_star(60, 1), {}});
    add_outline(hash, {scenes::comb(12), {}});
    add_outline(hash, scenes::plate(3, 8, 2));
    add_solid(hash, scenes::house(), 12);
    add_solid(hash, scenes::knotted_tube(24, 6), 8);
    scenes::SolidMesh torn = scenes::house();
    torn.triangles.resize(torn.triangles.size() - 3);
    std::swap(torn.triangles[5].x, torn.triangles[5].y);
    const auto repaired = repair(torn.points, torn.triangles);
    for (const Vec3& point : repaired->points) hash.add<3>(point);
    for (const glm::uvec3& t : repaired->triangles) hash.add(std::uint64_t{t.x} << 42 | std::uint64_t{t.y} << 21 | t.z);
}

}  // namespace abut::everywhere
