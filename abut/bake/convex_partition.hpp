#pragma once

// Convex parts of a triangulated region, as the triangles' edges without those that are not needed.

#include <abut/bake/optimal_partition.hpp>
#include <abut/bake/outline_sweep.hpp>

namespace abut::outline {

struct Improvement {
    bool optimal;     ///< every patch was all that hangs together, without holes: there can't be fewer faces
    bool worthwhile;  ///< the last round saved so much that there should be another
};

/// Faces made of half-edges, as those of the triangulation that it begins with; edges go one by one.
class Partition {
public:
    /// `conforming`: no corner of a face may lie within a straight side of another.
    Partition(const Triangulation& triangles, bool conforming);

    /// Takes away every edge between two faces that are one convex face without it, first those that split no corner of
    /// the region for good: at whose ends no angle over half a turn is split into two that aren't. Hertel and Mehlhorn
    /// (1983) with an order.
    void merge_all();

    /// Solves patches of neighbouring faces anew, with as few faces as can be: all of them once a round, as long as it
    /// pays, and at most `rounds` times. A patch has up to `corners` corners; `only_likely` leaves those alone that may
    /// have a face too many, but seldom do.
    Improvement improve(std::uint32_t corners, int rounds, bool only_likely);

    /// Takes away edges for as long as no corner of a face lies deeper than `concavity` behind the edge of its hull
    /// that goes around it, those first that make least of a notch.
    void merge_shallow(double concavity);

    /// How many corners the region has, and how many of them turn right.
    std::size_t corners() const;
    std::size_t reflex_corners() const;
    /// Pieces of the region that don't hang together, less the holes in them: faces less cuts, whatever the faces.
    std::int64_t pieces_less_holes() const { return pieces_less_holes_; }
    std::size_t face_count() const { return face_count_; }

    /// One half-edge a face.
    std::vector<std::uint32_t> faces() const;
    std::uint32_t next(std::uint32_t half_edge) const { return next_[half_edge]; }
    std::uint32_t origin(std::uint32_t half_edge) const { return origins_[half_edge]; }
    const Vec2& point(std::uint32_t number) const { return points_[number]; }

private:
    /// Faces that are one without the edges between them.
    struct Patch {
        std::vector<std::uint32_t> loop;   ///< the half-edges around it
        std::vector<std::uint32_t> inner;  ///< and those in it
        std::vector<std::uint32_t> faces;
        std::vector<Vec2> corners;                  ///< at the starts of the loop's half-edges
        std::vector<std::uint8_t> may_be_straight;  ///< as `OptimalPartition::solve` takes them
    };
    /// The number of the face at each half-edge, and one of its half-edges.
    struct FaceNumbers {
        std::vector<std::uint32_t> of, first;
        std::vector<bool> done;
    };

    bool may_join(const Patch& patch, std::uint32_t half_edge, std::uint32_t corners, const FaceNumbers& numbers,
                  std::vector<std::uint32_t>& added) const;
    bool grow(Patch& patch, std::uint32_t face, std::uint32_t corners, const FaceNumbers& numbers) const;
    bool may_improve(const Patch& patch, bool only_likely) const;
    void solve(Patch& patch, OptimalPartition& solver) const;
    void recut(const Patch& patch, const OptimalPartition& parts, FaceNumbers& numbers);
    FaceNumbers number_faces() const;

    const Vec2& at(std::uint32_t half_edge) const { return points_[origins_[half_edge]]; }
    double depth_without(std::uint32_t half_edge) const;
    bool convex_without(std::uint32_t half_edge) const;
    void remove(std::uint32_t half_edge);
    std::uint32_t last_around(std::uint32_t first) const;
    std::vector<std::uint8_t> uses() const;

    const std::vector<Vec2>& points_;
    std::vector<std::uint32_t> origins_, twins_, next_, before_;
    std::vector<std::uint32_t> faces_at_;  ///< one a point: how many corners of faces lie there
    std::int64_t pieces_less_holes_;
    std::size_t face_count_;
    bool conforming_;
};

}  // namespace abut::outline
