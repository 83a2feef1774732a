// Convex cells of the solid part of a tree.

#include <abut/convex/manifold/clip.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

enum class Content : std::uint8_t { open, solid, both };

/// The box of all faces, extended by its width on every side.
template <int D>
Convex<D> surroundings(const Aabb<D>& bounds) {
    constexpr double largest_float = static_cast<double>(std::numeric_limits<float>::max());
    const DVec<D> low(bounds.min), high(bounds.max);
    const double width = largest(high - low);
    Convex<D> box;
    box.core = Core::box;
    box.place.offset = 0.5 * (low + high);
    for (int i = 0; i < D; ++i) {
        const double half = 0.5 * (high[i] - low[i]) + width;
        box.own[0][i] = static_cast<float>(std::min(half, largest_float - std::abs(box.place.offset[i])));
    }
    return box;
}

template <int D>
class Cells {
public:
    Cells(SolidTree<D>& tree, double margin) : tree_(tree), margin_(margin), contents_(tree.nodes.size()) {
        // Children come after their parents.
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            const Content front = content(tree.nodes[i].front), back = content(tree.nodes[i].back);
            contents_[i] = front == back ? front : Content::both;
        }
    }

    void walk(std::uint32_t at, ClipBody<D> body) {
        while (content(at) == Content::both) {
            const SolidNode<D>& node = tree_.nodes[at];
            const double scale = length(node.plane.normal);
            const ClipPlane<D> plane{node.plane.normal / scale, node.plane.offset / scale};
            double lowest = 0, highest = 0;
            for (const DVec<D>& point : body.points) {
                const double height = dot(plane.normal, point) - plane.offset;
                lowest = std::min(lowest, height);
                highest = std::max(highest, height);
            }
            if (highest <= margin_ && lowest >= -margin_) return;  // thinner than the tolerance
            if (lowest >= -margin_) {
                at = node.front;
            } else if (highest <= margin_) {
                at = node.back;
            } else {
                ClipBody<D> behind = body;
                cut(behind, plane, margin_);
                walk(node.back, std::move(behind));
                cut(body, {-plane.normal, -plane.offset}, margin_);
                at = node.front;
            }
        }
        if (content(at) == Content::solid) tree_.parts.add(body.points, count_++);
    }

private:
    Content content(std::uint32_t at) const {
        if (at == solid_leaf) return Content::solid;
        return at == open_leaf ? Content::open : contents_[at];
    }

    SolidTree<D>& tree_;
    double margin_;
    std::vector<Content> contents_;
    std::uint32_t count_ = 0;
};

}  // namespace

template <int D>
void add_cells(SolidTree<D>& tree, double margin) {
    if (tree.nodes.empty()) return;
    Cells<D>(tree, margin).walk(tree.root, clip_body(surroundings(tree.bounds), DVec<D>(0.0)));
}

template void add_cells(SolidTree<2>&, double);
template void add_cells(SolidTree<3>&, double);

}  // namespace abut::detail
