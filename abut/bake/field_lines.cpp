#include <abut/bake/field_lines.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

SampleLines::Range SampleLines::range(const glm::uvec3& triangle, int axis) const {
    const float a = points_[triangle.x][axis], b = points_[triangle.y][axis], c = points_[triangle.z][axis];
    const auto least = static_cast<double>(std::min(std::min(a, b), c)),
               most = static_cast<double>(std::max(std::max(a, b), c));
    Range result{first_behind(lattice_, axis, least, samples_[axis]), 0};
    result.end = result.begin;
    while (result.end < samples_[axis] && lattice_.along(axis, result.end) <= most) ++result.end;
    return result;
}

/// Of the line, from one point to the other, as the first axis sees them: never 0 but where they are one point.
int SampleLines::side(std::uint32_t from, std::uint32_t to, const DVec<2>& line) const {
    const Vec2 a(points_[from].y, points_[from].z), b(points_[to].y, points_[to].z);
    const int turn = turn_towards(a, b, line);
    if (turn != 0) return turn;
    if (a.y != b.y) return a.y > b.y ? 1 : -1;
    return a.x == b.x ? 0 : (b.x > a.x ? 1 : -1);
}

std::optional<LineCrossing> SampleLines::crossing(const glm::uvec3& t, std::uint32_t y, std::uint32_t z) const {
    const DVec<2> line(lattice_.along(1, y), lattice_.along(2, z));
    const int turn = side(t.x, t.y, line);
    if (turn == 0 || side(t.y, t.z, line) != turn || side(t.z, t.x, line) != turn) return std::nullopt;

    const DVec<3> a(points_[t.x]), b(points_[t.y]), c(points_[t.z]);
    const DVec<3> normal = cross(b - a, c - a);
    double place = a.x - (normal.y * (line.x - a.y) + normal.z * (line.y - a.z)) / normal.x;
    const double least = std::min(std::min(a.x, b.x), c.x), most = std::max(std::max(a.x, b.x), c.x);
    place = place > least ? std::min(place, most) : least;
    return LineCrossing{first_behind(lattice_, 0, place, samples_.x), -turn};
}

LineCounts::LineCounts(const SampleLines& lines, std::span<const std::span<const glm::uvec3>> surfaces)
    : rows_(lines.samples().y), first_(std::size_t{lines.samples().y} * lines.samples().z + 1, 0) {
    struct Found {
        std::size_t line;
        LineCrossing crossing;
    };
    std::vector<Found> found;
    for (const std::span<const glm::uvec3>& surface : surfaces)
        for (const glm::uvec3& triangle : surface)
            lines.each_crossing(triangle, [&](std::uint32_t y, std::uint32_t z, const LineCrossing& crossing) {
                const std::size_t line = std::size_t{z} * rows_ + y;
                found.push_back({line, crossing});
                ++first_[line + 1];
            });
    for (std::size_t line = 1; line < first_.size(); ++line) first_[line] += first_[line - 1];
    crossings_.resize(found.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Found& one : found) crossings_[next[one.line]++] = one.crossing;
    const auto order = [](const LineCrossing& a, const LineCrossing& b) {
        return a.sample != b.sample ? a.sample < b.sample : a.change < b.change;
    };
    for (std::size_t line = 0; line + 1 < first_.size(); ++line)
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(first_[line]),
                  crossings_.begin() + static_cast<std::ptrdiff_t>(first_[line + 1]), order);
}

void LineCounts::tell(const glm::vec<3, std::uint32_t>& first, std::uint32_t count, std::uint32_t stride,
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

}  // namespace abut
