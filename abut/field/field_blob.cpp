// All numbers are little endian: "abutfld\n", the version, the dimension, what a FieldData says of itself in the order
// of `each_number`, how long its arrays are, the arrays one after another, and a checksum of all before it.

#include <abut/field/field_blob.hpp>
#include <abut/field/field_check.hpp>
#include <abut/math/blob.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace abut {
namespace {

constexpr std::array<char, 8> magic{'a', 'b', 'u', 't', 'f', 'l', 'd', '\n'};
constexpr std::uint32_t version = 1;

/// What takes part of a FieldData besides its arrays, number by number; `data` may be const.
template <class Data, class Take>
void each_number(Data& data, Take take) {
    take(data.store);
    take(data.lookup);
    for (int a = 0; a < data.origin.length(); ++a) {
        take(data.origin[a]);
        take(data.cells[a]);
        take(data.surface.min[a]);
        take(data.surface.max[a]);
    }
    take(data.cell);
    take(data.step);
}
template <class Data, class Take>
void each_array(Data& data, Take take) {
    take(data.brick);
    take(data.coarse);
    take(data.distance);
    take(data.steps);
    take(data.direction);
    take(data.closest);
}

Problem problem(const char* message, ProblemCode code = ProblemCode::bad_format) {
    return {code, message};
}

}  // namespace

template <int D>
std::vector<std::byte> save(const Field<D>& field) {
    const FieldData<D>& data = field.data();
    BlobWriter writer;
    writer.bytes.reserve(256 + field.bytes());
    for (const char c : magic) writer.number(c);
    writer.number(version);
    writer.number(static_cast<std::uint32_t>(D));
    each_number(data, [&](const auto& number) { writer.number(number); });
    each_array(data, [&](const auto& array) { writer.number(static_cast<std::uint64_t>(array.size())); });
    each_array(data, [&](const auto& array) { writer.array(std::span(array)); });
    writer.checksum();
    return std::move(writer.bytes);
}

template <int D>
Result<Field<D>> load_field(std::span<const std::byte> bytes) {
    BlobReader reader(bytes);
    std::array<char, 8> start{};
    for (char& c : start)
        if (!reader.number(c)) return problem("this is no field: it ends within the first bytes");
    if (start != magic) return problem("this is no field: it begins with other bytes");
    std::uint32_t number = 0;
    if (!reader.number(number)) return problem("the field ends too soon");
    if (number != version) return problem("the field is of another version");
    if (!reader.number(number)) return problem("the field ends too soon");
    if (number != D) return problem(D == 2 ? "the field isn't one of the plane" : "the field isn't one of space");

    if (reader.left() < sizeof(std::uint64_t)) return problem("the field ends too soon");
    if (!reader.checksum(bytes)) return problem("the field is damaged: its checksum is another");

    FieldData<D> data;
    bool whole = true;
    each_number(data, [&](auto& value) { whole = whole && reader.number(value); });
    std::array<std::uint64_t, 6> counts{};
    for (std::uint64_t& count : counts) whole = whole && reader.number(count);
    // Each array is checked before there is memory for it: the bytes that are left are enough.
    std::size_t next = 0;
    each_array(data, [&](auto& array) { whole = whole && reader.array(array, counts[next++]); });
    if (!whole) return problem("the field ends too soon");
    if (reader.left() != 0) return problem("the field goes on behind its end");

    if (data.store > FieldStore::sparse || data.lookup > FieldLookup::gradient)
        return problem("the field is of a kind that there isn't");
    if (!std::isfinite(data.cell) || !std::isfinite(data.step) || !is_finite<D>(data.origin))
        return problem("a number of the field is NaN or infinite", ProblemCode::not_finite);
    if (data.steps.empty() && std::bit_cast<std::uint32_t>(data.step) != 0)
        return problem("the field has a step and no steps");
    if (std::optional<Problem> fault = fault_of(data)) return *std::move(fault);
    return Field<D>(std::move(data));
}

int field_dimension(std::span<const std::byte> bytes) {
    BlobReader reader(bytes);
    std::array<char, 8> start{};
    for (char& c : start)
        if (!reader.number(c)) return 0;
    std::uint32_t number = 0, dimension = 0;
    const bool is_field = start == magic && reader.number(number) && number == version && reader.number(dimension);
    return is_field && (dimension == 2 || dimension == 3) ? static_cast<int>(dimension) : 0;
}

template std::vector<std::byte> save(const Field<2>&);
template std::vector<std::byte> save(const Field<3>&);
template Result<Field<2>> load_field<2>(std::span<const std::byte>);
template Result<Field<3>> load_field<3>(std::span<const std::byte>);

}  // namespace abut
