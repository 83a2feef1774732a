#pragma once

// The cheapest way through one strip. For .cpp files.

#include <abut/walk/walk_path_strip.hpp>

#include <vector>

namespace abut {

/// How far from the left end of a portal to the right one the ways from it to two points cost least together. The sum
/// is convex: its slope is halved to 0, so many times.
double cheapest_share(const WalkPortal& portal, const DVec<2>& from, double cost_from, const DVec<2>& to,
                      double cost_to, int halvings);

/// Where all areas cost the same this is a funnel. Else there is a funnel between every two portals at which the cost
/// changes, and the points at which the way crosses these are moved one after another to where the pieces on either
/// side cost least together (Snell's law), until that is no longer cheaper. All of it is convex: the points settle at
/// the cheapest, but for those that stop one another at a corner.
class WalkPuller {
public:
    explicit WalkPuller(const WalkPathRules& rules) : rules_(rules) {}

    /// Trims the strip, unfolds it, and finds the knots and the cost.
    void pull(WalkTaut& way);
    /// Of the piece from a knot to the next.
    double cost(const WalkTaut& way, std::size_t knot) const;

private:
    void pull_once(WalkTaut& way);
    void find_crossings(const WalkTaut& way);
    void move_crossings(const WalkTaut& way);

    /// A portal with areas of two costs on its two sides.
    struct Crossing {
        std::uint32_t portal = 0;
        double share = 0;
        double before = 1, after = 1;
    };

    const WalkPathRules& rules_;
    WalkFunnel funnel_;
    std::vector<Crossing> crossings_, best_;
};

}  // namespace abut
