#pragma once

// How often a surface goes round the samples of a lattice: counted along its lines, exactly. For .cpp files.

#include <abut/bake/field_samples.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// Where a line along the first axis goes through a triangle: the first sample that lies behind it or on it, and what
/// the winding number is more behind than before it.
struct LineCrossing {
    std::uint32_t sample = 0;
    std::int32_t change = 0;
};

/// The lines along the first axis through the samples of a box. A line that touches a corner or an edge is taken as if
/// it were shifted by as little as can be along the second axis, and by still less along the third: it then goes
/// through one of the triangles there, the same whoever asks. (Edelsbrunner, Muecke: "Simulation of simplicity", 1990.)
class SampleLines {
public:
    SampleLines(std::span<const Vec3> points, const SampleLattice<3>& lattice,
                const glm::vec<3, std::uint32_t>& samples)
        : points_(points), lattice_(lattice), samples_(samples) {}

    const SampleLattice<3>& lattice() const { return lattice_; }
    const glm::vec<3, std::uint32_t>& samples() const { return samples_; }

    /// Of the line through samples (0, y, z). Behind the last sample the number of samples.
    std::optional<LineCrossing> crossing(const glm::uvec3& triangle, std::uint32_t y, std::uint32_t z) const;

    /// Calls visit(y, z, crossing) for all lines that go through the triangle, but behind the last sample.
    template <class Visit>
    void each_crossing(const glm::uvec3& triangle, Visit visit) const {
        const Range y = range(triangle, 1), z = range(triangle, 2);
        for (std::uint32_t k = z.begin; k < z.end; ++k)
            for (std::uint32_t j = y.begin; j < y.end; ++j) {
                const std::optional<LineCrossing> found = crossing(triangle, j, k);
                if (found && found->sample < samples_.x) visit(j, k, *found);
            }
    }

private:
    struct Range {
        std::uint32_t begin, end;
    };
    /// The samples of an axis that are nowhere beside the triangle.
    Range range(const glm::uvec3& triangle, int axis) const;
    int side(std::uint32_t from, std::uint32_t to, const DVec<2>& line) const;

    std::span<const Vec3> points_;
    SampleLattice<3> lattice_;
    glm::vec<3, std::uint32_t> samples_;
};

/// The winding numbers of a closed surface at all samples.
class LineCounts {
public:
    /// `surfaces` are closed together: each edge is run along as often one way as the other.
    LineCounts(const SampleLines& lines, std::span<const std::span<const glm::uvec3>> surfaces);

    /// Of `count` samples `stride` apart along the first axis.
    void tell(const glm::vec<3, std::uint32_t>& first, std::uint32_t count, std::uint32_t stride,
              std::int32_t* winding) const;

private:
    std::uint32_t rows_;                   // along the second axis
    std::vector<std::size_t> first_;       // of each line among the crossings, and the end
    std::vector<LineCrossing> crossings_;  // of a line by where they are
};

}  // namespace abut
