#pragma once

// The numbers of a glTF file: buffers, and what accessors see in them.

#include <abut/io/gltf_document.hpp>
#include <abut/io/referenced_files.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::gltf {

/// Fetches buffers when they are first asked for. Every range is checked before a byte is read.
class Data {
public:
    /// Refers to the document. Buffers that aren't in it are among the files.
    Data(const Document& document, ReferencedFiles files);

    /// `components` numbers for each element, normalised integers as what they stand for.
    Result<std::vector<double>> numbers(std::uint32_t accessor, std::uint32_t components);

    /// Whole numbers, one for each element.
    Result<std::vector<std::uint32_t>> indices(std::uint32_t accessor);

private:
    struct Elements;

    Result<std::span<const std::byte>> buffer(std::uint32_t buffer);
    Result<Elements> elements(std::uint32_t view, std::uint64_t offset, std::uint64_t count, std::uint64_t size);
    template <class Number, class Convert>
    Result<std::vector<Number>> read(std::uint32_t accessor, std::uint32_t components, Convert convert);

    const Document& document_;
    ReferencedFiles files_;
    std::vector<std::vector<std::byte>> fetched_;
    std::vector<bool> is_fetched_;
};

}  // namespace abut::gltf
