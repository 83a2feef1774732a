#include <abut/math/detail/coincident.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace abut {

using namespace detail;

namespace {

/// A cell of a uniform hash grid, by its integer coordinates.
using Cell = std::array<double, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const double coordinate : cell) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// A hash grid of points that are more than `distance` apart; the cell edge is as long, so a cell holds few.
class PointGrid {
public:
    PointGrid(std::span<const Vec3> points, double distance)
        : points_(points),
          distance_(distance),
          edge_(std::max(1.0001 * distance, min_edge)),
          next_(points.size(), no_index) {}

    /// The nearest point within the distance, the first of equals; `none` if there is none.
    std::uint32_t nearest(std::uint32_t point) const {
        const DVec<3> at(points_[point]);
        const Cell middle = cell_of(at);
        std::uint32_t best = no_index;
        double best_distance = 0;
        for (int i = 0; i < 27; ++i) {
            const auto found =
                first_.find({middle[0] + (i % 3 - 1), middle[1] + (i / 3 % 3 - 1), middle[2] + (i / 9 - 1)});
            if (found == first_.end()) continue;
            for (std::uint32_t other = found->second; other != no_index; other = next_[other]) {
                const double gap = length(DVec<3>(points_[other]) - at);
                if (gap > distance_ || (best != no_index && std::tie(best_distance, best) <= std::tie(gap, other)))
                    continue;
                best = other;
                best_distance = gap;
            }
        }
        return best;
    }

    void insert(std::uint32_t point) {
        const auto [place, is_new] = first_.try_emplace(cell_of(DVec<3>(points_[point])), point);
        if (is_new) return;
        next_[point] = place->second;
        place->second = point;
    }

private:
    // No two floats are nearer than this, and no float divided by it is infinite.
    static constexpr double min_edge = 1e-50;

    Cell cell_of(const DVec<3>& p) const {
        return {std::floor(p.x / edge_), std::floor(p.y / edge_), std::floor(p.z / edge_)};
    }

    std::span<const Vec3> points_;
    double distance_, edge_;
    std::unordered_map<Cell, std::uint32_t, CellHash> first_;
    std::vector<std::uint32_t> next_;  // linked list of the points in the same cell
};

std::vector<std::uint32_t> representatives(std::span<const Vec3> points, double distance) {
    std::vector<std::uint32_t> result = first_coincident(points);
    if (distance == 0) return result;
    PointGrid grid(points, distance);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (result[i] != i) {
            result[i] = result[result[i]];
            continue;
        }
        const std::uint32_t nearest = grid.nearest(i);
        if (nearest == no_index)
            grid.insert(i);
        else
            result[i] = nearest;
    }
    return result;
}

}  // namespace

Welded weld(const PointSpan<3>& points, std::span<const glm::uvec3> triangles) {
    return weld(points, triangles, 0);
}

Welded weld(const PointSpan<3>& given, std::span<const glm::uvec3> triangles, double distance) {
    const PackedPoints<3> packed(given);
    const std::span<const Vec3> points = packed.points();
    const std::vector<std::uint32_t> representative = representatives(points, distance);
    std::vector<std::uint32_t> number(points.size(), no_index);
    Welded result;
    const auto use = [&](std::uint32_t corner) {
        const std::uint32_t point = representative[corner];
        if (number[point] == no_index) {
            number[point] = static_cast<std::uint32_t>(result.points.size());
            result.points.push_back(points[point] + Vec3(0.0f));
        }
        return number[point];
    };
    result.triangles.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        const std::uint32_t a = representative[t.x];
        const std::uint32_t b = representative[t.y];
        const std::uint32_t c = representative[t.z];
        if (a != b && b != c && c != a) result.triangles.push_back(glm::uvec3{use(a), use(b), use(c)});
    }
    return result;
}

}  // namespace abut
