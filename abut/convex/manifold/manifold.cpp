#include <abut/convex/face.hpp>
#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/manifold/reduce.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

/// The component of v orthogonal to the unit vector n, normalised.
template <int D>
DVec<D> across(const DVec<D>& v, const DVec<D>& n) {
    return normalized(v - n * dot(v, n), DVec<D>(0.0));
}

/// The side planes of a face through its edges along `out`, facing outwards. For an edge: its two ends, and its sides
/// `reach` away. The region between them lies in front of the face, seen along `out`.
template <int D, class Visit>
void each_side_plane(const Face<D>& face, const DVec<D>& out, double reach, Visit&& visit) {
    if (face.count == 2) {
        const DVec<D> along = across(face.points[1] - face.points[0], out);
        visit(-along, dot(-along, face.points[0]), face.indices[0]);
        visit(along, dot(along, face.points[1]), face.indices[1]);
        if constexpr (D == 3) {
            const DVec<3> side = cross(along, out);
            visit(-side, dot(-side, face.points[0]) + reach, face.indices[0]);
            visit(side, dot(side, face.points[0]) + reach, face.indices[1]);
        }
        return;
    }
    if constexpr (D == 3) {
        // One winding for all edges, so that the two long edges of a sliver face opposite directions.
        DVec<3> area(0.0);
        for (std::size_t i = 2; i < face.count; ++i)
            area += cross(face.points[i - 1] - face.points[0], face.points[i] - face.points[0]);
        const double round = dot(area, out) < 0 ? -1 : 1;
        for (std::size_t i = 0; i < face.count; ++i) {
            const DVec<3>& from = face.points[i];
            const DVec<3> edge = face.points[(i + 1) % face.count] - from;
            const DVec<3> side = normalized(cross(edge, out) * round, DVec<3>(0.0));
            visit(side, dot(side, from), face.indices[i]);
        }
    }
}

/// The height of the ball around an edge along `out`, at a point beside the edge.
double reach_beside(const Face<3>& edge, const DVec<3>& out, double radius, const DVec<3>& point) {
    const DVec<3> side = cross(across(edge.points[1] - edge.points[0], out), out);
    const double off = dot(side, point - edge.points[0]);
    return square_root(std::max(0.0, radius * radius - off * off));
}
double reach_beside(const Face<2>&, const DVec<2>&, double radius, const DVec<2>&) {
    return radius;
}

/// Whether two edges are parallel and orthogonal to the normal, such as those of two capsules.
bool side_by_side(const Face<3>& a, const Face<3>& b, const DVec<3>& normal) {
    if (a.count != 2 || b.count != 2) return false;
    const DVec<3> along_a = normalized(a.points[1] - a.points[0], DVec<3>(0.0));
    const DVec<3> along_b = normalized(b.points[1] - b.points[0], DVec<3>(0.0));
    const double tilt = square_root(1 - aligned * aligned);
    return std::abs(dot(along_a, along_b)) >= aligned && std::abs(dot(along_a, normal)) <= tilt;
}
bool side_by_side(const Face<2>&, const Face<2>&, const DVec<2>&) {
    return false;
}

/// The normal of a face's plane; for an edge, of the plane through it that faces `out` most.
template <int D>
DVec<D> plane_of(const Face<D>& face, const DVec<D>& out) {
    return face.flat() ? face.normal : across(out, normalized(face.points[1] - face.points[0]));
}

template <int D>
double alignment(const Face<D>& face, const DVec<D>& direction) {
    return face.flat() ? dot(face.normal, direction) : -1;
}

template <int D>
void record(const Face<D>& left, const DVec<D>& side, double offset, Trace<D>* trace) {
    if (trace == nullptr) return;
    ClipStep<D> step{to_float(side), static_cast<float>(offset), {}};
    for (std::size_t i = 0; i < left.count; ++i) step.points.push_back(to_float(left.points[i]));
    trace->steps.push_back(std::move(step));
}

/// The index of the largest `measure` over the candidates; of several the lowest.
template <int D, class Measure>
std::size_t index_of_max(const ManifoldCandidates<D>& all, Measure&& measure) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.count; ++i)
        if (measure(all.points[i]) > measure(all.points[best])) best = i;
    return best;
}

/// The deepest, and the one farthest from it.
std::array<std::size_t, 2> selected(const ManifoldCandidates<2>& all, std::size_t deepest, const DVec<2>&) {
    const DVec<2> first = all.points[deepest].position;
    return {deepest, index_of_max(all, [&](const ManifoldPoint<2>& p) { return length_squared(p.position - first); })};
}

/// The deepest, and the three that make the largest quadrilateral with it, seen along the normal.
std::array<std::size_t, 4> selected(const ManifoldCandidates<3>& all, std::size_t deepest, const DVec<3>& normal) {
    const int up = longest_axis(normal);
    const int u = (up + 1) % 3, v = (up + 2) % 3;
    const double slope_u = normal[u] / normal[up], slope_v = normal[v] / normal[up];
    std::array<double, Face<3>::capacity + 1> x, y;
    for (std::size_t i = 0; i < all.count; ++i) {
        const DVec<3>& position = all.points[i].position;
        x[i] = position[u] - position[up] * slope_u;
        y[i] = position[v] - position[up] * slope_v;
    }
    return largest_quadrilateral({x.data(), all.count}, {y.data(), all.count}, deepest);
}

/// The size of a set to within a factor of two, cheaper than `size`.
template <int D>
double approximate_size(const Convex<D>& convex) {
    if (!convex.similar || convex.inner_radius > 0) return size(convex);
    if (convex.core == Core::box) return convex.scale * length(DVec<D>(convex.own[0])) + convex.radius;
    if (convex.core != Core::points) return size(convex);
    const Vec<D>* points = convex.vertices();
    double farthest_squared = 0;
    for (std::uint32_t i = 1; i < convex.count; ++i)
        farthest_squared = std::max(farthest_squared, length_squared(DVec<D>(points[i]) - DVec<D>(points[0])));
    return 0.5 * convex.scale * square_root(farthest_squared) + convex.radius;
}

/// Adds the closest point if no candidate is as deep: the deepest corner may lie on no face along the normal.
template <int D>
void add_deepest(ManifoldCandidates<D>& candidates, const ManifoldPoint<D>& witness, double tolerance) {
    for (std::size_t i = 0; i < candidates.count; ++i)
        if (candidates.points[i].depth >= witness.depth - tolerance) return;
    candidates.push_back(witness);
}

/// The normal from A to B of a contact area, and the range of the depths of its points.
template <int D>
struct AreaLimits {
    DVec<D> normal;
    double depth, margin, tolerance;
};

/// Clips the incident face of two to the reference face, and adds its points: those of the contact area.
template <int D>
void add_contact_area(const Convex<D>& a, const Convex<D>& b, const Face<D>& face_a, const Face<D>& face_b,
                      bool a_is_reference, const AreaLimits<D>& limits, Trace<D>* trace,
                      ManifoldCandidates<D>& candidates) {
    const Face<D>& reference = a_is_reference ? face_a : face_b;
    Face<D> incident = a_is_reference ? face_b : face_a;
    const DVec<D> out = a_is_reference ? limits.normal : -limits.normal;
    const double reference_radius = a_is_reference ? a.radius : b.radius;
    const double incident_radius = a_is_reference ? b.radius : a.radius;
    each_side_plane(reference, out, reference_radius + limits.tolerance,
                    [&](const DVec<D>& side, double offset, std::uint32_t name) {
                        clip(incident, side, offset, name);
                        record(incident, side, offset, trace);
                    });
    const DVec<D> plane = plane_of(reference, out);
    for (std::size_t i = 0; i < incident.count; ++i) {
        const double gap = dot(plane, incident.points[i] - reference.points[0]) / dot(plane, out);
        const double reach =
            reference.flat() ? reference_radius : reach_beside(reference, out, reference_radius, incident.points[i]);
        // No point is deeper than the shapes, but faces that are not quite flat may suggest it.
        const double here = std::min(reach + incident_radius - gap, limits.depth);
        if (here < -limits.margin - limits.tolerance) continue;
        const DVec<D> middle = incident.points[i] - out * (incident_radius - 0.5 * here);
        candidates.push_back({middle, limits.margin > 0 ? here : std::max(here, 0.0), incident.indices[i]});
    }
}

}  // namespace

template <int D>
Manifold<D> reduced_manifold(const ManifoldCandidates<D>& all, const DVec<D>& normal, double tolerance) {
    Manifold<D> result;
    if (all.count <= result.points.size()) {
        for (std::size_t i = 0; i < all.count; ++i) result.points[result.count++] = all.points[i];
        return result;
    }
    // Of the points that are deepest to within the tolerance the first, which persists from frame to frame.
    const auto depth = [](const ManifoldPoint<D>& p) { return p.depth; };
    const double threshold = depth(all.points[index_of_max(all, depth)]) - tolerance;
    const std::size_t deepest =
        index_of_max(all, [&](const ManifoldPoint<D>& p) { return p.depth >= threshold ? 1 : 0; });
    const auto indices = selected(all, deepest, normal);
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (std::find(indices.data(), indices.data() + i, indices[i]) == indices.data() + i)
            result.points[result.count++] = all.points[indices[i]];
    return result;
}

template <int D>
Manifold<D> manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                     Trace<D>* trace) {
    const DVec<D>& normal = distance.normal;
    const double tolerance = 1e-6 * std::min(approximate_size(a), approximate_size(b)), depth = -distance.distance;
    const std::uint32_t witness_name = distance.corners.a[0] << 8 ^ distance.corners.b[0];

    ManifoldCandidates<D> candidates;
    const Face<D> face_a = face_along(a, normal), face_b = face_along(b, -normal);
    const double alignment_a = alignment(face_a, normal), alignment_b = alignment(face_b, -normal);
    if (std::max(alignment_a, alignment_b) >= aligned || side_by_side(face_a, face_b, normal))
        add_contact_area<D>(a, b, face_a, face_b, alignment_a >= aligned || alignment_b < aligned,
                            {normal, depth, margin, tolerance}, trace, candidates);
    add_deepest(candidates, {distance.on_a - normal * (0.5 * depth), depth, witness_name}, tolerance);
    return reduced_manifold(candidates, normal, tolerance);
}

template <int D>
ContactArea<D> contact_area(const Convex<D>& a, const Convex<D>& b, ReferenceFace reference, const DVec<D>& normal,
                            double depth, double margin) {
    ContactArea<D> area;
    const Face<D> face_a = face_along(a, normal), face_b = face_along(b, -normal);
    const double alignment_a = alignment(face_a, normal), alignment_b = alignment(face_b, -normal);
    if (std::max(alignment_a, alignment_b) < aligned && !side_by_side(face_a, face_b, normal)) return area;
    area.a_is_reference = alignment_b < aligned || (reference == ReferenceFace::of_a && alignment_a >= aligned);
    const double tolerance = 1e-6 * std::min(approximate_size(a), approximate_size(b));
    add_contact_area<D>(a, b, face_a, face_b, area.a_is_reference, {normal, depth, margin, tolerance}, nullptr,
                        area.points);
    return area;
}

template <int D>
Manifold<D> manifold_with_plane(const Convex<D>& a, const DVec<D>& normal, double offset, double margin) {
    const double tolerance = 1e-6 * approximate_size(a);
    ManifoldCandidates<D> candidates;
    const auto touching_at = [&](const DVec<D>& core, std::uint32_t name) {
        const DVec<D> surface = core - normal * a.radius;
        const double depth = offset - dot(normal, surface);
        return ManifoldPoint<D>{surface + normal * (0.5 * depth), margin > 0 ? depth : std::max(depth, 0.0), name};
    };
    const Face<D> face = face_along(a, -normal);
    for (std::size_t i = 0; i < face.count; ++i) {
        const double depth = offset - dot(normal, face.points[i]) + a.radius;
        if (depth >= -margin - tolerance) candidates.push_back(touching_at(face.points[i], face.indices[i]));
    }
    const CorePoint<D> lowest = core_support(a, -normal);
    add_deepest(candidates, touching_at(lowest.position, lowest.index), tolerance);
    return reduced_manifold(candidates, normal, tolerance);
}

#define ABUT_INSTANTIATE(D)                                                                                         \
    template Manifold<D> reduced_manifold(const ManifoldCandidates<D>&, const DVec<D>&, double);                    \
    template Manifold<D> manifold(const Convex<D>&, const Convex<D>&, const SignedDistance<D>&, double, Trace<D>*); \
    template ContactArea<D> contact_area(const Convex<D>&, const Convex<D>&, ReferenceFace, const DVec<D>&, double, \
                                         double);                                                                   \
    template Manifold<D> manifold_with_plane(const Convex<D>&, const DVec<D>&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
