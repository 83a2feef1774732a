#pragma once

// Moves of a solid B at which it surely overlaps a solid A: sets that rule out most moves and directions at once. For
// .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/shape/view/view.hpp>

#include <array>
#include <cstddef>

namespace abut::detail {

/// Balls of moves, and pairs of triangles, each of which stands for the moves at which the two cross. Refers to the two
/// solids.
class MoveCover {
public:
    MoveCover(const PlacedSolid& a, const PlacedSolid& b) : a_(a), b_(b) {}

    /// Adds the moves that bring a ball inside B to a ball inside A. The balls are found by rays through the shapes.
    void add_balls(const View<3>& shape_a, const View<3>& shape_b);
    /// Adds the moves at which two triangles cross.
    void add_pair(std::uint32_t triangle_a, std::uint32_t triangle_b);

    /// No shorter move parts the solids.
    double min_distance() const { return min_distance_; }

    /// How far balls contain the moves along all directions on the shorter arc between two: at least that far, or up to
    /// the limit, which seldom changes.
    double end_of_balls_between(const DVec<3>& first, const DVec<3>& last, double limit);

    /// Goes on along a direction as long as a set contains the move, at least by `step`, or up to the limit. Sets the
    /// normal of the last plane.
    void leave(const DVec<3>& direction, double step, double limit, double& distance, DVec<3>& normal);

    /// Whether a set contains the move.
    bool has_ball_at(const DVec<3>& move) const;
    bool has_pair_at(const DVec<3>& direction, double distance, double step);

private:
    /// A ball of moves, or the pair of triangles whose moves are in it.
    struct Ball {
        DVec<3> center{0.0};
        double radius = 0;
    };
    struct TrianglePair {
        std::uint32_t a, b;
        Ball around;
    };

    static constexpr std::size_t max_inner = 24;  ///< balls inside of each solid
    static constexpr std::size_t max_balls = max_inner * max_inner;
    static constexpr std::size_t max_pairs = 256;

    DVec<3> center(std::size_t ball) const { return {x_[ball], y_[ball], z_[ball]}; }
    bool is_in_ball(const DVec<3>& middle, double radius) const;
    /// Whether one ball contains the moves along all directions on an arc.
    bool has_ball_between(const DVec<3>& first, const DVec<3>& last, double limit);
    /// Sets the spans in which the balls, made smaller, contain moves along a direction.
    void set_spans(const DVec<3>& direction, double smaller = 0);
    double end_of_balls(double from, double step) const;

    /// A ball contains 0 and `limit * d` where dot(d, center) > min_along.
    struct Cap {
        std::uint32_t ball = 0;
        double min_along = 0;
    };

    const PlacedSolid &a_, &b_;
    // Balls: the centres, the radii, and the squared distances of 0 from the centres, less the squared radii.
    std::array<double, max_balls> x_, y_, z_, radius_, beyond_;
    std::size_t ball_count_ = 0;
    std::array<double, max_balls> from_, to_;  ///< the spans; empty for a ball that the line misses
    std::array<Cap, max_balls> caps_;
    std::size_t cap_count_ = 0;
    double limit_of_caps_ = 0;
    std::array<TrianglePair, max_pairs> pairs_;
    std::size_t pair_count_ = 0, next_pair_ = 0;
    double min_distance_ = 0;
};

}  // namespace abut::detail
