#pragma once

// What a SolidBsp is made of, and how they are put together. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/solid_parts.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

inline constexpr std::uint32_t no_number = 0xffffffffu;
inline constexpr std::uint32_t solid_leaf = 0xfffffffeu, open_leaf = 0xfffffffdu;
inline constexpr std::size_t solid_depth = 256;

/// Open where dot(normal, p) > offset.
template <int D>
struct SolidPlane {
    DVec<D> normal{0.0};  ///< of any length
    double offset = 0;
    /// What dot(normal, p) - offset may be off by: doubt * sum of |p_i|, plus doubt_at_origin.
    double doubt = 0, doubt_at_origin = 0;
    std::uint32_t face = no_number;  ///< whose corners decide in doubt
};

template <int D>
struct SolidNode {
    SolidPlane<D> plane;
    std::uint32_t front = open_leaf, back = solid_leaf;  ///< nodes or leaves
    std::uint32_t first_piece = 0, pieces = 0;
};

/// A face or part of one, in the plane of its node.
struct SolidPiece {
    std::uint32_t face;
    std::uint32_t first_corner, corners;
};

template <int D>
struct SolidTree {
    std::vector<Vec<D>> points;                     // of the input, for the exact answers; none of brushes
    std::vector<glm::vec<D, std::uint32_t>> faces;  // the same
    std::vector<SolidNode<D>> nodes;
    std::vector<SolidPiece> pieces;
    std::vector<Vec<D>> corners;
    std::uint32_t root = open_leaf;
    std::size_t depth = 0;
    Aabb<D> bounds = Aabb<D>::empty();
    SolidParts<D> parts;
};

/// 1 in front of the plane, -1 behind it, 0 on it: exact where it is that of a face or across an axis, else to the
/// rounding of doubles.
template <int D>
int side_of(const SolidTree<D>& tree, const SolidPlane<D>& plane, const Vec<D>& point);

template <int D>
SolidPlane<D> plane_of_face(const SolidTree<D>& tree, std::uint32_t face);
template <int D>
SolidPlane<D> plane_of(const HalfSpace<D>& side);
template <int D>
SolidPlane<D> plane_across(int axis, float at);

/// A corner of a piece while the tree grows.
template <int D>
struct SolidCorner {
    DVec<D> position;
    std::uint32_t point = no_number;  ///< of the input, where it is one
};

/// A segment or a convex polygon, counter-clockwise seen from its front.
template <int D>
struct SolidFragment {
    std::uint32_t face = 0;
    std::vector<SolidCorner<D>> corners;
};

/// Corners no farther from a plane than `margin` are on it. The part in front and the part behind; one without extent
/// is empty. Whether neither is, and nothing is left of it.
template <int D>
struct CutFragment {
    SolidFragment<D> front, back;
    bool in_plane = false;
};
template <int D>
void cut(const SolidTree<D>& tree, const SolidPlane<D>& plane, double margin, SolidFragment<D>&& fragment,
         CutFragment<D>& result);

/// What is beside a place on a plane.
struct SolidSides {
    bool front = false, back = true;
};

template <int D>
struct SolidBuild {
    std::vector<SolidFragment<D>> fragments;
    double margin = 0;  ///< what corners that were calculated may be off by, and then some
    FunctionRef<SolidPlane<D>(std::uint32_t face)> plane;
    /// What is beside a place on the plane; nothing where another place would be better.
    FunctionRef<std::optional<SolidSides>(const DVec<D>& place, const SolidPlane<D>& plane)> sides;
};

/// Makes the nodes, pieces and corners.
template <int D>
void build_tree(SolidTree<D>& tree, SolidBuild<D> build);

}  // namespace abut
