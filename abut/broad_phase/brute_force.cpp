#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <bit>

namespace abut {

using namespace detail;

namespace {

/// Returns false if the visitor stops the search.
bool add_pairs(std::span<const detail::BoxOverlaps> overlaps, detail::PairBuffer& pairs) {
    for (const detail::BoxOverlaps& overlap : overlaps)
        for (std::uint32_t bits = overlap.bits; bits != 0; bits &= bits - 1)
            if (!pairs.add(overlap.box, overlap.first + static_cast<std::uint32_t>(std::countr_zero(bits))))
                return false;
    return true;
}

}  // namespace

template <int D>
void BruteForce<D>::write(std::size_t index, const Aabb<D>& box) {
    const Aabb<D> stored = usable(box);
    boxes_.set(index, is_empty(stored) ? detail::nan_box<D>() : stored);
}

template <int D>
void BruteForce<D>::set_all(std::span<const Aabb<D>> boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) write(i, boxes[i]);
}

template <int D>
void BruteForce<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() < std::size_t{1} << 32);
    size_ = boxes.size();
    boxes_.reserve(size_);
    free_.clear();
    set_all(boxes);
}

template <int D>
void BruteForce<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    free_.remove_used(boxes);
    set_all(boxes);
}

template <int D>
std::uint32_t BruteForce<D>::insert(const Aabb<D>& box) {
    detail::enter_library();
    const std::uint32_t index = free_.take(static_cast<std::uint32_t>(size_));
    if (index == size_) {
        ABUT_ASSERT(size_ + 1 < std::size_t{1} << 32);
        if (size_ == boxes_.capacity()) boxes_.grow(2 * size_ + detail::box_lanes, size_);
        ++size_;
    }
    write(index, box);
    return index;
}

template <int D>
void BruteForce<D>::erase(std::uint32_t index) {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    if (index >= size() || free_.contains(index)) return;
    boxes_.set(index, detail::nan_box<D>());
    free_.add(index);
}

template <int D>
bool BruteForce<D>::set(std::uint32_t index, const Aabb<D>& box) {
    detail::enter_library();
    ABUT_ASSERT(index < size() && !free_.contains(index));
    if (index < size()) write(index, box);
    return true;
}

template <int D>
Aabb<D> BruteForce<D>::bounds() const {
    detail::enter_library();
    Aabb<D> result = Aabb<D>::empty();
    const detail::BoxSoaView<D> boxes = boxes_.view();
    for (std::size_t i = 0; i < size_; ++i)
        if (!is_empty(boxes[i])) result = merged(result, boxes[i]);
    return result;
}

template <int D>
void BruteForce<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const detail::BoxSoaView<D> boxes = boxes_.view();
    const auto visit_from = [&](std::size_t first, std::size_t last, PairsCall report) {
        detail::PairBuffer pairs(report);
        bool continues = true;
        const auto add = [&](std::span<const detail::BoxOverlaps> overlaps) {
            return continues = continues && add_pairs(overlaps, pairs);
        };
        each_overlap(boxes, first, last, size_, add);
        if (continues) pairs.flush();
    };
    // With fewer boxes, starting a thread costs more than the whole search.
    constexpr std::size_t min_parallel_count = 512;
    if (executor == nullptr || size_ < min_parallel_count) return visit_from(0, size_, visit);
    // Box k is tested against the boxes after it. A task takes one range from each end, so that all tasks are equal.
    const std::size_t parts = std::min<std::size_t>(4 * std::size_t{executor->workers()}, size_ / 64),
                      halves = 2 * parts;
    detail::report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit,
                               [&](std::uint32_t part, PairsCall report) {
                                   for (const std::size_t half : {std::size_t{part}, halves - 1 - part})
                                       visit_from(size_ * half / halves, size_ * (half + 1) / halves, report);
                               });
}

template <int D>
void BruteForce<D>::visit_pairs(const BruteForce& other, PairsCall visit) const {
    detail::report_between(*this, other, visit);
}

template <int D>
void BruteForce<D>::visit_boxes(BoxCall<D> visit) const {
    const detail::BoxSoaView<D> boxes = boxes_.view();
    for (std::uint32_t i = 0; i < size_; ++i)
        if (!is_empty(boxes[i]) && !visit(i, boxes[i])) return;
}

template <int D>
void BruteForce<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (is_empty(query)) return;
    for (std::size_t first = 0; first < size_; first += 64) {
        std::uint64_t bits = overlap_bits(boxes_.view(), first, std::min<std::size_t>(size_ - first, 64), query);
        for (; bits != 0; bits &= bits - 1)
            if (!visit(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(bits)))) return;
    }
}

template <int D>
void BruteForce<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    visit_within(RayReach<D>::of_box(box), visit);
}

template <int D>
void BruteForce<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(BoxReach<D>(box, reach), visit);
}

template <int D>
template <class Reach>
void BruteForce<D>::visit_within(Reach reach, ReachCall visit) const {
    const detail::BoxSoaView<D> boxes = boxes_.view();
    for (std::uint32_t i = 0; i < size_ && !reach.is_exhausted(); ++i) {
        double measure = 0;
        if (!is_empty(boxes[i]) && reach.measure(boxes[i], measure)) reach.shrink(visit(i));
    }
}

template class BruteForce<2>;
template class BruteForce<3>;
static_assert(BroadPhase<BruteForce<2>, 2> && BroadPhase<BruteForce<3>, 3>);

}  // namespace abut
