#include <abut/world/ball_early_out.hpp>

#include <algorithm>

namespace abut::detail {

template <int D>
ShapeType shape_type(const View<D>& view) {
    if (std::holds_alternative<HalfSpaceView<D>>(view)) return ShapeType::half_space;
    if (std::holds_alternative<Composite<D>>(view)) return ShapeType::composite;
    if (std::holds_alternative<DistanceFunction<D>>(view)) return ShapeType::distance;
    const Convex<D>& convex = std::get<Convex<D>>(view);
    switch (convex.core) {
        case Core::box:
            return ShapeType::box;
        case Core::discs:
            return ShapeType::discs;
        case Core::function:
            return ShapeType::function;
        case Core::points:
            break;
    }
    return static_cast<ShapeType>(std::min(convex.count, 4u) - 1);
}

void BallEarlyOuts::add_sample(Entry& entry, const std::array<double, 3>& nanoseconds, bool balls_overlap,
                               bool shapes_overlap) {
    constexpr std::array<std::size_t, 2> balls_first{0, 1};
    const std::span<const std::size_t> order(balls_first);
    entry.sampled.add(nanoseconds, (balls_overlap ? 1u : 0u) | (shapes_overlap ? 2u : 0u),
                      order.subspan(entry.is_used ? 0 : 1));
    has_new_samples_ = true;
}

void BallEarlyOuts::decide() {
    if (!has_new_samples_) return;
    has_new_samples_ = false;
    for (auto& entries : entries_)
        for (Entry& entry : entries) {
            if (entry.sampled.samples() < SampledTests<2>::enough) continue;
            const TestCost balls = entry.sampled.cost(0), shapes = entry.sampled.cost(1);
            entry.is_used = worth_pretesting(balls.time, balls.pass, shapes.time);
            entry.sampled.fade();
        }
}

template ShapeType shape_type(const View<2>&);
template ShapeType shape_type(const View<3>&);

}  // namespace abut::detail
