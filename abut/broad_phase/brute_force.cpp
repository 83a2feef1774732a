#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/pair_buffer.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>

namespace abut {
namespace {

template <int D, class Reach>
void visit_within(const std::vector<Aabb<D>>& boxes, Reach reach, ReachCall visit) {
    for (std::uint32_t i = 0; i < boxes.size() && !reach.over(); ++i) {
        double measure = 0;
        if (!is_empty(boxes[i]) && reach.measure(boxes[i], measure)) reach.shrink(visit(i));
    }
}

}  // namespace

template <int D>
void BruteForce<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    boxes_.clear();
    boxes_.reserve(boxes.size());
    for (const Aabb<D>& box : boxes) boxes_.push_back(usable(box));
}

template <int D>
void BruteForce<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() == size());
    build(boxes);
}

template <int D>
void BruteForce<D>::sorted_pairs(std::vector<ItemPair>& out) const {
    out.clear();
    each_pair([&](std::uint32_t i, std::uint32_t j) { out.emplace_back(i, j); });
}

template <int D>
Aabb<D> BruteForce<D>::bounds() const {
    Aabb<D> result = Aabb<D>::empty();
    for (const Aabb<D>& box : boxes_) result = merged(result, box);
    return result;
}

template <int D>
void BruteForce<D>::visit_pairs(PairsCall visit, Executor*) const {
    PairBuffer pairs(visit);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes_.size(); ++j)
            if (overlaps(boxes_[i], boxes_[j]) && !pairs.add(i, j)) return;
    pairs.flush();
}

template <int D>
void BruteForce<D>::visit_pairs(const BruteForce& other, PairsCall visit) const {
    PairBuffer pairs(visit);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        for (std::uint32_t j = 0; j < other.boxes_.size(); ++j)
            if (overlaps(boxes_[i], other.boxes_[j]) && !pairs.add(i, j)) return;
    pairs.flush();
}

template <int D>
void BruteForce<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        if (overlaps(boxes_[i], query) && !visit(i)) return;
}

template <int D>
void BruteForce<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    visit_within(boxes_, RayReach<D>(ray), visit);
}

template <int D>
void BruteForce<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(boxes_, BoxReach<D>(box, reach), visit);
}

template class BruteForce<2>;
template class BruteForce<3>;
static_assert(BroadPhase<BruteForce<2>, 2> && BroadPhase<BruteForce<3>, 3>);

}  // namespace abut
