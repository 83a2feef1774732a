#pragma once

// One input of `abut bake`: its key, and its result.

#include "tool/bake/cache.hpp"
#include "tool/bake/run_in_child.hpp"
#include "tool/shared/format.hpp"
#include <abut/math/result.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// What a bake does with each of its inputs.
struct BakeTask {
    std::string verb;
    std::string version;               ///< of the tool
    std::vector<std::string> options;  ///< of the verb, in its own order: "--parts=16", "--rooms"
    RunTool run;
};

/// The ending of the file that a verb writes, such as ".glb"; empty for `check`, which writes none. Nothing for verbs
/// that can't be baked.
std::optional<std::string> output_ending(const std::string& verb);

/// The name of the results in the cache, "ab/cdef...": the SHA-256 of the version, the verb, its options, the name of
/// the input without its folder, and of all bytes that are read: the files that the input names, the files that
/// options name, and the abut.toml of `check`. The message of a Problem doesn't name the file.
Result<std::string> key_of(const BakeTask& task, const std::filesystem::path& file);

/// A result. The report is the verb's own, without times and paths.
struct Baked {
    std::optional<Bytes> output;  ///< the bytes of the file that the verb wrote
    Json entry;                   ///< {"abut", "verb", "options", "file", "status", "report", "output"}

    /// The exit code of the verb: 0 or 1.
    int status() const { return entry.value("status", 2); }
    std::string text() const { return to_text(entry); }
};

/// Runs the verb; equal inputs give equal bytes. Returns a Problem if the input is rejected, whose message doesn't
/// begin with the file.
Result<Baked> bake(const BakeTask& task, const std::filesystem::path& file, const std::filesystem::path& scratch);

/// Reads a result. Nothing if it is missing, or damaged.
Result<std::optional<Baked>> load(const BakeTask& task, const std::string& key, Cache& cache);

/// Writes the output first, and then the entry, which makes the result count.
std::optional<Problem> save(const BakeTask& task, const std::string& key, const Baked& baked, Cache& cache);

}  // namespace abut::tool
