// Approximate convex decomposition of a polygon, bottom-up. Lien and Amato: "Approximate convex decomposition of
// polygons" (2006).

#include <abut/bake/outline/partition.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>

namespace abut::outline {

using namespace detail;

namespace {

double distance_to_line(const Vec2& p, const Vec2& from, const Vec2& to) {
    const DVec<2> along = DVec<2>(to) - DVec<2>(from);
    return std::abs(cross(along, DVec<2>(p) - DVec<2>(from))) / length(along);
}

/// The concavity of a loop: the largest distance of a corner from the hull edge that bridges it.
double concavity_of(std::span<const Vec2> loop) {
    std::vector<std::uint32_t> hull = hull_loop(loop);
    std::ranges::sort(hull);
    double result = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const std::uint32_t from = hull[i], to = hull[i + 1 == hull.size() ? 0 : i + 1];
        const auto size = static_cast<std::uint32_t>(loop.size());
        for (std::uint32_t corner = from + 1 == size ? 0 : from + 1; corner != to;
             corner = corner + 1 == size ? 0 : corner + 1)
            result = std::max(result, distance_to_line(loop[corner], loop[from], loop[to]));
    }
    return result;
}

class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parents_(count), changes_(count, 0) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }
    std::uint32_t of(std::uint32_t face) {
        while (parents_[face] != face) face = parents_[face] = parents_[parents_[face]];
        return face;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        parents_[b] = a;
        changes_[a] += changes_[b] + 1;
    }
    std::uint32_t changes(std::uint32_t face) const { return changes_[face]; }

private:
    std::vector<std::uint32_t> parents_, changes_;
};

}  // namespace

double Partition::depth_without(std::uint32_t half_edge) const {
    std::vector<Vec2> loop;
    for (const std::uint32_t edge : {half_edge, twins_[half_edge]})
        for (std::uint32_t i = next_[edge]; i != edge; i = next_[i]) loop.push_back(at(i));
    return concavity_of(loop);
}

void Partition::merge_shallow(double concavity) {
    struct Candidate {
        double depth;
        std::uint32_t edge, changes;

        bool operator>(const Candidate& other) const {
            return std::tie(depth, edge) > std::tie(other.depth, other.edge);
        }
    };
    const FaceNumbers numbers = number_faces();
    UnionFind union_find(numbers.first.size());
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
    const auto consider = [&](std::uint32_t edge) {
        const std::uint32_t a = union_find.of(numbers.of[edge]), b = union_find.of(numbers.of[twins_[edge]]);
        if (a == b) return;
        const double depth = depth_without(edge);
        if (depth <= concavity) queue.push({depth, edge, union_find.changes(a) + union_find.changes(b)});
    };
    for (std::uint32_t edge = 0; edge < origins_.size(); ++edge)
        if (next_[edge] != no_index && twins_[edge] != no_index && edge < twins_[edge]) consider(edge);
    while (!queue.empty()) {
        const Candidate best = queue.top();
        queue.pop();
        const std::uint32_t a = union_find.of(numbers.of[best.edge]), b = union_find.of(numbers.of[twins_[best.edge]]);
        if (a == b) continue;
        if (union_find.changes(a) + union_find.changes(b) != best.changes) {
            consider(best.edge);
            continue;
        }
        remove(best.edge);
        union_find.unite(a, b);
    }
}

}  // namespace abut::outline
