#include <abut/convex/simplex.hpp>

#include <limits>

namespace abut {
namespace {

/// The closest point on up to three of the simplex' points, their weights, and which of them count.
template <int D>
struct Candidate {
    std::array<std::size_t, 3> which;
    std::array<double, 3> weights;
    std::size_t count;
    DVec<D> point;
    double distance_squared;
};

template <int D>
Candidate<D> candidate(const Simplex<D>& simplex, std::initializer_list<std::size_t> which,
                       std::initializer_list<double> weights) {
    Candidate<D> result;
    result.count = 0;
    result.point = DVec<D>(0.0);
    auto weight = weights.begin();
    for (std::size_t i : which) {
        result.which[result.count] = i;
        result.weights[result.count++] = *weight;
        result.point += simplex.points[i].position * *weight++;
    }
    result.distance_squared = length_squared(result.point);
    return result;
}

/// With the point where it is known better than as a sum of the corners, which are large where it is small: at right
/// angles to the edge or face, to the last digit.
template <int D>
Candidate<D> moved_to(Candidate<D> candidate, const DVec<D>& point) {
    candidate.point = point;
    candidate.distance_squared = length_squared(point);
    return candidate;
}

/// Edges shorter and triangles lower than this have a direction that is rounding by more than 1e-9.
template <int D>
double least_extent(const Simplex<D>& simplex, std::initializer_list<std::size_t> which) {
    double most = 0;
    for (std::size_t i : which)
        most = std::max({most, largest(simplex.points[i].on_a), largest(simplex.points[i].on_b)});
    return 1e-7 * most;
}

/// The part of v at right angles to `edge`.
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
    const double t = along / whole, least = least_extent(simplex, {i, j});
    const Candidate<D> inside = candidate(simplex, {i, j}, {1 - t, t});
    return whole > least * least ? moved_to(inside, across(ab, a)) : inside;
}

template <int D>
Candidate<D> better(const Candidate<D>& a, const Candidate<D>& b) {
    return b.distance_squared < a.distance_squared ? b : a;
}

/// How fast each corner's weight grows along the ways of the plane, for weights that sum to 1.
std::array<DVec<3>, 3> weight_slopes(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    const DVec<3> normal = cross(b - a, c - a);
    const double area_squared = length_squared(normal);
    return {cross(normal, c - b) / area_squared, cross(normal, a - c) / area_squared,
            cross(normal, b - a) / area_squared};
}
std::array<DVec<2>, 3> weight_slopes(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
    const double area = cross(b - a, c - a);
    const auto turned = [area](const DVec<2>& v) { return DVec<2>(-v.y, v.x) / area; };
    return {turned(c - b), turned(a - c), turned(b - a)};
}

/// Weights are quotients of small volumes of large coordinates; on needles that leaves few digits. What they miss the
/// target by is known to all digits, and corrects them.
template <int D>
void refine(const Simplex<D>& simplex, Candidate<D>& inside, const DVec<D>& target) {
    const auto corner = [&](std::size_t i) { return simplex.points[inside.which[i]].position; };
    const auto slopes = weight_slopes(corner(0), corner(1), corner(2));
    for (int round = 0; round < 2; ++round) {
        DVec<D> missed = -target;
        for (std::size_t i = 0; i < 3; ++i) missed += corner(i) * inside.weights[i];
        for (std::size_t i = 0; i < 3; ++i)
            inside.weights[i] = std::max(0.0, inside.weights[i] - dot(slopes[i], missed));
    }
    const double sum = inside.weights[0] + inside.weights[1] + inside.weights[2];
    for (double& weight : inside.weights) weight /= sum;
}

/// Moved to the origin's projection onto the triangle's plane, where that is known.
Candidate<3> sharpened(const Simplex<3>& simplex, Candidate<3> inside) {
    const DVec<3>& a = simplex.points[inside.which[0]].position;
    const DVec<3> ab = simplex.points[inside.which[1]].position - a, ac = simplex.points[inside.which[2]].position - a;
    const DVec<3> normal = cross(ab, ac);
    const double least = least_extent(simplex, {inside.which[0], inside.which[1], inside.which[2]});
    const double longest_squared = std::max({length_squared(ab), length_squared(ac), length_squared(ac - ab)});
    const double area_squared = length_squared(normal);
    if (!(area_squared > least * least * longest_squared)) return inside;
    const DVec<3> foot = normal * (dot(normal, a) / area_squared);
    refine(simplex, inside, foot);
    return moved_to(inside, foot);
}
/// In the plane the origin is in the triangle itself.
Candidate<2> sharpened(const Simplex<2>& simplex, Candidate<2> inside) {
    refine(simplex, inside, DVec<2>(0.0));
    return inside;
}

template <int D>
Candidate<D> closest_on_triangle(const Simplex<D>& simplex, std::size_t i, std::size_t j, std::size_t k) {
    const DVec<D>& a = simplex.points[i].position;
    const DVec<D>& b = simplex.points[j].position;
    const DVec<D>& c = simplex.points[k].position;
    const DVec<D> ab = b - a, ac = c - a;
    // The weights of the origin's projection are the areas it spans with the edges, measured along the normal.
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
        return sharpened(simplex, candidate(simplex, {i, j, k}, {u / sum, v / sum, w / sum}));
    return better(better(closest_on_segment(simplex, i, j), closest_on_segment(simplex, j, k)),
                  closest_on_segment(simplex, i, k));
}

template <int D>
DVec<D> keep(Simplex<D>& simplex, const Candidate<D>& best) {
    std::array<DifferencePoint<D>, 3> kept;
    bool moves = false;
    for (std::size_t i = 0; i < best.count; ++i) moves = moves || best.which[i] != i;
    if (moves) {
        for (std::size_t i = 0; i < best.count; ++i) kept[i] = simplex.points[best.which[i]];
        for (std::size_t i = 0; i < best.count; ++i) simplex.points[i] = kept[i];
    }
    for (std::size_t i = 0; i < best.count; ++i) simplex.weights[i] = best.weights[i];
    simplex.count = best.count;
    return best.point;
}

/// A face of a tetrahedron, with the corner opposite.
struct Side {
    std::array<std::size_t, 3> corners;
    std::size_t opposite;
    DVec<3> normal;
    double origin, last;  ///< heights over it, times the length of the normal: of the origin, of the corner opposite
    bool flat;            ///< the corner opposite is in its plane, as far as doubles can tell

    Side(const Simplex<3>& simplex, std::size_t i, std::size_t j, std::size_t k, std::size_t l)
        : corners{i, j, k}, opposite(l) {
        const DVec<3>&a = simplex.points[i].position, &d = simplex.points[l].position;
        normal = cross(simplex.points[j].position - a, simplex.points[k].position - a);
        origin = -dot(normal, a);
        last = dot(normal, d - a);
        flat = std::abs(last) <= 1e-15 * length(normal) * (largest(a) + largest(d));
    }

    /// Whether its plane parts the origin from the corner opposite; always, of a flat tetrahedron.
    bool parts() const { return flat || (last > 0 ? origin < 0 : origin > 0); }
};

/// Sets the weights at the origin, each how much of the way to its corner the origin has come from the face opposite.
/// False where they don't lead there: of a tetrahedron almost without thickness, inside or outside is rounding.
bool weigh_origin(Simplex<3>& simplex, const std::array<Side, 4>& sides) {
    double scale = 0;
    for (const Side& side : sides) {
        simplex.weights[side.opposite] = side.origin / side.last;
        scale = std::max(scale, largest(simplex.points[side.opposite].position));
    }
    // As in `refine`.
    for (int round = 0; round < 3; ++round) {
        const DVec<3> missed = simplex.combine(&DifferencePoint<3>::position);
        for (const Side& side : sides) simplex.weights[side.opposite] -= dot(side.normal, missed) / side.last;
    }
    double sum = 0, least = 1;
    for (const double weight : simplex.weights) {
        sum += weight;
        least = std::min(least, weight);
    }
    for (double& weight : simplex.weights) weight /= sum;
    return least >= 0 && largest(simplex.combine(&DifferencePoint<3>::position)) <= 1e-12 * scale;
}

DVec<3> reduce_tetrahedron(Simplex<3>& simplex) {
    const std::array<Side, 4> sides{Side(simplex, 0, 1, 2, 3), Side(simplex, 0, 3, 1, 2), Side(simplex, 0, 2, 3, 1),
                                    Side(simplex, 1, 3, 2, 0)};
    bool inside = true;
    for (const Side& side : sides) inside = inside && !side.parts();
    if (inside && weigh_origin(simplex, sides)) return DVec<3>(0.0);
    Candidate<3> best;
    best.distance_squared = std::numeric_limits<double>::infinity();
    for (const Side& side : sides)
        if (inside || side.parts())
            best = better(best, closest_on_triangle(simplex, side.corners[0], side.corners[1], side.corners[2]));
    return keep(simplex, best);
}

}  // namespace

template <int D>
DVec<D> reduce_to_closest(Simplex<D>& simplex) {
    switch (simplex.count) {
        case 1:
            return keep(simplex, candidate(simplex, {0}, {1.0}));
        case 2:
            return keep(simplex, closest_on_segment(simplex, 0, 1));
        case 3:
            return keep(simplex, closest_on_triangle(simplex, 0, 1, 2));
        default:
            if constexpr (D == 3) return reduce_tetrahedron(simplex);
            return DVec<D>(0.0);
    }
}

template <int D>
Simplex<D> face_near(std::initializer_list<DifferencePoint<D>> corners, const DVec<D>& target) {
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
    template Simplex<D> face_near(std::initializer_list<DifferencePoint<D>>, const DVec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
