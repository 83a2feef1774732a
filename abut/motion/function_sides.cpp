#include <abut/motion/function_sides.hpp>
#include <abut/query/function_motion.hpp>
#include <abut/query/function_there.hpp>

#include <algorithm>
#include <optional>

namespace abut {
namespace {

/// So far beyond its reach a side may be from where a direction's ray begins, in parts of the shape's size: a ball
/// curves away from it by that at the farthest direction from its normal.
constexpr double curves_away = 0.2;

/// A ray that comes back with about the direction it went is that of a side.
constexpr double same_normal = 0.9999;

/// Sides whose normals differ by less are one.
constexpr double same_side = 0.99;

/// The bound on rays from one direction on.
constexpr int most_rays = 6;

/// How far the border is, along a direction.
template <int D>
class ToBorder {
public:
    ToBorder(const Convex<D>& shape, const DistanceFunction<D>& function, double far)
        : shape_(shape), function_(function), seen_(function), far_(far) {}

    bool find(const DVec<D>& direction, PartHit<D>& hit) const {
        const DVec<D> from = support(shape_, direction);
        return seen_.at(from) <= seen_.slope() * far_ && part_hit(Beam<D>{from, direction, far_}, function_, hit);
    }

    /// From a direction on, again and again against the normal found, to a side of which it is the normal; none where
    /// it comes to a side that is known.
    std::optional<FunctionSide<D>> side_from(DVec<D> direction, std::span<const FunctionSide<D>> known) const {
        for (int i = 0; i < most_rays; ++i) {
            PartHit<D> hit;
            if (!find(direction, hit)) return std::nullopt;
            const DVec<D> normal = normalized(hit.normal);
            const auto has_normal = [&](const FunctionSide<D>& side) { return dot(side.normal, normal) >= same_side; };
            if (std::any_of(known.begin(), known.end(), has_normal)) return std::nullopt;
            if (dot(normal, direction) <= -same_normal)
                return FunctionSide<D>{normal, support(shape_, direction) + direction * hit.along, hit.along};
            direction = -normal;
        }
        return std::nullopt;
    }

private:
    const Convex<D>& shape_;
    const DistanceFunction<D>& function_;
    FunctionThere<D> seen_;
    double far_;
};

}  // namespace

template <int D>
std::size_t find_sides(const Convex<D>& shape, const DistanceFunction<D>& function, double reach,
                       std::span<FunctionSide<D>, most_sides<D>> sides) {
    const double around = size(shape);
    const ToBorder<D> border(shape, function, std::min(1.2 * (reach + curves_away * around), around));
    std::size_t count = 0;
    // All of -1, 0 and 1 along each axis, but for 0 along all.
    constexpr int all = D == 2 ? 9 : 27;
    for (int number = 0; number < all; ++number) {
        if (number == all / 2) continue;
        DVec<D> direction;
        for (int i = 0, rest = number; i < D; ++i, rest /= 3) direction[i] = rest % 3 - 1;
        if (const auto side = border.side_from(normalized(direction), sides.first(count))) sides[count++] = *side;
    }
    return count;
}

template <int D>
double gap_to_border(const Convex<D>& shape, const DistanceFunction<D>& function, const DVec<D>& direction) {
    PartHit<D> hit;
    const bool found = ToBorder<D>(shape, function, size(shape)).find(direction, hit);
    return found ? hit.along : std::numeric_limits<double>::infinity();
}

#define ABUT_INSTANTIATE(D)                                                               \
    template std::size_t find_sides(const Convex<D>&, const DistanceFunction<D>&, double, \
                                    std::span<FunctionSide<D>, most_sides<D>>);           \
    template double gap_to_border(const Convex<D>&, const DistanceFunction<D>&, const DVec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
