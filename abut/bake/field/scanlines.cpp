#include <abut/bake/field/scanlines.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

Scanlines::Range Scanlines::range(const glm::uvec3& triangle, int axis) const {
    const float a = points_[triangle.x][axis], b = points_[triangle.y][axis], c = points_[triangle.z][axis];
    const auto low = static_cast<double>(std::min(std::min(a, b), c)),
               high = static_cast<double>(std::max(std::max(a, b), c));
    Range result{first_at_or_after(lattice_, axis, low, samples_[axis]), 0};
    result.end = result.begin;
    while (result.end < samples_[axis] && lattice_.along(axis, result.end) <= high) ++result.end;
    return result;
}

/// The side of the edge on which the line lies, seen along the first axis: 0 only if both ends project to the same
/// point.
int Scanlines::side(std::uint32_t from, std::uint32_t to, const DVec<2>& line) const {
    const Vec2 a(points_[from].y, points_[from].z), b(points_[to].y, points_[to].z);
    const int orientation = turn_towards(a, b, line);
    if (orientation != 0) return orientation;
    if (a.y != b.y) return a.y > b.y ? 1 : -1;
    return a.x == b.x ? 0 : (b.x > a.x ? 1 : -1);
}

std::optional<ScanlineCrossing> Scanlines::crossing(const glm::uvec3& t, std::uint32_t y, std::uint32_t z) const {
    const DVec<2> line(lattice_.along(1, y), lattice_.along(2, z));
    const int orientation = side(t.x, t.y, line);
    if (orientation == 0 || side(t.y, t.z, line) != orientation || side(t.z, t.x, line) != orientation)
        return std::nullopt;

    const DVec<3> a(points_[t.x]), b(points_[t.y]), c(points_[t.z]);
    const DVec<3> normal = cross(b - a, c - a);
    double at = a.x - (normal.y * (line.x - a.y) + normal.z * (line.y - a.z)) / normal.x;
    const double low = std::min(std::min(a.x, b.x), c.x), high = std::max(std::max(a.x, b.x), c.x);
    at = at > low ? std::min(at, high) : low;
    return ScanlineCrossing{first_at_or_after(lattice_, 0, at, samples_.x), -orientation};
}

ScanlineWindings::ScanlineWindings(const Scanlines& lines, std::span<const std::span<const glm::uvec3>> surfaces)
    : rows_(lines.samples().y), first_(std::size_t{lines.samples().y} * lines.samples().z + 1, 0) {
    struct Found {
        std::size_t line;
        ScanlineCrossing crossing;
    };
    std::vector<Found> found;
    for (const std::span<const glm::uvec3>& surface : surfaces)
        for (const glm::uvec3& triangle : surface)
            lines.each_crossing(triangle, [&](std::uint32_t y, std::uint32_t z, const ScanlineCrossing& crossing) {
                const std::size_t line = std::size_t{z} * rows_ + y;
                found.push_back({line, crossing});
                ++first_[line + 1];
            });
    for (std::size_t line = 1; line < first_.size(); ++line) first_[line] += first_[line - 1];
    crossings_.resize(found.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Found& one : found) crossings_[next[one.line]++] = one.crossing;
    const auto order = [](const ScanlineCrossing& a, const ScanlineCrossing& b) {
        return a.sample != b.sample ? a.sample < b.sample : a.change < b.change;
    };
    for (std::size_t line = 0; line + 1 < first_.size(); ++line)
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(first_[line]),
                  crossings_.begin() + static_cast<std::ptrdiff_t>(first_[line + 1]), order);
}

void ScanlineWindings::evaluate(const glm::vec<3, std::uint32_t>& first, std::uint32_t count, std::uint32_t stride,
                                std::int32_t* winding) const {
    const std::size_t line = std::size_t{first.z} * rows_ + first.y;
    std::size_t next = first_[line];
    std::int32_t sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t sample = first.x + i * stride;
        for (; next < first_[line + 1] && crossings_[next].sample <= sample; ++next) sum += crossings_[next].change;
        winding[i] = sum;
    }
}

}  // namespace abut::detail
