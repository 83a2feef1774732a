#pragma once

// The options of `abut check` as text, from the command line and from `abut.toml`, and what they mean.

#include "tool/check/check.hpp"
#include "tool/check/severities.hpp"
#include "tool/faults/faults.hpp"
#include "tool/shared/files.hpp"
#include <abut/math/result.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// A value, and where it was given: "--allow", or "levels/abut.toml:3: allow".
struct SettingText {
    std::string text;
    std::string where;
};

/// Values by the name of the option, without dashes at its front. Flags have the value "true" or "false".
using Settings = std::map<std::string, std::vector<SettingText>>;

enum class SettingForm : std::uint8_t { value, list, flag };

struct SettingInfo {
    const char* name;
    SettingForm form;
};

/// All options that a file may set.
const std::vector<SettingInfo>& all_settings();

/// A pattern of findings that are left out.
struct IgnorePattern {
    std::string code;  ///< with `*` and `?`; empty: any
    std::string a, b;  ///< of objects; `b` is empty if one object is enough
    std::string text;  ///< as it was given
    std::string where;
};

/// What to do with one file.
struct CheckPlan {
    CheckOptions contacts;
    FaultOptions faults;
    Severities severities;
    std::vector<IgnorePattern> ignored;
    std::vector<std::string> solid, bodies;  ///< glob patterns
    std::optional<std::string> baseline;
    std::optional<std::size_t> frames;  ///< default: the file's key times
    bool warnings_as_errors = false;
    bool wants_page = false, wants_picture = false;  ///< documents that show the findings
    FileOptions files;
};

/// Parses all values. The message of a Problem begins with the place of the value.
Result<CheckPlan> plan_of(const Settings& settings);

/// The settings of a file with those of the command line: of one option the latter count, and `ignore` has both.
Settings merged(const Settings& of_file, const Settings& of_command_line);

}  // namespace abut::tool
