#pragma once

// Convex parts of a triangulated region, as the triangles' edges without those that are not needed.

#include <abut/bake/outline_sweep.hpp>

namespace abut::outline {

/// Faces made of half-edges, as those of the triangulation that it begins with; edges go one by one.
class Partition {
public:
    /// `conforming`: no corner of a face may lie within a straight side of another.
    Partition(const Triangulation& triangles, bool conforming);

    /// Takes away every edge between two faces that are one convex face without it, first those that split no corner of
    /// the region for good: at whose ends no angle over half a turn is split into two that aren't. Hertel and Mehlhorn
    /// (1983) with an order.
    void merge_all();

    /// One half-edge a face.
    std::vector<std::uint32_t> faces() const;
    std::uint32_t next(std::uint32_t half_edge) const { return next_[half_edge]; }
    std::uint32_t origin(std::uint32_t half_edge) const { return origins_[half_edge]; }
    const Vec2& point(std::uint32_t number) const { return points_[number]; }

private:
    const Vec2& at(std::uint32_t half_edge) const { return points_[origins_[half_edge]]; }
    bool convex_without(std::uint32_t half_edge) const;
    void remove(std::uint32_t half_edge);
    std::vector<std::uint8_t> uses() const;
    std::vector<bool> pairs(const std::vector<std::uint8_t>& use, std::vector<bool>& paired) const;

    const std::vector<Vec2>& points_;
    std::vector<std::uint32_t> origins_, twins_, next_, before_;
    std::vector<std::uint32_t> faces_at_;  ///< one a point: how many corners of faces lie there
    bool conforming_;
};

}  // namespace abut::outline
