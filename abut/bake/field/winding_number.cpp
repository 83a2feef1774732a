#include <abut/bake/field/winding_number.hpp>
#include <abut/math/detail/sin_cos.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace abut::detail {
namespace {

constexpr double full_angle = 4 * 3.14159265358979323846;
constexpr std::uint32_t max_leaf_triangles = 8;
/// A group farther away than this multiple of its radius is approximated by its dipole.
constexpr double far_radii = 3;

}  // namespace

GeneralizedWindingNumber::GeneralizedWindingNumber(std::span<const Vec3> points,
                                                   std::span<const glm::uvec3> triangles) {
    if (triangles.empty()) return;
    corners_.reserve(triangles.size());
    for (const glm::uvec3& t : triangles)
        corners_.push_back({DVec<3>(points[t.x]), DVec<3>(points[t.y]), DVec<3>(points[t.z])});
    groups_.push_back({});
    groups_[0].count = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t group = 0; group < groups_.size(); ++group) divide(group);
}

void GeneralizedWindingNumber::divide(std::uint32_t number) {
    Group group = groups_[number];
    const auto begin = corners_.data() + group.first, end = begin + group.count;
    double areas = 0;
    DVec<3> middle(0.0), mean(0.0), low = begin->a, high = begin->a;
    for (auto t = begin; t != end; ++t) {
        const DVec<3> area = cross(t->b - t->a, t->c - t->a) * 0.5, center = (t->a + t->b + t->c) / 3.0;
        group.area += area;
        areas += length(area);
        middle += center * length(area);
        mean += center;
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], center[i]);
            high[i] = std::max(high[i], center[i]);
        }
    }
    group.middle = areas > 0 ? middle / areas : mean / static_cast<double>(group.count);
    for (auto t = begin; t != end; ++t)
        for (const DVec<3>* corner : {&t->a, &t->b, &t->c})
            group.radius = std::max(group.radius, length(*corner - group.middle));

    if (group.count > max_leaf_triangles) {
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
        const std::uint32_t half = group.count / 2;
        // The order is total for triangles that differ, so every standard library makes the same halves in the same
        // order.
        const auto is_before = [axis](const Corners& s, const Corners& t) {
            const double from = s.a[axis] + s.b[axis] + s.c[axis], to = t.a[axis] + t.b[axis] + t.c[axis];
            if (from != to) return from < to;
            for (const DVec<3> Corners::*corner : {&Corners::a, &Corners::b, &Corners::c})
                for (int i = 0; i < 3; ++i)
                    if ((s.*corner)[i] != (t.*corner)[i]) return (s.*corner)[i] < (t.*corner)[i];
            return false;
        };
        std::sort(begin, end, is_before);
        group.below = static_cast<std::uint32_t>(groups_.size());
        Group lower, upper;
        lower.first = group.first;
        lower.count = half;
        upper.first = group.first + half;
        upper.count = group.count - half;
        groups_.push_back(lower);
        groups_.push_back(upper);
    }
    groups_[number] = group;
}

/// Van Oosterom, Strackee: "The solid angle of a plane triangle" (1983).
std::optional<double> GeneralizedWindingNumber::exact(const DVec<3>& point, std::uint32_t first,
                                                      std::uint32_t count) const {
    double sum = 0;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const DVec<3> a = corners_[i].a - point, b = corners_[i].b - point, c = corners_[i].c - point;
        const double la = length(a), lb = length(b), lc = length(c), volume = dot(a, cross(b, c));
        const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        const double rounding = 0x1p-40 * la * lb * lc;
        if (std::abs(volume) <= rounding && rest <= rounding) return std::nullopt;
        sum += 2 * angle_of(rest, volume);
    }
    return sum / full_angle;
}

std::optional<double> GeneralizedWindingNumber::exact(const DVec<3>& point) const {
    return exact(point, 0, static_cast<std::uint32_t>(corners_.size()));
}

std::optional<double> GeneralizedWindingNumber::approximate(const DVec<3>& point) const {
    double sum = 0;
    // Each split halves a group: the tree is at most 32 deep.
    std::array<std::uint32_t, 40> stack;
    std::size_t stack_size = 0;
    if (!groups_.empty()) stack[stack_size++] = 0;
    while (stack_size > 0) {
        const Group& group = groups_[stack[--stack_size]];
        const DVec<3> offset = group.middle - point;
        const double squared = length_squared(offset);
        if (squared > far_radii * far_radii * group.radius * group.radius) {
            sum += dot(group.area, offset) / (full_angle * squared * square_root(squared));
        } else if (group.below == 0) {
            const std::optional<double> some = exact(point, group.first, group.count);
            if (!some) return std::nullopt;
            sum += *some;
        } else {
            stack[stack_size++] = group.below + 1;
            stack[stack_size++] = group.below;
        }
    }
    return sum;
}

}  // namespace abut::detail
