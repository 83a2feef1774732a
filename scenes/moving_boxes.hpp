#pragma once

// Boxes that move and bounce off the walls of their world, as game objects do: frames are coherent, and after many
// frames every box has moved far.

#include "../test/oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace abut::scenes {

struct MovingBoxesOptions {
    double overlaps = 2;           ///< mean number of overlaps per box
    std::size_t one_in_moves = 1;  ///< the first of every so many boxes moves, the others rest
    double speed = 0.1;            ///< maximum per frame along each axis
    double fineness = 1024;        ///< coordinates and steps are multiples of the reciprocal of this power of two
};

/// Edges from 0.5 to 2, motion of at most 0.1 per frame along each axis, and about one overlapping pair per box by
/// default. Every coordinate is a multiple of 1/1024, so that no library rounds a box and all libraries find the same
/// pairs.
template <int D>
class MovingBoxes {
public:
    MovingBoxes(std::size_t count, std::uint64_t seed, const MovingBoxesOptions& options = {})
        : fineness_(options.fineness), boxes_(count), velocities_(count) {
        // A box overlaps boxes whose centres lie in a box of edge 2.5, two mean edges.
        const double volume = power(2.5) * static_cast<double>(count) / options.overlaps;
        while (power(side_) < volume) ++side_;
        oracle::Random random(seed);
        for (std::size_t item = 0; item < count; ++item) {
            for (int i = 0; i < D; ++i) {
                const float half = on_grid(random.uniform(0.25, 1));
                const float center = on_grid(random.uniform(half, side_ - half));
                boxes_[item].min[i] = center - half;
                boxes_[item].max[i] = center + half;
                velocities_[item][i] = on_grid(random.uniform(-options.speed, options.speed));
            }
            if (item % options.one_in_moves != 0) velocities_[item] = {};
        }
    }

    std::span<const Aabb<D>> boxes() const { return boxes_; }
    /// The motion of each box in the last step.
    std::span<const Vec<D>> last_steps() const { return velocities_; }
    /// The world is a cube from 0 to this, exceeded only by boxes that have just hit a wall.
    float side() const { return side_; }

    void step() {
        for (std::size_t item = 0; item < boxes_.size(); ++item) {
            Aabb<D>& box = boxes_[item];
            Vec<D>& velocity = velocities_[item];
            for (int i = 0; i < D; ++i)
                if ((box.min[i] < 0 && velocity[i] < 0) || (box.max[i] > side_ && velocity[i] > 0))
                    velocity[i] = -velocity[i];
            box.min += velocity;
            box.max += velocity;
        }
    }

private:
    static double power(double x) { return D == 2 ? x * x : x * x * x; }
    float on_grid(double x) const { return static_cast<float>(std::floor(x * fineness_) / fineness_); }

    double fineness_;
    float side_ = 2;
    std::vector<Aabb<D>> boxes_;
    std::vector<Vec<D>> velocities_;
};

}  // namespace abut::scenes
