#include <abut/convex/hull.hpp>
#include <abut/shape/polyhedron.hpp>

#include <utility>

namespace abut {
namespace {

constexpr Vec3 zero(0.0f);
constexpr Facets no_facets;

}  // namespace

struct Polyhedron::Data {
    explicit Data(Hull3 built) : hull(std::move(built)), facets{hull.normals, hull.loops, hull.loop_ends, hull.edges} {}
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;

    Hull3 hull;
    Facets facets;  ///< refers to `hull`
};

Result<Polyhedron> Polyhedron::build(std::span<const Vec3> points) {
    Result<Hull3> built = hull(points);
    if (!built) return built.problem();
    Polyhedron result;
    result.data_ = std::make_shared<const Data>(*std::move(built));
    return result;
}

Result<Polyhedron> Polyhedron::build(std::initializer_list<Vec3> points) {
    return build(std::span<const Vec3>(points.begin(), points.size()));
}

std::span<const Vec3> Polyhedron::points() const {
    return data_ ? std::span<const Vec3>(data_->hull.points) : std::span<const Vec3>(&zero, 1);
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
    return data_ ? data_->hull.volume : 0;
}

double Polyhedron::area() const {
    return data_ ? data_->hull.area : 0;
}

Vec3 Polyhedron::centroid() const {
    return data_ ? data_->hull.centroid : zero;
}

Convex<3> convex(const Polyhedron& polyhedron) {
    Convex<3> result;
    const std::span<const Vec3> points = polyhedron.points();
    result.points = points.data();
    result.count = static_cast<std::uint32_t>(points.size());
    if (!polyhedron.facets().normals.empty()) result.facets = &polyhedron.facets();
    return result;
}

}  // namespace abut
