#include <abut/convex/face.hpp>
#include <abut/convex/largest_quadrilateral.hpp>
#include <abut/convex/manifold.hpp>

namespace abut {
namespace {

/// The part of v at right angles to the unit vector n, at length 1.
template <int D>
DVec<D> across(const DVec<D>& v, const DVec<D>& n) {
    return normalized(v - n * dot(v, n), DVec<D>(0.0));
}

/// The sides of a face as planes through its edges along `out`, looking outwards; of an edge, its two ends, and its
/// sides `reach` away. What lies between them lies in front of the face, seen along `out`.
template <int D, class Visit>
void each_side(const Face<D>& face, const DVec<D>& out, double reach, Visit&& visit) {
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
        // One way round for all edges, so that the two long ones of a sliver look opposite ways.
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

/// How far the ball around an edge reaches past it along `out`, seen from a point beside it.
double reach_beside(const Face<3>& edge, const DVec<3>& out, double radius, const DVec<3>& point) {
    const DVec<3> side = cross(across(edge.points[1] - edge.points[0], out), out);
    const double off = dot(side, point - edge.points[0]);
    return std::sqrt(std::max(0.0, radius * radius - off * off));
}
double reach_beside(const Face<2>&, const DVec<2>&, double radius, const DVec<2>&) {
    return radius;
}

/// Two edges side by side across the normal, such as those of two capsules.
bool side_by_side(const Face<3>& a, const Face<3>& b, const DVec<3>& normal) {
    if (a.count != 2 || b.count != 2) return false;
    const DVec<3> along_a = normalized(a.points[1] - a.points[0], DVec<3>(0.0));
    const DVec<3> along_b = normalized(b.points[1] - b.points[0], DVec<3>(0.0));
    const double tilt = std::sqrt(1 - aligned * aligned);
    return std::abs(dot(along_a, along_b)) >= aligned && std::abs(dot(along_a, normal)) <= tilt;
}
bool side_by_side(const Face<2>&, const Face<2>&, const DVec<2>&) {
    return false;
}

/// The normal of the plane in which a face lies; of an edge, of the one that looks most along `out`.
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

/// The index of the largest value of `measure` over the candidates; of several the lowest.
template <int D, class Measure>
std::size_t most(const ManifoldCandidates<D>& all, Measure&& measure) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.count; ++i)
        if (measure(all.points[i]) > measure(all.points[best])) best = i;
    return best;
}

/// The deepest, and the one farthest from it.
std::array<std::size_t, 2> kept(const ManifoldCandidates<2>& all, std::size_t deepest, const DVec<2>&) {
    const DVec<2> first = all.points[deepest].position;
    return {deepest, most(all, [&](const ManifoldPoint<2>& p) { return length_squared(p.position - first); })};
}

/// The deepest, and the three that make the largest quadrilateral with it, seen along the normal.
std::array<std::size_t, 4> kept(const ManifoldCandidates<3>& all, std::size_t deepest, const DVec<3>& normal) {
    const DVec<3> steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    const int u = (up + 1) % 3, v = (up + 2) % 3;
    const double lean_u = normal[u] / normal[up], lean_v = normal[v] / normal[up];
    std::array<double, Face<3>::capacity + 1> x, y;
    for (std::size_t i = 0; i < all.count; ++i) {
        const DVec<3>& position = all.points[i].position;
        x[i] = position[u] - position[up] * lean_u;
        y[i] = position[v] - position[up] * lean_v;
    }
    return largest_quadrilateral({x.data(), all.count}, {y.data(), all.count}, deepest);
}

/// The size of a set to within a factor of two, for less than `size` asks.
template <int D>
double rough_size(const Convex<D>& convex) {
    if (!convex.similar || convex.inner_radius > 0) return size(convex);
    if (convex.core == Core::box) return convex.scale * length(DVec<D>(convex.own[0])) + convex.radius;
    if (convex.core != Core::points) return size(convex);
    const Vec<D>* points = convex.vertices();
    double most = 0;
    for (std::uint32_t i = 1; i < convex.count; ++i)
        most = std::max(most, length_squared(DVec<D>(points[i]) - DVec<D>(points[0])));
    return 0.5 * convex.scale * std::sqrt(most) + convex.radius;
}

/// Adds the witness where no candidate is as deep as it is: a corner may lie on no face that looks along the normal.
template <int D>
void add_deepest(ManifoldCandidates<D>& candidates, const ManifoldPoint<D>& witness, double slack) {
    for (std::size_t i = 0; i < candidates.count; ++i)
        if (candidates.points[i].depth >= witness.depth - slack) return;
    candidates.push_back(witness);
}

}  // namespace

template <int D>
Manifold<D> thinned(const ManifoldCandidates<D>& all, const DVec<D>& normal, double slack) {
    Manifold<D> result;
    if (all.count <= result.points.size()) {
        for (std::size_t i = 0; i < all.count; ++i) result.points[result.count++] = all.points[i];
        return result;
    }
    // Of those that are as deep to within the slack the first, which stays the same from frame to frame.
    const auto depth = [](const ManifoldPoint<D>& p) { return p.depth; };
    const double least = depth(all.points[most(all, depth)]) - slack;
    const std::size_t deepest = most(all, [&](const ManifoldPoint<D>& p) { return p.depth >= least ? 1 : 0; });
    const auto indices = kept(all, deepest, normal);
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (std::find(indices.begin(), indices.begin() + i, indices[i]) == indices.begin() + i)
            result.points[result.count++] = all.points[indices[i]];
    return result;
}

template <int D>
Manifold<D> manifold(const Convex<D>& a, const Convex<D>& b, const SignedDistance<D>& distance, double margin,
                     Trace<D>* trace) {
    const DVec<D>& normal = distance.normal;
    const double slack = 1e-6 * std::min(rough_size(a), rough_size(b)), depth = -distance.distance;
    const std::uint32_t witness_name = distance.corners.a[0] << 8 ^ distance.corners.b[0];

    ManifoldCandidates<D> candidates;
    const Face<D> face_a = face_along(a, normal), face_b = face_along(b, -normal);
    const double alignment_a = alignment(face_a, normal), alignment_b = alignment(face_b, -normal);
    if (std::max(alignment_a, alignment_b) >= aligned || side_by_side(face_a, face_b, normal)) {
        const bool a_is_reference = alignment_a >= alignment_b - 1e-6;
        const Face<D>& reference = a_is_reference ? face_a : face_b;
        Face<D> incident = a_is_reference ? face_b : face_a;
        const DVec<D> out = a_is_reference ? normal : -normal;
        const double reference_radius = a_is_reference ? a.radius : b.radius;
        const double incident_radius = a_is_reference ? b.radius : a.radius;
        each_side(reference, out, reference_radius + slack,
                  [&](const DVec<D>& side, double offset, std::uint32_t name) {
                      clip(incident, side, offset, name);
                      record(incident, side, offset, trace);
                  });
        const DVec<D> plane = plane_of(reference, out);
        for (std::size_t i = 0; i < incident.count; ++i) {
            const double gap = dot(plane, incident.points[i] - reference.points[0]) / dot(plane, out);
            const double reach = reference.flat() ? reference_radius
                                                  : reach_beside(reference, out, reference_radius, incident.points[i]);
            // No two places are deeper than the shapes; faces that are not quite flat may say so.
            const double here = std::min(reach + incident_radius - gap, depth);
            if (here < -margin - slack) continue;
            const DVec<D> middle = incident.points[i] - out * (incident_radius - 0.5 * here);
            candidates.push_back({middle, margin > 0 ? here : std::max(here, 0.0), incident.indices[i]});
        }
    }
    add_deepest(candidates, {distance.on_a - normal * (0.5 * depth), depth, witness_name}, slack);
    return thinned(candidates, normal, slack);
}

template <int D>
Manifold<D> manifold_with_plane(const Convex<D>& a, const DVec<D>& normal, double offset, double margin) {
    const double slack = 1e-6 * rough_size(a);
    ManifoldCandidates<D> candidates;
    const auto touching_at = [&](const DVec<D>& core, std::uint32_t name) {
        const DVec<D> surface = core - normal * a.radius;
        const double depth = offset - dot(normal, surface);
        return ManifoldPoint<D>{surface + normal * (0.5 * depth), margin > 0 ? depth : std::max(depth, 0.0), name};
    };
    const Face<D> face = face_along(a, -normal);
    for (std::size_t i = 0; i < face.count; ++i) {
        const double depth = offset - dot(normal, face.points[i]) + a.radius;
        if (depth >= -margin - slack) candidates.push_back(touching_at(face.points[i], face.indices[i]));
    }
    const CorePoint<D> lowest = core_support(a, -normal);
    add_deepest(candidates, touching_at(lowest.position, lowest.index), slack);
    return thinned(candidates, normal, slack);
}

#define ABUT_INSTANTIATE(D)                                                                                         \
    template Manifold<D> thinned(const ManifoldCandidates<D>&, const DVec<D>&, double);                             \
    template Manifold<D> manifold(const Convex<D>&, const Convex<D>&, const SignedDistance<D>&, double, Trace<D>*); \
    template Manifold<D> manifold_with_plane(const Convex<D>&, const DVec<D>&, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
