#pragma once

// From one arrangement of things to another, by moving one at a time.

#include <abut/math/pose.hpp>
#include <abut/motion/removal_order.hpp>

namespace abut {

/// One thing moves straight from one place to another, without turning; or it turns about its place, which then stays
/// the same, by any way it likes.
template <int D>
struct Move {
    std::uint32_t shape = 0;
    Pose<D> from{}, to{};
};

template <int D>
struct Rearrangement {
    std::vector<Move<D>> moves;        ///< in this order, each from where the shape was left
    std::vector<std::uint32_t> stuck;  ///< empty, or shapes that block one another: then there are no moves

    explicit operator bool() const { return stuck.empty(); }
};

template <int D>
struct RearrangeOptions {
    Vec<D> away = last_axis();  ///< the way to where there is room without end; of any length but zero

private:
    static constexpr Vec<D> last_axis() {
        Vec<D> result(0);
        result[D - 1] = 1;
        return result;
    }
};

/// Moves that take the shapes, each on top of the position it carries itself, from one list of poses to another. None
/// runs into another by more than the margin of doubt: each straight move was tried by `sweep`, and things turn only
/// where nothing is within reach. In neither arrangement do shapes overlap by more than that.
///
/// What can go straight to its place does so; what stands right and in nobody's way stays. The others, and what lies
/// above them, are taken away in a removal order, each to a place of its own beyond all others, and brought back in the
/// reverse removal order of the new arrangement: at most five moves each.
///
/// In 2D, with room in one direction, that always succeeds. In 3D the shapes of either arrangement may block one
/// another along `away`; then the axes are tried, and if they do along each of them, those that do along `away` are
/// named. Lists of different lengths, NaN and infinity trip ABUT_ASSERT, and name all as stuck.
template <int D>
Rearrangement<D> rearrange(std::span<const Convex<D>> shapes, std::span<const Pose<D>> from,
                           std::span<const Pose<D>> to, const RearrangeOptions<D>& options = {});

template <ConvexShapes Shapes>
Rearrangement<dimension<detail::ElementOf<Shapes>>> rearrange(
    const Shapes& shapes, const std::vector<Pose<dimension<detail::ElementOf<Shapes>>>>& from,
    const std::vector<Pose<dimension<detail::ElementOf<Shapes>>>>& to,
    const RearrangeOptions<dimension<detail::ElementOf<Shapes>>>& options = {}) {
    constexpr int D = dimension<detail::ElementOf<Shapes>>;
    std::vector<Convex<D>> views;
    for (const auto& shape : shapes) views.push_back(view(shape));
    return rearrange(std::span<const Convex<D>>(views), std::span<const Pose<D>>(from), std::span<const Pose<D>>(to),
                     options);
}

}  // namespace abut
