#include <abut/math/predicates.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <cmath>

namespace abut::detail {
namespace {

/// Twice the sum of the roundings in a plane and in a height above it.
constexpr double rounding = 0x1p-48;

int exact_side(const SolidTree<2>& tree, std::uint32_t face, const Vec2& p) {
    const glm::uvec2& f = tree.faces[face];
    return -orientation(tree.points[f.x], tree.points[f.y], p);
}
int exact_side(const SolidTree<3>& tree, std::uint32_t face, const Vec3& p) {
    const glm::uvec3& f = tree.faces[face];
    return orientation(tree.points[f.x], tree.points[f.y], tree.points[f.z], p);
}

template <int D>
double sum_of_magnitudes(const DVec<D>& v) {
    double result = 0;
    for (int i = 0; i < D; ++i) result += std::abs(v[i]);
    return result;
}

template <int D>
SolidPlane<D> plane_through(const DVec<D>& normal, double magnitude, const DVec<D>& point, std::uint32_t face) {
    const double relative_error = rounding * magnitude;
    return {normal, dot(normal, point), relative_error, relative_error * sum_of_magnitudes<D>(point), face};
}

/// True if the extent of the fragment exceeds the rounding error.
bool has_extent(const SolidFragment<2>& fragment, double margin) {
    return fragment.corners.size() == 2 && length(fragment.corners[1].position - fragment.corners[0].position) > margin;
}
bool has_extent(const SolidFragment<3>& fragment, double margin) {
    if (fragment.corners.size() < 3) return false;
    DVec<3> area(0.0);
    double longest = 0;
    const DVec<3>& a = fragment.corners[0].position;
    for (std::size_t i = 1; i + 1 < fragment.corners.size(); ++i) {
        const DVec<3> ab = fragment.corners[i].position - a, ac = fragment.corners[i + 1].position - a;
        area += cross(ab, ac);
        longest = std::max({longest, length(ab), length(ac)});
    }
    return length(area) > margin * longest;
}

}  // namespace

template <int D>
int side_of(const SolidTree<D>& tree, const SolidPlane<D>& plane, const Vec<D>& point) {
    const DVec<D> p(point);
    const double height = dot(plane.normal, p) - plane.offset;
    if (std::abs(height) > plane.relative_error * sum_of_magnitudes<D>(p) + plane.error_at_origin)
        return height > 0 ? 1 : -1;
    return plane.face == no_index ? 0 : exact_side(tree, plane.face, point);
}

template <>
SolidPlane<2> plane_of_face(const SolidTree<2>& tree, std::uint32_t face) {
    const DVec<2> a(tree.points[tree.faces[face].x]), along = DVec<2>(tree.points[tree.faces[face].y]) - a;
    return plane_through<2>({along.y, -along.x}, largest(along), a, face);
}
template <>
SolidPlane<3> plane_of_face(const SolidTree<3>& tree, std::uint32_t face) {
    const glm::uvec3& f = tree.faces[face];
    const DVec<3> a(tree.points[f.x]), ab = DVec<3>(tree.points[f.y]) - a, ac = DVec<3>(tree.points[f.z]) - a;
    return plane_through<3>(cross(ab, ac), 2 * largest(ab) * largest(ac), a, face);
}

template <int D>
SolidPlane<D> plane_of(const HalfSpace<D>& side) {
    const DVec<D> normal(side.normal);
    const double offset = static_cast<double>(side.offset);
    return {normal, offset, rounding * largest(normal), rounding * std::abs(offset), no_index};
}

template <int D>
SolidPlane<D> plane_across(int axis, float at) {
    return {detail::axis<D>(axis), static_cast<double>(at), 0, 0, no_index};
}

template <int D>
void cut(const SolidTree<D>& tree, const SolidPlane<D>& plane, double margin, SolidFragment<D>&& fragment,
         CutFragment<D>& result) {
    const double tolerance = margin * length(plane.normal);
    const auto height = [&](const SolidCorner<D>& corner) { return dot(plane.normal, corner.position) - plane.offset; };
    const auto side = [&](const SolidCorner<D>& corner) {
        if (corner.point != no_index) return side_of(tree, plane, tree.points[corner.point]);
        const double above = height(corner);
        return above > tolerance ? 1 : above < -tolerance ? -1 : 0;
    };
    bool in_front = false, behind = false;
    for (const SolidCorner<D>& corner : fragment.corners) {
        const int which = side(corner);
        in_front = in_front || which > 0;
        behind = behind || which < 0;
    }
    result.in_plane = !in_front && !behind;
    result.front.corners.clear();
    result.back.corners.clear();
    result.front.face = result.back.face = fragment.face;
    if (result.in_plane || !behind) {
        result.front = std::move(fragment);
        return;
    }
    if (!in_front) {
        result.back = std::move(fragment);
        return;
    }
    const std::size_t count = fragment.corners.size(), edges = D == 2 ? 1 : count;
    for (std::size_t i = 0; i < count; ++i) {
        const SolidCorner<D>&corner = fragment.corners[i], &next = fragment.corners[(i + 1) % count];
        const int here = side(corner), there = i < edges ? side(next) : 0;
        if (here >= 0) result.front.corners.push_back(corner);
        if (here <= 0) result.back.corners.push_back(corner);
        if (here * there >= 0) continue;
        // Rounding may give a height the opposite sign of the exact side.
        const double above = std::abs(height(corner)), below = std::abs(height(next)), both = above + below;
        const double part = both > 0 ? above / both : 0.5;
        const SolidCorner<D> between{corner.position + (next.position - corner.position) * part, no_index};
        result.front.corners.push_back(between);
        result.back.corners.push_back(between);
    }
    if (!has_extent(result.front, margin)) result.front.corners.clear();
    if (!has_extent(result.back, margin)) result.back.corners.clear();
}

#define ABUT_INSTANTIATE(D)                                                         \
    template int side_of(const SolidTree<D>&, const SolidPlane<D>&, const Vec<D>&); \
    template SolidPlane<D> plane_of(const HalfSpace<D>&);                           \
    template SolidPlane<D> plane_across(int, float);                                \
    template void cut(const SolidTree<D>&, const SolidPlane<D>&, double, SolidFragment<D>&&, CutFragment<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
