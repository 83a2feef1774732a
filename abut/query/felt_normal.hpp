#pragma once

// Which normals of a surface made of parts are felt from outside. For .cpp files.
//
// A floor of tiles has edges inside it, where tile meets tile. What slides over it may touch such an edge, and of that
// tile alone the edge's normal is right: it catches there. Of the floor as a whole it is wrong. The surface of a union
// has at a point p the normals n for which
//
//     p is the point of the union nearest to p + s n,    s small,
//
// so a normal of one part is felt iff no other part is nearer to p + s n than that part. It takes no adjacency, so the
// parts may as well be separate shapes of a world, with gaps, T-junctions and small differences in height. What is
// lower than about s isn't felt as an edge.
//
// Others: ghost vertices of Box2D's chains and the inner edges that Bullet's btInternalEdgeUtility and Jolt's
// InternalEdgeRemovingCollector leave out know one mesh's edges, or its triangles near.

#include <abut/query/part_pairs.hpp>

#include <optional>

namespace abut {

/// s above, in parts of the size of what feels the surface.
inline constexpr double felt_scale = 1e-3;

/// The place of a surface nearest to a point.
template <int D>
struct Foot {
    double distance = std::numeric_limits<double>::infinity();  ///< below zero inside a part
    DVec<D> point{0.0};
    double behind = 0;  ///< how far the point is behind a part that is met from its front alone; else 0 or less
};

/// Is given the closest point of one part after the other; returns how far away others are still wanted, which is no
/// farther than before. Those beyond may be visited or not.
template <int D>
using ClosestPointVisitor = FunctionRef<double(const Foot<D>& foot)>;
inline constexpr double no_others = -std::numeric_limits<double>::infinity();

/// Tells the feet on all parts that are at most `within` from the point.
template <int D>
using EachFoot = FunctionRef<void(const DVec<D>& point, double within, ClosestPointVisitor<D> visit)>;

/// Of all parts that the point isn't behind, in whatever order they are told; none, with an infinite distance, where
/// all are farther than `within`. `scale` is s. Where one is found that is no farther than `near_enough`, it may be
/// that one and not the nearest.
template <int D>
Foot<D> nearest_foot(EachFoot<D> each_foot, const DVec<D>& point, double within, double scale, double near_enough);

template <int D>
Foot<D> foot_on(const Convex<D>& part, const DVec<D>& point);
template <int D>
Foot<D> foot_on(const HalfSpaceView<D>& part, const DVec<D>& point);
/// Where its distance points to.
template <int D>
Foot<D> foot_on(const DistanceFunction<D>& part, const DVec<D>& point);

/// False, and what `foot` tells is of no use, where it is farther than `within`: mostly found out for less than where.
template <int D>
bool find_foot(const Convex<D>& part, const DVec<D>& point, double within, Foot<D>& foot);
template <int D>
bool find_foot(const HalfSpaceView<D>& part, const DVec<D>& point, double within, Foot<D>& foot) {
    foot = foot_on(part, point);
    return foot.distance <= within;
}
template <int D>
bool find_foot(const DistanceFunction<D>& part, const DVec<D>& point, double within, Foot<D>& foot) {
    foot = foot_on(part, point);
    return foot.distance <= within;
}

/// All within reach of a point, and a bit more than rounding takes away.
template <int D>
Aabb<D> box_around(const DVec<D>& point, double within) {
    constexpr double wider = 0x1p-22;
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        const double reach = within * (1 + wider) + std::abs(point[i]) * wider;
        result.min[i] = static_cast<float>(point[i] - reach);
        result.max[i] = static_cast<float>(point[i] + reach);
    }
    return result;
}

/// As `overlaps`, of boxes that aren't empty: without a branch for each side.
template <int D>
bool meet(const Aabb<D>& a, const Aabb<D>& b) {
    unsigned result = 1;
    for (int i = 0; i < D; ++i)
        result &= static_cast<unsigned>(a.min[i] <= b.max[i]) & static_cast<unsigned>(b.min[i] <= a.max[i]);
    return result != 0;
}

/// Of a shape.
template <int D>
void each_foot_on(const View<D>& shape, const DVec<D>& point, double within, ClosestPointVisitor<D> visit);

/// A place on the surface of a part, the way out of the part there (of length 1), and where what feels it has its
/// middle.
template <int D>
struct FeltPlace {
    DVec<D> point, out, middle;
    double scale = 0;  ///< s
};

/// Whether the way out is one of the union's. What is met from its front alone covers nothing behind it. In a corner,
/// where the parts beside are as near, or the place is in one of them, the same is asked farther and farther along the
/// part, as long as that has the same way out, up to beside the middle of what feels it. A part's edge that stands out
/// from another part by no more than rounding explains, 1e-5 of the size, isn't felt.
template <int D, class Part>
bool is_felt(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot);

/// Whether the part has that way out at a place that is near its surface.
template <int D, class Part>
bool has_normal(const Part& part, const FeltPlace<D>& place);

/// Whether it has, and no other is nearer there: is_felt without looking farther along the part.
template <int D, class Part>
bool is_felt_there(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot);

/// A plane that the union is felt by.
template <int D>
struct FeltPlane {
    DVec<D> normal, point;
};

/// What is nearest to the middle of what feels a surface: the same for all places, and found where first asked for.
template <int D>
struct SeenFromMiddle {
    Foot<D> foot;
    double within = -1;  ///< where there is no foot, there is none so near
};

/// Near a place whose normal is not felt, as seen from there towards the middle of what feels it, which has come from
/// there; of surfaces equally near, the part's own. None where all that way is inside.
template <int D, class Part>
std::optional<FeltPlane<D>> felt_plane(const Part& part, const FeltPlace<D>& place, EachFoot<D> each_foot,
                                       SeenFromMiddle<D>& seen);

/// Whether a contact of this normal and depth tells of another one as well: of about the same normal, and so deep that
/// for something of this size the other one isn't much deeper.
template <int D>
bool tells_of(const DVec<D>& normal, double depth, const DVec<D>& other, double other_depth, double size) {
    const double cosine = dot(normal, other);
    if (cosine < 0.99) return false;
    return depth > other_depth - size * (felt_scale + std::sqrt(std::max(0.0, 2 * (1 - cosine))));
}

/// The middle of the box around a part; of a half-space, the point beside it.
template <int D>
DVec<D> middle_of(const Convex<D>& part, const DVec<D>&) {
    return DVec<D>(center(bounds(part)));
}
template <int D>
DVec<D> middle_of(const HalfSpaceView<D>&, const DVec<D>& beside) {
    return beside;
}
template <int D>
DVec<D> middle_of(const DistanceFunction<D>& part, const DVec<D>&) {
    return DVec<D>(center(bounds(part)));
}

/// s for a pair: by the smaller, for which the other is a level.
template <int D>
double felt_scale_of(const View<D>& a, const View<D>& b) {
    return felt_scale * std::min(size(a), size(b));
}

}  // namespace abut
