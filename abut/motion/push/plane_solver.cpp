#include <abut/math/simd/square_root.hpp>
#include <abut/motion/push/plane_solver.hpp>

#include <array>
#include <limits>

namespace abut::detail {
namespace {

template <std::size_t N>
using Coordinates = std::array<double, N>;

template <std::size_t N>
double dot_product(const Coordinates<N>& a, const Coordinates<N>& b) {
    double result = 0;
    for (std::size_t i = 0; i < N; ++i) result += a[i] * b[i];
    return result;
}

/// The constraint dot(normal, v) >= min; the normal is a unit vector.
template <std::size_t N>
struct Constraint {
    Coordinates<N> normal;
    double min = 0;
};

/// If the rest of a normal within a plane is shorter than this, the planes are parallel.
constexpr double parallel = 1e-9;

/// An orthonormal basis of the space perpendicular to a normal.
std::array<Coordinates<2>, 1> basis_across(const Coordinates<2>& normal) {
    return {{{-normal[1], normal[0]}}};
}
std::array<Coordinates<3>, 2> basis_across(const Coordinates<3>& normal) {
    const DVec<3> n{normal[0], normal[1], normal[2]}, u = perpendicular(n), v = cross(n, u);
    return {{{u.x, u.y, u.z}, {v.x, v.y, v.z}}};
}

bool nearest(std::span<const Constraint<1>> constraints, const Coordinates<1>& target, double tolerance,
             Coordinates<1>& found) {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    for (const Constraint<1>& constraint : constraints)
        if (constraint.normal[0] > 0)
            low = std::max(low, constraint.min);
        else
            high = std::min(high, -constraint.min);
    if (low > high + tolerance) return false;
    found[0] = low > high ? 0.5 * (low + high) : std::clamp(target[0], low, high);
    return true;
}

template <std::size_t N>
bool nearest(std::span<const Constraint<N>> constraints, const Coordinates<N>& target, double tolerance,
             Coordinates<N>& found) {
    found = target;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const Constraint<N>& constraint = constraints[i];
        if (dot_product(constraint.normal, found) >= constraint.min - tolerance) continue;
        // v = min * normal + basis * u
        const std::array<Coordinates<N>, N - 1> basis = basis_across(constraint.normal);
        std::array<Constraint<N - 1>, max_move_planes> within;
        std::size_t count = 0;
        for (std::size_t j = 0; j < i; ++j) {
            Constraint<N - 1> trace;
            for (std::size_t k = 0; k + 1 < N; ++k) trace.normal[k] = dot_product(basis[k], constraints[j].normal);
            trace.min = constraints[j].min - constraint.min * dot_product(constraint.normal, constraints[j].normal);
            const double length_of_trace = square_root(dot_product(trace.normal, trace.normal));
            if (length_of_trace < parallel) {
                if (trace.min > tolerance) return false;
                continue;
            }
            for (double& c : trace.normal) c /= length_of_trace;
            trace.min /= length_of_trace;
            within[count++] = trace;
        }
        Coordinates<N - 1> target_within, found_within{};
        for (std::size_t k = 0; k + 1 < N; ++k) target_within[k] = dot_product(basis[k], target);
        if (!nearest(std::span<const Constraint<N - 1>>(within.data(), count), target_within, tolerance, found_within))
            return false;
        for (std::size_t axis = 0; axis < N; ++axis) {
            found[axis] = constraint.min * constraint.normal[axis];
            for (std::size_t k = 0; k + 1 < N; ++k) found[axis] += found_within[k] * basis[k][axis];
        }
    }
    return true;
}

}  // namespace

template <int D>
bool nearest_move(std::span<const MovePlane<D>> planes, const DVec<D>& target, double tolerance, DVec<D>& move) {
    constexpr auto N = static_cast<std::size_t>(D);
    std::array<Constraint<N>, max_move_planes> constraints;
    const std::size_t count = std::min(planes.size(), max_move_planes);
    Coordinates<N> point, found{};
    for (std::size_t k = 0; k < N; ++k) point[k] = target[static_cast<int>(k)];
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < N; ++k) constraints[i].normal[k] = planes[i].normal[static_cast<int>(k)];
        constraints[i].min = -planes[i].clearance;
    }
    if (!nearest(std::span<const Constraint<N>>(constraints.data(), count), point, tolerance, found)) return false;
    for (std::size_t k = 0; k < N; ++k) move[static_cast<int>(k)] = found[k];
    return true;
}

template bool nearest_move(std::span<const MovePlane<2>>, const DVec<2>&, double, DVec<2>&);
template bool nearest_move(std::span<const MovePlane<3>>, const DVec<3>&, double, DVec<3>&);

}  // namespace abut::detail
