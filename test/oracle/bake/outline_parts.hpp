#pragma once

// Whether convex parts cover exactly the inside of an outline, in integers of any size.

#include "../rational.hpp"
#include <abut/math/aabb.hpp>
#include <abut/math/predicates.hpp>
#include <abut/shape/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace abut::oracle {

/// A float as an integer multiple of 2^-149.
inline Integer to_integer(float value) {
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(static_cast<double>(value), &exponent), 24));
    const int shift = exponent - 24 + 149;
    return shift >= 0 ? Integer(mantissa) << shift : Integer(mantissa >> -shift);
}

/// Twice the signed area of a ring, in units of 2^-298; above zero if the ring is counter-clockwise.
inline Integer twice_area(std::span<const Vec2> ring) {
    Integer sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
        sum += to_integer(a.x) * to_integer(b.y) - to_integer(a.y) * to_integer(b.x);
    }
    return sum;
}

/// Twice the area of a simple outline with disjoint holes inside it.
inline Integer twice_area(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes) {
    Integer result = abs(twice_area(outline));
    for (const std::vector<Vec2>& hole : holes) result -= abs(twice_area(hole));
    return result;
}

/// Checks the convex parts of an outline with holes. Each check returns a description of the fault, or an empty string.
class OutlineParts {
public:
    OutlineParts(std::span<const Vec2> outline, std::span<const std::vector<Vec2>> holes,
                 std::span<const Polygon> parts) {
        rings_.emplace_back(outline.begin(), outline.end());
        rings_.insert(rings_.end(), holes.begin(), holes.end());
        for (const std::vector<Vec2>& ring : rings_)
            for (IntegerRing& integer_ring = integer_rings_.emplace_back(); const Vec2& point : ring)
                integer_ring.emplace_back(3 * to_integer(point.x), 3 * to_integer(point.y));
        for (const Polygon& part : parts)
            if (part.rank() == 2) parts_.push_back({part.points(), box_of(part.points())});
        std::ranges::sort(parts_, {}, [](const Part& part) { return part.box.min.x; });
    }

    Integer twice_area() const {
        Integer sum = 0;
        for (const Part& part : parts_) sum += oracle::twice_area(part.loop);
        return sum;
    }

    /// All corners are points of the input, and convex.
    std::string fault_of_corners() const {
        std::set<std::pair<float, float>> given;
        for (const std::vector<Vec2>& ring : rings_)
            for (const Vec2& point : ring) given.emplace(point.x + 0.0f, point.y + 0.0f);
        for (const Part& part : parts_)
            for (std::size_t i = 0; i < part.loop.size(); ++i) {
                const std::size_t next = (i + 1) % part.loop.size(), after = (i + 2) % part.loop.size();
                if (!given.contains({part.loop[i].x, part.loop[i].y})) return "a corner that isn't in the input";
                if (orientation(part.loop[i], part.loop[next], part.loop[after]) <= 0) return "not convex";
            }
        return {};
    }

    std::string fault_of_overlaps() const {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            for (std::size_t j = i + 1; j < parts_.size() && parts_[j].box.min.x < parts_[i].box.max.x; ++j)
                if (overlaps(parts_[i].box, parts_[j].box) && !apart(parts_[i].loop, parts_[j].loop))
                    return "parts overlap";
        return {};
    }

    /// No ring crosses a part, and by the even-odd rule all parts are inside.
    std::string fault_of_inside() const {
        for (const std::vector<Vec2>& ring : rings_)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 edge[] = {ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]};
                const Aabb2 box = box_of(edge);
                for (const Part& part : parts_) {
                    if (part.box.min.x >= box.max.x && box.max.x > box.min.x) break;
                    if (overlaps(part.box, box) && !apart(part.loop, edge)) return "a ring runs through a part";
                }
            }
        return fault_of_middles();
    }

    /// A point of each part is inside by the even-odd rule. Also for rings with spikes, and nested rings.
    std::string fault_of_middles() const {
        for (const Part& part : parts_)
            if (!inside(part.loop)) return "a part that isn't inside";
        return {};
    }

    /// A place is covered by a part iff it is inside. On a ring either is right.
    std::string fault_at(const Vec2& place) const {
        for (const std::vector<Vec2>& ring : rings_)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec2 edge[] = {ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]};
                if (contains(box_of(edge), place) && orientation(edge[0], edge[1], place) == 0) return {};
            }
        const bool covered = std::ranges::any_of(parts_, [&](const Part& part) {
            for (std::size_t i = 0; i < part.loop.size(); ++i)
                if (orientation(part.loop[i], part.loop[(i + 1) % part.loop.size()], place) < 0) return false;
            return true;
        });
        const Vec2 three[] = {place, place, place};
        if (inside(three) == covered) return {};
        return covered ? "a place outside is covered" : "a place inside isn't covered";
    }

    /// No corner of a part lies within an edge of another (a T-junction).
    std::string fault_of_junctions() const {
        for (const Part& part : parts_)
            for (std::size_t i = 0; i < part.loop.size(); ++i) {
                const Vec2 &a = part.loop[i], &b = part.loop[i + 1 == part.loop.size() ? 0 : i + 1];
                const Aabb2 box = box_of(std::vector<Vec2>{a, b});
                for (const Part& other : parts_) {
                    if (!overlaps(other.box, box)) continue;
                    for (const Vec2& p : other.loop)
                        if (p != a && p != b && contains(box, p) && orientation(a, b, p) == 0)
                            return "a corner within an edge";
                }
            }
        return {};
    }

    /// All checks but those of single places and T-junctions; `expected` is twice the area.
    std::string fault(const Integer& expected) const {
        for (const std::string& found : {fault_of_corners(), fault_of_overlaps(), fault_of_inside()})
            if (!found.empty()) return found;
        return twice_area() == expected ? "" : "the area is wrong";
    }

private:
    using IntegerRing = std::vector<std::pair<Integer, Integer>>;
    struct Part {
        std::span<const Vec2> loop;
        Aabb2 box;
    };

    static Aabb2 box_of(std::span<const Vec2> points) {
        Aabb2 result = Aabb2::empty();
        for (const Vec2& point : points) result = merged(result, Aabb2{point, point});
        return result;
    }

    /// Whether the interiors of two convex loops are disjoint: then an edge of one lies on a separating line. A segment
    /// is a loop of two points.
    static bool apart(std::span<const Vec2> a, std::span<const Vec2> b) {
        const auto has_separating_edge = [](std::span<const Vec2> loop, std::span<const Vec2> other) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 &from = loop[i], &to = loop[i + 1 == loop.size() ? 0 : i + 1];
                if (std::ranges::all_of(other, [&](const Vec2& p) { return orientation(from, to, p) <= 0; }))
                    return true;
            }
            return false;
        };
        return has_separating_edge(a, b) || has_separating_edge(b, a);
    }

    /// Whether, by the even-odd rule, the ring contains the centroid of the first triangle of a loop. Coordinates are
    /// multiplied by 3.
    static bool contains_centroid(const IntegerRing& ring, std::span<const Vec2> loop) {
        const Integer x = to_integer(loop[0].x) + to_integer(loop[1].x) + to_integer(loop[2].x);
        const Integer y = to_integer(loop[0].y) + to_integer(loop[1].y) + to_integer(loop[2].y);
        bool result = false;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            // Edges go from left to right, so that an edge and its reverse cancel even if the point is on them.
            const auto [a, b] = std::minmax(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
            if ((a.first <= x) == (b.first <= x)) continue;
            if ((b.first - a.first) * (y - a.second) > (b.second - a.second) * (x - a.first)) result = !result;
        }
        return result;
    }

    bool inside(std::span<const Vec2> loop) const {
        for (std::size_t ring = 1; ring < integer_rings_.size(); ++ring)
            if (contains_centroid(integer_rings_[ring], loop)) return false;
        return contains_centroid(integer_rings_[0], loop);
    }

    std::vector<std::vector<Vec2>> rings_;
    std::vector<IntegerRing> integer_rings_;
    std::vector<Part> parts_;
};

}  // namespace abut::oracle
