// Highway compiles this file once for each SIMD target and selects the best at run time.

#include <abut/convex/gjk/gjk_fast.hpp>
#include <abut/math/simd/square_root.hpp>

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/gjk/gjk_fast.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After Highway's headers, because it is included once for each target.
#include <abut/convex/farthest_simd-inl.h>

#ifndef ABUT_CONVEX_GJK_FAST
#define ABUT_CONVEX_GJK_FAST
namespace abut::detail {

enum class GjkFastExit : std::uint8_t {
    separated,    ///< `toward` separates the cores by more than `max_distance`, by far more than rounding
    overlapping,  ///< the origin is inside the simplex, by far more than rounding
    converged,    ///< no point of A - B is nearer to the origin
    undecided,    ///< the distance is too small to decide
};

struct GjkFastResult {
    /// From A to B. On entry the first search direction if there are no vertices, zero if unknown; on exit as long as
    /// the distance.
    DVec<3> toward{0.0};
    // The closest points, if the exit is `converged`. They are right if the two bounds agree.
    double upper_bound = 0;   ///< the distance between a point of A and a point of B
    double lower_bound = -1;  ///< the width of a slab between the cores
    DVec<3> on_a{0.0};
};

}  // namespace abut::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// The vertices of one core, in its own frame.
class Corners {
public:
    explicit Corners(const Convex<3>& core) : half_(core.own[0]), box_(core.core == Core::box) {
        if (box_) return;
        if (core.lanes != nullptr)
            lanes_ = *core.lanes;
        else
            lanes_ = make_soa({core.vertices(), core.count}, own_);
    }

    std::uint32_t farthest(const DVec<3>& direction) const {
        if (!box_) return farthest_lane(lanes_, direction);
        return (direction.x < 0 ? 1u : 0u) | (direction.y < 0 ? 2u : 0u) | (direction.z < 0 ? 4u : 0u);
    }
    DVec<3> position(std::uint32_t i) const {
        if (!box_) return DVec<3>(lanes_.point(i));
        return {(i & 1u) != 0 ? -half_.x : half_.x, (i & 2u) != 0 ? -half_.y : half_.y,
                (i & 4u) != 0 ? -half_.z : half_.z};
    }
    DVec<3> middle() const { return box_ ? DVec<3>(0.0) : DVec<3>(lanes_.middle); }
    double reach() const { return largest(box_ ? half_ : DVec<3>(lanes_.reach)); }

private:
    DVec<3> half_;
    bool box_;
    PointSoa lanes_;
    float own_[3 * PointSoa::max_lanes];
};

struct Corner {
    DVec<3> position;  ///< in A - B
    std::uint32_t a, b;
};

/// A face of a simplex by the indices of its vertices, with its point closest to the origin.
struct Closest {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t count;
    DVec<3> point;
    double distance_squared;
};

class GjkFast {
public:
    GjkFast(const Convex<3>& a, const Convex<3>& b, double max_distance)
        : core_a_(a), a_(a), b_(b), unscale_(1 / (a.scale * a.scale)), max_distance_(max_distance / a.scale) {
        for (std::size_t i = 0; i < 3; ++i) b_to_a_.column[i] = into_a(b.place.column[i]);
        b_to_a_.offset = into_a(b.place.offset - a.place.offset);
        scale_ = a_.reach() + b.scale / a.scale * b_.reach() * 2 + largest(b_to_a_.offset);
    }

    /// Begins with the vertices of the cache, which receives those of the last simplex.
    GjkFastExit run(Cache& simplex, DVec<3>& toward, Trace<3>* trace) {
        for (std::uint32_t i = 0; i < simplex.count; ++i)
            corners_[count_++] = corner(simplex.corner_a[i], simplex.corner_b[i]);
        const GjkFastExit exit = begin(toward) ? iterate(trace) : GjkFastExit::overlapping;
        for (std::uint32_t i = 0; i < count_; ++i) {
            simplex.corner_a[i] = corners_[i].a;
            simplex.corner_b[i] = corners_[i].b;
        }
        simplex.count = count_;
        toward = core_a_.place.vector(-closest_);
        return exit;
    }

    /// The closest points of the last simplex. Returns false within the rounding error and for slivers with unreliable
    /// weights. A point off the simplex may be as near to the origin as a plane of it, and nearer than all of A - B.
    HWY_INLINE bool closest_points(GjkFastResult& result) const {
        const std::array<double, 3> weights = weights_of_closest();
        DVec<3> sum(0.0), on_a(0.0);
        for (std::uint32_t i = 0; i < count_; ++i) {
            sum += corners_[i].position * weights[i];
            on_a += a_.position(corners_[i].a) * weights[i];
        }
        const double upper_bound = length(sum);
        result.upper_bound = upper_bound * core_a_.scale;
        result.lower_bound = along_ / square_root(distance_squared_) * core_a_.scale;
        result.on_a = core_a_.place.point(on_a);
        const bool on_simplex = weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0;
        return on_simplex && upper_bound > 1e-6 * scale_ && largest(sum - closest_) <= 1e-9 * upper_bound;
    }

private:
    static constexpr int max_iterations = 64;

    HWY_INLINE DVec<3> into_a(const DVec<3>& v) const { return core_a_.place.transposed(v) * unscale_; }

    HWY_INLINE Corner corner(std::uint32_t a, std::uint32_t b) const {
        return {a_.position(a) - b_to_a_.point(b_.position(b)), a, b};
    }
    HWY_INLINE Corner farthest(const DVec<3>& toward) const {
        return corner(a_.farthest(toward), b_.farthest(b_to_a_.transposed(-toward)));
    }
    bool contains(const Corner& corner) const {
        for (std::uint32_t i = 0; i < count_; ++i)
            if (corners_[i].a == corner.a && corners_[i].b == corner.b) return true;
        return false;
    }

    /// Returns false if the given simplex contains the origin.
    bool begin(const DVec<3>& toward) {
        if (count_ == 4 && surely_inside()) return false;
        if (count_ > 0 && !(largest(toward) > 0)) {
            const Closest closest = closest_of_all();
            set_simplex(closest);
            distance_squared_ = closest.distance_squared;
            return true;
        }
        count_ = 0;
        closest_ = -into_a(toward);
        if (!(largest(closest_) > 0)) closest_ = a_.middle() - b_to_a_.point(b_.middle());
        if (!(largest(closest_) > 0)) closest_.x = 1;
        return true;
    }

    GjkFastExit iterate(Trace<3>* trace) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (int step = 0; step < max_iterations; ++step) {
            if (count_ > 0) record(trace);
            const Corner next = farthest(-closest_);
            const double along = along_ = dot(next.position, closest_);
            // The tolerances are ten thousand times the rounding error.
            if (along > 0 && max_distance_ < infinity) {
                const double threshold = max_distance_ + 1e-11 * scale_;
                if (along * along > threshold * threshold * length_squared(closest_)) return GjkFastExit::separated;
            }
            if (count_ > 0 && (contains(next) || distance_squared_ - along <= 1e-13 * distance_squared_))
                return GjkFastExit::converged;
            corners_[count_] = next;
            const Closest nearer = closest_at_newest();
            if (nearer.count == 0) {
                ++count_;
                return surely_inside() ? GjkFastExit::overlapping : GjkFastExit::undecided;
            }
            if (!(nearer.distance_squared < distance_squared_)) return GjkFastExit::converged;
            set_simplex(nearer);
            distance_squared_ = nearer.distance_squared;
            if (distance_squared_ <= 1e-24 * scale_ * scale_) return GjkFastExit::undecided;
        }
        return GjkFastExit::undecided;
    }

    HWY_INLINE void set_simplex(const Closest& face) {
        // The indices increase.
        for (std::uint32_t i = 0; i < face.count; ++i) corners_[i] = corners_[face.corners[i]];
        count_ = face.count;
        closest_ = face.point;
    }

    void record(Trace<3>* trace) const {
        if (trace == nullptr) return;
        GjkStep<3> step;
        step.count = count_;
        for (std::uint32_t i = 0; i < count_; ++i)
            step.points[i] = to_float(core_a_.place.vector(corners_[i].position));
        step.closest = to_float(core_a_.place.vector(closest_));
        trace->steps.push_back(step);
    }

    /// Up to three barycentric coordinates of the closest point, in the order of the vertices.
    HWY_INLINE std::array<double, 3> weights_of_closest() const {
        if (count_ == 1) return {1, 0, 0};
        const DVec<3>&a = corners_[0].position, &b = corners_[1].position;
        if (count_ == 2) {
            const double to_a = dot(b, b - a), to_b = dot(a, a - b), whole = to_a + to_b;
            return {to_a / whole, to_b / whole, 0};
        }
        const DVec<3>&c = corners_[2].position, normal = cross(b - a, c - a);
        const double to_a = dot(cross(b, c), normal), to_b = dot(cross(c, a), normal), to_c = dot(cross(a, b), normal);
        const double whole = to_a + to_b + to_c;
        return {to_a / whole, to_b / whole, to_c / whole};
    }

    static HWY_INLINE Closest at_corner(std::uint32_t i, const DVec<3>& point) {
        return {{i}, 1, point, length_squared(point)};
    }

    /// The closest point of a simplex whose last vertex was just added. It lies on a face at that vertex, because it is
    /// nearer than all points before.
    HWY_INLINE Closest closest_at_newest() const {
        switch (count_) {
            case 0:
                return at_corner(0, corners_[0].position);
            case 1:
                return on_edge(0, 1);
            case 2:
                return on_triangle(0, 1, 2, cross_from(2, 0, 1));
            default:
                return on_tetrahedron();
        }
    }

    HWY_INLINE DVec<3> cross_from(std::uint32_t from, std::uint32_t i, std::uint32_t j) const {
        const DVec<3>& a = corners_[from].position;
        return cross(corners_[i].position - a, corners_[j].position - a);
    }

    /// The closest point on the edge from a vertex to the newest one.
    HWY_INLINE Closest on_edge(std::uint32_t i, std::uint32_t newest) const {
        const DVec<3>& a = corners_[newest].position;
        const DVec<3> edge = corners_[i].position - a;
        const double along = -dot(a, edge);
        if (!(along > 0)) return at_corner(newest, a);
        const DVec<3> point = a + edge * std::min(along / length_squared(edge), 1.0);
        return {{i, newest}, 2, point, length_squared(point)};
    }

    /// The closest point on the triangle of two vertices and the newest one, given the normal (b - a) x (c - a).
    HWY_INLINE Closest on_triangle(std::uint32_t i, std::uint32_t j, std::uint32_t newest,
                                   const DVec<3>& normal) const {
        const DVec<3>&a = corners_[newest].position, &b = corners_[i].position, &c = corners_[j].position;
        const bool beyond_b = !(dot(cross(a, b), normal) > 0), beyond_c = !(dot(cross(c, a), normal) > 0);
        if (!beyond_b && !beyond_c) {
            const DVec<3> projection = normal * (dot(normal, a) / length_squared(normal));
            return {{i, j, newest}, 3, projection, length_squared(projection)};
        }
        if (!beyond_c) return on_edge(i, newest);
        if (!beyond_b) return on_edge(j, newest);
        return better(on_edge(i, newest), on_edge(j, newest));
    }

    static HWY_INLINE Closest better(const Closest& a, const Closest& b) {
        return b.distance_squared < a.distance_squared ? b : a;
    }

    /// The result has no vertices if the origin is inside.
    HWY_INLINE Closest on_tetrahedron() const {
        const DVec<3>& a = corners_[3].position;
        const DVec<3> b = corners_[0].position - a, c = corners_[1].position - a, d = corners_[2].position - a;
        const DVec<3> bc = cross(b, c), cd = cross(c, d), db = cross(d, b);
        const double sign = dot(bc, d) < 0 ? -1 : 1;
        Closest best{{}, 0, DVec<3>(0.0), std::numeric_limits<double>::infinity()};
        if (sign * dot(bc, a) > 0) best = better(best, on_triangle(0, 1, 3, bc));
        if (sign * dot(cd, a) > 0) best = better(best, on_triangle(1, 2, 3, cd));
        if (sign * dot(db, a) > 0) best = better(best, on_triangle(0, 2, 3, -db));
        return best;
    }

    /// The closest point of any simplex, without assumptions about its last vertex.
    Closest closest_of_all() const {
        if (count_ == 1) return at_corner(0, corners_[0].position);
        if (count_ == 2) return on_whole_edge(0, 1);
        if (count_ == 3) return on_whole_triangle(0, 1, 2);
        return better(better(on_whole_triangle(0, 1, 2), on_whole_triangle(0, 1, 3)),
                      better(on_whole_triangle(0, 2, 3), on_whole_triangle(1, 2, 3)));
    }
    Closest on_whole_edge(std::uint32_t i, std::uint32_t j) const {
        return better(at_corner(i, corners_[i].position), on_edge(i, j));
    }
    Closest on_whole_triangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        const DVec<3> normal = cross_from(k, i, j);
        const Closest face = on_triangle(i, j, k, normal);
        const bool inside = face.count == 3 && dot(cross(corners_[i].position, corners_[j].position), normal) > 0;
        return inside ? face : better(on_whole_edge(i, j), better(on_whole_edge(j, k), on_whole_edge(i, k)));
    }

    /// Whether the origin is inside the tetrahedron, farther from all faces than the rounding error.
    bool surely_inside() const {
        const DVec<3>&a = corners_[0].position, &b = corners_[1].position, &c = corners_[2].position,
              &d = corners_[3].position;
        const DVec<3> ab = cross(a, b), cd = cross(c, d);
        // Six times the volumes between the origin and each face.
        const double volumes[4] = {dot(cd, b), -dot(cd, a), dot(ab, d), -dot(ab, c)};
        const double threshold = 1e-12 * scale_ * scale_ * scale_;
        const double sign = volumes[0] < 0 ? -1 : 1;
        bool inside = true;
        for (const double volume : volumes) inside = inside && sign * volume > threshold;
        return inside;
    }

    const Convex<3>& core_a_;
    Corners a_, b_;
    double unscale_, max_distance_;
    Affine<3> b_to_a_;
    double scale_;  ///< no coordinate is larger
    DVec<3> closest_{0.0};
    double distance_squared_ = std::numeric_limits<double>::infinity();  ///< of `closest_`, if there are vertices
    double along_ = 0;  ///< the support value of A - B towards the origin, times the length of `closest_`
    std::array<Corner, 4> corners_;
    std::uint32_t count_ = 0;
};

/// Iterates until no point of A - B is nearer to the origin, or, with a finite `max_distance`, until it is certain
/// whether the distance is above that.
GjkFastExit search(const Convex<3>& a, const Convex<3>& b, double max_distance, Cache& simplex, GjkFastResult& result,
                   Trace<3>* trace) {
    GjkFast solver(a, b, max_distance);
    const GjkFastExit exit = solver.run(simplex, result.toward, trace);
    const bool measures = exit == GjkFastExit::converged && max_distance == std::numeric_limits<double>::infinity();
    return measures && !solver.closest_points(result) ? GjkFastExit::undecided : exit;
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {
namespace {

bool fits_simd(const Convex<3>& core) {
    if (core.core == Core::box) return true;
    if (core.core != Core::points || core.lanes != nullptr) return core.lanes != nullptr;
    if (core.count > PointSoa::max_lanes) return false;
    for (std::uint32_t i = 0; i < core.count; ++i)
        if (largest(DVec<3>(core.vertices()[i])) > static_cast<double>(PointSoa::max_coordinate)) return false;
    return true;
}

/// Whether both have vertices and a similarity placement, and they are not both boxes.
bool applies(const Convex<3>& a, const Convex<3>& b) {
    if (a.core == Core::box && b.core == Core::box) return false;
    return has_similarity_placement(a) && has_similarity_placement(b) && fits_simd(a) && fits_simd(b);
}

/// The vertices of a cache up to the first invalid index.
Cache valid_vertices(const Convex<3>& a, const Convex<3>& b, const Cache& cache) {
    Cache result = cache;
    result.axis = {};
    result.count = 0;
    const std::uint32_t count = std::min(cache.count, 4u);
    while (result.count < count && has_corner(a, cache.corner_a[result.count]) &&
           has_corner(b, cache.corner_b[result.count]))
        ++result.count;
    return result;
}

}  // namespace

HWY_EXPORT(search);

bool fast_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options, SignedDistance<3>& result,
                   Cache& inside) {
    if (!applies(a, b)) return false;
    Cache simplex;
    if (options.cache != nullptr) simplex = valid_vertices(a, b, *options.cache);
    GjkFastResult gap;
    const GjkFastExit exit =
        HWY_DYNAMIC_DISPATCH(search)(a, b, std::numeric_limits<double>::infinity(), simplex, gap, options.trace);
    if (exit == GjkFastExit::overlapping) inside = simplex;
    if (exit != GjkFastExit::converged || !(gap.upper_bound - gap.lower_bound <= 1e-9 * gap.upper_bound)) return false;
    result.distance = gap.upper_bound - a.radius - b.radius;
    result.normal = gap.toward / length(gap.toward);
    result.on_a = gap.on_a + result.normal * a.radius;
    result.corners = {simplex.corner_a, simplex.corner_b, simplex.count};
    if (options.cache != nullptr) {
        set_axis(result.normal, simplex);
        *options.cache = simplex;
    }
    return true;
}

std::optional<bool> fast_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (!applies(a, b)) return std::nullopt;
    Cache simplex;
    GjkFastResult found;
    if (options.cache != nullptr) {
        if (options.cache->count == 4) simplex = valid_vertices(a, b, *options.cache);
        found.toward = axis_of<3>(*options.cache);
    }
    const GjkFastExit exit = HWY_DYNAMIC_DISPATCH(search)(a, b, a.radius + b.radius, simplex, found, options.trace);
    if (exit != GjkFastExit::separated && exit != GjkFastExit::overlapping) return std::nullopt;
    if (options.cache != nullptr) {
        if (exit == GjkFastExit::separated) set_axis(normalized(found.toward), simplex);
        *options.cache = simplex;
    }
    return exit == GjkFastExit::overlapping;
}

}  // namespace abut::detail
#endif
