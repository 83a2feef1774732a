#include <abut/convex/facets.hpp>
#include <abut/query/detail/solid/solid_surface.hpp>

#include <algorithm>
#include <tuple>

namespace abut::detail {
namespace {

/// The triangles of a box. Corners have bit i set at the low end of axis i.
constexpr std::array<std::array<std::uint32_t, 3>, 12> box_triangles{{
    {0, 2, 6},
    {0, 6, 4},
    {1, 5, 7},
    {1, 7, 3},  // x
    {0, 4, 5},
    {0, 5, 1},
    {2, 3, 7},
    {2, 7, 6},  // y
    {0, 1, 3},
    {0, 3, 2},
    {4, 6, 7},
    {4, 7, 5},  // z
}};

constexpr std::uint32_t side_after(std::uint32_t side) {
    return side == 2 ? 0 : side + 1;
}

}  // namespace

bool is_solid_mesh(const View<3>& shape) {
    const auto* composite = std::get_if<Composite<3>>(&shape);
    return composite != nullptr && composite->solid != nullptr;
}

bool is_solid_polytope(const View<3>& shape) {
    const auto* convex = std::get_if<Convex<3>>(&shape);
    if (convex == nullptr || convex->radius > 0 || convex->inner_radius > 0) return false;
    if (convex->core == Core::box) return convex->own[0].x > 0 && convex->own[0].y > 0 && convex->own[0].z > 0;
    // A flat polygon has two faces.
    return convex->core == Core::points && convex->facets != nullptr && convex->facets->loop_ends.size() > 2;
}

View<3> surface_view(const View<3>& shape) {
    if (!is_solid_mesh(shape)) return shape;
    Composite<3> surface = std::get<Composite<3>>(shape);
    surface.solid = nullptr;
    return surface;
}

SolidSurface::SolidSurface(const Convex<3>& polytope) {
    if (polytope.core == Core::box) {
        half_ = polytope.own[0];
        return;
    }
    facets_ = polytope.facets;
    points_ = polytope.vertices();
    point_count_ = polytope.count;
}

std::uint32_t SolidSurface::count_of_triangles() const {
    if (mesh_ != nullptr) return static_cast<std::uint32_t>(mesh_->triangles.size());
    if (facets_ == nullptr) return static_cast<std::uint32_t>(box_triangles.size());
    return static_cast<std::uint32_t>(facets_->loops.size() - 2 * facets_->loop_ends.size());
}

SolidSurface::FanTriangle SolidSurface::fan_triangle(std::uint32_t index) const {
    // A face of n corners has n - 2 triangles.
    const std::span<const std::uint32_t> ends = facets_->loop_ends;
    std::uint32_t low = 0, high = static_cast<std::uint32_t>(ends.size()) - 1;
    while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (ends[middle] - 2 * (middle + 1) <= index)
            low = middle + 1;
        else
            high = middle;
    }
    return {low, index - (low == 0 ? 0 : ends[low - 1] - 2 * low)};
}

std::array<std::uint32_t, 3> SolidSurface::triangle(std::uint32_t index) const {
    if (mesh_ != nullptr) {
        const glm::uvec3& t = mesh_->triangles[index];
        return {t.x, t.y, t.z};
    }
    if (facets_ == nullptr) return box_triangles[index];
    const FanTriangle fan = fan_triangle(index);
    const std::span<const std::uint32_t> loop = facets_->loop(fan.face);
    return {loop[0], loop[fan.number + 1], loop[fan.number + 2]};
}

Vec3 SolidSurface::position(std::uint32_t point) const {
    if (mesh_ != nullptr) return mesh_->points[point];
    if (facets_ != nullptr) return points_[point];
    return {(point & 1u) != 0 ? -half_.x : half_.x, (point & 2u) != 0 ? -half_.y : half_.y,
            (point & 4u) != 0 ? -half_.z : half_.z};
}

std::uint32_t SolidSurface::point_count() const {
    return mesh_ != nullptr ? static_cast<std::uint32_t>(mesh_->points.size()) : point_count_;
}

std::uint32_t SolidSurface::triangle_across(std::uint32_t from, std::uint32_t to) const {
    const auto wanted = std::pair(std::min(from, to), std::max(from, to));
    const auto edge = std::lower_bound(facets_->edges.begin(), facets_->edges.end(), wanted,
                                       [](const FacetEdge& e, const std::pair<std::uint32_t, std::uint32_t>& w) {
                                           return std::pair(e.from, e.to) < w;
                                       });
    if (edge == facets_->edges.end() || std::pair(edge->from, edge->to) != wanted) return no_neighbour;
    const std::uint32_t face = from < to ? edge->right : edge->left;
    const std::span<const std::uint32_t> loop = facets_->loop(face);
    const auto corner = static_cast<std::uint32_t>(std::find(loop.begin(), loop.end(), to) - loop.begin());
    const auto last = static_cast<std::uint32_t>(loop.size()) - 3;
    const std::uint32_t first = face == 0 ? 0 : facets_->loop_ends[face - 1] - 2 * face;
    return first + std::min(corner == 0 ? 0 : corner - 1, last);
}

std::uint32_t SolidSurface::neighbour(std::uint32_t index, std::uint32_t side) const {
    if (mesh_ != nullptr) return mesh_->adjacency.neighbours[index][side];
    const std::array<std::uint32_t, 3> t = triangle(index);
    const std::uint32_t from = t[side], to = t[side_after(side)];
    if (facets_ != nullptr) {
        const FanTriangle fan = fan_triangle(index);
        if (side == 0 && fan.number > 0) return index - 1;
        if (side == 2 && fan.number + 3 < facets_->loop(fan.face).size()) return index + 1;
        return triangle_across(from, to);
    }
    for (std::uint32_t other = 0; other < box_triangles.size(); ++other)
        for (std::uint32_t i = 0; i < 3; ++i)
            if (box_triangles[other][i] == to && box_triangles[other][side_after(i)] == from) return other;
    return no_neighbour;
}

void SolidSurface::each_triangle(const Aabb3& box, FunctionRef<bool(std::uint32_t triangle)> visit) const {
    if (mesh_ != nullptr)
        return find_overlapping(mesh_->tree, box, [&](std::uint32_t index) -> bool { return visit(index); });
    const auto visit_if_near = [&](std::uint32_t index, const std::array<std::uint32_t, 3>& t) {
        const Vec3 a = position(t[0]), b = position(t[1]), c = position(t[2]);
        const Aabb3 around{glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
        return !overlaps(around, box) || visit(index);
    };
    std::uint32_t index = 0;
    if (facets_ == nullptr) {
        while (index < box_triangles.size() && visit_if_near(index, box_triangles[index])) ++index;
        return;
    }
    for (std::uint32_t face = 0; face < facets_->loop_ends.size(); ++face) {
        const std::span<const std::uint32_t> loop = facets_->loop(face);
        for (std::size_t i = 2; i < loop.size(); ++i)
            if (!visit_if_near(index++, {loop[0], loop[i - 1], loop[i]})) return;
    }
}

std::span<const std::uint32_t> SolidSurface::components() const {
    static constexpr std::uint32_t first = 0;
    return mesh_ != nullptr ? std::span<const std::uint32_t>(mesh_->components) : std::span(&first, 1);
}

Aabb3 SolidSurface::box() const {
    if (mesh_ != nullptr) return mesh_->tree.root(0).box;
    Aabb3 result = Aabb3::empty();
    for (std::uint32_t i = 0; i < point_count_; ++i) result = merged(result, Aabb3{position(i), position(i)});
    return result;
}

}  // namespace abut::detail
