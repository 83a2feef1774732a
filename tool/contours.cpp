#include "contours.hpp"

#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::tool {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The grid with a rim of places above every level around it, each where its nearest place of the grid is: so every line
// comes back to its beginning. An edge of its triangles is three times the number of its first place, and 0, 1, 2 for
// those that go on along the row, along the column, and across.
class Rimmed {
public:
    explicit Rimmed(const HeightGrid& grid) : grid_(grid), columns_(grid.columns + 2), rows_(grid.rows + 2) {}

    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    std::uint32_t number(std::uint32_t column, std::uint32_t row) const { return row * columns_ + column; }
    bool is_below(std::uint32_t place, float level) const { return height(place) < level; }

    /// Where the level crosses an edge.
    Vec2 crossing(std::uint32_t edge, float level) const {
        constexpr std::array<std::uint32_t, 3> right{1, 0, 1}, up{0, 1, 1};
        const std::uint32_t from = edge / 3, to = from + right[edge % 3] + up[edge % 3] * columns_;
        const DVec<2> a = position(from), b = position(to);
        const double first = static_cast<double>(height(from)), last = static_cast<double>(height(to));
        if (!std::isfinite(first)) return to_float(b);
        if (!std::isfinite(last)) return to_float(a);
        return to_float(a + (b - a) * ((static_cast<double>(level) - first) / (last - first)));
    }

private:
    bool is_rim(std::uint32_t column, std::uint32_t row) const {
        return column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_;
    }
    float height(std::uint32_t place) const {
        const std::uint32_t column = place % columns_, row = place / columns_;
        return is_rim(column, row) ? std::numeric_limits<float>::infinity() : grid_.at(column - 1, row - 1);
    }
    DVec<2> position(std::uint32_t place) const {
        const std::uint32_t column = place % columns_, row = place / columns_;
        return {std::clamp(column, 1u, columns_ - 2) - 1.0, std::clamp(row, 1u, rows_ - 2) - 1.0};
    }

    const HeightGrid& grid_;
    std::uint32_t columns_, rows_;
};

// Through a counter-clockwise triangle the line goes from the edge on which the border of the triangle leaves what is
// below to the one on which it enters it again, so that what is below is on its left.
void add_triangle(const std::array<bool, 3>& below, const std::array<std::uint32_t, 3>& edges,
                  std::vector<std::uint32_t>& next) {
    std::uint32_t leaves = none, enters = none;
    for (std::size_t i = 0; i < 3; ++i) {
        const bool now = below[i], then = below[(i + 1) % 3];
        if (now && !then) leaves = edges[i];
        if (!now && then) enters = edges[i];
    }
    if (leaves != none) next[leaves] = enters;
}

void add_squares(const Rimmed& grid, float level, std::vector<std::uint32_t>& next) {
    for (std::uint32_t row = 0; row + 1 < grid.rows(); ++row)
        for (std::uint32_t column = 0; column + 1 < grid.columns(); ++column) {
            const std::uint32_t a = grid.number(column, row), b = a + 1, d = a + grid.columns(), c = d + 1;
            const bool in_a = grid.is_below(a, level), in_b = grid.is_below(b, level), in_c = grid.is_below(c, level),
                       in_d = grid.is_below(d, level);
            if (in_a == in_b && in_b == in_c && in_c == in_d) continue;
            add_triangle({in_a, in_b, in_c}, {3 * a, 3 * b + 1, 3 * a + 2}, next);
            add_triangle({in_a, in_c, in_d}, {3 * a + 2, 3 * d, 3 * a + 1}, next);
        }
}

double distance_to_line(const Vec2& point, const Vec2& from, const Vec2& to) {
    const DVec<2> along = DVec<2>(to) - DVec<2>(from), there = DVec<2>(point) - DVec<2>(from);
    const double length = abut::length(along);
    return length > 0 ? std::abs(cross(along, there)) / length : abut::length(there);
}

// Each corner that is kept looks ahead as far as the line to there leaves out nothing.
std::vector<Vec2> simplified(const std::vector<Vec2>& loop, double tolerance) {
    constexpr std::size_t farthest = 64;
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < loop.size();) {
        result.push_back(loop[i]);
        std::size_t ahead = i + 1;
        const auto is_straight = [&](std::size_t last) {
            for (std::size_t k = i + 1; k < last; ++k)
                if (distance_to_line(loop[k], loop[i], loop[last]) > tolerance) return false;
            return true;
        };
        while (ahead + 1 < loop.size() && ahead < i + farthest && is_straight(ahead + 1)) ++ahead;
        i = ahead;
    }
    return result;
}

double area_of(const std::vector<Vec2>& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice += cross(DVec<2>(loop[i]), DVec<2>(loop[(i + 1) % loop.size()]));
    return 0.5 * twice;
}

}  // namespace

std::vector<Contour> contours(const HeightGrid& grid, std::span<const float> levels, double tolerance) {
    const Rimmed rimmed(grid);
    std::vector<Contour> result;
    std::vector<std::uint32_t> next;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        next.assign(std::size_t{3} * rimmed.columns() * rimmed.rows(), none);
        add_squares(rimmed, levels[level], next);
        for (std::uint32_t first = 0; first < next.size(); ++first) {
            std::vector<Vec2> loop;
            for (std::uint32_t edge = first; next[edge] != none;) {
                const Vec2 corner = rimmed.crossing(edge, levels[level]);
                if (loop.empty() || corner != loop.back()) loop.push_back(corner);
                edge = std::exchange(next[edge], none);
            }
            if (loop.size() < 3) continue;
            const double area = area_of(loop);
            std::vector<Vec2> corners = simplified(loop, tolerance);
            if (corners.size() >= 3 && area != 0) result.push_back({level, std::move(corners), area});
        }
    }
    // Of one size may be those along the edge of the grid: then what is below the higher level is around the other.
    std::stable_sort(result.begin(), result.end(), [](const Contour& a, const Contour& b) {
        if (std::abs(a.area) != std::abs(b.area)) return std::abs(a.area) > std::abs(b.area);
        return a.area > 0 ? a.level > b.level : a.level < b.level;
    });
    return result;
}

}  // namespace abut::tool
