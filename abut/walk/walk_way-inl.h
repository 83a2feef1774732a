#pragma once

// How a way over a walk mesh goes straight on. For .cpp files.

#include <abut/walk/unfolded_triangle-inl.h>

#include <algorithm>
#include <cstdint>

namespace abut {

/// A way over several triangles: straight on in those that it unfolds, whatever it turns in space. Only
/// the last of them is kept.
struct WalkWay {
    UnfoldedTriangle here;
    double left = 0;         ///< of the step, as the triangle measures lengths: it ends so far ahead of the origin
    std::uint32_t room = 0;  ///< for crossings and slides
    double walked = 0;
    std::uint32_t crossings = 0;
};

enum class WalkStop : std::uint8_t { within, barrier, limit };

/// What is beyond the side that a triangle is left by, unless it may not be crossed.
inline WalkLink way_over(const WalkTriangle* triangles, const WalkOptions& options, const UnfoldedTriangle& here) {
    const WalkLink link = triangles[here.triangle].link[here.side];
    if (!options.allow || link.is_border()) return link;
    const bool allowed = (*options.allow)(WalkSide{here.triangle, here.side}, WalkSide{link.triangle(), link.side()});
    return allowed ? link : WalkLink{};
}

/// Fetches what is beyond each side. By which one the way goes on takes longer to find than to ask for all: where the
/// mesh is larger than the caches, that makes long ways half as dear.
inline void fetch_beyond(const WalkTriangle* triangles, std::uint32_t triangle) {
    for (const WalkLink& link : triangles[triangle].link)
        __builtin_prefetch(&triangles[link.is_border() ? triangle : link.triangle()]);
}

/// From a triangle beyond whose side the step leads, to its end within a triangle, or to a side that stops it.
inline WalkStop go_straight(const WalkTriangle* triangles, const WalkOptions& options, WalkWay& way) {
    // Coordinates grow along the way, and the triangles don't: now and then they begin anew.
    constexpr std::uint32_t most_from_one_origin = 64;
    UnfoldedTriangle here = way.here;
    double left = way.left;
    std::uint32_t count = 0;
    const std::uint32_t most = way.room;
    WalkStop stop = WalkStop::within;
    for (;;) {
        const WalkLink link = way_over(triangles, options, here);
        if (link.is_border()) {
            stop = WalkStop::barrier;
            break;
        }
        if (count == most) {
            stop = WalkStop::limit;
            break;
        }
        const lanes::Both corner = here.apex(triangles[here.triangle]);
        here.enter(link, corner, corner[1] >= 0);
        fetch_beyond(triangles, here.triangle);
        ++count;
        if (!here.is_beyond(left)) break;
        if (count % most_from_one_origin == 0) {
            const double x = std::clamp(here.at(here.crossing())[0], 0.0, left);
            here.move_origin(lanes::Both{x, 0});
            left -= x;
            way.walked += x;
        }
    }
    way.here = here;
    way.left = left;
    way.room -= count;
    way.crossings += count;
    return stop;
}

}  // namespace abut
