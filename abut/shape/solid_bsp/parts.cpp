#include <abut/convex/hull/hull.hpp>
#include <abut/convex/point_soa.hpp>
#include <abut/convex/polygon_soa.hpp>
#include <abut/shape/solid_bsp/parts.hpp>

#include <cmath>

namespace abut::detail {
namespace {

/// The origin of a part's local frame: a multiple of a power of two that is at least twice the part's extent. Float
/// corners keep all their bits, and other corners keep more bits than a float at that distance.
template <int D>
DVec<D> origin_of(std::span<const DVec<D>> corners) {
    const auto [low, high] = min_max<D>(corners);
    DVec<D> result(0.0);
    const double extent = largest(high - low);
    if (extent == 0) return result;
    const double step = std::ldexp(4.0, std::ilogb(extent));
    for (int i = 0; i < D; ++i) result[i] = std::trunc(0.5 * (low[i] + high[i]) / step) * step;
    return result;
}

}  // namespace

bool SolidHulls<2>::add(std::span<const Vec2> points) {
    const Result<Hull2> built = hull(points);
    if (!built || built->rank < 1) return false;
    const auto count = static_cast<std::uint32_t>(built->points.size());
    hulls_.push_back({static_cast<std::uint32_t>(points_.size()), count, static_cast<std::uint32_t>(sides_.size())});
    points_.insert(points_.end(), built->points.begin(), built->points.end());
    if (count > 2 && count <= max_soa_edges) {
        sides_.resize(sides_.size() + soa_size(count));
        write_polygon_soa(built->points, sides_.data() + hulls_.back().first_number);
    }
    return true;
}

void SolidHulls<2>::write(std::size_t index, Convex<2>& part) const {
    const Hull& hull = hulls_[index];
    part.points = points_.data() + hull.first_point;
    part.count = hull.points;
    part.sides = hull.points > 2 && hull.points <= max_soa_edges ? sides_.data() + hull.first_number : nullptr;
}

bool SolidHulls<3>::add(std::span<const Vec3> points) {
    const Result<Hull3> built = hull(points);
    if (!built || built->rank < 2) return false;
    hulls_.push_back(end());
    const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(points_, built->points);
    append(normals_, built->normals);
    append(offsets_, built->offsets);
    append(loops_, built->loops);
    append(loop_ends_, built->loop_ends);
    append(edges_, built->edges);
    columns_.resize(columns_.size() + 3 * padded_count(built->points.size()));
    return true;
}

void SolidHulls<3>::finish() {
    // Vectors that grew by appending have spare capacity.
    points_.shrink_to_fit();
    normals_.shrink_to_fit();
    offsets_.shrink_to_fit();
    columns_.shrink_to_fit();
    loops_.shrink_to_fit();
    loop_ends_.shrink_to_fit();
    edges_.shrink_to_fit();
    const auto part_of = [](const auto& all, std::size_t from, std::size_t to) {
        return std::span(all).subspan(from, to - from);
    };
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
        const Hull& from = hulls_[i];
        const Hull to = i + 1 < hulls_.size() ? hulls_[i + 1] : end();
        facets_.push_back({part_of(normals_, from.face, to.face), part_of(loops_, from.loop, to.loop),
                           part_of(loop_ends_, from.face, to.face), part_of(edges_, from.edge, to.edge),
                           part_of(offsets_, from.face, to.face)});
        lanes_.push_back(make_soa(part_of(points_, from.point, to.point), columns_.data() + from.column));
    }
}

void SolidHulls<3>::write(std::size_t index, Convex<3>& part) const {
    part.points = points_.data() + hulls_[index].point;
    part.count = lanes_[index].count;
    part.facets = &facets_[index];
    part.lanes = fits_soa(lanes_[index]) ? &lanes_[index] : nullptr;
}

template <int D>
void SolidParts<D>::add(std::span<const DVec<D>> corners, std::uint32_t number) {
    if (corners.empty()) return;
    const DVec<D> origin = origin_of(corners);
    std::vector<Vec<D>> points;
    points.reserve(corners.size());
    for (const DVec<D>& corner : corners) points.push_back(to_float(corner - origin));
    if (hulls_.add(points)) places_.push_back({origin, number});
}

template <int D>
void SolidParts<D>::finish() {
    hulls_.finish();
    places_.shrink_to_fit();
    tree_.build(boxes());
}

template <int D>
std::vector<Aabb<D>> SolidParts<D>::boxes() const {
    std::vector<Aabb<D>> result;
    result.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) result.push_back(detail::bounds(part(i)));
    return result;
}

template <int D>
Convex<D> SolidParts<D>::part(std::size_t index) const {
    Convex<D> result;
    result.place.offset = places_[index].origin;
    hulls_.write(index, result);
    return result;
}

template <int D>
void SolidParts<D>::each_part(const Aabb<D>& box, PartVisitor<D> visit) const {
    tree_.each_overlapping(box, [&](std::uint32_t index) -> bool { return visit(part(index), places_[index].number); });
}

template <int D>
void SolidParts<D>::each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const {
    tree_.sweep(box, [&](std::uint32_t index) -> float { return visit(part(index), places_[index].number); });
}

template <int D>
void SolidParts<D>::each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const {
    tree_.closest(box, [&](std::uint32_t index) -> float { return visit(part(index), places_[index].number); });
}

template class SolidParts<2>;
template class SolidParts<3>;

}  // namespace abut::detail
