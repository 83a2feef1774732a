#include <abut/bake/parts/concavity.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace abut::detail {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double volume_weight = 0.3;  // k of CoACD

double cube_root(double x) {
    if (!(x > 0)) return 0;
    int exponent = 0;
    std::frexp(x, &exponent);
    double root = std::ldexp(1.0, exponent / 3 + 1);  // above the root, so Newton's iteration decreases and ends
    constexpr int farthest_found = 60;
    for (int i = 0; i < farthest_found; ++i) {
        const double next = (2 * root + x / (root * root)) / 3;
        if (!(next < root)) break;
        root = next;
    }
    return root;
}

/// Sample points: the centers of the cells of all triangles, which are subdivided to about a fifth of the total extent.
std::vector<DVec<3>> samples_of(std::span<const Corners> triangles) {
    double extent = 0;
    for (const Corners& t : triangles)
        for (const DVec<3>& p : t) extent = std::max(extent, largest(p - triangles[0][0]));
    std::vector<DVec<3>> result;
    for (const auto& [a, b, c] : triangles) {
        const double longest =
            square_root(std::max({length_squared(b - a), length_squared(c - b), length_squared(a - c)}));
        constexpr double cells_an_extent = 5, farthest_found = 5;
        const int cells =
            static_cast<int>(std::clamp(std::ceil(longest / extent * cells_an_extent), 1.0, farthest_found));
        const DVec<3> u = (b - a) / static_cast<double>(cells), v = (c - a) / static_cast<double>(cells);
        for (int i = 0; i < cells; ++i)
            for (int j = 0; i + j < cells; ++j) {
                const DVec<3> corner = a + u * static_cast<double>(i) + v * static_cast<double>(j);
                result.push_back(corner + (u + v) / 3.0);
                if (i + j + 1 < cells) result.push_back(corner + (u + v) * (2.0 / 3.0));
            }
    }
    return result;
}

/// A triangle and its bounding sphere, for early rejection.
struct BoundedTriangle {
    Corners corners;
    DVec<3> center;
    double radius;
};

BoundedTriangle bounded(const Corners& t) {
    const DVec<3> center = (t[0] + t[1] + t[2]) / 3.0;
    double square = 0;
    for (const DVec<3>& p : t) square = std::max(square, length_squared(p - center));
    return {t, center, square_root(square)};
}

/// The minimum of `best` and the squared distance from the triangle.
double nearest_squared(double best, const BoundedTriangle& bounded, const DVec<3>& p) {
    const double reach = square_root(best) + bounded.radius;
    if (length_squared(p - bounded.center) >= reach * reach) return best;
    const auto& [a, b, c] = bounded.corners;
    return std::min(best, length_squared(p - closest_on_triangle(a, b, c, p).point));
}

/// Distances from the caps of a piece. A cap is the region of its plane with a nonzero winding number.
class Caps {
public:
    explicit Caps(const Piece& piece) : piece_(piece), outlines_(piece.cap_origins.size()) {
        for (const CapEdge& edge : piece.cap_edges)
            outlines_[edge.cap].push_back({piece.points[edge.from], piece.points[edge.to]});
    }

    double distance_squared(const DVec<3>& p) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t cap = 0; cap < outlines_.size(); ++cap) {
            if (outlines_[cap].empty()) continue;
            const DVec<3>& normal = piece_.cap_normals[cap];
            const double height = dot(normal, p - piece_.cap_origins[cap]);
            if (height * height >= nearest) continue;
            nearest = inside(cap, p) ? height * height : std::min(nearest, to_outline(cap, p));
        }
        return nearest;
    }

private:
    bool inside(std::size_t cap, const DVec<3>& p) const {
        const DVec<3>& normal = piece_.cap_normals[cap];
        const int up = longest_axis(normal);
        const int u = (up + 1) % 3, v = (up + 2) % 3;
        int winding = 0;
        for (const auto& [a, b] : outlines_[cap]) {
            if ((a[v] <= p[v]) == (b[v] <= p[v])) continue;
            const double at = a[u] + (b[u] - a[u]) * ((p[v] - a[v]) / (b[v] - a[v]));
            if (at > p[u]) winding += b[v] > a[v] ? 1 : -1;
        }
        return winding != 0;
    }

    double to_outline(std::size_t cap, const DVec<3>& p) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [a, b] : outlines_[cap]) {
            const DVec<3> along = b - a;
            const double square = length_squared(along);
            const double share = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
            nearest = std::min(nearest, length_squared(p - a - along * share));
        }
        return nearest;
    }

    const Piece& piece_;
    std::vector<std::vector<std::array<DVec<3>, 2>>> outlines_;
};

bool contains(const HullSurface& hull, const DVec<3>& p) {
    return !hull.planes.empty() &&
           std::all_of(hull.planes.begin(), hull.planes.end(),
                       [&](const ApproximateHull::Plane& plane) { return dot(plane.normal, p) <= plane.offset; });
}

std::array<Corners, 2> bisected(const Corners& corners) {
    std::size_t longest = 0;
    const auto side = [&](std::size_t i) { return length_squared(corners[(i + 1) % 3] - corners[i]); };
    for (std::size_t i = 1; i < 3; ++i)
        if (side(i) > side(longest)) longest = i;
    const std::size_t next = (longest + 1) % 3;
    const DVec<3> middle = (corners[longest] + corners[next]) * 0.5;
    std::array<Corners, 2> result{corners, corners};
    result[0][next] = result[1][longest] = middle;
    return result;
}

/// The largest distance of a point of `surface` from the triangles of a target and from what `other` returns the
/// squared distance of. The samples come first. The distance is Lipschitz with constant 1, so a triangle's center and
/// radius bound the distance of all its points. The distance from one triangle of the target is convex, and so largest
/// at a corner. If both bounds exceed the threshold, the triangle is bisected. Its halves look only at the triangles of
/// the target that may be the nearest of one of their points.
template <class Other>
double farthest(std::span<const Corners> surface, std::span<const BoundedTriangle> target,
                const DistanceThreshold& threshold, const Other& other) {
    double farthest_found = 0;
    const auto add = [&](double squared) {
        const double distance = std::isfinite(squared) ? square_root(squared) : 0;
        farthest_found = std::max(farthest_found, distance);
        return distance;
    };
    for (const DVec<3>& p : samples_of(surface)) {
        double nearest = other(p);
        for (std::size_t k = 0; k < target.size() && nearest > 0; ++k) nearest = nearest_squared(nearest, target[k], p);
        add(nearest);
    }

    const double allowed = threshold.limit + threshold.precision;
    const auto is_near = [&](const BoundedTriangle& triangle, const Corners& part) {
        return std::all_of(part.begin(), part.end(), [&](const DVec<3>& p) {
            return nearest_squared(allowed * allowed, triangle, p) < allowed * allowed;
        });
    };
    const auto search = [&](const auto& self, const Corners& corners, std::span<const std::uint32_t> near) -> void {
        if (farthest_found > threshold.limit) return;
        const BoundedTriangle part = bounded(corners);
        double squared = other(part.center);
        const BoundedTriangle* nearest = nullptr;
        for (std::size_t k = 0; k < near.size() && squared > 0; ++k) {
            const BoundedTriangle& t = target[near[k]];
            const double before = std::exchange(squared, nearest_squared(squared, t, part.center));
            if (squared < before) nearest = &t;
        }
        const double here = add(squared);
        if (here + part.radius <= allowed || (nearest != nullptr && is_near(*nearest, corners))) return;
        constexpr double rounding = 1.00001;
        const double reach = (here + 2 * part.radius) * rounding, square = reach * reach;
        std::vector<std::uint32_t> remaining;
        for (const std::uint32_t k : near)
            if (nearest_squared(square, target[k], part.center) < square) remaining.push_back(k);
        const auto [first, second] = bisected(corners);
        self(self, second, remaining);
        self(self, first, remaining);
    };
    std::vector<std::uint32_t> all(target.size());
    std::iota(all.begin(), all.end(), 0u);
    for (std::size_t i = surface.size(); i-- > 0;) search(search, surface[i], all);
    return farthest_found;
}

}  // namespace

double volume_as_length(double volume) {
    return volume_weight * cube_root(3 * volume / (4 * pi));
}

double length_as_volume(double length) {
    const double radius = length / volume_weight;
    return 4 * pi / 3 * radius * radius * radius;
}

HullSurface approximate_hull_surface(std::span<const DVec<3>> points, ApproximateHull& hull) {
    constexpr double tolerance = 5e-3;
    hull.build(points, tolerance);
    HullSurface result;
    for (const auto& [a, b, c] : hull.triangles()) result.triangles.push_back({points[a], points[b], points[c]});
    result.planes = hull.planes();
    return result;
}

double farthest_distance(const Piece& piece, const HullSurface& surface, const DistanceThreshold& threshold) {
    std::vector<BoundedTriangle> triangles;
    triangles.reserve(piece.triangles.size());
    for (const glm::uvec3& t : piece.triangles)
        triangles.push_back(bounded({piece.points[t.x], piece.points[t.y], piece.points[t.z]}));
    const Caps caps(piece);
    return farthest(surface.triangles, triangles, threshold,
                    [&](const DVec<3>& p) { return caps.distance_squared(p); });
}

double farthest_distance(const HullSurface& first, const HullSurface& second, const HullSurface& surface,
                         const DistanceThreshold& threshold) {
    std::vector<BoundedTriangle> triangles;
    for (const HullSurface* hull : {&first, &second})
        for (const Corners& corners : hull->triangles) triangles.push_back(bounded(corners));
    return farthest(surface.triangles, triangles, threshold, [&](const DVec<3>& p) {
        return contains(first, p) || contains(second, p) ? 0 : std::numeric_limits<double>::infinity();
    });
}

}  // namespace abut::detail
