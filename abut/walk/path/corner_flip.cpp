#include <abut/math/simd/square_root.hpp>
#include <abut/walk/path/corner_flip.hpp>

namespace abut::detail {
namespace {

/// Angles within this tolerance of 180 degrees count as equal to it.
constexpr double tolerance = 1e-10;

std::uint32_t other_side_at(std::uint32_t corner, std::uint32_t side) {
    return side == corner ? next_corner(next_corner(corner)) : corner;
}

/// The triangles around a corner that are not in the strip.
class CornerFlip {
public:
    CornerFlip(const WalkPathRules& rules, const WalkTautPath& path, const WalkCorner& corner)
        : rules_(rules), path_(path), corner_(corner) {}

    /// The sides to cross around the other side of the corner, from the strip's first triangle at it to the last.
    /// Returns false if there is a border or a forbidden edge, or if the angle between `before` and `after` (if given)
    /// is 180 degrees or more.
    bool sides(std::vector<WalkSide>& result, const DVec<2>* before, const DVec<2>* after, double* product) const {
        result.clear();
        const std::vector<WalkSide>& strip = path_.strip.sides;
        const WalkMeshData& data = rules_.data;
        WalkSide side = strip[corner_.first];
        bool mirrored = path_.plane.mirrored[corner_.first] != 0;
        const bool starts_left = left_leaving(side.side, mirrored) == side.side;
        side.side = other_side_at(starts_left == corner_.left ? side.side : next_corner(side.side), side.side);
        const WalkLink out = link(strip[corner_.last]);
        const std::uint32_t left_out = left_entering(out.side(), path_.plane.mirrored[corner_.last + 1]);
        const bool out_starts_left = left_out == out.side();
        const WalkSide end{
            out.triangle(),
            other_side_at(out_starts_left == corner_.left ? out.side() : next_corner(out.side()), out.side())};

        DVec<2> ray = first_ray();
        for (std::size_t i = 0; i <= data.walk.size(); ++i) {
            if (before != nullptr && !is_less_than_half(*before, ray - corner_.at)) return false;
            const WalkLink beyond = link(side);
            if (beyond.is_border() || !rules_.may_cross(side, beyond)) return false;
            result.push_back(side);
            if (beyond.triangle() == end.triangle && beyond.side() == end.side) {
                if (before == nullptr) return true;
                const DVec<2> there = turned(*after, ray);
                if (product != nullptr) *product = dot(*before, there);
                return is_less_than_half(*before, there);
            }
            // The corner is to the right of the flipped path if it was to the left of the other.
            ray = beyond_side(data.walk[side.triangle], side.side, mirrored, corner_.left ? ray : corner_.at,
                              corner_.left ? corner_.at : ray);
            mirrored = mirrored != beyond.mirrored();
            const bool entered_left = left_entering(beyond.side(), mirrored) == beyond.side();
            side = {beyond.triangle(),
                    other_side_at(entered_left != corner_.left ? beyond.side() : next_corner(beyond.side()),
                                  beyond.side())};
        }
        return false;
    }

private:
    WalkLink link(const WalkSide& side) const { return rules_.data.walk[side.triangle].link[side.side]; }

    DVec<2> end_of(std::size_t portal) const {
        return corner_.left ? path_.plane.portals[portal].left : path_.plane.portals[portal].right;
    }
    /// The end of the side that is crossed first.
    DVec<2> first_ray() const { return corner_.first > 0 ? end_of(corner_.first - 1) : path_.plane.first; }
    /// A direction of the last triangle, rotated to this unfolding.
    DVec<2> turned(const DVec<2>& direction, const DVec<2>& ray) const {
        const DVec<2> was =
            (corner_.last + 1 < path_.plane.portals.size() ? end_of(corner_.last + 1) : path_.plane.last) - corner_.at;
        const DVec<2> is = ray - corner_.at;
        const double square = dot(was, was), cosine = dot(was, is) / square, sine = cross(was, is) / square;
        return {cosine * direction.x - sine * direction.y, sine * direction.x + cosine * direction.y};
    }
    /// Compares the angle between two directions with 180 degrees. The second is less than 540 degrees on.
    bool is_less_than_half(const DVec<2>& from, const DVec<2>& to) const {
        const double sine = (corner_.left ? -1 : 1) * cross(from, to);
        const double min_sine = tolerance * square_root(dot(from, from) * dot(to, to));
        return sine > min_sine || (sine >= -min_sine && dot(from, to) > 0);
    }

    const WalkPathRules& rules_;
    const WalkTautPath& path_;
    const WalkCorner corner_;
};

}  // namespace

bool sides_around_corner(const WalkPathRules& rules, const WalkTautPath& path, const WalkCorner& corner,
                         std::vector<WalkSide>& result, const DVec<2>* before, const DVec<2>* after, double* product) {
    return CornerFlip(rules, path, corner).sides(result, before, after, product);
}

}  // namespace abut::detail
