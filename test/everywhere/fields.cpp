// Fields: baked from meshes, outlines and shapes, combined, and queried.

#include "../../scenes/outlines.hpp"
#include "../../scenes/solid_meshes.hpp"
#include "sections.hpp"
#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field.hpp>
#include <abut/field/texture.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/box.hpp>

namespace abut::everywhere {
namespace {

template <int D>
void add_sample(Hash& hash, const FieldSample<D>& sample) {
    hash.add(sample.distance);
    hash.add<D>(sample.normal);
}

template <int D>
void add_field(Hash& hash, const Field<D>& field) {
    oracle::Random random(D);
    const Aabb<D> volume = field.volume();
    const auto place = [&] {
        Vec<D> result;
        for (int i = 0; i < D; ++i) {
            const auto low = static_cast<double>(volume.min[i]), high = static_cast<double>(volume.max[i]);
            result[i] = random.uniform_float(low - 0.2, high + 0.2);
        }
        return result;
    };
    std::vector<Vec<D>> points;
    for (int i = 0; i < 300; ++i) points.push_back(place());
    std::vector<float> numbers(points.size());
    std::vector<FieldSample<D>> samples(points.size());
    field.distance(points, numbers);
    field.sample(points, samples);
    for (std::size_t i = 0; i < points.size(); ++i) {
        hash.add(field.distance(points[i]));
        hash.add(numbers[i]);
        add_sample(hash, field.sample(points[i]));
        add_sample(hash, samples[i]);
        hash.add<D>(field.closest(points[i]));
    }
    for (int i = 0; i < 60; ++i) {
        const Vec<D> from = place(), to = place();
        hash.add(field.shadow(from, to, 0.1f));
        hash.add(field.ambient_occlusion(from, samples[0].normal, 0.4f));
        add_hit(hash, raycast(Ray<D>::between(from, to), field));
        if (i % 6 != 0) continue;
        const Box<D> box{from, Vec<D>(0.2f), random.rotation<D>()};
        add_contact(hash, contact(box, field));
        add_hit(hash, sweep(box, to - from, field));
    }
}

}  // namespace

void add_fields(Hash& hash) {
    const scenes::SolidMesh knot = scenes::knotted_tube(24, 6), house = scenes::house();
    const auto dense = bake_field(knot.points, knot.triangles, {.cell = 0.4f, .store = FieldStore::dense});
    const auto sparse = bake_field(house.points, house.triangles,
                                   {.cell = 0.5f, .lookup = FieldLookup::gradient, .closest_points = true});
    const auto quantised = bake_field(house.points, house.triangles, {.cell = 0.6f, .quantised = true});
    const scenes::Outline outline = scenes::plate(2, 8, 3);
    const auto flat = bake_field(outline.ring, outline.holes, {.cell = 0.05f});
    const auto round = bake_field(Sphere{{0, 0, 0}, 1}, {.cell = 0.2f});
    const auto square = bake_field(Box2{{0, 0}, {1, 1}, {0.6f, 0.8f}}, {.cell = 0.1f});
    add_field(hash, *dense);
    add_field(hash, *sparse);
    add_field(hash, *quantised);
    add_field(hash, *flat);
    add_field(hash, *round);
    add_field(hash, *square);
    add_field(hash, *field_smooth_union(*dense, *round, 0.3f, {.cell = 0.4f}));
    add_field(hash, *field_difference(*square, *flat, {.cell = 0.1f}));
    add_field(hash, *field_redistance(*round));
    for (const TextureFormat format : {TextureFormat::r8_snorm, TextureFormat::r16f, TextureFormat::r32f}) {
        const auto texture = to_texture(*round, format);
        const std::size_t texels = std::size_t{texture->width} * texture->height * texture->depth;
        for (std::size_t i = 0; i < texels; ++i) hash.add(texel_distance(*texture, i));
    }
}

}  // namespace abut::everywhere
