#pragma once

// Numbers and vectors as the reports write them: rounded for people, as they are for programs.

#include <abut/math/vec.hpp>

#include <string>

#include <nlohmann/json.hpp>

namespace abut::tool {

/// Keys stay in the order they are written in.
using Json = nlohmann::ordered_json;

template <int D>
Json numbers(const Vec<D>& v) {
    Json result = Json::array();
    for (int i = 0; i < D; ++i) result.push_back(v[i]);
    return result;
}

/// On one line.
std::string written(const Json& json);

/// To four digits.
std::string number(double value);

/// To four digits; coordinates that are nothing beside the largest one are written as 0.
template <int D>
std::string vector(const Vec<D>& v);

/// "1 pair", "2 pairs".
std::string counted(std::size_t count, const char* one, const char* many);

}  // namespace abut::tool
