#pragma once

// A convex surface of triangles that stays around what it is around while it loses corners.

#include <abut/convex/convex_surface.hpp>
#include <abut/convex/inner_points.hpp>
#include <abut/convex/lowest_point.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// A closed convex surface in half-edges, numbered like those of `TriangleSurface`. Corners and triangles that were
/// taken out keep their numbers. The body is some 1 across; the surface is convex to within 2e-6.
class OuterMesh {
public:
    explicit OuterMesh(const ConvexSurface& surface);

    /// Takes out corners until there are `count`: two neighbours become one point outside of all the faces that they
    /// had, the least volume first (Sander, Gu, Gortler, Hoppe, Snyder: "Silhouette clipping", 2000). May end with
    /// more, where no two neighbours have such a point that leaves the surface convex.
    void simplify(std::size_t count);

    /// Moves corner after corner to where the volume is least while all `inside` stay so, a number of times.
    void tighten(const InnerPoints& inside, int rounds);

    double volume() const;
    std::size_t count() const { return count_; }
    std::span<const DVec<3>> points() const { return points_; }
    bool has_point(std::uint32_t point) const { return leaving_[point] != none; }
    std::size_t triangle_count() const { return planes_.size(); }
    bool has_triangle(std::uint32_t triangle) const { return origin_[3 * triangle] != none; }
    std::uint32_t corner(std::uint32_t triangle, std::uint32_t i) const { return origin_[3 * triangle + i]; }

    const Plane<3>& plane(std::uint32_t triangle) const { return planes_[triangle]; }

    /// Grows about a point inside until it holds all of the others.
    void grow(const DVec<3>& middle, const InnerPoints& inside);

    /// Calls visit(triangle) for those around a corner.
    template <class Visit>
    void each_triangle_around(std::uint32_t point, Visit visit) const {
        each_leaving(point, [&](std::uint32_t h) { visit(h / 3); });
    }

    static constexpr std::uint32_t none = 0xffffffffu;

private:
    /// How far the surface may be from convex, and from holding what is inside: the corners of a hull's face needn't
    /// lie in a plane more exactly.
    static constexpr double flatness = 1e-6;

    /// Where two neighbours go, and the volume that it adds.
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
    double quick_cost(std::uint32_t half_edge);
    bool can_merge(std::uint32_t half_edge);
    void merge(std::uint32_t half_edge, const DVec<3>& point);
    void set_plane(std::uint32_t triangle);
    void cut_around(std::uint32_t point, const InnerPoints& inside);
    void move(std::uint32_t point, const DVec<3>& to);
    bool flip(std::uint32_t half_edge);
    bool widen(std::uint32_t point);
    bool fits(std::uint32_t point, const DVec<3>& at, const InnerPoints& inside);
    void push(std::uint32_t half_edge);
    void push_all();

    std::vector<DVec<3>> points_;
    std::vector<std::uint32_t> leaving_;        ///< one a point: a half-edge that leaves it
    std::vector<std::uint32_t> origin_, twin_;  ///< one a half-edge
    std::vector<Plane<3>> planes_;              ///< one a triangle
    std::vector<double> areas_;                 ///< one a triangle, twice
    std::size_t count_ = 0;

    struct Waiting {
        double cost;
        std::uint32_t half_edge, version;
    };
    std::vector<Waiting> heap_;
    std::vector<std::uint32_t> version_;  ///< one a half-edge: of the last of those that wait for it
    std::vector<std::uint32_t> mark_;     ///< one a point: the last search that came by
    std::uint32_t search_ = 0;

    // Around an edge or a point, seen from `middle_`.
    DVec<3> middle_{0.0};
    std::vector<std::uint32_t> ring_;  ///< half-edges of the triangles around it that lie opposite
    std::vector<std::uint32_t> star_;  ///< the triangles around it
    std::vector<Plane<3>> limits_;
    DVec<3> slope_{0.0};  ///< of the volume under the ring's cone, by its apex
    double size_ = 0;
    std::uint32_t touched_ = 0;  ///< the last of what is inside that a plane came upon
};

}  // namespace abut
