#include <abut/math/simd/square_root.hpp>
#include <abut/walk/frame.hpp>
#include <abut/walk/parallel_transport.hpp>

namespace abut::detail {

namespace {

/// An orthonormal frame: the rotated axes of a triangle's frame, and the normal.
struct Axes {
    DVec<3> first, second, normal;

    explicit Axes(const WalkTriangle& walk) {
        const WalkFrame frame(walk);
        first = frame.first_axis();
        second = frame.second_axis();
        normal = cross(first, second);
    }
    /// The frame after parallel transport: vectors keep their coordinates in it.
    Axes(const WalkTriangle& walk, const Turn& turn, bool mirrored) : Axes(walk) {
        const double cosine = static_cast<double>(turn.cos), sine = static_cast<double>(turn.sin);
        const double side = mirrored ? -1 : 1;
        const DVec<3> ahead = first * cosine + second * sine;
        second = (second * cosine - first * sine) * side;
        first = ahead;
        normal *= side;
    }
};

}  // namespace

WalkTurn transport_along(const WalkTriangle& from, const DVec<2>& tangent_from, const WalkTriangle& to,
                         const DVec<2>& tangent_to, bool mirrored, double square) {
    const DVec<2> turned(tangent_from.x, mirrored ? -tangent_from.y : tangent_from.y);
    const double scale = 1 / square;
    const Turn in_plane{static_cast<float>(dot(turned, tangent_to) * scale),
                        static_cast<float>(cross(turned, tangent_to) * scale)};
    return {from, to, in_plane, mirrored};
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

Vec3 WalkTurn::operator*(const Vec3& vector) const {
    if (from_ == nullptr) return vector;
    const Axes from(*from_), to(*to_, in_plane_, mirrored_);
    const DVec<3> v(vector);
    return to_float(to.first * dot(from.first, v) + to.second * dot(from.second, v) + to.normal * dot(from.normal, v));
}

/// Chooses the largest component of the quaternion, or one large enough: Shepperd, "Quaternion from Rotation Matrix"
/// (1978).
glm::quat WalkTurn::in_space() const {
    if (from_ == nullptr) return {1, 0, 0, 0};
    const Axes from(*from_), to(*to_, in_plane_, mirrored_);
    const double trace = dot(from.first, to.first) + dot(from.second, to.second) + dot(from.normal, to.normal);
    // Along the axis; the length is twice the sine of the angle.
    const DVec<3> twist = cross(from.first, to.first) + cross(from.second, to.second) + cross(from.normal, to.normal);
    double w = 1 + trace;
    DVec<3> axis = twist;
    if (trace <= 0) {
        const auto element = [&](int row, int column) {
            return to.first[row] * from.first[column] + to.second[row] * from.second[column] +
                   to.normal[row] * from.normal[column];
        };
        int largest_axis = 0;
        for (int i = 1; i < 3; ++i)
            if (element(i, i) > element(largest_axis, largest_axis)) largest_axis = i;
        for (int i = 0; i < 3; ++i) axis[i] = element(i, largest_axis) + element(largest_axis, i);
        axis[largest_axis] = 1 - trace + 2 * element(largest_axis, largest_axis);
        w = twist[largest_axis];
    }
    const double scale = 1 / square_root(w * w + length_squared(axis));
    return glm::quat(static_cast<float>(w * scale), static_cast<float>(axis.x * scale),
                     static_cast<float>(axis.y * scale), static_cast<float>(axis.z * scale));
}

}  // namespace abut
