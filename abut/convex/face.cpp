#include <abut/convex/face.hpp>
#include <abut/convex/farthest_point.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

template <int D>
Face<D> corner(const Convex<D>& convex, const DVec<D>& direction) {
    Face<D> face;
    const CorePoint<D> point = core_support(convex, direction);
    face.push_back(point.position, point.index);
    return face;
}

template <int D>
DVec<D> placed_vertex(const Convex<D>& convex, std::uint32_t i) {
    return convex.place.point(DVec<D>(convex.vertices()[i]));
}

/// An edge in 2D with its normal on the side of `direction`; a vertex if it has no length.
Face<2> edge_along(const DVec<2>& a, std::uint32_t index_a, const DVec<2>& b, std::uint32_t index_b,
                   const DVec<2>& direction) {
    Face<2> face;
    face.push_back(a, index_a);
    if (a == b) return face;
    face.push_back(b, index_b);
    face.normal = perpendicular(b - a);
    if (dot(face.normal, direction) < 0) face.normal = -face.normal;
    return face;
}

Face<3> triangle_along(const Convex<3>& convex, const DVec<3>& direction) {
    Face<3> face;
    for (std::uint32_t i = 0; i < 3; ++i) face.push_back(placed_vertex(convex, i), i);
    face.normal = normalized(cross(face.points[1] - face.points[0], face.points[2] - face.points[0]), DVec<3>(0.0));
    if (dot(face.normal, direction) < 0) face.normal = -face.normal;
    return face;
}

/// The normal nearest to `direction` after placement, for placements that aren't similarities.
std::size_t normal_along(const Convex<3>& convex, const DVec<3>& direction) {
    std::size_t best = 0;
    double maximum = -2;
    for (std::size_t i = 0; i < convex.facets->normals.size(); ++i) {
        const DVec<3> normal(convex.facets->normals[i]);
        const double along = dot(normalized(mapped_normal(convex.place, normal), DVec<3>(0.0)), direction);
        if (along > maximum) {
            maximum = along;
            best = i;
        }
    }
    return best;
}

Face<3> facet_along(const Convex<3>& convex, const DVec<3>& direction) {
    const Facets& facets = *convex.facets;
    const std::size_t best = convex.similar ? farthest_point(facets.normals, convex.place.transposed(direction))
                                            : normal_along(convex, direction);
    Face<3> face;
    face.normal = normalized(mapped_normal(convex.place, DVec<3>(facets.normals[best])), DVec<3>(0.0));
    const std::size_t begin = best == 0 ? 0 : facets.loop_ends[best - 1], corners = facets.loop_ends[best] - begin;
    const std::size_t selected = std::min(corners, Face<3>::capacity / 2);
    for (std::size_t i = 0; i < selected; ++i) {
        const std::uint32_t index = facets.loops[begin + i * corners / selected];
        face.push_back(placed_vertex(convex, index), index);
    }
    return face;
}

Face<3> box_face_along(const Convex<3>& convex, const DVec<3>& direction) {
    int best = 0;
    double sign = 1, maximum = -1;
    DVec<3> normal(0.0);
    for (int i = 0; i < 3; ++i) {
        const DVec<3> n = normalized(mapped_normal(convex.place, axis<3>(i)), DVec<3>(0.0));
        const double along = dot(n, direction);
        if (std::abs(along) > maximum) {
            maximum = std::abs(along);
            best = i;
            sign = along < 0 ? -1 : 1;
            normal = n * sign;
        }
    }
    Face<3> face;
    face.normal = normal;
    const int u = (best + 1) % 3, v = (best + 2) % 3;
    constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const auto& c : corners) {
        DVec<3> point(convex.own[0]);
        point[best] *= sign;
        point[u] *= c[0];
        point[v] *= c[1];
        const std::uint32_t index = (point[0] < 0 ? 1u : 0u) | (point[1] < 0 ? 2u : 0u) | (point[2] < 0 ? 4u : 0u);
        const DVec<3> position = convex.place.point(point);
        // The face of a box without thickness is an edge or a vertex.
        if (face.count > 0 && (position == face.points[0] || position == face.points[face.count - 1])) continue;
        face.push_back(position, index);
    }
    return face;
}

/// A flat end as a ring of points, a line along the side, or a vertex.
Face<3> discs_face_along(const Convex<3>& convex, const DVec<3>& direction) {
    const DVec<3> a(convex.own[0]), b(convex.own[1]);
    const double radius_a = static_cast<double>(convex.disc_radius[0]),
                 radius_b = static_cast<double>(convex.disc_radius[1]);
    const DVec<3> u = normalized(b - a, axis<3>(2));
    const DVec<3> local = normalized(convex.place.transposed(direction));
    const double along = dot(u, local);
    const bool at_b = along > 0;
    Face<3> face;
    if (std::abs(along) >= aligned && (at_b ? radius_b : radius_a) > 0) {
        // Eight directions by bisecting right angles: the ring has the same bits on every machine.
        const DVec<3> x = perpendicular(u), y = cross(u, x);
        const double diagonal = square_root(0.5);
        const DVec<3> ring[8] = {x,  (x + y) * diagonal,  y,  (y - x) * diagonal,
                                 -x, -(x + y) * diagonal, -y, (x - y) * diagonal};
        std::uint32_t index = 0;
        for (const DVec<3>& r : ring)
            face.push_back(convex.place.point(at_b ? b + r * radius_b : a + r * radius_a), index++);
        face.normal = normalized(mapped_normal(convex.place, at_b ? u : -u));
        return face;
    }
    const DVec<3> rim = normalized(local - u * along, DVec<3>(0.0));
    const DVec<3> low = a + rim * radius_a, high = b + rim * radius_b;
    const DVec<3> side = normalized(high - low, u);
    if (std::abs(dot(side, local)) > square_root(1 - aligned * aligned)) return corner(convex, direction);
    face.push_back(convex.place.point(low), 0);
    face.push_back(convex.place.point(high), 1);
    return face;
}

/// Reduces a face that is a million times longer than wide to an edge: its normal is rounding.
void thin_to_edge(Face<3>& face) {
    if (face.count < 3) return;
    const auto farthest_from = [&](std::size_t from) {
        std::size_t best = from;
        double maximum = 0;
        for (std::size_t i = 0; i < face.count; ++i) {
            const double distance = length_squared(face.points[i] - face.points[from]);
            if (distance > maximum) {
                maximum = distance;
                best = i;
            }
        }
        return best;
    };
    const std::size_t a = farthest_from(0), b = farthest_from(a);
    const DVec<3> along = face.points[b] - face.points[a];
    double widest_squared = 0;
    for (std::size_t i = 0; i < face.count; ++i)
        widest_squared = std::max(widest_squared, length_squared(cross(along, face.points[i] - face.points[a])));
    if (square_root(widest_squared) > 1e-6 * length_squared(along)) return;
    Face<3> edge;
    edge.push_back(face.points[a], face.indices[a]);
    if (a != b) edge.push_back(face.points[b], face.indices[b]);
    face = edge;
}

Face<3> any_face_along(const Convex<3>& convex, const DVec<3>& direction) {
    if (convex.inner_radius > 0) return corner(convex, direction);
    switch (convex.core) {
        case Core::box:
            return box_face_along(convex, direction);
        case Core::discs:
            return discs_face_along(convex, direction);
        case Core::function:
            return corner(convex, direction);
        case Core::points:
            break;
    }
    if (convex.facets != nullptr && !convex.facets->normals.empty()) return facet_along(convex, direction);
    if (convex.count == 3) return triangle_along(convex, direction);
    if (convex.count != 2) return corner(convex, direction);
    Face<3> face;
    face.push_back(placed_vertex(convex, 0), 0);
    face.push_back(placed_vertex(convex, 1), 1);
    return face;
}

}  // namespace

Face<2> face_along(const Convex<2>& convex, const DVec<2>& direction) {
    if (convex.inner_radius > 0 || convex.core == Core::function) return corner(convex, direction);
    std::array<Vec<2>, 4> corners;
    const Vec<2>* points = convex.vertices();
    std::uint32_t count = convex.count;
    if (convex.core == Core::box) {
        const Vec<2> half = convex.own[0];
        corners = {Vec<2>(-half.x, -half.y), Vec<2>(half.x, -half.y), half, Vec<2>(-half.x, half.y)};
        points = corners.data();
        count = 4;
    }
    if (count == 1) return corner(convex, direction);
    const auto at = [&](std::uint32_t i) { return convex.place.point(DVec<2>(points[i])); };
    std::uint32_t farthest = 0;
    for (std::uint32_t i = 1; i < count; ++i)
        if (dot(at(i), direction) > dot(at(farthest), direction)) farthest = i;
    const std::uint32_t after = (farthest + 1) % count, before = (farthest + count - 1) % count;
    const Face<2> next = edge_along(at(farthest), farthest, at(after), after, direction);
    if (count == 2) return next;
    const Face<2> last = edge_along(at(before), before, at(farthest), farthest, direction);
    return !next.flat() || dot(last.normal, direction) > dot(next.normal, direction) ? last : next;
}

Face<3> face_along(const Convex<3>& convex, const DVec<3>& direction) {
    Face<3> face = any_face_along(convex, direction);
    thin_to_edge(face);
    return face;
}

template <int D>
void clip(Face<D>& face, const DVec<D>& normal, double offset, std::uint32_t plane_name) {
    const Face<D> before = face;
    face.count = 0;
    const auto height = [&](std::size_t i) { return dot(normal, before.points[i]) - offset; };
    for (std::size_t i = 0; i < before.count; ++i) {
        const double here = height(i);
        if (here <= 0 && face.count < Face<D>::capacity) face.push_back(before.points[i], before.indices[i]);
        const bool closes = i + 1 == before.count;
        if (closes && before.count < 3) break;
        const std::size_t j = closes ? 0 : i + 1;
        const double there = height(j);
        if ((here < 0) == (there < 0) || here == 0 || there == 0 || face.count == Face<D>::capacity) continue;
        const DVec<D> point = before.points[i] + (before.points[j] - before.points[i]) * (here / (here - there));
        // The name of the point outside, and whether the edge comes back from it: one point may end both edges.
        const bool returns = here > 0;
        const std::uint32_t outside = before.indices[returns ? i : j] & 0x7fffu;
        face.push_back(point, (plane_name + 1) << 16 | (returns ? 0x8000u : 0u) | outside);
    }
}

template void clip(Face<2>&, const DVec<2>&, double, std::uint32_t);
template void clip(Face<3>&, const DVec<3>&, double, std::uint32_t);

}  // namespace abut::detail
