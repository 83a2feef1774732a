#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/bvh/queries.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <array>

namespace abut {

using namespace detail;

namespace {

/// The pairs of one tree, divided into tasks for several threads. The order doesn't depend on the number of threads.
template <int D>
class PairTasks {
public:
    explicit PairTasks(const detail::BvhTree<D>& tree) : tree_(tree) {
        const detail::BvhRoot<D>&bounded = tree.root(0), &unbounded = tree.root(1);
        if (bounded.ref != detail::bvh_none) tasks_[count_++] = {bounded.ref, detail::bvh_none, bounded.box, {}};
        if (unbounded.ref != detail::bvh_none) tasks_[count_++] = {unbounded.ref, detail::bvh_none, unbounded.box, {}};
        if (count_ == 2) tasks_[count_++] = {bounded.ref, unbounded.ref, bounded.box, unbounded.box};
    }

    /// Divides the tasks below a single node until there are `min_count` of them or the array is full.
    void divide(std::uint32_t min_count) {
        constexpr std::size_t max_parts = detail::bvh_lanes * (detail::bvh_lanes + 1) / 2;
        std::uint32_t single_node_tasks = 0;
        for (std::size_t next = 0;
             next < count_ && single_node_tasks < min_count && count_ + max_parts <= tasks_.size(); ++next) {
            const detail::BvhPairTask<D> task = tasks_[next];
            if (task.b != detail::bvh_none || detail::is_leaf(task.a)) continue;
            const detail::BvhNode<D>& node = tree_.node(task.a);
            const std::uint32_t children = node.count();
            single_node_tasks += children - 1;
            // The first child replaces the node, so that each node is divided once.
            tasks_[next] = {node.child[0], detail::bvh_none, node.box(0), {}};
            for (std::uint32_t i = 0; i < children; ++i) {
                if (i > 0) tasks_[count_++] = {node.child[i], detail::bvh_none, node.box(i), {}};
                for (std::uint32_t j = i + 1; j < children; ++j)
                    if (overlaps(node.box(i), node.box(j)))
                        tasks_[count_++] = {node.child[i], node.child[j], node.box(i), node.box(j)};
            }
        }
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(count_); }
    const detail::BvhPairTask<D>& operator[](std::uint32_t i) const { return tasks_[i]; }

private:
    const detail::BvhTree<D>& tree_;
    std::array<detail::BvhPairTask<D>, 512> tasks_;
    std::size_t count_ = 0;
};

}  // namespace

template <int D>
void Bvh<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    tree_.build(boxes, executor);
}

template <int D>
void Bvh<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    tree_.update(boxes, executor);
}

template <int D>
std::uint32_t Bvh<D>::insert(const Aabb<D>& box) {
    detail::enter_library();
    return tree_.insert(box);
}

template <int D>
void Bvh<D>::erase(std::uint32_t index) {
    detail::enter_library();
    tree_.erase(index);
}

template <int D>
bool Bvh<D>::set(std::uint32_t index, const Aabb<D>& box) {
    detail::enter_library();
    return tree_.set(index, box);
}

template <int D>
void Bvh<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    PairTasks<D> tasks(tree_);
    if (executor == nullptr) {
        detail::PairBuffer pairs(visit);
        bool continues = true;
        for (std::uint32_t i = 0; i < tasks.count() && continues; ++i)
            continues = find_pairs<D>(tree_, tree_, tasks[i], pairs);
        if (continues) pairs.flush();
        return;
    }
    tasks.divide(8 * executor->workers());
    detail::report_in_parallel(*executor, tasks.count(), visit, [&](std::uint32_t i, PairsCall report) {
        detail::PairBuffer pairs(report);
        if (find_pairs<D>(tree_, tree_, tasks[i], pairs)) pairs.flush();
    });
}

template <int D>
void Bvh<D>::visit_pairs(const Bvh& other, PairsCall visit) const {
    detail::PairBuffer pairs(visit);
    for (const std::size_t kind : {0u, 1u})
        for (const std::size_t other_kind : {0u, 1u}) {
            const detail::BvhRoot<D>&a = tree_.root(kind), &b = other.tree_.root(other_kind);
            if (a.ref != detail::bvh_none && b.ref != detail::bvh_none &&
                !find_pairs<D>(tree_, other.tree_, {a.ref, b.ref, a.box, b.box}, pairs))
                return;
        }
    pairs.flush();
}

template <int D>
void Bvh<D>::visit_boxes(BoxCall<D> visit) const {
    std::array<std::uint32_t, detail::bvh_depth*(detail::bvh_lanes - 1) + 1> stack;
    for (const std::size_t kind : {0u, 1u}) {
        std::size_t stack_size = 0;
        if (tree_.root(kind).ref != detail::bvh_none) stack[stack_size++] = tree_.root(kind).ref;
        while (stack_size > 0) {
            const std::uint32_t ref = stack[--stack_size];
            if (detail::is_leaf(ref)) {
                const detail::BvhLeaf<D>& leaf = tree_.leaf(ref);
                for (std::uint32_t lane = 0, count = leaf.count(); lane < count; ++lane)
                    if (!visit(leaf.index[lane], leaf.box(lane))) return;
            } else {
                const detail::BvhNode<D>& node = tree_.node(ref);
                for (std::uint32_t lane = 0, count = node.count(); lane < count; ++lane)
                    stack[stack_size++] = node.child[lane];
            }
        }
    }
}

template <int D>
void Bvh<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (!is_empty(query)) find_overlapping(tree_, query, visit);
}

template <int D>
void Bvh<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    find_within(tree_, ray, visit);
}

template <int D>
void Bvh<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    find_within(tree_, RayReach<D>::of_box(box), visit);
}

template <int D>
void Bvh<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    find_within(tree_, BoxReach<D>(box, reach), visit);
}

template class Bvh<2>;
template class Bvh<3>;
static_assert(BroadPhase<Bvh<2>, 2> && BroadPhase<Bvh<3>, 3>);

}  // namespace abut
