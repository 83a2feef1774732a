#pragma once

// The convex pieces that a solid level is made of, packed: what overlaps and distances are asked of. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/convex/facets.hpp>
#include <abut/convex/support.hpp>
#include <abut/shape/view.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Hulls one after the other in a few arrays.
template <int D>
class SolidHulls;

template <>
class SolidHulls<2> {
public:
    /// Takes the hull of some points, unless it has no length.
    bool add(std::span<const Vec2> points);
    void finish() {}
    /// `part` is made of the hull of this number, and refers to it.
    void write(std::size_t index, Convex<2>& part) const;

private:
    struct Hull {
        std::uint32_t first_point, points, first_number;
    };
    std::vector<Hull> hulls_;
    std::vector<Vec2> points_;
    std::vector<double> sides_;
};

template <>
class SolidHulls<3> {
public:
    /// Takes the hull of some points, unless it has no area.
    bool add(std::span<const Vec3> points);
    /// After the last: from here on the arrays stay where they are.
    void finish();
    void write(std::size_t index, Convex<3>& part) const;

private:
    /// Where what belongs to it begins in each array; it ends where that of the next one begins.
    struct Hull {
        std::size_t point, column, face, loop, edge;
    };
    Hull end() const { return {points_.size(), columns_.size(), normals_.size(), loops_.size(), edges_.size()}; }

    std::vector<Hull> hulls_;
    std::vector<Vec3> points_, normals_;
    std::vector<double> offsets_;
    std::vector<float> columns_;
    std::vector<std::uint32_t> loops_, loop_ends_;
    std::vector<FacetEdge> edges_;
    std::vector<Facets> facets_;
    std::vector<PointLanes> lanes_;
};

/// Immutable after `finish`. Not to be moved then, either: views of its parts refer to it.
template <int D>
class SolidParts {
public:
    /// The hull of some corners, as a part of this number. What is no wider than the rounding of floats becomes flat;
    /// without even a surface it is left out.
    void add(std::span<const DVec<D>> corners, std::uint32_t number);
    void finish();

    std::size_t size() const { return places_.size(); }
    Aabb<D> bounds() const { return tree_.bounds(); }
    void each_part(const Aabb<D>& box, PartVisitor<D> visit) const;
    void each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const;
    void each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const;

private:
    struct Place {
        DVec<D> origin;
        std::uint32_t number;
    };
    Convex<D> part(std::size_t index) const;

    std::vector<Place> places_;
    SolidHulls<D> hulls_;
    Bvh<D> tree_;
};

}  // namespace abut
