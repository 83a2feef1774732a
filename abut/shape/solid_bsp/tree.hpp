#pragma once

// The data of a SolidBsp and the interface of its builders. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/solid_bsp/parts.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace abut::detail {

inline constexpr std::uint32_t solid_leaf = 0xfffffffeu, open_leaf = 0xfffffffdu;
inline constexpr std::size_t solid_depth = 256;

/// A splitting plane; open where dot(normal, p) > offset.
template <int D>
struct SolidPlane {
    DVec<D> normal{0.0};  ///< not normalised
    double offset = 0;
    /// The error bound of dot(normal, p) - offset: relative_error * sum of |p_i|, plus error_at_origin.
    double relative_error = 0, error_at_origin = 0;
    std::uint32_t face = no_index;  ///< its corners decide exactly within the error bound
};

template <int D>
struct SolidNode {
    SolidPlane<D> plane;
    std::uint32_t front = open_leaf, back = solid_leaf;  ///< nodes or leaves
    std::uint32_t first_piece = 0, pieces = 0;
};

/// A face or a part of one, in the plane of its node.
struct SolidPiece {
    std::uint32_t face;
    std::uint32_t first_corner, corners;
};

template <int D>
struct SolidTree {
    std::vector<Vec<D>> points;                     // the input's points, for exact predicates; empty for brushes
    std::vector<glm::vec<D, std::uint32_t>> faces;  // the input's faces; empty for brushes
    std::vector<SolidNode<D>> nodes;
    std::vector<SolidPiece> pieces;
    std::vector<Vec<D>> corners;
    std::uint32_t root = open_leaf;
    std::size_t depth = 0;
    Aabb<D> bounds = Aabb<D>::empty();
    SolidParts<D> parts;
};

/// 1 in front of the plane, -1 behind it, 0 on it. Exact for planes of faces and axis-aligned planes, else to the
/// rounding of doubles.
template <int D>
int side_of(const SolidTree<D>& tree, const SolidPlane<D>& plane, const Vec<D>& point);

template <int D>
SolidPlane<D> plane_of_face(const SolidTree<D>& tree, std::uint32_t face);
template <>
SolidPlane<2> plane_of_face(const SolidTree<2>& tree, std::uint32_t face);
template <>
SolidPlane<3> plane_of_face(const SolidTree<3>& tree, std::uint32_t face);
template <int D>
SolidPlane<D> plane_of(const HalfSpace<D>& side);
template <int D>
SolidPlane<D> plane_across(int axis, float at);

/// A corner of a piece during the build.
template <int D>
struct SolidCorner {
    DVec<D> position;
    std::uint32_t point = no_index;  ///< input point, if it is one
};

/// A segment, or a convex polygon that is counter-clockwise seen from its front.
template <int D>
struct SolidFragment {
    std::uint32_t face = 0;
    std::vector<SolidCorner<D>> corners;
};

/// The parts of a fragment in front of a plane and behind it; a part without extent is empty. `in_plane` is true if all
/// corners are within `margin` of the plane.
template <int D>
struct CutFragment {
    SolidFragment<D> front, back;
    bool in_plane = false;
};
template <int D>
void cut(const SolidTree<D>& tree, const SolidPlane<D>& plane, double margin, SolidFragment<D>&& fragment,
         CutFragment<D>& result);

/// Whether the space in front of a plane and behind it is solid, at a point of the plane.
struct SolidSides {
    bool front = false, back = true;
};

template <int D>
struct SolidBuild {
    std::vector<SolidFragment<D>> fragments;
    double margin = 0;  ///< error bound of computed corners, with a safety factor
    FunctionRef<SolidPlane<D>(std::uint32_t face)> plane;
    /// The two sides of the plane at a point; nothing if another point should be tried.
    FunctionRef<std::optional<SolidSides>(const DVec<D>& place, const SolidPlane<D>& plane)> sides;
};

/// Builds the nodes, pieces and corners.
template <int D>
void build_tree(SolidTree<D>& tree, SolidBuild<D> build);

/// Adds a part for each subtree that is entirely solid, numbered from 0 in tree order, back before front. An unbounded
/// solid is clipped at the width of the faces' bounds beyond them. Vertices within `margin` of a plane are on it.
template <int D>
void add_cells(SolidTree<D>& tree, double margin);

}  // namespace abut::detail
