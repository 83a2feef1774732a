#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/math/assert.hpp>

namespace abut {

template <int D>
void LayeredGrid<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 31);
    size_ = boxes.size();
    items_.reserve(size_);
    plan_ = plan_layers<D>(boxes);
    items_.forget_cells();
    items_.fill(plan_, boxes);
    planned_work_ = items_.work();
}

template <int D>
void LayeredGrid<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() == size_);
    if (boxes.size() != size_) return build(boxes);
    items_.fill(plan_, boxes);
    if (items_.work() > 1.5 * planned_work_ + 20 * static_cast<double>(size_)) build(boxes);
}

template class LayeredGrid<2>;
template class LayeredGrid<3>;
static_assert(BroadPhase<LayeredGrid<2>, 2> && BroadPhase<LayeredGrid<3>, 3>);

}  // namespace abut
