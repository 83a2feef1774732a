#pragma once

// The adjacency of the triangles of a walk mesh, from the positions of the ends of their edges, and vectors of any
// number type. Only the triangles and points of the mesh are used.

#include <abut/math/dvec.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace abut::oracle {

using detail::dot;
using detail::length;
using detail::unit;

template <class Real>
struct RealVec3 {
    Real x = 0, y = 0, z = 0;

    RealVec3() = default;
    RealVec3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
    explicit RealVec3(const Vec3& v)
        : x(static_cast<Real>(v.x)), y(static_cast<Real>(v.y)), z(static_cast<Real>(v.z)) {}

    friend RealVec3 operator+(const RealVec3& a, const RealVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend RealVec3 operator-(const RealVec3& a, const RealVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend RealVec3 operator*(const RealVec3& a, const Real& s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Real dot(const RealVec3& a, const RealVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend RealVec3 cross(const RealVec3& a, const RealVec3& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    friend Real length(const RealVec3& a) {
        using std::sqrt;
        return sqrt(dot(a, a));
    }
    friend RealVec3 unit(const RealVec3& a) { return a * (1 / length(a)); }
    detail::DVec<3> rounded() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
};

/// The triangle across each edge, by the positions of the corners. At a non-manifold edge the two triangles with the
/// flattest dihedral angle are adjacent, then the flattest two of the rest.
class TriangleAdjacency {
public:
    using Allow = std::function<bool(const WalkSide& from, const WalkSide& to)>;

    explicit TriangleAdjacency(const WalkMesh& mesh, const Allow& allow = nullptr) {
        std::map<std::array<float, 3>, std::uint32_t> known;
        for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = mesh.points()[mesh.triangles()[t][k]] + Vec3(0.0f);
                const auto [where, is_new] =
                    known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(known.size()));
                corners_.push_back(p);
                vertices_.push_back(where->second);
            }
            walkable_.push_back(mesh.is_walkable(t));
        }
        join(allow);
    }

    std::uint32_t size() const { return static_cast<std::uint32_t>(walkable_.size()); }
    bool is_walkable(std::uint32_t triangle) const { return walkable_[triangle]; }
    const Vec3& corner(std::uint32_t triangle, std::uint32_t k) const { return corners_[3 * triangle + k % 3]; }
    /// The index of the corner's position.
    std::uint32_t vertex(std::uint32_t triangle, std::uint32_t k) const { return vertices_[3 * triangle + k % 3]; }
    /// The half-edge across a side. Its triangle is no_walk_side at a border, and where `allow` forbids the step.
    const WalkSide& across(std::uint32_t triangle, std::uint32_t side) const { return across_[3 * triangle + side]; }

private:
    void join(const Allow& allow) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<WalkSide>> edges;
        for (std::uint32_t t = 0; t < size(); ++t)
            for (std::uint32_t k = 0; k < 3 && walkable_[t]; ++k)
                edges[std::minmax(vertex(t, k), vertex(t, k + 1))].push_back({t, k});
        across_.resize(3 * walkable_.size());
        const auto link = [&](const WalkSide& from, const WalkSide& to) {
            if (!allow || allow(from, to)) across_[3 * from.triangle + from.side] = to;
        };
        for (const auto& [ends, sides] : edges) {
            std::vector<std::tuple<long double, std::size_t, std::size_t>> dihedral_cosines;
            for (std::size_t a = 0; a < sides.size(); ++a)
                for (std::size_t b = a + 1; b < sides.size(); ++b)
                    dihedral_cosines.emplace_back(dot(inwards(sides[a]), inwards(sides[b])), a, b);
            std::sort(dihedral_cosines.begin(), dihedral_cosines.end());
            std::vector<bool> taken(sides.size(), false);
            for (const auto& [cosine, a, b] : dihedral_cosines) {
                if (taken[a] || taken[b]) continue;
                taken[a] = taken[b] = true;
                link(sides[a], sides[b]);
                link(sides[b], sides[a]);
            }
        }
    }
    RealVec3<long double> inwards(const WalkSide& side) const {
        const RealVec3<long double> a(corner(side.triangle, side.side));
        const RealVec3<long double> along = unit(RealVec3<long double>(corner(side.triangle, side.side + 1)) - a);
        const RealVec3<long double> other = RealVec3<long double>(corner(side.triangle, side.side + 2)) - a;
        return unit(other - along * dot(along, other));
    }

    std::vector<Vec3> corners_;
    std::vector<std::uint32_t> vertices_;
    std::vector<bool> walkable_;
    std::vector<WalkSide> across_;
};

}  // namespace abut::oracle
