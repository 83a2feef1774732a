#pragma once

// Formatting for reports: rounded numbers for text, unrounded numbers for JSON.

#include <abut/math/vec.hpp>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace abut::tool {

/// Keys keep their insertion order.
using Json = nlohmann::ordered_json;

template <int D>
Json numbers(const Vec<D>& v) {
    Json result = Json::array();
    for (int i = 0; i < D; ++i) result.push_back(v[i]);
    return result;
}

template <int D>
std::vector<double> coordinates(const Vec<D>& v) {
    std::vector<double> result;
    for (int i = 0; i < D; ++i) result.push_back(static_cast<double>(v[i]));
    return result;
}

/// JSON text on one line, with a newline.
std::string to_text(const Json& json);

/// A report lists at most this number of things of a kind; its JSON lists them all.
inline constexpr std::size_t max_listed = 100;

/// A number with four significant digits.
std::string number(double value);

/// A vector with four significant digits; coordinates below 1e-4 of the largest one are printed as 0.
template <int D>
std::string vector(const Vec<D>& v);

/// "1 pair", "2 pairs".
std::string counted(std::size_t count, const char* one, const char* many);

}  // namespace abut::tool
