#pragma once

// Pairs on their way to a visitor, some at a time: one call of it through a pointer tells many. For .cpp files.

#include <abut/broad_phase/visit.hpp>

#include <array>
#include <cstddef>

namespace abut {

/// Hands on what it holds when it is full, and when it is told to.
class PairBuffer {
public:
    explicit PairBuffer(PairsCall visit) : visit_(visit) {}

    /// False where the visitor has had enough.
    bool add(std::uint32_t i, std::uint32_t j) {
        pairs_[count_++] = {i, j};
        return count_ < pairs_.size() || flush();
    }
    /// The lower number first. False where the visitor has had enough.
    bool add_sorted(std::uint32_t i, std::uint32_t j) { return i < j ? add(i, j) : add(j, i); }

    /// False where the visitor has had enough.
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

}  // namespace abut
