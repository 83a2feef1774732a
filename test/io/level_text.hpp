#pragma once

// Levels as text, a line for each object and point, for tests to compare with.

#include <abut/io/read_level.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace abut::test {

inline std::string text_of(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", std::abs(value) < 1e-5 ? 0.0 : value);
    return text.data();
}
inline std::string text_of(const Vec2& v) {
    return text_of(static_cast<double>(v.x)) + "," + text_of(static_cast<double>(v.y));
}

struct ShapeText {
    std::string points(std::span<const Vec2> all) const {
        std::string text;
        for (const Vec2& p : all) text += " " + text_of(p);
        return text;
    }
    std::string operator()(const Polygon& polygon) const { return points(polygon.points()); }
    std::string operator()(const Box2& box) const {
        return " " + text_of(box.center) + " half " + text_of(box.half) +
               (box.rotation == no_rotation<2> ? "" : " turned " + text_of({box.rotation.cos, box.rotation.sin}));
    }
    std::string operator()(const Circle& circle) const {
        return " " + text_of(circle.center) + " radius " + text_of(static_cast<double>(circle.radius));
    }
    std::string operator()(const Capsule2& capsule) const {
        return " " + text_of(capsule.a) + " " + text_of(capsule.b) + " radius " +
               text_of(static_cast<double>(capsule.radius));
    }
    std::string operator()(const Ellipse& ellipse) const { return " radii " + text_of(ellipse.scale); }
    std::string operator()(const RoundedBox& box) const {
        return (*this)(box.shape) + " rounded " + text_of(static_cast<double>(box.radius));
    }
    /// One letter per tile, drawn with y pointing down: t is the half at the top. Rows go from low y on.
    std::string operator()(const TileMap& map) const {
        std::string text;
        for (std::uint32_t i = 0; i < map.size(); ++i)
            text +=
                (i % map.columns() == 0 ? " " : "") + std::string(1, ".#lrtb1234<>^_"[static_cast<int>(map.tile(i))]);
        return text + " of " + text_of(map.cell());
    }
    std::string operator()(const Chain& chain) const {
        return points(chain.points()) + (chain.closed() ? " closed" : "");
    }
    std::string operator()(const Outlines& outlines) const {
        std::string text = outlines.rule == FillRule::even_odd ? " even-odd" : "";
        for (const Chain& chain : outlines.chains) text += " [" + (*this)(chain) + " ]";
        return text;
    }
    std::string operator()(const Compound2& compound) const {
        std::string text = " of " + std::to_string(compound.size());
        for (std::uint32_t i = 0; i < compound.size(); ++i) {
            const Aabb2 box = bounds(compound.child(i));
            text += " " + text_of(box.min) + ":" + text_of(box.max);
        }
        return text;
    }
};

inline std::string text_of(const std::vector<LevelProperty>& properties) {
    std::map<std::string, std::string> sorted;
    for (const LevelProperty& one : properties) sorted[one.name] = one.type + " " + one.value;
    std::string text;
    for (const auto& [name, value] : sorted) text += " {" + name + ": " + value + "}";
    return text;
}

inline std::string text_of(const LevelObject& object) {
    std::string text = object.path + (object.type.empty() ? "" : " (" + object.type + ")") + ": ";
    text += std::string(kind(object.shape)) + std::visit(ShapeText(), object.shape);
    if (!(object.pose == Pose2())) text += " at " + text_of(object.pose.position);
    if (!(object.pose.rotation == no_rotation<2>))
        text += " turned " + text_of(Vec2(object.pose.rotation.cos, object.pose.rotation.sin));
    return text + (object.filled ? " filled" : "") + text_of(object.properties) + "\n";
}

inline std::string text_of(const Level& level) {
    std::string text;
    for (const LevelObject& object : level.objects) text += text_of(object);
    for (const LevelPoint& point : level.points)
        text += point.path + (point.type.empty() ? "" : " (" + point.type + ")") + ": point " +
                text_of(point.position) + text_of(point.properties) + "\n";
    for (const std::string& warning : level.warnings) text += "note: " + warning + "\n";
    return text;
}

inline std::span<const std::byte> bytes_of_text(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

/// Files by name, as if beside the level.
using Beside = std::map<std::string, std::string>;

/// The level as text, or the problem of the file.
inline std::string read_as_text(std::string_view extension, std::string_view content, const Beside& beside = {},
                                const LevelOptions& options = {}) {
    const auto open = [&](const std::string& name) -> Result<std::vector<std::byte>> {
        const auto found = beside.find(name);
        if (found == beside.end()) return Problem{ProblemCode::not_found, "no such file"};
        const auto bytes = bytes_of_text(found->second);
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    const Result<Level> level = read_level(bytes_of_text(content), extension, open, options);
    return level ? text_of(*level) : "PROBLEM: " + level.problem().message + "\n";
}

}  // namespace abut::test
