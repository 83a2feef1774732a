#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/limited/outer_hull.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {

std::optional<ConvexSurface> convex_surface(std::span<const DVec<3>> points, double tolerance) {
    const HullGrid grid = on_grid(points);
    const Spread spread = spread_of(grid, grid.tolerance);
    if (spread.rank < 3) return std::nullopt;
    ConvexSurface result{{}, quickhull(grid.points, spread.points, grid.tolerance * (tolerance / hull_tolerance))};
    result.points = points_in_use(points, result.triangles.origin);
    return result;
}

const DVec<3>& SupportSearch::highest(const DVec<3>& direction) {
    double max_height = -std::numeric_limits<double>::infinity();
    at_ = hill_climb_.best(at_, [&](std::uint32_t i) {
        const double height = dot(direction, points_[i]);
        if (!(height > max_height)) return false;
        max_height = height;
        return true;
    });
    return points_[at_];
}

const DVec<3>& SupportSearch::first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal,
                                            double near) {
    // Seen along the line; the plane begins upside down.
    double best_x = -1, best_y = 1e-9;
    at_ = hill_climb_.best(at_, [&](std::uint32_t i) {
        const DVec<3> seen = points_[i] - from;
        const double x = dot(on, seen), y = std::max(0.0, -dot(normal, seen));
        if (!(x * best_y - y * best_x > 0) || x * x + y * y <= near * near) return false;
        best_x = x;
        best_y = y;
        return true;
    });
    return points_[at_];
}

namespace {

/// The tolerance of convexity and of containment: the corners of a hull's face aren't coplanar to more than this.
constexpr double flatness = 1e-6;
constexpr int max_halvings = 5;
/// The best place of a collapse adds less than the one of the estimate. An edge whose estimate is too low is tried in
/// vain; one whose estimate is too high comes too late.
constexpr double optimism = 0.7;
constexpr double min_tightening_gain = 1e-4;

Plane<3> relative_to(const DVec<3>& origin, const Plane<3>& plane) {
    return {plane.normal, plane.offset - dot(plane.normal, origin)};
}

Plane<3> plane_touching(const DVec<3>& normal, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    return {normal, std::max({dot(normal, a), dot(normal, b), dot(normal, c)})};
}

}  // namespace

OuterHull::OuterHull(const ConvexSurface& surface)
    : points_(surface.points),
      leaving_(surface.points.size(), no_index),
      origin_(surface.triangles.origin),
      twin_(surface.triangles.twin),
      count_(surface.points.size()),
      cost_(surface.triangles.origin.size(), 0) {
    for (std::uint32_t h = 0; h < origin_.size(); ++h) leaving_[origin_[h]] = h;
    for (std::uint32_t triangle = 0; triangle < surface.triangles.normals.size(); ++triangle) {
        const DVec<3>&a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
        planes_.push_back(plane_touching(normalized(DVec<3>(surface.triangles.normals[triangle])), a, b, c));
        areas_.push_back(cross(b - a, c - a));
    }
}

double OuterHull::volume() const {
    double six_times = 0;
    for (std::uint32_t t = 0; t < planes_.size(); ++t)
        if (has_triangle(t)) six_times += dot(cross(corner(t, 0), corner(t, 1)), corner(t, 2));
    return six_times / 6;
}

OuterBody<3> OuterHull::body() const {
    OuterBody<3> result;
    std::vector<std::uint32_t> number(planes_.size(), 0);
    for (std::uint32_t triangle = 0; triangle < planes_.size(); ++triangle) {
        if (!has_triangle(triangle)) continue;
        number[triangle] = static_cast<std::uint32_t>(result.planes.size());
        result.planes.push_back(planes_[triangle]);
    }
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
        if (leaving_[point] == no_index) continue;
        result.corners.push_back(points_[point]);
        std::vector<std::uint32_t>& through = result.through.emplace_back();
        each_leaving(point, [&](std::uint32_t h) { through.push_back(number[h / 3]); });
    }
    return result;
}

void OuterHull::grow(SupportSearch& inside) {
    DVec<3> middle(0.0);
    for (const DVec<3>& point : points_) middle += point;
    middle /= static_cast<double>(points_.size());
    double factor = 1;
    for (const Plane<3>& plane : planes_) {
        const DVec<3> highest = inside.highest(plane.normal) - middle;
        factor = std::max(factor, dot(plane.normal, highest) / relative_to(middle, plane).offset);
    }
    for (DVec<3>& point : points_) point = middle + (point - middle) * factor;
    for (DVec<3>& area : areas_) area *= factor * factor;
    for (Plane<3>& plane : planes_)
        plane.offset = dot(plane.normal, middle) + relative_to(middle, plane).offset * factor;
}

/// The triangles around a point or, if it is not `no_index`, around a half-edge from there.
void OuterHull::gather_ring(std::uint32_t point, std::uint32_t half_edge) {
    const bool around_edge = half_edge != no_index;
    const std::uint32_t end = around_edge ? origin_[twin_[half_edge]] : point;
    const std::uint32_t left = half_edge / 3, right = around_edge ? twin_[half_edge] / 3 : left;
    middle_ = (points_[point] + points_[end]) * 0.5;
    ring_.clear();
    star_.clear();
    slope_ = DVec<3>(0.0);
    volume_ = size_ = 0;
    const auto gather = [&](std::uint32_t from) {
        each_leaving(from, [&](std::uint32_t h) {
            const bool beside_edge = h / 3 == left || h / 3 == right;
            if (!beside_edge || from == point) {
                star_.push_back(h / 3);
                slope_ += areas_[h / 3];
                volume_ += dot(areas_[h / 3], points_[from] - middle_);
            }
            if (beside_edge) return;
            ring_.push_back(following(h));
            size_ = std::max(size_, length_squared(points_[origin_[ring_.back()]] - middle_));
        });
    };
    gather(point);
    if (around_edge) gather(end);
    size_ = square_root(size_);
}

/// Six times the volume that is added if cones from the ring to `apex`, relative to the middle, replace the star.
double OuterHull::added_by(const DVec<3>& apex) const {
    return dot(slope_, apex) - volume_;
}

/// An estimate of the cost of a collapse, as six times a volume: the new point moves along the mean of the normals
/// until it is outside of all planes.
double OuterHull::estimated_cost(std::uint32_t half_edge) {
    gather_ring(origin_[half_edge], half_edge);
    DVec<3> direction(0.0);
    for (const std::uint32_t triangle : star_) direction += planes_[triangle].normal;
    double out = 0;
    for (const std::uint32_t triangle : star_) {
        const double rise = dot(planes_[triangle].normal, direction);
        if (!(rise > 1e-3)) return std::numeric_limits<double>::max();
        out = std::max(out, relative_to(middle_, planes_[triangle]).offset / rise);
    }
    return optimism * added_by(direction * out);
}

std::optional<OuterHull::Merge> OuterHull::merge_at(std::uint32_t half_edge) {
    gather_ring(origin_[half_edge], half_edge);
    // The link condition: a common neighbour beside those of the two triangles is twice on the ring, and the surface
    // would fold there.
    neighbours_.clear();
    for (const std::uint32_t h : ring_) neighbours_.push_back(origin_[h]);
    std::sort(neighbours_.begin(), neighbours_.end());
    if (std::adjacent_find(neighbours_.begin(), neighbours_.end()) != neighbours_.end()) return std::nullopt;
    limits_.clear();
    for (const std::uint32_t triangle : star_) limits_.push_back(relative_to(middle_, planes_[triangle]));
    for (const std::uint32_t h : ring_) {
        Plane<3> outer = relative_to(middle_, planes_[twin_[h] / 3]);
        outer.offset += flatness;
        limits_.push_back(flipped(outer));
    }
    const std::optional<DVec<3>> apex = lowest_above(limits_, slope_, size_);
    if (!apex) return std::nullopt;
    // A volume below the old one by more than rounding means that the surface would turn inside out.
    const double added = added_by(*apex);
    if (added < -1e-9 * size_ * size_ * size_) return std::nullopt;
    return Merge{*apex + middle_, added};
}

/// The planes of the triangles around a moved point. A degenerate one takes that of its neighbour across the ring.
void OuterHull::set_planes_of_ring() {
    for (const std::uint32_t h : ring_) {
        const std::uint32_t triangle = h / 3;
        const DVec<3>&a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
        const DVec<3> area = areas_[triangle] = cross(b - a, c - a);
        const bool degenerate = !(length(area) > 1e-10 * std::max(length_squared(b - a), length_squared(c - a)));
        planes_[triangle] = degenerate ? planes_[twin_[h] / 3] : plane_touching(area / length(area), a, b, c);
    }
}

/// Edge collapse: the first end of the half-edge moves to `point`; the other end and the two triangles are removed.
void OuterHull::merge(std::uint32_t half_edge, const DVec<3>& point) {
    const std::uint32_t a = origin_[half_edge], b = origin_[twin_[half_edge]];
    gather_ring(a, half_edge);
    each_leaving(b, [&](std::uint32_t h) { origin_[h] = a; });
    points_[a] = point;
    leaving_[b] = no_index;
    for (const std::uint32_t side : {half_edge, twin_[half_edge]}) {
        const std::uint32_t first = following(side), second = following(first);
        const std::uint32_t one = twin_[first], other = twin_[second];
        leaving_[origin_[one]] = one;
        leaving_[origin_[other]] = other;
        twin_[one] = other;
        twin_[other] = one;
    }
    set_planes_of_ring();
    for (const std::uint32_t side : {half_edge, twin_[half_edge]})
        for (const std::uint32_t h : {side, following(side), following(following(side))}) origin_[h] = no_index;
    --count_;
}

void OuterHull::set_cost(std::uint32_t half_edge, double cost) {
    const std::uint32_t edge = std::min(half_edge, twin_[half_edge]);
    cost_[edge] = cost;
    cheapest_.push({cost, edge});
}

void OuterHull::simplify(std::size_t count) {
    bool fresh = false;  // whether no collapse succeeded since all edges were tried
    while (count_ > count) {
        if (cheapest_.empty()) {
            if (fresh) return;
            for (std::uint32_t h = 0; h < origin_.size(); ++h)
                if (origin_[h] != no_index && h < twin_[h]) set_cost(h, estimated_cost(h));
            fresh = true;
        }
        const auto [cost, edge] = cheapest_.top();
        cheapest_.pop();
        if (origin_[edge] == no_index || edge > twin_[edge] || cost != cost_[edge]) continue;
        const std::optional<Merge> found = merge_at(edge);
        if (!found) continue;
        if (!cheapest_.empty() && found->added > cheapest_.top().first && found->added > cost) {
            set_cost(edge, found->added);
            continue;
        }
        const std::uint32_t survivor = origin_[edge];
        merge(edge, found->point);
        fresh = false;
        each_leaving(survivor, [&](std::uint32_t h) { set_cost(h, estimated_cost(h)); });
    }
}

/// The constraints of a corner: above the plane through each edge of the ring that touches `inside`, so that it stays
/// contained, and below the planes across the ring, so that the surface stays convex.
void OuterHull::cut_around(std::uint32_t point, SupportSearch& inside) {
    gather_ring(point, no_index);
    limits_.clear();
    for (const std::uint32_t h : ring_) {
        const Plane<3>& outer = planes_[twin_[h] / 3];
        const DVec<3> from = points_[origin_[h]], along = points_[origin_[twin_[h]]] - from;
        const DVec<3> on = normalized(cross(outer.normal, along));
        const DVec<3> seen = inside.first_touched(from, on, outer.normal, 1e-12 * length(along)) - from;
        const double x = dot(on, seen), y = std::max(0.0, -dot(outer.normal, seen));
        const DVec<3> normal = normalized(outer.normal * x + on * y), local = from - middle_;
        limits_.push_back({normal, dot(normal, local)});
        limits_.push_back(flipped<3>({outer.normal, dot(outer.normal, local) + flatness}));
    }
}

/// Whether a corner can move: its triangles then contain `inside`, and stay convex.
bool OuterHull::fits(std::uint32_t point, const DVec<3>& at, SupportSearch& inside) {
    bool result = true;
    each_leaving(point, [&](std::uint32_t h) {
        if (!result) return;
        // Across the edge h: the third corner of the neighbouring triangle.
        const DVec<3> b = points_[origin_[following(h)]], c = points_[origin_[following(following(h))]],
                      d = points_[origin_[following(following(twin_[h]))]];
        const DVec<3> normal = cross(b - at, c - at);
        const double tolerance = flatness * length(normal);
        result = dot(normal, d - at) <= 2 * tolerance && dot(normal, inside.highest(normal) - at) <= tolerance;
    });
    return result;
}

void OuterHull::tighten(SupportSearch& inside, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        double gain = 0, size = 0;
        for (std::uint32_t point = 0; point < points_.size(); ++point) {
            if (leaving_[point] == no_index) continue;
            cut_around(point, inside);
            size = std::max(size, size_);
            const std::optional<DVec<3>> found = lowest_above(limits_, slope_, size_);
            if (!found || !(added_by(*found) < 0)) continue;
            DVec<3> step = *found;
            int halvings = 0;
            while (halvings < max_halvings && !fits(point, middle_ + step, inside)) {
                ++halvings;
                step *= 0.5;
            }
            if (halvings == max_halvings) continue;
            gain -= added_by(step);
            points_[point] = middle_ + step;
            set_planes_of_ring();
        }
        if (!(gain > min_tightening_gain * size * size * size)) return;
    }
}

}  // namespace abut::detail
