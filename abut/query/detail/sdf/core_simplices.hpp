#pragma once

// The core of a convex set as simplices, which a search bisects. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::detail {

template <int D>
struct SearchBox {
    DVec<D> center, half;
    double lower_bound;  ///< of the function in the box
};

/// The hull of up to D + 1 points, with the function's values there.
template <int D>
struct CoreSimplex {
    std::array<DVec<D>, static_cast<std::size_t>(D) + 1> points;
    std::array<double, static_cast<std::size_t>(D) + 1> values{};
    std::size_t count = 0;
    double lower_bound = -std::numeric_limits<double>::infinity();  ///< of the function in the simplex

    void push_back(const DVec<D>& point) { points[count++] = point; }
};

/// A stack of simplices, the last first: each bisection leaves one behind.
template <int D>
class SimplexStack {
public:
    bool empty() const { return count_ == 0; }
    bool full() const { return count_ + 2 > simplices_.size(); }
    void push(const CoreSimplex<D>& simplex) { simplices_[count_++] = simplex; }
    const CoreSimplex<D>& pop() { return simplices_[--count_]; }
    double lower_bound() const {
        double result = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count_; ++i) result = std::min(result, simplices_[i].lower_bound);
        return result;
    }

private:
    std::array<CoreSimplex<D>, 128> simplices_;
    std::size_t count_ = 0;
};

template <int D>
std::pair<std::size_t, std::size_t> longest_edge(const CoreSimplex<D>& simplex) {
    std::pair<std::size_t, std::size_t> result{0, 0};
    double longest = -1;
    for (std::size_t i = 0; i < simplex.count; ++i)
        for (std::size_t j = i + 1; j < simplex.count; ++j) {
            const double square = length_squared(simplex.points[j] - simplex.points[i]);
            if (square > longest) {
                longest = square;
                result = {i, j};
            }
        }
    return result;
}

template <int D>
DVec<D> middle_of(const CoreSimplex<D>& simplex) {
    DVec<D> sum(0.0);
    for (std::size_t i = 0; i < simplex.count; ++i) sum += simplex.points[i];
    return sum / static_cast<double>(simplex.count);
}

/// The largest distance of its points from a point.
template <int D>
double reach_from(const CoreSimplex<D>& simplex, const DVec<D>& point) {
    double farthest = 0;
    for (std::size_t i = 0; i < simplex.count; ++i)
        farthest = std::max(farthest, length_squared(simplex.points[i] - point));
    return std::sqrt(farthest);
}

/// Whether the core can be divided into simplices: it isn't known by its support function only, isn't round, and its
/// points are ordered.
template <int D>
bool has_simplices(const Convex<D>& convex) {
    if (convex.inner_radius > 0) return false;
    if (convex.core == Core::box) return true;
    if (convex.core != Core::points) return false;
    return D == 2 || convex.count <= 4 || convex.facets != nullptr;
}

/// Calls visit(simplex) for simplices that cover the core.
template <int D, class Visit>
void each_simplex(const Convex<D>& convex, Visit&& visit) {
    const auto corner = [&](std::uint32_t i) { return convex.place.point(local_corner(convex, i)); };
    CoreSimplex<D> simplex;
    if (convex.core == Core::box) {
        // The simplices along the paths from one corner to the opposite one, axis by axis.
        constexpr int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (int i = 0; i < (D == 2 ? 2 : 6); ++i) {
            std::uint32_t at = 0;
            simplex.count = 0;
            simplex.push_back(corner(at));
            for (int k = 0; k < D; ++k) {
                at |= 1u << orders[i][k];
                simplex.push_back(corner(at));
            }
            visit(simplex);
        }
        return;
    }
    if (convex.count <= static_cast<std::uint32_t>(D) + 1 && !(D == 2 && convex.count > 3)) {
        for (std::uint32_t i = 0; i < convex.count; ++i) simplex.push_back(corner(i));
        return visit(simplex);
    }
    if constexpr (D == 2) {
        for (std::uint32_t i = 1; i + 1 < convex.count; ++i) {
            simplex.count = 0;
            for (const std::uint32_t k : {0u, i, i + 1}) simplex.push_back(corner(k));
            visit(simplex);
        }
    } else {
        // From the centre to each face.
        DVec<3> middle(0.0);
        for (std::uint32_t i = 0; i < convex.count; ++i) middle += corner(i);
        middle /= static_cast<double>(convex.count);
        for (std::size_t face = 0; face < convex.facets->normals.size(); ++face) {
            const auto loop = convex.facets->loop(face);
            for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
                simplex.count = 0;
                for (const std::size_t k : {std::size_t{0}, i, i + 1}) simplex.push_back(corner(loop[k]));
                simplex.push_back(middle);
                visit(simplex);
            }
        }
    }
}

}  // namespace abut::detail
