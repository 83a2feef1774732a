// The shader against the library: equal queries on a graphics card, or on a software renderer.

#include "../oracle/random.hpp"
#include "analytic.hpp"
#include "gl_context.hpp"
#include <abut/field/texture.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <tuple>

#include <gtest/gtest.h>

namespace {

using namespace abut;
using namespace abut::detail;
using test::GlContext, test::GlKind;

std::string shader_file() {
    std::ifstream file(ABUT_SOURCE_FOLDER "/abut/field/abut_field.glsl");
    return {std::istreambuf_iterator<char>(file), {}};
}

test::GlTexture for_gl(TextureFormat format) {
    // GL_R8_SNORM, GL_BYTE; GL_R16F, GL_HALF_FLOAT; GL_R32F, GL_FLOAT.
    if (format == TextureFormat::r8_snorm) return {.internal_format = 0x8f94, .type = 0x1400};
    if (format == TextureFormat::r16f) return {.internal_format = 0x822d, .type = 0x140b};
    return {.internal_format = 0x822e, .type = 0x1406};
}

template <int D>
std::vector<float> numbers(const Vec<D>& v) {
    return {&v[0], &v[0] + D};
}

/// The results of `answer` for each query.
template <int D>
std::vector<glm::vec4> evaluated(GlContext& context, const FieldTexture<D>& texture, bool filter,
                                 const std::string& answer, const std::vector<glm::vec4>& questions) {
    std::string source = D == 2 ? "#define ABUT_2D\n" : "";
    if (filter) source += "#define ABUT_FIELD_FILTER\n";
    source += shader_file() +
              "\nuniform vec3 light;\n#ifdef ABUT_2D\n#define V(q) (q).xy\n#define W(v) vec3(v, 0.0)\n"
              "#else\n#define V(q) (q).xyz\n#define W(v) (v)\n#endif\n"
              "vec4 answer(vec4 q) { return " +
              answer + "; }\n";
    test::GlTexture gl = for_gl(texture.format);
    gl.size = {texture.width, texture.height, texture.depth};
    gl.flat = D == 2;
    gl.linear = filter;
    gl.bytes = texture.bytes.data();
    const std::array<test::GlUniform, 6> uniforms{{{"abut_origin", numbers<D>(texture.box.min)},
                                                   {"abut_cell", {texture.cell}},
                                                   {"abut_decode", {texture.scale, texture.offset}},
                                                   {"abut_surface_min", numbers<D>(texture.surface.min)},
                                                   {"abut_surface_max", numbers<D>(texture.surface.max)},
                                                   {"light", {2.9f, 2.1f, 3.3f}}}};
    std::string log;
    const std::vector<glm::vec4> result = context.run(source, gl, uniforms, questions, log);
    EXPECT_EQ(result.size(), questions.size()) << log;
    return result;
}

struct Case {
    GlKind kind;
    TextureFormat format;
    bool filter;
};

class Glsl : public ::testing::TestWithParam<Case> {
protected:
    void SetUp() override {
        std::string why;
        context = GlContext::open(GetParam().kind, why);
        if (context == nullptr) GTEST_SKIP() << "no OpenGL to run shaders on: " << why;
    }

    template <int D>
    void compare(const Field<D>& field, double factor = 1) {
        const auto texture = to_texture(field, GetParam().format);
        ASSERT_TRUE(texture);
        const bool filter = GetParam().filter;
        constexpr std::uint64_t seed = 11;
        oracle::Random random(seed);
        std::vector<glm::vec4> questions;
        std::vector<Vec<D>> points;
        const Aabb<D> volume = field.volume();
        for (int i = 0; i < 5000; ++i) {
            Vec<D> p;
            // Every fourth is a little outside.
            const float margin = i % 4 == 0 ? 1.0f : 0.0f;
            for (int a = 0; a < D; ++a) p[a] = random.uniform_float(volume.min[a] - margin, volume.max[a] + margin);
            points.push_back(p);
            questions.emplace_back(p[0], p[1], D == 3 ? p[D - 1] : 0.0f, 0.0f);
        }
        const auto answers =
            evaluated(*context, *texture, filter, "vec4(W(abut_normal(V(q))), abut_distance(V(q)))", questions);
        const auto shadows = evaluated(*context, *texture, filter,
                                       "vec4(abut_shadow(V(q), V(light), 0.0), abut_shadow(V(q), V(light), 0.05), "
                                       "abut_shadow(V(q), V(light), 0.3), 1.0)",
                                       questions);
        ASSERT_EQ(answers.size(), points.size());
        ASSERT_EQ(shadows.size(), points.size());

        Vec<D> light;
        for (int a = 0; a < D; ++a) light[a] = std::array{2.9f, 2.1f, 3.3f}[static_cast<std::size_t>(a)];
        // Texels, and the position within the cell: cards resolve it to 1/256, this one may be better.
        const float bound = texture->error + (filter ? field.cell() / 256 * D : 0) + 2e-5f;
        std::size_t within = 0, dark = 0, soft = 0, strays = 0;
        double angles = 0, shadow_error = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const FieldSample<D> right = field.sample(points[i]);
            if (contains(volume, points[i])) {
                ++within;
                ASSERT_NEAR(answers[i].w, right.distance, bound) << "seed " << seed << " point " << i;
                Vec<D> normal;
                for (int a = 0; a < D; ++a) normal[a] = answers[i][a];
                double cosine = dot(DVec<D>(normal), DVec<D>(right.normal));
                ASSERT_NEAR(dot(DVec<D>(normal), DVec<D>(normal)), 1, 1e-5);
                cosine = std::min(cosine, 1.0);
                angles += std::sqrt(2 - 2 * cosine);
                // Where the slopes of the corners cancel, the normal is undefined.
                strays += std::sqrt(2 - 2 * cosine) > 4 * texture->error / field.cell() + 1e-3;
            } else {
                // As in the library: never more than the true distance, and at most a cell less.
                ASSERT_LE(answers[i].w, right.distance + 1.5f * field.cell() + bound);
                ASSERT_GE(answers[i].w, right.distance - 1.5f * field.cell() - bound);
            }
            for (int s = 0; s < 3; ++s) {
                const float softness = std::array{0.0f, 0.05f, 0.3f}[static_cast<std::size_t>(s)];
                const float expected = field.shadow(points[i], light, softness);
                const float off = std::abs(shadows[i][s] - expected);
                dark += expected == 0;
                soft += expected > 0 && expected < 1;
                shadow_error += off;
                strays += off > 0.1f;
            }
        }
        const double n = static_cast<double>(points.size());
        std::cout << context->name() << D << "D format " << int(GetParam().format) << (filter ? " filter" : "")
                  << " texel error " << texture->error << " mean angle " << angles / static_cast<double>(within)
                  << " mean shadow error " << shadow_error / (3 * n) << " strays " << strays << "\n";
        EXPECT_GT(within, points.size() / 2);
        EXPECT_GT(dark, points.size() / 10) << "shadows to compare";
        EXPECT_GT(soft, points.size() / 50);
        const bool fine = GetParam().format != TextureFormat::r8_snorm;
        EXPECT_LT(angles / static_cast<double>(within), fine ? 2e-3 : 0.1);
        EXPECT_LT(shadow_error / (3 * n), factor * (fine ? 3e-4 : 3e-3));
        EXPECT_LT(static_cast<double>(strays), factor * (fine ? 0.005 : 0.05) * n);
    }

    std::unique_ptr<GlContext> context;
};

TEST_P(Glsl, SaysInSpaceWhatTheLibrarySays) {
    compare(Field3(oracle::filled_around(oracle::torus({0.2, 0.1, -0.3}, 1, 0.4), 0.08f, 5)));
}

TEST_P(Glsl, SaysInThePlaneWhatTheLibrarySays) {
    compare(Field2(oracle::filled_around(oracle::box<2>({0.2, 0.1}, {1, 0.4}), 0.05f, 5)));
}

TEST_P(Glsl, ASolidThatTheVolumeCutsEndsWithIt) {
    // Rays are parallel to planes at which the bounds outside differ.
    compare(Field2(oracle::filled<2>(oracle::box<2>({0, 0}, {2, 0.4}), {-1, -1}, 0.05f, {40, 40})), 4);
}

INSTANTIATE_TEST_SUITE_P(All, Glsl,
                         ::testing::Values(Case{GlKind::es_3_0, TextureFormat::r8_snorm, false},
                                           Case{GlKind::es_3_0, TextureFormat::r8_snorm, true},
                                           Case{GlKind::es_3_0, TextureFormat::r16f, true},
                                           Case{GlKind::es_3_0, TextureFormat::r32f, false},
                                           Case{GlKind::core_3_3, TextureFormat::r8_snorm, true},
                                           Case{GlKind::core_3_3, TextureFormat::r16f, false},
                                           Case{GlKind::core_3_3, TextureFormat::r16f, true},
                                           Case{GlKind::core_3_3, TextureFormat::r32f, false}));

}  // namespace
