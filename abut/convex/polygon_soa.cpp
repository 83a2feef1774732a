#include <abut/convex/polygon_soa.hpp>
#include <abut/math/simd/square_root.hpp>

#include <limits>

namespace abut::detail {

void write_polygon_soa(std::span<const Vec2> points, double* numbers) {
    const auto count = static_cast<std::uint32_t>(points.size()), capacity = padded_edge_count(count);
    const auto at = [&](std::size_t i, std::size_t row) -> double& {
        return numbers[PolygonSoa::place(i) + row * soa_lanes];
    };
    const DVec<2> first(points[0]);
    DVec<2> from = first, low = from, high = from;
    double area = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DVec<2> to(points[i + 1 == count ? 0 : i + 1]), edge = to - from;
        // In double no square of a difference of floats overflows or underflows.
        const double part = 1 / square_root(dot(edge, edge));
        const DVec<2> normal(edge.y * part, -edge.x * part);
        const double row[] = {from.x, from.y, normal.x, normal.y, dot(normal, from)};
        for (std::uint32_t k = 0; k < soa_rows; ++k) at(i, k) = row[k];
        area += cross(from - first, edge);
        low = {std::min(low.x, from.x), std::min(low.y, from.y)};
        high = {std::max(high.x, from.x), std::max(high.y, from.y)};
        from = to;
    }
    // A padding edge has no gap in front of it: it never is the widest, not even in a tie with its original.
    for (std::uint32_t i = count; i < capacity; ++i) {
        for (std::uint32_t k = 0; k < soa_rows; ++k) at(i, k) = at(0, k);
        at(i, 4) = std::numeric_limits<double>::infinity();
    }
    numbers[0] = 0.5 * length(high - low);
    numbers[1] = 0.5 * area;
}

}  // namespace abut::detail
