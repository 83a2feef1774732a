#include <abut/math/assert.hpp>
#include <abut/walk/walk_nearest_on.hpp>
#include <abut/walk/walk_path_flip.hpp>
#include <abut/walk/walk_path_search.hpp>
#include <abut/walk/walk_path_shorten.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace abut {
namespace {

/// Directions in space that are less apart go on as one.
constexpr double least_bend = 1e-6;
/// Pieces this short, of a side of their triangle, have no direction.
constexpr double least_piece = 1e-9;
/// Ways that pass a corner this close, in sides of a triangle, touch it.
constexpr double least_gap = 1e-5;

/// The corners of one triangle of the way, in the plane and in space.
struct Laid {
    DVec<2> plane[3];
    DVec<3> space[3];

    /// A unit vector of the plane in space.
    DVec<3> to_space(const DVec<2>& direction) const {
        const DVec<2> a = plane[1] - plane[0], b = plane[2] - plane[0];
        const double area = cross(a, b);
        return ((space[1] - space[0]) * cross(direction, b) + (space[2] - space[0]) * cross(a, direction)) / area;
    }
};

/// Where a way bends.
class Bends {
public:
    Bends(const WalkPathRules& rules, const WalkTaut& way) : rules_(rules), data_(rules.data), way_(way) {}

    void add_to(WalkPath& path) {
        const std::vector<WalkPortal>& portals = way_.plane.portals;
        find_crossings();
        std::optional<DVec<3>> last;
        std::optional<WalkCorner> before;
        for (std::uint32_t i = 0; i <= portals.size(); ++i) {
            const DVec<2> from = i == 0 ? way_.plane.from : crossing(i - 1);
            const DVec<2> to = i == portals.size() ? way_.plane.to : crossing(i);
            const Laid laid = lay(i);
            const double piece = length(to - from);
            if (!(piece > least_piece * length(laid.plane[1] - laid.plane[0]))) continue;
            const DVec<3> direction = laid.to_space((to - from) / piece);
            const std::optional<WalkCorner> touched = touched_at(i);
            const bool comes_to = touched && !goes_along(before, *touched);
            const bool bends = last && length_squared(direction - *last) > least_bend * least_bend;
            if (last && (bends || comes_to)) add(path, i);
            before = touched;
            if (bends || !last) last = direction;
        }
    }

private:
    /// The corner of a border, or of a forbidden edge, that the way comes to as it enters triangle i. Where it comes
    /// along the line of an edge to where that becomes a border, steps on its other side would end.
    std::optional<WalkCorner> touched_at(std::uint32_t i) {
        if (i == 0) return std::nullopt;
        const double share = shares_[i - 1];
        if (share > least_gap && share < 1 - least_gap) return std::nullopt;
        const WalkCorner corner = corner_of(way_.plane, i - 1, share <= least_gap);
        if (find_other_side(rules_, way_, corner, round_)) return std::nullopt;
        return corner;
    }
    /// Whether there is a border all the way to a corner from the one before, or from the start.
    bool goes_along(const std::optional<WalkCorner>& before, const WalkCorner& corner) const {
        const WalkSide& left_by = way_.strip.sides[corner.first];
        std::uint32_t side = 0;
        if (corner.first == 0) {
            const DVec<2> ray = way_.plane.first - corner.at, start = way_.plane.from - corner.at;
            if (std::abs(cross(ray, start)) > least_gap * dot(ray, ray)) return false;
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
        shares_.resize(way_.plane.portals.size());
        std::uint32_t next = 0;
        for (std::size_t k = 1; k < way_.knots.size(); ++k) {
            const WalkKnot& knot = way_.knots[k];
            for (; next < knot.first; ++next)
                shares_[next] = crossed_at(way_.plane.portals[next], way_.knots[k - 1].at, knot.at);
            for (; next <= knot.last && next < shares_.size(); ++next) shares_[next] = knot.share;
        }
    }
    DVec<2> crossing(std::uint32_t portal) const {
        const WalkPortal& of = way_.plane.portals[portal];
        return of.left + (of.right - of.left) * shares_[portal];
    }
    std::uint32_t triangle(std::uint32_t i) const { return i == 0 ? way_.strip.from.triangle : link(i - 1).triangle(); }
    WalkLink link(std::uint32_t portal) const {
        const WalkSide& side = way_.strip.sides[portal];
        return data_.walk[side.triangle].link[side.side];
    }
    /// The corners at the ends of the side that triangle i is entered by.
    void ends(std::uint32_t i, std::uint32_t& left, std::uint32_t& right) const {
        const std::uint32_t entered = link(i - 1).side();
        left = left_entering(entered, way_.plane.mirrored[i]);
        right = left == entered ? next_corner(entered) : entered;
    }
    Laid lay(std::uint32_t i) const {
        const WalkTriangle& walk = data_.walk[triangle(i)];
        if (i == 0)
            return {{WalkFrame(walk).corner(0), WalkFrame(walk).corner(1), WalkFrame(walk).corner(2)},
                    {DVec<3>(walk.corner[0]), DVec<3>(walk.corner[1]), DVec<3>(walk.corner[2])}};
        const std::vector<WalkPortal>& portals = way_.plane.portals;
        std::uint32_t left = 0, right = 0;
        ends(i, left, right);
        const DVec<2> tip =
            i == portals.size() ? way_.plane.last : (portals[i].new_left ? portals[i].left : portals[i].right);
        return {{portals[i - 1].left, portals[i - 1].right, tip},
                {DVec<3>(walk.corner[left]), DVec<3>(walk.corner[right]), DVec<3>(walk.corner[3 - left - right])}};
    }
    /// The point where triangle i is entered.
    void add(WalkPath& path, std::uint32_t i) const {
        std::uint32_t left = 0, right = 0;
        ends(i, left, right);
        const WalkTriangle& walk = data_.walk[triangle(i)];
        const DVec<3> from(walk.corner[left]);
        path.points.push_back(to_float(from + (DVec<3>(walk.corner[right]) - from) * shares_[i - 1]));
        path.places.push_back(place_on(data_, way_.strip, way_.plane, i - 1, shares_[i - 1], true));
    }

    const WalkPathRules& rules_;
    const WalkMeshData& data_;
    const WalkTaut& way_;
    std::vector<double> shares_;
    std::vector<WalkSide> round_;
};

WalkPath path_of(const WalkPathRules& rules, const WalkTaut& way, const WalkPoint& to) {
    const WalkMeshData& data = rules.data;
    WalkPath path;
    const auto add = [&](const WalkPoint& place) {
        path.points.push_back(to_float(in_space(data.walk[place.triangle], place)));
        const WalkWeights weights = shares(place.weights);
        path.places.push_back({place.triangle, in_grains(weights.second, weights.third)});
    };
    add(way.strip.from);
    Bends(rules, way).add_to(path);
    add(to);
    for (std::size_t i = 1; i < way.knots.size(); ++i) path.length += length(way.knots[i].at - way.knots[i - 1].at);
    path.cost = way.cost;
    return path;
}

bool is_valid(const WalkMeshData& data, const WalkPoint& place) {
    if (place.triangle >= data.walk.size() || !data.walk[place.triangle].is_walkable()) return false;
    const Vec3& w = place.weights;
    const float sum = w.x + w.y + w.z;
    return w.x >= 0 && w.y >= 0 && w.z >= 0 && sum > 0 && sum <= std::numeric_limits<float>::max();
}

/// Of some triangles, the place nearest to a point; of several, in the triangle with the lowest number.
WalkPoint nearest_of(const WalkMeshData& data, std::span<const std::uint32_t> triangles, const DVec<3>& point) {
    NearestOnTriangle least;
    least.square = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (const std::uint32_t triangle : triangles) {
        const WalkTriangle& walk = data.walk[triangle];
        const NearestOnTriangle on = nearest_on(Triangle3{walk.corner[0], walk.corner[1], walk.corner[2]}, point);
        if (on.square < least.square || (on.square == least.square && triangle < nearest)) {
            least = on;
            nearest = triangle;
        }
    }
    return {nearest, in_grains(least.second, least.third)};
}

/// The strip to the end, or to the nearest place that can be reached, where that is asked for.
std::optional<WalkStrip> strip_of(const WalkPathRules& rules, const WalkPoint& from, const WalkPoint& to) {
    const WalkMeshData& data = rules.data;
    if (!rules.is_open(from.triangle)) return std::nullopt;
    std::vector<std::uint32_t> reachable;
    std::vector<std::uint32_t>* wanted = rules.options.nearest_reachable ? &reachable : nullptr;
    const bool is_apart = data.islands[from.triangle] != data.islands[to.triangle] || !rules.is_open(to.triangle);
    if (!is_apart || wanted != nullptr) {
        if (std::optional<WalkStrip> strip = find_strip(rules, from, to, wanted)) return strip;
    }
    if (wanted == nullptr) return std::nullopt;
    return find_strip(rules, from, nearest_of(data, reachable, in_space(data.walk[to.triangle], to)));
}

}  // namespace

std::optional<WalkPath> WalkMesh::find_path(const WalkPoint& from, const WalkPoint& to,
                                            const WalkPathOptions& options) const {
    const bool valid = is_valid(*data_, from) && is_valid(*data_, to);
    ABUT_ASSERT(valid);
    if (!valid) return std::nullopt;
    const WalkPathRules rules(*data_, options);
    std::optional<WalkStrip> strip = strip_of(rules, from, to);
    if (!strip) return std::nullopt;
    const WalkPoint end = strip->to;
    WalkPath path = path_of(rules, pulled_tight(rules, *std::move(strip)), end);
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
