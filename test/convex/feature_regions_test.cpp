// Closest features by Voronoi regions: a point out from a vertex, an edge or a face, along its normals, is closest to
// it.

#include "../oracle/random.hpp"
#include <abut/convex/features.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/view/view.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

double some_height(Random& random, double size) {
    return size * random.power_of_two(-18, 4);
}

template <int D>
void expect_region(const Convex<D>& core, FeatureKind kind, std::uint32_t index, const DVec<D>& on,
                   const DVec<D>& direction, double height, double size) {
    const auto found = closest_feature(core, on + direction * height);
    EXPECT_EQ(found.kind, kind) << "at height " << height << " of " << size;
    EXPECT_EQ(found.index, index);
    EXPECT_LT(length(found.point - on), 1e-9 * (size + height));
    EXPECT_NEAR(found.distance, height, 1e-9 * (size + height));
    EXPECT_LT(length(found.normal - direction), 1e-8 * (size + height) / height);
}

template <int D>
Affine<D> some_place(Random& random) {
    const Pose<D> pose{to_float(random.in_cube<D>() * 100.0), random.rotation<D>()};
    Vec<D> scale(random.uniform_float(0.5, 2));
    if (random.chance(0.5))
        for (int i = 0; i < D; ++i) scale[i] = random.uniform_float(0.3, 3) * (random.chance(0.5) ? 1.0f : -1.0f);
    return affine(pose) * scaling(scale);
}

TEST(FeatureRegions, OfPolygons) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        std::vector<Vec2> points;
        for (int i = 0; i < 12; ++i) points.push_back(to_float(random.in_cube<2>()));
        const Polygon polygon = *Polygon::build(points);
        const Convex<2> core = mapped(convex(polygon), some_place<2>(random));
        const auto count = static_cast<std::uint32_t>(polygon.points().size());
        const auto corner = [&](std::uint32_t i) { return core.place.point(DVec<2>(polygon.points()[i % count])); };
        const double turn = cross(core.place.column[0], core.place.column[1]) < 0 ? -1 : 1;
        const auto normal = [&](std::uint32_t i) {
            const DVec<2> along = (corner(i + 1) - corner(i)) * turn;
            return normalized(DVec<2>(along.y, -along.x));
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            const double t = random.uniform(0.05, 0.95);
            expect_region<2>(core, FeatureKind::edge, edge_index(i, (i + 1) % count),
                             corner(i) * (1 - t) + corner(i + 1) * t, normal(i), some_height(random, 1), 1);
            const DVec<2> between = normalized(normal(i) * (1 - t) + normal(i + 1) * t);
            if (dot(normal(i), normal(i + 1)) > 1 - 1e-6) continue;
            expect_region<2>(core, FeatureKind::vertex, (i + 1) % count, corner(i + 1), between, some_height(random, 1),
                             1);
        }
    }
}

/// A placed hull of a few points, with the neighbours of each of its features.
class RandomHull {
public:
    explicit RandomHull(Random& random) {
        std::vector<Vec3> points;
        for (int i = 0; i < 12; ++i) points.push_back(to_float(random.in_cube<3>()));
        hull_ = *Polyhedron::build(points);
        core_ = mapped(convex(hull_), some_place<3>(random));
    }

    const Convex<3>& core() const { return core_; }
    const Facets& facets() const { return hull_.facets(); }
    std::uint32_t face_count() const { return static_cast<std::uint32_t>(facets().normals.size()); }
    std::uint32_t corner_count() const { return core_.count; }
    DVec<3> corner(std::uint32_t i) const { return core_.place.point(DVec<3>(hull_.points()[i])); }
    DVec<3> normal(std::uint32_t face) const {
        const auto loop = facets().loop(face);
        const DVec<3> a(hull_.points()[loop[0]]), b(hull_.points()[loop[1]]), c(hull_.points()[loop[2]]);
        return normalized(mapped_normal(core_.place, cross(b - a, c - a)));
    }
    DVec<3> within_face(std::uint32_t face, Random& random) const {
        DVec<3> sum(0.0);
        double whole = 0;
        for (const std::uint32_t i : facets().loop(face)) {
            const double weight = random.uniform(0.1, 1);
            sum += corner(i) * weight;
            whole += weight;
        }
        return sum / whole;
    }
    DVec<3> out_of_corner(std::uint32_t i, Random& random) const {
        DVec<3> sum(0.0);
        for (std::uint32_t face = 0; face < face_count(); ++face)
            for (const std::uint32_t j : facets().loop(face))
                if (i == j) sum += normal(face) * random.uniform(0.1, 1);
        return normalized(sum);
    }

private:
    Polyhedron hull_;
    Convex<3> core_;
};

TEST(FeatureRegions, OfPolyhedra) {
    int edges = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const RandomHull hull(random);
        for (std::uint32_t i = 0; i < hull.face_count(); ++i)
            expect_region<3>(hull.core(), FeatureKind::face, i, hull.within_face(i, random), hull.normal(i),
                             some_height(random, 1), 1);
        for (std::uint32_t i = 0; i < hull.corner_count(); ++i)
            expect_region<3>(hull.core(), FeatureKind::vertex, i, hull.corner(i), hull.out_of_corner(i, random),
                             some_height(random, 1), 1);
        for (const FacetEdge& e : hull.facets().edges) {
            const DVec<3> left = hull.normal(e.left), right = hull.normal(e.right);
            if (dot(left, right) > 1 - 1e-6) continue;
            ++edges;
            const double s = random.uniform(0.05, 0.95), t = random.uniform(0.05, 0.95);
            expect_region<3>(hull.core(), FeatureKind::edge, edge_index(e.from, e.to),
                             hull.corner(e.from) * (1 - s) + hull.corner(e.to) * s,
                             normalized(left * (1 - t) + right * t), some_height(random, 1), 1);
        }
    }
    EXPECT_GT(edges, 2000);
}

TEST(FeatureRegions, InsideOfPolyhedraToo) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const RandomHull hull(random);
        for (std::uint32_t i = 0; i < hull.face_count(); ++i) {
            const DVec<3> on = hull.within_face(i, random), normal = hull.normal(i);
            double max_depth = 1;  // the depth at which another face is as near
            for (std::uint32_t j = 0; j < hull.face_count(); ++j) {
                if (i == j) continue;
                const DVec<3> other = hull.normal(j);
                const double behind = dot(other, hull.corner(hull.facets().loop(j)[0]) - on);
                max_depth = std::min(max_depth, behind / (1 - dot(other, normal)));
            }
            const double depth = max_depth * random.uniform(0.01, 0.9);
            const auto found = closest_feature(hull.core(), on - normal * depth);
            EXPECT_EQ(found.kind, FeatureKind::face);
            EXPECT_EQ(found.index, i) << depth;
            EXPECT_NEAR(found.distance, -depth, 1e-12);
            EXPECT_LT(length(found.point - on), 1e-9);
        }
    }
}

}  // namespace
}  // namespace abut
