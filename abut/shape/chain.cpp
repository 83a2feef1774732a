#include <abut/math/assert.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/detail/chain_data.hpp>

#include <vector>

namespace abut {

std::optional<Problem> detail::problem_of_chain(std::span<const Vec2> points, bool closed) {
    const std::size_t min_count = closed ? 3 : 2;
    if (points.size() < min_count)
        return Problem{ProblemCode::empty_input,
                       std::string(closed ? "a closed" : "an open") + " chain needs at least " +
                           std::to_string(min_count) + " points, and there are " + std::to_string(points.size()),
                       points.size()};
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!detail::is_finite(points[i]))
            return Problem{ProblemCode::not_finite,
                           "point " + std::to_string(i) + " has a coordinate that is not finite", i};
    for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
        if (points[i] == points[i + 1 == points.size() ? 0 : i + 1])
            return Problem{ProblemCode::degenerate,
                           "segment " + std::to_string(i) + " has no length: its two points are at the same place", i};
    return std::nullopt;
}

Result<Chain> Chain::build(const PointSpan<2>& given, bool closed, const ChainOptions& options) {
    detail::enter_library();
    const detail::PackedPoints<2> packed(given);
    const std::span<const Vec2> points = packed.points();
    if (std::optional<Problem> problem = detail::problem_of_chain(points, closed)) return *std::move(problem);
    auto data = std::make_shared<Data>();
    data->points.assign(points.begin(), points.end());
    data->closed = closed;
    data->one_sided = options.one_sided;
    std::vector<Aabb2> boxes;
    boxes.reserve(data->size());
    for (std::uint32_t i = 0; i < data->size(); ++i) boxes.push_back(data->box(i));
    data->tree.build(boxes);
    return Chain(std::move(data));
}

Result<Chain> Chain::build(std::initializer_list<Vec2> points, bool closed, const ChainOptions& options) {
    return build(std::span<const Vec2>(points.begin(), points.size()), closed, options);
}

std::span<const Vec2> Chain::points() const {
    return data_->points;
}
bool Chain::closed() const {
    return data_->closed;
}
bool Chain::one_sided() const {
    return data_->one_sided;
}
std::uint32_t Chain::size() const {
    return data_->size();
}

Segment2 Chain::segment(std::uint32_t index) const {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    return data_->segment(index);
}

std::uint32_t Chain::neighbour(std::uint32_t segment, std::uint32_t end) const {
    const std::uint32_t count = size();
    ABUT_ASSERT(segment < count && end < 2);
    if (end == 0) return segment > 0 ? segment - 1 : data_->closed ? count - 1 : no_neighbour;
    return segment + 1 < count ? segment + 1 : data_->closed ? 0 : no_neighbour;
}

Aabb2 bounds(const Chain& chain) {
    detail::enter_library();
    return chain.data_->tree.bounds();
}

void each_part(const Chain& chain, const Aabb2& box, detail::PartVisitor<2> visit) {
    detail::enter_library();
    const Chain::Data& data = *chain.data_;
    data.tree.each_overlapping(box, [&](std::uint32_t index) -> bool { return visit(data.part(index), index); });
}

void each_part_along(const Chain& chain, const MovingBox<2>& box, detail::PartReachVisitor<2> visit) {
    detail::enter_library();
    const Chain::Data& data = *chain.data_;
    data.tree.sweep(box, [&](std::uint32_t index) -> float { return visit(data.part(index), index); });
}

void each_part_near(const Chain& chain, const Aabb2& box, detail::PartReachVisitor<2> visit) {
    detail::enter_library();
    const Chain::Data& data = *chain.data_;
    data.tree.closest(box, [&](std::uint32_t index) -> float { return visit(data.part(index), index); });
}

bool solid_contains(const Chain& chain, const Vec2& point) {
    detail::enter_library();
    if (!chain.closed()) return false;
    // The winding number, from signed crossings of a ray along x: Sunday, "Inclusion of a point in a polygon" (2001).
    Aabb2 ahead{point, point};
    ahead.max.x = std::numeric_limits<float>::infinity();
    int winding = 0;
    chain.data_->tree.each_overlapping(ahead, [&](std::uint32_t index) {
        const Segment2 s = chain.data_->segment(index);
        const bool from_below = s.a.y <= point.y, to_below = s.b.y <= point.y;
        if (from_below && !to_below && orientation(s.a, s.b, point) > 0) ++winding;
        if (!from_below && to_below && orientation(s.a, s.b, point) < 0) --winding;
    });
    return winding != 0;
}

}  // namespace abut
