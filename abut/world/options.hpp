#pragma once

// The options of a world, of its items and of queries about them.

#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/pose.hpp>
#include <abut/world/ball_early_out.hpp>
#include <abut/world/id.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace abut {

/// The options of an item: a shape in a world.
template <int D>
struct ItemOptions {
    Pose<D> pose{};                          ///< applied to the shape, which has a position of its own as well
    std::uint64_t user = 0;                  ///< free for the game's use, such as an index
    std::uint64_t layers = 1;                ///< the layers the item is on, one bit each
    std::uint64_t mask = ~std::uint64_t{0};  ///< the layers the item pairs with; both items must agree
    bool fixed = false;                      ///< seldom moves; two fixed items never pair
    bool sensor = false;                     ///< has events and no contacts; queries skip it by default
    bool continuous = false;  ///< the events include all that it touches between two updates, at any speed: bullets
    /// Two items of one group pair whatever their layers if it is above 0, and never if it is below 0, such as the
    /// parts of a vehicle. 0 is no group.
    std::int32_t group = 0;
    bool enabled = true;  ///< if not, the item keeps its id and options, and neither pairs nor is found by queries
};

/// The first two are for tests and measurements: no answer depends on them.
struct WorldOptions {
    BallEarlyOut ball_early_out = BallEarlyOut::measured;
    std::optional<BroadPhaseKind> broad_phase = std::nullopt;  ///< by default the world chooses
    /// Whether contacts() has the normals of the surface that neighbouring items form together (docs/ghosts.md). If
    /// not, each pair has its own contact. Events don't depend on it.
    bool filter_edges = true;
    /// How many shapes the world holds for `restore` that no item has any more: the last that a snapshot refers to.
    std::size_t max_released_shapes = 1024;
};

/// The items that a query takes into account.
struct Filter {
    std::uint64_t layers = ~std::uint64_t{0};  ///< the query pairs as an item on these layers does
    std::uint64_t mask = ~std::uint64_t{0};    ///< the query finds items on one of these layers only
    bool sensors = false;                      ///< whether the query finds sensors as well
    Id ignore{};                               ///< an item to skip, such as the one that the query is for
    /// More items to skip, such as a vehicle's parts. They are compared one by one, so a layer is faster for hundreds.
    /// The ids must outlive the filter.
    std::span<const Id> ignore_ids{};
    /// The query finds only items for which this returns true. It is called last, for items near the query, in an
    /// unspecified order, and on the threads of an executor. It must outlive the filter and not change the world.
    std::optional<FunctionRef<bool(Id)>> accepts{};
};

}  // namespace abut
