#pragma once

// The contacts of two shapes as manifolds of their whole surfaces: contacts of parts that are on one plane are joined,
// and internal edges are filtered (ghost collisions). For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>
#include <abut/query/detail/surface/part_cache.hpp>
#include <abut/query/detail/surface/surface_manifold.hpp>
#include <abut/query/detail/surface/surface_normal_flags.hpp>

namespace abut::detail {

/// The surfaces that continue each of two shapes; null: none. The functions must outlive this.
template <int D>
struct NeighbourSurfaces {
    const EachClosestPoint<D>* of_a = nullptr;  ///< what A touches beside B
    const EachClosestPoint<D>* of_b = nullptr;  ///< what B touches beside A
    /// The points nearest to the centres of A and B, shared by all pairs of an item that is no composite shape; null:
    /// they are found for each pair.
    NearestToCenter<D>*nearest_to_a = nullptr, *nearest_to_b = nullptr;
};

/// Filters contacts on internal edges between two shapes, to which it refers. The surface of a part is that of its
/// whole composite shape, with the neighbours.
template <int D>
class PairEdgeFilter {
public:
    PairEdgeFilter(const View<D>& a, const View<D>& b, const NeighbourSurfaces<D>& neighbours = {});

    /// From now on queries try this cache of the composite shape's parts first.
    void use_cache(const PartCache<D>& cache) {
        for (ForShape* shape : {&for_a_, &for_b_})
            if (shape->surface.is_composite()) shape->surface.cache = &cache;
    }

    /// The size of the smaller shape.
    double size() const { return std::min(size_a_, size_b_); }
    bool a_is_larger() const { return size_a_ > size_b_; }
    /// s
    double scale() const { return for_a_.filter.scale(); }
    /// Most surface queries stay this near to the contact.
    double reach() const { return 5 * scale(); }

    /// Tests the normal between two parts in the centre of their contact area and at the deepest point. manifold_of()
    /// returns that area.
    SurfaceNormalFlags surface_normal_flags(const Part<D>& part_a, const Part<D>& part_b,
                                            const SignedDistance<D>& distance,
                                            FunctionRef<const Manifold<D>&()> manifold_of) const;

    enum class Substitute : std::uint8_t {
        none,  ///< the surface has no plane there
        plane,
        ridge,  ///< the plane is that of a ridge, where the contact isn't as deep
    };
    /// Replaces a distance whose normal is no surface normal by that from a plane of the surface, if there is one and
    /// it isn't that of a ridge. Of two composite shapes the larger counts as the level. Of two such planes it takes
    /// the one that separates sooner, so that swapping A and B changes nothing.
    Substitute replace(const Part<D>& part_a, const Part<D>& part_b, const SurfaceNormalFlags& flags,
                       SignedDistance<D>& distance);

private:
    /// The filter for one of the two shapes. The other one is the level.
    class ForShape {
    public:
        ForShape(const View<D>& shape, const View<D>& level, bool level_is_b, double size,
                 const EachClosestPoint<D>* neighbours, NearestToCenter<D>* shared)
            : surface{level, neighbours},
              filter(surface.is_composite() || neighbours == nullptr ? EachClosestPoint<D>(surface) : *neighbours,
                     size),
              shape_(shape),
              level_is_b_(level_is_b),
              nearest_(shared != nullptr ? shared : &own_nearest_) {}
        ForShape(const ForShape&) = delete;
        ForShape& operator=(const ForShape&) = delete;

        bool has_surface() const { return surface.is_composite() || surface.neighbours != nullptr; }
        bool is_surface_normal(const Part<D>& part, const Part<D>& level_part, const SignedDistance<D>& distance,
                               FunctionRef<const Manifold<D>&()> manifold_of) const;
        std::optional<SurfacePlane<D>> plane(const Part<D>& part, const Part<D>& level_part,
                                             const SignedDistance<D>& distance);

        Surface<D> surface;
        EdgeFilter<D> filter;

    private:
        SurfacePlace<D> point_on_level(const SignedDistance<D>& distance) const;
        SurfacePlace<D> place_on_level(const Part<D>& part, const SignedDistance<D>& distance) const;
        const DVec<D>& center() const;

        const View<D>& shape_;
        bool level_is_b_;
        NearestToCenter<D> own_nearest_, *nearest_;
        mutable std::optional<DVec<D>> center_;
    };

    double size_a_, size_b_;
    ForShape for_a_, for_b_;
};

extern template class PairEdgeFilter<2>;
extern template class PairEdgeFilter<3>;

/// A manifold of the surfaces of two shapes.
template <int D>
struct SurfaceContact {
    Contact<D> contact;
    /// Of a contact whose normal is a substitute for one of an internal edge: the points on faces of the two shapes
    /// themselves. It may be empty, where another shape has the surface.
    Contact<D> own_area;
    /// False for a side whose surface doesn't have the normal of the parts' contact, which was replaced.
    SurfaceNormalFlags surface_normals;
    double size = 0;  ///< of the smaller shape, of a contact without a surface normal; infinite on a ridge
};

/// Visits one contact for each plane on which two shapes touch, of which at least one is composite or has neighbours;
/// the visitor returns false to stop. The surfaces go on in the neighbours. Returns whether the shapes touch, even if
/// none of their surfaces do.
template <int D>
bool each_surface_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options,
                          const NeighbourSurfaces<D>& neighbours, FunctionRef<bool(const SurfaceContact<D>&)> visit);

/// Filters the contact of two shapes of one part each that touch. `own` and `contact` are that contact without
/// neighbours.
template <int D>
SurfaceContact<D> filtered_contact(const View<D>& a, const View<D>& b, const PartContact<D>& own,
                                   const Contact<D>& contact, const NeighbourSurfaces<D>& neighbours,
                                   double margin = 0);

/// The deepest contact of two parts of two shapes.
template <int D>
struct DeepestParts {
    std::uint32_t index_a = 0, index_b = 0;
    PartContact<D> contact;

    /// Written out: clearing all of it first is slow.
    DeepestParts() {}
};

/// Finds the deepest parts; of composite shapes without the manifold. For two convex shapes it writes their contact
/// too. Returns false, and leaves `contact`, if the shapes don't touch. All numbers of the shapes are finite.
template <int D>
bool find_deepest_parts(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, DeepestParts<D>& deepest,
                        Contact<D>& contact);

/// Writes the contact on the plane of two parts that touch, the deepest such pair. Returns false, and writes nothing,
/// if that contact is on an internal edge, unless it `keeps_edges`.
template <int D>
bool whole_contact(const View<D>& a, const View<D>& b, const QueryOptions<D>& options, const DeepestParts<D>& deepest,
                   bool keeps_edges, Contact<D>& result);

}  // namespace abut::detail
