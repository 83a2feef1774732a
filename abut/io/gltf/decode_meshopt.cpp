#include <abut/io/gltf/decompress.hpp>

#include <string>

#ifdef ABUT_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace abut::gltf {

#ifdef ABUT_HAS_MESHOPTIMIZER

namespace {

// No encoder packs more than 64 bytes into one. The rest bounds the memory of small files.
constexpr std::uint64_t max_ratio = 128, max_bytes = std::uint64_t{1} << 30;

bool has_valid_stride(const Compression& compression) {
    const std::uint64_t stride = compression.stride;
    if (compression.mode != Compression::Mode::attributes) return stride == 2 || stride == 4;
    if (stride == 0 || stride > 256 || stride % 4 != 0) return false;
    if (compression.filter == Compression::Filter::octahedral) return stride == 4 || stride == 8;
    return compression.filter != Compression::Filter::quaternion || stride == 8;
}

bool decode(const Compression& compression, std::span<const std::byte> bytes, std::vector<std::byte>& to) {
    const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
    switch (compression.mode) {
        case Compression::Mode::attributes:
            return meshopt_decodeVertexBuffer(to.data(), compression.count, compression.stride, from, bytes.size()) ==
                   0;
        case Compression::Mode::triangles:
            return compression.count % 3 == 0 &&
                   meshopt_decodeIndexBuffer(to.data(), compression.count, compression.stride, from, bytes.size()) == 0;
        case Compression::Mode::indices:
            return meshopt_decodeIndexSequence(to.data(), compression.count, compression.stride, from, bytes.size()) ==
                   0;
    }
    return false;
}

void filter(const Compression& compression, std::vector<std::byte>& bytes) {
    switch (compression.filter) {
        case Compression::Filter::none:
            return;
        case Compression::Filter::octahedral:
            return meshopt_decodeFilterOct(bytes.data(), compression.count, compression.stride);
        case Compression::Filter::quaternion:
            return meshopt_decodeFilterQuat(bytes.data(), compression.count, compression.stride);
        case Compression::Filter::exponential:
            return meshopt_decodeFilterExp(bytes.data(), compression.count, compression.stride);
    }
}

}  // namespace

Result<std::vector<std::byte>> decode_meshopt(const Compression& compression, std::span<const std::byte> bytes) {
    if (!has_valid_stride(compression))
        return Problem{ProblemCode::bad_format,
                       "meshopt: byteStride can't be " + std::to_string(compression.stride) + " here"};
    if (compression.count == 0) return Problem{ProblemCode::bad_format, "meshopt: no elements"};
    if (compression.count > max_bytes / compression.stride ||
        compression.count * compression.stride > max_ratio * (bytes.size() + 64))
        return Problem{ProblemCode::too_large, "meshopt: " + std::to_string(compression.count) + " elements in " +
                                                   std::to_string(bytes.size()) + " bytes"};
    std::vector<std::byte> result(compression.count * compression.stride);
    if (!decode(compression, bytes, result))
        return Problem{ProblemCode::bad_format, "meshopt: the compressed data is damaged"};
    if (compression.mode == Compression::Mode::attributes) filter(compression, result);
    return result;
}

#else

Result<std::vector<std::byte>> decode_meshopt(const Compression&, std::span<const std::byte>) {
    return Problem{ProblemCode::bad_format, "is compressed by meshoptimizer, and this abut was built without it"};
}

#endif

}  // namespace abut::gltf
