#pragma once

// Boxes of all sizes, most of them in a few crowds: what a uniform grid is bad at.

#include "../test/oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace abut::scenes {

/// Sizes of 0.1 to 10, as many of each power of two; the edges of a box are 0.7 to 1 of its size. Of ten boxes nine lie
/// in one of ten crowds, where each overlaps about eight others, and one lies anywhere, where it overlaps about two.
/// They drift at most 0.05 a frame along each axis, those of a crowd within its cube, so that the crowds stay. Every
/// coordinate is a multiple of 1/1024.
template <int D>
class SkewedBoxes {
public:
    SkewedBoxes(std::size_t count, std::uint64_t seed) : boxes_(count), velocities_(count), homes_(count) {
        oracle::Random random(seed);
        const auto items = static_cast<double>(count);
        // A box overlaps those whose centres lie in a box of both their edges: for x and y as above that is the mean of
        // (x + y)^D.
        const double reached = D == 2 ? 22.4 : 175;
        const float crowd_side = side_of(reached * items * 0.09 / 8), world_side = side_of(reached * items * 0.1 / 2);
        std::array<Aabb<D>, crowds + 1> home;
        side_ = std::max(world_side, 3 * crowd_side);
        home[crowds] = {Vec<D>(0), Vec<D>(side_)};
        for (std::size_t k = 0; k < crowds; ++k)
            for (int i = 0; i < D; ++i) {
                home[k].min[i] = on_grid(random.uniform(0, side_ - crowd_side));
                home[k].max[i] = home[k].min[i] + crowd_side;
            }
        for (std::size_t item = 0; item < count; ++item) {
            homes_[item] = home[random.chance(0.9) ? random.below(crowds) : crowds];
            const double size = some_size(random);
            for (int i = 0; i < D; ++i) {
                const float half = on_grid(0.5 * size * random.uniform(0.7, 1));
                const float low = homes_[item].min[i], high = homes_[item].max[i];
                const float center = on_grid(random.uniform(low, high));
                boxes_[item].min[i] = center - half;
                boxes_[item].max[i] = center + half;
                velocities_[item][i] = on_grid(random.uniform(-0.05, 0.05));
            }
        }
    }

    std::span<const Aabb<D>> boxes() const { return boxes_; }
    /// How far each has moved in the last step.
    std::span<const Vec<D>> last_steps() const { return velocities_; }
    /// The middles of the boxes lie in a cube from 0 to here.
    float side() const { return side_; }

    void step() {
        for (std::size_t item = 0; item < boxes_.size(); ++item) {
            Aabb<D>& box = boxes_[item];
            Vec<D>& velocity = velocities_[item];
            const Aabb<D>& home = homes_[item];
            for (int i = 0; i < D; ++i) {
                const float twice = box.min[i] + box.max[i];
                if ((twice < 2 * home.min[i] && velocity[i] < 0) || (twice > 2 * home.max[i] && velocity[i] > 0))
                    velocity[i] = -velocity[i];
            }
            box.min += velocity;
            box.max += velocity;
        }
    }

private:
    static constexpr std::uint32_t crowds = 10;

    /// From 0.1 to 10, evenly in the logarithm; by products alone, which are the same on every machine.
    static double some_size(oracle::Random& random) {
        constexpr double step = 1.0366329284376980;  // 100^(1/128)
        double result = 0.1 * random.uniform(1, step);
        for (std::uint32_t i = random.below(128); i > 0; --i) result *= step;
        return result;
    }
    static float side_of(double volume) {
        float side = 2;
        while ((D == 2 ? side * side : side * side * side) < static_cast<float>(volume)) ++side;
        return side;
    }
    static float on_grid(double x) { return static_cast<float>(std::floor(x * 1024) / 1024); }

    float side_ = 2;
    std::vector<Aabb<D>> boxes_;
    std::vector<Vec<D>> velocities_;
    std::vector<Aabb<D>> homes_;
};

}  // namespace abut::scenes
