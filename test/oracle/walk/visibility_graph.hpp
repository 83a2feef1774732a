#pragma once

// The shortest path over squares of which some are missing: a visibility graph of the corners, and Dijkstra 1959.

#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace abut::oracle {

using detail::axis;
using detail::DVec;
using detail::length;

/// A grid of squares of edge 1, of which some are missing. No two missing ones may share only a corner.
struct Squares {
    int columns = 0, rows = 0;
    std::vector<bool> there;

    bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < columns && y < rows &&
               there[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
    }
};

/// Whether the segment between two points lies in the squares that aren't missing, or along their edges.
inline bool is_visible(const Squares& squares, const DVec<2>& a, const DVec<2>& b) {
    // The lines of the grid cut the segment. The middle of each piece is within one square, or on an edge.
    std::vector<double> cuts{0, 1};
    for (int axis = 0; axis < 2; ++axis) {
        const double from = a[axis], along = b[axis] - a[axis];
        if (std::abs(along) < 1e-12) continue;
        const double low = std::min(from, from + along), high = std::max(from, from + along);
        for (double line = std::ceil(low); line <= high; line += 1) {
            const double cut = (line - from) / along;
            if (cut > 0 && cut < 1) cuts.push_back(cut);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (cuts[i] - cuts[i - 1] < 1e-9) continue;
        const DVec<2> middle = a + (b - a) * (0.5 * (cuts[i] + cuts[i - 1]));
        bool any = false;
        for (const double dx : {-1e-9, 1e-9})
            for (const double dy : {-1e-9, 1e-9})
                any = any || squares.at(static_cast<int>(std::floor(middle.x + dx)),
                                        static_cast<int>(std::floor(middle.y + dy)));
        if (!any) return false;
    }
    return true;
}

/// The length of the shortest path; infinite if there is none.
inline double shortest_path_length(const Squares& squares, const DVec<2>& from, const DVec<2>& to) {
    std::vector<DVec<2>> nodes{from, to};
    for (int y = 0; y <= squares.rows; ++y)
        for (int x = 0; x <= squares.columns; ++x) {
            const int around =
                squares.at(x - 1, y - 1) + squares.at(x, y - 1) + squares.at(x - 1, y) + squares.at(x, y);
            if (around == 3)
                nodes.emplace_back(x, y);  // a shortest path turns only at the corner of one missing square
        }
    std::vector<double> distance(nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> done(nodes.size(), false);
    distance[0] = 0;
    for (std::size_t round = 0; round < nodes.size(); ++round) {
        std::size_t nearest = nodes.size();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!done[i] && (nearest == nodes.size() || distance[i] < distance[nearest])) nearest = i;
        if (nearest == 1 || distance[nearest] == std::numeric_limits<double>::infinity()) break;
        done[nearest] = true;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (done[i]) continue;
            const double by = distance[nearest] + length(nodes[i] - nodes[nearest]);
            if (by < distance[i] && is_visible(squares, nodes[nearest], nodes[i])) distance[i] = by;
        }
    }
    return distance[1];
}

}  // namespace abut::oracle
