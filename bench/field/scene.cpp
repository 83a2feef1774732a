#include "scene.hpp"

#include "../../scenes/bumpy_ball.hpp"
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace abut::bench {

using namespace detail;

FieldOptions<3> FieldScene::options(std::uint32_t cells) const {
    // Slightly less, so that rounding adds no cell.
    const float size = cell(cells) * (static_cast<float>(cells) - 0.25f);
    return {.cell = cell(cells), .volume = Aabb3{corner, corner + Vec3(size)}};
}

SharedFieldScene field_scene() {
    oracle::Random random(1);
    scenes::BumpyBall ball = scenes::bumpy_ball(148, 0.3, 0.002, random);
    Aabb3 box = Aabb3::empty();
    for (const Vec3& p : ball.points) box = merged(box, Aabb3{p, p});
    const Vec3 size = box.max - box.min;
    const float side = 1.1f * std::max({size.x, size.y, size.z});
    const Vec3 corner = (box.min + box.max - Vec3(side)) * 0.5f;
    return std::make_shared<const FieldScene>(
        FieldScene{std::move(ball.points), std::move(ball.triangles), corner, side});
}

std::vector<Vec3> places_near(const FieldScene& scene, float reach, std::size_t count, oracle::Random& random) {
    std::vector<Vec3> result;
    while (result.size() < count) {
        const glm::uvec3& triangle = scene.triangles[random.below(static_cast<std::uint32_t>(scene.triangles.size()))];
        const double u = random.unit(), v = random.uniform(0, 1 - u);
        const DVec<3> a(scene.points[triangle.x]), b(scene.points[triangle.y]), c(scene.points[triangle.z]);
        const double far = random.uniform(0, static_cast<double>(reach));
        result.push_back(to_float(a + (b - a) * u + (c - a) * v + random.direction<3>() * far));
    }
    return result;
}

std::vector<Vec3> samples_at(const FieldScene& scene, std::uint32_t cells, std::span<const Vec3> places) {
    const DVec<3> corner(scene.corner);
    const auto cell = static_cast<double>(scene.cell(cells));
    std::vector<Vec3> result;
    for (const Vec3& p : places) result.push_back(to_float(corner + glm::round((DVec<3>(p) - corner) / cell) * cell));
    return result;
}

}  // namespace abut::bench
