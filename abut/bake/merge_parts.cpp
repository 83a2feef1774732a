#include <abut/bake/gaps.hpp>
#include <abut/bake/merge_parts.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

namespace abut {
namespace {

constexpr double roughness = 1e-3;

/// What a hull of two lumps turns on.
struct Shell {
    std::vector<DVec<3>> corners;
    DVec<3> least, greatest;
};

struct Join {
    double cost;
    std::uint32_t a, b;

    bool operator<(const Join& other) const { return std::tie(cost, a, b) < std::tie(other.cost, other.a, other.b); }
};

class Merger {
public:
    Merger(std::vector<Lump>& lumps, const GapSearch& search, RoughHull& hull)
        : lumps_(lumps), search_(search), hull_(hull), alive_(lumps.size(), true) {
        for (const Lump& lump : lumps) {
            hull_.build(lump.points, roughness);
            add_shell(lump.points);
        }
    }

    void run(std::size_t most) {
        const double enough = length_as_volume(search_.enough);
        for (std::uint32_t a = 0; a < lumps_.size(); ++a)
            for (std::uint32_t b = a + 1; b < lumps_.size(); ++b) consider(a, b);
        std::size_t count = lumps_.size();
        while (!joins_.empty()) {
            const Join best = *joins_.begin();
            joins_.erase(joins_.begin());
            if (!alive_[best.a] || !alive_[best.b]) continue;
            const bool needed = count > most;
            if (!needed && (lumps_[best.a].whole || lumps_[best.b].whole)) continue;
            const double solid = lumps_[best.a].volume + lumps_[best.b].volume;
            if (!needed && best.cost + lumps_[best.a].hull_volume + lumps_[best.b].hull_volume - solid > enough)
                continue;
            Lump lump = joined(best.a, best.b);
            if (!needed && lump.gap > search_.enough) continue;
            alive_[best.a] = alive_[best.b] = false;
            hull_.build(lump.points, roughness);
            add_shell(lump.points);
            lumps_.push_back(std::move(lump));
            alive_.push_back(true);
            --count;
            const auto last = static_cast<std::uint32_t>(lumps_.size() - 1);
            for (std::uint32_t other = 0; other < last; ++other)
                if (alive_[other]) consider(other, last);
        }
        std::vector<Lump> result;
        for (std::size_t i = 0; i < lumps_.size(); ++i)
            if (alive_[i]) result.push_back(std::move(lumps_[i]));
        lumps_ = std::move(result);
    }

private:
    void add_shell(const std::vector<DVec<3>>& points) {
        Shell shell{{}, points.front(), points.front()};
        for (const std::uint32_t corner : hull_.corners()) {
            const DVec<3>& p = shell.corners.emplace_back(points[corner]);
            for (int i = 0; i < 3; ++i) {
                shell.least[i] = std::min(shell.least[i], p[i]);
                shell.greatest[i] = std::max(shell.greatest[i], p[i]);
            }
        }
        shells_.push_back(std::move(shell));
    }

    void build_both(std::uint32_t a, std::uint32_t b) {
        both_ = shells_[a].corners;
        both_.insert(both_.end(), shells_[b].corners.begin(), shells_[b].corners.end());
        hull_.build(both_, roughness);
    }

    double size_of_both(std::uint32_t a, std::uint32_t b) const {
        return hull_.volume() + std::max(lumps_[a].thickness, lumps_[b].thickness) * hull_.area() / 2;
    }

    void consider(std::uint32_t a, std::uint32_t b) {
        build_both(a, b);
        joins_.insert({size_of_both(a, b) - lumps_[a].hull_volume - lumps_[b].hull_volume, a, b});
    }

    Lump joined(std::uint32_t a, std::uint32_t b) {
        const Lump &first = lumps_[a], &second = lumps_[b];
        Lump result;
        result.points = first.points;
        result.points.insert(result.points.end(), second.points.begin(), second.points.end());
        result.volume = first.volume + second.volume;
        result.thickness = std::max(first.thickness, second.thickness);
        build_both(a, b);
        result.hull_volume = size_of_both(a, b);
        const HullSides sides = coarse_sides(both_, hull_);
        result.gap = std::max(first.gap, second.gap);
        // Gaps add up, which is more than they are: half as exact is as good.
        const double left = std::max(0.0, search_.enough - result.gap);
        result.gap += farthest_from(coarse_sides(shells_[a].corners, hull_), coarse_sides(shells_[b].corners, hull_),
                                    sides, {left, std::max(search_.precision, 0.5 * search_.enough)});
        return result;
    }

    std::vector<Lump>& lumps_;
    GapSearch search_;
    RoughHull& hull_;
    std::vector<bool> alive_;
    std::vector<Shell> shells_;
    std::set<Join> joins_;
    std::vector<DVec<3>> both_;
};

}  // namespace

void merge_parts(std::vector<Lump>& lumps, std::size_t most, const GapSearch& search, RoughHull& hull) {
    Merger(lumps, search, hull).run(most);
}

}  // namespace abut
