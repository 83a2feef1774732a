#pragma once

// Boxes of very different sizes, most of them crowded in a few places of a wide world: what a grid of one cell size, or
// of cells all over the world, is worst at.

#include "../test/oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace abut::scenes {

/// Nine in ten boxes hang in ten dense clouds, cubes that lie apart, where a box overlaps 6 or 7 others. The rest lie
/// on the ground, a wide flat slab below, and overlap 1 or 2. Edges from 0.1 to 10, as many of each order of size.
/// Each moves by at most 0.1 a frame along each axis, and its centre turns back at the border of its region. Every
/// coordinate is a multiple of 1/1024.
template <int D>
class SkewedBoxes {
public:
    SkewedBoxes(std::size_t count, std::uint64_t seed) : boxes_(count), velocities_(count), homes_(count) {
        oracle::Random random(seed);
        const std::array<double, size_count> sizes = all_sizes();
        place_regions(mean_overlap_volume(sizes) * static_cast<double>(count), random);
        for (std::size_t item = 0; item < count; ++item) {
            homes_[item] = random.chance(in_clouds) ? 1 + random.below(cloud_count) : 0;
            const Aabb<D>& home = regions_[homes_[item]];
            const double size = sizes[random.below(size_count)];
            for (int i = 0; i < D; ++i) {
                const float half = on_grid(0.5 * size * random.uniform(thinnest, 1));
                const float center = on_grid(random.uniform_float(home.min[i], home.max[i]));
                boxes_[item].min[i] = center - half;
                boxes_[item].max[i] = center + half;
                velocities_[item][i] = on_grid(random.uniform(-0.1, 0.1));
            }
        }
    }

    std::span<const Aabb<D>> boxes() const { return boxes_; }

    void step() {
        for (std::size_t item = 0; item < boxes_.size(); ++item) {
            Aabb<D>& box = boxes_[item];
            Vec<D>& velocity = velocities_[item];
            const Aabb<D>& home = regions_[homes_[item]];
            for (int i = 0; i < D; ++i) {
                const float center = 0.5f * (box.min[i] + box.max[i]);
                if ((center < home.min[i] && velocity[i] < 0) || (center > home.max[i] && velocity[i] > 0))
                    velocity[i] = -velocity[i];
            }
            box.min += velocity;
            box.max += velocity;
        }
    }

private:
    static constexpr std::uint32_t cloud_count = 10;
    static constexpr double in_clouds = 0.9, overlaps_in_cloud = 7, overlaps_on_ground = 2;
    static constexpr double world = 6;  ///< its edge, in those of a cloud
    // A box's size is the most that its edges may be, and each is at least half of it.
    static constexpr double thinnest = 0.5, least_size = 0.2, next_size = 1.063;
    static constexpr std::uint32_t size_count = 65;  ///< the last one is 10

    static std::array<double, size_count> all_sizes() {
        std::array<double, size_count> result;
        result[0] = least_size;
        for (std::uint32_t i = 1; i < size_count; ++i) result[i] = result[i - 1] * next_size;
        return result;
    }
    /// Two boxes overlap where their centres are no farther apart than half the sum of their edges: the mean volume of
    /// that place.
    static double mean_overlap_volume(const std::array<double, size_count>& sizes) {
        double sum = 0;
        for (const double a : sizes)
            for (const double b : sizes) sum += power((a + b) * 0.5 * (1 + thinnest));
        return sum / (size_count * size_count);
    }

    /// The ground is the first.
    void place_regions(double overlap_volume, oracle::Random& random) {
        double edge = 1;
        while (power(edge) < overlap_volume * in_clouds / cloud_count / overlaps_in_cloud) edge += 0.5;
        const double wide = world * edge;
        const double depth = overlap_volume * (1 - in_clouds) / overlaps_on_ground / (power(wide) / wide);
        Aabb<D>& ground = regions_[0];
        ground.min = Vec<D>(0);
        ground.max = Vec<D>(static_cast<float>(wide));
        ground.min[D - 1] = -on_grid(depth);
        ground.max[D - 1] = 0;
        for (std::uint32_t cloud = 1; cloud <= cloud_count;) {
            Aabb<D>& box = regions_[cloud];
            for (int i = 0; i < D; ++i) {
                box.min[i] = on_grid(random.uniform(0, wide - edge));
                box.max[i] = box.min[i] + static_cast<float>(edge);
            }
            bool apart = true;
            for (std::uint32_t other = 1; other < cloud; ++other) apart = apart && !overlaps(box, regions_[other]);
            if (apart) ++cloud;
        }
    }

    static double power(double x) { return D == 2 ? x * x : x * x * x; }
    static float on_grid(double x) { return static_cast<float>(std::floor(x * 1024) / 1024); }

    std::vector<Aabb<D>> boxes_;
    std::vector<Vec<D>> velocities_;
    std::array<Aabb<D>, 1 + cloud_count> regions_;
    std::vector<std::uint32_t> homes_;
};

}  // namespace abut::scenes
