#include <abut/bake/parts/concavity.hpp>
#include <abut/bake/parts/merge_parts.hpp>
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
        for (std::uint32_t a = 0; a < parts_.size(); ++a)
            for (std::uint32_t b = a + 1; b < parts_.size(); ++b) consider(a, b);
        std::size_t count = parts_.size();
        while (!merges_.empty()) {
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
            for (std::uint32_t other = 0; other < last; ++other)
                if (alive_[other]) consider(other, last);
        }
        std::vector<MergePart> result;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (alive_[i]) result.push_back(std::move(parts_[i]));
        parts_ = std::move(result);
    }

private:
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
    std::vector<DVec<3>> points_of_both_;
};

}  // namespace

void merge_parts(std::vector<MergePart>& parts, std::size_t max_parts, const DistanceThreshold& threshold,
                 ApproximateHull& hull) {
    Merger(parts, threshold, hull).run(max_parts);
}

}  // namespace abut::detail
