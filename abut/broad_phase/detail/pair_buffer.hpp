#pragma once

// Batches of pairs for a visitor: one call through a pointer reports up to 256 pairs. For .cpp files.

#include <abut/broad_phase/visit.hpp>

#include <array>
#include <cstddef>

namespace abut::detail {

/// Passes its pairs to the visitor when it is full, and on `flush`.
class PairBuffer {
public:
    explicit PairBuffer(PairsCall visit) : visit_(visit) {}

    /// Returns false if the visitor stops the search.
    bool add(std::uint32_t i, std::uint32_t j) {
        pairs_[count_++] = {i, j};
        return count_ < pairs_.size() || flush();
    }
    /// Adds the pair with its lower index first. Returns false if the visitor stops the search.
    bool add_sorted(std::uint32_t i, std::uint32_t j) { return i < j ? add(i, j) : add(j, i); }

    /// Returns false if the visitor stops the search.
    bool flush() {
        const std::size_t count = count_;
        count_ = 0;
        return visit_({pairs_.data(), count});
    }

private:
    PairsCall visit_;
    std::size_t count_ = 0;
    std::array<ItemPair, 256> pairs_;
};

}  // namespace abut::detail
