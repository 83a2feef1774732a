// CGAL's box_self_intersection_d: Zomorodian and Edelsbrunner, "Fast software for box intersection" (2000), a streamed
// segment tree that is never stored. It finds all pairs of a set and has no state between frames.

#include "broad_peers.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <CGAL/box_intersection_d.h>

namespace abut::bench {

namespace {

/// Sets up to this size are swept along one axis. The best of several tried: CGAL's default 10 takes twice as long.
std::ptrdiff_t cutoff(std::size_t count) {
    return count <= 10'000 ? 300 : 1500;
}

template <int D>
struct NumberedBox {
    using NT = float;
    using ID = std::uint32_t;
    static int dimension() { return D; }
    float min_coord(int axis) const { return box.min[axis]; }
    float max_coord(int axis) const { return box.max[axis]; }
    std::uint32_t id() const { return number; }

    Aabb<D> box;
    std::uint32_t number;
};

template <int D>
struct Counter {
    explicit Counter(std::span<const Aabb<D>>) {}

    std::size_t count(std::span<const Aabb<D>> boxes) {
        numbered.clear();  // reordered below
        for (const Aabb<D>& box : boxes) numbered.push_back({box, static_cast<std::uint32_t>(numbered.size())});
        std::size_t pairs = 0;
        const auto count_one = [&pairs](const NumberedBox<D>&, const NumberedBox<D>&) { ++pairs; };
        CGAL::box_self_intersection_d(numbered.begin(), numbered.end(), count_one, cutoff(boxes.size()));
        return pairs;
    }

    std::vector<NumberedBox<D>> numbered;
};

}  // namespace

template <int D>
Side cgal_pairs(const MakeScene<D>& make, Upkeep) {
    return count_pairs<Counter<D>>("cgal", make);
}

template Side cgal_pairs(const MakeScene<2>&, Upkeep);
template Side cgal_pairs(const MakeScene<3>&, Upkeep);

}  // namespace abut::bench
