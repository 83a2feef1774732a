#pragma once

// The data of a Chain. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/chain.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

/// The problem of the points of a chain.
std::optional<Problem> problem_of_chain(std::span<const Vec2> points, bool closed);

}  // namespace abut::detail

namespace abut {

struct Chain::Data {
    std::vector<Vec2> points;
    bool closed = false;
    bool one_sided = false;
    Bvh<2> tree;  ///< of the segments

    std::uint32_t size() const { return static_cast<std::uint32_t>(closed ? points.size() : points.size() - 1); }
    Segment2 segment(std::uint32_t index) const {
        return {points[index], points[index + 1 == points.size() ? 0 : index + 1]};
    }
    detail::Convex<2> part(std::uint32_t index) const {
        detail::Convex<2> result = convex(segment(index));
        result.one_sided = one_sided;
        return result;
    }
    Aabb2 box(std::uint32_t index) const {
        const Segment2 s = segment(index);
        return merged(Aabb2{s.a, s.a}, Aabb2{s.b, s.b});
    }
};

}  // namespace abut
