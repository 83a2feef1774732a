#pragma once

// Binary serialisation: numbers as little-endian bytes, the same on every machine. Baked data is saved in this form.

#include <abut/math/vec.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// Converts a number to or from little-endian order.
template <class T>
requires std::is_arithmetic_v<T> || std::is_enum_v<T> T little(T number) {
    if constexpr (std::endian::native == std::endian::little || sizeof(T) == 1) {
        return number;
    } else {
        std::array<std::byte, sizeof(T)> bytes;
        std::memcpy(bytes.data(), &number, sizeof(T));
        std::reverse(bytes.begin(), bytes.end());
        std::memcpy(&number, bytes.data(), sizeof(T));
        return number;
    }
}

/// A step of a checksum or hash over 64-bit words: a bijection of the state, so a single wrong word is always detected.
inline void add_to_checksum(std::uint64_t& state, std::uint64_t word) {
    state = (state ^ word) * 0x9e3779b97f4a7c15u;
    state ^= state >> 32;
}

/// A checksum over 64-bit words; the last word is padded with zeros. Word i belongs to the sum of number i modulo
/// `sums`; several sums are faster, because their steps don't depend on each other.
template <std::size_t sums = 1>
std::uint64_t blob_checksum(std::span<const std::byte> bytes) {
    constexpr std::size_t block = sums * sizeof(std::uint64_t);
    std::array<std::uint64_t, sums> states;
    states.fill(bytes.size());
    std::size_t i = 0;
    for (; i + block <= bytes.size(); i += block)
        for (std::size_t k = 0; k < sums; ++k) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i + k * sizeof(word), sizeof(word));
            add_to_checksum(states[k], little(word));
        }
    for (std::size_t k = 0; i < bytes.size(); i += sizeof(std::uint64_t), ++k) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
        add_to_checksum(states[k], little(word));
    }
    for (std::size_t k = 1; k < sums; ++k) add_to_checksum(states[0], states[k]);
    return states[0];
}

/// The scalar type of an item: for a vector that of its coordinates.
template <class T>
struct BlobScalar {
    using type = T;
};
template <int N, class T>
struct BlobScalar<glm::vec<N, T>> {
    using type = T;
};

/// Converts an item to or from little-endian order, scalar by scalar.
template <class T>
T little_scalars(T item) {
    using Number = typename BlobScalar<T>::type;
    std::array<Number, sizeof(T) / sizeof(Number)> numbers;
    std::memcpy(numbers.data(), &item, sizeof(T));
    for (Number& each : numbers) each = little(each);
    std::memcpy(static_cast<void*>(&item), numbers.data(), sizeof(T));
    return item;
}

class BlobWriter {
public:
    template <class T>
    void number(T value) {
        const T ordered = little(value);
        raw(&ordered, sizeof(T));
    }
    template <class T>
    void array(std::span<const T> values) {
        if constexpr (std::endian::native == std::endian::little) {
            raw(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) {
                const T ordered = little_scalars(value);
                raw(&ordered, sizeof(T));
            }
        }
    }
    /// Appends the checksum of all bytes so far.
    template <std::size_t sums = 1>
    void checksum() {
        number(blob_checksum<sums>(bytes));
    }

    std::vector<std::byte> bytes;

private:
    void raw(const void* from, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(from);
        bytes.insert(bytes.end(), first, first + size);
    }
};

/// Reads numbers from the front of the bytes.
class BlobReader {
public:
    explicit BlobReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::size_t left() const { return bytes_.size(); }

    /// Returns false if there are too few bytes left.
    template <class T>
    bool number(T& value) {
        if (bytes_.size() < sizeof(T)) return false;
        std::memcpy(&value, bytes_.data(), sizeof(T));
        value = little(value);
        bytes_ = bytes_.subspan(sizeof(T));
        return true;
    }
    /// Reads `count` numbers. The number of bytes is checked before memory is allocated.
    template <class T, class Allocator>
    bool array(std::vector<T, Allocator>& values, std::uint64_t count) {
        if (count > bytes_.size() / sizeof(T)) return false;
        const auto size = static_cast<std::size_t>(count) * sizeof(T);
        values.clear();
        values.reserve(static_cast<std::size_t>(count));
        // By parts that stay in the cache: the bytes needn't be aligned, and a resize would set the items to zero
        // first.
        std::array<T, std::max<std::size_t>(1, 4096 / sizeof(T))> part;
        for (std::size_t next = 0; next < size;) {
            const std::size_t part_size = std::min(sizeof(part), size - next);
            std::memcpy(static_cast<void*>(part.data()), bytes_.data() + next, part_size);
            next += part_size;
            const std::span<T> items(part.data(), part_size / sizeof(T));
            if constexpr (std::endian::native != std::endian::little)
                for (T& value : items) value = little_scalars(value);
            values.insert(values.end(), items.begin(), items.end());
        }
        bytes_ = bytes_.subspan(size);
        return true;
    }
    /// Removes so many bytes from the front, without a copy.
    bool bytes(std::span<const std::byte>& part, std::uint64_t count) {
        if (count > bytes_.size()) return false;
        part = bytes_.first(static_cast<std::size_t>(count));
        bytes_ = bytes_.subspan(part.size());
        return true;
    }
    /// Removes the checksum from the end. Returns false if it doesn't match the bytes of `whole` before it, or if too
    /// few bytes are left.
    template <std::size_t sums = 1>
    bool checksum(std::span<const std::byte> whole) {
        std::uint64_t sum = 0;
        if (bytes_.size() < sizeof(sum)) return false;
        const std::size_t before = whole.size() - sizeof(sum);
        BlobReader(whole.subspan(before)).number(sum);
        bytes_ = bytes_.first(bytes_.size() - sizeof(sum));
        return sum == blob_checksum<sums>(whole.first(before));
    }

private:
    std::span<const std::byte> bytes_;
};

}  // namespace abut::detail
