// A crowd on each of several surfaces, 1,000,000 steps and more: no walker leaves the mesh or gets stuck. Simple
// walkers fail by: a start exactly on an edge, a weight of exactly 0, `<=` instead of `<`, a reversed triangle, and a
// limit of steps.

#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include "walk_check.hpp"
#include "walk_surfaces.hpp"
#include <abut/math/thread_pool.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::uint64_t walk_many_seed = 20261123;

/// Preferred ends of the steps of some walkers: on edges and corners, again and again.
enum class Habit { anywhere, on_edges, along_edges, through_corners, whole_steps };

struct Walker {
    WalkPoint place;
    Habit habit = Habit::anywhere;
    oracle::Random random{0};
    int stops = 0;  ///< consecutive ones
};

class Crowd {
public:
    Crowd(const WalkMesh& mesh, const Surface& surface, std::uint32_t walkers)
        : mesh_(mesh), edge_(edge_of(surface)), size_(size_of(surface)) {
        oracle::Random random(walk_many_seed);
        const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
        while (walkers_.size() < walkers) {
            const std::uint32_t triangle = random.below(count);
            if (!mesh.is_walkable(triangle)) continue;
            Walker walker;
            walker.habit = static_cast<Habit>(walkers_.size() % 5);
            walker.random = oracle::Random(random.bits());
            walker.place.triangle = triangle;
            walker.place.weights = walkers_.size() % 3 == 0   ? Vec3(1, 0, 0)
                                   : walkers_.size() % 3 == 1 ? Vec3(0.5f, 0, 0.5f)
                                                              : Vec3(0.25f, 0.25f, 0.5f);
            walkers_.push_back(walker);
        }
    }

    void step() {
        for (Walker& walker : walkers_) step(walker);
    }
    std::uint64_t steps() const { return steps_; }
    std::uint64_t lost() const { return lost_; }
    const std::string& first_fault() const { return first_fault_; }

private:
    void step(Walker& walker) {
        ++steps_;
        const WalkPoint before = walker.place;
        const Vec3 step = next_step(walker);
        if (walker.habit == Habit::on_edges && walker.random.chance(0.5)) {
            // Exactly to the edge ahead, and over it the next time.
            const WalkedInTriangle walked = mesh_.walk_in_triangle(before, step * 10.0f);
            walker.place = walked.end;
            check_place(walker, before, "in its triangle");
            return;
        }
        const Walked walked = mesh_.walk(before, step);
        walker.place = walked.place;
        if (!check_place(walker, before, "on its path")) return;
        const double requested = length(DVec<2>(mesh_.to_plane(before.triangle, step)));
        const double length = static_cast<double>(walked.length), lost = static_cast<double>(walked.lost);
        if (walked.met == WalkMet::limit) return fault(walker, before, "is at its limit");
        if (!(std::abs(length + lost - requested) <= 2e-6 * requested + 1e-30))
            return fault(walker, before, "has no length");
        if (walked.met == WalkMet::nothing && lost > 0) return fault(walker, before, "has lost a part of its path");
        if (mesh_.report().border == 0 && walked.met != WalkMet::nothing)
            return fault(walker, before, "has met a border that isn't there");
        if (mesh_.component(before.triangle) != mesh_.component(walker.place.triangle))
            return fault(walker, before, "is on another component");
        // No walker moves farther than its path is long.
        if (abut::detail::length(where(walker.place) - where(before)) > length * (1 + 1e-6) + 1e-6 * size_)
            return fault(walker, before, "has jumped");
        walker.stops = walked.met == WalkMet::corner && length < 1e-3 * requested ? walker.stops + 1 : 0;
        if (walker.stops > 60) return fault(walker, before, "is stuck");
    }

    Vec3 next_step(Walker& walker) {
        const glm::uvec3 t = mesh_.triangles()[walker.place.triangle];
        const auto k = static_cast<glm::length_t>(walker.random.below(3));
        const Vec3 corner = mesh_.points()[t[k]], next = mesh_.points()[t[(k + 1) % 3]];
        const double far = edge_ * walker.random.uniform(0.01, 3);
        const DVec<3> direction = walker.random.direction<3>();
        switch (walker.habit) {
            case Habit::along_edges:
                return next - corner;
            case Habit::through_corners:
                return (corner - mesh_.to_world(walker.place)) * 2.0f;
            case Habit::whole_steps: {
                Vec3 step(0);
                step[k] = walker.random.chance(0.5) ? 0.5f : -0.5f;
                return step;
            }
            default:
                return to_float(direction * far);
        }
    }

    DVec<3> where(const WalkPoint& place) const {
        DVec<3> result(0.0);
        for (int k = 0; k < 3; ++k)
            result +=
                DVec<3>(mesh_.points()[mesh_.triangles()[place.triangle][k]]) * static_cast<double>(place.weights[k]);
        return result;
    }
    bool check_place(const Walker& walker, const WalkPoint& before, const char* where) {
        if (walker.place.triangle < mesh_.triangles().size() && mesh_.is_walkable(walker.place.triangle) &&
            are_valid_weights(walker.place.weights))
            return true;
        fault(walker, before, where);
        return false;
    }
    void fault(const Walker& walker, const WalkPoint& before, const std::string& what) {
        if (lost_++ == 0)
            first_fault_ = "a walker from " + test::text(before) + " at " + test::text(walker.place) + " " + what;
    }

    const WalkMesh& mesh_;
    double edge_, size_;
    std::vector<Walker> walkers_;
    std::uint64_t steps_ = 0, lost_ = 0;
    std::string first_fault_;
};

TEST(WalkMany, NobodyIsLost) {
    std::uint64_t steps = 0;
    const std::vector<NamedSurface> all = surfaces(walk_many_seed);
    for (const NamedSurface& named : all) {
        const WalkMesh mesh = *WalkMesh::build(named.surface.points, named.surface.triangles);
        Crowd crowd(mesh, named.surface, 400);
        for (int i = 0; i < (oracle::is_long() ? 500 : 140); ++i) crowd.step();
        EXPECT_EQ(crowd.lost(), 0u) << named.name << ", walk_many_seed " << walk_many_seed << ": "
                                    << crowd.first_fault();
        steps += crowd.steps();
    }
    std::cout << steps << " steps on " << all.size() << " surfaces\n";
}

TEST(WalkMany, NobodyIsLostAtAnyScaleAndFarFromTheOrigin) {
    for (const double scale : {1e-3, 30.0, 1e4})
        for (const NamedSurface& named : surfaces(walk_many_seed)) {
            Surface surface = named.surface;
            for (Vec3& point : surface.points) point = to_float(DVec<3>(point) * scale + DVec<3>(100, -50, 20) * scale);
            const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
            ASSERT_TRUE(mesh);
            Crowd crowd(*mesh, surface, 200);
            for (int i = 0; i < (oracle::is_long() ? 200 : 10); ++i) crowd.step();
            EXPECT_EQ(crowd.lost(), 0u) << named.name << " at " << scale << ", walk_many_seed " << walk_many_seed
                                        << ": " << crowd.first_fault();
        }
}

TEST(WalkMany, ManyThreadsWalkAtOnce) {
    const NamedSurface named = surfaces(walk_many_seed)[6];
    const WalkMesh mesh = *WalkMesh::build(named.surface.points, named.surface.triangles);
    constexpr std::uint32_t count = 512;
    const auto walk = [&](std::uint32_t i) {
        oracle::Random random(walk_many_seed + i);
        WalkPoint place{i % static_cast<std::uint32_t>(mesh.triangles().size()), {0.25f, 0.25f, 0.5f}};
        for (int step = 0; step < 20; ++step) place = mesh.walk(place, to_float(random.direction<3>() * 0.5)).place;
        return place;
    };
    std::vector<WalkPoint> alone, together(count);
    for (std::uint32_t i = 0; i < count; ++i) alone.push_back(walk(i));
    ThreadPool(8).run(count, [&](std::uint32_t i) { together[i] = walk(i); });
    EXPECT_EQ(alone, together);
}

}  // namespace
}  // namespace abut::test
