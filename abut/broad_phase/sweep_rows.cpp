#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/broad_phase/sweep_rows.hpp>

#include <algorithm>
#include <bit>

namespace abut {
namespace {

constexpr std::size_t fan = box_lanes;

constexpr std::size_t whole_blocks(std::size_t count) {
    return (count + fan - 1) / fan;
}

/// Level 0 are the boxes, level k > 0 the blocks of 16 of level k - 1.
template <int D>
struct Levels {
    BoxSoaView<D> boxes;
    const std::uint32_t* items;
    BoxSoaView<D> blocks;
    const std::size_t* begins;
    std::size_t count;

    bool is_copy(std::size_t i) const { return (items[i] & copy_bits) != 0; }
};

/// Returns false where the visitor has had enough. `first`: the first of 16 of the level.
template <int D>
bool visit_overlapping_in(const Levels<D>& levels, std::size_t level, std::size_t first, const Aabb<D>& box,
                          ItemCall visit) {
    if (level == 0) {
        for (auto bits = overlap_bits(levels.boxes, first, fan, box); bits != 0; bits &= bits - 1) {
            const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
            if (!levels.is_copy(i) && !visit(levels.items[i])) return false;
        }
        return true;
    }
    const std::size_t begin = levels.begins[level - 1];
    for (auto bits = overlap_bits(levels.blocks, begin + first, fan, box); bits != 0; bits &= bits - 1) {
        const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
        if (!visit_overlapping_in(levels, level - 1, i * fan, box, visit)) return false;
    }
    return true;
}

/// What is within reach of 16 boxes of a level, the nearest first. `first`: the first of them.
template <int D, class Reach>
void visit_within_in(const Levels<D>& levels, std::size_t level, std::size_t first, Reach& reach, ReachCall visit) {
    struct Found {
        double measure;
        std::size_t index;
    };
    std::array<Found, fan> found;
    std::size_t count = 0;
    for (std::size_t i = first; i < first + fan; ++i) {
        if (level == 0 && levels.is_copy(i)) continue;
        const Aabb<D> box = level == 0 ? levels.boxes[i] : levels.blocks[levels.begins[level - 1] + i];
        double measure = 0;
        if (is_empty(box) || !reach.measure(box, measure)) continue;
        std::size_t place = count++;
        for (; place > 0 && found[place - 1].measure > measure; --place) found[place] = found[place - 1];
        found[place] = {measure, i};
    }
    for (std::size_t k = 0; k < count && !reach.is_exhausted() && reach.within(found[k].measure); ++k) {
        if (level == 0)
            reach.shrink(visit(levels.items[found[k].index]));
        else
            visit_within_in(levels, level - 1, found[k].index * fan, reach, visit);
    }
}

}  // namespace

template <int D>
void SweepRows<D>::reserve(std::size_t count) {
    boxes_.reserve(count + fan);
    if (items_.size() < count + fan) items_.resize(count + fan);
    std::size_t blocks = 0;
    do {
        count = whole_blocks(count);
        blocks += whole_blocks(count) * fan;
    } while (count > fan);
    blocks_.reserve(blocks);
}

template <int D>
void SweepRows<D>::make_blocks(std::size_t count) {
    count_ = count;
    level_count_ = 0;
    levels_[0] = 0;
    if (count == 0) return;
    for (std::size_t i = count; i < whole_blocks(count) * fan; ++i) end_column(i);
    std::size_t blocks = whole_blocks(count);
    block_bounds(boxes_.view(), items_.data(), copy_bits, blocks, 0, blocks_);
    for (;;) {
        const std::size_t begin = levels_[level_count_], whole = whole_blocks(blocks) * fan;
        for (std::size_t i = blocks; i < whole; ++i) blocks_.set(begin + i, nan_box<D>());
        levels_[++level_count_] = begin + whole;
        if (blocks <= fan) return;
        blocks = whole / fan;
        block_bounds(blocks_.view(begin), items_.data(), 0, blocks, begin + whole, blocks_);
    }
}

template <int D>
Aabb<D> SweepRows<D>::bounds() const {
    Aabb<D> result = Aabb<D>::empty();
    if (level_count_ == 0) return result;
    const BoxSoaView<D> blocks = blocks_.view();
    for (std::size_t i = levels_[level_count_ - 1]; i < levels_[level_count_]; ++i)
        if (!is_empty(blocks[i])) result = merged(result, blocks[i]);
    return result;
}

template <int D>
bool SweepRows<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    if (level_count_ == 0) return true;
    const Levels<D> levels{boxes_.view(), items_.data(), blocks_.view(), levels_.data(), level_count_};
    return visit_overlapping_in(levels, level_count_, 0, box, visit);
}

template <int D>
void SweepRows<D>::visit_within(RayReach<D> reach, ReachCall visit) const {
    if (level_count_ == 0 || reach.is_exhausted()) return;
    const Levels<D> levels{boxes_.view(), items_.data(), blocks_.view(), levels_.data(), level_count_};
    visit_within_in(levels, level_count_, 0, reach, visit);
}

template <int D>
void SweepRows<D>::visit_within(BoxReach<D> reach, ReachCall visit) const {
    if (level_count_ == 0 || reach.is_exhausted()) return;
    const Levels<D> levels{boxes_.view(), items_.data(), blocks_.view(), levels_.data(), level_count_};
    visit_within_in(levels, level_count_, 0, reach, visit);
}

template class SweepRows<2>;
template class SweepRows<3>;

}  // namespace abut
