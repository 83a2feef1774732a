// Stands for tool/shared/import_in_child.cpp: the page's worker is the process that a damaged file may end.

#include "tool/shared/import_in_child.hpp"

namespace abut::tool {

bool limits_memory() {
    return false;
}

ImportLimits limits_for(const std::filesystem::path&) {
    return {};
}

Result<Scene> import_in_child(const std::filesystem::path& file, const ReadOptions& options, const ImportLimits&) {
    return read_scene(file, options);
}

}  // namespace abut::tool
