#include "tool/shared/format.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace abut::tool {

std::string to_text(const Json& json) {
    // Names from files may contain invalid UTF-8.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string number(double value) {
    return fmt::format("{:.4g}", value);
}

template <int D>
std::string vector(const Vec<D>& v) {
    float largest = 0;
    for (int i = 0; i < D; ++i) largest = std::max(largest, std::abs(v[i]));
    std::string text;
    for (int i = 0; i < D; ++i)
        text += (i == 0 ? "(" : ", ") + (std::abs(v[i]) < 1e-4f * largest ? "0" : number(static_cast<double>(v[i])));
    return text + ")";
}
template std::string vector(const Vec<2>& v);
template std::string vector(const Vec<3>& v);

std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace abut::tool
