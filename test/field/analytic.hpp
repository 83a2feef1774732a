#pragma once

// Fields with known answers: filled sample by sample from closed-form distances.

#include "../oracle/random.hpp"
#include <abut/field/field.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace abut::oracle {

using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::to_float;

/// A solid by its exact signed distance in double.
template <int D>
struct Analytic {
    std::function<double(const DVec<D>&)> distance;
    Aabb<D> surface;

    /// The gradient by short differences, accurate away from edges.
    DVec<D> gradient(const DVec<D>& p) const {
        constexpr double step = 1e-6;
        DVec<D> result;
        for (int a = 0; a < D; ++a) {
            DVec<D> low = p, high = p;
            low[a] -= step;
            high[a] += step;
            result[a] = distance(high) - distance(low);
        }
        return normalized(result);
    }
    DVec<D> closest(const DVec<D>& p) const { return p - gradient(p) * distance(p); }
};

template <int D>
Analytic<D> ball(const DVec<D>& center, double radius) {
    return {[=](const DVec<D>& p) { return length(p - center) - radius; },
            {to_float<D>(center - radius), to_float<D>(center + radius)}};
}

template <int D>
Analytic<D> box(const DVec<D>& center, const DVec<D>& half) {
    return {[=](const DVec<D>& p) {
                DVec<D> out;
                double most = -1e300;
                for (int a = 0; a < D; ++a) {
                    const double past = std::abs(p[a] - center[a]) - half[a];
                    out[a] = std::max(past, 0.0);
                    most = std::max(most, past);
                }
                return most > 0 ? length(out) : most;
            },
            {to_float<D>(center - half), to_float<D>(center + half)}};
}

/// Around the third axis.
inline Analytic<3> torus(const DVec<3>& center, double large, double small) {
    const DVec<3> half(large + small, large + small, small);
    return {[=](const DVec<3>& p) {
                const DVec<3> q = p - center;
                const double ring = std::sqrt(q.x * q.x + q.y * q.y) - large;
                return std::sqrt(ring * ring + q.z * q.z) - small;
            },
            {to_float<3>(center - half), to_float<3>(center + half)}};
}

/// The solid rotated about the origin, so that its edges aren't parallel to the axes.
inline Analytic<3> turned(const Analytic<3>& solid, const DVec<3>& x, const DVec<3>& towards_y) {
    const DVec<3> u = normalized(x), w = normalized(cross(u, towards_y)), v = cross(w, u);
    const auto inverse = [=](const DVec<3>& p) { return DVec<3>(dot(u, p), dot(v, p), dot(w, p)); };
    Analytic<3> result{[=](const DVec<3>& p) { return solid.distance(inverse(p)); }, Aabb<3>::empty()};
    for (unsigned i = 0; i < 8; ++i) {
        const Aabb<3>& box = solid.surface;
        const Vec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
        const Vec3 at = to_float<3>(u * static_cast<double>(corner.x) + v * static_cast<double>(corner.y) +
                                    w * static_cast<double>(corner.z));
        result.surface = merged(result.surface, Aabb<3>{at, at});
    }
    return result;
}

struct FillOptions {
    FieldStore store = FieldStore::dense;
    FieldLookup lookup = FieldLookup::linear;
    double band = 3;  ///< sparse: in cells
    bool closest_points = false;
};

template <int D>
glm::vec<D, std::uint32_t> counted(std::size_t index, const glm::vec<D, std::uint32_t>& counts) {
    glm::vec<D, std::uint32_t> result;
    for (int a = 0; a < D; ++a) {
        result[a] = static_cast<std::uint32_t>(index % counts[a]);
        index /= counts[a];
    }
    return result;
}

template <int D>
std::size_t product(const glm::vec<D, std::uint32_t>& counts) {
    std::size_t result = 1;
    for (int a = 0; a < D; ++a) result *= counts[a];
    return result;
}

/// The field that a baker makes of a solid.
template <int D>
detail::FieldData<D> filled(const Analytic<D>& solid, const Vec<D>& origin, float cell,
                            glm::vec<D, std::uint32_t> cells, const FillOptions& options = {}) {
    using Counts = glm::vec<D, std::uint32_t>;
    detail::FieldData<D> data;
    data.origin = origin;
    data.cell = cell;
    data.surface = solid.surface;
    data.store = options.store;
    data.lookup = options.lookup;
    const auto place = [&](const Counts& i) { return DVec<D>(origin) + DVec<D>(i) * static_cast<double>(cell); };
    const auto keep = [&](const Counts& i) {
        const DVec<D> p = place(i);
        data.distance.push_back(static_cast<float>(solid.distance(p)));
        if (options.lookup == FieldLookup::gradient) data.gradient.push_back(to_float<D>(solid.gradient(p)));
        if (options.closest_points) data.closest.push_back(to_float<D>(solid.closest(p)));
    };
    if (options.store == FieldStore::dense) {
        data.cells = cells;
        const Counts counts = cells + 1u;
        for (std::size_t i = 0; i < product<D>(counts); ++i) keep(counted<D>(i, counts));
        return data;
    }
    constexpr std::uint32_t side = detail::brick_cells<D>;
    const Counts blocks = (cells + (side - 1)) / side;
    data.cells = blocks * side;
    for (std::size_t i = 0; i < product<D>(blocks + 1u); ++i)
        data.coarse.push_back(static_cast<float>(solid.distance(place(counted<D>(i, blocks + 1u) * side))));
    std::uint32_t bricks = 0;
    const double step = static_cast<double>(cell), half = 0.5 * side * step;
    for (std::size_t i = 0; i < product<D>(blocks); ++i) {
        const Counts first = counted<D>(i, blocks) * side;
        const double reach = half * std::sqrt(static_cast<double>(D)) + options.band * step;
        if (std::abs(solid.distance(place(first) + half)) > reach) {
            data.brick.push_back(detail::no_brick);
            continue;
        }
        data.brick.push_back(bricks++);
        const Counts counts(side + 1);
        for (std::size_t j = 0; j < product<D>(counts); ++j) keep(first + counted<D>(j, counts));
    }
    return data;
}

/// The lower corner and the cells of a volume around a box, with `padding` cells around it.
template <int D>
detail::FieldData<D> filled_around(const Analytic<D>& solid, float cell, float padding,
                                   const FillOptions& options = {}) {
    glm::vec<D, std::uint32_t> cells;
    for (int a = 0; a < D; ++a)
        cells[a] =
            static_cast<std::uint32_t>(std::ceil((solid.surface.max[a] - solid.surface.min[a]) / cell + 2 * padding));
    return filled<D>(solid, solid.surface.min - Vec<D>(padding * cell), cell, cells, options);
}

}  // namespace abut::oracle
