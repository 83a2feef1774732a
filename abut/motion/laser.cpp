#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/laser.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/view/part.hpp>

#include <algorithm>
#include <array>
#include <tuple>

namespace abut {

using namespace detail;

namespace {

/// A raycast that starts nearer to a thin part than this, relative to its size, may count as leaving it. The true
/// factor is 1e-6 of the part's size; the size is only estimated here and may be too small.
constexpr double near_part = 4e-5;

/// The error of a point after two roundings and the offset that `reflect` applies.
constexpr double rounding = 1e-6;

/// True for a part without thickness: a segment in 2D, a triangle in 3D.
template <int D>
bool is_thin(const Convex<D>& part) {
    return part.core == Core::points && part.count == static_cast<std::uint32_t>(D) && part.radius == 0 &&
           part.inner_radius == 0;
}

DVec<2> normal_of(const std::array<DVec<2>, 2>& corner) {
    const DVec<2> along = corner[1] - corner[0];
    return normalized(DVec<2>(along.y, -along.x));
}
DVec<3> normal_of(const std::array<DVec<3>, 3>& corner) {
    return normalized(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

/// The distance of a point in the part's plane beyond its edges; negative inside.
double beyond(const std::array<DVec<2>, 2>& corner, const DVec<2>&, const DVec<2>& point) {
    const DVec<2> along = corner[1] - corner[0];
    const double size = length(along), part = dot(point - corner[0], along);
    return size > 0 ? std::max(-part, part - size * size) / size : length(point - corner[0]);
}
double beyond(const std::array<DVec<3>, 3>& corner, const DVec<3>& normal, const DVec<3>& point) {
    double result = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3> along = corner[(i + 1) % 3] - corner[i];
        result = std::max(result, dot(normalized(cross(along, normal)), point - corner[i]));
    }
    return result;
}

/// The incoming ray at a mirror, and the reflected ray.
template <int D>
struct Bounce {
    DVec<D> start;         ///< start of the incoming ray
    DVec<D> incoming;      ///< direction of the incoming ray
    DVec<D> mirror;        ///< normal of the mirror
    DVec<D> origin;        ///< start of the reflected ray
    DVec<D> outgoing;      ///< direction of the reflected ray
    double length = 0;     ///< length of the reflected ray
    double tolerance = 0;  ///< rounding error of a point
};

/// The side of the part on which the reflected ray starts. Within rounding, it is the side on which the incoming ray
/// started. If that is undecided too, the incoming ray had just left the part, or grazes a part that continues the
/// mirror.
template <int D>
double free_side(const Bounce<D>& bounce, const DVec<D>& out, double height, double first) {
    constexpr double same_plane = 0.99;
    const double as_mirror = dot(out, bounce.mirror);
    const double height_or_sign = std::abs(height) > bounce.tolerance  ? height
                                  : std::abs(first) > bounce.tolerance ? first
                                  : std::abs(as_mirror) > same_plane   ? as_mirror
                                                                       : dot(out, bounce.incoming);
    return height_or_sign < 0 ? -1 : 1;
}

/// True if the reflected ray passes through a thin part that it starts at; writes the hit.
template <int D>
bool goes_through(const Bounce<D>& bounce, const Convex<D>& part, Hit<D>& hit) {
    std::array<DVec<D>, static_cast<std::size_t>(D)> corner;
    double size = 0;
    for (std::uint32_t i = 0; i < corner.size(); ++i) {
        corner[i] = part.place.point(DVec<D>(part.vertices()[i]));
        size = std::max(size, length(corner[i] - corner[0]));
    }
    const DVec<D> out = normal_of(corner);
    const double height = dot(out, bounce.origin - corner[0]);
    if (std::abs(height) > near_part * size) return false;
    const double side = free_side(bounce, out, height, dot(out, bounce.start - corner[0]));
    const double sinks = -side * dot(out, bounce.outgoing);
    if (!(sinks > 0)) return false;
    const double along = std::max(side * height / sinks, 0.0);
    const DVec<D> point = bounce.origin + bounce.outgoing * along;
    if (along > bounce.length || beyond(corner, out, point) > bounce.tolerance) return false;
    hit.distance = static_cast<float>(along);
    hit.fraction = bounce.length > 0 && std::isfinite(bounce.length) ? static_cast<float>(along / bounce.length) : 0;
    hit.point = to_float(point);
    hit.normal = to_float(out * side);
    hit.feature.kind = D == 2 ? FeatureKind::edge : FeatureKind::face;
    hit.feature.index = D == 2 ? edge_index(0, 1) : side > 0 ? 0 : 1;
    return true;
}

}  // namespace

template <int D>
Laser<D>::Laser(const World<D>& world, const Ray<D>& ray, const Filter& filter)
    : world_((detail::enter_library(), &world)),
      filter_(filter),
      piece_(ray),
      last_start_(ray.origin),
      hit_(world.raycast(ray, filter)) {}

template <int D>
void Laser<D>::bounce() {
    detail::enter_library();
    ABUT_ASSERT(hit_);
    if (!hit_) return;
    const WorldHit<D> mirror = *hit_;
    const Ray<D> before = piece_;
    piece_ = reflect(before, mirror.hit);
    hit_ = world_->raycast(piece_, filter_);

    const DVec<D> origin(piece_.origin), outgoing = unit(DVec<D>(piece_.direction));
    const double tolerance = rounding * std::max(largest(origin), largest(DVec<D>(before.origin)));
    constexpr double many = 64;
    if (static_cast<double>(mirror.hit.distance) > many * tolerance) last_start_ = before.origin;
    const Bounce<D> bounce{DVec<D>(last_start_),
                           unit(DVec<D>(before.direction)),
                           DVec<D>(mirror.hit.normal),
                           origin,
                           outgoing,
                           static_cast<double>(piece_.length),
                           tolerance};
    // Thin parts nearby are assumed to be as large as the hit shape or as the distance to it.
    const Aabb<D> box = bounds(world_->shape(mirror.id));
    const double size = length(DVec<D>(box.max) - DVec<D>(box.min)) + static_cast<double>(mirror.hit.distance);
    if (!std::isfinite(size)) return;
    const Aabb<D> about =
        grown(Aabb<D>{piece_.origin, piece_.origin}, static_cast<float>(near_part * size + tolerance));

    const auto test_part = [&](Id id, const Convex<D>& part, std::uint32_t index) {
        Hit<D> hit;
        if (!is_thin(part) || !goes_through(bounce, part, hit)) return;
        hit.feature.part = index;
        const bool is_first =
            !hit_ || std::tie(hit.distance, id, index) < std::tie(hit_->hit.distance, hit_->id, hit_->hit.feature.part);
        if (is_first) hit_ = WorldHit<D>{id, hit};
    };
    const auto test_parts = [&](Id id) {
        detail::for_each_part<D>(world_->shape(id), about, [&](const detail::Part<D>& part, std::uint32_t index) {
            if (part.is_convex()) test_part(id, part.convex(), index);
            return true;
        });
    };
    world_->each_overlapping(about, test_parts, filter_);
}

template class Laser<2>;
template class Laser<3>;

}  // namespace abut
