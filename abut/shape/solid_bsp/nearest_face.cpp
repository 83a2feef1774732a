// Nearest face query: near sides of planes first; far sides only if they may hold a nearer face.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/math/assert.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <cmath>
#include <limits>

namespace abut {

using namespace detail;

namespace {

template <int D>
class NearestFace {
public:
    NearestFace(const SolidTree<D>& tree, const Vec<D>& point) : tree_(tree) { point_.place.offset = DVec<D>(point); }

    std::uint32_t face() const { return face_; }

    void search(std::uint32_t at) {
        while (at < open_leaf) {
            const SolidNode<D>& node = tree_.nodes[at];
            const double height =
                (dot(node.plane.normal, point_.place.offset) - node.plane.offset) / length(node.plane.normal);
            search(height > 0 ? node.front : node.back);
            if (std::abs(height) > distance_) return;
            for (std::uint32_t i = node.first_piece; i < node.first_piece + node.pieces; ++i)
                test_piece(tree_.pieces[i]);
            at = height > 0 ? node.back : node.front;
        }
    }

private:
    void test_piece(const SolidPiece& piece) {
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
    std::uint32_t face_ = no_index;
};

}  // namespace

template <int D>
std::optional<std::uint32_t> SolidBsp<D>::nearest_face(const Vec<D>& point) const {
    const bool finite = is_finite(point);
    ABUT_ASSERT(finite);
    if (!finite || tree_->pieces.empty()) return std::nullopt;
    NearestFace<D> nearest(*tree_, point);
    nearest.search(tree_->root);
    return nearest.face();
}

template std::optional<std::uint32_t> SolidBsp<2>::nearest_face(const Vec2&) const;
template std::optional<std::uint32_t> SolidBsp<3>::nearest_face(const Vec3&) const;

}  // namespace abut
