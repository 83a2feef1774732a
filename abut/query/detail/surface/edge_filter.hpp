#pragma once

// The filter of internal edges (ghost collisions): contacts of parts with the normals of the whole surfaces. For .cpp
// files.

#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/part_cache.hpp>
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
class EdgeFilter {
public:
    EdgeFilter(const View<D>& a, const View<D>& b, const NeighbourSurfaces<D>& neighbours = {});

    /// From now on queries try this cache of the composite shape's parts first.
    void use_cache(const PartCache<D>& cache) { cache_ = &cache; }
    /// Most surface queries stay this near to the contact.
    double reach() const { return 5 * scale_; }

    /// The size of the smaller shape.
    double size() const { return std::min(size_a_, size_b_); }
    bool a_is_larger() const { return size_a_ > size_b_; }

    /// Tests the normal between two parts in the centre of their contact area and at the deepest point. manifold_of()
    /// returns that area.
    detail::SurfaceNormalFlags surface_normal_flags(const Part<D>& part_a, const Part<D>& part_b,
                                                    const SignedDistance<D>& distance,
                                                    FunctionRef<const Manifold<D>&()> manifold_of) const;

    /// Replaces a distance whose normal is no surface normal by that from a plane of the surface. Of two composite
    /// shapes the larger counts as the level. Of two such planes it takes the one that separates sooner, so that
    /// swapping A and B changes nothing. Returns false, and changes nothing, if there is no plane.
    bool replace(const Part<D>& part_a, const Part<D>& part_b, const detail::SurfaceNormalFlags& flags,
                 SignedDistance<D>& distance);

private:
    class Center {
    public:
        explicit Center(const View<D>& view) : view_(view) {}
        const DVec<D>& get() const;

    private:
        const View<D>& view_;
        mutable std::optional<DVec<D>> found_;
    };

    /// One of the two shapes, and the other one.
    enum class Side : bool { a, b };

    SurfacePlace<D> place_on(Side side, const Part<D>& other_part, const SignedDistance<D>& distance) const;
    auto closest_points_on(Side side) const;
    bool is_surface_normal_of(Side side, const Part<D>& part, const Part<D>& other_part,
                              const SignedDistance<D>& distance, FunctionRef<const Manifold<D>&()> manifold_of) const;
    std::optional<SurfacePlane<D>> plane_of(Side side, const Part<D>& part, const Part<D>& other_part,
                                            const SignedDistance<D>& distance);

    const View<D>&a_, &b_;
    NeighbourSurfaces<D> neighbours_;
    double size_a_, size_b_, scale_;
    bool are_composite_;  ///< both shapes: the larger one is the level
    Center center_of_a_, center_of_b_;
    const PartCache<D>* cache_ = nullptr;
    NearestToCenter<D> nearest_to_a_, nearest_to_b_;
};

extern template class EdgeFilter<2>;
extern template class EdgeFilter<3>;

}  // namespace abut::detail
