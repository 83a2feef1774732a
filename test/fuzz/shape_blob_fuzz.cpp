// Loads any bytes as a shape of every kind: the load refuses them, or the shape is saved as the same bytes again and
// answers queries.

#include "../shape/saved_shapes.hpp"
#include "bytes.hpp"
#include "with_checksum.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

template <class S>
void check(std::span<const std::byte> bytes) {
    const Result<S> shape = test::load<S>(bytes);
    if (!shape) {
        require(!shape.problem().message.empty());
        return;
    }
    const std::vector<std::byte> again = test::file_of(*shape);
    const Result<S> loaded = test::load<S>(again);
    require(loaded && test::file_of(*loaded) == again);
    // A compound joins equal files of its children, and leaves out what queries don't need of them.
    constexpr bool may_differ = std::is_same_v<S, Compound2> || std::is_same_v<S, Compound3>;
    require(may_differ || std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
    std::uint64_t seed = 0;
    for (const std::byte b : bytes) seed = (seed ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    oracle::Random random(seed);
    int touching = 0;
    test::answers_of(*shape, random, 1, touching);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    abut::fuzz::check_with_checksum(
        data, size,
        [](std::span<const std::byte> bytes) { abut::test::each_saved_type([&]<class S>() { check<S>(bytes); }); }, 8);
    return 0;
}
