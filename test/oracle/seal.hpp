#pragma once

// Recomputes the checksum of saved bytes after a test has changed them. An implementation of its own, byte by byte.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut::oracle {

/// Replaces the last eight bytes by the checksum of all before them, which is made of several sums of every so many
/// words. There must be at least eight bytes.
inline void seal(std::vector<std::byte>& bytes, std::size_t sums = 1) {
    const std::size_t size = bytes.size() - 8;
    const auto add = [](std::uint64_t& sum, std::uint64_t word) {
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    };
    std::vector<std::uint64_t> each(sums, size);
    for (std::size_t i = 0; i < size; i += 8) {
        std::uint64_t word = 0;
        for (std::size_t j = i; j < std::min(i + 8, size); ++j)
            word |= static_cast<std::uint64_t>(bytes[j]) << (8 * (j - i));
        add(each[i / 8 % sums], word);
    }
    std::uint64_t sum = each[0];
    for (std::size_t k = 1; k < sums; ++k) add(sum, each[k]);
    for (std::size_t j = 0; j < 8; ++j) bytes[size + j] = static_cast<std::byte>(sum >> (8 * j) & 255);
}

}  // namespace abut::oracle
