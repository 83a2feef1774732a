#pragma once

// Inputs with a right checksum, so that fuzzing reaches the code behind its check.

#include "../oracle/seal.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::fuzz {

/// Calls check(bytes) with the input, and with its last bytes replaced by the checksum, which is made of so many sums.
template <class Check>
void check_with_checksum(const std::uint8_t* data, std::size_t size, const Check& check, std::size_t sums = 1) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
    check(bytes);
    if (size < 8) return;
    std::vector<std::byte> whole(bytes.begin(), bytes.end());
    oracle::seal(whole, sums);
    check(std::span<const std::byte>(whole));
}

}  // namespace abut::fuzz
