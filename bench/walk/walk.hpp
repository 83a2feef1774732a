#pragma once

// Walkers, closest points and paths on hills, and the peers that have them.

#include "../bench.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abut::bench {

/// Smooth hills with small bumps: `columns` x `columns` squares of edge 1, two triangles each, y up. Heights are
/// multiples of 1/256 and coordinates integers, as Detour stores them.
struct WalkScene {
    std::uint32_t columns = 0;
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;  ///< 2 * (columns * row + column), and the next
    WalkMesh mesh;
};
using SharedWalkScene = std::shared_ptr<const WalkScene>;
SharedWalkScene walk_scene(std::uint32_t columns);

/// Walkers that go straight at a constant speed and change their direction from time to time; blocked ones do so at
/// once.
struct WalkSteps {
    SharedWalkScene scene;
    float length = 0;
    std::vector<WalkPoint> starts;
    std::vector<Vec3> headings;                   ///< horizontal, of that length
    std::vector<std::uint32_t> initial_headings;  ///< initial index in `headings`, per walker
};
using SharedWalkSteps = std::shared_ptr<const WalkSteps>;

inline constexpr std::uint32_t frames_per_heading = 64;
/// Consecutive frames per side, so that each side runs with warm caches. Positions are compared after the first.
inline constexpr std::uint32_t frames_per_call = 8;
/// The next heading of a walker.
inline std::uint32_t next_heading(const WalkSteps& steps, std::uint32_t heading) {
    return (heading + 389) % static_cast<std::uint32_t>(steps.headings.size());
}

/// A side with walkers: advance() moves them by a frame, write(values) writes their positions, and lost_share() is the
/// fraction of lost steps, named `lost`.
template <class Walkers>
Side walking_side(const char* who, const char* lost, std::shared_ptr<Walkers> walkers, std::size_t values_count) {
    return {.who = who,
            .run =
                [walkers, later = std::vector<double>(values_count)](std::span<double> values) mutable {
                    for (std::uint32_t frame = 0; frame < frames_per_call; ++frame) {
                        walkers->advance();
                        walkers->write(frame == 0 ? values : later);
                    }
                },
            .figures =
                [walkers, lost] {
                    Walkers others = *walkers;
                    for (std::uint32_t frame = 0; frame < frames_per_heading; ++frame) others.advance();
                    return std::vector<Figure>{{lost, others.lost_share()}};
                }};
}

/// moveAlongSurface: horizontal positions only, as it has no heights; `with_heights` sets heights by getPolyHeight, as
/// dtPathCorridor does.
Side detour_steps(const SharedWalkSteps& steps, bool with_heights);

struct WalkPoints {
    SharedWalkScene scene;
    std::vector<Vec3> points;
    float reach = 0;  ///< above the maximum distance of any point
};
using SharedWalkPoints = std::shared_ptr<const WalkPoints>;

/// Each writes the distance of the closest surface point.
Side detour_nearest(const SharedWalkPoints& points);
Side cgal_nearest(const SharedWalkPoints& points);
Side embree_nearest(const SharedWalkPoints& points);

struct WalkPaths {
    SharedWalkScene scene;
    std::vector<WalkPoint> from, to;
};
using SharedWalkPaths = std::shared_ptr<const WalkPaths>;

/// findPath and findStraightPath: the lengths of paths.
Side detour_paths(const SharedWalkPaths& paths);
/// Exact shortest paths over any triangles: Surface_mesh_shortest_path.
Side cgal_paths(const SharedWalkPaths& paths);

}  // namespace abut::bench
