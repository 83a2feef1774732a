// Bytes as fields: whatever they are, they are refused or make a field that can be asked anything and saved again.

#include "../oracle/seal.hpp"
#include <abut/field/field_blob.hpp>
#include <abut/field/field_check.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

namespace {

using namespace abut;

void require(bool condition) {
    if (!condition) std::abort();
}

template <int D>
void check(std::span<const std::byte> bytes) {
    const Result<Field<D>> field = load_field<D>(bytes);
    if (!field) {
        require(!field.problem().message.empty());
        return;
    }
    require(fault_of(field->data()) == nullptr);
    const std::vector<std::byte> again = save(*field);
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
    const Aabb<D> volume = field->volume();
    for (unsigned i = 0; i < 27; ++i) {
        Vec<D> point;
        unsigned rest = i;
        for (int a = 0; a < D; ++a, rest /= 3)
            point[a] = rest % 3 == 0   ? volume.min[a]
                       : rest % 3 == 1 ? volume.max[a]
                                       : 0.3f * volume.min[a] + 0.7f * volume.max[a] + field->cell();
        float distance = 0;
        field->distance(std::span(&point, 1), std::span(&distance, 1));
        const float one = field->distance(point);
        require(std::memcmp(&distance, &one, sizeof(one)) == 0);
        field->sample(point);
        field->closest(point);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
    check<2>(bytes);
    check<3>(bytes);
    if (size < 8) return 0;
    // With the checksum set right, so that what comes behind it is reached.
    std::vector<std::byte> whole(bytes.begin(), bytes.end());
    oracle::seal(whole);
    check<2>(whole);
    check<3>(whole);
    return 0;
}
