#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/minkowski.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/minkowski_sum.hpp>

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

/// Corners as floats, relative to an origin.
template <int D>
struct PlacedPoints {
    std::vector<Vec<D>> points;
    DVec<D> origin{0.0};
};

/// The placed corners of a convex set: exact if they are floats after rotation and scale, else rounded relative to
/// their centre, where floats are finest.
template <int D>
PlacedPoints<D> placed_points(const Convex<D>& convex) {
    std::vector<DVec<D>> exact;
    bool floats = true;
    for (const Vec<D>& corner : detail::core_corners(convex)) {
        const DVec<D>& point = exact.emplace_back(convex.place.vector(DVec<D>(corner)));
        floats = floats && DVec<D>(to_float(point)) == point;
    }
    const DVec<D> center = floats ? DVec<D>(0.0) : min_max<D>(exact).middle();
    PlacedPoints<D> result;
    for (const DVec<D>& point : exact) result.points.push_back(to_float(point - center));
    result.origin = convex.place.offset + center;
    return result;
}

/// A polygon as a loop.
class PlacedLoop {
public:
    explicit PlacedLoop(const Convex<2>& convex) {
        const PlacedPoints<2> placed = placed_points(convex);
        for (const std::uint32_t i : hull_loop(placed.points)) corners_.emplace_back(placed.points[i]);
        origin_ = placed.origin;
    }

    std::span<const DVec<2>> outline() const { return corners_; }
    const DVec<2>& corner(std::uint32_t i) const { return corners_[i]; }
    const DVec<2>& origin() const { return origin_; }

private:
    std::vector<DVec<2>> corners_;
    DVec<2> origin_;
};

/// A polyhedron with its faces.
class PlacedSurface {
public:
    explicit PlacedSurface(const Convex<3>& convex) {
        if (convex.facets != nullptr && convex.similar && convex.scale > 0)
            use_facets(convex);
        else
            build(placed_points(convex));
    }
    PlacedSurface(const PlacedSurface&) = delete;
    PlacedSurface& operator=(const PlacedSurface&) = delete;

    SummandSurface outline() const { return {corners_, facets_.edges.empty() ? nullptr : &facets_, mirrored_}; }
    const DVec<3>& corner(std::uint32_t i) const { return corners_[i]; }
    const DVec<3>& origin() const { return origin_; }

private:
    void use_facets(const Convex<3>& convex) {
        for (std::uint32_t i = 0; i < convex.count; ++i)
            corners_.push_back(convex.place.vector(DVec<3>(convex.vertices()[i])));
        origin_ = convex.place.offset;
        facets_ = *convex.facets;
        const std::array<DVec<3>, 3>& axes = convex.place.column;
        mirrored_ = dot(axes[0], cross(axes[1], axes[2])) < 0;
    }

    /// Builds the faces, for a set that has none, or whose placement may have bent or flattened them.
    void build(const PlacedPoints<3>& placed) {
        Result<Hull3> built = hull(placed.points);
        ABUT_ASSERT(static_cast<bool>(built));
        if (!built) return;
        hull_ = *std::move(built);
        facets_ = {hull_.normals, hull_.loops, hull_.loop_ends, hull_.edges};
        for (const Vec3& point : hull_.points) corners_.emplace_back(point);
        origin_ = placed.origin;
    }

    Hull3 hull_;
    Facets facets_;  ///< refers to `hull_` or to the shape
    std::vector<DVec<3>> corners_;
    DVec<3> origin_{0.0};
    bool mirrored_ = false;
};

template <int D>
using Placed = std::conditional_t<D == 2, PlacedLoop, PlacedSurface>;

template <int D>
PolytopeOf<D> sum(const Convex<D>& a, const Convex<D>& b) {
    const bool possible = detail::has_corners_only(a) && detail::has_corners_only(b) && is_finite(a) && is_finite(b);
    ABUT_ASSERT(possible);
    if (!possible) return {};
    const Placed<D> placed_a(a), placed_b(b);
    const DVec<D> origin = placed_a.origin() + placed_b.origin();
    std::vector<Vec<D>> corners;
    for (const CornerPair& pair : sum_corners(placed_a.outline(), placed_b.outline()))
        corners.push_back(to_float(placed_a.corner(pair.a) + placed_b.corner(pair.b) + origin));
    const Result<PolytopeOf<D>> built = PolytopeOf<D>::build(corners);
    ABUT_ASSERT(static_cast<bool>(built));
    return built ? *built : PolytopeOf<D>();
}

template <int D>
Convex<D> negative(const Convex<D>& convex) {
    return mapped(convex, scaling(Vec<D>(-1)));
}

}  // namespace

Polygon minkowski_sum(const Convex<2>& a, const Convex<2>& b) {
    return sum(a, b);
}
Polyhedron minkowski_sum(const Convex<3>& a, const Convex<3>& b) {
    return sum(a, b);
}

Polygon minkowski_difference(const Convex<2>& a, const Convex<2>& b) {
    return sum(a, negative(b));
}
Polyhedron minkowski_difference(const Convex<3>& a, const Convex<3>& b) {
    return sum(a, negative(b));
}

}  // namespace abut
