#include "written.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace abut::tool {

Json numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
}

std::string written(const Json& json) {
    // Names come from files, and files hold any bytes.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string number(double value) {
    return fmt::format("{:.4g}", value);
}

std::string vector(const Vec3& v) {
    const float most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const auto one = [&](float value) { return std::abs(value) < 1e-4f * most ? "0" : number(value); };
    return fmt::format("({}, {}, {})", one(v.x), one(v.y), one(v.z));
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace abut::tool
