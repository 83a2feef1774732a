#pragma once

// String pulling: the cheapest path through one strip. For .cpp files.

#include <abut/walk/path/strip.hpp>

#include <vector>

namespace abut::detail {

/// The fraction of the portal, from left to right, at which the path between two points is cheapest. The cost is
/// convex; its slope is bisected `halvings` times.
double cheapest_fraction(const WalkPortal& portal, const DVec<2>& from, double cost_from, const DVec<2>& to,
                         double cost_to, int halvings);

/// Finds the cheapest path through a strip. With equal costs this is one funnel. Otherwise there is a funnel between
/// every two portals at which the cost changes. The crossings of these portals are moved one after another to where the
/// adjacent segments are cheapest together (Snell's law), until the cost stops decreasing. The problem is convex: the
/// points converge to the optimum, except for points that block one another at a corner.
class StringPuller {
public:
    explicit StringPuller(const WalkPathRules& rules) : rules_(rules) {}

    /// Trims and unfolds the strip, and computes the knots and the cost.
    void pull(WalkTautPath& path);
    /// The cost of the segment from a knot to the next.
    double cost(const WalkTautPath& path, std::size_t knot) const;

private:
    void pull_once(WalkTautPath& path);
    void find_crossings(const WalkTautPath& path);
    void move_crossings(const WalkTautPath& path);

    /// A portal between areas of different costs.
    struct Crossing {
        std::uint32_t portal = 0;
        double fraction = 0;
        double before = 1, after = 1;
    };

    const WalkPathRules& rules_;
    Funnel funnel_;
    std::vector<Crossing> crossings_, best_;
};

}  // namespace abut::detail
