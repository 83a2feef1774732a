// Neighbouring faces are merged until no two can be.
#include "point_sets.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

/// A loop of corners, and twice its vector area.
struct Face {
    std::vector<DVec<3>> corners;
    DVec<3> area{0.0};
};

std::vector<Face> faces_of(const Hull3& hull) {
    const Facets facets{hull.normals, hull.loops, hull.loop_ends, hull.edges};
    std::vector<Face> result;
    for (std::size_t i = 0; i < hull.normals.size(); ++i) {
        Face& face = result.emplace_back();
        for (const std::uint32_t corner : facets.loop(i)) face.corners.emplace_back(hull.points[corner]);
        for (std::size_t j = 1; j + 1 < face.corners.size(); ++j)
            face.area += cross(face.corners[j] - face.corners[0], face.corners[j + 1] - face.corners[0]);
    }
    return result;
}

/// The corners of two faces as one loop, from their common edge on: those of `left`, which has the edge from `from` to
/// `to`, then those of `right`.
std::vector<DVec<3>> joined(const Face& left, const Face& right, const DVec<3>& from, const DVec<3>& to) {
    std::vector<DVec<3>> result;
    const auto add = [&](const Face& face, const DVec<3>& first, const DVec<3>& last) {
        const std::size_t count = face.corners.size();
        for (std::size_t i = static_cast<std::size_t>(std::find(face.corners.begin(), face.corners.end(), first) -
                                                      face.corners.begin());
             face.corners[i % count] != last; ++i)
            result.push_back(face.corners[i % count]);
    };
    add(left, to, from);
    add(right, from, to);
    return result;
}

/// Whether two faces are coplanar to within the rounding to the grid.
bool clearly_joinable(const Face& left, const Face& right, const DVec<3>& from, const DVec<3>& to, double extent) {
    if (dot(left.area, right.area) < 0.72 * length(left.area) * length(right.area)) return false;
    const DVec<3> normal = normalized(left.area + right.area);
    const std::vector<DVec<3>> loop = joined(left, right, from, to);
    double low = 0, high = 0;
    std::set<std::tuple<double, double, double>> different;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const DVec<3>&a = loop[i], &b = loop[(i + 1) % loop.size()], &c = loop[(i + 2) % loop.size()];
        different.emplace(a.x, a.y, a.z);
        low = std::min(low, dot(normal, a - from));
        high = std::max(high, dot(normal, a - from));
        if ((b == from || b == to) && dot(cross(b - a, c - b), normal) < -0.5 * hull_tolerance * extent * length(c - a))
            return false;
    }
    return different.size() == loop.size() && high - low < 0.98 * hull_flatness * extent;
}

TEST(HullFaces, AreJoinedWhereTheyCanBe) {
    int joined_faces = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed)
        for (std::size_t kind = 0; kind <= kinds.size(); ++kind) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", kind " + std::to_string(kind));
            Random random(seed);
            const auto thin_lens = [&] {
                const std::vector<Vec3> sphere = on_a_sphere(random, 2000);
                return stretched(sphere, {1, 1, static_cast<float>(random.power_of_two(-20, 0))});
            };
            const std::vector<Vec3> points = kind < kinds.size() ? kinds[kind].make(random) : thin_lens();
            const Hull3 hull = *abut::detail::hull(points);
            if (hull.rank < 3) continue;
            const double extent = abut::detail::extent<3>(points);
            const std::vector<Face> faces = faces_of(hull);
            for (const Face& face : faces) joined_faces += face.corners.size() > 3 ? 1 : 0;
            for (const FacetEdge& edge : hull.edges)
                ASSERT_FALSE(clearly_joinable(faces[edge.left], faces[edge.right], DVec<3>(hull.points[edge.from]),
                                              DVec<3>(hull.points[edge.to]), extent));
        }
    EXPECT_GT(joined_faces, 1000);
}

}  // namespace
}  // namespace abut::test
