// Balls and boxes against a field of 128^3 cells and against its mesh; and boxes and cylinders in any pose against a
// crate's field of 12 x 8 x 12 cells.

#include "../bench.hpp"
#include "scene.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <vector>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::uint32_t cells = 128;
constexpr std::size_t shape_count = 4096;

struct Level {
    SharedFieldScene scene = field_scene();
    Field3 field = *bake_field(scene->points, scene->triangles, scene->options(cells));
    Mesh mesh = *Mesh::build(scene->points, scene->triangles);
    float cell = field.cell();
};

/// Balls with a radius of three cells; their centers are outside, up to twice that from the surface.
std::vector<Sphere> balls(const Level& level) {
    oracle::Random random(7);
    const float radius = 3 * level.cell;
    std::vector<Sphere> result;
    for (const Vec3& p : places_near(*level.scene, 2 * radius, 8 * shape_count, random))
        if (result.size() < shape_count && level.field.distance(p) > level.cell) result.push_back({p, radius});
    return result;
}

/// Boxes of six cells, aligned to the surface below, up to half a cell above or below it.
std::vector<Box3> resting_boxes(const Level& level) {
    oracle::Random random(8);
    const float half = 3 * level.cell;
    std::vector<Box3> result;
    for (const Vec3& p : places_near(*level.scene, 0, shape_count, random)) {
        const Vec3 normal = level.field.sample(p).normal;
        // The rotation that takes y to the normal. For the opposite direction it is not unique, and any half turn will
        // do.
        const float turn = 1 + normal.y;
        const Rotation<3> rotation =
            turn > 1e-3f ? glm::normalize(Rotation<3>(turn, normal.z, 0, -normal.x)) : Rotation<3>(0, 1, 0, 0);
        const float height = half + random.uniform_float(-0.5, 0.5) * level.cell;
        result.push_back({p + normal * height, Vec3(half), rotation});
    }
    return result;
}

/// Calls run(shape, field or mesh), one value each.
template <class Shape, class Run>
Job beside_both(const std::shared_ptr<const Level>& level, const std::vector<Shape>& shapes, Run run) {
    // The two differ: a mesh is a surface, and a field is solid and smooths details finer than its cells.
    Job job{
        .items = shape_count, .values = shape_count, .tolerance = std::numeric_limits<double>::infinity(), .sides = {}};
    job.sides.push_back({"abut", [=](std::span<double> values) {
                             for (std::size_t i = 0; i < shape_count; ++i) values[i] = run(shapes[i], level->field);
                         }});
    job.sides.push_back({"abut mesh", [=](std::span<double> values) {
                             for (std::size_t i = 0; i < shape_count; ++i) values[i] = run(shapes[i], level->mesh);
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

template <class Run>
std::function<Job()> of_balls(Run run) {
    return [run] {
        const auto level = std::make_shared<const Level>();
        return beside_both(level, balls(*level), run);
    };
}

template <class Run>
std::function<Job()> of_boxes(Run run) {
    return [run] {
        const auto level = std::make_shared<const Level>();
        return beside_both(level, resting_boxes(*level), run);
    };
}

constexpr Box3 crate_box{{0, 0, 0}, {0.5f, 0.3f, 0.4f}};

/// A crate, and poses around and in it, with motions between them.
struct PoseMotions {
    static constexpr std::size_t count = 100;

    /// At any rotation, or unrotated boxes of `crate_box` at this distance from the crate's top.
    explicit PoseMotions(float distance = -1) {
        oracle::Random random(5);
        const Aabb3 box = bounds(field);
        const Vec3 middle = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
        for (std::size_t i = 0; i < count; ++i) {
            Pose3 pose;
            pose.rotation = random.rotation<3>();
            pose.position = middle + to_float(random.in_cube<3>()) * (half + 1.5f);
            if (distance >= 0) {
                pose.rotation = Rotation<3>(1, 0, 0, 0);
                pose.position.y = 0.5f + distance + crate_box.half.y;
            }
            poses.push_back(pose);
            motions.push_back((middle + to_float(random.in_cube<3>()) * half - pose.position) * 1.25f);
        }
    }

    Field3 field = *bake_field(Box3{Vec3(0.0f), {1.5f, 0.5f, 1}}, FieldOptions<3>{.cell = 0.5f});
    std::vector<Pose3> poses;
    std::vector<Vec3> motions;
};

constexpr Cylinder crate_cylinder{{-0.4f, 0, 0}, {0.4f, 0, 0}, 0.4f};

bool holds(const Box3&, const Vec3&) {
    return true;
}
bool holds(const Cylinder& cylinder, const Vec3& point) {
    return glm::length(Vec3(0, point.y, point.z)) <= cylinder.radius;
}

/// The minimum of distances sampled on a grid in the shape.
template <class Shape>
double min_sampled(const Shape& shape, const Pose3& pose, const Field3& field) {
    constexpr int last = 12;
    const Aabb3 box = bounds(view(shape));
    double min_distance = std::numeric_limits<double>::infinity();
    for (int x = 0; x <= last; ++x)
        for (int y = 0; y <= last; ++y)
            for (int z = 0; z <= last; ++z) {
                const Vec3 own = box.min + (box.max - box.min) * Vec3(x, y, z) / static_cast<float>(last);
                if (!holds(shape, own)) continue;
                const Sphere place{pose.position + pose.rotation * own, 0};
                min_distance = std::min(min_distance, static_cast<double>(closest(place, field).distance));
            }
    return min_distance;
}

/// Compares run(shape, motions, i) with sampled(shape, motions, i), and measures the slowest call.
template <class Shape, class Run, class Sampled>
std::function<Job()> of_poses(const Shape& shape, double tolerance, Run run, Sampled sampled, float distance = -1) {
    return [=] {
        const auto motions = std::make_shared<const PoseMotions>(distance);
        Job job{.items = PoseMotions::count, .values = PoseMotions::count, .tolerance = tolerance, .sides = {}};
        const auto worst = [=] {
            using Clock = std::chrono::steady_clock;
            double longest = 0;
            for (std::size_t i = 0; i < PoseMotions::count; ++i) {
                double shortest = std::numeric_limits<double>::infinity();
                for (int k = 0; k < 5; ++k) {
                    const auto start = Clock::now();
                    run(shape, *motions, i);
                    shortest =
                        std::min(shortest, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
                }
                longest = std::max(longest, shortest);
            }
            return std::vector<Figure>{{"worst, us", longest}};
        };
        job.sides.push_back({.who = "abut",
                             .run =
                                 [=](std::span<double> values) {
                                     for (std::size_t i = 0; i < PoseMotions::count; ++i)
                                         values[i] = run(shape, *motions, i);
                                 },
                             .figures = worst});
        job.sides.push_back({"samples", [=](std::span<double> values) {
                                 for (std::size_t i = 0; i < PoseMotions::count; ++i)
                                     values[i] = sampled(shape, *motions, i);
                             }});
        return job;
    };
}

constexpr auto pose_gap = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    return static_cast<double>(closest(at(shape, motions.poses[i]), motions.field).distance);
};
constexpr auto sampled_gap = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    return min_sampled(shape, motions.poses[i], motions.field);
};
constexpr auto pose_depth = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    return std::max(static_cast<double>(contact(at(shape, motions.poses[i]), motions.field).depth), 0.0);
};
constexpr auto sampled_depth = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    return std::max(-min_sampled(shape, motions.poses[i], motions.field), 0.0);
};
constexpr auto pose_fraction = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    const auto hit = sweep(at(shape, motions.poses[i]), motions.motions[i], motions.field);
    return hit ? static_cast<double>(hit->fraction) : 1.0;
};
/// Compares motions, unless samples touch earlier.
constexpr auto sampled_fraction = [](const auto& shape, const PoseMotions& motions, std::size_t i) {
    const double reported = pose_fraction(shape, motions, i);
    if (min_sampled(shape, motions.poses[i], motions.field) < 0) return reported;
    for (double time = 0; time < reported; time += 0.02) {
        Pose3 pose = motions.poses[i];
        pose.position += motions.motions[i] * static_cast<float>(time);
        if (min_sampled(shape, pose, motions.field) < -1e-3) return time;
    }
    return reported;
};

}  // namespace

std::vector<Bench> field_shape_benches() {
    return {{"field/ball/overlaps", of_balls(touches)},
            {"field/ball/closest", of_balls(gap)},
            {"field/ball/contact", of_balls(depth)},
            {"field/box/overlaps", of_boxes(touches)},
            {"field/box/closest", of_boxes(gap)},
            {"field/box/contact", of_boxes(depth)},
            {"field/shape/closest/box", of_poses(crate_box, 0.08, pose_gap, sampled_gap)},
            {"field/shape/closest/cylinder", of_poses(crate_cylinder, 0.08, pose_gap, sampled_gap)},
            {"field/shape/closest/aligned", of_poses(crate_box, 0.08, pose_gap, sampled_gap, 1.9f)},
            {"field/shape/contact/box", of_poses(crate_box, 0.08, pose_depth, sampled_depth)},
            {"field/shape/contact/cylinder", of_poses(crate_cylinder, 0.08, pose_depth, sampled_depth)},
            {"field/shape/sweep/box", of_poses(crate_box, 1e-3, pose_fraction, sampled_fraction)},
            {"field/shape/sweep/cylinder", of_poses(crate_cylinder, 1e-3, pose_fraction, sampled_fraction)},
            {"field/shape/sweep/aligned", of_poses(crate_box, 1e-3, pose_fraction, sampled_fraction, 1.9f)}};
}

}  // namespace abut::bench
