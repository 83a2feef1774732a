#pragma once

// Reads accessors of a glTF file through their buffer views and buffers.

#include <abut/io/file/referenced_files.hpp>
#include <abut/io/gltf/document.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut::gltf {

/// Reads accessors. Buffers are loaded on first use. Every range is checked before a byte is read.
class AccessorReader {
public:
    /// Refers to the document. External buffers are found among `files`.
    AccessorReader(const Document& document, detail::ReferencedFiles files);

    /// `components` numbers per element. Normalized integers are converted to [0, 1] or [-1, 1].
    Result<std::vector<double>> numbers(std::uint32_t accessor, std::uint32_t components);

    /// One unsigned integer per element.
    Result<std::vector<std::uint32_t>> indices(std::uint32_t accessor);

    /// The bytes of a buffer view, decompressed.
    Result<std::span<const std::byte>> view(std::uint32_t view);

private:
    struct Elements;

    Result<std::span<const std::byte>> buffer(std::uint32_t buffer);
    Result<std::span<const std::byte>> range(std::uint32_t buffer, std::uint64_t offset, std::uint64_t length,
                                             const std::string& where);
    Result<Elements> elements(std::uint32_t view, std::uint64_t offset, std::uint64_t count, std::uint64_t size);
    template <class Number, class Convert>
    Result<std::vector<Number>> read(std::uint32_t accessor, std::uint32_t components, Convert convert);

    const Document& document_;
    detail::ReferencedFiles files_;
    std::vector<std::vector<std::byte>> loaded_;
    std::vector<std::vector<std::byte>> decoded_;  ///< by Document::compressions; empty: not yet
    std::vector<bool> is_loaded_;
};

}  // namespace abut::gltf
