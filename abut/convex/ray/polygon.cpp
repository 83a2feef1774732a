#include <abut/convex/ray/closed_forms.hpp>

namespace abut::detail {
namespace {

/// An edge and the line through it, relative to the ray's origin.
struct Edge {
    DVec<2> along;
    DVec<2> out;     ///< as long as the edge
    double height;   ///< of the ray's origin over the line, in lengths of `out`
    double descent;  ///< the decrease of the height per length of the ray

    Edge(const DRay<2>& ray, const Vec2& from, const Vec2& to, double turn) {
        const DVec<2> a(from);
        along = DVec<2>(to) - a;
        out = DVec<2>(along.y * turn, -along.x * turn);
        height = dot(out, ray.origin - a);
        descent = -dot(out, ray.direction);
    }
};

/// 1 for counter-clockwise corners, -1 for clockwise ones, 0 for collinear ones.
double turn_of(std::span<const Vec2> points) {
    if (points.size() > 3) return 1;
    const DVec<2> a(points[0]);
    const double area = cross(DVec<2>(points[1]) - a, DVec<2>(points[2]) - a);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

}  // namespace

RayEntry<2> enter_polygon(const DRay<2>& ray, std::span<const Vec2> points, double radius) {
    const std::size_t count = points.size();
    const double turn = turn_of(points);
    if (turn == 0) return {};
    const auto edge = [&](std::size_t i) { return Edge(ray, points[i], points[i + 1 == count ? 0 : i + 1], turn); };
    const double tolerance = ray_tolerance * (largest(ray.origin) + largest(DVec<2>(points[0])) + radius);

    RayCut cut;
    std::size_t in = count, out = count;
    for (std::size_t i = 0; i < count && !(cut.lower > cut.upper); ++i) {
        Edge line = edge(i);
        if (radius > 0) line.height -= radius * length(line.out);
        // Compared before the division: most lines clip nothing.
        if (line.descent > 0) {
            if (!(line.height > cut.lower * line.descent)) continue;
            cut.lower = line.height / line.descent;
            in = i;
        } else if (line.descent < 0) {
            if (!(line.height > cut.upper * line.descent)) continue;
            cut.upper = line.height / line.descent;
            out = i;
        } else if (line.height > 0) {
            return line.height > tolerance * length(line.out) ? ray_misses<2>() : RayEntry<2>();
        }
    }
    if (cut.lower > ray.length) return ray_misses<2>();
    if (in == count || out == count) return {};
    const Edge entered = edge(in), left = edge(out);
    const double width = length(entered.out);
    cut.slope_in = entered.descent / width;
    if (!(cut.lower <= cut.upper && cut.upper >= 0)) cut.slope_out = -left.descent / length(left.out);
    RayEntry<2> result;
    result.answer = cut.answer(ray.length, tolerance);
    if (result.answer != RayAnswer::enters) return result;

    // At a sharp corner the two lines may cross away from it, and around a corner the ball is round.
    const double part = dot(ray.at(cut.lower) - DVec<2>(points[in]), entered.along);
    const double edge_tolerance = radius > 0 ? 0 : tolerance * width;
    const bool skims = cut.slope_in < 1e-6 * length(ray.direction);
    if (skims || !(part >= -edge_tolerance && part <= width * width + edge_tolerance)) return {};
    result.along = cut.lower;
    result.normal = entered.out;
    result.kind = FeatureKind::edge;
    result.index = edge_index(static_cast<std::uint32_t>(in), static_cast<std::uint32_t>(in + 1 == count ? 0 : in + 1));
    return result;
}

}  // namespace abut::detail
