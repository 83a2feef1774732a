#include <abut/bake/field/fill.hpp>
#include <abut/bake/field/grid.hpp>
#include <abut/field/check.hpp>
#include <abut/field/quantise.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace abut::detail {
namespace {

template <int D>
using Counts = glm::vec<D, std::uint32_t>;

Problem too_many() {
    return {ProblemCode::too_large, "the field would have more than 2^31 samples", 0};
}

/// Calls visit(sample of a block, number in the block) in the order of the samples.
template <int D, class Visit>
void each_sample(const SampleBlock<D>& block, Visit visit) {
    const std::uint32_t count = block.samples();
    for (std::uint32_t i = 0; i < count; ++i) visit(block.sample(i), i);
}

/// Arrays with one entry per sample, for the quantities that the options request.
template <int D>
struct SampleArrays {
    std::vector<float> distance;
    std::vector<Vec<D>> gradient, closest;
    std::vector<std::uint8_t> uncertain;

    SampleArrays(std::size_t count, const FieldOptions<D>& options, bool uncertain_count)
        : distance(count),
          gradient(options.lookup == FieldLookup::gradient ? count : 0),
          closest(options.closest_points ? count : 0),
          uncertain(uncertain_count ? count : 0) {}

    SampleValues<D> from(std::size_t first) {
        const auto at = [&](auto& numbers) { return numbers.empty() ? nullptr : numbers.data() + first; };
        return {at(distance), at(gradient), at(closest), at(uncertain)};
    }
    void copy(std::size_t to, const SampleArrays& from, std::size_t place) {
        distance[to] = from.distance[place];
        if (!gradient.empty()) gradient[to] = from.gradient[place];
        if (!closest.empty()) closest[to] = from.closest[place];
        if (!uncertain.empty()) uncertain[to] = from.uncertain[place];
    }
    std::size_t uncertain_count() const { return std::accumulate(uncertain.begin(), uncertain.end(), std::size_t{0}); }
};

/// Divides a box of samples into blocks.
template <int D>
class Blocks {
public:
    Blocks(const Counts<D>& samples, std::uint32_t stride) : samples_(samples), stride_(stride) {
        for (int i = 0; i < D; ++i) blocks_[i] = (samples[i] + side - 1) / side;
    }

    std::size_t count() const { return grid_size(blocks_); }
    SampleBlock<D> block(std::size_t number) const {
        SampleBlock<D> result;
        result.stride = stride_;
        const Counts<D> block = grid_index(number, blocks_);
        for (int i = 0; i < D; ++i) {
            result.first[i] = block[i] * side * stride_;
            result.count[i] = std::min(side, samples_[i] - block[i] * side);
        }
        return result;
    }

private:
    static constexpr std::uint32_t side = max_block_side<D>;

    Counts<D> samples_, blocks_{};
    std::uint32_t stride_;
};

/// The samples of one block, before they are copied to their final places.
template <int D>
struct BlockSamples {
    std::array<float, max_block_samples<D>> distance;
    std::array<Vec<D>, max_block_samples<D>> gradient, closest;
    std::array<std::uint8_t, max_block_samples<D>> uncertain;
};

/// Evaluates all samples of a box, `stride` apart, and stores them in rows.
template <int D>
bool evaluate_all(const SampleSource<D>& source, const Counts<D>& samples, std::uint32_t stride, BakeJob& work,
                  const SampleValues<D>& rows) {
    const Blocks<D> blocks(samples, stride);
    return work.each(blocks.count(), [&](std::size_t number) {
        const SampleBlock<D> block = blocks.block(number);
        BlockSamples<D> evaluated;
        source.evaluate(block,
                        {evaluated.distance.data(), rows.gradient != nullptr ? evaluated.gradient.data() : nullptr,
                         rows.closest != nullptr ? evaluated.closest.data() : nullptr,
                         rows.uncertain != nullptr ? evaluated.uncertain.data() : nullptr});
        each_sample(block, [&](const Counts<D>& sample, std::uint32_t i) {
            const std::size_t place = linear_index<D>(sample / stride, samples);
            rows.distance[place] = evaluated.distance[i];
            if (rows.gradient != nullptr) rows.gradient[place] = evaluated.gradient[i];
            if (rows.closest != nullptr) rows.closest[place] = evaluated.closest[i];
            if (rows.uncertain != nullptr) rows.uncertain[place] = evaluated.uncertain[i];
        });
    });
}

/// Finds the blocks near the surface from the distances at some of their points. The distance function is Lipschitz
/// with constant 1: from one point to another it changes by at most their distance.
template <int D>
class NearBlocks {
public:
    NearBlocks(const FieldData<D>& field, const SampleSource<D>& source, double band)
        : field_(field), source_(source), lattice_(lattice_of(field)), corners_(blocks_along(field) + 1u) {
        reach_ = band * lattice_.cell;
    }

    bool is_near(std::size_t number) const {
        const Counts<D> block = grid_index(number, blocks_along(field_));
        double min_distance = std::numeric_limits<double>::infinity(), max_distance = 0;
        for (std::uint32_t corner = 0; corner < 1u << D; ++corner) {
            Counts<D> at = block;
            for (int i = 0; i < D; ++i) at[i] += corner >> i & 1u;
            const double distance = std::abs(static_cast<double>(field_.coarse[linear_index(at, corners_)]));
            min_distance = std::min(min_distance, distance);
            max_distance = std::max(max_distance, distance);
        }
        // The distances at the corners are rounded to float.
        constexpr double rounding = 1 + 1e-6;
        const double half = 0.5 * lattice_.cell * brick_cells<D>;
        if (min_distance <= reach_) return true;
        if (min_distance > rounding * (reach_ + half_diagonal * half) ||
            max_distance > rounding * (reach_ + 2 * half_diagonal * half))
            return false;
        return is_near(lattice_.at(block * brick_cells<D>) + half, half);
    }

private:
    /// The distance from the center of a cube to a corner, as a multiple of half its edge, rounded up.
    static constexpr double half_diagonal = D == 2 ? 1.41421357 : 1.73205081;

    bool is_near(const DVec<D>& middle, double half) const {
        const double distance = source_.distance(middle);
        if (distance <= reach_) return true;
        if (distance > reach_ + half_diagonal * half) return false;
        if (half <= 0.5 * lattice_.cell) return true;
        for (std::uint32_t part = 0; part < 1u << D; ++part) {
            DVec<D> there = middle;
            for (int i = 0; i < D; ++i) there[i] += (part >> i & 1u) != 0 ? 0.5 * half : -0.5 * half;
            if (is_near(there, 0.5 * half)) return true;
        }
        return false;
    }

    const FieldData<D>& field_;
    const SampleSource<D>& source_;
    SampleLattice<D> lattice_;
    Counts<D> corners_;
    double reach_;
};

/// Assigns shared samples: neighbouring bricks share the samples on their sides. Each sample is evaluated once, with
/// the block on whose lower side it lies.
template <int D>
class BrickOwners {
public:
    static constexpr std::uint32_t side = brick_cells<D>;

    explicit BrickOwners(const FieldData<D>& field)
        : along_(blocks_along(field) + 1u), owner_(grid_size(along_), no_brick) {
        const Counts<D> blocks = blocks_along(field);
        for (std::size_t number = 0; number < field.brick.size(); ++number) {
            if (field.brick[number] == no_brick) continue;
            const Counts<D> block = grid_index(number, blocks);
            for (std::uint32_t beside = 0; beside < 1u << D; ++beside) {
                const Counts<D> at = shifted(block, beside);
                std::uint32_t& owner = owner_[linear_index(at, along_)];
                if (owner == no_brick) {
                    owner = static_cast<std::uint32_t>(blocks_.size());
                    blocks_.push_back({at * side, Counts<D>(1u), 1});
                }
                for (int i = 0; i < D; ++i)
                    if ((beside >> i & 1u) == 0) blocks_[owner].count[i] = side;
            }
        }
    }

    std::size_t count() const { return blocks_.size(); }
    const SampleBlock<D>& block(std::size_t owner) const { return blocks_[owner]; }
    static std::size_t first(std::size_t owner) { return owner * max_block_samples<D>; }

    /// Calls visit(number in the brick, index in the owners' arrays) for each sample of a block.
    template <class Visit>
    void each_of_brick(const Counts<D>& block, Visit visit) const {
        std::array<std::uint32_t, 1u << D> owners;
        for (std::uint32_t beside = 0; beside < 1u << D; ++beside)
            owners[beside] = owner_[linear_index(shifted(block, beside), along_)];
        for (std::uint32_t number = 0; number < brick_samples<D>; ++number) {
            std::uint32_t rest = number, beside = 0, place = 0, rows = 1;
            Counts<D> local;
            for (int i = 0; i < D; ++i) {
                local[i] = rest % (side + 1);
                rest /= side + 1;
                if (local[i] < side) continue;
                local[i] = 0;
                beside |= 1u << i;
            }
            const std::uint32_t owner = owners[beside];
            for (int i = 0; i < D; ++i) {
                place += rows * local[i];
                rows *= blocks_[owner].count[i];
            }
            visit(number, first(owner) + place);
        }
    }

private:
    static Counts<D> shifted(Counts<D> block, std::uint32_t beside) {
        for (int i = 0; i < D; ++i) block[i] += beside >> i & 1u;
        return block;
    }

    Counts<D> along_;
    std::vector<std::uint32_t> owner_;
    std::vector<SampleBlock<D>> blocks_;
};

template <int D>
void store_samples(FieldData<D>& field, SampleArrays<D>& stored) {
    field.distance = std::move(stored.distance);
    field.gradient = std::move(stored.gradient);
    field.closest = std::move(stored.closest);
}

template <int D>
bool fill_dense(FieldData<D>& field, const SampleSource<D>& source, const FieldOptions<D>& options, BakeJob& work,
                FieldReport& report) {
    const Counts<D> along = samples_along(field);
    SampleArrays<D> stored(grid_size(along), options, !report.closed);
    if (!work.begin(0.9) || !evaluate_all(source, along, 1, work, stored.from(0))) return false;
    report.uncertain += stored.uncertain_count();
    store_samples(field, stored);
    return true;
}

template <int D>
Result<FieldData<D>> fill_sparse(FieldData<D> field, const SampleSource<D>& source, const FieldOptions<D>& options,
                                 BakeJob& work, FieldReport& report) {
    const Counts<D> blocks = blocks_along(field);
    std::vector<std::uint8_t> uncertain(report.closed ? 0 : grid_size(blocks + 1u));
    field.coarse.resize(grid_size(blocks + 1u));
    const SampleValues<D> corners{field.coarse.data(), nullptr, nullptr, report.closed ? nullptr : uncertain.data()};
    if (!work.begin(0.15) || !evaluate_all(source, blocks + 1u, brick_cells<D>, work, corners))
        return BakeJob::cancelled();
    report.uncertain += std::accumulate(uncertain.begin(), uncertain.end(), std::size_t{0});

    field.brick.resize(grid_size(blocks));
    const NearBlocks<D> near(field, source, static_cast<double>(options.band));
    const auto classify = [&](std::size_t block) { field.brick[block] = near.is_near(block) ? 0 : no_brick; };
    if (!work.begin(0.05) || !work.each(field.brick.size(), classify)) return BakeJob::cancelled();
    std::uint32_t bricks = 0;
    for (std::uint32_t& brick : field.brick)
        if (brick != no_brick) brick = bricks++;
    const double samples = static_cast<double>(bricks) * brick_samples<D> + static_cast<double>(field.coarse.size());
    if (samples > max_field_samples) return too_many();

    const BrickOwners<D> owners(field);
    SampleArrays<D> evaluated(owners.count() * max_block_samples<D>, options, !report.closed);
    const auto evaluate = [&](std::size_t owner) {
        source.evaluate(owners.block(owner), evaluated.from(BrickOwners<D>::first(owner)));
    };
    if (!work.begin(0.65) || !work.each(owners.count(), evaluate)) return BakeJob::cancelled();

    SampleArrays<D> stored(std::size_t{bricks} * brick_samples<D>, options, !report.closed);
    const auto gather = [&](std::size_t block) {
        if (field.brick[block] == no_brick) return;
        const std::size_t first = std::size_t{field.brick[block]} * brick_samples<D>;
        owners.each_of_brick(grid_index(block, blocks), [&](std::uint32_t number, std::size_t place) {
            stored.copy(first + number, evaluated, place);
        });
    };
    if (!work.begin(0.05) || !work.each(field.brick.size(), gather)) return BakeJob::cancelled();
    report.uncertain += stored.uncertain_count();
    store_samples(field, stored);
    return field;
}

}  // namespace

template <int D>
Result<Field<D>> fill_field(FieldData<D> grid, const SampleSource<D>& source, const FieldOptions<D>& options,
                            BakeJob& work, FieldReport& report) {
    static_assert(brick_cells<D> == max_block_side<D>, "an owner's samples are one block");
    if (grid.store == FieldStore::dense) {
        if (!fill_dense(grid, source, options, work, report)) return BakeJob::cancelled();
    } else {
        Result<FieldData<D>> sparse = fill_sparse(std::move(grid), source, options, work, report);
        if (!sparse) return sparse.problem();
        grid = *std::move(sparse);
    }
    if (fault_of_numbers(grid))
        return Problem{ProblemCode::bad_argument,
                       "the surface of a field is beyond 2^60 cells or 2^100 from its volume"};
    if (options.quantised) quantise(grid);
    report.samples = grid.samples() + grid.coarse.size();
    if (!work.finish()) return BakeJob::cancelled();
    Field<D> field(std::move(grid));
    report.bytes = field.bytes();
    return field;
}

template Result<Field<2>> fill_field(FieldData<2>, const SampleSource<2>&, const FieldOptions<2>&, BakeJob&,
                                     FieldReport&);
template Result<Field<3>> fill_field(FieldData<3>, const SampleSource<3>&, const FieldOptions<3>&, BakeJob&,
                                     FieldReport&);

}  // namespace abut::detail
