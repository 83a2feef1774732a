#include <abut/draw/convex.hpp>
#include <abut/draw/distance_function.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/shape/view/view.hpp>

#include <array>
#include <vector>

namespace abut::detail {
namespace {

/// Cells along the longest side.
template <int D>
constexpr int max_cells = D == 2 ? 64 : 24;

template <int D>
struct Corner {
    DVec<D> point;
    double distance;
};

/// The axis orders of Kuhn's simplices: each is a path from a cell's lowest corner to its highest, one axis at a time
/// (Kuhn, "Some combinatorial lemmas in topology", 1960). Neighbouring cells are cut consistently.
template <int D>
constexpr auto orders() {
    if constexpr (D == 2)
        return std::array<std::array<int, 2>, 2>{{{0, 1}, {1, 0}}};
    else
        return std::array<std::array<int, 3>, 6>{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
}

template <int D>
Vec<D> zero_crossing(const Corner<D>& a, const Corner<D>& b) {
    const double fraction = a.distance / (a.distance - b.distance);
    return to_float(a.point + (b.point - a.point) * fraction);
}

template <int D>
using Simplex = std::array<Corner<D>, static_cast<std::size_t>(D) + 1>;

/// A stable partition: inside corners first. Returns their number.
template <int D>
std::size_t sort_by_side(Simplex<D>& simplex) {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
        if (!(simplex[i].distance <= 0)) continue;
        for (std::size_t j = i; j > inside; --j) std::swap(simplex[j], simplex[j - 1]);
        ++inside;
    }
    return inside;
}

void draw_simplex(Canvas<2>& canvas, Simplex<2> simplex, const Style& style) {
    const std::size_t inside = sort_by_side<2>(simplex);
    if (inside == 0) return;
    std::vector<Vec2> area;
    if (inside == 3) {
        for (const Corner<2>& corner : simplex) area.push_back(to_float(corner.point));
    } else if (inside == 1) {
        area = {to_float(simplex[0].point), zero_crossing(simplex[0], simplex[1]),
                zero_crossing(simplex[0], simplex[2])};
    } else {
        area = {to_float(simplex[0].point), to_float(simplex[1].point), zero_crossing(simplex[1], simplex[2]),
                zero_crossing(simplex[0], simplex[2])};
    }
    if (style.fill.visible()) canvas.polygon(area, fill_only(style));
    if (inside < 3) canvas.line(area[inside], area[inside + 1], style);
}

void draw_simplex(Canvas<3>& canvas, Simplex<3> simplex, const Style& style) {
    const std::size_t inside = sort_by_side<3>(simplex);
    if (inside == 0 || inside == 4) return;
    std::vector<Vec3> face;
    if (inside == 2) {
        face = {zero_crossing(simplex[0], simplex[2]), zero_crossing(simplex[0], simplex[3]),
                zero_crossing(simplex[1], simplex[3]), zero_crossing(simplex[1], simplex[2])};
    } else {
        const std::size_t apex = inside == 1 ? 0 : 3;
        for (std::size_t i = 0; i < 4; ++i)
            if (i != apex) face.push_back(zero_crossing(simplex[apex], simplex[i]));
    }
    canvas.polygon(face, style);
}

}  // namespace

template <int D>
void draw_function(Canvas<D>& canvas, const DistanceFunction<D>& function, const Style& style) {
    const Aabb<D> shown = canvas.shown(), all = bounds(function);
    DVec<D> low, side;
    double longest = 0;
    for (int i = 0; i < D; ++i) {
        low[i] = static_cast<double>(std::max(shown.min[i], all.min[i]));
        side[i] = static_cast<double>(std::min(shown.max[i], all.max[i])) - low[i];
        if (!(side[i] >= 0)) return;
        longest = std::max(longest, side[i]);
    }
    if (!(longest > 0) || !std::isfinite(longest)) return;
    // The grid extends half a cell beyond the box on every side, so surfaces that touch it have samples on both sides.
    const double cell = longest / max_cells<D>;
    glm::vec<D, int> cells;
    for (int i = 0; i < D; ++i) {
        cells[i] = static_cast<int>(side[i] / cell) + 2;
        low[i] -= 0.5 * (cells[i] * cell - side[i]);
    }
    const PlacedFunction<D> function_view(function);
    const double reach = function_view.slope() * square_root(static_cast<double>(D)) * cell;
    glm::vec<D, int> at(0);
    for (;;) {
        DVec<D> corner = low;
        for (int i = 0; i < D; ++i) corner[i] += at[i] * cell;
        if (std::abs(function_view.at(corner)) <= reach || (D == 2 && style.fill.visible())) {
            for (const auto& order : orders<D>()) {
                Simplex<D> simplex;
                DVec<D> point = corner;
                simplex[0] = {point, function_view.at(point)};
                for (std::size_t i = 0; i < order.size(); ++i) {
                    point[order[i]] += cell;
                    simplex[i + 1] = {point, function_view.at(point)};
                }
                draw_simplex(canvas, simplex, style);
            }
        }
        int axis = 0;
        while (axis < D && ++at[axis] == cells[axis]) at[axis++] = 0;
        if (axis == D) return;
    }
}

template void draw_function(Canvas<2>&, const DistanceFunction<2>&, const Style&);
template void draw_function(Canvas<3>&, const DistanceFunction<3>&, const Style&);

}  // namespace abut::detail
