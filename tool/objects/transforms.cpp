#include "tool/objects/transforms.hpp"

#include <cmath>

#include <glm/matrix.hpp>

namespace abut::tool {
namespace {

// Maximum deviation from a rotation, within the tolerance of queries.
constexpr double rotation_tolerance = 1e-6;

}  // namespace

bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

bool is_rotation(const glm::dmat3& m) {
    const glm::dmat3 product = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(product[i][j] - (i == j ? 1 : 0)) <= rotation_tolerance)) return false;
    return glm::determinant(m) > 0;
}

std::optional<glm::dmat3> rotation_since(const glm::dmat3& baked, const glm::dmat3& now) {
    if (now == baked) return glm::dmat3(1.0);
    const glm::dmat3 change = now * glm::inverse(baked);
    return is_rotation(change) ? std::optional(change) : std::nullopt;
}

}  // namespace abut::tool
