#include <abut/draw/projected.hpp>
#include <abut/math/dvec.hpp>

#include <vector>

namespace abut {

using namespace detail;

Projected::Projected(Canvas<2>& flat, const Aabb3& shown, const Vec3& towards_eye, const Vec3& up)
    : flat_(flat), shown_(shown) {
    const DVec<3> back = normalized(DVec<3>(towards_eye), axis<3>(2));
    right_ = normalized(cross(DVec<3>(up), back), perpendicular(back));
    up_ = cross(back, right_);
}

Vec2 Projected::operator()(const Vec3& point) const {
    const DVec<3> p(point);
    return to_float(DVec<2>(dot(right_, p), dot(up_, p)));
}

void Projected::line(const Vec3& a, const Vec3& b, const Style& style) {
    flat_.line((*this)(a), (*this)(b), style);
}

void Projected::point(const Vec3& position, const Style& style) {
    flat_.point((*this)(position), style);
}

void Projected::polygon(std::span<const Vec3> points, const Style& style) {
    std::vector<Vec2> seen;
    for (const Vec3& point : points) seen.push_back((*this)(point));
    flat_.polygon(seen, style);
}

void Projected::ball(const Vec3& center, float radius, const Style& style) {
    flat_.ball((*this)(center), radius, style);
    Canvas<3>::ball(center, radius, style);
}

void Projected::text(const Vec3& position, std::string_view text, const Style& style) {
    flat_.text((*this)(position), text, style);
}

}  // namespace abut
