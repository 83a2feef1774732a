#pragma once

// Pairs, each with the moment at which it is to be looked at again. For .cpp files.

#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/visit.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut {

/// They lie in the order in which they were added, in blocks; a block knows its earliest moment, so that those in which
/// nothing is due are passed over. 12.2 bytes a pair.
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

    /// Asks `look(pair)` for each that is due at `now`, and keeps its answer. `fetch(pair)` tells of one that comes
    /// soon.
    template <class Fetch, class F>
    std::size_t look_at_due(float now, Fetch fetch, F look) {
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

    /// Drops the others; the order stays.
    template <class F>
    void keep_if(F wanted) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (!wanted(pairs_[i])) continue;
            set(kept++, pairs_[i], {due_[i], (touching_[i / block] >> i % block & 1) != 0});
        }
        shrink(kept);
    }

    std::size_t size() const { return pairs_.size(); }
    std::size_t blocks() const { return next_.size(); }
    /// Tells those that touch, of the blocks from `begin` on. False where the visitor has had enough.
    bool tell(std::size_t begin, std::size_t end, PairBuffer& out) const;

private:
    static constexpr std::size_t at_once = 1024;

    /// The numbers of those that are due, from a block on; moves on to the block behind them.
    std::size_t collect_due(float now, std::size_t& next_block, std::uint32_t* out) const;
    /// Of the blocks in which something was due.
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

}  // namespace abut
