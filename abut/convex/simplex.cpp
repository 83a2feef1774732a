#include <abut/convex/simplex.hpp>

#include <limits>

namespace abut {
namespace {

/// The closest point on up to three of the simplex' points, their weights, and which of them count.
template <int D>
struct Candidate {
    std::array<std::size_t, 3> which{};
    std::array<double, 3> weights{};
    std::size_t count = 0;
    DVec<D> point{0.0};
    double distance_squared = 0;
};

template <int D>
Candidate<D> candidate(const Simplex<D>& simplex, std::initializer_list<std::size_t> which,
                       std::initializer_list<double> weights) {
    Candidate<D> result;
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

/// Moved to the origin's projection onto the triangle's plane, where that is known.
Candidate<3> sharpened(const Simplex<3>& simplex, const Candidate<3>& inside) {
    const DVec<3>& a = simplex.points[inside.which[0]].position;
    const DVec<3> ab = simplex.points[inside.which[1]].position - a, ac = simplex.points[inside.which[2]].position - a;
    const DVec<3> normal = cross(ab, ac);
    const double least = least_extent(simplex, {inside.which[0], inside.which[1], inside.which[2]});
    const double longest_squared = std::max({length_squared(ab), length_squared(ac), length_squared(ac - ab)});
    const double area_squared = length_squared(normal);
    if (!(area_squared > least * least * longest_squared)) return inside;
    return moved_to(inside, normal * (dot(normal, a) / area_squared));
}
/// In the plane the origin is in the triangle itself.
Candidate<2> sharpened(const Simplex<2>&, const Candidate<2>& inside) {
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

/// Whether the plane of i j k parts the origin from l; a face of a flat tetrahedron parts them always.
bool parts_origin(const Simplex<3>& simplex, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    const DVec<3>& a = simplex.points[i].position;
    const DVec<3> normal = cross(simplex.points[j].position - a, simplex.points[k].position - a);
    const double height_origin = -dot(normal, a);
    const double height_last = dot(normal, simplex.points[l].position - a);
    const double noise = 1e-15 * length(normal) * (largest(a) + largest(simplex.points[l].position));
    if (std::abs(height_last) <= noise) return true;
    return height_last > 0 ? height_origin < 0 : height_origin > 0;
}

/// Each with the corner opposite.
constexpr std::size_t tetrahedron_faces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};

template <int D>
DVec<D> keep(Simplex<D>& simplex, const Candidate<D>& best) {
    const Simplex<D> before = simplex;
    simplex.count = best.count;
    for (std::size_t i = 0; i < best.count; ++i) {
        simplex.points[i] = before.points[best.which[i]];
        simplex.weights[i] = best.weights[i];
    }
    return best.point;
}

/// Sets the weights at the origin, each the volume that it spans with the face opposite. False where they don't lead
/// there: of a tetrahedron almost without thickness, inside or outside is rounding.
bool weigh_origin(Simplex<3>& simplex) {
    double sum = 0, scale = 0;
    for (const auto& f : tetrahedron_faces) {
        const DVec<3>&a = simplex.points[f[0]].position, &b = simplex.points[f[1]].position,
              &c = simplex.points[f[2]].position;
        simplex.weights[f[3]] = std::abs(dot(a, cross(b, c)));
        sum += simplex.weights[f[3]];
        scale = std::max(scale, largest(a));
    }
    for (double& weight : simplex.weights) weight /= sum;
    return largest(simplex.combine(&DifferencePoint<3>::position)) <= 1e-10 * scale;
}

DVec<3> reduce_tetrahedron(Simplex<3>& simplex) {
    std::array<bool, 4> outside;
    bool inside = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& f = tetrahedron_faces[i];
        outside[i] = parts_origin(simplex, f[0], f[1], f[2], f[3]);
        inside = inside && !outside[i];
    }
    if (inside && weigh_origin(simplex)) return DVec<3>(0.0);
    Candidate<3> best;
    best.distance_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& f = tetrahedron_faces[i];
        if (inside || outside[i]) best = better(best, closest_on_triangle(simplex, f[0], f[1], f[2]));
    }
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
