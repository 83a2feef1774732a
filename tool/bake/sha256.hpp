#pragma once

// SHA-256, by OpenSSL's libcrypto.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace abut::tool {

/// Hashes bytes piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void add(std::span<const std::byte> bytes);
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }

    /// 64 hexadecimal digits. Call once, at the end.
    std::string digest();

private:
    struct State;
    std::unique_ptr<State> state_;
};

std::string sha256(std::span<const std::byte> bytes);

}  // namespace abut::tool
