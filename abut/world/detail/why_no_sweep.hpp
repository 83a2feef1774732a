#pragma once

// The reasons, for error messages of compilers, why World::sweep does not take some arguments.

#include <abut/math/executor.hpp>
#include <abut/math/motion.hpp>
#include <abut/shape/view/constraints.hpp>
#include <abut/world/options.hpp>
#include <abut/world/results.hpp>

#include <optional>
#include <span>
#include <type_traits>

namespace abut::detail {

/// The overloads of World::sweep without the shape.
template <int D>
struct MotionsInWorld {
    void operator()(const Vec<D>&, const Filter& = {}) const;
    void operator()(const Motion<D>&, const Filter& = {}) const;
    void operator()(const Pose<D>&, const Pose<D>&, const Filter& = {}) const;
    using Hits = std::span<std::optional<WorldHit<D>>>;
    void operator()(std::span<const Motion<D>>, Hits, const Filter& = {}) const;
    void operator()(std::span<const Motion<D>>, Hits, Executor&, const Filter& = {}) const;
};

/// Names the reason why World::sweep does not take some arguments.
template <int D, class S, class... Motions>
requires(!ShapeIn<S, D> || !std::is_invocable_v<MotionsInWorld<D>, Motions&...> ||
         (is_other_point<Motions, D> || ...)) using WhyNoSweepInWorld =
    std::conditional_t<!Shape<S>, this_is_no_shape,
                       std::conditional_t<ShapeIn<S, D>, a_Pose_of_this_dimension_is_needed_here_and_not_a_position,
                                          this_shape_has_another_dimension>>;

}  // namespace abut::detail
