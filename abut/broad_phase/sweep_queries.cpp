// What a SweepAndPrune is asked.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <algorithm>
#include <bit>

namespace abut {
namespace {

/// Pairs on their way to the visitor, all those of one BoxOverlaps at a time.
class Told {
public:
    Told(const std::uint32_t* items, PairsCall visit) : items_(items), visit_(visit) {}

    /// A pair that is in two columns is told in the first: in any other, both have begun before it along some axis. It
    /// is written and forgotten. Returns false where the visitor has had enough.
    bool add(const BoxOverlaps& hit) {
        const std::uint32_t item = items_[hit.box];
        for (std::uint32_t bits = hit.bits; bits != 0; bits &= bits - 1) {
            const std::uint32_t other = items_[hit.first + static_cast<std::uint32_t>(std::countr_zero(bits))];
            const std::uint32_t i = item & ~copy_bits, j = other & ~copy_bits;
            pairs_[count_] = {std::min(i, j), std::max(i, j)};
            count_ += (item & other & copy_bits) == 0 ? 1 : 0;
        }
        return count_ < enough || flush();
    }
    bool flush() {
        const std::size_t count = count_;
        count_ = 0;
        return visit_({pairs_.data(), count});
    }

private:
    static constexpr std::size_t enough = 256;
    const std::uint32_t* items_;
    PairsCall visit_;
    std::size_t count_ = 0;
    std::array<ItemPair, enough + box_lanes> pairs_;
};

}  // namespace

template <int D>
void SweepAndPrune<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto visit_from = [&](std::size_t first, std::size_t last, PairsCall told) {
        Told pairs(rows_.items(), told);
        bool go_on = true;
        const auto add = [&](std::span<const BoxOverlaps> hits) {
            for (const BoxOverlaps& hit : hits)
                if (!pairs.add(hit)) return go_on = false;
            return go_on;
        };
        each_sorted_overlap(rows_.boxes(), first, last, add);
        if (go_on) pairs.flush();
    };
    // Below this, starting a thread costs more than all there is to do.
    constexpr std::size_t few = 2048;
    const std::size_t count = rows_.count();
    if (executor == nullptr || count < few) return visit_from(0, count, visit);
    const std::size_t parts = std::min<std::size_t>(4 * std::size_t{executor->workers()}, count / 256);
    report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit, [&](std::uint32_t part, PairsCall told) {
        visit_from(count * part / parts, count * (part + 1) / parts, told);
    });
}

template <int D>
void SweepAndPrune<D>::visit_pairs(const SweepAndPrune& other, PairsCall visit) const {
    PairBuffer pairs(visit);
    bool go_on = true;
    visit_boxes([&](std::uint32_t i, const Aabb<D>& box) {
        const auto add = [&](std::uint32_t j) { return pairs.add(i, j); };
        return go_on = other.rows_.visit_overlapping(turned<D>(box, other.plan_.axis), add);
    });
    if (go_on) pairs.flush();
}

template <int D>
void SweepAndPrune<D>::visit_boxes(BoxCall<D> visit) const {
    const BoxSoaView<D> boxes = rows_.boxes();
    for (std::size_t i = 0; i < rows_.count(); ++i) {
        const std::uint32_t item = rows_.items()[i];
        if ((item & copy_bits) == 0 && !visit(item, turned_back<D>(boxes[i], plan_.axis))) return;
    }
}

template <int D>
void SweepAndPrune<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (!is_empty(query)) rows_.visit_overlapping(turned<D>(query, plan_.axis), visit);
}

template <int D>
void SweepAndPrune<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    const Ray<D> here{turned<D>(ray.origin, plan_.axis), turned<D>(ray.direction, plan_.axis), ray.length};
    rows_.visit_within(RayReach<D>(here), visit);
}

template <int D>
void SweepAndPrune<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    const MovingBox<D> here{turned<D>(box.center, plan_.axis), turned<D>(box.half, plan_.axis),
                            turned<D>(box.direction, plan_.axis), box.length};
    rows_.visit_within(RayReach<D>::of_box(here), visit);
}

template <int D>
void SweepAndPrune<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    rows_.visit_within(BoxReach<D>(turned<D>(box, plan_.axis), reach), visit);
}

#define ABUT_FOR_DIMENSION(D)                                                              \
    template void SweepAndPrune<D>::visit_pairs(PairsCall, Executor*) const;               \
    template void SweepAndPrune<D>::visit_pairs(const SweepAndPrune<D>&, PairsCall) const; \
    template void SweepAndPrune<D>::visit_boxes(BoxCall<D>) const;                         \
    template void SweepAndPrune<D>::visit_overlapping(const Aabb<D>&, ItemCall) const;     \
    template void SweepAndPrune<D>::visit_along(const Ray<D>&, ReachCall) const;           \
    template void SweepAndPrune<D>::visit_along(const MovingBox<D>&, ReachCall) const;     \
    template void SweepAndPrune<D>::visit_near(const Aabb<D>&, float, ReachCall) const;
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut
