#include <abut/draw/convex.hpp>
#include <abut/draw/distance_function.hpp>
#include <abut/query/function_there.hpp>
#include <abut/shape/view.hpp>

#include <array>
#include <vector>

namespace abut {
namespace {

/// Cells along the longest side.
template <int D>
constexpr int most_cells = D == 2 ? 64 : 24;

template <int D>
struct Corner {
    DVec<D> point;
    double distance;
};

/// A cell is cut into simplices along the ways from its lowest corner to its highest, one axis after the other (Kuhn,
/// "Some combinatorial lemmas in topology", 1960), so that neighbours are cut alike.
template <int D>
constexpr auto orders() {
    if constexpr (D == 2)
        return std::array<std::array<int, 2>, 2>{{{0, 1}, {1, 0}}};
    else
        return std::array<std::array<int, 3>, 6>{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
}

template <int D>
Vec<D> zero_between(const Corner<D>& a, const Corner<D>& b) {
    const double share = a.distance / (a.distance - b.distance);
    return to_float(a.point + (b.point - a.point) * share);
}

template <int D>
using Simplex = std::array<Corner<D>, static_cast<std::size_t>(D) + 1>;

/// The inside corners first, then the others, each in their order.
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
        area = {to_float(simplex[0].point), zero_between(simplex[0], simplex[1]), zero_between(simplex[0], simplex[2])};
    } else {
        area = {to_float(simplex[0].point), to_float(simplex[1].point), zero_between(simplex[1], simplex[2]),
                zero_between(simplex[0], simplex[2])};
    }
    if (style.fill.visible()) canvas.polygon(area, fill_only(style));
    if (inside < 3) canvas.line(area[inside], area[inside + 1], style);
}

void draw_simplex(Canvas<3>& canvas, Simplex<3> simplex, const Style& style) {
    const std::size_t inside = sort_by_side<3>(simplex);
    if (inside == 0 || inside == 4) return;
    std::vector<Vec3> face;
    if (inside == 2) {
        face = {zero_between(simplex[0], simplex[2]), zero_between(simplex[0], simplex[3]),
                zero_between(simplex[1], simplex[3]), zero_between(simplex[1], simplex[2])};
    } else {
        const std::size_t alone = inside == 1 ? 0 : 3;
        for (std::size_t i = 0; i < 4; ++i)
            if (i != alone) face.push_back(zero_between(simplex[alone], simplex[i]));
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
    // Half a cell more on every side, so that what touches the box has both its sides in the grid.
    const double cell = longest / most_cells<D>;
    glm::vec<D, int> cells;
    for (int i = 0; i < D; ++i) {
        cells[i] = static_cast<int>(side[i] / cell) + 2;
        low[i] -= 0.5 * (cells[i] * cell - side[i]);
    }
    const FunctionThere<D> seen(function);
    const double reach = seen.slope() * std::sqrt(static_cast<double>(D)) * cell;
    glm::vec<D, int> at(0);
    for (;;) {
        DVec<D> corner = low;
        for (int i = 0; i < D; ++i) corner[i] += at[i] * cell;
        if (std::abs(seen.at(corner)) <= reach || (D == 2 && style.fill.visible())) {
            for (const auto& order : orders<D>()) {
                Simplex<D> simplex;
                DVec<D> point = corner;
                simplex[0] = {point, seen.at(point)};
                for (std::size_t i = 0; i < order.size(); ++i) {
                    point[order[i]] += cell;
                    simplex[i + 1] = {point, seen.at(point)};
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

}  // namespace abut
