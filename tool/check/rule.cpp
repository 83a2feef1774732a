#include "tool/check/rule.hpp"

#include <abut/io/file/glob.hpp>

#include <algorithm>

namespace abut::tool {
namespace {

constexpr std::array<const char*, count_kinds> kinds{"spawn",     "inside", "contact", "gap",
                                                     "duplicate", "leak",   "floating"};

constexpr std::array<RuleInfo, count_rules> rules{{
    {Rule::overlap, "ABUT101", Kind::contact, Severity::error, "overlap", "Two objects overlap deeper than allowed"},
    {Rule::too_near, "ABUT102", Kind::contact, Severity::error, "too-near",
     "Two objects are closer than the clearance"},
    {Rule::between_frames, "ABUT103", Kind::contact, Severity::error, "between-frames",
     "Two objects collide between two frames"},
    {Rule::pile, "ABUT104", Kind::contact, Severity::error, "pile", "Many objects are in one place"},
    {Rule::inside, "ABUT201", Kind::inside, Severity::error, "inside", "An object is inside another one"},
    {Rule::spawn_blocked, "ABUT301", Kind::spawn, Severity::error, "spawn-blocked", "A spawn is inside an object"},
    {Rule::spawn_beneath, "ABUT302", Kind::spawn, Severity::error, "spawn-beneath", "A spawn is below the ground"},
    {Rule::spawn_no_ground, "ABUT303", Kind::spawn, Severity::error, "spawn-no-ground",
     "A spawn has nothing below it to stand on"},
    {Rule::narrow_passage, "ABUT401", Kind::gap, Severity::error, "narrow-passage",
     "A passage is too narrow for the character"},
    {Rule::narrow_detour, "ABUT402", Kind::gap, Severity::warning, "narrow-detour",
     "A passage is too narrow for the character, which gets to both ends by another way"},
    {Rule::same_object, "ABUT501", Kind::duplicate, Severity::error, "same-object",
     "Objects are equal and in the same place"},
    {Rule::same_facets, "ABUT502", Kind::duplicate, Severity::warning, "same-facets",
     "A mesh has triangles, or a line segments, twice"},
    {Rule::hole, "ABUT601", Kind::leak, Severity::warning, "hole", "A mesh has a hole"},
    {Rule::crack, "ABUT602", Kind::leak, Severity::warning, "crack",
     "Two borders of a mesh coincide but have different corners"},
    {Rule::non_manifold, "ABUT603", Kind::leak, Severity::warning, "non-manifold",
     "An edge of a mesh belongs to more than two triangles"},
    {Rule::flipped, "ABUT604", Kind::leak, Severity::warning, "flipped",
     "Triangles face the wrong way, against those beside them"},
    {Rule::floating, "ABUT701", Kind::floating, Severity::off, "floating", "An object rests on nothing"},
}};

}  // namespace

const std::array<RuleInfo, count_rules>& all_rules() {
    return rules;
}

const RuleInfo& info(Rule rule) {
    return rules[static_cast<std::size_t>(rule)];
}

const char* name_of(Kind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

const char* name_of(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "off";
}

bool names_rule(std::string_view word, const RuleInfo& rule) {
    return word == name_of(rule.kind) || detail::glob_matches(word, rule.code);
}

bool names_any_rule(std::string_view word) {
    return std::any_of(rules.begin(), rules.end(), [&](const RuleInfo& rule) { return names_rule(word, rule); });
}

std::string kind_names() {
    std::string names;
    for (const char* kind : kinds) names += (names.empty() ? "" : ", ") + std::string(kind);
    return names;
}

}  // namespace abut::tool
