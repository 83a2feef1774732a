#include "tool/objects/solid_objects.hpp"

#include "tool/shared/name_pattern.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace abut::tool {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::array<std::string_view, 8> collision_words{"collision",  "collid",     "solid",      "obstacle",
                                                          "unwalkable", "impassable", "impassible", "blocking"};
constexpr std::array<std::string_view, 5> negations{"nocolli", "no colli", "no_colli", "no-colli", "non"};
constexpr std::array<std::string_view, 2> wall_words{"wall", "block"};
constexpr std::array<std::string_view, 14> zone_words{"trigger",    "zone",   "sensor",       "warp",       "portal",
                                                      "teleport",   "event",  "spawn",        "region",     "particle",
                                                      "checkpoint", "camera", "player_start", "playerstart"};

bool has_word(std::string_view text, Words words) {
    const std::string lower = lower_case(text);
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool says_collision(std::string_view text) {
    return has_word(text, collision_words) && !has_word(text, negations);
}

// A property with a name that says so: true if it is set, false if it is unset.
std::optional<bool> property_says(const LevelObject& object) {
    for (const LevelProperty& property : object.properties)
        if (says_collision(property.name)) {
            const std::string value = lower_case(property.value);
            return value != "false" && value != "0" && value != "none" && !value.empty();
        }
    return std::nullopt;
}

bool says_collision(const LevelObject& object) {
    if (const std::optional<bool> said = property_says(object)) return *said;
    return says_collision(object.path) || says_collision(object.type);
}

bool is_zone(const LevelObject& object) {
    if (object.is_layer) return false;
    return has_word(object.path, zone_words) || has_word(object.type, zone_words);
}

// True if the pattern matches the object or a layer above it.
bool matches(std::string_view pattern, const LevelObject& object) {
    if (matches_name(pattern, object)) return true;
    for (std::size_t slash = object.path.find('/'); slash != std::string::npos;
         slash = object.path.find('/', slash + 1))
        if (detail::glob_matches(pattern, std::string_view(object.path).substr(0, slash))) return true;
    return false;
}

// What collides if nothing says so.
void select_by_shape(const Level& level, std::vector<bool>& solid) {
    std::size_t layers = 0, walls = 0;
    for (const LevelObject& object : level.objects) {
        layers += object.assumed_full ? 1 : 0;
        walls += object.assumed_full && has_word(object.path, wall_words) ? 1 : 0;
    }
    for (std::size_t i = 0; i < solid.size(); ++i) {
        const LevelObject& object = level.objects[i];
        solid[i] = !is_zone(object) && property_says(object) != false;
        if (object.assumed_full) solid[i] = walls > 0 ? has_word(object.path, wall_words) : layers == 1;
    }
}

std::string note_of(const Level& level, const std::vector<bool>& solid) {
    const auto count = static_cast<std::size_t>(std::count(solid.begin(), solid.end(), true));
    if (count == solid.size()) return {};
    const std::size_t first = static_cast<std::size_t>(std::find(solid.begin(), solid.end(), false) - solid.begin());
    return fmt::format(
        "{} of {} objects and layers collide, by their names, classes and properties; not '{}', for example; --solid "
        "PATTERN selects others",
        count, solid.size(), level.objects[first].path);
}

}  // namespace

Result<SolidObjects> solid_objects(const Level& level, const std::vector<std::string>& patterns) {
    const std::size_t count = level.objects.size();
    SolidObjects result;
    result.solid.resize(count);
    for (const std::string& pattern : patterns) {
        bool any = false;
        for (std::size_t i = 0; i < count; ++i)
            if (matches(pattern, level.objects[i])) result.solid[i] = any = true;
        if (!any)
            return Problem{ProblemCode::bad_argument, "--solid: no object and no layer is named '" + pattern + "'"};
    }
    const bool any_says = std::any_of(level.objects.begin(), level.objects.end(),
                                      [](const LevelObject& object) { return says_collision(object); });
    if (patterns.empty() && any_says)
        for (std::size_t i = 0; i < count; ++i) {
            const LevelObject& object = level.objects[i];
            result.solid[i] = says_collision(object) || (object.is_layer && !object.assumed_full);
        }
    else if (patterns.empty())
        select_by_shape(level, result.solid);
    result.ground.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        result.ground[i] = result.solid[i] && (level.objects[i].is_layer || says_collision(level.objects[i]));
    if (patterns.empty()) result.note = note_of(level, result.solid);
    return result;
}

}  // namespace abut::tool
