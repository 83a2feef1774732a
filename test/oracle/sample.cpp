#include "sample.hpp"

namespace abut::oracle {

template <int D>
Sample<D> SampleGenerator<D>::make(Kind kind) {
    const float radius = random_.uniform_float(0.05 * size_, 0.7 * size_);
    switch (kind) {
        case Kind::ball: {
            const Vec<D> center = point(0);
            const float whole = static_cast<float>(size_);
            return sample<D>(kind, Ball<D>{center, whole}, hull_of<D>({center}, static_cast<double>(whole)));
        }
        case Kind::capsule: {
            const Vec<D> a = point(0.7), b = point(0.7);
            return sample<D>(kind, Capsule<D>{a, b, radius}, hull_of<D>({a, b}, static_cast<double>(radius)));
        }
        case Kind::segment: {
            const Vec<D> a = point(1), b = point(1);
            return sample<D>(kind, Segment<D>{a, b}, hull_of<D>({a, b}));
        }
        case Kind::triangle: {
            const Vec<D> a = point(1), b = point(1), c = point(1);
            return sample<D>(kind, Triangle<D>{a, b, c}, hull_of<D>({a, b, c}));
        }
        case Kind::box: {
            const Box<D> box{point(0), half(), random_.rotation<D>()};
            return sample<D>(kind, box, box_of<D>(detail::affine(Pose<D>{box.center, box.rotation}), box.half));
        }
        case Kind::aabb: {
            const Vec<D> middle = point(0), extent = half();
            const Aabb<D> box{middle - extent, middle + extent};
            return sample<D>(kind, box, box_between(box.min, box.max));
        }
        case Kind::rounded_box: {
            const Box<D> box{point(0), half() * 0.5f, random_.rotation<D>()};
            return sample<D>(
                kind, rounded(Box<D>(box), radius),
                box_of<D>(detail::affine(Pose<D>{box.center, box.rotation}), box.half, static_cast<double>(radius)));
        }
        case Kind::cloud: {
            std::vector<Vec<D>> points;
            for (std::uint32_t i = D + 1 + random_.below(7); i > 0; --i) points.push_back(point(1));
            return sample<D>(kind, PointCloud<D>{points}, hull_of<D>(points));
        }
        case Kind::polytope: {
            std::vector<Vec<D>> points;
            for (std::uint32_t i = D + 1 + random_.below(7); i > 0; --i) points.push_back(point(1));
            return sample<D>(kind, *BuiltHull<D>::build(points), hull_of<D>(points));
        }
        case Kind::posed_capsule: {
            const Pose<D> pose{point(0), random_.rotation<D>()};
            const Vec<D> a = local(0.7), b = local(0.7);
            return sample<D>(kind, at(Capsule<D>{a, b, radius}, pose),
                             mapped(hull_of<D>({a, b}, static_cast<double>(radius)), detail::affine(pose)));
        }
        case Kind::stretched_box: {
            const Pose<D> pose{point(0), random_.rotation<D>()};
            const Box<D> box{local(0.1), half() * 0.5f, random_.rotation<D>()};
            const Vec<D> scale = local(2) / static_cast<float>(size_);
            const detail::Affine<D> place =
                detail::affine(pose) * detail::scaling(scale) * detail::affine(Pose<D>{box.center, box.rotation});
            return sample<D>(kind, at(stretched(Box<D>(box), scale), pose), box_of<D>(place, box.half));
        }
        case Kind::rounded_triangle: {
            const Vec<D> a = point(0.7), b = point(0.7), c = point(0.7);
            return sample<D>(kind, rounded(Triangle<D>{a, b, c}, radius),
                             hull_of<D>({a, b, c}, static_cast<double>(radius)));
        }
    }
    return {};
}

template class SampleGenerator<2>;
template class SampleGenerator<3>;

}  // namespace abut::oracle
