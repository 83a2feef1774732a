// The ray through a point of the screen passes through the world points drawn there.

#include "../../oracle/expect.hpp"
#include "../../oracle/random.hpp"
#include <abut/query/ray_through.hpp>

#include <array>
#include <optional>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

TEST(RayThrough, ByHand) {
    // The camera at z = 10 faces -z; its view extends from -1 to 1 at a distance of 1.
    const glm::mat4 view = glm::lookAt(Vec3(0, 0, 10), Vec3(0), Vec3(0, 1, 0));
    const glm::mat4 projection = glm::frustumRH_NO(-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 100.0f);
    const Ray3 middle = ray_through({400, 300}, Vec2(800, 600), projection * view);
    EXPECT_TRUE(near(middle.origin, Vec3(0, 0, 9), 1e-5));
    EXPECT_TRUE(near(middle.direction, Vec3(0, 0, -1)));
    EXPECT_NEAR(middle.length, 99, 1e-2);
    // The upper left corner of the window is the upper left of the view.
    const Ray3 corner = ray_through({0, 0}, Vec2(800, 600), projection * view);
    EXPECT_TRUE(near(corner.origin, Vec3(-1, 1, 9), 1e-5));
    EXPECT_TRUE(near(corner.direction, Vec3(-0.57735027f, 0.57735027f, -0.57735027f)));
    // The viewport is a part of the window.
    const Ray3 part = ray_through({500, 350}, Aabb2{{400, 300}, {600, 400}}, projection * view);
    EXPECT_TRUE(near(part.direction, middle.direction));
    EXPECT_TRUE(near(part.origin, middle.origin, 1e-5));
}

/// A camera matrix, with its convention of clip space.
struct Camera {
    glm::mat4 projection;
    ClipSpace clip;
    bool has_end = true;
    bool left_handed = false;
};

/// A reversed depth range from 1 to 0, without a far plane.
glm::mat4 reversed_without_end(float slope, float aspect, float from) {
    glm::mat4 m(0);
    m[0][0] = slope / aspect;
    m[1][1] = slope;
    m[2][3] = -1;
    m[3][2] = from;
    return m;
}

std::array<Camera, 8> cameras(float slope, float aspect, float from, float to, float size) {
    const float right = from * aspect / slope, top = from / slope;
    glm::mat4 vulkan = glm::frustumRH_ZO(-right, right, -top, top, from, to);
    vulkan[1][1] *= -1;
    return {{{glm::frustumRH_NO(-right, right, -top, top, from, to), clip_one_to_one, true},
             {glm::frustumRH_ZO(-right, right, -top, top, from, to), clip_zero_to_one, true},
             {glm::frustumLH_ZO(-right, right, -top, top, from, to), clip_zero_to_one, true, true},
             {glm::frustumRH_ZO(-right * to / from, right * to / from, -top * to / from, top * to / from, to, from),
              clip_reversed, true},
             {vulkan, {0, 1, true}, true},
             {reversed_without_end(slope, aspect, from), clip_reversed, false},
             {glm::orthoRH_NO(-size, size, -size, size, from, to), clip_one_to_one, true},
             {glm::orthoRH_ZO(-size, size, -size, size, to, from), clip_reversed, true}}};
}

/// Projects a world point to the screen, with its depth, in double.
struct Seen {
    Vec2 mouse;
    double depth, w;
};
std::optional<Seen> seen(const glm::mat4& m, const ClipSpace& clip, const Aabb2& viewport, const Vec3& point) {
    const glm::dvec4 q = glm::dmat4(m) * glm::dvec4(glm::dvec3(point), 1);
    if (!(q.w > 0)) return std::nullopt;
    const double x = q.x / q.w, y = (clip.y_down ? q.y : -q.y) / q.w, depth = q.z / q.w;
    const double low = static_cast<double>(std::min(clip.near_depth, clip.far_depth));
    const double high = static_cast<double>(std::max(clip.near_depth, clip.far_depth));
    if (std::abs(x) > 1 || std::abs(y) > 1 || depth <= low || depth >= high) return std::nullopt;
    const DVec<2> least(viewport.min), size = DVec<2>(viewport.max) - least;
    return Seen{Vec2(least + size * (DVec<2>(x, y) * 0.5 + 0.5)), depth, q.w};
}

TEST(RayThrough, PassesThroughWhatIsSeenThere) {
    constexpr std::uint64_t seed = 51;
    oracle::Random random(seed);
    std::array<int, 8> tested{};
    for (int repeat = 0; repeat < 20000; ++repeat) {
        const double size = random.power_of_two(-8, 12);
        const Vec3 eye(random.in_cube<3>() * (10 * size)), aim(random.in_cube<3>() * size);
        const Vec3 up(random.direction<3>());
        const glm::mat4 view = glm::lookAtRH(eye, aim, up), left_handed_view = glm::lookAtLH(eye, aim, up);
        const float from = random.uniform_float(0.05 * size, size), to = random.uniform_float(20 * size, 100 * size);
        const auto all = cameras(random.uniform_float(0.5, 3), random.uniform_float(0.5, 2), from, to,
                                 random.uniform_float(size, 4 * size));
        const Aabb2 viewport{Vec2(random.in_cube<2>() * 100.0), Vec2(DVec<2>(1000) + random.in_cube<2>() * 700.0)};
        const Vec3 point(DVec<3>(aim) + random.in_cube<3>() * (2 * size));
        for (std::size_t i = 0; i < all.size(); ++i) {
            const glm::mat4 matrix = all[i].projection * (all[i].left_handed ? left_handed_view : view);
            const auto at = seen(matrix, all[i].clip, viewport, point);
            if (!at) continue;
            ++tested[i];
            const Ray3 ray = ray_through(at->mouse, viewport, matrix, all[i].clip);
            const DVec<3> displacement = DVec<3>(point) - DVec<3>(ray.origin);
            const double along = dot(displacement, DVec<3>(ray.direction));
            // The matrix and the position of the mouse are in float.
            const double error = 3e-5 * size;
            ASSERT_NEAR(length(DVec<3>(ray.direction)), 1, 2e-7);
            ASSERT_LE(length(displacement - DVec<3>(ray.direction) * along), error)
                << "camera " << i << ", seed " << seed << ", repeat " << repeat;
            ASSERT_GE(along, -error);
            ASSERT_EQ(std::isfinite(ray.length), all[i].has_end) << "camera " << i << ", repeat " << repeat;
            ASSERT_LE(along, static_cast<double>(ray.length) * 1.01 + error);
        }
    }
    for (const int count : tested) EXPECT_GT(count, 3000);
}

TEST(RayThrough, OfAMirroredMatrixIsTheSame) {
    const glm::mat4 m = glm::frustumRH_ZO(-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 50.0f);
    const Ray3 plain = ray_through({10, 20}, Vec2(100), m, clip_zero_to_one);
    const Ray3 negated = ray_through({10, 20}, Vec2(100), m * -1.0f, clip_zero_to_one);
    EXPECT_EQ(plain.direction, negated.direction);
    EXPECT_EQ(plain.length, negated.length);
}

TEST(RayThrough, NothingIsSeenByWhatIsNoProjection) {
    const auto is_nothing = [](const Ray3& ray) {
        return ray.length == 0 && ray.origin == Vec3(0) && ray.direction == Vec3(1, 0, 0);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const glm::mat4 fine = glm::frustumRH_NO(-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 100.0f);
    EXPECT_FALSE(is_nothing(ray_through({5, 5}, Vec2(10), fine)));
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(10), glm::mat4(0))));
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(10), glm::mat4(nan))));
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(10), glm::mat4(infinity))));
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(0), fine))) << "a minimised window";
    EXPECT_TRUE(is_nothing(ray_through({nan, 5}, Vec2(10), fine)));
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(10), fine, {1, 1}))) << "near and far are one";
    glm::mat4 flat = fine;
    for (int i = 0; i < 4; ++i) flat[i][1] = flat[i][0];
    EXPECT_TRUE(is_nothing(ray_through({5, 5}, Vec2(10), flat)));
}

}  // namespace
}  // namespace abut
