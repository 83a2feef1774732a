// Replays any bytes: they are refused in one line, or every difference has its entry and its question.

#include "../oracle/seal.hpp"
#include "bytes.hpp"
#include <abut/world/replay.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

void check(std::span<const std::byte> bytes) {
    const Result<ReplayReport> report = replay(bytes, {.max_differences = 3});
    if (!report) {
        require(!report.problem().message.empty() && report.problem().message.find('\n') == std::string::npos);
        return;
    }
    require(report->differences.size() <= 3 && report->differences.size() <= report->difference_count);
    for (const ReplayDifference& each : report->differences)
        require(each.entry < report->entries && !each.question.empty());
}

/// Seals so many bytes from a place on, which end in a checksum.
void seal(std::vector<std::byte>& bytes, std::size_t from, std::size_t size, std::size_t sums) {
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(from);
    std::vector<std::byte> part(first, first + static_cast<std::ptrdiff_t>(size));
    oracle::seal(part, sums);
    std::copy(part.begin(), part.end(), first);
}

/// With right checksums, as far as the sizes lead.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
    constexpr std::size_t fields = 40, checksum = 8;
    if (bytes.size() < fields) return bytes;
    std::uint64_t world = 0;
    std::memcpy(&world, bytes.data() + fields - sizeof(world), sizeof(world));
    if (world < checksum || world > bytes.size() - fields) return bytes;
    seal(bytes, fields, world, 8);
    std::size_t at = fields + world + checksum;
    if (at > bytes.size()) return bytes;
    seal(bytes, 0, at, 4);
    while (bytes.size() - at >= 8) {
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + at, sizeof(size));
        const std::uint32_t complement = ~size;
        std::memcpy(bytes.data() + at + 4, &complement, sizeof(complement));
        at += 8;
        if (bytes.size() - at < std::size_t{size} + checksum) break;
        seal(bytes, at, size + checksum, 4);
        at += size + checksum;
    }
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
    check(bytes);
    check(sealed({bytes.begin(), bytes.end()}));
    return 0;
}
