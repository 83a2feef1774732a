// Solid BSP trees from brushes: the faces of a brush are its side planes, clipped by the other sides.

#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <cmath>
#include <string>

namespace abut {

using namespace detail;

namespace {

/// A brush is unbounded if a vertex is farther away than this times the farthest side.
constexpr double unbounded_factor = 32;

/// An orthonormal basis of the plane of a side.
std::vector<DVec<2>> span_of(const DVec<2>& normal) {
    return {perpendicular(normal)};
}
std::vector<DVec<3>> span_of(const DVec<3>& normal) {
    const DVec<3> first = perpendicular(normal);
    return {first, normalized(cross(normal, first))};
}

/// A large polygon in the plane, counter-clockwise seen from in front.
template <int D>
SolidFragment<D> large_face(std::uint32_t face, const SolidPlane<D>& plane, double reach) {
    const DVec<D> middle = plane.normal * (plane.offset / dot(plane.normal, plane.normal));
    const std::vector<DVec<D>> along = span_of(plane.normal);
    SolidFragment<D> result{face, {}};
    if constexpr (D == 2)
        for (const double sign : {-reach, reach}) result.corners.push_back({middle + along[0] * sign});
    else
        for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            result.corners.push_back({middle + along[0] * (u * reach) + along[1] * (v * reach)});
    return result;
}

template <int D>
class Brushes {
public:
    Brushes(std::span<const HalfSpace<D>> sides, std::span<const std::uint32_t> ends) : ends_(ends) {
        planes_.reserve(sides.size());
        for (const HalfSpace<D>& side : sides) planes_.push_back(plane_of(side));
    }

    const SolidPlane<D>& plane(std::uint32_t side) const { return planes_[side]; }
    double margin() const { return margin_; }

    /// Adds the faces of a brush, none if it has zero volume. Returns false if it is unbounded.
    bool add_faces(std::size_t brush, std::vector<SolidFragment<D>>& fragments, SolidParts<D>& parts) {
        double farthest = 0;
        for (std::uint32_t i = begin(brush); i < ends_[brush]; ++i)
            farthest = std::max(farthest, std::abs(planes_[i].offset) / length(planes_[i].normal));
        const double reach = 4 * unbounded_factor * farthest, margin = 0x1p-44 * reach;
        margin_ = std::max(margin_, margin);
        Aabb<D> box = Aabb<D>::empty();
        const std::size_t first = fragments.size();
        for (std::uint32_t i = begin(brush); i < ends_[brush]; ++i) {
            SolidFragment<D> face = face_of(brush, i, reach, margin);
            if (face.corners.empty()) continue;
            for (const SolidCorner<D>& corner : face.corners) {
                if (largest(corner.position) > unbounded_factor * farthest) return false;
                const Vec<D> point = to_float(corner.position);
                box = merged(box, grown(Aabb<D>{point, point}, static_cast<float>(margin)));
            }
            fragments.push_back(std::move(face));
        }
        // A closed surface needs at least D + 1 faces.
        if (fragments.size() - first <= static_cast<std::size_t>(D)) {
            fragments.resize(first);
            box = Aabb<D>::empty();
        }
        boxes_.push_back(box);
        std::vector<DVec<D>> corners;
        for (std::size_t i = first; i < fragments.size(); ++i)
            for (const SolidCorner<D>& corner : fragments[i].corners) corners.push_back(corner.position);
        parts.add(corners, static_cast<std::uint32_t>(brush));
        return true;
    }

    void index() { tree_.build(boxes_); }

    std::optional<SolidSides> beside(const DVec<D>& place, const SolidPlane<D>& plane) const {
        SolidSides result{false, false};
        bool is_certain = true;
        const Vec<D> point = to_float(place);
        tree_.each_overlapping(grown(Aabb<D>{point, point}, 0.0f), [&](std::uint32_t brush) -> bool {
            SolidSides here{true, true};
            for (std::uint32_t i = begin(brush); i < ends_[brush]; ++i) {
                const double size = length(planes_[i].normal);
                const double height = dot(planes_[i].normal, place) - planes_[i].offset;
                if (std::abs(height) > margin_ * size) {
                    if (height > 0) here = {false, false};
                    continue;
                }
                const double along = dot(planes_[i].normal, plane.normal) / (size * length(plane.normal));
                if (1 - std::abs(along) > 1e-9) return is_certain = false;
                (along > 0 ? here.front : here.back) = false;
            }
            result.front = result.front || here.front;
            result.back = result.back || here.back;
            return true;
        });
        if (!is_certain) return std::nullopt;
        return result;
    }

private:
    std::uint32_t begin(std::size_t brush) const { return brush == 0 ? 0 : ends_[brush - 1]; }

    /// Of coplanar sides the first one has the face.
    SolidFragment<D> face_of(std::size_t brush, std::uint32_t side, double reach, double margin) const {
        SolidFragment<D> face = large_face<D>(side, planes_[side], reach);
        CutFragment<D> parts;
        for (std::uint32_t i = begin(brush); i < ends_[brush] && !face.corners.empty(); ++i) {
            if (i == side) continue;
            cut(no_points_, planes_[i], margin, std::move(face), parts);
            face = std::move(parts.back);
            if (!parts.in_plane) continue;
            face = std::move(parts.front);
            if (i < side || dot(planes_[i].normal, planes_[side].normal) < 0) face.corners.clear();
        }
        return face;
    }

    const SolidTree<D> no_points_;
    std::span<const std::uint32_t> ends_;
    std::vector<SolidPlane<D>> planes_;
    std::vector<Aabb<D>> boxes_;
    Bvh<D> tree_;
    double margin_ = 0;
};

template <int D>
std::optional<Problem> problem_of(std::span<const HalfSpace<D>> sides, std::span<const std::uint32_t> ends) {
    if (ends.empty()) return Problem{ProblemCode::empty_input, "a level needs at least one brush", 0};
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (!is_finite(sides[i].normal) || !std::isfinite(sides[i].offset))
            return Problem{ProblemCode::not_finite,
                           "half-space " + std::to_string(i) + " has a number that is not finite", i};
        if (largest(DVec<D>(sides[i].normal)) == 0)
            return Problem{ProblemCode::degenerate, "half-space " + std::to_string(i) + " has no normal", i};
    }
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (ends[i] > sides.size() || (i > 0 && ends[i] < ends[i - 1]))
            return Problem{ProblemCode::index_out_of_range,
                           "brush " + std::to_string(i) + " ends at " + std::to_string(ends[i]) + " of " +
                               std::to_string(sides.size()) + " half-spaces, or before it begins",
                           i};
    return std::nullopt;
}

}  // namespace

template <int D>
Result<SolidBsp<D>> SolidBsp<D>::from_brushes(std::span<const HalfSpace<D>> sides,
                                              std::span<const std::uint32_t> ends) {
    if (auto problem = problem_of<D>(sides, ends)) return *std::move(problem);
    Brushes<D> brushes(sides, ends);
    auto tree = std::make_shared<SolidTree<D>>();
    std::vector<SolidFragment<D>> fragments;
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (!brushes.add_faces(i, fragments, tree->parts))
            return Problem{ProblemCode::bad_argument, "brush " + std::to_string(i) + " has no bound", i};
    brushes.index();
    tree->parts.finish();
    const auto plane = [&](std::uint32_t side) { return brushes.plane(side); };
    const auto beside = [&](const DVec<D>& place, const SolidPlane<D>& at) { return brushes.beside(place, at); };
    build_tree<D>(*tree, {std::move(fragments), brushes.margin(), plane, beside});
    return SolidBsp(std::move(tree));
}

template Result<SolidBsp<2>> SolidBsp<2>::from_brushes(std::span<const HalfSpace2>, std::span<const std::uint32_t>);
template Result<SolidBsp<3>> SolidBsp<3>::from_brushes(std::span<const HalfSpace3>, std::span<const std::uint32_t>);

}  // namespace abut
