#pragma once

// The rules of `abut check`: what it reports, under which code, and how severe that is by default.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace abut::tool {

/// Groups of rules, in the order of reports.
enum class Kind : std::uint8_t { spawn, inside, contact, gap, duplicate, leak, floating };
inline constexpr std::size_t count_kinds = 7;

enum class Severity : std::uint8_t {
    off,      ///< not reported
    warning,  ///< reported; the exit status stays 0
    error,    ///< the exit status is 1
};

enum class Rule : std::uint8_t {
    overlap,
    too_near,
    between_frames,
    pile,
    inside,
    spawn_blocked,
    spawn_beneath,
    spawn_no_ground,
    narrow_passage,
    narrow_detour,
    same_object,
    same_facets,
    hole,
    crack,
    non_manifold,
    flipped,
    floating,
};
inline constexpr std::size_t count_rules = 17;

struct RuleInfo {
    Rule rule;
    const char* code;  ///< stable: never given to another rule
    Kind kind;
    Severity severity;  ///< by default
    const char* name;   ///< in words with hyphens
    const char* text;   ///< a sentence without a full stop
};

const std::array<RuleInfo, count_rules>& all_rules();
const RuleInfo& info(Rule rule);

/// "contact", "leak", ...
const char* name_of(Kind kind);
/// "off", "warning", "error"
const char* name_of(Severity severity);

/// True if a word names the rule: a kind, or a code with `*` and `?`.
bool names_rule(std::string_view word, const RuleInfo& rule);

/// True if a word names any rule.
bool names_any_rule(std::string_view word);

/// All kinds, for messages: "contact, inside, ...".
std::string kind_names();

}  // namespace abut::tool
