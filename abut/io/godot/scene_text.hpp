#pragma once

// The text of Godot's scenes (.tscn) and resources (.tres): sections of properties.

#include <abut/math/result.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_double3.hpp>

namespace abut::godot {

/// A value as far as a reader of shapes needs it. Arrays and dictionaries are empty.
struct Value {
    std::string name;             ///< "Vector3" of Vector3(1, 2, 3), "SubResource" of SubResource("id")
    std::vector<double> numbers;  ///< of a number, or in the parentheses
    std::string text;             ///< a string, the first one in the parentheses, or a word such as true
};

using Properties = std::map<std::string, Value, std::less<>>;

/// [node name="Crate" parent="."], and the properties below it.
struct Section {
    std::string kind;  ///< "node"
    std::size_t line = 0;
    Properties attributes, properties;

    /// The text of an attribute; empty if there is none.
    std::string_view attribute(std::string_view name) const;
    /// A property, or nullptr.
    const Value* property(std::string_view name) const;
    /// A property of three numbers.
    std::optional<glm::dvec3> vector(std::string_view name) const;
};

/// A Problem names the line.
Result<std::vector<Section>> parse(std::string_view text);

}  // namespace abut::godot
