#pragma once

// Reuses the samples of a field after a local change of its surface. For .cpp files.

#include <abut/bake/field/grid.hpp>
#include <abut/bake/field/samples.hpp>
#include <abut/field/data.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

/// Reuses a sample that was nearer to the surface than it is to the changed box: its closest point lies outside the
/// box, and nothing in the box is closer.
template <int D>
class ReusedSource final : public SampleSource<D> {
public:
    /// Refers to all arguments. `before` has the same grid and 32-bit distances.
    ReusedSource(const SampleSource<D>& source, const FieldData<D>& before, const Aabb<D>& changed)
        : source_(source), before_(before), changed_(changed), lattice_(lattice_of(before)) {}

    void evaluate(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        if (!copy_unchanged(block, values)) source_.evaluate(block, values);
    }
    double distance(const DVec<D>& point) const override { return source_.distance(point); }

private:
    using Counts = glm::vec<D, std::uint32_t>;

    /// Copies the samples of a block. Returns false if one of them may have changed or is not stored.
    bool copy_unchanged(const SampleBlock<D>& block, const SampleValues<D>& values) const {
        const bool of_blocks = before_.store == FieldStore::sparse && block.stride == brick_cells<D>;
        if (before_.store == FieldStore::sparse && block.stride != 1 && !of_blocks) return false;
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const Counts sample = block.sample(i);
            const std::size_t index =
                of_blocks ? linear_index<D>(sample / brick_cells<D>, blocks_along(before_) + 1u) : index_of(sample);
            if (index == not_stored) return false;
            const float was = of_blocks ? before_.coarse[index] : before_.distance[index];
            if (!is_unchanged(lattice_.at(sample), was)) return false;
            values.distance[i] = was;
            if (values.gradient != nullptr) values.gradient[i] = unpacked<D>(before_.direction[index]);
            if (values.closest != nullptr) values.closest[i] = before_.closest[index];
        }
        return true;
    }

    bool is_unchanged(const DVec<D>& point, float was) const {
        double squared = 0;
        for (int i = 0; i < D; ++i) {
            const double below = static_cast<double>(changed_.min[i]) - point[i];
            const double above = point[i] - static_cast<double>(changed_.max[i]);
            const double gap = std::max(std::max(below, above), 0.0);
            squared += gap * gap;
        }
        return square_root(squared) > std::abs(static_cast<double>(was)) * (1 + 1e-6);
    }

    /// The index of a stored sample: in a dense field directly, else in the brick of its block or of a lower neighbour.
    std::size_t index_of(const Counts& sample) const {
        if (before_.store == FieldStore::dense) return linear_index<D>(sample, samples_along(before_));
        const Counts blocks = blocks_along(before_);
        for (std::uint32_t beside = 0; beside < 1u << D; ++beside) {
            Counts block = sample / brick_cells<D>, inner = sample % brick_cells<D>;
            bool is_in = true;
            for (int i = 0; i < D; ++i) {
                if ((beside >> i & 1u) != 0) {
                    is_in = is_in && inner[i] == 0 && block[i] > 0;
                    inner[i] = brick_cells<D>;
                    block[i] -= 1;
                }
                is_in = is_in && block[i] < blocks[i];
            }
            if (!is_in) continue;
            const std::uint32_t brick = before_.brick[linear_index(block, blocks)];
            if (brick == no_brick) continue;
            return std::size_t{brick} * brick_samples<D> + linear_index<D>(inner, Counts(brick_cells<D> + 1));
        }
        return not_stored;
    }

    static constexpr std::size_t not_stored = ~std::size_t{0};

    const SampleSource<D>& source_;
    const FieldData<D>& before_;
    Aabb<D> changed_;
    SampleLattice<D> lattice_;
};

}  // namespace abut::detail
