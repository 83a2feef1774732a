#pragma once

// Writes vectors and numbers as floats, one after the other.

#include <abut/c/detail/handles.hpp>

namespace abut::play {

class Numbers {
public:
    template <int D>
    void vec(const Vec<D>& v) {
        for (int i = 0; i < D; ++i) numbers_.push_back(v[i]);
    }
    void rotation(const Turn& turn) {
        for (const float x : std::bit_cast<std::array<float, 2>>(turn)) numbers_.push_back(x);
    }
    /// x, y, z and w, as in the C API.
    void rotation(const glm::quat& rotation) {
        numbers_.insert(numbers_.end(), {rotation.x, rotation.y, rotation.z, rotation.w});
    }
    void number(float value) { numbers_.push_back(value); }

    /// Replaces the bytes of the buffer.
    void write(abut_buffer& out) const {
        const auto bytes = std::as_bytes(std::span(numbers_));
        out.bytes.assign(bytes.begin(), bytes.end());
    }

private:
    std::vector<float> numbers_;
};

}  // namespace abut::play
