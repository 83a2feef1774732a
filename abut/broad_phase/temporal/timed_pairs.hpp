#pragma once

// Pairs, each with the time at which it is due to be tested again. For .cpp files.

#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/visit.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::detail {

/// Stores pairs in blocks of 64, in the order in which they were added. A block has the earliest time of its pairs, so
/// that blocks in which nothing is due are skipped. 12.2 bytes a pair.
class TimedPairs {
public:
    static constexpr float never = std::numeric_limits<float>::infinity();

    struct Look {
        float due;
        bool touching;
    };

    void clear() { shrink(0); }
    void add(const ItemPair& pair, const Look& look);

    /// Stores look(pair) for each pair that is due at `now`, after fetch(pair) for those of a block. Returns how many
    /// there are.
    template <class Fetch, class F>
    std::size_t test_due(float now, const Fetch& fetch, const F& look) {
        std::size_t looks = 0;
        for (std::size_t k = 0; k < next_.size(); ++k) {
            if (next_[k] > now) continue;
            const std::uint64_t due = due_in(k, now);
            const auto index = [k](std::uint64_t bits) {
                return block * k + static_cast<std::size_t>(std::countr_zero(bits));
            };
            for (std::uint64_t bits = due; bits != 0; bits &= bits - 1) fetch(pairs_[index(bits)]);
            for (std::uint64_t bits = due; bits != 0; bits &= bits - 1, ++looks)
                set(index(bits), pairs_[index(bits)], look(pairs_[index(bits)]));
            next_[k] = earliest_in(k);
        }
        return looks;
    }

    /// Removes the pairs that are not wanted. The order of the others stays.
    template <class F>
    void retain_if(const F& wanted) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            if (wanted(pairs_[i])) set(count++, pairs_[i], {due_[i], (touching_[i / block] >> i % block & 1) != 0});
        shrink(count);
    }

    std::size_t size() const { return pairs_.size(); }
    std::size_t blocks() const { return next_.size(); }
    /// Adds the touching pairs of a block. Returns false as soon as the buffer does.
    bool add_touching(std::size_t block_index, PairBuffer& out) const;

private:
    static constexpr std::size_t block = 64;

    void set(std::size_t index, const ItemPair& pair, const Look& look) {
        pairs_[index] = pair;
        due_[index] = look.due;
        std::uint64_t& touching = touching_[index / block];
        touching = (touching & ~(std::uint64_t{1} << index % block)) | std::uint64_t{look.touching} << index % block;
    }
    void shrink(std::size_t count);
    /// The pairs of block k that are due, one bit each.
    std::uint64_t due_in(std::size_t k, float now) const;
    float earliest_in(std::size_t k) const;

    std::vector<ItemPair> pairs_;
    std::vector<float> due_;               // whole blocks: `never` behind the last
    std::vector<float> next_;              // of each block, the earliest
    std::vector<std::uint64_t> touching_;  // of each block, a bit a pair
};

}  // namespace abut::detail
