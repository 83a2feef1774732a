#pragma once

// The bytes of everything that the library saves, and reading them on another machine.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace abut::everywhere {

struct Blob {
    std::string name;
    std::vector<std::byte> bytes;
    /// Loads the bytes, which may be another machine's, and saves what it loaded. Empty if they are refused.
    std::vector<std::byte> (*save_again)(std::span<const std::byte> bytes);
};

std::vector<Blob> blobs();

}  // namespace abut::everywhere
