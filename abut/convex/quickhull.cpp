// Quickhull (Barber, Dobkin, Huhdanpaa: "The quickhull algorithm for convex hulls", 1996), farthest point first, with
// the points outside of each facet in a list of its own.

#include <abut/convex/quickhull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

double distance_squared_to_segment(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b) {
    const DVec<3> along = b - a;
    const double weight = std::clamp(dot(p - a, along) / length_squared(along), 0.0, 1.0);
    return length_squared(p - a - along * weight);
}

class Quickhull {
public:
    Quickhull(std::span<const GridPoint> points, double tolerance)
        : points_(points), tolerance_(tolerance), next_outside_(points.size(), none), leaving_(points.size(), none) {}

    void run(std::array<std::uint32_t, 4> start);
    TriangleSurface surface() const;

private:
    struct Facet {
        std::array<std::uint32_t, 3> corner{};  ///< half-edge i runs from corner i to corner i + 1
        std::array<std::uint32_t, 3> twin{};
        GridPoint normal{0};
        double inverse_length = 0;     ///< of the normal
        std::uint32_t outside = none;  ///< the first of the points above it, linked by next_outside_
        std::uint32_t farthest = none;
        double height = 0;  ///< of the farthest
        bool alive = true;
    };

    std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    double height(const Facet& facet, std::uint32_t point) const;
    double distance(const Facet& facet, std::uint32_t point) const;
    double farthest_left_out(const Facet& facet) const;
    std::uint32_t next_eye(const Facet& facet) const;
    void assign(std::uint32_t point, std::uint32_t first_facet);
    void insert(std::uint32_t eye, std::uint32_t seen);
    std::uint32_t origin(std::uint32_t half_edge) const { return facets_[half_edge / 3].corner[half_edge % 3]; }

    std::span<const GridPoint> points_;
    double tolerance_;
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> next_outside_;  ///< one a point
    std::vector<std::uint32_t> leaving_;       ///< one a point: the new facet on the edge of the horizon that leaves it
    std::vector<std::uint32_t> visible_;       ///< the facets that the new point sees
    std::vector<std::uint32_t> horizon_;       ///< half-edges of the facets behind the horizon
};

std::uint32_t Quickhull::add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Facet facet;
    facet.corner = {a, b, c};
    facet.normal = grid_normal(points_[a], points_[b], points_[c]);
    facet.inverse_length = 1 / length(DVec<3>(facet.normal));
    facets_.push_back(facet);
    return static_cast<std::uint32_t>(facets_.size() - 1);
}

/// Above the facet, in steps of the grid; of the exact sign.
double Quickhull::height(const Facet& facet, std::uint32_t point) const {
    return grid_dot(facet.normal, points_[point] - points_[facet.corner[0]]) * facet.inverse_length;
}

/// From a point above the facet to the triangle itself, not to its plane alone: beyond a sharp corner a point can be
/// low above every facet and still far from all of them.
double Quickhull::distance(const Facet& facet, std::uint32_t point) const {
    const DVec<3> p(points_[point]), normal(facet.normal);
    bool over = true;
    double to_edge_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3> a(points_[facet.corner[i]]), b(points_[facet.corner[(i + 1) % 3]]);
        over = over && dot(cross(normal, b - a), p - a) >= 0;
        to_edge_squared = std::min(to_edge_squared, distance_squared_to_segment(p, a, b));
    }
    return over ? height(facet, point) : std::sqrt(to_edge_squared);
}

/// The point above the facet to go on with; none where all are near enough to be left out. A hull only grows, so they
/// stay near enough.
std::uint32_t Quickhull::next_eye(const Facet& facet) const {
    if (facet.outside == none || facet.height > tolerance_) return facet.farthest;
    std::uint32_t result = none;
    double most = 0;
    for (std::uint32_t point = facet.outside; point != none; point = next_outside_[point]) {
        const double above = height(facet, point);
        if (above > most && distance(facet, point) > tolerance_) {
            most = above;
            result = point;
        }
    }
    return result;
}

/// Puts the point on the list of the facet that it is highest above, of those from `first_facet` on; a point above none
/// of them is inside.
void Quickhull::assign(std::uint32_t point, std::uint32_t first_facet) {
    std::uint32_t best = none;
    double most = 0;
    for (std::uint32_t f = first_facet; f < facets_.size(); ++f) {
        const double above = height(facets_[f], point);
        if (above > most) {
            most = above;
            best = f;
        }
    }
    if (best == none) return;
    Facet& facet = facets_[best];
    next_outside_[point] = facet.outside;
    facet.outside = point;
    if (most > facet.height) {
        facet.height = most;
        facet.farthest = point;
    }
}

/// Replaces the facets that the eye sees, one of them known, by the cone from the eye over their outline. What a facet
/// is seen by is exact, so they are one piece without holes, and the outline passes each of its points once.
void Quickhull::insert(std::uint32_t eye, std::uint32_t seen) {
    visible_.assign(1, seen);
    horizon_.clear();
    facets_[seen].alive = false;
    for (std::size_t i = 0; i < visible_.size(); ++i)
        for (const std::uint32_t twin : facets_[visible_[i]].twin) {
            Facet& neighbor = facets_[twin / 3];
            if (!neighbor.alive) continue;
            if (height(neighbor, eye) > 0) {
                neighbor.alive = false;
                visible_.push_back(twin / 3);
            } else {
                horizon_.push_back(twin);
            }
        }

    const auto first_new = static_cast<std::uint32_t>(facets_.size());
    for (const std::uint32_t behind : horizon_) {
        const std::uint32_t from = origin(following(behind));
        const std::uint32_t facet = add_facet(from, origin(behind), eye);
        facets_[facet].twin[0] = behind;
        facets_[behind / 3].twin[behind % 3] = 3 * facet;
        leaving_[from] = facet;
    }
    for (std::uint32_t facet = first_new; facet < facets_.size(); ++facet) {
        const std::uint32_t neighbor = leaving_[facets_[facet].corner[1]];
        facets_[facet].twin[1] = 3 * neighbor + 2;
        facets_[neighbor].twin[2] = 3 * facet + 1;
    }

    for (const std::uint32_t old : visible_)
        for (std::uint32_t point = facets_[old].outside, next; point != none; point = next) {
            next = next_outside_[point];
            if (point != eye) assign(point, first_new);
        }
}

void Quickhull::run(std::array<std::uint32_t, 4> start) {
    // A triangle with two sides, of which the fourth point sees the front, makes the first tetrahedron.
    if (grid_dot(grid_normal(points_[start[0]], points_[start[1]], points_[start[2]]),
                 points_[start[3]] - points_[start[0]]) < 0)
        std::swap(start[1], start[2]);
    const std::uint32_t front = add_facet(start[0], start[1], start[2]);
    const std::uint32_t back = add_facet(start[0], start[2], start[1]);
    facets_[front].twin = {3 * back + 2, 3 * back + 1, 3 * back};
    facets_[back].twin = {3 * front + 2, 3 * front + 1, 3 * front};
    insert(start[3], front);
    for (std::uint32_t point = 0; point < points_.size(); ++point) assign(point, back);

    // Each turn takes a point into the hull or leaves the facet for good.
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
        if (!facets_[f].alive) continue;
        const std::uint32_t eye = next_eye(facets_[f]);
        if (eye != none) insert(eye, f);
    }
}

double Quickhull::farthest_left_out(const Facet& facet) const {
    double result = 0;
    for (std::uint32_t point = facet.outside; point != none; point = next_outside_[point])
        result = std::max(result, distance(facet, point));
    return result;
}

TriangleSurface Quickhull::surface() const {
    std::vector<std::uint32_t> number(facets_.size(), none);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < facets_.size(); ++f)
        if (facets_[f].alive) number[f] = count++;
    TriangleSurface result;
    for (const Facet& facet : facets_) {
        if (!facet.alive) continue;
        result.origin.insert(result.origin.end(), facet.corner.begin(), facet.corner.end());
        for (const std::uint32_t twin : facet.twin) result.twin.push_back(3 * number[twin / 3] + twin % 3);
        result.normals.push_back(facet.normal);
        result.left_out = std::max(result.left_out, farthest_left_out(facet));
    }
    return result;
}

}  // namespace

GridPoint grid_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    const GridPoint u = b - a, v = c - a;
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double grid_dot(const GridPoint& normal, const GridPoint& difference) {
    // normal = high 2^26 + low with 0 <= low < 2^26, so that neither sum leaves 64 bits; then the same for the result.
    constexpr int shift = 26;
    constexpr std::int64_t mask = (std::int64_t{1} << shift) - 1;
    std::int64_t high = 0, low = 0;
    for (int i = 0; i < 3; ++i) {
        high += (normal[i] >> shift) * difference[i];
        low += (normal[i] & mask) * difference[i];
    }
    high += low >> shift;
    low &= mask;
    return static_cast<double>(high) * 0x1p26 + static_cast<double>(low);
}

TriangleSurface quickhull(std::span<const GridPoint> points, const std::array<std::uint32_t, 4>& start,
                          double tolerance) {
    Quickhull hull(points, tolerance);
    hull.run(start);
    return hull.surface();
}

}  // namespace abut
