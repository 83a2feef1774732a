#include <abut/convex/ray_forms.hpp>

namespace abut {
namespace {

/// An edge and the line through it, seen from where the beam begins.
struct Edge {
    DVec<2> along;
    DVec<2> out;    ///< as long as the edge
    double height;  ///< of the beam's origin over the line, in lengths of `out`
    double sinks;   ///< by how much the beam comes nearer, per length

    Edge(const Beam<2>& beam, const Vec2& from, const Vec2& to, double turn) {
        const DVec<2> a(from);
        along = DVec<2>(to) - a;
        out = DVec<2>(along.y * turn, -along.x * turn);
        height = dot(out, beam.origin - a);
        sinks = -dot(out, beam.direction);
    }
};

/// 1 where the corners go round counter-clockwise, -1 where clockwise, 0 where they lie on a line.
double turn_of(std::span<const Vec2> points) {
    if (points.size() > 3) return 1;
    const DVec<2> a(points[0]);
    const double area = cross(DVec<2>(points[1]) - a, DVec<2>(points[2]) - a);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

}  // namespace

RayEntry<2> enter_polygon(const Beam<2>& beam, std::span<const Vec2> points, double radius) {
    const std::size_t count = points.size();
    const double turn = turn_of(points);
    if (turn == 0) return {};
    const auto edge = [&](std::size_t i) { return Edge(beam, points[i], points[i + 1 == count ? 0 : i + 1], turn); };
    const double doubt = ray_doubt * (largest(beam.origin) + largest(DVec<2>(points[0])) + radius);

    RayCut cut;
    std::size_t in = count, out = count;
    for (std::size_t i = 0; i < count && !(cut.lower > cut.upper); ++i) {
        Edge line = edge(i);
        if (radius > 0) line.height -= radius * length(line.out);
        // Compared before they are divided: most lines cut nothing off.
        if (line.sinks > 0) {
            if (!(line.height > cut.lower * line.sinks)) continue;
            cut.lower = line.height / line.sinks;
            in = i;
        } else if (line.sinks < 0) {
            if (!(line.height > cut.upper * line.sinks)) continue;
            cut.upper = line.height / line.sinks;
            out = i;
        } else if (line.height > 0) {
            return line.height > doubt * length(line.out) ? ray_misses<2>() : RayEntry<2>();
        }
    }
    if (cut.lower > beam.length) return ray_misses<2>();
    if (in == count || out == count) return {};
    const Edge entered = edge(in), left = edge(out);
    const double width = length(entered.out);
    cut.slope_in = entered.sinks / width;
    if (!(cut.lower <= cut.upper && cut.upper >= 0)) cut.slope_out = -left.sinks / length(left.out);
    RayEntry<2> result;
    result.answer = cut.answer(beam.length, doubt);
    if (result.answer != RayAnswer::enters) return result;

    // Where the corner is sharp, its two lines may meet elsewhere than it is; and round a corner the ball is round.
    const double part = dot(beam.at(cut.lower) - DVec<2>(points[in]), entered.along);
    const double slack = radius > 0 ? 0 : doubt * width;
    const bool skims = cut.slope_in < 1e-6 * length(beam.direction);
    if (skims || !(part >= -slack && part <= width * width + slack)) return {};
    result.along = cut.lower;
    result.normal = entered.out;
    result.kind = FeatureKind::edge;
    result.index = edge_index(static_cast<std::uint32_t>(in), static_cast<std::uint32_t>(in + 1 == count ? 0 : in + 1));
    return result;
}

}  // namespace abut
