#pragma once

// JSON reports of `abut check`; docs/check.schema.json describes them.

#include "tool/check/finding.hpp"
#include "tool/shared/format.hpp"

#include <array>
#include <span>
#include <string>

namespace abut::tool {

/// The members of a report that list findings.
inline constexpr std::array<const char*, 7> finding_arrays{"contacts",   "piles", "spawns",  "gaps",
                                                           "duplicates", "leaks", "floating"};

/// The member that lists the findings of a rule.
const char* array_of(Rule rule);

/// One object; numbers unrounded.
Json json_of(const FileReport& report);

}  // namespace abut::tool
