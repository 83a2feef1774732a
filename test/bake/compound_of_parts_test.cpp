// The convex parts of a level: no contact has an internal-edge normal at the faces between them.

#include "../../scenes/solid_meshes.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/decompose.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/polyhedron.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

using DoubleOutline = std::vector<DVec<2>>;

DoubleOutline behind(const DoubleOutline& outline, const DVec<2>& normal, double offset) {
    DoubleOutline result;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const DVec<2>&a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double from = dot(normal, a) - offset, to = dot(normal, b) - offset;
        if (from <= 0) result.push_back(a);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) result.push_back(a + (b - a) * (from / (from - to)));
    }
    return result;
}

/// A floor of 10 by 10 around the origin, its top at y = 0, cut into convex parts by random vertical planes.
std::vector<Polyhedron> cut_floor(int cuts, Random& random) {
    std::vector<DoubleOutline> outlines{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}};
    for (int i = 0; i < cuts; ++i) {
        const DVec<2> normal = random.direction<2>();
        const double offset = random.uniform(-3, 3);
        // Every other plane cuts only one part, so that corners of some lie on edges of others (T-junctions).
        const std::size_t first = i % 2 == 0 ? 0 : random.below(static_cast<std::uint32_t>(outlines.size()));
        const std::size_t last = i % 2 == 0 ? outlines.size() : first + 1;
        for (std::size_t part = first; part < last; ++part) {
            DoubleOutline other = behind(outlines[part], -normal, -offset);
            DoubleOutline rest = behind(outlines[part], normal, offset);
            if (other.size() < 3 || rest.size() < 3) continue;
            outlines[part] = std::move(rest);
            outlines.push_back(std::move(other));
        }
    }
    std::vector<Polyhedron> parts;
    for (const DoubleOutline& outline : outlines) {
        std::vector<Vec3> points;
        for (const DVec<2>& p : outline)
            for (const double y : {-1.0, 0.0}) points.push_back(to_float(DVec<3>(p.x, y, p.y)));
        parts.push_back(*Polyhedron::build(points));
    }
    return parts;
}

Compound3 compound_of(const std::vector<Polyhedron>& parts) {
    const std::vector<AnyShape<3>> children(parts.begin(), parts.end());
    return *Compound3::build(children);
}

/// The largest tilt of a normal towards the floor.
double lean(const Vec3& normal) {
    const DVec<3> n(normal);
    return n.y < 0 ? std::sqrt(n.x * n.x + n.z * n.z) : 2;
}

Box3 resting(double x, double z, double depth, Random& random) {
    const Vec3 half(random.uniform_float(0.1, 1), random.uniform_float(0.1, 1), random.uniform_float(0.1, 1));
    const DVec<2> turn = random.direction<2>();
    Box3 box{to_float(DVec<3>(x, static_cast<double>(half.y) - depth, z)), half};
    box.rotation = glm::quat(static_cast<float>(turn.x), 0, static_cast<float>(turn.y), 0);
    return box;
}

/// The number of parts that a box touches.
std::size_t touched(const std::vector<Polyhedron>& parts, const Box3& box) {
    return static_cast<std::size_t>(
        std::count_if(parts.begin(), parts.end(), [&](const Polyhedron& part) { return overlaps(part, box); }));
}

TEST(CompoundOfParts, PushesWhatLiesOnItUpAlone) {
    std::size_t seams = 0;
    double most = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto parts = cut_floor(6, random);
        const Compound3 floor = compound_of(parts);
        for (int i = 0; i < 50; ++i) {
            const Box3 box = resting(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(1e-4, 1e-2), random);
            std::size_t here = 0;
            each_contact(box, floor, [&](const Contact<3>& contact) {
                ++here;
                most = std::max(most, lean(contact.normal));
            });
            seams += touched(parts, box) > 1;
            EXPECT_EQ(here, 1u);
            const auto deepest = contact(box, floor);
            ASSERT_TRUE(deepest);
            most = std::max(most, lean(deepest.normal));
        }
    }
    EXPECT_LE(most, 1e-6);
    EXPECT_GT(seams, 500u);
}

TEST(CompoundOfParts, OfADecomposedMeshPushUpAlone) {
    // A flat top in the shape of a U, 1 thick, its top rotated to y = 0.
    scenes::SolidMesh mesh = scenes::of_cubes({{"######", "######", "##  ##", "##  ##"}});
    for (Vec3& p : mesh.points) p = {p.x, p.z - 1, -p.y};
    const auto parts = decompose(mesh.points, mesh.triangles);
    ASSERT_TRUE(parts);
    EXPECT_GE(parts->size(), 3u);
    const Compound3 ground = compound_of(*parts);
    std::size_t seams = 0;
    double most = 0;
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        // Along the bar, or along a leg and over the corner, all of it over the top.
        const double along = random.uniform(0.6, 3.4), beside = random.uniform(0.6, 1.4);
        Box3 box = resting(i % 2 == 0 ? 1.3 * along : beside, i % 2 == 0 ? -beside : -along, random.uniform(1e-4, 1e-2),
                           random);
        box.half *= Vec3(0.3f, 1, 0.3f);
        std::size_t here = 0;
        each_contact(box, ground, [&](const Contact<3>& contact) {
            ++here;
            most = std::max(most, lean(contact.normal));
        });
        EXPECT_EQ(here, 1u);
        seams += touched(*parts, box) > 1;
    }
    EXPECT_LE(most, 1e-6);
    EXPECT_GT(seams, 100u);
}

TEST(CompoundOfParts, HardlyEverStopsWhatSlidesOnIt) {
    std::size_t stopped = 0, landed = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto parts = cut_floor(6, random);
        const Compound3 floor = compound_of(parts);
        for (int i = 0; i < 50; ++i) {
            const DVec<2> from = random.in_cube<2>() * 3.0, to = random.in_cube<2>() * 3.0;
            const Vec3 along(static_cast<float>(to.x - from.x), 0, static_cast<float>(to.y - from.y));
            stopped += sweep(resting(from.x, from.y, 0, random), along, floor).has_value();
            const Sphere ball{to_float(DVec<3>(from.x, 0.5, from.y)), 0.5f};
            stopped += sweep(ball, along, floor).has_value();
            const auto hit = sweep(Sphere{ball.center + Vec3(0, 1, 0), 0.5f}, along + Vec3(0, -2, 0), floor);
            ASSERT_TRUE(hit);
            landed += hit->normal.y > 0.999999f;
        }
    }
    // A touching shape is within the tolerance, where an answer may go either way: a few in a thousand do.
    EXPECT_LE(stopped, 40u);
    EXPECT_EQ(landed, 2000u);
}

}  // namespace
}  // namespace abut
