// The Minkowski sum of two polygons: their edges merged by direction.

#include <abut/convex/hull/minkowski.hpp>
#include <abut/math/detail/expansion.hpp>

namespace abut::detail {
namespace {

/// The sign of cross(u, v), exact. Rounding keeps the order of two products unless it makes them equal.
int turn(const DVec<2>& u, const DVec<2>& v) {
    const ExactSum left = two_product(u.x, v.y), right = two_product(u.y, v.x);
    return left.rounded != right.rounded ? sign_of(left.rounded - right.rounded) : sign_of(left.error - right.error);
}

/// A convex loop from its lexicographically least corner. The directions of its edges turn once around, from downwards,
/// which is the last.
class ConvexLoop {
public:
    explicit ConvexLoop(std::span<const DVec<2>> corners) : corners_(corners) {
        for (std::size_t i = 1; i < corners.size(); ++i) {
            const DVec<2>&p = corners[i], &least = corners[first_];
            if (p.x < least.x || (p.x == least.x && p.y < least.y)) first_ = i;
        }
    }

    std::size_t edges() const { return corners_.size() > 1 ? corners_.size() : 0; }
    std::uint32_t corner(std::size_t i) const { return static_cast<std::uint32_t>((first_ + i) % corners_.size()); }
    DVec<2> edge(std::size_t i) const { return corners_[corner(i + 1)] - corners_[corner(i)]; }

private:
    std::span<const DVec<2>> corners_;
    std::size_t first_ = 0;
};

/// Whether an edge belongs to the upper chain, back to the least corner.
bool runs_back(const DVec<2>& edge) {
    return edge.x < 0 || (edge.x == 0 && edge.y < 0);
}

/// Negative if the edge u comes before v, positive if after, zero if they are parallel. For exactly convex loops the
/// cross product alone would suffice. But edges are rounded differences, and two that become parallel could compare
/// with an opposite edge.
int compare(const DVec<2>& u, const DVec<2>& v) {
    if (runs_back(u) != runs_back(v)) return runs_back(u) ? 1 : -1;
    return turn(v, u);
}

}  // namespace

std::vector<CornerPair> sum_corners(std::span<const DVec<2>> a, std::span<const DVec<2>> b) {
    const ConvexLoop loop_a(a), loop_b(b);
    std::vector<CornerPair> result{{loop_a.corner(0), loop_b.corner(0)}};
    result.reserve(loop_a.edges() + loop_b.edges() + 1);
    std::size_t i = 0, j = 0;
    while (i < loop_a.edges() || j < loop_b.edges()) {
        const int order =
            i == loop_a.edges() ? 1 : (j == loop_b.edges() ? -1 : compare(loop_a.edge(i), loop_b.edge(j)));
        if (order <= 0) ++i;
        if (order >= 0) ++j;
        result.push_back({loop_a.corner(i), loop_b.corner(j)});
    }
    if (result.size() > 1) result.pop_back();  // the first again
    return result;
}

}  // namespace abut::detail
