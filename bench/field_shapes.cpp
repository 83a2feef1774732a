// Balls and boxes beside a field of 128^3 cells, and beside the mesh it was baked of.

#include "bench.hpp"
#include "field_scene.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/mesh.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace abut::bench {
namespace {

constexpr std::uint32_t cells = 128;
constexpr std::size_t asked = 4096;

struct Level {
    SharedFieldScene scene = field_scene();
    Field3 field = *bake_field(scene->points, scene->triangles, scene->options(cells));
    Mesh mesh = *Mesh::build(scene->points, scene->triangles);
    float cell = field.cell();
};

/// Of three cells' radius; their centers are outside and up to twice that from the surface.
std::vector<Sphere> balls(const Level& level) {
    oracle::Random random(7);
    const float radius = 3 * level.cell;
    std::vector<Sphere> result;
    for (const Vec3& p : places_near(*level.scene, 2 * radius, 8 * asked, random))
        if (result.size() < asked && level.field.distance(p) > level.cell) result.push_back({p, radius});
    return result;
}

/// Of six cells' size, flat on what is below their middle, up to half a cell above or below it.
std::vector<Box3> resting_boxes(const Level& level) {
    oracle::Random random(8);
    const float half = 3 * level.cell;
    std::vector<Box3> result;
    for (const Vec3& p : places_near(*level.scene, 0, asked, random)) {
        const Vec3 normal = level.field.sample(p).normal;
        // By as much as turns y to the normal; straight down has no such turn, but any that turns over will do.
        const float turn = 1 + normal.y;
        const Rotation<3> rotation =
            turn > 1e-3f ? glm::normalize(Rotation<3>(turn, normal.z, 0, -normal.x)) : Rotation<3>(0, 1, 0, 0);
        const float height = half + random.uniform_float(-0.5, 0.5) * level.cell;
        result.push_back({p + normal * height, Vec3(half), rotation});
    }
    return result;
}

/// ask(shape, field or mesh), one value each.
template <class Shape, class Ask>
Job beside_both(const std::shared_ptr<const Level>& level, const std::vector<Shape>& shapes, Ask ask) {
    // What the two are is not the same: a mesh is a surface, and a field is solid and rounds off what is finer than it.
    Job job{.items = asked, .values = asked, .tolerance = std::numeric_limits<double>::infinity(), .sides = {}};
    job.sides.push_back({"abut", [=](std::span<double> values) {
                             for (std::size_t i = 0; i < asked; ++i) values[i] = ask(shapes[i], level->field);
                         }});
    job.sides.push_back({"abut mesh", [=](std::span<double> values) {
                             for (std::size_t i = 0; i < asked; ++i) values[i] = ask(shapes[i], level->mesh);
                         }});
    return job;
}

constexpr auto gap = [](const auto& shape, const auto& ground) {
    return static_cast<double>(closest(shape, ground).distance);
};
constexpr auto touches = [](const auto& shape, const auto& ground) { return overlaps(shape, ground) ? 1.0 : 0.0; };
constexpr auto depth = [](const auto& shape, const auto& ground) {
    return static_cast<double>(contact(shape, ground).depth);
};

template <class Ask>
std::function<Job()> of_balls(Ask ask) {
    return [ask] {
        const auto level = std::make_shared<const Level>();
        return beside_both(level, balls(*level), ask);
    };
}

template <class Ask>
std::function<Job()> of_boxes(Ask ask) {
    return [ask] {
        const auto level = std::make_shared<const Level>();
        return beside_both(level, resting_boxes(*level), ask);
    };
}

}  // namespace

std::vector<Bench> field_shape_benches() {
    return {{"field/ball/overlaps", of_balls(touches)}, {"field/ball/closest", of_balls(gap)},
            {"field/ball/contact", of_balls(depth)},    {"field/box/overlaps", of_boxes(touches)},
            {"field/box/closest", of_boxes(gap)},       {"field/box/contact", of_boxes(depth)}};
}

}  // namespace abut::bench
