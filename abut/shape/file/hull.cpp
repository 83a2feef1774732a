#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>
#include <abut/shape/file/hull.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

template <int D>
bool is_less(const Vec<D>& a, const Vec<D>& b) {
    for (int i = 0; i < D; ++i)
        if (a[i] != b[i]) return a[i] < b[i];
    return false;
}

template <int D>
bool are_finite(std::span<const Vec<D>> points) {
    return std::all_of(points.begin(), points.end(), [](const Vec<D>& p) { return is_finite<D>(p); });
}

/// Loops of three or more different corners, each of them from its lowest. Every corner is in some loop.
bool are_loops(std::size_t corners, const Facets& facets) {
    std::vector<std::uint32_t> last_face(corners, 0);  // the last face that has the corner, plus one
    std::size_t begin = 0;
    for (std::uint32_t face = 0; face < facets.loop_ends.size(); ++face) {
        const std::size_t end = facets.loop_ends[face];
        if (end > facets.loops.size() || end < begin + 3) return false;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t corner = facets.loops[i];
            if (corner >= corners || corner < facets.loops[begin] || last_face[corner] == face + 1) return false;
            last_face[corner] = face + 1;
        }
        begin = end;
    }
    return begin == facets.loops.size() &&
           std::all_of(last_face.begin(), last_face.end(), [](std::uint32_t face) { return face > 0; });
}

/// Calls visit(from, to, face, i) for the sides of the loops, where i is the place of `from` in the loops; it returns
/// false to stop.
template <class Visit>
bool each_side(const Facets& facets, Visit visit) {
    std::size_t begin = 0;
    for (std::uint32_t face = 0; face < facets.loop_ends.size(); ++face) {
        const std::size_t end = facets.loop_ends[face];
        for (std::size_t i = begin; i < end; ++i)
            if (!visit(facets.loops[i], facets.loops[i + 1 == end ? begin : i + 1], face, i)) return false;
        begin = end;
    }
    return true;
}

const FacetEdge* edge_of(const Facets& facets, std::uint32_t from, std::uint32_t to) {
    const auto ends = std::pair(std::min(from, to), std::max(from, to));
    const auto edge =
        std::lower_bound(facets.edges.begin(), facets.edges.end(), ends,
                         [](const FacetEdge& e, const auto& wanted) { return std::pair(e.from, e.to) < wanted; });
    return edge != facets.edges.end() && std::pair(edge->from, edge->to) == ends ? &*edge : nullptr;
}

/// The edges are those of the loops, each once: every side is one side of its edge, no loop comes to it twice, and
/// there are twice as many.
bool are_edges(const Facets& facets) {
    if (2 * facets.edges.size() != facets.loops.size()) return false;
    for (std::size_t i = 0; i < facets.edges.size(); ++i) {
        const FacetEdge& edge = facets.edges[i];
        if (edge.from >= edge.to || edge.left == edge.right) return false;
        if (i > 0 && std::pair(facets.edges[i - 1].from, facets.edges[i - 1].to) >= std::pair(edge.from, edge.to))
            return false;
    }
    return each_side(facets, [&](std::uint32_t from, std::uint32_t to, std::uint32_t face, std::size_t) {
        const FacetEdge* edge = edge_of(facets, from, to);
        return edge != nullptr && (from < to ? edge->left : edge->right) == face;
    });
}

bool are_planes(const Facets& facets) {
    for (const Vec3& normal : facets.normals)
        if (!is_finite<3>(normal) || !(std::abs(length_squared(DVec<3>(normal)) - 1) < 1e-5)) return false;
    return std::all_of(facets.offsets.begin(), facets.offsets.end(), [](double o) { return std::isfinite(o); });
}

/// The corners of a face, and those beside its edges in the faces around it, are not in front of its plane, and its own
/// not far behind. That makes a surface without holes convex.
bool is_convex(std::span<const Vec3> corners, const Facets& facets) {
    const auto [low, high] = min_max<3>(corners);
    const double extent = largest(high - low);
    const double tolerance = 4 * hull_flatness * extent;
    const auto height = [&](std::uint32_t face, std::uint32_t corner) {
        return dot(DVec<3>(facets.normals[face]), DVec<3>(corners[corner])) - facets.offsets[face];
    };
    return each_side(facets, [&](std::uint32_t from, std::uint32_t to, std::uint32_t face, std::size_t i) {
        if (!(std::abs(height(face, from)) <= tolerance)) return false;
        const FacetEdge& edge = *edge_of(facets, from, to);
        const std::uint32_t other = from < to ? edge.right : edge.left;
        const std::size_t begin = face == 0 ? 0 : facets.loop_ends[face - 1], end = facets.loop_ends[face];
        const std::uint32_t before = facets.loops[i == begin ? end - 1 : i - 1];
        return height(other, before) <= tolerance;
    });
}

}  // namespace

const char* fault_of_outline(std::span<const Vec2> corners) {
    if (corners.empty()) return "has no corners";
    if (!are_finite<2>(corners)) return "has a corner that is not finite";
    const std::size_t count = corners.size();
    for (std::size_t i = 1; i < count; ++i)
        if (!is_less<2>(corners[0], corners[i])) return "has corners out of order";
    if (count < 3) return nullptr;
    // Twice around, the direction would turn more often from right to left.
    std::size_t turns = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 &before = corners[i == 0 ? count - 1 : i - 1], &at = corners[i],
                   &after = corners[i + 1 == count ? 0 : i + 1];
        if (orientation(before, at, after) <= 0) return "is not convex";
        turns += is_less<2>(before, at) != is_less<2>(at, after) ? 1 : 0;
    }
    return turns == 2 ? nullptr : "is not convex";
}

int rank_of_hull(std::size_t corners, std::size_t faces) {
    if (corners <= 2) return static_cast<int>(corners) - 1;
    return faces == 2 ? 2 : 3;
}

const char* fault_of_hull(std::span<const Vec3> corners, const Facets& facets) {
    const std::size_t count = corners.size(), faces = facets.loop_ends.size();
    if (count == 0) return "has no corners";
    if (!are_finite<3>(corners)) return "has a corner that is not finite";
    for (std::size_t i = 1; i < count; ++i)
        if (!is_less<3>(corners[i - 1], corners[i])) return "has corners out of order";
    if (facets.normals.size() != faces || facets.offsets.size() != faces) return "has faces without planes";
    if (count <= 2) return faces == 0 && facets.loops.empty() && facets.edges.empty() ? nullptr : "has too few corners";
    if (!are_loops(count, facets)) return "has faces that are no loops of its corners";
    if (!are_edges(facets)) return "has edges that are not those of its faces";
    if (count + faces != facets.edges.size() + 2) return "is not in one piece";
    if (!are_planes(facets)) return "has a plane that is none";
    return is_convex(corners, facets) ? nullptr : "is not convex";
}

}  // namespace abut::detail
