// Simplification by edge collapse.

#include <abut/convex/hull/limited/outer_hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::detail {
OuterHull::OuterHull(const ConvexSurface& surface)
    : points_(surface.points),
      leaving_(surface.points.size(), none),
      origin_(surface.triangles.origin),
      twin_(surface.triangles.twin),
      count_(surface.points.size()),
      version_(surface.triangles.origin.size(), 0),
      mark_(surface.points.size(), 0) {
    for (std::uint32_t h = 0; h < origin_.size(); ++h) leaving_[origin_[h]] = h;
    for (std::uint32_t triangle = 0; triangle < surface.triangles.normals.size(); ++triangle) {
        const DVec<3>&a = points_[corner(triangle, 0)], &b = points_[corner(triangle, 1)],
              &c = points_[corner(triangle, 2)];
        const DVec<3> normal = normalized(DVec<3>(surface.triangles.normals[triangle]));
        planes_.push_back({normal, std::max({dot(normal, a), dot(normal, b), dot(normal, c)})});
        areas_.push_back(length(cross(b - a, c - a)));
    }
}

double OuterHull::volume() const {
    double six_times = 0;
    for (std::uint32_t t = 0; t < planes_.size(); ++t)
        if (has_triangle(t))
            six_times += dot(cross(points_[corner(t, 0)], points_[corner(t, 1)]), points_[corner(t, 2)]);
    return six_times / 6;
}

void OuterHull::grow(const DVec<3>& middle, const VertexGraph& inside) {
    double factor = 1;
    std::uint32_t highest = 0;
    for (std::uint32_t triangle = 0; triangle < planes_.size(); ++triangle) {
        if (!has_triangle(triangle)) continue;
        const Plane<3>& plane = planes_[triangle];
        const double inner = dot(plane.normal, middle);
        highest = inside.highest(plane.normal, highest);
        factor = std::max(factor, (dot(plane.normal, inside.points()[highest]) - inner) / (plane.offset - inner));
    }
    for (DVec<3>& point : points_) point = middle + (point - middle) * factor;
    for (Plane<3>& plane : planes_) {
        const double inner = dot(plane.normal, middle);
        plane.offset = inner + (plane.offset - inner) * factor;
    }
    for (double& area : areas_) area *= factor * factor;
}

void OuterHull::gather_ring(std::uint32_t half_edge) {
    const std::uint32_t a = origin_[half_edge], b = origin_[twin_[half_edge]];
    const std::uint32_t left = half_edge / 3, right = twin_[half_edge] / 3;
    middle_ = (points_[a] + points_[b]) * 0.5;
    ring_.clear();
    star_.clear();
    each_leaving(a, [&](std::uint32_t h) {
        star_.push_back(h / 3);
        if (h / 3 != left && h / 3 != right) ring_.push_back(following(h));
    });
    each_leaving(b, [&](std::uint32_t h) {
        if (h / 3 == left || h / 3 == right) return;
        star_.push_back(h / 3);
        ring_.push_back(following(h));
    });
    finish_ring();
}

void OuterHull::gather_ring_of_point(std::uint32_t point) {
    middle_ = points_[point];
    ring_.clear();
    star_.clear();
    each_leaving(point, [&](std::uint32_t h) {
        star_.push_back(h / 3);
        ring_.push_back(following(h));
    });
    finish_ring();
}

void OuterHull::finish_ring() {
    slope_ = DVec<3>(0.0);
    size_ = 0;
    for (const std::uint32_t h : ring_) {
        const DVec<3> from = points_[origin_[h]] - middle_, to = points_[origin_[following(h)]] - middle_;
        slope_ += cross(from, to);
        size_ = std::max(size_, length_squared(from));
    }
    size_ = std::sqrt(size_);
}

/// Six times the difference of the volumes of the ring's cones to `apex`, relative to the middle, and to the middle.
double OuterHull::volume_to(const DVec<3>& apex) const {
    return dot(slope_, apex);
}

/// An estimate of the cost of a collapse, as six times a volume: the new point moves along the mean of the normals
/// until it is outside of all planes.
double OuterHull::estimated_cost(std::uint32_t half_edge) {
    const std::uint32_t a = origin_[half_edge], b = origin_[twin_[half_edge]];
    const std::uint32_t left = half_edge / 3, right = twin_[half_edge] / 3;
    star_.clear();
    each_leaving(a, [&](std::uint32_t h) { star_.push_back(h / 3); });
    each_leaving(b, [&](std::uint32_t h) {
        if (h / 3 != left && h / 3 != right) star_.push_back(h / 3);
    });
    const DVec<3> middle = (points_[a] + points_[b]) * 0.5;
    DVec<3> direction(0.0), slope(0.0);
    double old = 0;
    for (const std::uint32_t triangle : star_) {
        const Plane<3>& plane = planes_[triangle];
        direction += plane.normal;
        slope += plane.normal * areas_[triangle];
        old += areas_[triangle] * (plane.offset - dot(plane.normal, middle));
    }
    double out = 0;
    for (const std::uint32_t triangle : star_) {
        const Plane<3>& plane = planes_[triangle];
        const double rise = dot(plane.normal, direction), need = plane.offset - dot(plane.normal, middle);
        if (!(rise > 1e-3)) return std::numeric_limits<double>::max();
        if (need > out * rise) out = need / rise;
    }
    return dot(slope, direction) * out - old;
}

std::optional<OuterHull::Merge> OuterHull::merge_at(std::uint32_t half_edge) {
    gather_ring(half_edge);
    limits_.clear();
    const auto local = [&](const Plane<3>& plane) {
        return Plane<3>{plane.normal, plane.offset - dot(plane.normal, middle_)};
    };
    double old = 0;
    for (const std::uint32_t triangle : star_) {
        limits_.push_back(local(planes_[triangle]));
        const DVec<3> a = points_[corner(triangle, 0)] - middle_, b = points_[corner(triangle, 1)] - middle_,
                      c = points_[corner(triangle, 2)] - middle_;
        old += dot(cross(a, b), c);
    }
    for (const std::uint32_t h : ring_) {
        Plane<3> outer = local(planes_[twin_[h] / 3]);
        outer.offset += flatness;
        limits_.push_back(flipped(outer));
    }
    const std::optional<DVec<3>> apex = lowest_above(limits_, slope_, size_);
    if (!apex) return std::nullopt;
    // A volume below the old one by more than rounding means that the surface would turn inside out.
    const double added = volume_to(*apex) - old;
    if (added < -1e-9 * size_ * size_ * size_) return std::nullopt;
    return Merge{*apex + middle_, added};
}

/// The link condition: two neighbours with a third common neighbour beside those of their two triangles would fold the
/// surface.
bool OuterHull::can_merge(std::uint32_t half_edge) {
    if (count_ <= 4) return false;
    ++search_;
    each_leaving(origin_[half_edge], [&](std::uint32_t h) { mark_[origin_[twin_[h]]] = search_; });
    std::size_t common = 0;
    each_leaving(origin_[twin_[half_edge]],
                 [&](std::uint32_t h) { common += mark_[origin_[twin_[h]]] == search_ ? 1u : 0u; });
    return common == 2;
}

void OuterHull::set_plane(std::uint32_t triangle) {
    const DVec<3>&a = points_[corner(triangle, 0)], &b = points_[corner(triangle, 1)],
          &c = points_[corner(triangle, 2)];
    const DVec<3> u = b - a, v = c - a, normal = cross(u, v);
    const double area = length(normal);
    areas_[triangle] = area;
    const double longest = std::max(length_squared(u), length_squared(v));
    if (!(area > 1e-10 * longest)) return;
    planes_[triangle].normal = normal / area;
    planes_[triangle].offset = std::max(
        {dot(planes_[triangle].normal, a), dot(planes_[triangle].normal, b), dot(planes_[triangle].normal, c)});
}

/// Edge collapse: the first end of the half-edge moves to `point`; the other end and the two triangles are removed.
void OuterHull::merge(std::uint32_t half_edge, const DVec<3>& point) {
    gather_ring(half_edge);
    const std::uint32_t a = origin_[half_edge], b = origin_[twin_[half_edge]];
    each_leaving(b, [&](std::uint32_t h) { origin_[h] = a; });
    points_[a] = point;
    leaving_[b] = none;
    for (const std::uint32_t side : {half_edge, twin_[half_edge]}) {
        const std::uint32_t first = following(side), second = following(first);
        const std::uint32_t one = twin_[first], other = twin_[second];
        leaving_[origin_[one]] = one;
        leaving_[origin_[other]] = other;
        twin_[one] = other;
        twin_[other] = one;
    }
    // A degenerate triangle takes the plane of its neighbour across the ring.
    for (const std::uint32_t h : ring_) {
        planes_[h / 3] = planes_[twin_[h] / 3];
        set_plane(h / 3);
    }
    for (const std::uint32_t side : {half_edge, twin_[half_edge]})
        for (const std::uint32_t h : {side, following(side), following(following(side))}) origin_[h] = none;
    --count_;
}

void OuterHull::push(std::uint32_t half_edge) {
    if (twin_[half_edge] < half_edge) half_edge = twin_[half_edge];
    heap_.push_back({estimated_cost(half_edge), half_edge, ++version_[half_edge]});
}

namespace {

constexpr auto later = [](const auto& a, const auto& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.half_edge > b.half_edge;
};

}  // namespace

void OuterHull::push_all() {
    heap_.clear();
    for (std::uint32_t h = 0; h < origin_.size(); ++h)
        if (origin_[h] != none && h < twin_[h]) push(h);
    std::make_heap(heap_.begin(), heap_.end(), later);
}

void OuterHull::simplify(std::size_t count) {
    bool fresh = false;
    while (count_ > count) {
        if (heap_.empty()) {
            if (fresh) return;
            push_all();
            fresh = true;
            if (heap_.empty()) return;
        }
        std::pop_heap(heap_.begin(), heap_.end(), later);
        const HeapEntry next = heap_.back();
        heap_.pop_back();
        if (origin_[next.half_edge] == none || version_[next.half_edge] != next.version) continue;
        if (!can_merge(next.half_edge)) continue;
        const std::optional<Merge> found = merge_at(next.half_edge);
        if (!found) continue;
        if (!heap_.empty() && found->added > heap_.front().cost && found->added > next.cost) {
            heap_.push_back({found->added, next.half_edge, next.version});
            std::push_heap(heap_.begin(), heap_.end(), later);
            continue;
        }
        const std::uint32_t survivor = origin_[next.half_edge];
        merge(next.half_edge, found->point);
        fresh = false;
        std::vector<std::uint32_t> again;
        each_leaving(survivor, [&](std::uint32_t h) { again.push_back(h); });
        for (const std::uint32_t h : again) {
            const std::size_t before = heap_.size();
            push(h);
            if (heap_.size() > before) std::push_heap(heap_.begin(), heap_.end(), later);
        }
    }
}

}  // namespace abut::detail
