#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/polyhedron_data.hpp>
#include <abut/shape/polyhedron.hpp>

#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr Vec3 origin3(0.0f);
constexpr Facets no_facets;

}  // namespace

Result<Polyhedron> Polyhedron::build(const PointSpan<3>& points) {
    return build(points, HullOptions());
}

Result<Polyhedron> Polyhedron::build(const PointSpan<3>& points, const HullOptions& options) {
    detail::enter_library();
    Result<Hull3> built = limited_hull(PackedPoints<3>(points).points(), options);
    if (!built) return built.problem();
    Polyhedron result;
    result.data_ = std::make_shared<const Data>(*std::move(built));
    return result;
}

Result<Polyhedron> Polyhedron::build(std::initializer_list<Vec3> points) {
    return build(std::span<const Vec3>(points.begin(), points.size()));
}

std::span<const Vec3> Polyhedron::points() const {
    return data_ ? std::span<const Vec3>(data_->hull.points) : std::span<const Vec3>(&origin3, 1);
}

const Facets& Polyhedron::facets() const {
    return data_ ? data_->facets : no_facets;
}

std::span<const double> Polyhedron::offsets() const {
    return data_ ? std::span<const double>(data_->hull.offsets) : std::span<const double>();
}

int Polyhedron::rank() const {
    return data_ ? data_->hull.rank : 0;
}

double Polyhedron::volume() const {
    detail::enter_library();
    return data_ ? data_->hull.volume : 0;
}

double Polyhedron::area() const {
    detail::enter_library();
    return data_ ? data_->hull.area : 0;
}

Vec3 Polyhedron::centroid() const {
    detail::enter_library();
    return data_ ? data_->hull.centroid : origin3;
}

BoundingBall<3> Polyhedron::ball() const {
    detail::enter_library();
    return data_ ? data_->ball : BoundingBall<3>();
}

const PointSoa* Polyhedron::lanes() const {
    return data_ && fits_soa(data_->lanes) ? &data_->lanes : nullptr;
}

Vec3 Polyhedron::normal() const {
    detail::enter_library();
    const std::span<const Vec3> corners = points();
    if (rank() == 0) return to_float(axis<3>(0));
    if (rank() == 1) return to_float(perpendicular(DVec<3>(corners[1]) - DVec<3>(corners[0])));
    std::size_t largest_face = 0;
    double largest_area = 0;
    for (std::size_t face = 0; face < facets().normals.size(); ++face) {
        const std::span<const std::uint32_t> loop = facets().loop(face);
        const DVec<3> origin(corners[loop[0]]);
        DVec<3> area(0.0);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            area += cross(DVec<3>(corners[loop[i]]) - origin, DVec<3>(corners[loop[i + 1]]) - origin);
        if (length_squared(area) > largest_area) {
            largest_area = length_squared(area);
            largest_face = face;
        }
    }
    return facets().normals[largest_face];
}

Convex<3> convex(const Polyhedron& polyhedron, const Affine<3>& place) {
    Convex<3> result;
    result.place = place;
    const std::span<const Vec3> points = polyhedron.points();
    result.points = points.data();
    result.count = static_cast<std::uint32_t>(points.size());
    result.lanes = polyhedron.lanes();
    if (!polyhedron.facets().normals.empty()) result.facets = &polyhedron.facets();
    return result;
}

}  // namespace abut
