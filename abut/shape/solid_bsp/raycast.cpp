// Ray cast through a solid BSP tree, leaf by leaf. Both sides of a plane share the crossing point, so no ray passes
// between adjacent faces.

#include <abut/math/assert.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

using namespace detail;

namespace {

template <int D>
class RayTraversal {
public:
    RayTraversal(const SolidTree<D>& tree, const Vec<D>& origin, const DVec<D>& direction)
        : tree_(tree), point_(origin), origin_(origin), direction_(direction) {
        double scale = largest(origin_);
        for (int i = 0; i < D; ++i)
            scale = std::max({scale, std::abs(static_cast<double>(tree.bounds.min[i])),
                              std::abs(static_cast<double>(tree.bounds.max[i]))});
        scale_ = scale;
        min_interval_ = 1e-13 * scale / length(direction);
    }

    bool inside(std::uint32_t at) {
        while (at < open_leaf) {
            const SolidNode<D>& node = tree_.nodes[at];
            const int side = side_of(tree_, node.plane, point_);
            if (side == 0 && !inside(node.back)) return false;
            at = side < 0 ? node.back : node.front;
        }
        return at == solid_leaf;
    }

    bool first(double length, SolidEntry<D>& entry) {
        double from = 0, to = length;
        if (!clip(from, to)) return false;
        entry.started_inside = in_solid_ = inside(tree_.root);
        return enter(tree_.root, from, to, no_index, entry);
    }

private:
    /// Clips the ray to the box of the faces, with padding. False if it misses the box.
    bool clip(double& from, double& to) const {
        const double padding = 1e-6 * scale_;
        for (int i = 0; i < D; ++i) {
            const double low = static_cast<double>(tree_.bounds.min[i]) - padding - origin_[i];
            const double high = static_cast<double>(tree_.bounds.max[i]) + padding - origin_[i];
            if (direction_[i] == 0) {
                if (low > 0 || high < 0) return false;
                continue;
            }
            const double at_low = low / direction_[i], at_high = high / direction_[i];
            from = std::max(from, std::min(at_low, at_high));
            to = std::min(to, std::max(at_low, at_high));
        }
        return from <= to;
    }

    /// The ray interval [from, to], which entered through the plane of node `through`.
    bool enter(std::uint32_t at, double from, double to, std::uint32_t through, SolidEntry<D>& entry) {
        while (at < open_leaf) {
            const SolidNode<D>& node = tree_.nodes[at];
            const int side = side_of(tree_, node.plane, point_);
            const double slope = dot(node.plane.normal, direction_);
            const bool descends = slope < 0;
            if (side == 0 || slope == 0 || (side > 0) != descends) {
                // The ray doesn't cross the plane, or only at its start.
                const bool back = side < 0 || (side == 0 && descends);
                if (side == 0 && descends && from == 0) through = at;
                at = back ? node.back : node.front;
                continue;
            }
            const double height = std::abs(dot(node.plane.normal, origin_) - node.plane.offset);
            const double crossing = height / std::abs(slope);
            const std::uint32_t near = side > 0 ? node.front : node.back, beyond = side > 0 ? node.back : node.front;
            if (crossing >= to) {
                at = near;
                continue;
            }
            if (crossing >= from) {
                if (enter(near, from, crossing, through, entry)) return true;
                from = crossing;
                through = at;
            }
            at = beyond;
        }
        // An interval below rounding is a corner that the ray grazes.
        if (to - from <= min_interval_) return false;
        const bool comes_in = at == solid_leaf && !in_solid_;
        in_solid_ = at == solid_leaf;
        if (!comes_in || through == no_index) return false;
        write_entry(from, through, entry);
        return true;
    }

    void write_entry(double along, std::uint32_t through, SolidEntry<D>& entry) const {
        const SolidNode<D>& node = tree_.nodes[through];
        entry.along = along;
        entry.normal = dot(node.plane.normal, direction_) < 0 ? node.plane.normal : -node.plane.normal;
        double nearest = std::numeric_limits<double>::infinity();
        const DVec<D> place = origin_ + direction_ * along;
        for (std::uint32_t i = node.first_piece; i < node.first_piece + node.pieces; ++i) {
            const double beside = outside(tree_.pieces[i], node.plane, place);
            if (beside >= nearest) continue;
            nearest = beside;
            entry.face = tree_.pieces[i].face;
            entry.has_face = true;
        }
    }

    /// The signed distance of a point in the plane to a piece's outline, negative inside.
    double outside(const SolidPiece& piece, const SolidPlane<D>& plane, const DVec<D>& place) const {
        const auto corner = [&](std::uint32_t i) {
            return DVec<D>(tree_.corners[piece.first_corner + i % piece.corners]);
        };
        if constexpr (D == 2) {
            const DVec<2> along = normalized(corner(1) - corner(0));
            return std::max(dot(along, place - corner(1)), dot(along, corner(0) - place));
        } else {
            double max_left = -std::numeric_limits<double>::infinity(), max_right = max_left;
            for (std::uint32_t i = 0; i < piece.corners; ++i) {
                const DVec<3> along = corner(i + 1) - corner(i);
                const double left = dot(normalized(cross(plane.normal, along)), place - corner(i));
                max_left = std::max(max_left, left);
                max_right = std::max(max_right, -left);
            }
            return std::min(max_left, max_right);  // counter-clockwise from one side or the other
        }
    }

    const SolidTree<D>& tree_;
    Vec<D> point_;
    DVec<D> origin_, direction_;
    double scale_ = 0, min_interval_ = 0;
    bool in_solid_ = false;
};

}  // namespace

template <int D>
bool SolidBsp<D>::enter(const Vec<D>& origin, const DVec<D>& direction, double length, SolidEntry<D>& entry) const {
    const bool usable = is_finite(origin) && std::isfinite(abut::length(direction)) && !std::isnan(length);
    ABUT_ASSERT(usable);
    entry = {};
    return usable && length >= 0 && RayTraversal<D>(*tree_, origin, direction).first(length, entry);
}

template bool SolidBsp<2>::enter(const Vec2&, const DVec<2>&, double, SolidEntry<2>&) const;
template bool SolidBsp<3>::enter(const Vec3&, const DVec<3>&, double, SolidEntry<3>&) const;

}  // namespace abut
