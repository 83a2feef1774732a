#include "tool/faults/walkable.hpp"

#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::tool {

using namespace detail;

namespace {

constexpr std::size_t max_walk_places = 1'000'000;
// Relative to the character's height.
constexpr double climb = 0.25;
// The cosine of the steepest slope to stand on: 60 degrees.
constexpr double min_ground_cosine = 0.5;
// The character touches walls and ground: it is this much thinner.
constexpr double thinner = 0.01;

constexpr double any_depth = std::numeric_limits<double>::infinity();

}  // namespace

template <int D>
Walkable<D>::Walkable(const FacetTree<D>& facets, const Character& character, const std::optional<Vec<D>>& up,
                      std::span<const Vec<D>> spawns)
    : facets_(facets),
      radius_(static_cast<double>(character.radius)),
      height_(static_cast<double>(character.height)),
      step_(climb * height_),
      space_(Aabb<D>::empty()) {
    for (int i = 0; up && i < D; ++i)
        if ((*up)[i] != 0) {
            up_axis_ = i;
            sign_ = static_cast<double>((*up)[i]);
        }
    if (has_ground()) up_[up_axis_] = sign_;
    for (std::size_t i = 0; i < facets_.size(); ++i) space_ = merged(space_, facets_.box(i));
    for (const Vec<D>& spawn : spawns) space_ = merged(space_, Aabb<D>{spawn, spawn});
    space_ = grown(space_, 3 * character.radius);
    for (const Vec<D>& spawn : spawns) start(DVec<D>(spawn));
    while (!stack_.empty()) {
        const Place place = stack_.back();
        stack_.pop_back();
        if (count_ < max_walk_places)
            visit_neighbours(place);
        else
            is_complete_ = false;
    }
}

// The lowest point of a character at a place.
template <int D>
DVec<D> Walkable<D>::at(const Place& place) const {
    DVec<D> point(0.0);
    for (int i = 0; i < D; ++i) point[i] = radius_ * static_cast<double>(place.cell[static_cast<std::size_t>(i)]);
    return point + up_ * place.height;
}

template <int D>
bool Walkable<D>::fits(const DVec<D>& bottom) const {
    const double radius = radius_ * (1 - thinner);
    if (!has_ground())
        return contains(space_, to_float(bottom)) && !facets_.has_within(bottom, radius) && !facets_.is_inside(bottom);
    const double high = height_ - radius_, low = std::min(radius_ + step_, high);
    return !facets_.has_within(bottom + up_ * low, bottom + up_ * high, radius) &&
           !facets_.is_inside(bottom + up_ * (0.5 * (low + high)));
}

// The height of the ground below a point, if the character can stand on it.
template <int D>
std::optional<double> Walkable<D>::ground_below(const DVec<D>& point) const {
    const auto hit = facets_.first_hit(point, -up_, any_depth);
    if (!hit) return std::nullopt;
    const PlacedFacet<D>& facet = facets_[hit->facet];
    const double cosine = std::abs(dot(facet.front, up_));
    if (cosine < min_ground_cosine || (hit->from_behind && !facet.two_sided)) return std::nullopt;
    return height_of(point) - hit->distance;
}

template <int D>
bool Walkable<D>::add(const Place& place) {
    std::vector<double>& heights = heights_[place.cell];
    const double tolerance = has_ground() ? 0.5 * step_ : any_depth;
    for (const double height : heights)
        if (std::abs(height - place.height) <= tolerance) return false;
    heights.push_back(place.height);
    stack_.push_back(place);
    ++count_;
    return true;
}

// The places around a spawn: it is between the cells' centres.
template <int D>
void Walkable<D>::start(const DVec<D>& spawn) {
    const std::optional<double> ground =
        has_ground() ? ground_below(spawn + up_ * (0.5 * height_)) : std::optional(0.0);
    if (!ground) return;
    Place first;
    for (int i = 0; i < D; ++i)
        if (!has_ground() || i != up_axis_) first.cell[static_cast<std::size_t>(i)] = std::llround(spawn[i] / radius_);
    first.height = *ground;
    for (std::int64_t i = -1; i <= 1; ++i)
        for (std::int64_t j = -1; j <= 1; ++j) {
            Place place = first;
            const std::size_t x = has_ground() && up_axis_ == 0 ? 1 : 0, y = has_ground() && up_axis_ != 2 ? 2 : 1;
            place.cell[x] += i;
            place.cell[y] += j;
            if (fits(at(place))) add(place);
        }
}

template <int D>
void Walkable<D>::visit_neighbours(const Place& place) {
    for (std::size_t axis = 0; axis < D; ++axis) {
        if (has_ground() && static_cast<int>(axis) == up_axis_) continue;
        for (const std::int64_t direction : {-1, 1}) {
            Place next = place;
            next.cell[axis] += direction;
            if (has_ground()) {
                const std::optional<double> ground = ground_below(at(next) + up_ * step_);
                if (!ground) continue;
                // Before a fall the character is beside the edge.
                if (*ground < place.height - step_ && !fits(at(next))) continue;
                next.height = *ground;
            }
            const auto known = heights_.find(next.cell);
            const bool is_known =
                known != heights_.end() && std::any_of(known->second.begin(), known->second.end(), [&](double height) {
                    return !has_ground() || std::abs(height - next.height) <= 0.5 * step_;
                });
            if (!is_known && fits(at(next))) add(next);
        }
    }
}

template <int D>
bool Walkable<D>::reaches(const DVec<D>& point, double distance, const std::optional<DVec<D>>& middle) const {
    Cell center{};
    for (int i = 0; i < D; ++i)
        if (!has_ground() || i != up_axis_) center[static_cast<std::size_t>(i)] = std::llround(point[i] / radius_);
    const auto window = static_cast<std::int64_t>(std::ceil(distance / radius_)) + 2;
    const std::size_t x = has_ground() && up_axis_ == 0 ? 1 : 0, y = has_ground() && up_axis_ != 2 ? 2 : 1;
    for (std::int64_t i = -window; i <= window; ++i)
        for (std::int64_t j = -window; j <= window; ++j) {
            if (i * i + j * j > window * window) continue;
            Place place{center, 0};
            place.cell[x] += i;
            place.cell[y] += j;
            const auto found = heights_.find(place.cell);
            if (found == heights_.end()) continue;
            for (const double height : found->second) {
                const double above = height_of(point) - height;
                if (has_ground() && (above < -step_ || above > height_)) continue;
                place.height = has_ground() ? std::max(height_of(point), height + step_) : 0;
                const DVec<D> eye = at(place);
                const bool is_beyond = middle && dot(eye - *middle, point - *middle) <= 0;
                if (!is_beyond && facets_.is_visible(eye, point)) return true;
            }
        }
    return false;
}

template <int D>
bool Walkable<D>::has_headroom(const DVec<D>& point) const {
    if (!has_ground()) return true;
    const std::optional<double> ground = ground_below(point);
    if (!ground || height_of(point) - *ground > height_) return false;
    const double above = height_of(point) - *ground;
    return !facets_.first_hit(point, up_, height_ - above);
}

template class Walkable<2>;
template class Walkable<3>;

}  // namespace abut::tool
