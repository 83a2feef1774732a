#include "tool/field/field_report.hpp"
#include "tool/shared/format.hpp"
#include <abut/field/file.hpp>
#include <abut/io/file/read_file.hpp>

#include <cstddef>
#include <span>
#include <string>

#include <fmt/format.h>

namespace abut::tool {
namespace {

template <int D>
std::string surface_line(const Field<D>& field) {
    const Aabb<D>& box = field.data().surface;
    if (box == Aabb<D>::empty()) return "surface     none\n";
    return fmt::format("surface     from {} to {}\n", vector(box.min), vector(box.max));
}

template <int D>
Json surface_json(const Field<D>& field) {
    const Aabb<D>& box = field.data().surface;
    if (box == Aabb<D>::empty()) return nullptr;
    return {{"min", numbers(box.min)}, {"max", numbers(box.max)}};
}

template <int D>
Result<ExitCode> print_info(const InfoRequest& request, std::span<const std::byte> bytes) {
    const Result<Field<D>> field = load_field<D>(bytes);
    if (!field) return Problem{field.problem().code, request.scene + ": " + field.problem().message};
    if (request.json) {
        Json json = json_of(*field);
        json["surface"] = surface_json(*field);
        json["file_bytes"] = bytes.size();
        return print(to_text(json), fine);
    }
    return print(fmt::format("{}\n\n{}{}file        {}\n", request.scene, described(*field), surface_line(*field),
                             megabytes(bytes.size())),
                 fine);
}

}  // namespace

Result<ExitCode> run_field_info(const InfoRequest& request) {
    const Result<std::vector<std::byte>> bytes = detail::read_file(request.scene);
    if (!bytes) return Problem{bytes.problem().code, request.scene + ": " + bytes.problem().message};
    return field_dimension(*bytes) == 2 ? print_info<2>(request, *bytes) : print_info<3>(request, *bytes);
}

}  // namespace abut::tool
