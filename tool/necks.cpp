#include "necks.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/groups.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::tool {
namespace {

// Parts of the width. How far a surface may reach into the ball of a neck.
constexpr double slack = 1e-3;
// How nearly parallel and alike necks are that are shifts of one another.
constexpr double alike = 1e-3;
// How far apart their pieces may be.
constexpr double beside = 0.5;

// The necks between two facets.
template <int D>
struct Patch {
    std::size_t a = 0, b = 0;  // facets
    Facing<D> facing;
    std::vector<DVec<D>> free;  // some middles that are
};

template <int D>
class NeckSearch {
public:
    NeckSearch(const FacetTree<D>& facets, const GapOptions<D>& options) : facets_(facets), options_(options) {}

    std::vector<Neck<D>> all();

private:
    bool may_face(std::size_t i, std::size_t j) const;
    bool reaches_before(std::size_t i, std::size_t j) const;
    std::optional<Patch<D>> patch(std::size_t i, std::size_t j) const;
    bool is_in_front(const DVec<D>& end, const DVec<D>& outwards, std::uint32_t object, double width) const;
    bool is_free(const DVec<D>& middle, const Patch<D>& patch) const;
    bool is_buried(const DVec<D>& point) const;
    bool are_shifts(const Patch<D>& a, const Patch<D>& b) const;
    Neck<D> neck_of(const std::vector<std::size_t>& group) const;

    const FacetTree<D>& facets_;
    const GapOptions<D>& options_;
    std::vector<Patch<D>> patches_;
};

// Whether some corner of the second is in front of the first, or beside it at its border.
template <int D>
bool NeckSearch<D>::reaches_before(std::size_t i, std::size_t j) const {
    const PlacedFacet<D>&facet = facets_[i], &other = facets_[j];
    if (facet.two_sided) return true;
    const double some = 0.01 * options_.least, wanted = facet.has_border && other.has_border ? -some : some;
    const double height = dot(facet.front, DVec<D>(corners<D>(facet.shape)[0]));
    for (const Vec<D>& corner : corners<D>(other.shape))
        if (dot(facet.front, DVec<D>(corner)) - height > wanted) return true;
    return false;
}

template <int D>
bool NeckSearch<D>::may_face(std::size_t i, std::size_t j) const {
    if (options_.wanted && !options_.wanted(facets_[i].object, facets_[j].object)) return false;
    return reaches_before(i, j) && reaches_before(j, i);
}

// Of the facets of an object that meet at the end of a neck, the one that faces it most, or away from it most, tells.
template <int D>
bool NeckSearch<D>::is_in_front(const DVec<D>& end, const DVec<D>& outwards, std::uint32_t object, double width) const {
    double most = 0;
    bool two_sided = false;
    facets_.each_within(end, slack * width, [&](std::uint32_t i) {
        const PlacedFacet<D>& facet = facets_[i];
        if (facet.object != object) return;
        two_sided = two_sided || facet.two_sided;
        const double turned = dot(facet.front, outwards);
        if (std::abs(turned) > std::abs(most) || (std::abs(turned) == std::abs(most) && turned > most)) most = turned;
    });
    return two_sided || most > -slack;
}

// Under the back of a surface that isn't closed: below a ground.
template <int D>
bool NeckSearch<D>::is_buried(const DVec<D>& point) const {
    if (!options_.up) return false;
    const auto above = facets_.first_hit(point, *options_.up, std::numeric_limits<double>::infinity());
    return above && above->from_behind && !facets_[above->facet].two_sided;
}

template <int D>
bool NeckSearch<D>::is_free(const DVec<D>& middle, const Patch<D>& patch) const {
    const Facing<D>& facing = patch.facing;
    const double half = 0.5 * facing.width;
    if (facets_.has_within(middle, half * (1 - slack))) return false;
    if (!is_in_front(middle - facing.across * half, facing.across, facets_[patch.a].object, facing.width) ||
        !is_in_front(middle + facing.across * half, -facing.across, facets_[patch.b].object, facing.width))
        return false;
    return !facets_.is_inside(middle) && !is_buried(middle);
}

template <int D>
std::optional<Patch<D>> NeckSearch<D>::patch(std::size_t i, std::size_t j) const {
    std::optional<Facing<D>> facing =
        tool::facing<D>(facets_[i].shape, facets_[j].shape, options_.least, options_.width);
    if (!facing) return std::nullopt;
    Patch<D> result{i, j, *std::move(facing), {}};
    const DVec<D>& centroid = result.facing.centroid;
    if (is_free(centroid, result)) result.free.push_back(centroid);
    if (result.facing.middles.size() > 1 && result.free.empty())
        for (const DVec<D>& corner : result.facing.middles)
            if (const DVec<D> between = (corner + centroid) * 0.5; is_free(between, result))
                result.free.push_back(between);
    return result.free.empty() ? std::nullopt : std::optional(std::move(result));
}

template <int D>
bool NeckSearch<D>::are_shifts(const Patch<D>& a, const Patch<D>& b) const {
    const Facing<D>&first = a.facing, &second = b.facing;
    if (std::abs(first.width - second.width) > alike * first.width) return false;
    if (std::abs(dot(first.across, second.across)) < 1 - 0.5 * alike * alike) return false;
    const auto set_of = [](const Facing<D>& facing) {
        std::vector<Vec<D>> points;
        for (const DVec<D>& middle : facing.middles) points.push_back(Vec<D>(middle));
        return points;
    };
    const std::vector<Vec<D>> these = set_of(first), those = set_of(second);
    const auto hull = [](const std::vector<Vec<D>>& points) {
        Convex<D> convex;
        convex.core = Core::points;
        convex.points = points.data();
        convex.count = static_cast<std::uint32_t>(points.size());
        return convex;
    };
    return static_cast<double>(closest(hull(these), hull(those)).distance) <= beside * first.width;
}

// The main axes of a cloud of points at right angles to a direction.
std::array<DVec<2>, 1> axes_of(const std::vector<DVec<2>>&, const DVec<2>&, const DVec<2>& across) {
    return {perpendicular(across)};
}
std::array<DVec<3>, 2> axes_of(const std::vector<DVec<3>>& cloud, const DVec<3>& middle, const DVec<3>& across) {
    const DVec<3> x = perpendicular(across), y = cross(across, x);
    double xx = 0, xy = 0, yy = 0;
    for (const DVec<3>& point : cloud) {
        const double u = dot(point - middle, x), v = dot(point - middle, y);
        xx += u * u;
        xy += u * v;
        yy += v * v;
    }
    const double half_difference = 0.5 * (xx - yy), root = std::sqrt(half_difference * half_difference + xy * xy);
    // The eigenvector of the larger value, by whichever row doesn't vanish.
    const DVec<2> main =
        normalized(half_difference >= 0 ? DVec<2>(half_difference + root, xy) : DVec<2>(xy, root - half_difference));
    return {x * main.x + y * main.y, y * main.x - x * main.y};
}

template <int D>
Neck<D> NeckSearch<D>::neck_of(const std::vector<std::size_t>& group) const {
    // Of pieces that are all flat the same way, those with an area count by it.
    DVec<D> weighted(0.0), plain(0.0);
    double total = 0;
    std::vector<DVec<D>> cloud, free;
    for (const std::size_t i : group) {
        const Patch<D>& patch = patches_[i];
        double reach = 0;
        for (const DVec<D>& middle : patch.facing.middles)
            reach = std::max(reach, length(middle - patch.facing.centroid));
        double weight = reach;
        if constexpr (D == 3) {
            const std::vector<DVec<3>>& m = patch.facing.middles;
            weight = 0;
            for (std::size_t k = 2; k < m.size(); ++k) weight += length(cross(m[k - 1] - m[0], m[k] - m[0]));
        }
        weighted += patch.facing.centroid * weight;
        plain += patch.facing.centroid;
        total += weight;
        cloud.insert(cloud.end(), patch.facing.middles.begin(), patch.facing.middles.end());
        free.insert(free.end(), patch.free.begin(), patch.free.end());
    }
    const Patch<D>& narrowest =
        patches_[*std::min_element(group.begin(), group.end(), [&](std::size_t i, std::size_t j) {
            return patches_[i].facing.width < patches_[j].facing.width;
        })];
    const DVec<D> middle = total > 0 ? weighted / total : plain / static_cast<double>(group.size());
    Neck<D> neck{facets_[narrowest.a].object,
                 facets_[narrowest.b].object,
                 narrowest.facing.across,
                 narrowest.facing.width,
                 middle,
                 axes_of(cloud, middle, narrowest.facing.across)};
    // In the very middle there may be something else, or nothing on both sides.
    const double half = 0.5 * neck.width;
    const auto is_neck = [&](const DVec<D>& place) {
        return facets_.has_within(place - neck.across * half, slack * neck.width) &&
               facets_.has_within(place + neck.across * half, slack * neck.width) && is_free(place, narrowest);
    };
    if (is_neck(middle)) return neck;
    const auto nearer = [&](const DVec<D>& a, const DVec<D>& b) {
        return length_squared(a - middle) < length_squared(b - middle);
    };
    neck.middle = *std::min_element(free.begin(), free.end(), nearer);
    return neck;
}

template <int D>
std::vector<Neck<D>> NeckSearch<D>::all() {
    const auto half_width = static_cast<float>(0.5 * options_.width);
    std::vector<Aabb<D>> boxes;
    for (std::size_t i = 0; i < facets_.size(); ++i) boxes.push_back(grown(facets_.box(i), half_width));
    Bvh<D> tree;
    tree.build(boxes);
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        if (i > j) std::swap(i, j);
        if (!may_face(i, j)) return;
        if (std::optional<Patch<D>> found = patch(i, j)) patches_.push_back(*std::move(found));
    });
    std::sort(patches_.begin(), patches_.end(),
              [](const Patch<D>& a, const Patch<D>& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });

    boxes.clear();
    for (const Patch<D>& patch : patches_) {
        Aabb<D> box = Aabb<D>::empty();
        for (const DVec<D>& middle : patch.facing.middles) box = merged(box, Aabb<D>{Vec<D>(middle), Vec<D>(middle)});
        boxes.push_back(grown(box, static_cast<float>(0.5 * beside * patch.facing.width)));
    }
    tree.build(boxes);
    Groups groups(patches_.size());
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        if (groups.lowest(i) != groups.lowest(j) && are_shifts(patches_[i], patches_[j])) groups.join(i, j);
    });
    std::vector<Neck<D>> result;
    for (const std::vector<std::size_t>& group : groups.all()) result.push_back(neck_of(group));
    return result;
}

}  // namespace

template <int D>
std::vector<Neck<D>> find_necks(const FacetTree<D>& facets, const GapOptions<D>& options) {
    return NeckSearch<D>(facets, options).all();
}

template std::vector<Neck<2>> find_necks(const FacetTree<2>&, const GapOptions<2>&);
template std::vector<Neck<3>> find_necks(const FacetTree<3>&, const GapOptions<3>&);

}  // namespace abut::tool
