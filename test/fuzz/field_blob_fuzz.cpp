// Loads any bytes as a field: the load refuses them, or the field can be saved again and has a finite answer to every
// query with finite points and shapes, near and far.

#include "../oracle/finite_answers.hpp"
#include "../oracle/random.hpp"
#include "bytes.hpp"
#include "with_checksum.hpp"
#include <abut/field/check.hpp>
#include <abut/field/file.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace {

using namespace abut;
using namespace abut::detail;
using fuzz::require;

/// A point in and around a box, sometimes anywhere in the range of floats.
template <int D>
Vec<D> place_near(const Aabb<D>& box, oracle::Random& random) {
    const double beyond = random.chance(0.5)   ? 0
                          : random.chance(0.7) ? static_cast<double>(box.max[0]) - static_cast<double>(box.min[0])
                                               : random.power_of_two(-149, 100);
    Vec<D> result;
    for (int a = 0; a < D; ++a)
        result[a] = random.chance(0.1) ? box.min[a]
                                       : random.uniform_float(static_cast<double>(box.min[a]) - beyond,
                                                              static_cast<double>(box.max[a]) + beyond);
    return result;
}

/// Balls, boxes and rods of about the size of a cell, of the volume, or of any size.
template <int D>
void question(const Field<D>& field, std::uint64_t seed) {
    oracle::Random random(seed);
    const Aabb<D> volume = field.volume();
    for (int i = 0; i < 4; ++i) {
        const Vec<D> from = place_near(volume, random), to = place_near(volume, random);
        const FieldSample<D> here = field.sample(from);
        require(std::isfinite(here.distance) && oracle::is_direction<D>(here.normal));
        require(is_finite<D>(field.closest(from)));
        const float light = field.shadow(from, to, random.uniform_float(0, 1));
        require(light >= 0 && light <= 1);
        const float open = field.ambient_occlusion(from, here.normal, field.cell() * random.uniform_float(0, 9));
        require(open >= 0 && open <= 1);
        require(oracle::non_finite_shape_query(field, from, to) == nullptr);

        const double unit = random.chance(0.5)   ? static_cast<double>(field.cell())
                            : random.chance(0.7) ? static_cast<double>(volume.max[0] - volume.min[0])
                                                 : random.power_of_two(-149, 100);
        const auto length = [&] { return random.uniform_float(0, 2) * static_cast<float>(unit); };
        const Vec<D> place = place_near(volume, random), motion = to - place;
        if (!is_finite<D>(motion)) continue;
        Vec<D> half;
        for (int a = 0; a < D; ++a) half[a] = length();
        // Only some with a shape: a search of a field takes a thousand times as long as a look-up.
        const std::uint32_t kind = random.below(16);
        if (kind == 0) require(oracle::non_finite_pair_query(Ball<D>{place, length()}, field, motion) == nullptr);
        if (kind == 1)
            require(oracle::non_finite_pair_query(field, Box<D>{place, half, random.rotation<D>()}, motion) == nullptr);
        if (kind == 2)
            require(oracle::non_finite_pair_query(Capsule<D>{place, from, length()}, field, motion) == nullptr);
    }
}

template <int D>
void check(std::span<const std::byte> bytes) {
    const Result<Field<D>> field = load_field<D>(bytes);
    if (!field) {
        require(!field.problem().message.empty());
        return;
    }
    require(!fault_of(field->data()));
    const std::vector<std::byte> again = save(*field);
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
    const Aabb<D> volume = field->volume();
    for (unsigned i = 0; i < 27; ++i) {
        Vec<D> point;
        unsigned rest = i;
        for (int a = 0; a < D; ++a, rest /= 3)
            point[a] = rest % 3 == 0   ? volume.min[a]
                       : rest % 3 == 1 ? volume.max[a]
                                       : 0.3f * volume.min[a] + 0.7f * volume.max[a] + field->cell();
        float distance = 0;
        field->distance(std::span(&point, 1), std::span(&distance, 1));
        const float one = field->distance(point);
        require(std::memcmp(&distance, &one, sizeof(one)) == 0);
    }
    std::uint64_t seed = 0;
    for (const std::byte b : bytes) seed = (seed ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    question(*field, seed);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    abut::fuzz::check_with_checksum(data, size, [](std::span<const std::byte> bytes) {
        check<2>(bytes);
        check<3>(bytes);
    });
    return 0;
}
