#pragma once

// Runs importers in a child process: some crash, hang or exhaust memory on damaged files.

#include <abut/io/read_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstdint>
#include <filesystem>

namespace abut::tool {

struct ImportLimits {
    std::uint32_t seconds = 60;                    ///< limit of CPU time and of wall-clock time
    std::uint64_t bytes = std::uint64_t{4} << 30;  ///< limit of the address space, if `limits_memory`
};

/// False in builds with sanitizers, which reserve terabytes of address space.
bool limits_memory();

/// Limits by size and format of the file: several times the need of the slowest importer.
ImportLimits limits_for(const std::filesystem::path& file);

/// Calls `read_scene` in a child process. Returns a Scene or a Problem whatever happens to the child; nothing is
/// printed and no process is left behind. Requires that this process has only one thread.
Result<Scene> import_in_child(const std::filesystem::path& file, const ReadOptions& options,
                              const ImportLimits& limits = {});

}  // namespace abut::tool
