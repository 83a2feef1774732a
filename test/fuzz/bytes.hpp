#pragma once

// The input of a fuzz target as a sequence of bytes, and its assertion.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace abut::fuzz {

/// Unlike an assertion, it is there in all builds.
inline void require(bool condition, const char* what = "") {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

/// Numbers until the bytes end; then 0.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    bool empty() const { return left_ == 0; }
    std::uint8_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *data_++;
    }
    /// Mostly small integers, so that points coincide and are collinear; after 0xff any bits.
    float coordinate() {
        const std::uint8_t first = byte();
        if (first != 0xff) return static_cast<float>(first % 8);
        std::uint8_t bits[sizeof(float)];
        for (std::uint8_t& b : bits) b = byte();
        float result = 0;
        std::memcpy(&result, bits, sizeof result);
        return result;
    }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

}  // namespace abut::fuzz
