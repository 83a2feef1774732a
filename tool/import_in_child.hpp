#pragma once

// Importers have been seen to crash, loop and eat all memory on mangled files: here that happens to another process.

#include <abut/io/read_scene.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstdint>
#include <filesystem>

namespace abut::tool {

struct ImportLimits {
    std::uint32_t seconds = 60;                    ///< of computing, and of waiting
    std::uint64_t bytes = std::uint64_t{4} << 30;  ///< of address space, where `limits_memory`
};

/// False in builds with sanitizers, which reserve terabytes of address space for themselves.
bool limits_memory();

/// For a file of this size and format: what the slowest of importers needs several times over, and no more, for some
/// never come to an end.
ImportLimits limits_for(const std::filesystem::path& file);

/// `read_scene` in a child process of its own. Whatever becomes of the child, the answer is a Scene or a Problem,
/// nothing is printed, and no process stays behind. To be called while the program has one thread.
Result<Scene> import_in_child(const std::filesystem::path& file, const ReadOptions& options,
                              const ImportLimits& limits = {});

}  // namespace abut::tool
