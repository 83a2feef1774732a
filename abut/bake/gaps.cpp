#include <abut/bake/gaps.hpp>
#include <abut/convex/features.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace abut {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double weight = 0.3;  // k of CoACD

double cube_root(double x) {
    if (!(x > 0)) return 0;
    int exponent = 0;
    std::frexp(x, &exponent);
    double root = std::ldexp(1.0, exponent / 3 + 1);  // above it: Newton's steps go down, and end
    constexpr int most = 60;
    for (int i = 0; i < most; ++i) {
        const double next = (2 * root + x / (root * root)) / 3;
        if (!(next < root)) break;
        root = next;
    }
    return root;
}

/// The middles of the cells of all triangles, cut into parts about a fifth as long as the whole.
std::vector<DVec<3>> samples_of(std::span<const Corners> triangles) {
    double extent = 0;
    for (const Corners& t : triangles)
        for (const DVec<3>& p : t) extent = std::max(extent, largest(p - triangles[0][0]));
    std::vector<DVec<3>> result;
    for (const auto& [a, b, c] : triangles) {
        const double longest =
            std::sqrt(std::max({length_squared(b - a), length_squared(c - b), length_squared(a - c)}));
        constexpr double cells_an_extent = 5, most = 5;
        const int cells = static_cast<int>(std::clamp(std::ceil(longest / extent * cells_an_extent), 1.0, most));
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

/// A triangle, and a ball around it, by which most are passed over.
struct Target {
    Corners corners;
    DVec<3> center;
    double radius;
};

Target target(const Corners& t) {
    const DVec<3> center = (t[0] + t[1] + t[2]) / 3.0;
    double square = 0;
    for (const DVec<3>& p : t) square = std::max(square, length_squared(p - center));
    return {t, center, std::sqrt(square)};
}

/// The lesser of what is known already and the distance, squared.
double nearer(double known, const Target& target, const DVec<3>& p) {
    const double reach = std::sqrt(known) + target.radius;
    if (length_squared(p - target.center) >= reach * reach) return known;
    const auto& [a, b, c] = target.corners;
    return std::min(known, length_squared(p - closest_on_triangle(a, b, c, p).point));
}

/// How far points are from the caps of a piece, each a region of a plane that its outline winds around.
class Caps {
public:
    explicit Caps(const Piece& piece) : piece_(piece), outlines_(piece.cap_origins.size()) {
        for (const CapEdge& edge : piece.cap_edges)
            outlines_[edge.cap].push_back({piece.points[edge.from], piece.points[edge.to]});
    }

    double distance_squared(const DVec<3>& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t cap = 0; cap < outlines_.size(); ++cap) {
            if (outlines_[cap].empty()) continue;
            const DVec<3>& normal = piece_.cap_normals[cap];
            const double height = dot(normal, p - piece_.cap_origins[cap]);
            if (height * height >= least) continue;
            least = inside(cap, p) ? height * height : std::min(least, to_outline(cap, p));
        }
        return least;
    }

private:
    bool inside(std::size_t cap, const DVec<3>& p) const {
        const DVec<3>& normal = piece_.cap_normals[cap];
        const DVec<3> steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
        const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
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
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b] : outlines_[cap]) {
            const DVec<3> along = b - a;
            const double square = length_squared(along);
            const double share = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
            least = std::min(least, length_squared(p - a - along * share));
        }
        return least;
    }

    const Piece& piece_;
    std::vector<std::vector<std::array<DVec<3>, 2>>> outlines_;
};

/// The distance, squared; 0 inside.
double distance_squared(const HullSides& hull, const DVec<3>& p) {
    const bool inside =
        !hull.planes.empty() && std::all_of(hull.planes.begin(), hull.planes.end(), [&](const RoughHull::Plane& plane) {
            return dot(plane.normal, p) <= plane.offset;
        });
    double least = inside ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.triangles.size() && least > 0; ++i)
        least = nearer(least, target(hull.triangles[i]), p);
    return least;
}

/// The largest distance, of the samples first. No point is farther than its neighbour by more than what parts the two:
/// where that leaves room for a distance above what is looked for, triangles are halved and their middles are samples,
/// too.
template <class Distance>
double farthest(std::span<const Corners> triangles, const GapSearch& search, Distance squared) {
    double most = 0;
    const auto distance = [&](const DVec<3>& p) {
        const double found = squared(p);
        return std::isfinite(found) ? std::sqrt(found) : 0;
    };
    for (const DVec<3>& p : samples_of(triangles)) most = std::max(most, distance(p));
    std::vector<Corners> waiting(triangles.begin(), triangles.end());
    while (!waiting.empty() && most <= search.enough) {
        const Corners corners = waiting.back();
        waiting.pop_back();
        const Target ball = target(corners);
        const double here = distance(ball.center);
        most = std::max(most, here);
        if (here + ball.radius <= search.enough + search.precision) continue;
        std::size_t longest = 0;
        const auto side = [&](std::size_t i) { return length_squared(corners[(i + 1) % 3] - corners[i]); };
        for (std::size_t i = 1; i < 3; ++i)
            if (side(i) > side(longest)) longest = i;
        const std::size_t next = (longest + 1) % 3;
        const DVec<3> middle = (corners[longest] + corners[next]) * 0.5;
        Corners first = corners, second = corners;
        first[next] = second[longest] = middle;
        waiting.push_back(first);
        waiting.push_back(second);
    }
    return most;
}

}  // namespace

double volume_as_length(double volume) {
    return weight * cube_root(3 * volume / (4 * pi));
}

double length_as_volume(double length) {
    const double radius = length / weight;
    return 4 * pi / 3 * radius * radius * radius;
}

HullSides coarse_sides(std::span<const DVec<3>> points, RoughHull& hull) {
    constexpr double coarse = 5e-3;
    hull.build(points, coarse);
    HullSides result;
    for (const auto& [a, b, c] : hull.triangles()) result.triangles.push_back({points[a], points[b], points[c]});
    result.planes = hull.planes();
    return result;
}

double farthest_from(const Piece& piece, const HullSides& sides, const GapSearch& search) {
    const Caps caps(piece);
    std::vector<Target> targets;
    targets.reserve(piece.triangles.size());
    for (const glm::uvec3& t : piece.triangles)
        targets.push_back(target({piece.points[t.x], piece.points[t.y], piece.points[t.z]}));
    return farthest(sides.triangles, search, [&](const DVec<3>& p) {
        double least = caps.distance_squared(p);
        for (const Target& t : targets) least = nearer(least, t, p);
        return least;
    });
}

double farthest_from(const HullSides& first, const HullSides& second, const HullSides& sides, const GapSearch& search) {
    return farthest(sides.triangles, search, [&](const DVec<3>& p) {
        return std::min(distance_squared(first, p), distance_squared(second, p));
    });
}

}  // namespace abut
