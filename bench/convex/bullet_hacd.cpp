#include "bullet_hacd.hpp"

#include <hacdHACD.h>

namespace abut::bench {

std::vector<std::vector<Vec3>> hacd_parts(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                          std::size_t clusters, std::size_t corners) {
    using Point = HACD::Vec3<HACD::Real>;
    std::vector<Point> their_points;
    their_points.reserve(points.size());
    for (const Vec3& p : points) their_points.emplace_back(p.x, p.y, p.z);
    std::vector<HACD::Vec3<long>> their_triangles;
    their_triangles.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) their_triangles.emplace_back(t.x, t.y, t.z);

    // The settings of its own test program, except that the concavity bound is disabled: the number of parts decides.
    HACD::HACD hacd;
    hacd.SetPoints(their_points.data());
    hacd.SetNPoints(their_points.size());
    hacd.SetTriangles(their_triangles.data());
    hacd.SetNTriangles(their_triangles.size());
    hacd.SetCompacityWeight(0.1);
    hacd.SetVolumeWeight(0);
    hacd.SetNClusters(clusters);
    hacd.SetNVerticesPerCH(corners);
    hacd.SetConcavity(100);
    hacd.SetAddExtraDistPoints(false);
    hacd.SetAddNeighboursDistPoints(false);
    hacd.SetAddFacesPoints(false);
    hacd.Compute();

    std::vector<std::vector<Vec3>> result(hacd.GetNClusters());
    for (std::size_t part = 0; part < result.size(); ++part) {
        std::vector<Point> hull(hacd.GetNPointsCH(part));
        std::vector<HACD::Vec3<long>> faces(hacd.GetNTrianglesCH(part));
        hacd.GetCH(part, hull.data(), faces.data());
        for (const Point& p : hull)
            result[part].emplace_back(static_cast<float>(p.X()), static_cast<float>(p.Y()), static_cast<float>(p.Z()));
    }
    return result;
}

}  // namespace abut::bench
