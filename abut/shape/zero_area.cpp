#include <abut/math/dvec.hpp>
#include <abut/shape/zero_area.hpp>

namespace abut {

bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const DVec<3> ab = DVec<3>(b) - DVec<3>(a);
    const DVec<3> ac = DVec<3>(c) - DVec<3>(a);
    const DVec<3> bc = DVec<3>(c) - DVec<3>(b);
    const double longest = std::max({length_squared(ab), length_squared(ac), length_squared(bc)});
    const double area = length(cross(ab, ac));
    return area <= 1e-12 * longest;
}

}  // namespace abut
