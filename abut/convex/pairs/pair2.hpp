#pragma once

// Pairs of plain shapes in the plane: circles, capsules, segments, triangles, boxes and polygons of few edges, each
// against each. One closed form serves a pair of shapes without rows, another any pair. They return what
// `signed_distance` and `manifold` return, or `unknown`. For .cpp files.

#include <abut/convex/face.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/pairs/core_pair2.hpp>

namespace abut::detail {

/// Up to two contact points, one in each lane, midway between the two surfaces along the normal.
struct ContactLanes {
    Double2 x, y, depth;
    std::uint32_t features[2];
    std::uint32_t mask = 0;  ///< bits: the points that exist
};

/// The limits of the points of a contact.
struct ContactRange {
    double depth, margin, tolerance;
};

/// Clips the facing edge of `incident` at both ends of that of `reference`, and finds the points that are near enough.
/// It has no branches, as clipping is unpredictable. `out` is the contact normal out of the reference, in its frame,
/// and `per_slope` the inverse of its part along the edge's normal.
template <class Core>
[[gnu::always_inline]] inline void clip_edges(const Core& reference, const Core& incident, const LanePose& seen,
                                              std::uint32_t side, std::uint32_t facing, Double2 out, double per_slope,
                                              const ContactRange& range, ContactLanes& points) {
    using namespace lanes;
    const Double2 own_x = incident.ends_x(facing), own_y = incident.ends_y(facing);
    Double2 x = (seen.cos * own_x - first(seen.sin) * own_y) + first(seen.position);
    Double2 y = (first(seen.sin) * own_x + seen.cos * own_y) + second(seen.position);
    // Counter-clockwise, the reference edge runs to the left of the normal.
    const Double2 normal = reference.normal(side), out_x = first(out), out_y = second(out);
    const Double2 ends = out_x * reference.ends_y(side) - out_y * reference.ends_x(side);
    const Double2 from = first(ends), to = second(ends), at = out_x * y - out_y * x;
    const Double2 clamped = lesser(greater(at, from), to);
    const std::uint32_t below = bits(at < from), above = bits(at > to);
    const double run = at[1] - at[0], per_run = run != 0 ? 1 / run : 0;
    const Double2 part = (clamped - at) * double2(per_run);
    x += double2(x[1] - x[0]) * part;
    y += double2(y[1] - y[0]) * part;

    const Double2 gaps =
        (first(normal) * x + second(normal) * y - double2(reference.offset(side))) * double2(per_slope);
    points.depth = lesser(double2(reference.radius() + incident.radius()) - gaps, double2(range.depth));
    const Double2 back = double2(incident.radius()) - points.depth * Double2{0.5, 0.5};
    x -= out_x * back;
    y -= out_y * back;
    const LanePose& place = reference.place();
    points.x = (place.cos * x - first(place.sin) * y) + first(place.position);
    points.y = (first(place.sin) * x + place.cos * y) + second(place.position);

    const std::uint32_t start = reference.contact_number(side) + 1,
                        end = reference.contact_number(reference.after(side)) + 1;
    points.features[0] = incident.contact_number(facing);
    points.features[1] = incident.contact_number(incident.after(facing));
    for (std::uint32_t i = 0; i < 2; ++i)
        points.features[i] |= (start * (below >> i & 1u) | end * (above >> i & 1u)) << 16;
    points.mask = bits(points.depth >= double2(-range.margin - range.tolerance));
    if (below == 3 || above == 3) points.mask = 0;
    // If only an end of the edge remains, it is one point: the end itself, if it wasn't clipped.
    if (std::abs(clamped[1] - clamped[0]) <= range.tolerance) points.mask &= points.features[1] < 1u << 16 ? 2u : 1u;
}

/// Adds a point that is deeper than all. Of three it leaves itself, and the one farthest from it.
[[gnu::noinline]] inline void add_deepest(Double2 position, double depth, std::uint32_t feature, ContactLanes& points) {
    const Double2 off_x = points.x - lanes::first(position), off_y = points.y - lanes::second(position);
    const Double2 squares = off_x * off_x + off_y * off_y;
    const std::uint32_t other = points.mask == 2 || (points.mask == 3 && squares[1] > squares[0]) ? 1 : 0;
    const std::uint32_t place = points.mask == 1 || points.mask == 2 ? 1 : 0;
    const auto pair = [&](double other_one, double added) {
        return place == 1 ? lanes::double2(other_one, added) : lanes::double2(added, other_one);
    };
    points.x = pair(points.x[other], position[0]);
    points.y = pair(points.y[other], position[1]);
    points.depth = pair(points.depth[other], depth);
    points.features[1 - place] = points.features[other];
    points.features[place] = feature;
    points.mask = points.mask == 0 ? 1 : 3;
}

/// If the closest features are two corners, or if A's edge is parallel to the edge of B.
template <class Core>
[[gnu::noinline]] void clip_facing_edges(const CorePair<Core>& pair, const ClosestFeatures2& closest,
                                         const ContactRange& range, ContactLanes& points) {
    const Double2 out = closest.from_a();
    const Double2 outwards[2] = {pair.shape(0).place().back(out), -pair.shape(1).place().back(out)};
    const FacingEdge edges[2] = {pair.shape(0).facing(closest.corners[0][0], outwards[0]),
                                 pair.shape(1).facing(closest.corners[1][0], outwards[1])};
    const std::uint32_t of = edges[0].alignment >= aligned ? 0 : 1, side = edges[of].side;
    points.mask = 0;
    if (!(edges[of].alignment >= aligned)) return;
    const Core& reference = pair.shape(of);
    clip_edges(reference, pair.shape(1 - of), pair.seen_from(of), side, edges[1 - of].side, outwards[of],
               1 / lanes::dot(reference.normal(side), outwards[of])[0], range, points);
}

/// From the closest features, whose corners have the numbers of `PolygonSoa`.
template <class Core>
[[gnu::always_inline]] inline void find_contact_points(const CorePair<Core>& pair, const ClosestFeatures2& closest,
                                                       double margin, ContactLanes& points) {
    const Core &a = pair.shape(0), &b = pair.shape(1);
    const double depth = a.radius() + b.radius() - closest.gap;
    const ContactRange range{depth, margin, 1e-6 * std::min(a.extent() + a.radius(), b.extent() + b.radius())};
    const std::uint32_t of = closest.of, side = closest.corners[of][0];
    const Core reference = pair.shape(of), incident = pair.shape(1 - of);
    const Double2 normal = reference.normal(side);
    const FacingEdge facing = incident.facing(closest.corners[1 - of][0], -pair.seen_from(1 - of).vector(normal));
    const bool is_edge = closest.corners[of][1] != side && reference.is_proper(side);
    if (is_edge && (of == 0 || facing.alignment < aligned))
        clip_edges(reference, incident, pair.seen_from(of), side, facing.side, normal, 1, range, points);
    else
        clip_facing_edges(pair, closest, range, points);
    // The deepest corner may lie on no edge along the normal.
    if ((lanes::bits(points.depth >= lanes::double2(depth - range.tolerance)) & points.mask) == 0) {
        add_deepest(closest.midway(incident.radius(), depth), depth,
                    a.number(closest.corners[0][0]) << 8 ^ b.number(closest.corners[1][0]), points);
    }
    if (!(margin > 0)) points.depth = lanes::greater(points.depth, Double2{0, 0});
}

// A polygon may get rows, and its corners new numbers. The corners of the answers have the numbers of the shapes.

/// Whether the distance of two shapes is at most `reach`.
PairAnswer pair2_within(PlacedPolygon& a, PlacedPolygon& b, double reach, Cache* cache);

/// The closest features of the cores, unless they are unknown.
PairAnswer pair2_closest(PlacedPolygon& a, PlacedPolygon& b, Cache* cache, ClosestFeatures2& closest);

/// The contact if the distance is at most `reach`; its points have gaps of at most `margin`.
PairAnswer pair2_contact(PlacedPolygon& a, PlacedPolygon& b, double reach, double margin, Cache* cache,
                         ClosestFeatures2& closest, ContactLanes& points);

inline void write(const ClosestFeatures2& closest, const PlacedPolygon& a, const PlacedPolygon& b,
                  SignedDistance<2>& result) {
    const Double2 out = closest.from_a();
    result.distance = closest.gap - a.radius - b.radius;
    result.normal = vector_of(out);
    result.on_a = vector_of(closest.on_a() + out * lanes::double2(a.radius));
    for (std::size_t i = 0; i < 2; ++i) {
        result.corners.a[i] = closest.corners[0][i];
        result.corners.b[i] = closest.corners[1][i];
    }
    result.corners.count = 2;
}
inline void write(const ContactLanes& points, Manifold<2>& result) {
    result.count = 0;
    for (std::size_t i = 0; i < 2; ++i)
        if ((points.mask >> i & 1u) != 0)
            result.points[result.count++] = {{points.x[i], points.y[i]}, points.depth[i], points.features[i]};
}

}  // namespace abut::detail
