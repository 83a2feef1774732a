// All numbers are little endian. The parts, in order: "abutfld\n", the version, the dimension, the scalars of a
// FieldData in the order of `each_number`, the sizes of its arrays, the arrays, and a checksum of everything before it.

#include <abut/field/check.hpp>
#include <abut/field/file.hpp>
#include <abut/math/detail/blob.hpp>

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

/// Visits the scalars of a FieldData; `data` may be const.
template <class Data, class Take>
void each_number(Data& data, Take visit) {
    visit(data.store);
    visit(data.lookup);
    for (int a = 0; a < data.origin.length(); ++a) {
        visit(data.origin[a]);
        visit(data.cells[a]);
        visit(data.surface.min[a]);
        visit(data.surface.max[a]);
    }
    visit(data.cell);
    visit(data.step);
}
template <class Data, class Take>
void each_array(Data& data, Take visit) {
    visit(data.brick);
    visit(data.coarse);
    visit(data.distance);
    visit(data.steps);
    visit(data.direction);
    visit(data.closest);
}

Problem problem(const char* message, ProblemCode code = ProblemCode::bad_format) {
    return {code, message};
}

}  // namespace

template <int D>
std::vector<std::byte> save(const Field<D>& field) {
    const detail::FieldData<D>& data = field.data();
    detail::BlobWriter writer;
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
    detail::BlobReader reader(bytes);
    std::array<char, 8> start{};
    for (char& c : start)
        if (!reader.number(c)) return problem("this is not a field: its signature is truncated");
    if (start != magic) return problem("this is not a field: its signature is wrong");
    std::uint32_t number = 0;
    if (!reader.number(number)) return problem("the field is truncated");
    if (number != version) return problem("the field has an unknown version");
    if (!reader.number(number)) return problem("the field is truncated");
    if (number != D) return problem(D == 2 ? "the field is not a 2D field" : "the field is not a 3D field");

    if (reader.left() < sizeof(std::uint64_t)) return problem("the field is truncated");
    if (!reader.checksum(bytes)) return problem("the field is damaged: its checksum is wrong");

    detail::FieldData<D> data;
    bool complete = true;
    each_number(data, [&](auto& value) { complete = complete && reader.number(value); });
    std::array<std::uint64_t, 6> counts{};
    for (std::uint64_t& count : counts) complete = complete && reader.number(count);
    // Each array is checked against the remaining bytes before its memory is allocated.
    std::size_t next = 0;
    each_array(data, [&](auto& array) { complete = complete && reader.array(array, counts[next++]); });
    if (!complete) return problem("the field is truncated");
    if (reader.left() != 0) return problem("the field has extra bytes at its end");

    if (data.store > FieldStore::sparse || data.lookup > FieldLookup::gradient)
        return problem("the field is of an unknown kind");
    if (!std::isfinite(data.cell) || !std::isfinite(data.step) || !detail::is_finite<D>(data.origin))
        return problem("a number of the field is NaN or infinite", ProblemCode::not_finite);
    if (data.steps.empty() && std::bit_cast<std::uint32_t>(data.step) != 0)
        return problem("the field has a step and no steps");
    if (std::optional<Problem> fault = fault_of(data)) return *std::move(fault);
    return Field<D>(std::move(data));
}

int field_dimension(std::span<const std::byte> bytes) {
    detail::BlobReader reader(bytes);
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
