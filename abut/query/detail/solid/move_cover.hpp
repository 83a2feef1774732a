#pragma once

// Sets of moves at which two solids are known to overlap, which show quickly that a direction isn't better. For .cpp
// files.

#include <abut/query/detail/solid/slide_interval.hpp>

#include <array>
#include <cstddef>

namespace abut::detail {

/// Refers to the two solids.
class MoveCover {
public:
    MoveCover(const PlacedSolid& a, const PlacedSolid& b) : a_(a), b_(b) {}

    /// Adds the moves that bring a ball inside B to a ball inside A. The balls are found by rays through the shapes.
    void add_balls(const View<3>& shape_a, const View<3>& shape_b);
    /// Adds the moves at which two triangles cross.
    void add_pair(std::uint32_t triangle_a, std::uint32_t triangle_b);

    /// No shorter move parts the solids.
    double min_distance() const { return min_distance_; }

    /// Goes on along a direction as long as a set contains the move, at least by `step`, or up to the limit. Sets the
    /// normal of the last plane.
    void leave(const DVec<3>& direction, double step, double limit, double& distance, DVec<3>& normal) const;
    /// Whether a set contains the move.
    bool has_ball_at(const DVec<3>& move) const;

private:
    /// A ball of moves, or the pair of triangles whose moves are in it.
    struct Ball {
        DVec<3> center{0.0};
        double radius = 0;
    };
    struct TrianglePair {
        std::uint32_t a, b;
    };

    static constexpr std::size_t max_inner = 20;  ///< balls inside of each solid
    static constexpr std::size_t max_pairs = 256;

    const PlacedSolid &a_, &b_;
    std::array<Ball, max_inner * max_inner> balls_;
    std::size_t ball_count_ = 0;
    std::array<Ball, max_pairs> around_pairs_;
    std::array<TrianglePair, max_pairs> pairs_;
    std::size_t pair_count_ = 0, next_pair_ = 0;
    double min_distance_ = 0;
};

}  // namespace abut::detail
