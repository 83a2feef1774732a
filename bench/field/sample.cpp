// Single samples of a field of 256^3 cells: all in the cache, near the surface, and anywhere. Figures: error and
// memory.

#include "../bench.hpp"
#include "cgal_field.hpp"
#include "openvdb_field.hpp"
#include "scene.hpp"
#include <abut/query/closest.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::uint32_t cells = 256;

/// Writes distances.
using LookUp = std::function<void(std::span<const Vec3> at, std::span<double> out)>;

/// The sample points, and the errors of the answers.
struct Places {
    SharedFieldScene scene = field_scene();
    float cell = scene->cell(cells);
    std::vector<Vec3> at;

    // Only near the surface:
    std::vector<double> exact;          ///< signed
    std::vector<Vec3> samples;          ///< lattice samples near them
    std::vector<double> exact_samples;  ///< exact distances at these

    std::vector<double> distances(std::span<const Vec3> points) const {
        std::vector<double> result(points.size()), inside(points.size());
        const Mesh mesh = *Mesh::build(scene->points, scene->triangles);
        CgalSolid(scene->points, scene->triangles).inside(points, inside);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto gap = static_cast<double>(closest(Sphere{points[i], 0}, mesh).distance);
            result[i] = inside[i] > 0 ? -gap : gap;
        }
        return result;
    }

    /// In cells, except for bytes; signs are compared at samples 0.1 cells or more from the surface.
    std::vector<Figure> figures(const LookUp& look_up, std::size_t bytes) const {
        std::vector<Figure> result{{"megabytes", static_cast<double>(bytes) * 1e-6}};
        if (exact.empty()) return result;
        std::vector<double> found(at.size());
        look_up(at, found);
        double squares = 0, max_error = 0, wrong = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double error = std::abs(found[i] - exact[i]) / static_cast<double>(cell);
            squares += error * error;
            max_error = std::max(max_error, error);
        }
        look_up(samples, found);
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (std::abs(exact_samples[i]) > 0.1 * static_cast<double>(cell) &&
                (found[i] < 0) != (exact_samples[i] < 0))
                ++wrong;
        result.push_back({"rms error", std::sqrt(squares / static_cast<double>(at.size()))});
        result.push_back({"max error", max_error});
        result.push_back({"wrong signs", wrong});
        return result;
    }
};
using SharedPlaces = std::shared_ptr<const Places>;

Side side(const char* who, const SharedPlaces& places, std::size_t bytes, const LookUp& look_up) {
    return {.who = who,
            .run =
                [places, look_up](std::span<double> values) {
                    look_up(places->at, values);
                    for (double& value : values) value = near_in_cells(value, places->cell);
                },
            .figures = [places, look_up, bytes] { return places->figures(look_up, bytes); }};
}

Side one_by_one(const char* who, const SharedPlaces& places, const Field3& field) {
    return side(who, places, field.bytes(), [field](std::span<const Vec3> at, std::span<double> out) {
        for (std::size_t i = 0; i < at.size(); ++i) out[i] = static_cast<double>(field.distance(at[i]));
    });
}

Side all_at_once(const char* who, const SharedPlaces& places, const Field3& field) {
    const auto values = std::make_shared<std::vector<float>>(places->at.size());
    return side(who, places, field.bytes(), [field, values](std::span<const Vec3> at, std::span<double> out) {
        field.distance(at, std::span(*values).first(at.size()));
        std::copy_n(values->begin(), at.size(), out.begin());
    });
}

Side openvdb(const char* who, const SharedPlaces& places, OpenvdbDistances distances) {
    const FieldScene& scene = *places->scene;
    const OpenvdbField field(scene.points, scene.triangles, scene.corner, places->cell, 3, distances);
    Side result = side(who, places, field.bytes(),
                       [field](std::span<const Vec3> at, std::span<double> out) { field.distance(at, out); });
    result.strays = 0.02;  // its signs are wrong there
    return result;
}

/// Tolerance in cells: some round off edges more than others.
constexpr double tolerance = 0.4;

Job look_up(const SharedPlaces& places) {
    const FieldScene& scene = *places->scene;
    const auto bake = [&](FieldStore store, FieldLookup lookup) {
        FieldOptions<3> options = scene.options(cells);
        options.store = store;
        options.lookup = lookup;
        return *bake_field(scene.points, scene.triangles, options);
    };
    const Field3 sparse = bake(FieldStore::sparse, FieldLookup::linear),
                 dense = bake(FieldStore::dense, FieldLookup::linear),
                 gradient = bake(FieldStore::sparse, FieldLookup::gradient);
    FieldOptions<3> fine = scene.options(2 * cells);
    fine.quantised = true;
    const Field3 half = *bake_field(scene.points, scene.triangles, fine);

    Job job{.items = places->at.size(), .values = places->at.size(), .tolerance = tolerance, .sides = {}};
    job.sides = {one_by_one("abut", places, sparse),
                 all_at_once("abut many", places, sparse),
                 one_by_one("abut dense", places, dense),
                 all_at_once("abut dense many", places, dense),
                 one_by_one("abut gradient", places, gradient),
                 all_at_once("abut gradient many", places, gradient),
                 one_by_one("abut half cell 16 bit", places, half),
                 openvdb("openvdb", places, OpenvdbDistances::cleaned),
                 openvdb("openvdb measured", places, OpenvdbDistances::measured)};
    return job;
}

/// In a box of 16 cells around a surface point.
Job cached() {
    const auto places = std::make_shared<Places>();
    oracle::Random random(4);
    const Vec3 center = places->scene->points.front();
    for (std::size_t i = 0; i < 4096; ++i)
        places->at.push_back(center + to_float(random.in_cube<3>()) * (8 * places->cell));
    return look_up(places);
}

/// Within a cell of the surface.
Job near() {
    const auto places = std::make_shared<Places>();
    oracle::Random random(5);
    places->at = places_near(*places->scene, places->cell, 40'000, random);
    places->exact = places->distances(places->at);
    places->samples = samples_at(*places->scene, cells, places->at);
    places->exact_samples = places->distances(places->samples);
    return look_up(places);
}

/// In the entire cube.
Job random_places() {
    const auto places = std::make_shared<Places>();
    oracle::Random random(6);
    const float half = 0.5f * places->scene->side;
    for (std::size_t i = 0; i < 262'144; ++i)
        places->at.push_back(places->scene->corner + (to_float(random.in_cube<3>()) + Vec3(1)) * half);
    return look_up(places);
}

}  // namespace

std::vector<Bench> field_sample_benches() {
    return {{"field/sample/cached", cached}, {"field/sample/near", near}, {"field/sample/random", random_places}};
}

}  // namespace abut::bench
