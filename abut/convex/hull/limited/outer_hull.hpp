#pragma once

// A simplified outer hull: a convex triangle mesh that contains a body and loses vertices.

#include <abut/convex/hull/limited/convex_surface.hpp>
#include <abut/convex/hull/limited/linear_program.hpp>
#include <abut/convex/hull/limited/vertex_graph.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

/// A closed convex surface in half-edges, numbered like those of `TriangleSurface`. Removed corners and triangles leave
/// their numbers unused. The body has a size of about 1; the surface is convex to within 2e-6.
class OuterHull {
public:
    explicit OuterHull(const ConvexSurface& surface);

    /// Removes corners until `count` are left. Each edge collapse moves two neighbours to a point outside of all their
    /// faces, the smallest added volume first (Sander, Gu, Gortler, Hoppe, Snyder: "Silhouette clipping", 2000). It may
    /// end with more corners if no collapse leaves the surface convex.
    void simplify(std::size_t count);

    /// Moves each corner to the position of minimum volume that still contains `inside`, for a number of rounds.
    void tighten(const VertexGraph& inside, int rounds);

    double volume() const;
    std::size_t count() const { return count_; }
    std::span<const DVec<3>> points() const { return points_; }
    bool has_point(std::uint32_t point) const { return leaving_[point] != none; }
    std::size_t triangle_count() const { return planes_.size(); }
    bool has_triangle(std::uint32_t triangle) const { return origin_[3 * triangle] != none; }
    std::uint32_t corner(std::uint32_t triangle, std::uint32_t i) const { return origin_[3 * triangle + i]; }

    const Plane<3>& plane(std::uint32_t triangle) const { return planes_[triangle]; }

    /// Scales about an inner point until it contains `inside`.
    void grow(const DVec<3>& middle, const VertexGraph& inside);

    /// Calls visit(triangle) for those around a corner.
    template <class Visit>
    void each_triangle_around(std::uint32_t point, Visit visit) const {
        each_leaving(point, [&](std::uint32_t h) { visit(h / 3); });
    }

    static constexpr std::uint32_t none = 0xffffffffu;

private:
    /// The tolerance of convexity and of containment: the corners of a hull's face aren't coplanar to more than this.
    static constexpr double flatness = 1e-6;

    /// The new point of a collapse, and the volume that it adds.
    struct Merge {
        DVec<3> point{0.0};
        double added = 0;
    };

    /// Calls visit(half-edge) for those that leave a corner.
    template <class Visit>
    void each_leaving(std::uint32_t point, Visit visit) const {
        const std::uint32_t first = leaving_[point];
        std::uint32_t h = first;
        do {
            visit(h);
            h = twin_[following(following(h))];
        } while (h != first);
    }
    void gather_ring(std::uint32_t half_edge);
    void gather_ring_of_point(std::uint32_t point);
    void finish_ring();
    double volume_to(const DVec<3>& apex) const;
    std::optional<Merge> merge_at(std::uint32_t half_edge);
    double estimated_cost(std::uint32_t half_edge);
    bool can_merge(std::uint32_t half_edge);
    void merge(std::uint32_t half_edge, const DVec<3>& point);
    void set_plane(std::uint32_t triangle);
    void cut_around(std::uint32_t point, const VertexGraph& inside);
    void move(std::uint32_t point, const DVec<3>& to);
    bool flip(std::uint32_t half_edge);
    bool add_triangles(std::uint32_t point);
    bool fits(std::uint32_t point, const DVec<3>& at, const VertexGraph& inside);
    void push(std::uint32_t half_edge);
    void push_all();

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> leaving_;        ///< one per point: a half-edge that leaves it
    std::vector<std::uint32_t> origin_, twin_;  ///< one per half-edge
    std::vector<Plane<3>> planes_;              ///< one per triangle
    std::vector<double> areas_;                 ///< one per triangle, twice the area
    std::size_t count_ = 0;

    struct HeapEntry {
        double cost;
        std::uint32_t half_edge, version;
    };
    std::vector<HeapEntry> heap_;
    std::vector<std::uint32_t> version_;  ///< one per half-edge: of its latest entry in the heap
    std::vector<std::uint32_t> mark_;     ///< one per point: the last search that visited it
    std::uint32_t search_ = 0;

    // Around an edge or a point, relative to `middle_`.
    DVec<3> middle_{0.0};
    std::vector<std::uint32_t> ring_;  ///< the half-edges of the surrounding triangles opposite to it
    std::vector<std::uint32_t> star_;  ///< the surrounding triangles
    std::vector<Plane<3>> limits_;
    DVec<3> slope_{0.0};  ///< the gradient of the volume under the ring's cone by its apex
    double size_ = 0;
    std::uint32_t touched_ = 0;  ///< the last support point of `inside`
};

}  // namespace abut::detail
