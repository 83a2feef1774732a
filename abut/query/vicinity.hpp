#pragma once

// Which of many parts may be near a shape, told for less than their distances would take. For .cpp files.

#include <abut/convex/gjk/gjk.hpp>

namespace abut {

/// About one shape, which is not copied.
template <int D>
class Vicinity {
public:
    explicit Vicinity(const Convex<D>& shape) : shape_(shape) {
        for (int i = 0; i < D; ++i)
            middle_[i] = 0.5 * (core_support(shape, axis<D>(i, 1)).position[i] +
                                core_support(shape, axis<D>(i, -1)).position[i]);
    }

    /// Whether the part is surely farther off than that. Asked of few points, along the way to them from the middle of
    /// the shape; of anything else by a search that ends as soon as it knows.
    bool is_beyond(const Convex<D>& part, double distance) const {
        const double enough = distance + part.radius + shape_.radius;
        if (part.core != Core::points || part.count > 3 || part.inner_radius > 0)
            return gjk(CoreDifference<D>(shape_, part), enough).lower_bound > enough;
        Affine<D> seen = part.place;
        seen.offset -= middle_;
        std::array<DVec<D>, 3> corners;
        Simplex<D> simplex;
        for (; simplex.count < part.count; ++simplex.count) {
            const DVec<D> corner = seen.point(DVec<D>(part.vertices()[simplex.count]));
            corners[simplex.count] = corner;
            simplex.points[simplex.count] = {corner, corner, DVec<D>(0.0), 0, 0};
        }
        const DVec<D> way = reduce_to_closest(simplex);
        const double length_of_way = length(way);
        if (!(length_of_way > enough)) return false;
        const DVec<D> direction = way / length_of_way;
        double from = std::numeric_limits<double>::infinity(), scale = 0;
        for (std::size_t i = 0; i < part.count; ++i) {
            from = std::min(from, dot(direction, corners[i]));
            scale = std::max(scale, largest(corners[i]));
        }
        if (!(from > enough)) return false;
        const double to = dot(direction, core_support(shape_, direction).position - middle_);
        return from - to > enough + 1e-12 * scale + 1e-15 * largest(middle_);
    }

private:
    const Convex<D>& shape_;
    DVec<D> middle_{0.0};
};

}  // namespace abut
