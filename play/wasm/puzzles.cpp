// Arrangements of convex pieces.

#include "puzzles.h"

#include "../../test/oracle/random.hpp"
#include "json.hpp"

#include <algorithm>

using namespace abut::detail;
using abut::oracle::Random;
using abut::play::Json;

namespace {

using Ring = std::vector<DVec<2>>;

double area_of(const Ring& ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) twice += cross(ring[i], ring[(i + 1) % ring.size()]);
    return 0.5 * twice;
}
DVec<2> middle_of(const Ring& ring) {
    DVec<2> sum(0.0);
    for (const DVec<2>& corner : ring) sum += corner;
    return sum / static_cast<double>(ring.size());
}

/// Cuts a convex ring by a line through its middle; a fifth of all lines is upright or level.
std::array<Ring, 2> cut(const Ring& ring, Random& random) {
    const DVec<2> normal = random.chance(0.2) ? axis<2>(static_cast<int>(random.below(2))) : random.direction<2>();
    const DVec<2> middle = middle_of(ring);
    std::array<Ring, 2> parts;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const DVec<2>&a = ring[i], &b = ring[(i + 1) % ring.size()];
        const double at_a = dot(normal, a - middle), at_b = dot(normal, b - middle);
        parts[at_a < 0 ? 0 : 1].push_back(a);
        if ((at_a < 0) == (at_b < 0)) continue;
        const DVec<2> crossing = a + (b - a) * (at_a / (at_a - at_b));
        for (Ring& part : parts) part.push_back(crossing);
    }
    return parts;
}

void write(Json& json, std::span<const abut::Vec2> points, const abut::Pose2& pose) {
    json.begin('{').key("points").vecs<2>(points).key("position").vec<2>(pose.position);
    json.key("rotation").vec<2>({pose.rotation.cos, pose.rotation.sin}).end('}');
}

}  // namespace

abut_code abut_play_cut_square(uint32_t seed, uint32_t count, abut_buffer* out) {
    return entry({present(out, "out")}, [&] {
        Random random(seed);
        std::vector<Ring> pieces{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
        while (pieces.size() < count) {
            const auto largest = std::max_element(pieces.begin(), pieces.end(),
                                                  [](const Ring& a, const Ring& b) { return area_of(a) < area_of(b); });
            auto parts = cut(*largest, random);
            *largest = std::move(parts[0]);
            pieces.push_back(std::move(parts[1]));
        }
        Json json;
        json.begin('[');
        for (const Ring& piece : pieces) {
            const abut::Vec2 middle = to_float(middle_of(piece));
            std::vector<abut::Vec2> own;
            for (const DVec<2>& corner : piece) own.push_back(to_float(corner - DVec<2>(middle)));
            write(json, own, {middle});
        }
        json.end(']').write(*out);
    });
}

abut_code abut_play_thrown_sticks(uint32_t seed, uint32_t count, abut_buffer* out) {
    return entry({present(out, "out")}, [&] {
        constexpr int attempts = 20000;
        Random random(seed);
        std::vector<abut::Box2> sticks;
        for (int attempt = 0; attempt < attempts && sticks.size() < count; ++attempt) {
            const abut::Vec2 half(random.uniform_float(0.25, 0.5), 0.035f);
            const abut::Box2 stick{to_float(random.in_cube<2>()), half, random.rotation<2>()};
            const auto is_clear = [&](const abut::Box2& other) { return !abut::overlaps(stick, other); };
            if (std::all_of(sticks.begin(), sticks.end(), is_clear)) sticks.push_back(stick);
        }
        Json json;
        json.begin('[');
        for (const abut::Box2& stick : sticks) {
            const abut::Vec2& half = stick.half;
            const abut::Vec2 corners[] = {-half, {half.x, -half.y}, half, {-half.x, half.y}};
            write(json, corners, {stick.center, stick.rotation});
        }
        json.end(']').write(*out);
    });
}
