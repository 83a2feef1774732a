#include "tool/shared/picture.hpp"

#include <algorithm>
#include <array>

namespace abut::tool {
namespace {

constexpr Color background{248, 250, 252};
constexpr double picture_width = 1200;

constexpr std::array<Color, 12> colors{{{96, 165, 250},
                                        {251, 146, 60},
                                        {74, 222, 128},
                                        {244, 114, 182},
                                        {250, 204, 21},
                                        {167, 139, 250},
                                        {45, 212, 191},
                                        {248, 113, 113},
                                        {163, 230, 53},
                                        {129, 140, 248},
                                        {217, 160, 102},
                                        {148, 163, 184}}};

class NullCanvas final : public Canvas<2> {
public:
    Aabb2 shown() const override { return Aabb2::empty(); }
    void line(const Vec2&, const Vec2&, const Style&) override {}
    void point(const Vec2&, const Style&) override {}
};

}  // namespace

Aabb2 projected_bounds(const Aabb3& box, const Vec3& towards_eye, const Vec3& up) {
    NullCanvas none;
    const Projected view(none, box, towards_eye, up);
    Aabb2 result = Aabb2::empty();
    for (int i = 0; i < 8; ++i) {
        const Vec2 corner = view({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z});
        result = merged(result, Aabb2{corner, corner});
    }
    return result;
}

SvgCanvas make_canvas(const Aabb2& plane) {
    const double extent =
        std::max(static_cast<double>(plane.max.x - plane.min.x), static_cast<double>(plane.max.y - plane.min.y));
    return {plane, static_cast<float>(picture_width / extent), background};
}

Color color_of_part(std::size_t part) {
    return colors[part % colors.size()];
}

}  // namespace abut::tool
