#pragma once

// Runs a recording again, and reports where an answer differs.

#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abut {

struct ReplayOptions {
    std::size_t max_differences = 10;  ///< so many are reported; all are counted
};

/// An answer that differs from the recorded one.
struct ReplayDifference {
    std::uint64_t entry = 0;  ///< its number in the file, from 0 on
    std::uint64_t frame = 0;  ///< the number of updates before it
    std::string question;     ///< such as "raycast"
    std::string field;        ///< the first part of the answer that differs, such as "hit.normal.x"
    std::string recorded, now;
    /// A C++ program that repeats this question alone, in a world with the items that matter. Empty if the answer
    /// depends on an earlier update, or if the shapes are too large for a listing.
    std::string code;
};

/// What a replay found.
struct ReplayReport {
    int dimension = 0;
    std::uint64_t entries = 0, questions = 0, frames = 0;
    std::uint64_t difference_count = 0;
    bool is_cut = false;  ///< the file ends within an entry, such as after a crash
    std::vector<ReplayDifference> differences;
};

/// Replays the bytes that a RecordedWorld has written. A Problem (`bad_format`) if they are not a recording, of another
/// version, or damaged, also on purpose, with right checksums.
Result<ReplayReport> replay(std::span<const std::byte> recording, const ReplayOptions& options = {});

}  // namespace abut
