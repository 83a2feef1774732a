// Which units are in this rectangle? The player drags it over the map; units that overlap it are selected.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    enum Layer : std::uint32_t { units = 1, trees = 2 };

    abut::World2 map;
    for (int i = 0; i < 100; ++i) {
        const abut::Vec2 place{static_cast<float>(i % 10), static_cast<float>(i / 10)};
        map.add(abut::Circle{place, 0.25f}, {.user = static_cast<std::uint64_t>(i), .layers = units});
        map.add(abut::Circle{place + 0.5f, 0.25f}, {.layers = trees, .fixed = true});
    }

    const abut::Aabb2 dragged{{1.8f, 3.1f}, {4.1f, 4.2f}};
    const auto selected = map.overlapping(dragged, {.mask = units});

    for (const abut::Id id : selected) std::printf("unit %d\n", static_cast<int>(map.user(id)));
    return selected.size() == 6 && map.user(selected[0]) == 32 && map.user(selected[5]) == 44 ? 0 : 1;
}
