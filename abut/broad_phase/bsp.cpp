#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bsp_place.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

/// The boxes of the items, those of the empty ones included.
template <int D>
Aabb<D> bounds_of(const std::vector<BspItem<D>>& items) {
    Aabb<D> result = Aabb<D>::empty();
    for (const BspItem<D>& item : items) result = merged(result, item.box);
    return result;
}

/// Found from the root, for it is seldom asked for.
template <int D>
Aabb<D> cell_of(const BspTree<D>& tree, std::uint32_t index) {
    constexpr float far = std::numeric_limits<float>::infinity();
    Aabb<D> cell{Vec<D>(-far), Vec<D>(far)};
    for (std::uint32_t at = 0; at != index;) {
        const BspNode& node = tree.nodes[at];
        const bool above = index >= node.above();
        if (above)
            cell.min[node.axis()] = node.plane;
        else
            cell.max[node.axis()] = float_before(node.plane);
        at = above ? node.above() : at + 1;
    }
    return cell;
}

/// A ray on its way through the cells: when it meets their planes, and which cell tells an item that it comes into at
/// `enters`. At each plane that the item meets, that is the side on which the ray is then; so it may be told by a cell
/// that the ray has left by a rounding, where it meets the item by no more than that.
template <int D>
class CellRay {
public:
    /// What RayReach allows for its roundings, times a bit more.
    static constexpr double doubt = 2e-12;

    explicit CellRay(const Ray<D>& ray)
        : origin_(ray.origin), direction_(ray.direction), inverse_(1.0 / DVec<D>(ray.direction)) {}

    double direction(int axis) const { return direction_[axis]; }
    bool starts_below(int axis, float plane) const { return origin_[axis] < static_cast<double>(plane); }
    double meets(int axis, float plane) const { return (static_cast<double>(plane) - origin_[axis]) * inverse_[axis]; }

    /// Of an item of a node whose cell the ray is in from `from` to `to`.
    bool tells(const BspTree<D>& tree, std::uint32_t node, const Aabb<D>& item, double enters, double from,
               double to) const {
        if (enters < from || enters > to * (1 + doubt)) return false;
        return enters < to || tells_about_its_end(cell_of(tree, node), item, enters);
    }

private:
    bool tells_about_its_end(const Aabb<D>& cell, const Aabb<D>& item, double enters) const {
        for (int i = 0; i < D; ++i) {
            if (direction_[i] == 0) continue;
            const bool up = direction_[i] > 0;
            const bool ends_here = up ? item.max[i] <= cell.max[i] : item.min[i] >= cell.min[i];
            if (!ends_here && enters >= meets(i, up ? -float_before(-cell.max[i]) : cell.min[i])) return false;
        }
        return true;
    }

    DVec<D> origin_, direction_, inverse_;
};

}  // namespace

template <int D>
void Bsp<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 29);
    tree_.items.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) tree_.items[i] = {usable(boxes[i]), i};
    build_tree(tree_);
    bounds_ = bounds_of(tree_.items);
    replaced_ = 0;
}

template <int D>
void Bsp<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes);
    std::size_t moved = 0;
    for (const BspItem<D>& item : tree_.items) moved += usable(boxes[item.index]) == item.box ? 0 : 1;
    if (moved == 0) return;
    replaced_ += moved;
    if (moved > size() / 8 || replaced_ > size()) return build(boxes);
    for (std::uint32_t i = 0; i < size(); ++i) {
        BspItem<D>& item = tree_.items[i];
        const Aabb<D> box = usable(boxes[item.index]);
        if (box == item.box) continue;
        if (!is_empty(item.box)) take_out(tree_, i);
        item.box = box;
        if (!is_empty(box) && !put_in(tree_, i)) return build(boxes);
    }
    bounds_ = bounds_of(tree_.items);
}

template <int D>
void Bsp<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    struct Waiting {
        std::uint32_t node;
        double from, to;
    };
    RayReach<D> reach(ray);
    double measure = 0;
    if (reach.is_exhausted() || is_empty(bounds_) || !reach.measure(bounds_, measure)) return;
    const CellRay<D> way(ray);
    constexpr double doubt = CellRay<D>::doubt;
    std::array<Waiting, bsp_depth + 1> stack;
    stack[0] = {0, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t waiting = 1; waiting > 0;) {
        auto [at, from, to] = stack[--waiting];
        while (reach.within(from * (1 - doubt))) {
            const BspNode& node = tree_.nodes[at];
            for (std::uint32_t w = node.first; w < node.first + node.count; ++w) {
                const BspItem<D>& item = tree_.items[tree_.words[w]];
                if (!reach.measure(item.box, measure) || !way.tells(tree_, at, item.box, measure, from, to)) continue;
                reach.shrink(visit(item.index));
                if (reach.is_exhausted()) return;
            }
            if (node.is_leaf()) break;
            const int axis = node.axis();
            const double meets = way.meets(axis, node.plane), direction = way.direction(axis);
            const bool below_first = direction == 0 ? way.starts_below(axis, node.plane) : direction > 0;
            const std::uint32_t first = below_first ? at + 1 : node.above();
            const std::uint32_t second = below_first ? node.above() : at + 1;
            const bool go_first = direction == 0 || from <= std::min(to, meets) * (1 + doubt);
            const bool go_second = direction != 0 && std::max(from, meets) <= to * (1 + doubt);
            if (go_first && go_second) stack[waiting++] = {second, std::max(from, meets), to};
            at = go_first ? first : second;
            if (go_first && direction != 0) to = std::min(to, meets);
            if (!go_first) {
                if (!go_second) break;
                from = std::max(from, meets);
            }
        }
    }
}

template <int D>
void Bsp<D>::visit_near(const Aabb<D>& box, float near, ReachCall visit) const {
    struct Waiting {
        std::uint32_t node;
        double measure;
        Aabb<D> cell;
    };
    BoxReach<D> reach(box, near);
    double measure = 0;
    if (reach.is_exhausted() || is_empty(bounds_) || !reach.measure(bounds_, measure)) return;
    // The cell tells an item that has the point of it nearest to the lower corner of the box.
    const auto tells = [&](const Aabb<D>& cell, const Aabb<D>& item) {
        bool result = true;
        for (int i = 0; i < D; ++i) {
            const float place = std::min(std::max(item.min[i], box.min[i]), item.max[i]);
            result = result && cell.min[i] <= place && place <= cell.max[i];
        }
        return result;
    };
    std::array<Waiting, bsp_depth + 1> stack;
    stack[0] = {0, measure, bounds_};
    for (std::size_t waiting = 1; waiting > 0;) {
        auto [at, nearest, cell] = stack[--waiting];
        if (!reach.within(nearest)) continue;
        for (;;) {
            const BspNode& node = tree_.nodes[at];
            for (std::uint32_t w = node.first; w < node.first + node.count; ++w) {
                const BspItem<D>& item = tree_.items[tree_.words[w]];
                if (!reach.measure(item.box, measure) || !tells(cell, item.box)) continue;
                reach.shrink(visit(item.index));
                if (reach.is_exhausted()) return;
            }
            if (node.is_leaf()) break;
            // The nearer part is as near as the whole; so are both where the box is on both sides.
            const int axis = node.axis();
            const bool below_first = box.min[axis] < node.plane;
            Waiting second{below_first ? node.above() : at + 1, nearest, cell};
            (below_first ? second.cell.min : second.cell.max)[axis] =
                below_first ? node.plane : float_before(node.plane);
            if (reach.measure(second.cell, second.measure)) stack[waiting++] = second;
            (below_first ? cell.max : cell.min)[axis] = below_first ? float_before(node.plane) : node.plane;
            at = below_first ? at + 1 : node.above();
        }
    }
}

template class Bsp<2>;
template class Bsp<3>;
static_assert(BroadPhase<Bsp<2>, 2> && BroadPhase<Bsp<3>, 3>);

}  // namespace abut
