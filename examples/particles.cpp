// A million particles fall on a level, bounce and come to rest. A signed distance field returns each particle's
// distance to the ground.
#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field.hpp>
#include <abut/field/field.hpp>
#include <abut/math/thread_pool.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

namespace {

struct Particles {
    std::vector<abut::Vec3> position, velocity;
};

constexpr float radius = 0.02f, step = 1.0f / 60, bounce = 0.4f, friction = 0.95f;

/// Moves a range of particles by a step. Returns how many touched the ground.
std::uint32_t advance(const abut::Field3& ground, std::span<abut::Vec3> position, std::span<abut::Vec3> velocity) {
    constexpr std::size_t at_once = 512;
    abut::FieldSample<3> samples[at_once];
    const float bottom = ground.volume().min.y;
    std::uint32_t touching = 0;
    for (std::size_t begin = 0; begin < position.size(); begin += at_once) {
        const std::size_t count = std::min(at_once, position.size() - begin);
        const auto x = position.subspan(begin, count), v = velocity.subspan(begin, count);
        for (std::size_t i = 0; i < count; ++i) {
            v[i].y -= 9.81f * step;
            x[i] += v[i] * step;
            if (x[i].y < bottom) {  // fell over the edge: restarts from above
                x[i] = {0.5f * x[i].x, 2, 0.5f * x[i].z};
                v[i] = {};
            }
        }
        ground.sample(x, std::span(samples, count));
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [distance, normal] = samples[i];
            if (distance >= radius) continue;
            ++touching;
            x[i] += normal * (radius - distance);
            const float into = v[i].x * normal.x + v[i].y * normal.y + v[i].z * normal.z;
            if (into < 0) v[i] = (v[i] - normal * into) * friction - normal * (bounce * into);
        }
    }
    return touching;
}

}  // namespace

int main() {
    // A bowl: a slab minus a ball, with a knob in the middle.
    const abut::FieldOptions<3> options{.cell = 0.1f, .store = abut::FieldStore::dense};
    const auto slab = abut::bake_field(abut::Box3{{0, -0.6f, 0}, {3, 0.6f, 3}}, options);
    const auto hole = abut::bake_field(abut::Sphere{{0, 1.5f, 0}, 2.2f}, options);
    const auto knob = abut::bake_field(abut::Sphere{{0, -0.6f, 0}, 0.5f}, options);
    if (!slab || !hole || !knob) return 1;
    const auto bowl = abut::field_difference(*slab, *hole, options);
    if (!bowl) return 1;
    const auto level = abut::field_smooth_union(*bowl, *knob, 0.2f, options);
    if (!level) return 1;

    Particles all;
    constexpr std::uint32_t side = 100, count = side * side * side;
    for (std::uint32_t i = 0; i < count; ++i) {
        const abut::Vec3 place(i % side, i / side % side, i / side / side);
        all.position.push_back(place * 0.03f + abut::Vec3(-1.5f, 0.3f, -1.5f));
        all.velocity.push_back({0.3f * (static_cast<float>(i % 7) - 3), 0, 0.3f * (static_cast<float>(i % 11) - 5)});
    }

    abut::ThreadPool threads(2);
    constexpr std::uint32_t parts = 32;
    std::uint32_t touching[parts] = {}, most = 0;
    for (int frame = 0; frame < 120; ++frame) {
        threads.run(parts, [&](std::uint32_t part) {
            const std::size_t first = std::size_t{count} * part / parts, last = std::size_t{count} * (part + 1) / parts;
            touching[part] = advance(*level, std::span(all.position).subspan(first, last - first),
                                     std::span(all.velocity).subspan(first, last - first));
        });
        std::uint32_t sum = 0;
        for (const std::uint32_t some : touching) sum += some;
        most = std::max(most, sum);
        if (frame % 30 == 29) std::printf("frame %3d: %u of %u touch the level\n", frame + 1, sum, count);
    }

    std::uint32_t within = 0;
    for (const abut::Vec3& place : all.position) within += level->distance(place) < -0.01f;
    std::printf("%u are within it\n", within);
    return most > count / 4 && within == 0 ? 0 : 1;
}
