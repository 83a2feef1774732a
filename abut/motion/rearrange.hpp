#pragma once

// Rearrangement: moves shapes from one arrangement to another, one at a time.

#include <abut/math/pose.hpp>
#include <abut/motion/removal_order.hpp>

namespace abut {

/// One move of one shape: a translation without rotation, or a rotation in place by any path.
template <int D>
struct Move {
    std::uint32_t shape = 0;
    Pose<D> from{}, to{};
};

template <int D>
struct Rearrangement {
    std::vector<Move<D>> moves;        ///< in order; each starts where the shape was left
    std::vector<std::uint32_t> stuck;  ///< empty on success; else shapes that block one another, and there are no moves

    explicit operator bool() const { return stuck.empty(); }
};

template <int D>
struct RearrangeOptions {
    Vec<D> away = last_axis();  ///< direction towards unlimited free space; of any length but zero

private:
    static constexpr Vec<D> last_axis() {
        Vec<D> result(0);
        result[D - 1] = 1;
        return result;
    }
};

/// Plans moves that take the shapes from one list of poses to another; poses apply after the shapes' own positions. No
/// shape penetrates another by more than the tolerance: each translation is verified by `sweep`, and shapes rotate only
/// where nothing is within reach. In both arrangements shapes must not overlap by more than the tolerance.
///
/// Shapes that can move straight to their target do so first; a shape that is in place and blocks nothing stays. The
/// others, and the shapes above them, are removed in a disassembly order, each to a place of its own beyond all others,
/// and returned in the reverse disassembly order of the new arrangement: at most five moves each.
///
/// In 2D this always succeeds if one direction is free. In 3D the shapes of either arrangement may block one another
/// along `away`; then the axes are tried. If all fail, `stuck` holds the shapes that block one another along `away`.
/// Lists of different lengths, NaN and infinity trip ABUT_ASSERT, and all shapes are stuck.
template <int D>
Rearrangement<D> rearrange(std::span<const detail::Convex<D>> shapes, std::span<const Pose<D>> from,
                           std::span<const Pose<D>> to, const RearrangeOptions<D>& options = {});

template <detail::ConvexShapes Shapes>
Rearrangement<dimension<detail::ElementOf<Shapes>>> rearrange(
    const Shapes& shapes, const std::vector<Pose<dimension<detail::ElementOf<Shapes>>>>& from,
    const std::vector<Pose<dimension<detail::ElementOf<Shapes>>>>& to,
    const RearrangeOptions<dimension<detail::ElementOf<Shapes>>>& options = {}) {
    constexpr int D = dimension<detail::ElementOf<Shapes>>;
    detail::clear_upper_halves();
    std::vector<detail::Convex<D>> views;
    for (const auto& shape : shapes) views.push_back(view(shape));
    return rearrange(std::span<const detail::Convex<D>>(views), std::span<const Pose<D>>(from),
                     std::span<const Pose<D>>(to), options);
}

}  // namespace abut
