#pragma once

// The parts of a shape of any kind. A part is a convex set, a distance function or a half-space. For .cpp files.

#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// The kinds of parts, in the order in which the functions for pairs take them.
enum class PartKind : std::uint8_t { convex, function, half_space };

/// Refers to a part.
template <int D>
class Part {
public:
    Part(const Convex<D>& part) : part_(&part), kind_(PartKind::convex) {}
    Part(const DistanceFunction<D>& part) : part_(&part), kind_(PartKind::function) {}
    Part(const HalfSpaceView<D>& part) : part_(&part), kind_(PartKind::half_space) {}

    PartKind kind() const { return kind_; }
    bool is_convex() const { return kind_ == PartKind::convex; }
    bool is_function() const { return kind_ == PartKind::function; }
    bool is_half_space() const { return kind_ == PartKind::half_space; }

    const Convex<D>& convex() const { return *static_cast<const Convex<D>*>(part_); }
    const DistanceFunction<D>& function() const { return *static_cast<const DistanceFunction<D>*>(part_); }
    const HalfSpaceView<D>& half_space() const { return *static_cast<const HalfSpaceView<D>*>(part_); }

    /// Calls f with the part in its own type.
    template <class F>
    decltype(auto) visit(F&& f) const {
        if (is_convex()) return f(convex());
        if (is_function()) return f(function());
        return f(half_space());
    }

private:
    const void* part_;
    PartKind kind_;
};

template <int D>
Aabb<D> bounds(const Part<D>& part) {
    return part.visit([](const auto& own) { return bounds(own); });
}

/// The bounding radius; infinite for a half-space, and for a distance function without bounds.
template <int D>
double size(const Part<D>& part) {
    if (part.is_half_space()) return std::numeric_limits<double>::infinity();
    return part.is_convex() ? size(part.convex()) : size(part.function());
}

/// The part that a shape is, which isn't composite.
template <int D>
Part<D> single_part(const View<D>& shape) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape)) return *convex;
    if (const auto* function = std::get_if<DistanceFunction<D>>(&shape)) return *function;
    return std::get<HalfSpaceView<D>>(shape);
}

/// Calls at_part(part) for a shape that is one part, and at_composite(composite) for a composite shape.
template <int D, class AtPart, class AtComposite>
decltype(auto) with_part(const View<D>& shape, AtPart&& at_part, AtComposite&& at_composite) {
    const auto* composite = std::get_if<Composite<D>>(&shape);
    return composite != nullptr ? at_composite(*composite) : at_part(single_part(shape));
}

/// Calls visit(part, index) for a shape that is one part, or for at least the parts of a composite shape whose boxes
/// overlap `box`. The visitor returns false to stop.
template <int D, class Visit>
void for_each_part(const View<D>& shape, const Aabb<D>& box, Visit&& visit) {
    with_part(
        shape, [&](const Part<D>& part) { visit(part, 0u); },
        [&](const Composite<D>& composite) {
            each_part<D>(composite, box,
                         [&](const Convex<D>& part, std::uint32_t index) -> bool { return visit(part, index); });
        });
}

/// Calls visit(part, index) for a shape that is one part, or for at least the parts of a composite shape that are at
/// most `reach` from another shape or part. The visitor returns false to stop.
template <int D, class Other, class Visit>
void for_each_part(const View<D>& shape, const Other& other, float reach, Visit&& visit) {
    with_part(
        shape, [&](const Part<D>& part) { visit(part, 0u); },
        [&](const Composite<D>& composite) {
            each_part<D>(composite, grown(bounds(other), reach),
                         [&](const Convex<D>& part, std::uint32_t index) -> bool { return visit(part, index); });
        });
}

/// Calls visit(part_a, index_a, part_b, index_b) for at least all pairs of parts that are at most `reach` apart. The
/// visitor returns false to stop.
template <int D, class Visit>
void for_each_part_pair(const View<D>& a, const View<D>& b, float reach, Visit&& visit) {
    for_each_part(a, b, reach, [&](const Part<D>& part_a, std::uint32_t index_a) {
        bool go_on = true;
        for_each_part(b, part_a, reach, [&](const Part<D>& part_b, std::uint32_t index_b) {
            return go_on = visit(part_a, index_a, part_b, index_b);
        });
        return go_on;
    });
}

}  // namespace abut::detail
