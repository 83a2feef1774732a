// Inscribed polytopes of convex sets. Both algorithms query the support function along the polytope's own normals, and
// add the point that stands out most, until none stands out by more than the tolerance: the sandwich algorithm in the
// plane (Rote: "The convergence rate of the sandwich algorithm for approximating convex functions", 1992), its
// counterpart in space.
//
// The set stands out by its support function less that of the polytope. That difference is a sublinear function on the
// cone of directions of each corner. So it is at most the weighted sum of its values at directions around, with the
// weights that combine these: 1 / cos(half the angle) between two of them.

#include <abut/convex/hull/hull.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/polytope.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

template <class Built>
Built finished(const Result<Built>& built) {
    ABUT_ASSERT(static_cast<bool>(built));
    return built ? *built : Built();
}

template <int D>
std::vector<Vec<D>> corners(const Aabb<D>& box) {
    std::vector<Vec<D>> result;
    for (std::uint32_t corner = 0; corner < 1u << D; ++corner) {
        Vec<D>& point = result.emplace_back(box.min);
        for (int i = 0; i < D; ++i)
            if ((corner >> i & 1u) != 0) point[i] = box.max[i];
    }
    return result;
}

/// The set relative to the centre of its bounding box, where floats are finest.
template <int D>
struct Centered {
    explicit Centered(const Convex<D>& shape) : convex(shape) {
        DVec<D> side(0.0);
        for (int i = 0; i < D; ++i) {
            const double high = support(shape, axis<D>(i))[i], low = support(shape, axis<D>(i, -1))[i];
            origin[i] = 0.5 * (low + high);
            side[i] = high - low;
        }
        extent = largest(side);
        convex.place.offset -= origin;
    }

    Convex<D> convex;
    DVec<D> origin;
    double extent;
};

/// A corner of the expanding polygon.
struct Corner {
    DVec<2> position;
    bool settled = false;  ///< nothing stands out beyond the edge to the next
};

std::vector<DVec<2>> inscribed_corners(const Convex<2>& convex, double tolerance) {
    std::vector<Corner> loop;
    for (const DVec<2>& direction : {DVec<2>(1, 0), DVec<2>(0, 1), DVec<2>(-1, 0), DVec<2>(0, -1)})
        loop.push_back({support(convex, direction)});
    for (bool grown = true; grown && loop.size() < max_polygon_vertices;) {
        grown = false;
        std::vector<Corner> finer;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            finer.push_back(loop[i]);
            const DVec<2> from = loop[i].position, edge = loop[(i + 1) % loop.size()].position - from;
            const std::size_t left = loop.size() - i - 1;
            if (loop[i].settled || finer.size() + left >= max_polygon_vertices || !(largest(edge) > 0)) continue;
            const DVec<2> out = normalized(DVec<2>(edge.y, -edge.x)), beyond = support(convex, out);
            finer.back().settled = !(dot(beyond - from, out) > tolerance);
            if (finer.back().settled) continue;
            finer.push_back({beyond});
            grown = true;
        }
        loop = std::move(finer);
    }
    std::vector<DVec<2>> result;
    for (const Corner& corner : loop) result.push_back(corner.position);
    return result;
}

/// The cosine of half a right angle.
constexpr double half_right_angle = 0.7071067811865475;

/// An expanding polyhedron inside the set. Support queries go along the normals of its faces, and across edges where
/// the faces differ by more than a right angle, as those of a flat polygon always do.
class InscribedPolyhedron {
public:
    InscribedPolyhedron(const Convex<3>& convex, double tolerance) : convex_(convex), tolerance_(tolerance) {
        for (int i = 0; i < 3; ++i)
            for (const double sign : {1.0, -1.0}) points_.push_back(to_float(support(convex, axis<3>(i, sign))));
    }

    /// Adds the farthest points first: points far less out may be inside once those are added.
    std::vector<Vec3> inscribed_corners() {
        for (std::size_t found = points_.size();; found += outside_.size()) {
            const Result<Hull3> built = hull(points_);
            if (!built) return points_;
            points_ = built->points;
            probe_directions(*built);
            std::stable_sort(outside_.begin(), outside_.end(),
                             [](const Outside& a, const Outside& b) { return a.height > b.height; });
            const auto far_less = [&](const Outside& outside) {
                return outside.height < 0.25 * outside_.front().height;
            };
            outside_.erase(std::find_if(outside_.begin(), outside_.end(), far_less), outside_.end());
            outside_.resize(std::min(outside_.size(), max_polyhedron_vertices - found));
            if (outside_.empty()) return points_;
            for (const Outside& outside : outside_) points_.push_back(outside.point);
        }
    }

private:
    struct Outside {
        Vec3 point;
        double height;
    };

    void probe(const DVec<3>& direction, double reached, double allowed) {
        const DVec<3> beyond = support(convex_, direction);
        const double height = dot(direction, beyond) - reached;
        if (height > allowed) outside_.push_back({to_float(beyond), height});
    }

    void probe_directions(const Hull3& hull) {
        outside_.clear();
        const auto point = [&](std::size_t i) { return DVec<3>(hull.points[i]); };
        if (hull.rank == 1) {
            const DVec<3> u = perpendicular(point(1) - point(0)), v = normalized(cross(point(1) - point(0), u));
            for (const DVec<3>& n : {u, -u, v, -v})
                probe(n, std::max(dot(n, point(0)), dot(n, point(1))), half_right_angle * tolerance_);
            return;
        }
        std::vector<double> min_cosine(hull.normals.size(),
                                       1.0);  // of the angles that a face makes with its neighbours
        for (const FacetEdge& edge : hull.edges) {
            const DVec<3> left(hull.normals[edge.left]), right(hull.normals[edge.right]);
            const double cosine = dot(left, right);
            for (const std::uint32_t face : {edge.left, edge.right})
                min_cosine[face] = std::min(min_cosine[face], cosine);
            if (cosine >= 0) continue;
            const DVec<3> along = normalized(point(edge.to) - point(edge.from));
            const DVec<3> n = normalized(left + right + cross(along, left) + cross(right, along));
            probe(n, dot(n, point(edge.from)), half_right_angle * tolerance_);
        }
        for (std::size_t face = 0; face < hull.normals.size(); ++face) {
            const double half_angle = square_root(std::max(0.5 * (1 + min_cosine[face]), 0.5));
            probe(DVec<3>(hull.normals[face]), hull.offsets[face], half_angle * tolerance_);
        }
    }

    const Convex<3>& convex_;
    double tolerance_;
    std::vector<Vec3> points_;
    std::vector<Outside> outside_;
};

std::vector<DVec<3>> inscribed_corners(const Convex<3>& convex, double tolerance) {
    std::vector<DVec<3>> result;
    for (const Vec3& point : InscribedPolyhedron(convex, tolerance).inscribed_corners()) result.emplace_back(point);
    return result;
}

}  // namespace

namespace detail {

template <int D>
bool has_corners_only(const Convex<D>& convex) {
    return (convex.core == Core::points || convex.core == Core::box) && !(convex.inner_radius > 0) &&
           !(convex.radius > 0);
}

template <int D>
std::vector<Vec<D>> core_corners(const Convex<D>& convex) {
    if (convex.core == Core::box) return corners(Aabb<D>{-convex.own[0], convex.own[0]});
    return {convex.vertices(), convex.vertices() + convex.count};
}

template <int D>
PolytopeOf<D> polytope_of_corners(const Convex<D>& shape) {
    const bool possible = has_corners_only(shape) && is_finite(shape);
    ABUT_ASSERT(possible);
    if (!possible) return {};
    std::vector<Vec<D>> points;
    for (const Vec<D>& corner : core_corners(shape)) points.push_back(to_float(shape.place.point(DVec<D>(corner))));
    return finished(PolytopeOf<D>::build(points));
}

template <int D>
PolytopeOf<D> inscribed_polytope(const Convex<D>& shape, float tolerance) {
    ABUT_ASSERT(tolerance > 0);
    if (has_corners_only(shape)) return polytope_of_corners(shape);
    if (!is_valid_query(shape)) return {};
    const Centered<D> centered(shape);
    const double reached = std::max(min_polytope_tolerance * centered.extent, static_cast<double>(tolerance));
    std::vector<Vec<D>> points;
    for (const DVec<D>& point : inscribed_corners(centered.convex, reached))
        points.push_back(to_float(centered.origin + point));
    return finished(PolytopeOf<D>::build(points));
}

#define ABUT_INSTANTIATE(D)                                       \
    template bool has_corners_only(const Convex<D>&);             \
    template std::vector<Vec<D>> core_corners(const Convex<D>&);  \
    template PolytopeOf<D> polytope_of_corners(const Convex<D>&); \
    template PolytopeOf<D> inscribed_polytope(const Convex<D>&, float);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace detail

Polygon polytope(const Aabb<2>& box) {
    detail::enter_library();
    return finished(Polygon::build(corners(box)));
}
Polyhedron polytope(const Aabb<3>& box) {
    detail::enter_library();
    return finished(Polyhedron::build(corners(box)));
}

}  // namespace abut
