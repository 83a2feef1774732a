// A field baked of a closed mesh, with all that is within three cells of the surface: beside OpenVDB, on two threads,
// and again where the mesh has changed. And inside or outside at the samples of a small one, beside CGAL.

#include "bench.hpp"
#include "cgal_field.hpp"
#include "field_scene.hpp"
#include "openvdb_field.hpp"
#include "tbb_executor.hpp"
#include <abut/bake/field_lines.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {
namespace {

constexpr std::size_t places = 20'000;

/// Bakes each time, and looks up afterwards what has come of it, which takes next to no time.
struct Baked {
    SharedFieldScene scene = field_scene();
    std::vector<Vec3> at;
    float cell = 0;

    explicit Baked(std::uint32_t cells) : cell(scene->cell(cells)) {
        oracle::Random random(2);
        at = samples_at(*scene, cells, places_near(*scene, cell, places, random));
    }
    void tell(const Field3& field, std::span<double> values) const {
        for (std::size_t i = 0; i < at.size(); ++i)
            values[i] = near_in_cells(static_cast<double>(field.distance(at[i])), cell);
    }
    void tell(const OpenvdbField& field, std::span<double> values) const {
        field.distance(at, values);
        for (double& value : values) value = near_in_cells(value, cell);
    }
};

/// Time of all of it, not of a sample: fields of all sizes are of the same mesh.
Job bake(std::uint32_t cells) {
    const auto baked = std::make_shared<const Baked>(cells);
    Job job{.items = 1, .values = places, .tolerance = 0.1, .sides = {}};
    job.sides.push_back({"abut", [baked, cells](std::span<double> values) {
                             const FieldScene& scene = *baked->scene;
                             baked->tell(*bake_field(scene.points, scene.triangles, scene.options(cells)), values);
                         }});
    // Where triangles are smaller than its cells, OpenVDB takes in for out at one sample of sixteen there, and what it
    // tidies moves some more. CGAL and abut say the same of all of them: field/sample/near counts.
    for (const OpenvdbDistances distances : {OpenvdbDistances::tidied, OpenvdbDistances::measured})
        job.sides.push_back(
            {.who = distances == OpenvdbDistances::tidied ? "openvdb" : "openvdb measured",
             .ask =
                 [baked, distances](std::span<double> values) {
                     const FieldScene& scene = *baked->scene;
                     baked->tell(OpenvdbField(scene.points, scene.triangles, scene.corner, baked->cell, 3, distances),
                                 values);
                 },
             .strays = 0.12});
    return job;
}

Job threads(std::uint32_t cells) {
    const auto baked = std::make_shared<const Baked>(cells);
    Job job{.items = 1, .values = places, .on_the_wall = true, .tolerance = 0, .sides = {}};
    for (const std::uint32_t count : {2u, 1u}) {
        const auto executor = std::make_shared<TbbExecutor>(count);
        job.sides.push_back({count == 2 ? "abut" : "abut alone", [baked, cells, executor](std::span<double> values) {
                                 const FieldScene& scene = *baked->scene;
                                 FieldOptions<3> options = scene.options(cells);
                                 options.executor = executor.get();
                                 baked->tell(*bake_field(scene.points, scene.triangles, options), values);
                             }});
    }
    return job;
}

/// A dent in one place, of a hundredth of the surface or so.
Job bake_again(std::uint32_t cells) {
    struct Dented {
        Baked baked;
        Field3 before;
        std::vector<Vec3> points;
        Aabb3 changed = Aabb3::empty();
    };
    const Baked whole(cells);
    const FieldScene& scene = *whole.scene;
    const auto dented = std::make_shared<Dented>(
        Dented{whole, *bake_field(scene.points, scene.triangles, scene.options(cells)), scene.points, Aabb3::empty()});
    const Vec3 center = scene.points[scene.points.size() / 3];
    const float reach = 0.2f;
    const auto moves = [&](const Vec3& p) {
        const Vec3 away = p - center;
        return away.x * away.x + away.y * away.y + away.z * away.z < reach * reach;
    };
    for (Vec3& p : dented->points)
        if (moves(p)) p *= 0.97f;
    for (const glm::uvec3& t : scene.triangles) {
        if (!moves(scene.points[t.x]) && !moves(scene.points[t.y]) && !moves(scene.points[t.z])) continue;
        for (const std::uint32_t corner : {t.x, t.y, t.z})
            for (const Vec3& p : {scene.points[corner], dented->points[corner]})
                dented->changed = merged(dented->changed, Aabb3{p, p});
    }
    oracle::Random random(3);
    for (std::size_t i = 0; i < places / 2; ++i) dented->baked.at[i] = center + to_float(random.in_cube<3>()) * reach;

    Job job{.items = 1, .values = places, .tolerance = 0, .sides = {}};
    job.sides.push_back(
        {"abut", [dented](std::span<double> values) {
             const Baked& baked = dented->baked;
             FieldOptions<3> options;
             options.cell = baked.cell;
             baked.tell(*rebake_field(dented->before, dented->changed, dented->points, baked.scene->triangles, options),
                        values);
         }});
    job.sides.push_back({"abut all of it", [dented, cells](std::span<double> values) {
                             const std::vector<glm::uvec3>& triangles = dented->baked.scene->triangles;
                             dented->baked.tell(
                                 *bake_field(dented->points, triangles, dented->baked.scene->options(cells)), values);
                         }});
    return job;
}

/// Inside or outside at the samples of a lattice. abut's own count along its lines; its baker besides measures all
/// distances.
Job signs(std::uint32_t side) {
    struct Asked {
        SharedFieldScene scene = field_scene();
        std::vector<Vec3> at;
        CgalSolid cgal{scene->points, scene->triangles};
    };
    const auto asked = std::make_shared<Asked>();
    const SampleLattice<3> lattice{DVec<3>(asked->scene->corner), static_cast<double>(asked->scene->cell(side - 1))};
    const glm::uvec3 samples(side);
    const std::size_t count = std::size_t{side} * side * side;
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) asked->at.push_back(to_float(lattice.at({x, y, z})));

    Job job{.items = count, .values = count, .tolerance = 0, .sides = {}};
    job.sides.push_back({"abut", [=](std::span<double> values) {
                             const SampleLines lines(asked->scene->points, lattice, samples);
                             const std::span<const glm::uvec3> surface = asked->scene->triangles;
                             const LineCounts counts(lines, std::span(&surface, 1));
                             std::vector<std::int32_t> winding(side);
                             for (std::uint32_t z = 0; z < side; ++z)
                                 for (std::uint32_t y = 0; y < side; ++y) {
                                     counts.tell({0, y, z}, side, 1, winding.data());
                                     double* row = values.data() + (std::size_t{z} * side + y) * side;
                                     for (std::uint32_t x = 0; x < side; ++x) row[x] = winding[x] != 0 ? 1 : 0;
                                 }
                         }});
    job.sides.push_back({"abut and distances", [=](std::span<double> values) {
                             FieldOptions<3> options = asked->scene->options(side - 1);
                             options.store = FieldStore::dense;
                             const Field3 field = *bake_field(asked->scene->points, asked->scene->triangles, options);
                             std::ranges::transform(field.data().distance, values.begin(),
                                                    [](float distance) { return distance < 0 ? 1.0 : 0.0; });
                         }});
    job.sides.push_back({"cgal", [=](std::span<double> values) { asked->cgal.inside(asked->at, values); }});
    return job;
}

}  // namespace

std::vector<Bench> field_bake_benches() {
    std::vector<Bench> result;
    for (const std::uint32_t cells : {64u, 128u, 256u})
        result.push_back({"field/bake/" + std::to_string(cells), [cells] { return bake(cells); }});
    result.push_back({"field/bake/threads/256", [] { return threads(256); }});
    result.push_back({"field/bake/again/256", [] { return bake_again(256); }});
    result.push_back({"field/sign/39304", [] { return signs(34); }});
    return result;
}

}  // namespace abut::bench
