// Which face is next to a place: near sides of planes first, and far ones only where they may hold something nearer.

#include <abut/convex/signed_distance.hpp>
#include <abut/math/assert.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_tree.hpp>

#include <cmath>
#include <limits>

namespace abut {
namespace {

template <int D>
class Nearest {
public:
    Nearest(const SolidTree<D>& tree, const Vec<D>& point) : tree_(tree) { point_.place.offset = DVec<D>(point); }

    std::uint32_t face() const { return face_; }

    void search(std::uint32_t at) {
        while (at < open_leaf) {
            const SolidNode<D>& node = tree_.nodes[at];
            const double height =
                (dot(node.plane.normal, point_.place.offset) - node.plane.offset) / length(node.plane.normal);
            search(height > 0 ? node.front : node.back);
            if (std::abs(height) > distance_) return;
            for (std::uint32_t i = node.first_piece; i < node.first_piece + node.pieces; ++i) look_at(tree_.pieces[i]);
            at = height > 0 ? node.back : node.front;
        }
    }

private:
    void look_at(const SolidPiece& piece) {
        Convex<D> polygon;
        polygon.points = tree_.corners.data() + piece.first_corner;
        polygon.count = piece.corners;
        const double distance = std::abs(signed_distance(polygon, point_).distance);
        if (distance > distance_ || (distance == distance_ && piece.face > face_)) return;
        distance_ = distance;
        face_ = piece.face;
    }

    const SolidTree<D>& tree_;
    Convex<D> point_;
    double distance_ = std::numeric_limits<double>::infinity();
    std::uint32_t face_ = no_number;
};

}  // namespace

template <int D>
std::optional<std::uint32_t> SolidBsp<D>::nearest_face(const Vec<D>& point) const {
    const bool finite = is_finite(point);
    ABUT_ASSERT(finite);
    if (!finite || tree_->pieces.empty()) return std::nullopt;
    Nearest<D> nearest(*tree_, point);
    nearest.search(tree_->root);
    return nearest.face();
}

template std::optional<std::uint32_t> SolidBsp<2>::nearest_face(const Vec2&) const;
template std::optional<std::uint32_t> SolidBsp<3>::nearest_face(const Vec3&) const;

}  // namespace abut
