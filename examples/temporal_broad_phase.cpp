// Which of ten thousand snails are close to each other? A temporal broad phase skips pairs that can't have come close
// since the last test.
#include <abut/broad_phase/temporal.hpp>

#include <cstdio>
#include <vector>

int main() {
    constexpr int count = 10000;
    std::vector<abut::Aabb2> boxes;
    std::vector<abut::Vec2> velocities;
    std::vector<float> top_speeds;
    for (int i = 0; i < count; ++i) {
        const abut::Vec2 place{static_cast<float>(i % 100), static_cast<float>(i / 100)};
        boxes.push_back({place - 0.25f, place + 0.25f});
        velocities.push_back(
            {static_cast<float>(i * 37 % 21 - 10) / 1000, static_cast<float>(i * 61 % 21 - 10) / 1000});
        top_speeds.push_back(0.011f);  // per second, along each axis; above the maximum speed by more than rounding
    }

    abut::Temporal<2> snails;
    snails.build(boxes, top_speeds);
    constexpr float frame = 1.0f / 64;
    int pairs = 0;
    for (int i = 0; i < 64 * 60; ++i) {
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            boxes[k].min += velocities[k] * frame;
            boxes[k].max += velocities[k] * frame;
        }
        snails.update(boxes, frame);
        pairs = 0;
        snails.each_pair([&](std::uint32_t, std::uint32_t) { ++pairs; });
    }

    const abut::TemporalCounts& counts = snails.counts();
    std::printf("%d pairs after a minute\n", pairs);
    std::printf("searched for the neighbours of a snail %.0f times, instead of %.0f\n",
                static_cast<double>(counts.searches), static_cast<double>(counts.plain_searches));
    std::printf("tested a pair %.0f times, instead of %.0f\n", static_cast<double>(counts.looks),
                static_cast<double>(counts.plain_looks));

    abut::Bvh<2> plain;
    plain.build(boxes);
    int expected = 0;
    plain.each_pair([&](std::uint32_t, std::uint32_t) { ++expected; });
    return pairs == expected && pairs > 0 && counts.searches * 100 < counts.plain_searches ? 0 : 1;
}
