#include <abut/motion/mover/sdf_planes.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>

#include <algorithm>
#include <optional>

namespace abut::detail {
namespace {

/// Extra range of rays, relative to the shape's size: the maximum curvature offset of a ball.
constexpr double max_curvature_offset = 0.2;

/// A ray that hits at about its own direction has found a plane.
constexpr double same_normal = 0.9999;

/// Planes whose normals are closer than this cosine count once.
constexpr double same_plane = 0.99;

/// Maximum number of rays per start direction.
constexpr int max_rays = 6;

/// Rays from the support point to the surface.
template <int D>
class SurfaceRays {
public:
    SurfaceRays(const Convex<D>& shape, const DistanceFunction<D>& function, double max_distance)
        : shape_(shape), function_(function), sdf_(function), max_distance_(max_distance) {}

    bool find(const DVec<D>& direction, PartHit<D>& hit) const {
        const DVec<D> from = support(shape_, direction);
        return sdf_.at(from) <= sdf_.slope() * max_distance_ &&
               part_hit(DRay<D>{from, direction, max_distance_}, function_, hit);
    }

    /// Iterates from a direction against the normal found, until the direction is the plane's normal. Nothing if it
    /// reaches a known plane.
    std::optional<SdfPlane<D>> plane_from(DVec<D> direction, std::span<const SdfPlane<D>> known) const {
        for (int i = 0; i < max_rays; ++i) {
            PartHit<D> hit;
            if (!find(direction, hit)) return std::nullopt;
            const DVec<D> normal = normalized(hit.normal);
            const auto has_normal = [&](const SdfPlane<D>& plane) { return dot(plane.normal, normal) >= same_plane; };
            if (std::any_of(known.begin(), known.end(), has_normal)) return std::nullopt;
            if (dot(normal, direction) <= -same_normal)
                return SdfPlane<D>{normal, support(shape_, direction) + direction * hit.along, hit.along};
            direction = -normal;
        }
        return std::nullopt;
    }

private:
    const Convex<D>& shape_;
    const DistanceFunction<D>& function_;
    PlacedFunction<D> sdf_;
    double max_distance_;
};

}  // namespace

template <int D>
std::size_t find_sdf_planes(const Convex<D>& shape, const DistanceFunction<D>& function, double reach,
                            std::span<SdfPlane<D>, max_sdf_planes<D>> planes) {
    const double around = size(shape);
    const SurfaceRays<D> rays(shape, function, std::min(1.2 * (reach + max_curvature_offset * around), around));
    std::size_t count = 0;
    // All combinations of -1, 0 and 1 along the axes, except 0.
    constexpr int all = D == 2 ? 9 : 27;
    for (int number = 0; number < all; ++number) {
        if (number == all / 2) continue;
        DVec<D> direction;
        for (int i = 0, rest = number; i < D; ++i, rest /= 3) direction[i] = rest % 3 - 1;
        if (const auto plane = rays.plane_from(normalized(direction), planes.first(count))) planes[count++] = *plane;
    }
    return count;
}

template <int D>
double distance_to_surface(const Convex<D>& shape, const DistanceFunction<D>& function, const DVec<D>& direction) {
    PartHit<D> hit;
    const bool found = SurfaceRays<D>(shape, function, size(shape)).find(direction, hit);
    return found ? hit.along : std::numeric_limits<double>::infinity();
}

#define ABUT_INSTANTIATE(D)                                                                    \
    template std::size_t find_sdf_planes(const Convex<D>&, const DistanceFunction<D>&, double, \
                                         std::span<SdfPlane<D>, max_sdf_planes<D>>);           \
    template double distance_to_surface(const Convex<D>&, const DistanceFunction<D>&, const DVec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
