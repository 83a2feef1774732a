// Stands for the readers of formats that the page leaves to the tool: abut/io/mesh/read_assimp.cpp and
// abut/io/godot/read_tscn.cpp.

#include <abut/io/godot/read_tscn.hpp>
#include <abut/io/mesh/read_assimp.hpp>

#include <string_view>

namespace abut {
namespace {

constexpr std::string_view of_tool = "is of a format that only the tool reads: run `abut check` on it";

Problem left_to_tool() {
    return {ProblemCode::bad_format, std::string(of_tool)};
}

}  // namespace

namespace detail {

bool assimp_knows(const std::string&) {
    return true;
}

Result<ReadScene> read_assimp(const std::filesystem::path&, const ReadOptions&) {
    return left_to_tool();
}

Result<ReadScene> read_assimp(std::span<const std::byte>, const std::string&, const ReadOptions&) {
    return left_to_tool();
}

}  // namespace detail

Result<detail::ReadScene> godot::read_tscn(std::span<const std::byte>, const std::filesystem::path&,
                                           const ReadOptions&) {
    return left_to_tool();
}

}  // namespace abut
