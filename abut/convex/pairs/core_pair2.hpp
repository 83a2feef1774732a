#pragma once

// The closest features of two placed cores, in double: all edges are tested as separating axes at once; if one
// separates the cores, the closest features are a few steps from it. For .cpp files.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/pairs/edge_gaps2.hpp>
#include <abut/convex/pairs/pair_answer.hpp>
#include <abut/convex/pairs/point2.hpp>
#include <abut/convex/pairs/voronoi2.hpp>

namespace abut::detail {

/// The closest features of two cores, or those of the minimum penetration, in the world: an edge of one, the reference,
/// and a corner of the other; or two corners.
struct ClosestFeatures2 {
    std::uint32_t of;                ///< the reference. 0: A, 1: B
    std::uint32_t corners[2][2];     ///< of A and of B: the ends of the edge, or one corner twice
    double gap;                      ///< between the cores; below zero: penetration
    Double2 normal;                  ///< of length 1, outwards from the reference
    Double2 on_reference, on_other;  ///< on the cores

    /// From A to B.
    Double2 from_a() const {
        static constexpr double towards_b[2] = {1, -1};
        return normal * lanes::double2(towards_b[of]);
    }
    Double2 on_a() const { return of == 0 ? on_reference : on_other; }
    Double2 on_b() const { return of == 0 ? on_other : on_reference; }
    /// Midway between the two surfaces, from the radius of the other and the depth of the surfaces.
    Double2 midway(double other_radius, double depth) const {
        return on_other - normal * lanes::double2(other_radius - 0.5 * depth);
    }
    void set_corners(std::uint32_t reference_first, std::uint32_t reference_second, std::uint32_t other) {
        corners[of][0] = reference_first;
        corners[of][1] = reference_second;
        corners[1 - of][0] = corners[1 - of][1] = other;
    }
};

/// Two cores of one kind, neither of which is a point.
template <class Core>
class CorePair {
public:
    /// Both must outlive the pair.
    CorePair(const PlacedPolygon& a, const PlacedPolygon& b)
        : shapes_{Core(a), Core(b)}, between_(b.place.position - a.place.position) {}

    /// Places each shape relative to the other, for all that isn't answered by the cache.
    void set_relative_places() {
        const LanePose &a = shapes_[0].place(), &b = shapes_[1].place();
        seen_[0].position = a.back(between_);
        seen_[0].set_turn(a.back(b.turn()));
        seen_[1].position = -b.back(between_);
        seen_[1].cos = seen_[0].cos;
        seen_[1].sin = -seen_[0].sin;
    }
    const Core& shape(std::uint32_t of) const { return shapes_[of]; }
    /// The other shape relative to this one.
    const LanePose& seen_from(std::uint32_t of) const { return seen_[of]; }

    /// The magnitude of all numbers.
    double scale() const {
        const Double2 place = lanes::magnitude(between_);
        return (place[0] + place[1]) + (shapes_[0].size() + shapes_[1].size());
    }

    /// The closest features, if the gap between the cores is at most `reach`.
    [[gnu::always_inline]] PairAnswer find_closest(double reach, Cache* cache, ClosestFeatures2& closest) {
        return find<false>(reach, cache, closest);
    }
    /// Whether the gap between the cores is at most `reach`.
    [[gnu::always_inline]] PairAnswer within(double reach, Cache* cache) {
        ClosestFeatures2 closest;
        return find<true>(reach, cache, closest);
    }

private:
    template <bool only_within>
    [[gnu::always_inline]] inline PairAnswer find(double reach, Cache* cache, ClosestFeatures2& closest) {
        const bool all = !only_within && !is_finite(reach);
        if (cache != nullptr && (all ? closest_from_cache(*cache, closest) : separated_by_cache(*cache, reach)))
            return all ? PairAnswer::yes : PairAnswer::no;
        const double magnitude = scale();
        if (!is_finite(magnitude)) return PairAnswer::unknown;
        if constexpr (only_within) {
            // Bounding circles around the positions.
            const double far = reach + shapes_[0].outer_radius() + shapes_[1].outer_radius();
            if (lanes::dot(between_, between_)[0] > far * far) return PairAnswer::no;
        }
        set_relative_places();
        EdgeGap widest;
        find_widest_gap(shapes_[0], shapes_[1], seen_, reach, 1e-14 * magnitude, widest);
        const bool overlaps = only_within && widest.gap <= 0;
        if (overlaps || widest.gap > reach) {
            if (cache != nullptr) store_edge(widest, *cache);
            return overlaps ? PairAnswer::yes : PairAnswer::no;
        }
        return find_from_edge(widest, reach, cache, closest);
    }
    static Double2 from_position(const Core& core, std::uint32_t corner) {
        return core.place().vector(core.corner(corner));
    }
    const Core& other_than(std::uint32_t of) const { return shapes_[1 - of]; }
    /// From this shape's position to the other one's.
    Double2 between(std::uint32_t of) const {
        static constexpr double towards_other[2] = {1, -1};
        return between_ * lanes::double2(towards_other[of]);
    }

    /// From the edge with the widest gap: the other's lowest corner is in front of it, or past one of its ends.
    [[gnu::always_inline]] inline PairAnswer find_from_edge(const EdgeGap& widest, double reach, Cache* cache,
                                                            ClosestFeatures2& closest) const {
        const EdgeRegion region =
            set_edge(widest.of, widest.side, widest.corner,
                     seen_[widest.of].point(other_than(widest.of).corner(widest.corner)), closest);
        const bool found = region == EdgeRegion::within || (closest.gap > 0 ? find_corner(widest, region, closest)
                                                                            : find_behind_end(widest, region, closest));
        if (!found) return PairAnswer::unknown;
        if (cache != nullptr) store(closest, *cache);
        return closest.gap > reach ? PairAnswer::no : PairAnswer::yes;
    }

    /// An edge of one shape and a corner of the other, and in which Voronoi region of the edge the corner is,
    /// which has the place `local_corner` in the frame of the edge.
    [[gnu::always_inline]] inline EdgeRegion set_edge(std::uint32_t of, std::uint32_t side, std::uint32_t corner,
                                                      Double2 local_corner, ClosestFeatures2& closest) const {
        const Core &reference = shapes_[of], &other = shapes_[1 - of];
        const Double2 own_corner = other.corner(corner), normal = reference.normal(side);
        closest.of = of;
        closest.gap = lanes::dot(normal, local_corner)[0] - reference.offset(side);
        closest.set_corners(side, reference.after(side), corner);
        closest.normal = reference.place().vector(normal);
        closest.on_other = other.place().point(own_corner);
        closest.on_reference = closest.on_other - closest.normal * lanes::double2(closest.gap);
        return reference.voronoi_region(side, local_corner);
    }

    /// The direction between two points that are nearer may be rounding.
    double touching() const { return on_corner * scale(); }

    /// Two corners. Returns false unless they are apart and, if it isn't known, each is farthest in the direction of
    /// the other.
    bool set_corners(std::uint32_t corner_a, std::uint32_t corner_b, bool known, ClosestFeatures2& closest) const {
        const Double2 offset_a = from_position(shapes_[0], corner_a), offset_b = from_position(shapes_[1], corner_b);
        const Double2 between = between_ + (offset_b - offset_a), square = lanes::dot(between, between);
        // Only of the numbers in the sum: the sizes of the cores lie on other cache lines.
        const Double2 sizes = lanes::magnitude(between_) + lanes::magnitude(offset_a) + lanes::magnitude(offset_b);
        const double apart = on_corner * (sizes[0] + sizes[1]);
        if (!(square[0] > apart * apart)) return false;
        if (!known && !(shapes_[0].is_farthest(corner_a, shapes_[0].place().back(between)) &&
                        shapes_[1].is_farthest(corner_b, -shapes_[1].place().back(between))))
            return false;
        // The root and the quotient run in parallel.
        const Double2 gap = lanes::root(square), per_gap = gap * (Double2{1, 1} / square);
        closest.of = 0;
        closest.set_corners(corner_a, corner_a, corner_b);
        closest.gap = gap[0];
        closest.normal = between * per_gap;
        closest.on_reference = shapes_[0].place().position + offset_a;
        closest.on_other = shapes_[1].place().position + offset_b;
        return true;
    }

    /// From an edge that separates the cores, if the other's lowest corner is beyond one of its ends.
    bool find_corner(const EdgeGap& widest, EdgeRegion region, ClosestFeatures2& closest) const {
        const Core& reference = shapes_[widest.of];
        const std::uint32_t end = region == EdgeRegion::before_start ? widest.side : reference.after(widest.side);
        const std::uint32_t corner_a = widest.of == 0 ? end : widest.corner,
                            corner_b = widest.of == 0 ? widest.corner : end;
        return set_corners(corner_a, corner_b, false, closest) || walk(corner_a, corner_b, closest);
    }
    /// From an edge and the corners at its end. If these touch, the edge remains the closest feature, unless it is
    /// nearer than they are: far from the origin corners count as touching that aren't.
    [[gnu::noinline]] bool walk(std::uint32_t corner_a, std::uint32_t corner_b, ClosestFeatures2& closest) const {
        const Double2 between = seen_[0].point(shapes_[1].corner(corner_b)) - shapes_[0].corner(corner_a);
        const double square = lanes::dot(between, between)[0];
        if (square <= touching() * touching()) return square_root(square) - closest.gap <= 1e-14 * scale();
        FeaturePair features{{corner_a, corner_b}, false, 0, 0};
        const Rigid2 places[2] = {rigid(seen_[0]), rigid(seen_[1])};
        SoaStorage storage[2];
        PolygonSoa rows[2];
        for (std::uint32_t i = 0; i < 2; ++i) set_rows(shapes_[i], storage[i], rows[i]);
        if (!walk_to_closest(rows[0], rows[1], places, features)) return false;
        if (!features.is_edge) return set_corners(features.corners[0], features.corners[1], true, closest);
        const std::uint32_t of = features.of, corner = features.corners[1 - of];
        set_edge(of, features.side, corner, seen_[of].point(other_than(of).corner(corner)), closest);
        return closest.gap > 0;
    }
    static void set_rows(const PolygonCore& core, SoaStorage&, PolygonSoa& rows) { rows = core.sides(); }
    static void set_rows(const BoxCore& core, SoaStorage& storage, PolygonSoa& rows) {
        write_box_rows(core.half(), storage, rows);
    }

    /// The other's lowest corner lies behind the edge of minimum depth, but past one of its ends. Then an edge of the
    /// other runs along it, and one of its points lies behind that end.
    [[gnu::noinline]] bool find_behind_end(const EdgeGap& widest, EdgeRegion region, ClosestFeatures2& closest) const {
        const Core &reference = shapes_[widest.of], &other = other_than(widest.of);
        const LanePose& seen = seen_[widest.of];
        const bool before = region == EdgeRegion::before_start;
        const std::uint32_t end = before ? widest.side : reference.after(widest.side);
        const std::uint32_t next = before ? other.before(widest.corner) : other.after(widest.corner);
        const Double2 normal = reference.normal(widest.side), along = lanes::swapped(normal) * Double2{-1, 1};
        const Double2 corner = seen.point(other.corner(widest.corner)), edge = seen.point(other.corner(next)) - corner;
        const double part = lanes::dot(along, reference.corner(end) - corner)[0] / lanes::dot(along, edge)[0];
        if (!(part >= 0 && part <= 1)) return false;
        const Double2 on_other = corner + edge * lanes::double2(part),
                      on_reference = on_other - normal * lanes::double2(widest.gap);
        const Double2 off = on_reference - reference.corner(end);
        closest.gap = widest.gap;
        closest.corners[widest.of][0] = closest.corners[widest.of][1] = end;
        closest.corners[1 - widest.of][0] = widest.corner;
        closest.corners[1 - widest.of][1] = next;
        closest.on_other = shapes_[widest.of].place().point(on_other);
        closest.on_reference = shapes_[widest.of].place().point(on_reference);
        return lanes::dot(off, off)[0] <= 1e-18 * scale() * scale();
    }

    // Warm start: the cache names an edge and a corner, or two corners.

    /// The closest features of the last query, if they are still closest.
    [[gnu::always_inline]] bool closest_from_cache(const Cache& cache, ClosestFeatures2& closest) const {
        if (!names_features(cache)) return false;
        const std::uint32_t corner_a = shapes_[0].corner_of(cache.corner_a[0]),
                            corner_b = shapes_[1].corner_of(cache.corner_b[0]);
        if (cache.count == 1) return set_corners(corner_a, corner_b, false, closest);
        const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1;
        const std::uint32_t side = of == 0 ? corner_a : corner_b, corner = of == 0 ? corner_b : corner_a;
        const Double2 local_corner = shapes_[of].place().back(between(of) + from_position(other_than(of), corner));
        return set_edge(of, side, corner, local_corner, closest) == EdgeRegion::within && closest.gap > 0 &&
               other_than(of).is_farthest(corner, -other_than(of).place().back(closest.normal));
    }
    /// Whether the last separating edge proves that the cores are farther apart than `reach`, whatever the cache
    /// contains.
    [[gnu::noinline]] bool separated_by_cache(const Cache& cache, double reach) const {
        if (cache.count != 2 || !names_features(cache)) return false;
        const std::uint32_t of = cache.corner_a[0] != cache.corner_a[1] ? 0 : 1;
        const Core &reference = shapes_[of], &other = other_than(of);
        const std::uint32_t side = reference.corner_of(of == 0 ? cache.corner_a[0] : cache.corner_b[0]);
        const Double2 normal = reference.place().vector(reference.normal(side));
        const double away = lanes::dot(normal, between(of))[0], lowest = other.lowest(other.place().back(normal));
        return away + lowest - reference.offset(side) > reach + 1e-14 * scale();
    }
    bool names_features(const Cache& cache) const {
        return cache.count > 0 && cache.count <= 2 && cache.corner_a[0] < shapes_[0].count() &&
               cache.corner_b[0] < shapes_[1].count();
    }
    [[gnu::noinline]] void store(const ClosestFeatures2& closest, Cache& cache) const {
        for (std::size_t i = 0; i < 2; ++i) {
            cache.corner_a[i] = shapes_[0].number(closest.corners[0][i]);
            cache.corner_b[i] = shapes_[1].number(closest.corners[1][i]);
        }
        const bool has_edge = cache.corner_a[0] != cache.corner_a[1] || cache.corner_b[0] != cache.corner_b[1];
        // For overlapping cores all edges are tested each time.
        cache.count = closest.gap > 0 ? (has_edge ? 2 : 1) : 0;
        const Double2 axis = closest.from_a();
        cache.axis = {static_cast<float>(axis[0]), static_cast<float>(axis[1]), 0};
    }
    [[gnu::noinline]] void store_edge(const EdgeGap& widest, Cache& cache) const {
        const Core& reference = shapes_[widest.of];
        auto &of_reference = widest.of == 0 ? cache.corner_a : cache.corner_b,
             &of_other = widest.of == 0 ? cache.corner_b : cache.corner_a;
        of_reference[0] = reference.number(widest.side);
        of_reference[1] = reference.number(reference.after(widest.side));
        of_other[0] = of_other[1] = other_than(widest.of).number(widest.corner);
        cache.count = widest.gap <= 0 ? 0 : of_reference[0] != of_reference[1] ? 2 : 1;
    }

    Core shapes_[2];
    LanePose seen_[2];
    Double2 between_;
};

}  // namespace abut::detail
