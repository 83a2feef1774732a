#pragma once

// Tracing of geodesics over a walk mesh. For .cpp files.

#include <abut/math/simd/compiler-inl.h>
#include <abut/walk/unfolded_triangle-inl.h>

#include <algorithm>
#include <cstdint>

namespace abut::detail {

/// A geodesic over several triangles: straight in the unfolded plane. Only the last triangle is stored.
struct WalkGeodesic {
    UnfoldedTriangle here;
    double remaining = 0;              ///< remaining length of the step, in the units of the unfolded triangle
    std::uint32_t crossings_left = 0;  ///< for crossings and slides
    double walked = 0;
    std::uint32_t crossings = 0;
};

enum class WalkStop : std::uint8_t { within, barrier, limit };

/// The neighbour across the side by which a triangle is left, unless it must not be crossed.
inline WalkLink link_across(const WalkTriangle* triangles, const WalkOptions& options, const UnfoldedTriangle& here) {
    const WalkLink link = triangles[here.triangle].link[here.side];
    if (!options.allow || link.is_border()) return link;
    const bool allowed = (*options.allow)(WalkSide{here.triangle, here.side}, WalkSide{link.triangle(), link.side()});
    return allowed ? link : WalkLink{};
}

/// Prefetches all neighbours, before it is known which one is next. On meshes larger than the caches this halves the
/// time of long walks.
inline void prefetch_neighbours(const WalkTriangle* triangles, std::uint32_t triangle) {
    for (const WalkLink& link : triangles[triangle].link)
        prefetch(&triangles[link.is_border() ? triangle : link.triangle()]);
}

/// Traces the geodesic from its current triangle until the step ends within one, or a side stops it.
inline WalkStop trace_geodesic(const WalkTriangle* triangles, const WalkOptions& options, WalkGeodesic& geodesic) {
    // Coordinates grow along the geodesic and the triangles don't, so the origin is moved from time to time.
    constexpr std::uint32_t max_from_one_origin = 64;
    UnfoldedTriangle here = geodesic.here;
    double remaining = geodesic.remaining;
    std::uint32_t count = 0;
    const std::uint32_t max_crossings = geodesic.crossings_left;
    WalkStop stop = WalkStop::within;
    for (;;) {
        const WalkLink link = link_across(triangles, options, here);
        if (link.is_border()) {
            stop = WalkStop::barrier;
            break;
        }
        if (count == max_crossings) {
            stop = WalkStop::limit;
            break;
        }
        const lanes::Double2 corner = here.apex(triangles[here.triangle]);
        here.enter(link, corner, corner[1] >= 0);
        prefetch_neighbours(triangles, here.triangle);
        ++count;
        if (!here.is_beyond(remaining)) break;
        if (count % max_from_one_origin == 0) {
            const double x = std::clamp(here.at(here.crossing())[0], 0.0, remaining);
            here.move_origin(lanes::Double2{x, 0});
            remaining -= x;
            geodesic.walked += x;
        }
    }
    geodesic.here = here;
    geodesic.remaining = remaining;
    geodesic.crossings_left -= count;
    geodesic.crossings += count;
    return stop;
}

}  // namespace abut::detail
