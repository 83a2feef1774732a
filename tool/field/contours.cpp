#include "tool/field/contours.hpp"

#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The grid with a border of infinite heights around it, so that every contour is closed. Border samples coincide with
// the nearest samples of the grid. Edge numbers are three times the first sample's number plus 0 for the row, 1 for the
// column and 2 for the diagonal direction.
class PaddedGrid {
public:
    explicit PaddedGrid(const HeightGrid& grid) : grid_(grid), columns_(grid.columns + 2), rows_(grid.rows + 2) {}

    std::uint32_t columns() const { return columns_; }
    std::uint32_t rows() const { return rows_; }
    std::uint32_t number(std::uint32_t column, std::uint32_t row) const { return row * columns_ + column; }
    bool is_below(std::uint32_t sample, float level) const { return height(sample) < level; }

    /// The point at which the level crosses an edge.
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
    bool is_padding(std::uint32_t column, std::uint32_t row) const {
        return column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_;
    }
    float height(std::uint32_t sample) const {
        const std::uint32_t column = sample % columns_, row = sample / columns_;
        return is_padding(column, row) ? std::numeric_limits<float>::infinity() : grid_.at(column - 1, row - 1);
    }
    DVec<2> position(std::uint32_t sample) const {
        const std::uint32_t column = sample % columns_, row = sample / columns_;
        return {std::clamp(column, 1u, columns_ - 2) - 1.0, std::clamp(row, 1u, rows_ - 2) - 1.0};
    }

    const HeightGrid& grid_;
    std::uint32_t columns_, rows_;
};

// Connects the two crossed edges of a counter-clockwise triangle, with the region below the level on the left.
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

void add_squares(const PaddedGrid& grid, float level, std::vector<std::uint32_t>& next) {
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
    const double length = abut::detail::length(along);
    return length > 0 ? std::abs(cross(along, there)) / length : abut::detail::length(there);
}

// Greedy simplification: skips ahead from each vertex while all vertices skipped are within the tolerance of the line.
std::vector<Vec2> simplify(const std::vector<Vec2>& loop, double tolerance) {
    constexpr std::size_t max_skipped = 64;
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < loop.size();) {
        result.push_back(loop[i]);
        std::size_t ahead = i + 1;
        const auto is_straight = [&](std::size_t last) {
            for (std::size_t k = i + 1; k < last; ++k)
                if (distance_to_line(loop[k], loop[i], loop[last]) > tolerance) return false;
            return true;
        };
        while (ahead + 1 < loop.size() && ahead < i + max_skipped && is_straight(ahead + 1)) ++ahead;
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
    const PaddedGrid padded(grid);
    std::vector<Contour> result;
    std::vector<std::uint32_t> next;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        next.assign(std::size_t{3} * padded.columns() * padded.rows(), none);
        add_squares(padded, levels[level], next);
        for (std::uint32_t first = 0; first < next.size(); ++first) {
            std::vector<Vec2> loop;
            for (std::uint32_t edge = first; next[edge] != none;) {
                const Vec2 corner = padded.crossing(edge, levels[level]);
                if (loop.empty() || corner != loop.back()) loop.push_back(corner);
                edge = std::exchange(next[edge], none);
            }
            if (loop.size() < 3) continue;
            const double area = area_of(loop);
            std::vector<Vec2> vertices = simplify(loop, tolerance);
            if (vertices.size() >= 3 && area != 0) result.push_back({level, std::move(vertices), area});
        }
    }
    // Contours along the grid's boundary may have equal areas: the region below the higher level is drawn first.
    std::stable_sort(result.begin(), result.end(), [](const Contour& a, const Contour& b) {
        if (std::abs(a.area) != std::abs(b.area)) return std::abs(a.area) > std::abs(b.area);
        return a.area > 0 ? a.level > b.level : a.level < b.level;
    });
    return result;
}

}  // namespace abut::tool
