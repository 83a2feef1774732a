#include <abut/bake/parts/concavity.hpp>
#include <abut/bake/parts/merge_parts.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/k_nearest.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

namespace abut::detail {
namespace {

constexpr double merged_hull_tolerance = 1e-3;

/// The vertices and bounds of a part's hull.
struct PartHull {
    std::vector<DVec<3>> corners;
    DVec<3> min, max;
};

struct Merge {
    double cost;
    std::uint32_t a, b;

    bool operator<(const Merge& other) const { return std::tie(cost, a, b) < std::tie(other.cost, other.a, other.b); }
};

class Merger {
public:
    Merger(std::vector<MergePart>& parts, const DistanceThreshold& threshold, ApproximateHull& hull)
        : parts_(parts), threshold_(threshold), hull_(hull), alive_(parts.size(), true) {
        for (const MergePart& part : parts) {
            hull_.build(part.points, merged_hull_tolerance);
            add_part_hull(part.points);
        }
    }

    void run(std::size_t max_parts) {
        const double limit = length_as_volume(threshold_.limit);
        std::size_t count = parts_.size();
        bool has_all_pairs = count <= max_for_all_pairs;
        has_all_pairs ? consider_all() : consider_nearest();
        for (;;) {
            // With few parts left, or no neighbours, others count as well.
            if (!has_all_pairs && count <= max_for_all_pairs) {
                has_all_pairs = true;
                merges_.clear();
                consider_all();
            }
            if (merges_.empty() && !has_all_pairs && count > max_parts) consider_nearest();
            if (merges_.empty()) break;
            const Merge best = *merges_.begin();
            merges_.erase(merges_.begin());
            if (!alive_[best.a] || !alive_[best.b]) continue;
            const bool needed = count > max_parts;
            if (!needed && (parts_[best.a].is_convex_component || parts_[best.b].is_convex_component)) continue;
            const double solid = parts_[best.a].volume + parts_[best.b].volume;
            if (!needed && best.cost + parts_[best.a].hull_volume + parts_[best.b].hull_volume - solid > limit)
                continue;
            MergePart part = merged(best.a, best.b);
            if (!needed && part.hull_distance > threshold_.limit) continue;
            alive_[best.a] = alive_[best.b] = false;
            hull_.build(part.points, merged_hull_tolerance);
            add_part_hull(part.points);
            parts_.push_back(std::move(part));
            alive_.push_back(true);
            --count;
            const auto last = static_cast<std::uint32_t>(parts_.size() - 1);
            if (has_all_pairs) {
                for (std::uint32_t other = 0; other < last; ++other)
                    if (alive_[other]) consider(other, last);
            } else {
                inherit_neighbours(best.a, best.b, last);
                for (const std::uint32_t other : neighbours_[last]) consider(other, last);
            }
        }
        std::vector<MergePart> result;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (alive_[i]) result.push_back(std::move(parts_[i]));
        parts_ = std::move(result);
    }

private:
    /// Above this number of parts only neighbours are merged: the time for all pairs is quadratic.
    static constexpr std::size_t max_for_all_pairs = 512;
    static constexpr std::size_t max_neighbours = 16;

    void consider_all() {
        for (std::uint32_t a = 0; a < parts_.size(); ++a)
            for (std::uint32_t b = a + 1; b < parts_.size(); ++b)
                if (alive_[a] && alive_[b]) consider(a, b);
    }

    DVec<3> center(std::uint32_t part) const { return (part_hulls_[part].min + part_hulls_[part].max) / 2.0; }

    /// Considers each part with those whose centres are nearest to its own.
    void consider_nearest() {
        std::vector<std::uint32_t> parts;
        std::vector<Aabb<3>> boxes;
        for (std::uint32_t i = 0; i < parts_.size(); ++i) {
            if (!alive_[i]) continue;
            parts.push_back(i);
            const Vec3 at = to_float(center(i));
            boxes.push_back({at, at});
        }
        neighbours_.assign(parts_.size(), {});
        merged_into_.resize(parts_.size());
        for (std::uint32_t i = 0; i < parts_.size(); ++i) merged_into_[i] = i;
        Bvh<3> tree;
        tree.build(boxes);
        std::vector<NearItem> nearest;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            k_nearest<3>(tree, boxes, boxes[i].min, max_neighbours + 1, nearest);
            for (const NearItem& found : nearest)
                if (found.item != i) neighbours_[parts[i]].push_back(parts[found.item]);
        }
        for (const std::uint32_t part : parts)
            for (const std::uint32_t other : neighbours_[part])
                if (part < other || !has_neighbour(other, part)) consider(std::min(part, other), std::max(part, other));
    }

    bool has_neighbour(std::uint32_t part, std::uint32_t other) const {
        return std::find(neighbours_[part].begin(), neighbours_[part].end(), other) != neighbours_[part].end();
    }

    /// The part that a part is in by now.
    std::uint32_t current(std::uint32_t part) {
        while (merged_into_[part] != part) part = merged_into_[part] = merged_into_[merged_into_[part]];
        return part;
    }

    /// The neighbours of a merged part are the nearest of those of both.
    void inherit_neighbours(std::uint32_t a, std::uint32_t b, std::uint32_t both) {
        merged_into_.push_back(both);
        merged_into_[a] = merged_into_[b] = both;
        std::vector<std::uint32_t> all;
        for (const std::uint32_t part : {a, b})
            for (const std::uint32_t neighbour : neighbours_[part])
                if (const std::uint32_t now = current(neighbour); now != both) all.push_back(now);
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        const DVec<3> middle = center(both);
        std::stable_sort(all.begin(), all.end(), [&](std::uint32_t p, std::uint32_t q) {
            return length_squared(center(p) - middle) < length_squared(center(q) - middle);
        });
        if (all.size() > max_neighbours) all.resize(max_neighbours);
        neighbours_.push_back(std::move(all));
    }

    void add_part_hull(const std::vector<DVec<3>>& points) {
        PartHull hull_of_part{{}, points.front(), points.front()};
        for (const std::uint32_t corner : hull_.corners()) {
            const DVec<3>& p = hull_of_part.corners.emplace_back(points[corner]);
            for (int i = 0; i < 3; ++i) {
                hull_of_part.min[i] = std::min(hull_of_part.min[i], p[i]);
                hull_of_part.max[i] = std::max(hull_of_part.max[i], p[i]);
            }
        }
        part_hulls_.push_back(std::move(hull_of_part));
    }

    void build_hull_of_both(std::uint32_t a, std::uint32_t b) {
        points_of_both_ = part_hulls_[a].corners;
        points_of_both_.insert(points_of_both_.end(), part_hulls_[b].corners.begin(), part_hulls_[b].corners.end());
        hull_.build(points_of_both_, merged_hull_tolerance);
    }

    double hull_size_of_both(std::uint32_t a, std::uint32_t b) const {
        return hull_.volume() + std::max(parts_[a].thickness, parts_[b].thickness) * hull_.area() / 2;
    }

    void consider(std::uint32_t a, std::uint32_t b) {
        build_hull_of_both(a, b);
        merges_.insert({hull_size_of_both(a, b) - parts_[a].hull_volume - parts_[b].hull_volume, a, b});
    }

    MergePart merged(std::uint32_t a, std::uint32_t b) {
        const MergePart &first = parts_[a], &second = parts_[b];
        MergePart result;
        result.points = first.points;
        result.points.insert(result.points.end(), second.points.begin(), second.points.end());
        result.volume = first.volume + second.volume;
        result.thickness = std::max(first.thickness, second.thickness);
        build_hull_of_both(a, b);
        result.hull_volume = hull_size_of_both(a, b);
        const HullSurface surface = approximate_hull_surface(points_of_both_, hull_);
        result.hull_distance = std::max(first.hull_distance, second.hull_distance);
        // The sum of hull distances is an upper bound, so half the precision is sufficient.
        const double remaining = std::max(0.0, threshold_.limit - result.hull_distance);
        result.hull_distance += farthest_distance(approximate_hull_surface(part_hulls_[a].corners, hull_),
                                                  approximate_hull_surface(part_hulls_[b].corners, hull_), surface,
                                                  {remaining, std::max(threshold_.precision, 0.5 * threshold_.limit)});
        return result;
    }

    std::vector<MergePart>& parts_;
    DistanceThreshold threshold_;
    ApproximateHull& hull_;
    std::vector<bool> alive_;
    std::vector<PartHull> part_hulls_;
    std::set<Merge> merges_;
    std::vector<std::vector<std::uint32_t>> neighbours_;  ///< of each part, if not all pairs are considered
    std::vector<std::uint32_t> merged_into_;
    std::vector<DVec<3>> points_of_both_;
};

}  // namespace

void merge_parts(std::vector<MergePart>& parts, std::size_t max_parts, const DistanceThreshold& threshold,
                 ApproximateHull& hull) {
    Merger(parts, threshold, hull).run(max_parts);
}

}  // namespace abut::detail
