#pragma once

// Numbers and vectors as the reports write them: rounded for people, as they are for programs.

#include <abut/math/vec.hpp>

#include <string>

#include <nlohmann/json.hpp>

namespace abut::tool {

/// Keys stay in the order they are written in.
using Json = nlohmann::ordered_json;

Json numbers(const Vec3& v);

/// On one line.
std::string written(const Json& json);

/// To four digits.
std::string number(double value);

/// To four digits; coordinates that are nothing beside the largest one are written as 0.
std::string vector(const Vec3& v);

/// "1 pair", "2 pairs".
std::string counted(std::size_t count, const char* one, const char* many);

}  // namespace abut::tool
