#include <abut/draw/placed_faces.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

void add_face(PlacedFaces& result, const Convex<3>& convex, const DVec<3>& normal, std::vector<std::uint32_t> corners) {
    const Affine<3>& place = convex.place;
    const bool mirrored = dot(place.column[0], cross(place.column[1], place.column[2])) < 0;
    if (mirrored) std::reverse(corners.begin(), corners.end());
    result.faces.push_back({normalized(mapped_normal(place, normal), DVec<3>(0.0)), std::move(corners)});
}

void add_box(PlacedFaces& result, const Convex<3>& convex) {
    for (std::uint32_t i = 0; i < 8; ++i) {
        DVec<3> corner(convex.own[0]);
        for (int k = 0; k < 3; ++k)
            if ((i >> k & 1) == 0) corner[k] = -corner[k];
        result.corners.push_back(convex.place.point(corner));
    }
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t along = 1u << k, u = 1u << (k + 1) % 3, v = 1u << (k + 2) % 3;
        add_face(result, convex, axis<3>(k), {along, along | u, along | u | v, along | v});
        add_face(result, convex, axis<3>(k, -1), {0, v, u | v, u});
    }
}

void add_triangle(PlacedFaces& result, const Convex<3>& convex) {
    const Vec3* p = convex.vertices();
    const DVec<3> a(p[0]), b(p[1]), c(p[2]);
    const DVec<3> normal = normalized(cross(b - a, c - a), DVec<3>(0.0));
    add_face(result, convex, normal, {0, 1, 2});
    add_face(result, convex, -normal, {0, 2, 1});
}

void add_facets(PlacedFaces& result, const Convex<3>& convex) {
    const Facets& facets = *convex.facets;
    auto begin = facets.loops.data();
    for (std::size_t i = 0; i < facets.normals.size(); ++i) {
        const auto end = facets.loops.data() + facets.loop_ends[i];
        add_face(result, convex, DVec<3>(facets.normals[i]), {begin, end});
        begin = end;
    }
}

}  // namespace

PlacedFaces placed_faces(const Convex<3>& convex) {
    PlacedFaces result;
    if (convex.inner_radius > 0) return result;
    if (convex.core == Core::box) {
        add_box(result, convex);
    } else if (convex.core == Core::points) {
        for (std::uint32_t i = 0; i < convex.count; ++i)
            result.corners.push_back(convex.place.point(DVec<3>(convex.vertices()[i])));
        if (convex.facets != nullptr)
            add_facets(result, convex);
        else if (convex.count == 3)
            add_triangle(result, convex);
    }
    return result;
}

}  // namespace abut::detail
