#pragma once

// The insides of the broad phases: lines to draw, and the items that each leaves to be tested against a box.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>
#include <abut/broad_phase/temporal.hpp>

#include <vector>

namespace abut::play {

/// A line of a level.
struct LevelLine {
    float level;
    Vec2 from, to;
};

using Lines = std::vector<LevelLine>;
using TemporalGrid = Temporal<2, Grid<2>>;
using Items = std::vector<std::uint32_t>;

/// The borders of the cells.
Lines lines_of(const Grid<2>& phase);
/// The borders of the cells that hold boxes. Level 0 is the finest.
Lines lines_of(const LayeredGrid<2>& phase);
/// The borders of the columns, and at level 1 the interval of each box along the axis.
Lines lines_of(const SweepAndPrune<2>& phase);
/// The boxes of nodes and leaves. Level 0 is the root.
Lines lines_of(const Bvh<2>& phase);
/// The planes, cut to their cells. Level 0 is the root.
Lines lines_of(const Bsp<2>& phase);

/// Finds the candidates of boxes in a structure that does not change meanwhile.
template <class Phase>
class Candidates;

/// The items in the cells that the box touches.
template <>
class Candidates<Grid<2>> {
public:
    explicit Candidates(const Grid<2>& phase);
    /// Replaces `out`; each item is in it once.
    void of(const Aabb2& box, Items& out);

private:
    const Grid<2>& phase_;
    std::vector<std::uint32_t> seen_in_;  ///< of each item, the last call that had it
    std::uint32_t call_ = 0;
};

/// On each level, the items whose cells the box touches, or come before those.
template <>
class Candidates<LayeredGrid<2>> {
public:
    explicit Candidates(const LayeredGrid<2>& phase);
    void of(const Aabb2& box, Items& out) const;

private:
    struct Place {
        std::uint32_t level;
        std::int32_t row, column;
        std::uint32_t item;
        auto operator<=>(const Place&) const = default;
    };
    std::vector<Place> places_;  ///< sorted
    std::vector<std::uint32_t> levels_;
};

/// The items in the same columns that overlap the box along the axis.
template <>
class Candidates<SweepAndPrune<2>> {
public:
    explicit Candidates(const SweepAndPrune<2>& phase) : phase_(phase), seen_in_(phase.size()) {}
    void of(const Aabb2& box, Items& out);

private:
    const SweepAndPrune<2>& phase_;
    std::vector<std::uint32_t> seen_in_;
    std::uint32_t call_ = 0;
};

/// The items in leaves whose boxes overlap the box.
template <>
class Candidates<Bvh<2>> {
public:
    explicit Candidates(const Bvh<2>& phase) : phase_(phase) {}
    void of(const Aabb2& box, Items& out) const;

private:
    const Bvh<2>& phase_;
};

/// The items in leaves on the sides of the planes that the box reaches.
template <>
class Candidates<Bsp<2>> {
public:
    explicit Candidates(const Bsp<2>& phase) : phase_(phase) {}
    void of(const Aabb2& box, Items& out) const;

private:
    const Bsp<2>& phase_;
};

/// The time in steps before which nothing about an item can change; 0 where it may at once.
std::vector<float> not_before(const TemporalGrid& phase);

}  // namespace abut::play
