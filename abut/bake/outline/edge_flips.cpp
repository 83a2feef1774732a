// Flips of edges to the shorter diagonal. Delaunay flips would maximise the smallest angle; short edges are enough
// here, and need no exact circle test.

#include <abut/bake/outline/triangulate.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

namespace abut::outline {

using namespace detail;

namespace {

std::uint32_t next(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

std::uint32_t before(std::uint32_t half_edge) {
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

}  // namespace

void shorten_edges(Triangulation& triangles) {
    std::vector<std::uint32_t>&origins = triangles.origins, &twins = triangles.twins;
    const auto length_squared_between = [&](std::uint32_t a, std::uint32_t b) {
        return length_squared(DVec<2>(triangles.points[b]) - DVec<2>(triangles.points[a]));
    };
    const auto turns_left = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return orientation(triangles.points[a], triangles.points[b], triangles.points[c]) > 0;
    };
    const auto set_twins = [&](std::uint32_t half_edge, std::uint32_t twin) {
        twins[half_edge] = twin;
        if (twin != no_index) twins[twin] = half_edge;
    };

    std::vector<std::uint32_t> queue;
    std::vector<bool> is_queued(origins.size(), false);
    const auto push = [&](std::uint32_t half_edge) {
        if (twins[half_edge] == no_index || is_queued[half_edge]) return;
        is_queued[half_edge] = true;
        queue.push_back(half_edge);
    };
    for (std::uint32_t i = 0; i < origins.size(); ++i)
        if (twins[i] != no_index && i < twins[i]) push(i);
    // The loop ends because the lengths only decrease; the bound limits the time for extreme outlines.
    for (std::size_t flips = 0; !queue.empty() && flips < 8 * origins.size();) {
        const std::uint32_t edge = queue.back();
        queue.pop_back();
        is_queued[edge] = false;
        if (twins[edge] == no_index) continue;
        const std::uint32_t twin = twins[edge];
        const std::uint32_t a = origins[edge], b = origins[twin];
        const std::uint32_t left = origins[before(edge)], right = origins[before(twin)];
        if (!(length_squared_between(left, right) < length_squared_between(a, b))) continue;
        if (!turns_left(a, right, left) || !turns_left(b, left, right)) continue;
        ++flips;
        // The triangles (a b left) and (b a right) become (right left a) and (left right b).
        const std::uint32_t after = next(edge), last = before(edge), twin_after = next(twin), twin_last = before(twin);
        const std::uint32_t beyond_after = twins[after], beyond_last = twins[last];
        const std::uint32_t beyond_twin_after = twins[twin_after], beyond_twin_last = twins[twin_last];
        origins[edge] = right;
        origins[after] = left;
        origins[last] = a;
        origins[twin] = left;
        origins[twin_after] = right;
        origins[twin_last] = b;
        set_twins(after, beyond_last);
        set_twins(last, beyond_twin_after);
        set_twins(twin_after, beyond_twin_last);
        set_twins(twin_last, beyond_after);
        for (const std::uint32_t around : {after, last, twin_after, twin_last}) push(around);
    }
}

}  // namespace abut::outline
