#include <abut/walk/walk_frame.hpp>
#include <abut/walk/walk_turn.hpp>

#include <cmath>

namespace abut {
namespace {

/// Three axes at right angles: a tangent, what is left of it, and the normal.
struct Axes {
    DVec<3> ahead, left, up;

    Axes(const WalkTriangle& walk, const DVec<2>& tangent, double side) {
        const WalkFrame frame(walk);
        const DVec<3> first = frame.first_axis(), second = frame.second_axis();
        ahead = first * tangent.x + second * tangent.y;
        left = (second * tangent.x - first * tangent.y) * side;
        up = cross(ahead, left);
    }
    const DVec<3>& operator[](int i) const { return i == 0 ? ahead : (i == 1 ? left : up); }
};

/// The rotation that takes one to the other: Shepperd, "Quaternion from Rotation Matrix" (1978), the root of the
/// largest of four numbers first.
glm::quat rotation_between(const Axes& from, const Axes& to) {
    const double trace = dot(from.ahead, to.ahead) + dot(from.left, to.left) + dot(from.up, to.up);
    // Twice the sine of the angle, along the axis.
    const DVec<3> twist = cross(from.ahead, to.ahead) + cross(from.left, to.left) + cross(from.up, to.up);
    double w = 0;
    DVec<3> axis;
    if (trace > 0) {
        w = 1 + trace;
        axis = twist;
    } else {
        const auto element = [&](int row, int column) {
            return to.ahead[row] * from.ahead[column] + to.left[row] * from.left[column] + to.up[row] * from.up[column];
        };
        int most = 0;
        for (int i = 1; i < 3; ++i)
            if (element(i, i) > element(most, most)) most = i;
        for (int i = 0; i < 3; ++i) axis[i] = element(i, most) + element(most, i);
        axis[most] = 1 - trace + 2 * element(most, most);
        w = twist[most];
    }
    const double scale = 1 / std::sqrt(w * w + length_squared(axis));
    axis *= scale;
    return {static_cast<float>(w * scale), static_cast<float>(axis.x), static_cast<float>(axis.y),
            static_cast<float>(axis.z)};
}

}  // namespace

WalkTurn turn_along(const WalkTriangle& from, const DVec<2>& tangent_from, const WalkTriangle& to,
                    const DVec<2>& tangent_to, bool mirrored) {
    WalkTurn result;
    result.mirrored = mirrored;
    const DVec<2> turned(tangent_from.x, mirrored ? -tangent_from.y : tangent_from.y);
    result.in_plane = {static_cast<float>(dot(turned, tangent_to)), static_cast<float>(cross(turned, tangent_to))};
    result.in_space = rotation_between(Axes(from, tangent_from, 1), Axes(to, tangent_to, mirrored ? -1 : 1));
    return result;
}

}  // namespace abut
