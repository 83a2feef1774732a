#pragma once

// Samples of a surface that has changed in one place, most of which are as they were. For .cpp files.

#include <abut/bake/field_grid.hpp>
#include <abut/bake/field_samples.hpp>
#include <abut/field/field_data.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

/// A sample that was nearer to the surface than it is to all that has changed is as it was: what is closest to it isn't
/// in the box, and nothing in the box is as close.
template <int D>
class KeptSource final : public SampleSource<D> {
public:
    /// Refers to all of them. `before` has the same grid, and its distances in 32 bits.
    KeptSource(const SampleSource<D>& now, const FieldData<D>& before, const Aabb<D>& changed)
        : now_(now), before_(before), changed_(changed), lattice_(lattice_of(before)) {}

    void tell(const SampleBlock<D>& block, const SampleValues<D>& values) const override {
        if (!tell_kept(block, values)) now_.tell(block, values);
    }
    double distance(const DVec<D>& point) const override { return now_.distance(point); }

private:
    using Counts = glm::vec<D, std::uint32_t>;

    /// False where not all of them are as they were, or not all were kept.
    bool tell_kept(const SampleBlock<D>& block, const SampleValues<D>& values) const {
        const bool of_blocks = before_.store == FieldStore::sparse && block.stride == brick_cells<D>;
        if (before_.store == FieldStore::sparse && block.stride != 1 && !of_blocks) return false;
        for (std::uint32_t i = 0; i < block.samples(); ++i) {
            const Counts sample = block.sample(i);
            const std::size_t place =
                of_blocks ? number_of<D>(sample / brick_cells<D>, blocks_along(before_) + 1u) : place_of(sample);
            if (place == nowhere) return false;
            const float was = of_blocks ? before_.coarse[place] : before_.distance[place];
            if (!is_kept(lattice_.at(sample), was)) return false;
            values.distance[i] = was;
            if (values.gradient != nullptr) values.gradient[i] = unpacked<D>(before_.direction[place]);
            if (values.closest != nullptr) values.closest[i] = before_.closest[place];
        }
        return true;
    }

    bool is_kept(const DVec<D>& point, float was) const {
        double squared = 0;
        for (int i = 0; i < D; ++i) {
            const double below = static_cast<double>(changed_.min[i]) - point[i];
            const double above = point[i] - static_cast<double>(changed_.max[i]);
            const double gap = std::max(std::max(below, above), 0.0);
            squared += gap * gap;
        }
        return std::sqrt(squared) > std::abs(static_cast<double>(was)) * (1 + 1e-6);
    }

    /// Where a sample of the field is kept: dense, or with the brick of the block that it is the lower side of, or of
    /// one before.
    std::size_t place_of(const Counts& sample) const {
        if (before_.store == FieldStore::dense) return number_of<D>(sample, samples_along(before_));
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
            const std::uint32_t brick = before_.brick[number_of(block, blocks)];
            if (brick == no_brick) continue;
            return std::size_t{brick} * brick_samples<D> + number_of<D>(inner, Counts(brick_cells<D> + 1));
        }
        return nowhere;
    }

    static constexpr std::size_t nowhere = ~std::size_t{0};

    const SampleSource<D>& now_;
    const FieldData<D>& before_;
    Aabb<D> changed_;
    SampleLattice<D> lattice_;
};

}  // namespace abut
