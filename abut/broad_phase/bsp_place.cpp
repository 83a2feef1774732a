#include <abut/broad_phase/bsp_place.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

/// False where there is no room left.
template <int D>
bool append(BspTree<D>& tree, BspNode& node, std::uint32_t item) {
    if (node.count == tree.words[node.first - 1]) {
        const std::uint32_t room = 2 * node.count + 2;
        if (tree.used + 1 + room > tree.words.size()) return false;
        tree.words[tree.used] = room;
        std::copy_n(tree.words.begin() + node.first, node.count, tree.words.begin() + tree.used + 1);
        node.first = tree.used + 1;
        tree.used += 1 + room;
    }
    tree.words[node.first + node.count++] = item;
    return true;
}

}  // namespace

template <int D>
void take_out(BspTree<D>& tree, std::uint32_t item) {
    const Aabb<D>& box = tree.items[item].box;
    std::array<std::uint32_t, bsp_depth + 1> stack{0};
    for (std::size_t waiting = 1; waiting > 0;) {
        const std::uint32_t top = stack[--waiting];
        BspNode& node = tree.nodes[top];
        const auto begin = tree.words.begin() + node.first, end = begin + node.count;
        const auto found = std::find(begin, end, item);
        if (found != end) {
            *found = *(end - 1);
            --node.count;
        } else if (!node.is_leaf()) {
            if (box.max[node.axis()] >= node.plane) stack[waiting++] = node.above();
            if (box.min[node.axis()] < node.plane) stack[waiting++] = top + 1;
        }
    }
}

template <int D>
bool put_in(BspTree<D>& tree, std::uint32_t item) {
    const Aabb<D>& box = tree.items[item].box;
    struct Waiting {
        std::uint32_t node;
        Aabb<D> cell;
    };
    std::array<Waiting, bsp_depth + 1> stack;
    stack[0] = {0, tree.frame};
    for (std::size_t waiting = 1; waiting > 0;) {
        const Waiting top = stack[--waiting];
        BspNode& node = tree.nodes[top.node];
        const bool leaf = node.is_leaf();
        const int axis = node.axis();
        const bool below = !leaf && box.min[axis] < node.plane, above = !leaf && box.max[axis] >= node.plane;
        if (leaf || (below && above && is_wide(box, top.cell, axis))) {
            if (!append(tree, node, item)) return false;
            continue;
        }
        const auto [cell_below, cell_above] = cut(top.cell, axis, node.plane);
        if (above) stack[waiting++] = {node.above(), cell_above};
        if (below) stack[waiting++] = {top.node + 1, cell_below};
    }
    return true;
}

template void take_out(BspTree<2>&, std::uint32_t);
template void take_out(BspTree<3>&, std::uint32_t);
template bool put_in(BspTree<2>&, std::uint32_t);
template bool put_in(BspTree<3>&, std::uint32_t);

}  // namespace abut
