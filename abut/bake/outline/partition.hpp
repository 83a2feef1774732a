#pragma once

// A convex partition of a triangulated region in half-edges, by removal of edges.

#include <abut/bake/outline/optimal_partition.hpp>
#include <abut/bake/outline/triangulate.hpp>

namespace abut::outline {

struct Improvement {
    bool optimal;        ///< every patch was an entire connected component without holes, so the minimum is reached
    bool is_worthwhile;  ///< the last round saved enough faces to justify another
};

/// A planar subdivision in half-edges. It starts as a triangulation; edges are removed one by one.
class Partition {
public:
    /// `conforming`: no corner of a face may lie within a straight side of another.
    Partition(const Triangulation& triangles, bool conforming);

    /// Removes every edge whose two faces have a convex union (Hertel and Mehlhorn 1983). Edges that resolve no reflex
    /// corner of the region go first.
    void merge_all();

    /// Re-solves patches of neighbouring faces with the minimum number of faces, each patch once per round, at most
    /// `rounds` times. A patch has at most `corners` corners. `promising_only` skips patches that rarely improve.
    Improvement improve(std::uint32_t corners, int rounds, bool promising_only);

    /// Removes edges as long as the concavity of every face stays within `concavity`, smallest concavity first.
    void merge_shallow(double concavity);

    /// The number of corners of the region, and of its reflex corners.
    std::size_t corners() const;
    std::size_t reflex_corners() const;
    /// The number of connected components minus the number of holes: faces minus cuts, an invariant.
    std::int64_t pieces_less_holes() const { return pieces_less_holes_; }
    std::size_t face_count() const { return face_count_; }

    /// One half-edge per face.
    std::vector<std::uint32_t> faces() const;
    std::uint32_t next(std::uint32_t half_edge) const { return next_[half_edge]; }
    std::uint32_t origin(std::uint32_t half_edge) const { return origins_[half_edge]; }
    const Vec2& point(std::uint32_t number) const { return points_[number]; }

private:
    /// Faces whose common edges are ignored.
    struct Patch {
        std::vector<std::uint32_t> loop;   ///< the half-edges of its boundary
        std::vector<std::uint32_t> inner;  ///< the half-edges in its interior
        std::vector<std::uint32_t> faces;
        std::vector<Vec2> corners;                  ///< the origins of the loop's half-edges
        std::vector<std::uint8_t> may_be_straight;  ///< the argument of `OptimalPartition::solve`
    };
    /// The face at each half-edge, and one half-edge of each face.
    struct FaceNumbers {
        std::vector<std::uint32_t> of, first;
        std::vector<bool> done;
    };

    bool may_join(const Patch& patch, std::uint32_t half_edge, std::uint32_t corners, const FaceNumbers& numbers,
                  std::vector<std::uint32_t>& added) const;
    bool grow(Patch& patch, std::uint32_t face, std::uint32_t corners, const FaceNumbers& numbers) const;
    bool may_improve(const Patch& patch, bool promising_only) const;
    void solve(Patch& patch, OptimalPartition& solver) const;
    void recut(const Patch& patch, const OptimalPartition& parts, FaceNumbers& numbers);
    FaceNumbers number_faces() const;

    const Vec2& at(std::uint32_t half_edge) const { return points_[origins_[half_edge]]; }
    double depth_without(std::uint32_t half_edge) const;
    bool convex_without(std::uint32_t half_edge) const;
    void remove(std::uint32_t half_edge);
    std::uint32_t last_around(std::uint32_t first) const;
    std::vector<std::uint8_t> split_counts() const;

    const std::vector<Vec2>& points_;
    std::vector<std::uint32_t> origins_, twins_, next_, before_;
    std::vector<std::uint32_t> faces_at_;  ///< one per point: the number of incident face corners
    std::int64_t pieces_less_holes_;
    std::size_t face_count_;
    bool conforming_;
};

}  // namespace abut::outline
