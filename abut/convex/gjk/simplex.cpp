#include <abut/convex/gjk/simplex.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// The closest point on up to three vertices of the simplex, with their weights.
template <int D>
struct Candidate {
    std::array<std::size_t, 3> vertices;
    std::array<double, 3> weights;
    std::size_t count;
    DVec<D> point;
    double distance_squared;
};

template <int D>
Candidate<D> candidate(const Simplex<D>& simplex, std::initializer_list<std::size_t> vertices,
                       std::initializer_list<double> weights) {
    Candidate<D> result;
    result.count = 0;
    result.point = DVec<D>(0.0);
    auto weight = weights.begin();
    for (std::size_t i : vertices) {
        result.vertices[result.count] = i;
        result.weights[result.count++] = *weight;
        result.point += simplex.points[i].position * *weight++;
    }
    result.distance_squared = length_squared(result.point);
    return result;
}

/// Replaces the point by a more precise one than the weighted sum, whose terms are large and cancel. The precise point
/// is orthogonal to the edge or face to the last digit.
template <int D>
Candidate<D> with_point(Candidate<D> candidate, const DVec<D>& point) {
    candidate.point = point;
    candidate.distance_squared = length_squared(point);
    return candidate;
}

/// The direction of a shorter edge or of a lower triangle has a rounding error above 1e-9.
template <int D>
double min_extent(const Simplex<D>& simplex, std::initializer_list<std::size_t> vertices) {
    double maximum = 0;
    for (std::size_t i : vertices)
        maximum = std::max({maximum, largest(simplex.points[i].on_a), largest(simplex.points[i].on_b)});
    return 1e-7 * maximum;
}

/// The component of v orthogonal to `edge`.
DVec<2> across(const DVec<2>& edge, const DVec<2>& v) {
    return DVec<2>(-edge.y, edge.x) * (cross(edge, v) / dot(edge, edge));
}
DVec<3> across(const DVec<3>& edge, const DVec<3>& v) {
    return cross(edge, cross(v, edge)) / dot(edge, edge);
}

template <int D>
Candidate<D> closest_on_segment(const Simplex<D>& simplex, std::size_t i, std::size_t j) {
    const DVec<D>& a = simplex.points[i].position;
    const DVec<D>& b = simplex.points[j].position;
    const DVec<D> ab = b - a;
    const double along = -dot(a, ab), whole = dot(ab, ab);
    if (!(along > 0)) return candidate(simplex, {i}, {1.0});
    if (along >= whole) return candidate(simplex, {j}, {1.0});
    const double t = along / whole, min_length = min_extent(simplex, {i, j});
    const Candidate<D> inside = candidate(simplex, {i, j}, {1 - t, t});
    return whole > min_length * min_length ? with_point(inside, across(ab, a)) : inside;
}

template <int D>
Candidate<D> better(const Candidate<D>& a, const Candidate<D>& b) {
    return b.distance_squared < a.distance_squared ? b : a;
}

/// The gradient of each vertex' weight in the plane of the triangle, for weights that sum to 1.
std::array<DVec<3>, 3> weight_slopes(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const DVec<3> normal = cross(b - a, c - a);
    const double area_squared = length_squared(normal);
    return {cross(normal, c - b) / area_squared, cross(normal, a - c) / area_squared,
            cross(normal, b - a) / area_squared};
}
std::array<DVec<2>, 3> weight_slopes(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
    const double area = cross(b - a, c - a);
    const auto rotated = [area](const DVec<2>& v) { return DVec<2>(-v.y, v.x) / area; };
    return {rotated(c - b), rotated(a - c), rotated(b - a)};
}

/// Refines the weights. They are quotients of small volumes of large coordinates, so few digits are left on needles.
/// The residual of the weighted sum is exact and corrects them.
template <int D>
void refine(const Simplex<D>& simplex, Candidate<D>& inside, const DVec<D>& target) {
    const auto corner = [&](std::size_t i) { return simplex.points[inside.vertices[i]].position; };
    const auto slopes = weight_slopes(corner(0), corner(1), corner(2));
    for (int round = 0; round < 2; ++round) {
        DVec<D> residual = -target;
        for (std::size_t i = 0; i < 3; ++i) residual += corner(i) * inside.weights[i];
        for (std::size_t i = 0; i < 3; ++i)
            inside.weights[i] = std::max(0.0, inside.weights[i] - dot(slopes[i], residual));
    }
    const double sum = inside.weights[0] + inside.weights[1] + inside.weights[2];
    for (double& weight : inside.weights) weight /= sum;
}

/// Moved to the projection of the origin onto the plane of the triangle, if that is precise.
Candidate<3> refined_projection(const Simplex<3>& simplex, Candidate<3> inside) {
    const DVec<3>& a = simplex.points[inside.vertices[0]].position;
    const DVec<3> ab = simplex.points[inside.vertices[1]].position - a,
                  ac = simplex.points[inside.vertices[2]].position - a;
    const DVec<3> normal = cross(ab, ac);
    const double min_length = min_extent(simplex, {inside.vertices[0], inside.vertices[1], inside.vertices[2]});
    const double longest_squared = std::max({length_squared(ab), length_squared(ac), length_squared(ac - ab)});
    const double area_squared = length_squared(normal);
    if (!(area_squared > min_length * min_length * longest_squared)) return inside;
    const DVec<3> projection = normal * (dot(normal, a) / area_squared);
    refine(simplex, inside, projection);
    return with_point(inside, projection);
}
/// In 2D the origin lies in the triangle itself.
Candidate<2> refined_projection(const Simplex<2>& simplex, Candidate<2> inside) {
    refine(simplex, inside, DVec<2>(0.0));
    return inside;
}

template <int D>
Candidate<D> closest_on_triangle(const Simplex<D>& simplex, std::size_t i, std::size_t j, std::size_t k) {
    const DVec<D>& a = simplex.points[i].position;
    const DVec<D>& b = simplex.points[j].position;
    const DVec<D>& c = simplex.points[k].position;
    const DVec<D> ab = b - a, ac = c - a;
    // The weights of the origin's projection are the areas that it spans with the edges, measured along the normal.
    double u, v, w;
    if constexpr (D == 3) {
        const DVec<3> normal = cross(ab, ac);
        u = dot(cross(b, c), normal);
        v = dot(cross(c, a), normal);
        w = dot(cross(a, b), normal);
    } else {
        const double area = cross(ab, ac);
        u = cross(b, c) * area;
        v = cross(c, a) * area;
        w = cross(a, b) * area;
    }
    const double sum = u + v + w;
    if (u > 0 && v > 0 && w > 0 && sum > 0)
        return refined_projection(simplex, candidate(simplex, {i, j, k}, {u / sum, v / sum, w / sum}));
    return better(better(closest_on_segment(simplex, i, j), closest_on_segment(simplex, j, k)),
                  closest_on_segment(simplex, i, k));
}

template <int D>
DVec<D> set_simplex(Simplex<D>& simplex, const Candidate<D>& best) {
    std::array<DifferencePoint<D>, 3> points;
    bool moves = false;
    for (std::size_t i = 0; i < best.count; ++i) moves = moves || best.vertices[i] != i;
    if (moves) {
        for (std::size_t i = 0; i < best.count; ++i) points[i] = simplex.points[best.vertices[i]];
        for (std::size_t i = 0; i < best.count; ++i) simplex.points[i] = points[i];
    }
    for (std::size_t i = 0; i < best.count; ++i) simplex.weights[i] = best.weights[i];
    simplex.count = best.count;
    return best.point;
}

/// A face of a tetrahedron with the opposite vertex.
struct TetrahedronFace {
    std::array<std::size_t, 3> corners;
    std::size_t opposite;
    DVec<3> normal;
    double origin,
        last;   ///< heights of the origin and of the opposite vertex over the face, times the length of the normal
    bool flat;  ///< the opposite vertex lies in the plane of the face, to rounding

    TetrahedronFace(const Simplex<3>& simplex, std::size_t i, std::size_t j, std::size_t k, std::size_t l)
        : corners{i, j, k}, opposite(l) {
        const DVec<3>&a = simplex.points[i].position, &d = simplex.points[l].position;
        normal = cross(simplex.points[j].position - a, simplex.points[k].position - a);
        origin = -dot(normal, a);
        last = dot(normal, d - a);
        flat = std::abs(last) <= 1e-15 * length(normal) * (largest(a) + largest(d));
    }

    /// Whether the plane of the face separates the origin from the opposite vertex; always true for a flat tetrahedron.
    bool separates() const { return flat || (last > 0 ? origin < 0 : origin > 0); }
};

/// Sets the barycentric coordinates of the origin. Returns false if their weighted sum is not the origin: in a
/// tetrahedron of almost no thickness inside and outside differ by rounding.
bool set_origin_weights(Simplex<3>& simplex, const std::array<TetrahedronFace, 4>& faces) {
    double scale = 0;
    for (const TetrahedronFace& face : faces) {
        simplex.weights[face.opposite] = face.origin / face.last;
        scale = std::max(scale, largest(simplex.points[face.opposite].position));
    }
    // Residual correction, as in `refine`.
    for (int round = 0; round < 3; ++round) {
        const DVec<3> residual = simplex.combine(&DifferencePoint<3>::position);
        for (const TetrahedronFace& face : faces)
            simplex.weights[face.opposite] -= dot(face.normal, residual) / face.last;
    }
    double sum = 0, min_weight = 1;
    for (const double weight : simplex.weights) {
        sum += weight;
        min_weight = std::min(min_weight, weight);
    }
    for (double& weight : simplex.weights) weight /= sum;
    return min_weight >= 0 && largest(simplex.combine(&DifferencePoint<3>::position)) <= 1e-12 * scale;
}

DVec<3> reduce_tetrahedron(Simplex<3>& simplex) {
    const std::array<TetrahedronFace, 4> faces{
        TetrahedronFace(simplex, 0, 1, 2, 3), TetrahedronFace(simplex, 0, 3, 1, 2),
        TetrahedronFace(simplex, 0, 2, 3, 1), TetrahedronFace(simplex, 1, 3, 2, 0)};
    bool inside = true;
    for (const TetrahedronFace& face : faces) inside = inside && !face.separates();
    if (inside && set_origin_weights(simplex, faces)) return DVec<3>(0.0);
    Candidate<3> best;
    best.distance_squared = std::numeric_limits<double>::infinity();
    for (const TetrahedronFace& face : faces)
        if (inside || face.separates())
            best = better(best, closest_on_triangle(simplex, face.corners[0], face.corners[1], face.corners[2]));
    return set_simplex(simplex, best);
}

}  // namespace

template <int D>
DVec<D> reduce_to_closest(Simplex<D>& simplex) {
    switch (simplex.count) {
        case 1:
            return set_simplex(simplex, candidate(simplex, {0}, {1.0}));
        case 2:
            return set_simplex(simplex, closest_on_segment(simplex, 0, 1));
        case 3:
            return set_simplex(simplex, closest_on_triangle(simplex, 0, 1, 2));
        default:
            if constexpr (D == 3) return reduce_tetrahedron(simplex);
            return DVec<D>(0.0);
    }
}

template <int D>
Simplex<D> closest_subsimplex(std::initializer_list<DifferencePoint<D>> corners, const DVec<D>& target) {
    Simplex<D> face;
    for (const DifferencePoint<D>& corner : corners) {
        face.points[face.count] = corner;
        face.points[face.count++].position -= target;
    }
    reduce_to_closest(face);
    for (std::size_t i = 0; i < face.count; ++i) face.points[i].position += target;
    return face;
}

#define ABUT_INSTANTIATE(D)                          \
    template DVec<D> reduce_to_closest(Simplex<D>&); \
    template Simplex<D> closest_subsimplex(std::initializer_list<DifferencePoint<D>>, const DVec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
