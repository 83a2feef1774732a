#include <abut/motion/plane_solver.hpp>

#include <array>
#include <limits>

namespace abut {
namespace {

template <std::size_t N>
using Coordinates = std::array<double, N>;

template <std::size_t N>
double dot_product(const Coordinates<N>& a, const Coordinates<N>& b) {
    double result = 0;
    for (std::size_t i = 0; i < N; ++i) result += a[i] * b[i];
    return result;
}

/// dot(normal, v) >= least; the normal is of length 1.
template <std::size_t N>
struct Side {
    Coordinates<N> normal;
    double least = 0;
};

/// Below this, what is left of a normal within a plane is rounding, and the two planes are parallel.
constexpr double parallel = 1e-9;

/// An orthonormal basis of what is at right angles to a normal.
std::array<Coordinates<2>, 1> basis_across(const Coordinates<2>& normal) {
    return {{{-normal[1], normal[0]}}};
}
std::array<Coordinates<3>, 2> basis_across(const Coordinates<3>& normal) {
    const DVec<3> n{normal[0], normal[1], normal[2]}, u = perpendicular(n), v = cross(n, u);
    return {{{u.x, u.y, u.z}, {v.x, v.y, v.z}}};
}

bool nearest(std::span<const Side<1>> sides, const Coordinates<1>& wanted, double tolerance, Coordinates<1>& found) {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    for (const Side<1>& side : sides)
        if (side.normal[0] > 0)
            low = std::max(low, side.least);
        else
            high = std::min(high, -side.least);
    if (low > high + tolerance) return false;
    found[0] = low > high ? 0.5 * (low + high) : std::clamp(wanted[0], low, high);
    return true;
}

template <std::size_t N>
bool nearest(std::span<const Side<N>> sides, const Coordinates<N>& wanted, double tolerance, Coordinates<N>& found) {
    found = wanted;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side<N>& side = sides[i];
        if (dot_product(side.normal, found) >= side.least - tolerance) continue;
        // v = least * normal + basis * u
        const std::array<Coordinates<N>, N - 1> basis = basis_across(side.normal);
        std::array<Side<N - 1>, most_move_planes> within;
        std::size_t count = 0;
        for (std::size_t j = 0; j < i; ++j) {
            Side<N - 1> cut;
            for (std::size_t k = 0; k + 1 < N; ++k) cut.normal[k] = dot_product(basis[k], sides[j].normal);
            cut.least = sides[j].least - side.least * dot_product(side.normal, sides[j].normal);
            const double length_of_cut = std::sqrt(dot_product(cut.normal, cut.normal));
            if (length_of_cut < parallel) {
                if (cut.least > tolerance) return false;
                continue;
            }
            for (double& c : cut.normal) c /= length_of_cut;
            cut.least /= length_of_cut;
            within[count++] = cut;
        }
        Coordinates<N - 1> wanted_within, found_within{};
        for (std::size_t k = 0; k + 1 < N; ++k) wanted_within[k] = dot_product(basis[k], wanted);
        if (!nearest(std::span<const Side<N - 1>>(within.data(), count), wanted_within, tolerance, found_within))
            return false;
        for (std::size_t axis = 0; axis < N; ++axis) {
            found[axis] = side.least * side.normal[axis];
            for (std::size_t k = 0; k + 1 < N; ++k) found[axis] += found_within[k] * basis[k][axis];
        }
    }
    return true;
}

}  // namespace

template <int D>
bool nearest_move(std::span<const MovePlane<D>> planes, const DVec<D>& wanted, double tolerance, DVec<D>& move) {
    constexpr auto N = static_cast<std::size_t>(D);
    std::array<Side<N>, most_move_planes> sides;
    const std::size_t count = std::min(planes.size(), most_move_planes);
    Coordinates<N> target, found{};
    for (std::size_t k = 0; k < N; ++k) target[k] = wanted[static_cast<int>(k)];
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < N; ++k) sides[i].normal[k] = planes[i].normal[static_cast<int>(k)];
        sides[i].least = -planes[i].room;
    }
    if (!nearest(std::span<const Side<N>>(sides.data(), count), target, tolerance, found)) return false;
    for (std::size_t k = 0; k < N; ++k) move[static_cast<int>(k)] = found[k];
    return true;
}

template bool nearest_move(std::span<const MovePlane<2>>, const DVec<2>&, double, DVec<2>&);
template bool nearest_move(std::span<const MovePlane<3>>, const DVec<3>&, double, DVec<3>&);

}  // namespace abut
