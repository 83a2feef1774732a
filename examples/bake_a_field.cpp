// Bakes a signed distance field of a mesh. At run time one look-up returns the distance to the surface and its normal:
// a ball rolls into a valley, and a lamp casts soft shadows of its rim.

#include <abut/abut.hpp>
#include <abut/bake.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

struct Ground {
    std::vector<abut::Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// A valley along z as a closed mesh. Its profile is counter-clockwise and star-shaped around corner 0.
Ground valley() {
    const std::vector<abut::Vec2> profile{{0, 1}, {-4, 3}, {-4, 0}, {4, 0}, {4, 3}};
    const auto count = static_cast<std::uint32_t>(profile.size());
    Ground result;
    for (const abut::Vec2& corner : profile)
        for (const float z : {-3.0f, 3.0f}) result.points.emplace_back(corner.x, corner.y, z);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % count);
        result.triangles.insert(result.triangles.end(),
                                {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
    }
    std::erase_if(result.triangles, [](const glm::uvec3& t) { return t.x == t.y || t.x == t.z; });
    return result;
}

}  // namespace

int main() {
    const Ground ground = valley();
    abut::FieldReport report;
    const auto field = abut::bake_field(ground.points, ground.triangles, {.cell = 0.1f, .report = &report});
    if (!field) return 1;  // field.problem().message says why
    std::printf("%zu samples, %zu kB, every sign is certain: %s\n", report.samples, report.bytes / 1000,
                report.closed ? "yes" : "no");

    constexpr float radius = 0.5f, time = 1.0f / 60;
    abut::Vec3 ball{3, 4, 0}, velocity{0, 0, 0};
    for (int frame = 0; frame < 1200; ++frame) {
        velocity = (velocity - abut::Vec3(0, 9.8f * time, 0)) * 0.995f;
        ball += velocity * time;
        const auto [distance, out] = field->sample(ball);
        if (distance >= radius) continue;
        ball += out * (radius - distance);
        const float along = glm::dot(velocity, out);
        if (along < 0) velocity -= out * along;
    }
    const float rest = 1 + radius * std::sqrt(1.25f);  // touches both slopes
    std::printf("at rest at (%.2f, %.2f), %.3f above the ground\n", static_cast<double>(ball.x),
                static_cast<double>(ball.y), static_cast<double>(field->distance(ball)));

    // Uses the field as a shape, and as an occluder of light.
    const bool touches = abut::overlaps(abut::Sphere{ball, radius + 0.1f}, *field);
    const float lit = field->shadow({2, 2, 0}, {-1, 9, 0}), dark = field->shadow({-2, 2, 0}, {-9, 4, 0});
    std::printf("light: %.2f on one slope, %.2f on the other, from behind the rim\n", static_cast<double>(lit),
                static_cast<double>(dark));
    const bool as_expected = report.closed && touches && std::abs(ball.x) < 0.1f && std::abs(ball.y - rest) < 0.1f &&
                             lit > 0.9f && dark < 0.1f;
    return as_expected ? 0 : 1;
}
