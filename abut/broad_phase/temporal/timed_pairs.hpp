#pragma once

// Pairs, each with the time at which it is due to be tested again. For .cpp files.

#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/visit.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut::detail {

/// Stores pairs in blocks, in the order in which they were added. A block has the earliest time of its pairs, so that
/// blocks in which nothing is due are skipped. 12.2 bytes a pair.
class TimedPairs {
public:
    static constexpr std::size_t block = 64;
    static constexpr float never = std::numeric_limits<float>::infinity();

    struct Look {
        float due;
        bool touching;
    };

    void clear();
    void add(ItemPair pair, Look look);

    /// Stores look(pair) for each pair that is due at `now`. Calls fetch(pair) some pairs ahead, to prefetch.
    template <class Fetch, class F>
    std::size_t test_due(float now, Fetch fetch, F look) {
        constexpr std::size_t ahead = 8;
        std::array<std::uint32_t, at_once> due;
        std::size_t looks = 0, next_block = 0;
        while (next_block < next_.size()) {
            const std::size_t first_block = next_block, count = collect_due(now, next_block, due.data());
            for (std::size_t k = 0; k < std::min(ahead, count); ++k) fetch(pairs_[due[k]]);
            for (std::size_t k = 0; k < count; ++k) {
                if (k + ahead < count) fetch(pairs_[due[k + ahead]]);
                set(due[k], pairs_[due[k]], look(pairs_[due[k]]));
            }
            renew_next(now, first_block, next_block);
            looks += count;
        }
        return looks;
    }

    /// Removes the pairs that are not wanted. The order of the others stays.
    template <class F>
    void retain_if(F wanted) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (!wanted(pairs_[i])) continue;
            set(count++, pairs_[i], {due_[i], (touching_[i / block] >> i % block & 1) != 0});
        }
        shrink(count);
    }

    std::size_t size() const { return pairs_.size(); }
    std::size_t blocks() const { return next_.size(); }
    /// Adds the touching pairs of some blocks. Returns false as soon as the visitor does.
    bool add_touching(std::size_t begin, std::size_t end, PairBuffer& out) const;

private:
    static constexpr std::size_t at_once = 1024;

    /// Collects the indices of the pairs that are due, from a block on, and advances to the block after them.
    std::size_t collect_due(float now, std::size_t& next_block, std::uint32_t* out) const;
    /// Finds the earliest time of each block in which a pair was due.
    void renew_next(float now, std::size_t begin, std::size_t end);
    void set(std::size_t index, const ItemPair& pair, Look look) {
        pairs_[index] = pair;
        due_[index] = look.due;
        const std::uint64_t bit = std::uint64_t{1} << index % block;
        std::uint64_t& touching = touching_[index / block];
        touching = (touching & ~bit) | (look.touching ? bit : 0);
    }
    void shrink(std::size_t count);

    std::vector<ItemPair> pairs_;
    std::vector<float> due_;               // whole blocks: `never` behind the last
    std::vector<float> next_;              // of each block, the earliest
    std::vector<std::uint64_t> touching_;  // of each block, a bit a pair
};

}  // namespace abut::detail
