#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/motion/laser.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <array>
#include <tuple>

namespace abut {
namespace {

/// A raycast that starts nearer to a thin part than this, in parts of its size, may say that it leaves it. It is 1e-6
/// of the part's own size; here the size is guessed, and the part may be so much larger.
constexpr double near_part = 4e-5;

/// What two roundings of a place, and the step back that `reflect` takes, may move it by.
constexpr double rounding = 1e-6;

/// Without thickness: a segment of the plane, a triangle of space.
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

/// How far a point in the plane of a part lies beyond its borders.
double beyond(const std::array<DVec<2>, 2>& corner, const DVec<2>&, const DVec<2>& point) {
    const DVec<2> along = corner[1] - corner[0];
    const double size = length(along), part = dot(point - corner[0], along);
    return size > 0 ? std::max(-part, part - size * size) / size : length(point - corner[0]);
}
double beyond(const std::array<DVec<3>, 3>& corner, const DVec<3>& normal, const DVec<3>& point) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec<3> along = corner[(i + 1) % 3] - corner[i];
        most = std::max(most, dot(normalized(cross(along, normal)), point - corner[i]));
    }
    return most;
}

/// The ray that came to a mirror, and the one that leaves it.
template <int D>
struct Bounce {
    DVec<D> seen_from;  ///< where the way to the mirror began
    DVec<D> came;       ///< the direction in which the ray came
    DVec<D> mirror;     ///< its normal
    DVec<D> origin;     ///< where the ray starts that leaves,
    DVec<D> leaves;     ///< and its direction
    double length = 0;  ///< of that ray
    double doubt = 0;   ///< of a place
};

/// The side of a part that is free: the one on which the ray that leaves starts; where that may be rounding, the one
/// from which the other came. Where that began about on the part too, either it had just left it; or it grazed a part
/// that goes on where the mirror ends.
template <int D>
double free_side(const Bounce<D>& bounce, const DVec<D>& out, double height, double first) {
    constexpr double same_plane = 0.99;
    const double as_mirror = dot(out, bounce.mirror);
    const double tells = std::abs(height) > bounce.doubt    ? height
                         : std::abs(first) > bounce.doubt   ? first
                         : std::abs(as_mirror) > same_plane ? as_mirror
                                                            : dot(out, bounce.came);
    return tells < 0 ? -1 : 1;
}

/// Where the ray that leaves goes through a thin part about which it starts.
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
    const double side = free_side(bounce, out, height, dot(out, bounce.seen_from - corner[0]));
    const double sinks = -side * dot(out, bounce.leaves);
    if (!(sinks > 0)) return false;
    const double along = std::max(side * height / sinks, 0.0);
    const DVec<D> point = bounce.origin + bounce.leaves * along;
    if (along > bounce.length || beyond(corner, out, point) > bounce.doubt) return false;
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
    : world_(&world), filter_(filter), piece_(ray), seen_from_(ray.origin), hit_(world.raycast(ray, filter)) {}

template <int D>
void Laser<D>::bounce() {
    ABUT_ASSERT(hit_);
    if (!hit_) return;
    const WorldHit<D> mirror = *hit_;
    const Ray<D> before = piece_;
    piece_ = reflect(before, mirror.hit);
    hit_ = world_->raycast(piece_, filter_);

    const DVec<D> origin(piece_.origin), leaves = unit(DVec<D>(piece_.direction));
    const double doubt = rounding * std::max(largest(origin), largest(DVec<D>(before.origin)));
    constexpr double many = 64;
    if (static_cast<double>(mirror.hit.distance) > many * doubt) seen_from_ = before.origin;
    const Bounce<D> bounce{DVec<D>(seen_from_),
                           unit(DVec<D>(before.direction)),
                           DVec<D>(mirror.hit.normal),
                           origin,
                           leaves,
                           static_cast<double>(piece_.length),
                           doubt};
    // Thin parts about here are as large as what was hit, or as far as the way to it was long.
    const Aabb<D> box = bounds(world_->shape(mirror.id));
    const double size = length(DVec<D>(box.max) - DVec<D>(box.min)) + static_cast<double>(mirror.hit.distance);
    if (!std::isfinite(size)) return;
    const Aabb<D> about = grown(Aabb<D>{piece_.origin, piece_.origin}, static_cast<float>(near_part * size + doubt));

    const auto look_at = [&](Id id, const Convex<D>& part, std::uint32_t index) {
        Hit<D> hit;
        if (!is_thin(part) || !goes_through(bounce, part, hit)) return;
        hit.feature.part = index;
        const bool is_first =
            !hit_ || std::tie(hit.distance, id, index) < std::tie(hit_->hit.distance, hit_->id, hit_->hit.feature.part);
        if (is_first) hit_ = WorldHit<D>{id, hit};
    };
    const auto look_at_parts = [&](Id id) {
        const View<D> shape = world_->shape(id);
        if (const auto* convex = std::get_if<Convex<D>>(&shape)) look_at(id, *convex, 0);
        if (const auto* composite = std::get_if<Composite<D>>(&shape))
            each_part<D>(*composite, about, [&](const Convex<D>& part, std::uint32_t index) -> bool {
                look_at(id, part, index);
                return true;
            });
    };
    world_->each_overlapping(about, look_at_parts, filter_);
}

template class Laser<2>;
template class Laser<3>;

}  // namespace abut
