#pragma once

// The convex parts of a solid level in packed arrays, for overlap and distance queries. For .cpp files.

#include <abut/broad_phase/bvh.hpp>
#include <abut/convex/facets.hpp>
#include <abut/convex/point_soa.hpp>
#include <abut/convex/support.hpp>
#include <abut/shape/view/view.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

class BlobWriter;
class BlobReader;

/// Convex hulls in packed arrays.
template <int D>
class SolidHulls;

template <>
class SolidHulls<2> {
public:
    /// Adds the hull of the points; returns false if it is a single point.
    bool add(std::span<const Vec2> points);
    void finish() {}
    /// Makes `part` refer to hull `index`.
    void write(std::size_t index, Convex<2>& part) const;
    void save(BlobWriter& writer) const;
    /// Reads so many hulls. Returns what is wrong with them; null if nothing is.
    const char* load(BlobReader& reader, std::size_t count);

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
    /// Adds the hull of the points; returns false if it has no area.
    bool add(std::span<const Vec3> points);
    /// Call once after the last `add`: the arrays don't move afterwards.
    void finish();
    void write(std::size_t index, Convex<3>& part) const;
    void save(BlobWriter& writer) const;
    const char* load(BlobReader& reader, std::size_t count);

private:
    /// First index of a hull in each array; its end is the first index of the next hull.
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
    std::vector<PointSoa> lanes_;
};

/// The parts of a level. Immutable after `finish` and not movable then, since views refer to it.
template <int D>
class SolidParts {
public:
    /// Adds the hull of the corners as part `number`. A hull thinner than float rounding becomes flat; one without area
    /// is dropped.
    void add(std::span<const DVec<D>> corners, std::uint32_t number);
    void finish();

    void save(BlobWriter& writer) const;
    /// Reads what `save` has written, in place of adding parts and `finish`. Returns what is wrong with it; null if
    /// nothing is.
    const char* load(BlobReader& reader);

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
    std::vector<Aabb<D>> boxes() const;

    std::vector<Place> places_;
    SolidHulls<D> hulls_;
    Bvh<D> tree_;
};

}  // namespace abut::detail
