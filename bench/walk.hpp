#pragma once

// Walkers, nearest places and ways on hills, and the peers that have such.

#include "bench.hpp"
#include <abut/walk/walk_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abut::bench {

/// Round hills with small bumps: `columns` x `columns` squares of edge 1, two triangles each, y up. Heights are
/// multiples of 1/256, places whole numbers, as Detour keeps them.
struct WalkScene {
    std::uint32_t columns = 0;
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;  ///< 2 * (columns * row + column), and the next
    WalkMesh mesh;
};
using SharedWalkScene = std::shared_ptr<const WalkScene>;
SharedWalkScene walk_scene(std::uint32_t columns);

/// Walkers that go straight on, level, and now and then another way; those that don't get through, at once.
struct WalkSteps {
    SharedWalkScene scene;
    float length = 0;
    std::vector<WalkPoint> starts;
    std::vector<Vec3> headings;       ///< level, of that length
    std::vector<std::uint32_t> ways;  ///< of each walker at first, one of `headings`
};
using SharedWalkSteps = std::shared_ptr<const WalkSteps>;

inline constexpr std::uint32_t frames_a_way = 64;
/// Frames in a row before it is another side's turn, so that each walks in its own caches. Places are compared after
/// the first.
inline constexpr std::uint32_t frames_a_turn = 8;
/// Which way a walker goes next.
inline std::uint32_t next_way(const WalkSteps& steps, std::uint32_t way) {
    return (way + 389) % static_cast<std::uint32_t>(steps.headings.size());
}

/// The side whose walkers advance() frame by frame, tell(values) where they are, and know a lost_share() of their
/// steps; `lost` is what that is called.
template <class Walkers>
Side walking_side(const char* who, const char* lost, std::shared_ptr<Walkers> walkers, std::size_t values_count) {
    return {.who = who,
            .ask =
                [walkers, later = std::vector<double>(values_count)](std::span<double> values) mutable {
                    for (std::uint32_t frame = 0; frame < frames_a_turn; ++frame) {
                        walkers->advance();
                        walkers->tell(frame == 0 ? values : later);
                    }
                },
            .figures =
                [walkers, lost] {
                    Walkers others = *walkers;
                    for (std::uint32_t frame = 0; frame < frames_a_way; ++frame) others.advance();
                    return std::vector<Figure>{{lost, others.lost_share()}};
                }};
}

/// moveAlongSurface: the places seen from above, as it tells no heights; `with_heights` sets them by getPolyHeight, as
/// dtPathCorridor does.
Side detour_steps(const SharedWalkSteps& steps, bool with_heights);

struct WalkPoints {
    SharedWalkScene scene;
    std::vector<Vec3> points;
    float reach = 0;  ///< farther than the farthest of them is away
};
using SharedWalkPoints = std::shared_ptr<const WalkPoints>;

/// Each tells how far away the nearest place of the surface is.
Side detour_nearest(const SharedWalkPoints& points);
Side cgal_nearest(const SharedWalkPoints& points);
Side embree_nearest(const SharedWalkPoints& points);

struct WalkWays {
    SharedWalkScene scene;
    std::vector<WalkPoint> from, to;
};
using SharedWalkWays = std::shared_ptr<const WalkWays>;

/// findPath and findStraightPath: how long the ways are.
Side detour_ways(const SharedWalkWays& ways);
/// The shortest that there are, over any triangles: Surface_mesh_shortest_path.
Side cgal_ways(const SharedWalkWays& ways);

}  // namespace abut::bench
