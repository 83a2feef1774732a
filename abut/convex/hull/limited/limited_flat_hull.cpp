#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_flat_hull.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

/// The projection of the plane of a flat hull along the axis nearest to its normal.
class PlaneProjection {
public:
    PlaneProjection(const Hull3& full, std::span<const Vec3> points)
        : normal_(normalized(DVec<3>(full.normals[0]))), origin_(full.points[0]) {
        const DVec<3> steep{std::abs(normal_.x), std::abs(normal_.y), std::abs(normal_.z)};
        up_ = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
        right_ = (up_ + 1) % 3;
        front_ = (up_ + 2) % 3;
        level_ =
            std::all_of(points.begin(), points.end(), [&](const Vec3& point) { return point[up_] == points[0][up_]; });
        // The plane midway between the lowest and the highest point.
        double low = 0, high = 0;
        for (const Vec3& point : points) {
            const double height = dot(normal_, DVec<3>(point) - origin_);
            low = std::min(low, height);
            high = std::max(high, height);
        }
        middle_ = 0.5 * (low + high);
    }

    Vec2 of(const Vec3& point) const { return {point[right_], point[front_]}; }

    Vec3 lifted(const Vec2& point) const {
        Vec3 result;
        result[right_] = point.x;
        result[front_] = point.y;
        const double rest = normal_[right_] * (static_cast<double>(point.x) - origin_[right_]) +
                            normal_[front_] * (static_cast<double>(point.y) - origin_[front_]);
        result[up_] = static_cast<float>(level_ ? origin_[up_] : origin_[up_] + (middle_ - rest) / normal_[up_]);
        return result;
    }

    double height(const Vec3& point) const { return dot(normal_, DVec<3>(point) - origin_) - middle_; }

    /// A map of the projection that restores lengths in the plane.
    Affine<2> to_plane() const {
        // The slopes of the plane to the right and to the front; the map is a root of (1 + x x, x y; x y, 1 + y y).
        const double x = -normal_[right_] / normal_[up_], y = -normal_[front_] / normal_[up_];
        const double root = std::sqrt(1 + x * x);
        Affine<2> result;
        result.column = {DVec<2>(root, 0), DVec<2>(x * y / root, std::sqrt(1 + x * x + y * y) / root)};
        return result;
    }

private:
    DVec<3> normal_, origin_;
    double middle_ = 0;
    int up_ = 0, right_ = 0, front_ = 0;
    bool level_ = false;
};

/// The polygon as two faces, back to back.
Hull3 flat_hull(std::vector<Vec3> loop, std::span<const Vec3> points) {
    const DVec<3> origin(loop[0]);
    DVec<3> area(0.0), moment(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const DVec<3> a = DVec<3>(loop[i]) - origin, b = DVec<3>(loop[i + 1]) - origin;
        area += cross(a, b);
    }
    const DVec<3> across = normalized(area);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const DVec<3> a = DVec<3>(loop[i]) - origin, b = DVec<3>(loop[i + 1]) - origin;
        moment += (a + b) * dot(cross(a, b), across);
    }
    Hull3 result;
    result.rank = 2;
    result.area = length(area);
    result.centroid = to_float(origin + moment / (3 * result.area));
    result.points = loop;
    std::sort(result.points.begin(), result.points.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    std::vector<std::uint32_t> numbers;
    for (const Vec3& corner : loop)
        numbers.push_back(static_cast<std::uint32_t>(std::find(result.points.begin(), result.points.end(), corner) -
                                                     result.points.begin()));
    std::rotate(numbers.begin(), std::find(numbers.begin(), numbers.end(), 0u), numbers.end());
    result.loops = numbers;
    std::reverse(numbers.begin() + 1, numbers.end());
    result.normals = {to_float(across), to_float(-across)};
    if (numbers < result.loops) {
        result.loops.swap(numbers);
        std::swap(result.normals[0], result.normals[1]);
    }
    const auto count = static_cast<std::uint32_t>(numbers.size());
    result.loops.insert(result.loops.end(), numbers.begin(), numbers.end());
    result.loop_ends = {count, 2 * count};
    result.edges = facet_edges(result.loops, result.loop_ends);
    for (const Vec3& normal : result.normals)
        result.offsets.push_back(std::max(offset_above(normal, result.points), offset_above(normal, points)));
    return result;
}

}  // namespace

std::optional<Hull3> limited_flat_hull(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const PlaneProjection projection(full, points);
    std::vector<Vec2> outline, inner;
    for (const Vec3& point : points) outline.push_back(projection.of(point));
    for (const std::uint32_t i : hull_loop(outline)) inner.push_back(outline[i]);
    const std::optional<Hull2> outer = outline_of(inner, limit, projection.to_plane());
    if (!outer) return std::nullopt;
    std::vector<Vec3> loop;
    const double flat = hull_tolerance * extent<3>(full.points);
    for (const Vec2& corner : outer->points) {
        loop.push_back(projection.lifted(corner));
        if (!is_finite(loop.back()) || !(std::abs(projection.height(loop.back())) <= flat)) return std::nullopt;
    }
    return flat_hull(std::move(loop), points);
}

}  // namespace abut::detail
