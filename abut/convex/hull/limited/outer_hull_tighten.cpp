// Moves corners to positions of minimum volume.

#include <abut/convex/hull/limited/outer_hull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {
namespace {

constexpr int max_moves = 4, max_halvings = 5;
constexpr double min_tightening_gain = 1e-4;

}  // namespace

/// Whether a corner can move: its triangles then contain `inside`, and stay convex.
bool OuterHull::fits(std::uint32_t point, const DVec<3>& at, const VertexGraph& inside) {
    bool result = true;
    each_leaving(point, [&](std::uint32_t h) {
        if (!result) return;
        // Across the edge h: the third corner of the neighbouring triangle.
        const DVec<3> b = points_[origin_[following(h)]], c = points_[origin_[following(following(h))]],
                      d = points_[origin_[following(following(twin_[h]))]];
        const DVec<3> u = b - at, v = c - at, w = d - at, normal = cross(u, v);
        const double area = length(normal);
        touched_ = inside.highest(normal, touched_);
        result =
            dot(normal, w) <= 2 * flatness * area && dot(normal, inside.points()[touched_] - at) <= flatness * area;
    });
    return result;
}

void OuterHull::move(std::uint32_t point, const DVec<3>& to) {
    points_[point] = to;
    for (const std::uint32_t h : ring_) {
        planes_[h / 3] = planes_[twin_[h] / 3];
        set_plane(h / 3);
    }
}

/// Edge flip of two coplanar triangles, if the other diagonal is inside of them.
bool OuterHull::flip(std::uint32_t half_edge) {
    const std::uint32_t h = half_edge, h1 = following(h), h2 = following(h1);
    const std::uint32_t g = twin_[h], g1 = following(g), g2 = following(g1);
    const std::uint32_t c = origin_[h], d = origin_[g], v = origin_[h2], w = origin_[g2];
    const DVec<3>& normal = planes_[g / 3].normal;
    const DVec<3> across = points_[w] - points_[v], to_c = points_[c] - points_[v], to_d = points_[d] - points_[v];
    const double tolerance = 1e-9 * length_squared(across);
    if (std::abs(dot(normal, points_[v] - points_[w])) > 1e-9 * length(across)) return false;
    if (!(dot(normal, cross(to_c, across)) > tolerance) || !(dot(normal, cross(across, to_d)) > tolerance))
        return false;
    std::size_t at_c = 0, at_d = 0;
    bool neighbours = false;
    each_leaving(c, [&](std::uint32_t) { ++at_c; });
    each_leaving(d, [&](std::uint32_t) { ++at_d; });
    each_leaving(v, [&](std::uint32_t from) { neighbours = neighbours || origin_[twin_[from]] == w; });
    if (at_c < 4 || at_d < 4 || neighbours) return false;

    const std::uint32_t over_dv = twin_[h1], over_vc = twin_[h2], over_cw = twin_[g1], over_wd = twin_[g2];
    const auto link = [&](std::uint32_t one, std::uint32_t from, std::uint32_t other) {
        origin_[one] = from;
        twin_[one] = other;
        twin_[other] = one;
    };
    link(h, w, g);
    link(h1, v, over_vc);
    link(h2, c, over_cw);
    link(g, v, h);
    link(g1, w, over_wd);
    link(g2, d, over_dv);
    leaving_[v] = h1;
    leaving_[c] = h2;
    leaving_[w] = g1;
    leaving_[d] = g2;
    planes_[h / 3] = planes_[g / 3];
    set_plane(h / 3);
    set_plane(g / 3);
    return true;
}

/// Flips flat edges to give a corner more triangles.
bool OuterHull::add_triangles(std::uint32_t point) {
    bool result = false;
    for (const std::uint32_t h : std::vector<std::uint32_t>(ring_))
        if (origin_[following(following(h))] == point && flip(h)) result = true;
    return result;
}

/// The constraints of a corner: above the plane through each edge of the ring that touches `inside`, so that it stays
/// contained, and below the planes across the ring, so that the surface stays convex.
void OuterHull::cut_around(std::uint32_t point, const VertexGraph& inside) {
    gather_ring_of_point(point);
    limits_.clear();
    for (const std::uint32_t h : ring_) {
        const Plane<3>& outer = planes_[twin_[h] / 3];
        const DVec<3> from = points_[origin_[h]], along = points_[origin_[following(h)]] - from;
        const DVec<3> on = normalized(cross(outer.normal, along));
        touched_ = inside.first_touched(from, on, outer.normal, 1e-12 * length(along), touched_);
        const DVec<3> seen = inside.points()[touched_] - from;
        const double x = dot(on, seen), y = std::max(0.0, -dot(outer.normal, seen));
        const DVec<3> normal = normalized(outer.normal * x + on * y), local = from - middle_;
        limits_.push_back({normal, dot(normal, local)});
        limits_.push_back(flipped<3>({outer.normal, dot(outer.normal, local) + flatness}));
    }
}

void OuterHull::tighten(const VertexGraph& inside, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        double gain = 0, size = 0;
        for (std::uint32_t point = 0; point < points_.size(); ++point) {
            if (!has_point(point)) continue;
            for (int turn = 0; turn < max_moves; ++turn) {
                cut_around(point, inside);
                size = std::max(size, size_);
                const std::optional<DVec<3>> found = lowest_above(limits_, slope_, size_);
                if (!found || !(volume_to(*found) < 0)) break;
                DVec<3> step = *found;
                int halvings = 0;
                while (halvings < max_halvings && !fits(point, middle_ + step, inside)) {
                    ++halvings;
                    step *= 0.5;
                }
                if (halvings == max_halvings) break;
                gain -= volume_to(step);
                move(point, middle_ + step);
                if (!add_triangles(point)) break;
            }
        }
        if (!(gain > min_tightening_gain * size * size * size)) return;
    }
}

}  // namespace abut::detail
