// Bytes as fields: whatever they are, they are refused or make a field that can be asked anything and saved again.

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

/// The checksum set right, so that what comes behind it is reached.
std::vector<std::byte> sealed(std::span<const std::byte> bytes) {
    std::vector<std::byte> result(bytes.begin(), bytes.end());
    std::uint64_t sum = result.size();
    for (std::size_t i = 0; i < result.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, result.data() + i, std::min<std::size_t>(8, result.size() - i));
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 32;
    }
    for (unsigned i = 0; i < 8; ++i) result.push_back(static_cast<std::byte>(sum >> (8 * i) & 255));
    return result;
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
    const std::vector<std::byte> whole = sealed(bytes.first(size - 8));
    check<2>(whole);
    check<3>(whole);
    return 0;
}
