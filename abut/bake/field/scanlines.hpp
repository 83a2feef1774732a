#pragma once

// Exact winding numbers of a closed surface at the samples of a lattice, by scanlines. For .cpp files.

#include <abut/bake/field/samples.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The crossing of a scanline and a triangle: the first sample at or behind it, and the change of the winding number.
struct ScanlineCrossing {
    std::uint32_t sample = 0;
    std::int32_t change = 0;
};

/// The scanlines along the first axis through the samples of a box. A line that touches a corner or an edge is
/// perturbed symbolically: infinitesimally along the second axis, and by less along the third. It then crosses exactly
/// one of the adjacent triangles (Edelsbrunner, Muecke: "Simulation of simplicity", 1990).
class Scanlines {
public:
    Scanlines(std::span<const Vec3> points, const SampleLattice<3>& lattice, const glm::vec<3, std::uint32_t>& samples)
        : points_(points), lattice_(lattice), samples_(samples) {}

    const SampleLattice<3>& lattice() const { return lattice_; }
    const glm::vec<3, std::uint32_t>& samples() const { return samples_; }

    /// The crossing of the line through samples (0, y, z). Its sample is the number of samples if it lies behind all.
    std::optional<ScanlineCrossing> crossing(const glm::uvec3& triangle, std::uint32_t y, std::uint32_t z) const;

    /// Calls visit(y, z, crossing) for all lines that cross the triangle before their last sample.
    template <class Visit>
    void each_crossing(const glm::uvec3& triangle, Visit visit) const {
        const Range y = range(triangle, 1), z = range(triangle, 2);
        for (std::uint32_t k = z.begin; k < z.end; ++k)
            for (std::uint32_t j = y.begin; j < y.end; ++j) {
                const std::optional<ScanlineCrossing> found = crossing(triangle, j, k);
                if (found && found->sample < samples_.x) visit(j, k, *found);
            }
    }

private:
    struct Range {
        std::uint32_t begin, end;
    };
    /// The samples along an axis that lie within the triangle's extent.
    Range range(const glm::uvec3& triangle, int axis) const;
    int side(std::uint32_t from, std::uint32_t to, const DVec<2>& line) const;

    std::span<const Vec3> points_;
    SampleLattice<3> lattice_;
    glm::vec<3, std::uint32_t> samples_;
};

/// The winding numbers of a closed surface at all samples.
class ScanlineWindings {
public:
    /// `surfaces` are closed together: every edge is traversed equally often in both directions.
    ScanlineWindings(const Scanlines& lines, std::span<const std::span<const glm::uvec3>> surfaces);

    /// The winding numbers of `count` samples, `stride` apart along the first axis.
    void evaluate(const glm::vec<3, std::uint32_t>& first, std::uint32_t count, std::uint32_t stride,
                  std::int32_t* winding) const;

private:
    std::uint32_t rows_;                       // number of lines along the second axis
    std::vector<std::size_t> first_;           // one per line, and the end: its first crossing
    std::vector<ScanlineCrossing> crossings_;  // sorted along each line
};

}  // namespace abut::detail
