#include <abut/bake/parts/approximate_hull.hpp>
#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/hull.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

constexpr double min_tolerance = 0.9;  // in grid steps: the rounding of a point
constexpr double grid_steps = 65535;   // a plane's height at a point stays below 2^53, exact in double

}  // namespace

std::uint32_t ApproximateHull::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Facet facet;
    facet.corner = {a, b, c};
    facet.normal = cross(points_[b] - points_[a], points_[c] - points_[a]);
    facet.offset = dot(facet.normal, points_[a]);
    const double inverse_length = 1 / length(facet.normal);
    raised_planes_.push_back({facet.normal * inverse_length, facet.offset * inverse_length + tolerance_});
    facet.outside = facet.farthest = no_index;
    facet.height = 0;
    facet.alive = true;
    facets_.push_back(facet);
    return static_cast<std::uint32_t>(facets_.size() - 1);
}

double ApproximateHull::above(const Facet& facet, std::uint32_t point) const {
    return dot(facet.normal, points_[point]) - facet.offset;
}

/// Appends the point to the outside set of the first facet, from `first` on, that it is above. A point above none is
/// discarded for good.
void ApproximateHull::assign_outside(std::uint32_t point, std::uint32_t first) {
    const DVec<3>& p = points_[point];
    for (std::size_t f = first; f < raised_planes_.size(); ++f) {
        const double height = dot(raised_planes_[f].normal, p) - raised_planes_[f].offset;
        if (height <= 0) continue;
        Facet& facet = facets_[f];
        next_[point] = facet.outside;
        facet.outside = point;
        if (height > facet.height) {
            facet.height = height;
            facet.farthest = point;
        }
        return;
    }
}

void ApproximateHull::insert_apex(std::uint32_t apex, std::uint32_t seen) {
    visible_.assign(1, seen);
    horizon_.clear();
    facets_[seen].alive = false;
    for (std::size_t i = 0; i < visible_.size(); ++i)
        for (const std::uint32_t twin : facets_[visible_[i]].twin) {
            Facet& neighbor = facets_[twin / 3];
            if (!neighbor.alive) continue;
            if (above(neighbor, apex) > 0) {
                neighbor.alive = false;
                visible_.push_back(twin / 3);
            } else {
                horizon_.push_back(twin);
            }
        }

    const auto first = static_cast<std::uint32_t>(facets_.size());
    for (const std::uint32_t behind : horizon_) {
        const Facet& neighbor = facets_[behind / 3];
        const std::uint32_t from = neighbor.corner[(behind % 3 + 1) % 3], to = neighbor.corner[behind % 3];
        const std::uint32_t facet = add(from, to, apex);
        facets_[facet].twin[0] = behind;
        facets_[behind / 3].twin[behind % 3] = 3 * facet;
        leaving_[from] = facet;
    }
    for (std::uint32_t facet = first; facet < facets_.size(); ++facet) {
        const std::uint32_t neighbor = leaving_[facets_[facet].corner[1]];
        facets_[facet].twin[1] = 3 * neighbor + 2;
        facets_[neighbor].twin[2] = 3 * facet + 1;
    }
    for (const std::uint32_t old : visible_)
        for (std::uint32_t point = facets_[old].outside, next; point != no_index; point = next) {
            next = next_[point];
            if (point != apex) assign_outside(point, first);
        }
}

/// Projects the points along the axis closest to the normal and takes their 2D hull. Points on the line from a to b are
/// represented by a and b.
void ApproximateHull::build_flat(const DVec<3>& normal, std::uint32_t a, std::uint32_t b) {
    const int up = longest_axis(normal);
    if (!(std::abs(normal[up]) > 0)) {
        flat_hull_ = {a, b};
    } else {
        std::vector<Vec2> flat;
        flat.reserve(points_.size());
        for (const DVec<3>& p : points_)
            flat.emplace_back(static_cast<float>(p[(up + 1) % 3]), static_cast<float>(p[(up + 2) % 3]));
        flat_hull_ = hull_loop(flat);
    }
    DVec<3> area(0.0);
    const DVec<3>& origin = points_[flat_hull_[0]];
    for (std::size_t i = 2; i < flat_hull_.size(); ++i)
        area += cross(points_[flat_hull_[i - 1]] - origin, points_[flat_hull_[i]] - origin);
    area_ = length(area) * step_ * step_;
    corners_ = flat_hull_;
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
}

/// Builds the initial tetrahedron. Returns false if the points are flatter than the tolerance.
bool ApproximateHull::build_tetrahedron(double tolerance) {
    const std::uint32_t a = farthest_of(points_, [&](const DVec<3>& p) { return -p.x; });
    const std::uint32_t b = farthest_of(points_, [&](const DVec<3>& p) { return length_squared(p - points_[a]); });
    const DVec<3> along = points_[b] - points_[a];
    const auto area = [&](const DVec<3>& p) { return length_squared(cross(along, p - points_[a])); };
    const std::uint32_t c = farthest_of(points_, area);
    const bool line = area(points_[c]) <= tolerance * tolerance * length_squared(along);
    const DVec<3> normal = line ? DVec<3>(0.0) : cross(along, points_[c] - points_[a]);
    const auto height = [&](const DVec<3>& p) { return std::abs(dot(normal, p - points_[a])); };
    const std::uint32_t d = farthest_of(points_, height);
    if (height(points_[d]) <= tolerance * length(normal)) {
        build_flat(normal, a, b);
        return false;
    }

    const bool front = dot(normal, points_[d] - points_[a]) > 0;
    add(a, front ? b : c, front ? c : b);
    add(a, front ? c : b, front ? b : c);
    facets_[0].twin = {5, 4, 3};
    facets_[1].twin = {2, 1, 0};
    insert_apex(d, 0);
    for (std::uint32_t point = 0; point < points_.size(); ++point) assign_outside(point, 1);
    return true;
}

void ApproximateHull::finish() {
    double six_volumes = 0, two_areas = 0;
    std::vector<std::uint32_t>& used = leaving_;
    used.assign(points_.size(), 0);
    const DVec<3>& origin = points_[0];
    for (const Facet& facet : facets_) {
        if (!facet.alive) continue;
        six_volumes += facet.offset - dot(facet.normal, origin);
        two_areas += length(facet.normal);
        for (const std::uint32_t corner : facet.corner) used[corner] = 1;
    }
    for (std::uint32_t i = 0; i < points_.size(); ++i)
        if (used[i] != 0) corners_.push_back(i);
    volume_ = six_volumes / 6 * step_ * step_ * step_;
    area_ = two_areas / 2 * step_ * step_;
}

void ApproximateHull::build(std::span<const DVec<3>> points, double tolerance) {
    DVec<3> max = points[0];
    min_ = points[0];
    for (const DVec<3>& p : points)
        for (int i = 0; i < 3; ++i) {
            min_[i] = std::min(min_[i], p[i]);
            max[i] = std::max(max[i], p[i]);
        }
    const double extent = largest(max - min_);
    step_ = extent / grid_steps;
    corners_.clear();
    facets_.clear();
    raised_planes_.clear();
    flat_hull_.clear();
    volume_ = area_ = 0;
    points_.clear();
    next_.assign(points.size(), no_index);
    leaving_.assign(points.size(), no_index);
    const double inverse = extent > 0 ? grid_steps / extent : 0;
    for (const DVec<3>& p : points) {
        const DVec<3> at = (p - min_) * inverse;
        points_.emplace_back(std::floor(at.x + 0.5), std::floor(at.y + 0.5), std::floor(at.z + 0.5));
    }
    tolerance_ = std::max(tolerance * grid_steps, min_tolerance);
    if (!build_tetrahedron(2 * min_tolerance)) return;
    // Quickhull: each iteration adds a point to the hull or discards a facet's outside set.
    for (std::uint32_t f = 0; f < facets_.size(); ++f)
        if (facets_[f].alive && facets_[f].farthest != no_index) insert_apex(facets_[f].farthest, f);
    finish();
}

std::vector<ApproximateHull::Plane> ApproximateHull::planes() const {
    std::vector<Plane> result;
    for (const Facet& facet : facets_) {
        if (!facet.alive) continue;
        const DVec<3> normal = normalized(facet.normal);
        result.push_back({normal, dot(normal, min_ + points_[facet.corner[0]] * step_)});
    }
    return result;
}

std::vector<std::array<std::uint32_t, 3>> ApproximateHull::triangles() const {
    std::vector<std::array<std::uint32_t, 3>> result;
    for (const Facet& facet : facets_)
        if (facet.alive) result.push_back(facet.corner);
    for (std::size_t i = 2; i < flat_hull_.size(); ++i)
        result.push_back({flat_hull_[0], flat_hull_[i - 1], flat_hull_[i]});
    return result;
}

}  // namespace abut::detail
