#include <abut/io/file/base64.hpp>
#include <abut/io/gltf/accessors.hpp>
#include <abut/io/gltf/decompress.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace abut::gltf {

using detail::no_index;

// Elements at a constant stride in a buffer.
struct AccessorReader::Elements {
    std::span<const std::byte> bytes;
    std::uint64_t stride = 0;
};

namespace {

// Elements of an accessor without a buffer view are zero: this limits the memory that a few bytes of JSON can allocate.
constexpr std::uint64_t max_elements_without_data = 1u << 24;

enum ComponentType : std::uint32_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

/// Size in bytes; 0 for an unknown component type.
std::uint64_t size_of(std::uint32_t component) {
    switch (component) {
        case int8:
        case uint8:
            return 1;
        case int16:
        case uint16:
            return 2;
        case uint32:
        case float32:
            return 4;
        default:
            return 0;
    }
}

std::uint32_t little_endian(const std::byte* bytes, std::uint64_t size) {
    std::uint32_t result = 0;
    for (std::uint64_t i = 0; i < size; ++i) result |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
    return result;
}

double number(const std::byte* bytes, std::uint32_t component, bool normalized) {
    const std::uint32_t raw = little_endian(bytes, size_of(component));
    switch (component) {
        case int8: {
            const double value = static_cast<std::int8_t>(raw);
            return normalized ? std::max(value / 127, -1.0) : value;
        }
        case uint8:
            return normalized ? raw / 255.0 : raw;
        case int16: {
            const double value = static_cast<std::int16_t>(raw);
            return normalized ? std::max(value / 32767, -1.0) : value;
        }
        case uint16:
            return normalized ? raw / 65535.0 : raw;
        case float32:
            return static_cast<double>(std::bit_cast<float>(raw));
        default:
            return raw;
    }
}

std::string text(const char* array, std::uint32_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// Decodes percent escapes such as %20.
std::string decode_percent(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape =
            uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
        result += escape ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
        if (escape) i += 2;
    }
    return result;
}

Result<std::vector<std::byte>> load(const std::string& uri, const detail::ReferencedFiles& files) {
    constexpr std::string_view base64 = ";base64,";
    if (!uri.starts_with("data:")) {
        const std::string name = decode_percent(uri);
        Result<std::vector<std::byte>> bytes = files.bytes(name);
        if (!bytes) return Problem{bytes.problem().code, detail::quoted_name(name) + ": " + bytes.problem().message};
        return bytes;
    }
    const std::size_t marker = uri.find(base64);
    if (marker == std::string::npos) return Problem{ProblemCode::bad_format, "embedded data isn't base64"};
    return detail::decode_base64(std::string_view(uri).substr(marker + base64.size()));
}

}  // namespace

AccessorReader::AccessorReader(const Document& document, detail::ReferencedFiles files)
    : document_(document),
      files_(std::move(files)),
      loaded_(document.buffers.size()),
      decoded_(document.compressions.size()),
      is_loaded_(document.buffers.size(), false) {}

Result<std::span<const std::byte>> AccessorReader::buffer(std::uint32_t index) {
    const Buffer& buffer = document_.buffers[index];
    std::span<const std::byte> bytes = document_.binary;
    if (!buffer.uri.empty()) {
        if (!is_loaded_[index]) {
            Result<std::vector<std::byte>> loaded = load(buffer.uri, files_);
            if (!loaded)
                return Problem{loaded.problem().code, text("buffers", index) + ": " + loaded.problem().message};
            loaded_[index] = *std::move(loaded);
            is_loaded_[index] = true;
        }
        bytes = loaded_[index];
    }
    if (bytes.size() < buffer.length)
        return Problem{ProblemCode::bad_format, text("buffers", index) +
                                                    " is truncated: " + std::to_string(bytes.size()) + " of " +
                                                    std::to_string(buffer.length) + " bytes"};
    return bytes.first(buffer.length);
}

Result<std::span<const std::byte>> AccessorReader::range(std::uint32_t index, std::uint64_t offset,
                                                         std::uint64_t length, const std::string& where) {
    if (index == no_index) return Problem{ProblemCode::bad_format, where + ".buffer: an index was expected"};
    const Result<std::span<const std::byte>> bytes = buffer(index);
    if (!bytes) return bytes.problem();
    if (offset > bytes->size() || length > bytes->size() - offset)
        return Problem{ProblemCode::index_out_of_range, where + " reaches past the end of its buffer"};
    return bytes->subspan(offset, length);
}

Result<std::span<const std::byte>> AccessorReader::view(std::uint32_t index) {
    const BufferView& view = document_.views[index];
    const std::string where = text("bufferViews", index);
    if (view.compression == no_index) return range(view.buffer, view.offset, view.length, where);
    std::vector<std::byte>& decoded = decoded_[view.compression];
    if (decoded.empty()) {
        const Compression& compression = document_.compressions[view.compression];
        const Result<std::span<const std::byte>> bytes =
            range(compression.buffer, compression.offset, compression.length, where);
        if (!bytes) return bytes.problem();
        Result<std::vector<std::byte>> result = decode_meshopt(compression, *bytes);
        if (!result) return Problem{result.problem().code, where + ": " + result.problem().message};
        decoded = *std::move(result);
    }
    return std::span<const std::byte>(decoded);
}

// `count` elements of `size` bytes in a buffer view. Requires count >= 1 and 1 <= size <= 64.
Result<AccessorReader::Elements> AccessorReader::elements(std::uint32_t view_index, std::uint64_t offset,
                                                          std::uint64_t count, std::uint64_t size) {
    const BufferView& view = document_.views[view_index];
    const Result<std::span<const std::byte>> bytes = this->view(view_index);
    if (!bytes) return bytes.problem();
    const std::uint64_t own_stride =
        view.compression == no_index ? view.stride : document_.compressions[view.compression].stride;
    const std::uint64_t stride = own_stride == 0 ? size : own_stride;
    const std::uint64_t length = bytes->size();
    const bool fits = offset <= length && size <= length - offset && count - 1 <= (length - offset - size) / stride;
    if (!fits)
        return Problem{ProblemCode::index_out_of_range,
                       text("bufferViews", view_index) + " has " + std::to_string(length) + " bytes, too few for " +
                           std::to_string(count) + " elements of " + std::to_string(size) + " bytes"};
    return Elements{bytes->subspan(offset), stride};
}

template <class Number, class Convert>
Result<std::vector<Number>> AccessorReader::read(std::uint32_t index, std::uint32_t components, Convert convert) {
    const Accessor& accessor = document_.accessors[index];
    const auto problem = [&](ProblemCode code, const std::string& what) {
        return Problem{code, text("accessors", index) + ": " + what};
    };
    const std::uint64_t size = size_of(accessor.component);
    if (size == 0)
        return problem(ProblemCode::bad_format, "unknown componentType " + std::to_string(accessor.component));
    if (accessor.components != components)
        return problem(ProblemCode::bad_format,
                       "elements of " + std::to_string(components) + " components were expected");
    if (accessor.count == 0) return std::vector<Number>();
    const auto copy = [&](const std::byte* from, Number* to) {
        for (std::uint32_t i = 0; i < components; ++i) to[i] = convert(from + i * size, accessor);
    };

    std::vector<Number> result;
    if (accessor.view == no_index) {
        if (accessor.count > max_elements_without_data)
            return problem(ProblemCode::too_large, std::to_string(accessor.count) + " elements without data");
        result.resize(accessor.count * components);
    } else {
        const Result<Elements> from = elements(accessor.view, accessor.offset, accessor.count, size * components);
        if (!from) return problem(from.problem().code, from.problem().message);
        result.resize(accessor.count * components);
        for (std::uint64_t i = 0; i < accessor.count; ++i)
            copy(from->bytes.data() + i * from->stride, result.data() + i * components);
    }
    if (accessor.sparse_count == 0) return result;

    const std::uint64_t index_size = size_of(accessor.sparse_indices_component);
    if (index_size == 0 || accessor.sparse_indices_view == no_index || accessor.sparse_values_view == no_index)
        return problem(ProblemCode::bad_format, "sparse: indices or values are missing");
    const Result<Elements> index_data =
        elements(accessor.sparse_indices_view, accessor.sparse_indices_offset, accessor.sparse_count, index_size);
    if (!index_data) return problem(index_data.problem().code, index_data.problem().message);
    const Result<Elements> from =
        elements(accessor.sparse_values_view, accessor.sparse_values_offset, accessor.sparse_count, size * components);
    if (!from) return problem(from.problem().code, from.problem().message);
    for (std::uint64_t i = 0; i < accessor.sparse_count; ++i) {
        const std::uint32_t place = little_endian(index_data->bytes.data() + i * index_data->stride, index_size);
        if (place >= accessor.count)
            return problem(ProblemCode::index_out_of_range, "sparse: index " + std::to_string(place) +
                                                                " is out of range (" + std::to_string(accessor.count) +
                                                                " elements)");
        copy(from->bytes.data() + i * from->stride, result.data() + place * components);
    }
    return result;
}

Result<std::vector<double>> AccessorReader::numbers(std::uint32_t accessor, std::uint32_t components) {
    return read<double>(accessor, components, [](const std::byte* bytes, const Accessor& from) {
        return number(bytes, from.component, from.normalized);
    });
}

Result<std::vector<std::uint32_t>> AccessorReader::indices(std::uint32_t accessor) {
    const std::uint32_t component = document_.accessors[accessor].component;
    if (component != uint8 && component != uint16 && component != uint32)
        return Problem{ProblemCode::bad_format, text("accessors", accessor) + ": indices aren't unsigned integers"};
    return read<std::uint32_t>(accessor, 1, [](const std::byte* bytes, const Accessor& from) {
        return little_endian(bytes, size_of(from.component));
    });
}

}  // namespace abut::gltf
