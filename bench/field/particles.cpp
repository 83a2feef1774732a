// A million particles above one field: batched look-ups, on one thread and on two, in wall-clock time.

#include "../bench.hpp"
#include "../tbb_executor.hpp"
#include <abut/bake/combine_fields.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

/// A bowl with a knob, as in examples/particles.cpp.
Field3 bowl(FieldStore store) {
    const FieldOptions<3> fine{.cell = 0.1f, .store = store};
    const Field3 slab = *bake_field(Box3{{0, -0.6f, 0}, {3, 0.6f, 3}}, fine);
    const Field3 hole = *bake_field(Sphere{{0, 1.5f, 0}, 2.2f}, fine),
                 knob = *bake_field(Sphere{{0, -0.6f, 0}, 0.5f}, fine);
    const FieldOptions<3> options{.store = store};
    return *field_smooth_union(*field_difference(slab, hole, options), knob, 0.2f, options);
}

constexpr float radius = 0.02f, step = 1.0f / 60;

/// Particles fall, touch the ground and lose speed there.
struct Particles {
    std::vector<Vec3> position, velocity;

    explicit Particles(std::size_t count) : velocity(count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3 place(i % 100, i / 100 % 100, i / 10000);
            position.push_back(place * 0.03f + Vec3(-1.5f, 0.3f, -1.5f));
            velocity[i] = {0.3f * (static_cast<float>(i % 7) - 3), 0, 0.3f * (static_cast<float>(i % 11) - 5)};
        }
    }

    /// Returns the count of particles that touch the ground.
    std::uint32_t advance(const Field3& ground, std::size_t from, std::size_t to) {
        constexpr std::size_t at_once = 512;
        std::array<FieldSample<3>, at_once> samples;
        const float bottom = ground.volume().min.y;
        std::uint32_t result = 0;
        for (std::size_t begin = from; begin < to; begin += at_once) {
            const std::size_t count = std::min(at_once, to - begin);
            const auto x = std::span(position).subspan(begin, count), v = std::span(velocity).subspan(begin, count);
            for (std::size_t i = 0; i < count; ++i) {
                v[i].y -= 9.81f * step;
                x[i] += v[i] * step;
                if (x[i].y < bottom) {
                    x[i] = {0.5f * x[i].x, 2, 0.5f * x[i].z};
                    v[i] = {};
                }
            }
            ground.sample(x, std::span(samples).first(count));
            for (std::size_t i = 0; i < count; ++i) {
                const auto& [distance, normal] = samples[i];
                if (distance >= radius) continue;
                ++result;
                x[i] += normal * (radius - distance);
                const float into = v[i].x * normal.x + v[i].y * normal.y + v[i].z * normal.z;
                if (into < 0) v[i] = (v[i] - normal * (1.4f * into)) * 0.95f;
            }
        }
        return result;
    }
};

/// In flight, most particles touch nothing; at rest, most do.
Job particles(std::size_t count, FieldStore store, int frames_before) {
    struct World {
        Field3 ground;
        Particles before, now;
        std::array<TbbExecutor, 2> threads{TbbExecutor(1), TbbExecutor(2)};
    };
    const auto world = std::make_shared<World>(World{bowl(store), Particles(count), Particles(0)});
    for (int i = 0; i < frames_before; ++i) world->before.advance(world->ground, 0, count);
    world->now = world->before;

    Job job;
    job.items = count;
    job.values = 1;
    job.on_the_wall = true;
    job.tolerance = 0;
    for (const std::uint32_t threads : {2u, 1u})
        job.sides.push_back({.who = threads == 2 ? "abut" : "abut alone",
                             .run =
                                 [world, threads, count](std::span<double> values) {
                                     constexpr std::uint32_t parts = 32;
                                     std::array<std::uint32_t, parts> touching{};
                                     world->threads[threads - 1].run(parts, [&](std::uint32_t part) {
                                         touching[part] = world->now.advance(world->ground, count * part / parts,
                                                                             count * (part + 1) / parts);
                                     });
                                     values[0] = 0;
                                     for (const std::uint32_t some : touching) values[0] += some;
                                 },
                             .prepare = [world] { world->now = world->before; }});
    return job;
}

}  // namespace

std::vector<Bench> field_particle_benches() {
    std::vector<Bench> result;
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse})
        for (const int frames : {20, 120}) {
            const std::string name = std::string("field/particles/") + (frames == 20 ? "in flight/" : "at rest/") +
                                     (store == FieldStore::dense ? "dense/" : "sparse/") + "1000000";
            result.push_back({name, [=] { return particles(1'000'000, store, frames); }});
        }
    return result;
}

}  // namespace abut::bench
