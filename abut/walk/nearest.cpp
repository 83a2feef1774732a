#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/walk/data.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/nearest_on.hpp>
#include <abut/walk/nearest_search.hpp>

namespace abut {

using namespace detail;

namespace {

/// A fallback for points that are not finite.
WalkPoint somewhere(const WalkMeshData& data) {
    return {data.tree.order[0], {1, 0, 0}};
}

WalkPoint place_of(const WalkMeshData& data, const Vec3& point, const NearestTriangle& nearest) {
    const Triangle3 triangle = data.tree.leaves[nearest.leaf].at(nearest.lane);
    const NearestOnTriangle on = nearest_on(triangle, DVec<3>(point));
    return {nearest.triangle, quantised_weights(on.second, on.third)};
}

}  // namespace

WalkPoint WalkMesh::nearest(const Vec3& point) const {
    detail::enter_library();
    const bool finite = is_finite(point);
    ABUT_ASSERT(finite);
    if (!finite) return somewhere(*data_);
    NearestTriangle nearest;
    find_nearest(data_->tree, point, NearestTriangle::none, nearest);
    return place_of(*data_, point, nearest);
}

WalkPoint WalkMesh::nearest(const Vec3& point, const WalkPoint& last) const {
    detail::enter_library();
    const bool finite = is_finite(point), known = last.triangle < data_->leaf_of.size();
    ABUT_ASSERT(finite && known);
    if (!finite) return somewhere(*data_);
    NearestTriangle nearest;
    find_nearest(data_->tree, point, known ? data_->leaf_of[last.triangle] : NearestTriangle::none, nearest);
    return place_of(*data_, point, nearest);
}

std::optional<WalkPoint> WalkMesh::nearest(const Vec3& point, float reach) const {
    detail::enter_library();
    const bool finite = is_finite(point);
    ABUT_ASSERT(finite);
    if (!finite || !(reach >= 0)) return std::nullopt;
    const double twice = 2 * static_cast<double>(reach);
    NearestTriangle nearest{.square = twice * twice};
    find_nearest(data_->tree, point, NearestTriangle::none, nearest);
    if (!nearest.is_found()) return std::nullopt;
    return place_of(*data_, point, nearest);
}

}  // namespace abut
