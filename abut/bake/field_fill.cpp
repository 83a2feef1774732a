#include <abut/bake/field_fill.hpp>
#include <abut/bake/field_grid.hpp>
#include <abut/field/field_check.hpp>
#include <abut/field/quantise.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace abut {
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

/// As many numbers of each kind as are wanted.
template <int D>
struct Kept {
    std::vector<float> distance;
    std::vector<Vec<D>> gradient, closest;
    std::vector<std::uint8_t> doubtful;

    Kept(std::size_t count, const FieldOptions<D>& options, bool doubts)
        : distance(count),
          gradient(options.lookup == FieldLookup::gradient ? count : 0),
          closest(options.closest_points ? count : 0),
          doubtful(doubts ? count : 0) {}

    SampleValues<D> from(std::size_t first) {
        const auto at = [&](auto& numbers) { return numbers.empty() ? nullptr : numbers.data() + first; };
        return {at(distance), at(gradient), at(closest), at(doubtful)};
    }
    void copy(std::size_t to, const Kept& from, std::size_t place) {
        distance[to] = from.distance[place];
        if (!gradient.empty()) gradient[to] = from.gradient[place];
        if (!closest.empty()) closest[to] = from.closest[place];
        if (!doubtful.empty()) doubtful[to] = from.doubtful[place];
    }
    std::size_t doubts() const { return std::accumulate(doubtful.begin(), doubtful.end(), std::size_t{0}); }
};

/// Samples of a box of them, block by block.
template <int D>
class Blocks {
public:
    Blocks(const Counts<D>& samples, std::uint32_t stride) : samples_(samples), stride_(stride) {
        for (int i = 0; i < D; ++i) blocks_[i] = (samples[i] + side - 1) / side;
    }

    std::size_t count() const { return count_of(blocks_); }
    SampleBlock<D> block(std::size_t number) const {
        SampleBlock<D> result;
        result.stride = stride_;
        const Counts<D> block = item_of(number, blocks_);
        for (int i = 0; i < D; ++i) {
            result.first[i] = block[i] * side * stride_;
            result.count[i] = std::min(side, samples_[i] - block[i] * side);
        }
        return result;
    }

private:
    static constexpr std::uint32_t side = most_block_side<D>;

    Counts<D> samples_, blocks_{};
    std::uint32_t stride_;
};

/// The numbers of a block on their way to where they are kept.
template <int D>
struct Told {
    std::array<float, most_block_samples<D>> distance;
    std::array<Vec<D>, most_block_samples<D>> gradient, closest;
    std::array<std::uint8_t, most_block_samples<D>> doubtful;
};

/// Tells all samples of a box of them, `stride` apart, into rows.
template <int D>
bool tell_all(const SampleSource<D>& source, const Counts<D>& samples, std::uint32_t stride, FieldWork& work,
              const SampleValues<D>& rows) {
    const Blocks<D> blocks(samples, stride);
    return work.each(blocks.count(), [&](std::size_t number) {
        const SampleBlock<D> block = blocks.block(number);
        Told<D> told;
        source.tell(block, {told.distance.data(), rows.gradient != nullptr ? told.gradient.data() : nullptr,
                            rows.closest != nullptr ? told.closest.data() : nullptr,
                            rows.doubtful != nullptr ? told.doubtful.data() : nullptr});
        each_sample(block, [&](const Counts<D>& sample, std::uint32_t i) {
            const std::size_t place = number_of<D>(sample / stride, samples);
            rows.distance[place] = told.distance[i];
            if (rows.gradient != nullptr) rows.gradient[place] = told.gradient[i];
            if (rows.closest != nullptr) rows.closest[place] = told.closest[i];
            if (rows.doubtful != nullptr) rows.doubtful[place] = told.doubtful[i];
        });
    });
}

/// Which blocks come near the surface: told by the distances at some of their points, which grow by no more than the
/// way from one to another.
template <int D>
class NearBlocks {
public:
    NearBlocks(const FieldData<D>& field, const SampleSource<D>& source, double band)
        : field_(field), source_(source), lattice_(lattice_of(field)), corners_(blocks_along(field) + 1u) {
        reach_ = band * lattice_.cell;
    }

    bool is_near(std::size_t number) const {
        const Counts<D> block = item_of(number, blocks_along(field_));
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (std::uint32_t corner = 0; corner < 1u << D; ++corner) {
            Counts<D> at = block;
            for (int i = 0; i < D; ++i) at[i] += corner >> i & 1u;
            const double distance = std::abs(static_cast<double>(field_.coarse[number_of(at, corners_)]));
            least = std::min(least, distance);
            most = std::max(most, distance);
        }
        // The corners are rounded to float.
        constexpr double doubt = 1 + 1e-6;
        const double half = 0.5 * lattice_.cell * brick_cells<D>;
        if (least <= reach_) return true;
        if (least > doubt * (reach_ + across * half) || most > doubt * (reach_ + 2 * across * half)) return false;
        return is_near(lattice_.at(block * brick_cells<D>) + half, half);
    }

private:
    /// The way from the middle of a cube to a corner, as a share of half its edge; no less.
    static constexpr double across = D == 2 ? 1.41421357 : 1.73205081;

    bool is_near(const DVec<D>& middle, double half) const {
        const double distance = source_.distance(middle);
        if (distance <= reach_) return true;
        if (distance > reach_ + across * half) return false;
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

/// Bricks share the samples on their sides: each sample is told once, with the block that it is the lower side of.
template <int D>
class Owners {
public:
    static constexpr std::uint32_t side = brick_cells<D>;

    explicit Owners(const FieldData<D>& field) : along_(blocks_along(field) + 1u), owner_(count_of(along_), no_brick) {
        const Counts<D> blocks = blocks_along(field);
        for (std::size_t number = 0; number < field.brick.size(); ++number) {
            if (field.brick[number] == no_brick) continue;
            const Counts<D> block = item_of(number, blocks);
            for (std::uint32_t beside = 0; beside < 1u << D; ++beside) {
                const Counts<D> at = shifted(block, beside);
                std::uint32_t& owner = owner_[number_of(at, along_)];
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
    static std::size_t first(std::size_t owner) { return owner * most_block_samples<D>; }

    /// Calls visit(number in the brick, place among what the owners hold) for each sample of a block.
    template <class Visit>
    void each_of_brick(const Counts<D>& block, Visit visit) const {
        std::array<std::uint32_t, 1u << D> owners;
        for (std::uint32_t beside = 0; beside < 1u << D; ++beside)
            owners[beside] = owner_[number_of(shifted(block, beside), along_)];
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
void keep(FieldData<D>& field, Kept<D>& kept) {
    field.distance = std::move(kept.distance);
    field.gradient = std::move(kept.gradient);
    field.closest = std::move(kept.closest);
}

template <int D>
bool fill_dense(FieldData<D>& field, const SampleSource<D>& source, const FieldOptions<D>& options, FieldWork& work,
                FieldReport& report) {
    const Counts<D> along = samples_along(field);
    Kept<D> kept(count_of(along), options, !report.closed);
    if (!work.begin(0.9) || !tell_all(source, along, 1, work, kept.from(0))) return false;
    report.doubtful += kept.doubts();
    keep(field, kept);
    return true;
}

template <int D>
Result<FieldData<D>> fill_sparse(FieldData<D> field, const SampleSource<D>& source, const FieldOptions<D>& options,
                                 FieldWork& work, FieldReport& report) {
    const Counts<D> blocks = blocks_along(field);
    std::vector<std::uint8_t> doubtful(report.closed ? 0 : count_of(blocks + 1u));
    field.coarse.resize(count_of(blocks + 1u));
    const SampleValues<D> corners{field.coarse.data(), nullptr, nullptr, report.closed ? nullptr : doubtful.data()};
    if (!work.begin(0.15) || !tell_all(source, blocks + 1u, brick_cells<D>, work, corners))
        return FieldWork::cancelled();
    report.doubtful += std::accumulate(doubtful.begin(), doubtful.end(), std::size_t{0});

    field.brick.resize(count_of(blocks));
    const NearBlocks<D> near(field, source, static_cast<double>(options.band));
    const auto look_at = [&](std::size_t block) { field.brick[block] = near.is_near(block) ? 0 : no_brick; };
    if (!work.begin(0.05) || !work.each(field.brick.size(), look_at)) return FieldWork::cancelled();
    std::uint32_t bricks = 0;
    for (std::uint32_t& brick : field.brick)
        if (brick != no_brick) brick = bricks++;
    const double samples = static_cast<double>(bricks) * brick_samples<D> + static_cast<double>(field.coarse.size());
    if (samples > most_field_samples) return too_many();

    const Owners<D> owners(field);
    Kept<D> told(owners.count() * most_block_samples<D>, options, !report.closed);
    const auto tell = [&](std::size_t owner) { source.tell(owners.block(owner), told.from(Owners<D>::first(owner))); };
    if (!work.begin(0.65) || !work.each(owners.count(), tell)) return FieldWork::cancelled();

    Kept<D> kept(std::size_t{bricks} * brick_samples<D>, options, !report.closed);
    const auto gather = [&](std::size_t block) {
        if (field.brick[block] == no_brick) return;
        const std::size_t first = std::size_t{field.brick[block]} * brick_samples<D>;
        owners.each_of_brick(item_of(block, blocks),
                             [&](std::uint32_t number, std::size_t place) { kept.copy(first + number, told, place); });
    };
    if (!work.begin(0.05) || !work.each(field.brick.size(), gather)) return FieldWork::cancelled();
    report.doubtful += kept.doubts();
    keep(field, kept);
    return field;
}

}  // namespace

template <int D>
Result<Field<D>> fill_field(FieldData<D> grid, const SampleSource<D>& source, const FieldOptions<D>& options,
                            FieldWork& work, FieldReport& report) {
    static_assert(brick_cells<D> == most_block_side<D>, "an owner's samples are one block");
    if (grid.store == FieldStore::dense) {
        if (!fill_dense(grid, source, options, work, report)) return FieldWork::cancelled();
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
    if (!work.finish()) return FieldWork::cancelled();
    Field<D> field(std::move(grid));
    report.bytes = field.bytes();
    return field;
}

template Result<Field<2>> fill_field(FieldData<2>, const SampleSource<2>&, const FieldOptions<2>&, FieldWork&,
                                     FieldReport&);
template Result<Field<3>> fill_field(FieldData<3>, const SampleSource<3>&, const FieldOptions<3>&, FieldWork&,
                                     FieldReport&);

}  // namespace abut
