#pragma once

// Boxes of very different sizes, most of them in a few clusters of a large world: the worst case for uniform grids.

#include "../test/oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace abut::scenes {

/// 90 % of the boxes are in ten dense clusters, separate cubes in which a box overlaps 6 or 7 others. The rest lie on
/// the ground, a flat slab below, and overlap 1 or 2. Edges are from 0.1 to 10, evenly distributed over orders of
/// magnitude. Each box moves by at most 0.1 per frame along each axis, and its centre turns back at the border of its
/// region. Every coordinate is a multiple of 1/1024.
template <int D>
class SkewedBoxes {
public:
    SkewedBoxes(std::size_t count, std::uint64_t seed) : boxes_(count), velocities_(count), homes_(count) {
        oracle::Random random(seed);
        const std::array<double, size_count> sizes = all_sizes();
        place_regions(mean_overlap_volume(sizes) * static_cast<double>(count), random);
        for (std::size_t item = 0; item < count; ++item) {
            homes_[item] = random.chance(cluster_fraction) ? 1 + random.below(cluster_count) : 0;
            const Aabb<D>& home = regions_[homes_[item]];
            const double size = sizes[random.below(size_count)];
            for (int i = 0; i < D; ++i) {
                const float half = on_grid(0.5 * size * random.uniform(min_aspect, 1));
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
    static constexpr std::uint32_t cluster_count = 10;
    static constexpr double cluster_fraction = 0.9, overlaps_in_cluster = 7, overlaps_on_ground = 2;
    static constexpr double world = 6;  ///< edge of the world in edges of a cluster
    // A box's size is the maximum of its edges, and each edge is at least half of it.
    static constexpr double min_aspect = 0.5, min_size = 0.2, next_size = 1.063;
    static constexpr std::uint32_t size_count = 65;  ///< the last one is 10

    static std::array<double, size_count> all_sizes() {
        std::array<double, size_count> result;
        result[0] = min_size;
        for (std::uint32_t i = 1; i < size_count; ++i) result[i] = result[i - 1] * next_size;
        return result;
    }
    /// The volume of relative positions at which two boxes overlap: their centres differ by at most half the sum of
    /// their edges. The mean over all pairs.
    static double mean_overlap_volume(const std::array<double, size_count>& sizes) {
        double sum = 0;
        for (const double a : sizes)
            for (const double b : sizes) sum += power((a + b) * 0.5 * (1 + min_aspect));
        return sum / (size_count * size_count);
    }

    /// The regions: the ground first, then the clusters.
    void place_regions(double overlap_volume, oracle::Random& random) {
        double edge = 1;
        while (power(edge) < overlap_volume * cluster_fraction / cluster_count / overlaps_in_cluster) edge += 0.5;
        const double wide = world * edge;
        const double depth = overlap_volume * (1 - cluster_fraction) / overlaps_on_ground / (power(wide) / wide);
        Aabb<D>& ground = regions_[0];
        ground.min = Vec<D>(0);
        ground.max = Vec<D>(static_cast<float>(wide));
        ground.min[D - 1] = -on_grid(depth);
        ground.max[D - 1] = 0;
        for (std::uint32_t cloud = 1; cloud <= cluster_count;) {
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
    std::array<Aabb<D>, 1 + cluster_count> regions_;
    std::vector<std::uint32_t> homes_;
};

}  // namespace abut::scenes
