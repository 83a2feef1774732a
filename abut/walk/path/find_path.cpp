#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/walk/nearest_on.hpp>
#include <abut/walk/path/corner_flip.hpp>
#include <abut/walk/path/search.hpp>
#include <abut/walk/path/shorten.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace abut {

using namespace detail;

namespace {

/// Directions in space that differ by less don't count as a bend.
constexpr double min_bend = 1e-6;
/// Segments shorter than this fraction of a triangle's side have no direction.
constexpr double min_piece = 1e-9;
/// A path within this fraction of a side from a corner touches it.
constexpr double min_gap = 1e-5;

/// The corners of a triangle of the path, in the unfolded plane and in space.
struct UnfoldedCorners {
    DVec<2> plane[3];
    DVec<3> space[3];

    /// Converts a unit vector of the plane to space.
    DVec<3> to_space(const DVec<2>& direction) const {
        const DVec<2> a = plane[1] - plane[0], b = plane[2] - plane[0];
        const double area = cross(a, b);
        return ((space[1] - space[0]) * cross(direction, b) + (space[2] - space[0]) * cross(a, direction)) / area;
    }
};

/// Finds the points at which a path bends in space.
class PathPoints {
public:
    PathPoints(const WalkPathRules& rules, const WalkTautPath& path) : rules_(rules), data_(rules.data), path_(path) {}

    void add_to(WalkPath& path) {
        const std::vector<WalkPortal>& portals = path_.plane.portals;
        find_crossings();
        std::optional<DVec<3>> last;
        std::optional<WalkCorner> before;
        for (std::uint32_t i = 0; i <= portals.size(); ++i) {
            const DVec<2> from = i == 0 ? path_.plane.from : crossing(i - 1);
            const DVec<2> to = i == portals.size() ? path_.plane.to : crossing(i);
            const UnfoldedCorners corners = unfolded_corners(i);
            const double piece = length(to - from);
            if (!(piece > min_piece * length(corners.plane[1] - corners.plane[0]))) continue;
            const DVec<3> direction = corners.to_space((to - from) / piece);
            const std::optional<WalkCorner> touched = touched_at(i);
            const bool comes_to = touched && !goes_along(before, *touched);
            const bool bends = last && length_squared(direction - *last) > min_bend * min_bend;
            if (last && (bends || comes_to)) add(path, i);
            before = touched;
            if (bends || !last) last = direction;
        }
    }

private:
    /// The corner of a border or a forbidden edge that the path touches on entering triangle i. A step that follows the
    /// path beyond such a corner, on its other side, would end at the border.
    std::optional<WalkCorner> touched_at(std::uint32_t i) {
        if (i == 0) return std::nullopt;
        const double fraction = fractions_[i - 1];
        if (fraction > min_gap && fraction < 1 - min_gap) return std::nullopt;
        const WalkCorner corner = corner_of(path_.plane, i - 1, fraction <= min_gap);
        if (sides_around_corner(rules_, path_, corner, sides_around_)) return std::nullopt;
        return corner;
    }
    /// True if a border runs from the previous corner, or from the start, to this corner.
    bool goes_along(const std::optional<WalkCorner>& before, const WalkCorner& corner) const {
        const WalkSide& left_by = path_.strip.sides[corner.first];
        std::uint32_t side = 0;
        if (corner.first == 0) {
            const DVec<2> ray = path_.plane.first - corner.at, start = path_.plane.from - corner.at;
            if (std::abs(cross(ray, start)) > min_gap * dot(ray, ray)) return false;
            const bool at_start = (left_leaving(left_by.side, false) == left_by.side) == corner.left;
            side = at_start ? next_corner(next_corner(left_by.side)) : next_corner(left_by.side);
        } else {
            if (!before || before->left != corner.left || corner.first != before->last + 1) return false;
            side = 3 - link(corner.first - 1).side() - left_by.side;
        }
        const WalkLink beside = data_.walk[left_by.triangle].link[side];
        return beside.is_border() || !rules_.may_cross({left_by.triangle, side}, beside);
    }
    void find_crossings() {
        fractions_.resize(path_.plane.portals.size());
        std::uint32_t next = 0;
        for (std::size_t k = 1; k < path_.knots.size(); ++k) {
            const WalkKnot& knot = path_.knots[k];
            for (; next < knot.first; ++next)
                fractions_[next] = crossing_fraction(path_.plane.portals[next], path_.knots[k - 1].at, knot.at);
            for (; next <= knot.last && next < fractions_.size(); ++next) fractions_[next] = knot.fraction;
        }
    }
    DVec<2> crossing(std::uint32_t portal) const {
        const WalkPortal& of = path_.plane.portals[portal];
        return of.left + (of.right - of.left) * fractions_[portal];
    }
    std::uint32_t triangle(std::uint32_t i) const {
        return i == 0 ? path_.strip.from.triangle : link(i - 1).triangle();
    }
    WalkLink link(std::uint32_t portal) const {
        const WalkSide& side = path_.strip.sides[portal];
        return data_.walk[side.triangle].link[side.side];
    }
    /// The corners at the ends of the side by which triangle i is entered.
    void ends(std::uint32_t i, std::uint32_t& left, std::uint32_t& right) const {
        const std::uint32_t entered = link(i - 1).side();
        left = left_entering(entered, path_.plane.mirrored[i]);
        right = left == entered ? next_corner(entered) : entered;
    }
    UnfoldedCorners unfolded_corners(std::uint32_t i) const {
        const WalkTriangle& walk = data_.walk[triangle(i)];
        if (i == 0)
            return {{WalkFrame(walk).corner(0), WalkFrame(walk).corner(1), WalkFrame(walk).corner(2)},
                    {DVec<3>(walk.corner[0]), DVec<3>(walk.corner[1]), DVec<3>(walk.corner[2])}};
        const std::vector<WalkPortal>& portals = path_.plane.portals;
        std::uint32_t left = 0, right = 0;
        ends(i, left, right);
        const DVec<2> tip =
            i == portals.size() ? path_.plane.last : (portals[i].new_left ? portals[i].left : portals[i].right);
        return {{portals[i - 1].left, portals[i - 1].right, tip},
                {DVec<3>(walk.corner[left]), DVec<3>(walk.corner[right]), DVec<3>(walk.corner[3 - left - right])}};
    }
    /// Adds the point at which triangle i is entered.
    void add(WalkPath& path, std::uint32_t i) const {
        std::uint32_t left = 0, right = 0;
        ends(i, left, right);
        const WalkTriangle& walk = data_.walk[triangle(i)];
        const DVec<3> from(walk.corner[left]);
        path.points.push_back(to_float(from + (DVec<3>(walk.corner[right]) - from) * fractions_[i - 1]));
        path.places.push_back(point_on_portal(data_, path_.strip, path_.plane, i - 1, fractions_[i - 1], true));
    }

    const WalkPathRules& rules_;
    const WalkMeshData& data_;
    const WalkTautPath& path_;
    std::vector<double> fractions_;
    std::vector<WalkSide> sides_around_;
};

WalkPath path_of(const WalkPathRules& rules, const WalkTautPath& taut, const WalkPoint& to) {
    const WalkMeshData& data = rules.data;
    WalkPath path;
    const auto add = [&](const WalkPoint& place) {
        path.points.push_back(to_float(position_of(data.walk[place.triangle], place)));
        const WalkWeights weights = normalised_weights(place.weights);
        path.places.push_back({place.triangle, quantised_weights(weights.second, weights.third)});
    };
    add(taut.strip.from);
    PathPoints(rules, taut).add_to(path);
    add(to);
    for (std::size_t i = 1; i < taut.knots.size(); ++i) path.length += length(taut.knots[i].at - taut.knots[i - 1].at);
    path.cost = taut.cost;
    return path;
}

bool is_valid(const WalkMeshData& data, const WalkPoint& place) {
    if (place.triangle >= data.walk.size() || !data.walk[place.triangle].is_walkable()) return false;
    const Vec3& w = place.weights;
    const float sum = w.x + w.y + w.z;
    return w.x >= 0 && w.y >= 0 && w.z >= 0 && sum > 0 && sum <= std::numeric_limits<float>::max();
}

/// The closest point of several triangles; of equally near ones, the one in the triangle with the lowest number.
WalkPoint nearest_of(const WalkMeshData& data, std::span<const std::uint32_t> triangles, const DVec<3>& point) {
    NearestOnTriangle best;
    best.square = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (const std::uint32_t triangle : triangles) {
        const WalkTriangle& walk = data.walk[triangle];
        const NearestOnTriangle on = nearest_on(Triangle3{walk.corner[0], walk.corner[1], walk.corner[2]}, point);
        if (on.square < best.square || (on.square == best.square && triangle < nearest)) {
            best = on;
            nearest = triangle;
        }
    }
    return {nearest, quantised_weights(best.second, best.third)};
}

/// The strip to the end or, if requested, to the nearest reachable place.
std::optional<WalkStrip> strip_of(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to) {
    const WalkMeshData& data = rules.data;
    if (!rules.is_open(from.triangle)) return std::nullopt;
    std::vector<std::uint32_t> reachable;
    std::vector<std::uint32_t>* wanted = rules.options.nearest_reachable ? &reachable : nullptr;
    const bool is_apart = data.components[from.triangle] != data.components[to.triangle] || !rules.is_open(to.triangle);
    if (!is_apart || wanted != nullptr) {
        if (std::optional<WalkStrip> strip = find_strip(rules, from, to, wanted)) return strip;
    }
    if (wanted == nullptr) return std::nullopt;
    return find_strip(rules, from, nearest_of(data, reachable, position_of(data.walk[to.triangle], to)));
}

}  // namespace

std::optional<WalkPath> WalkMesh::find_path(const WalkPoint& from, const WalkPoint& to,
                                            const WalkPathOptions& options) const {
    detail::enter_library();
    const bool valid = is_valid(*data_, from) && is_valid(*data_, to);
    ABUT_ASSERT(valid);
    if (!valid) return std::nullopt;
    const WalkPathRules rules(*data_, options);
    std::optional<WalkStrip> strip = strip_of(rules, from, to);
    if (!strip) return std::nullopt;
    const WalkPoint end = strip->to;
    WalkPath path = path_of(rules, shorten_path(rules, *std::move(strip)), end);
    path.reached = end == to;
    return path;
}

std::optional<std::vector<Vec3>> WalkMesh::path(const WalkPoint& from, const WalkPoint& to,
                                                const WalkPathOptions& options) const {
    std::optional<WalkPath> found = find_path(from, to, options);
    if (!found) return std::nullopt;
    return std::move(found->points);
}

}  // namespace abut
