#include "tool/faults/spawns.hpp"

#include "tool/shared/name_pattern.hpp"
#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

namespace abut::tool {

using namespace detail;

namespace {

// Default allowed depth relative to the smaller one's size: characters on the ground may penetrate this far.
constexpr float default_allow = 1e-3f;
// The cosine of the steepest slope to stand on: 60 degrees.
constexpr float min_slope_cosine = 0.5f;
// Maximum distance of a free position, in sizes of the character, or of the object that a point is in.
constexpr float max_free_distance = 4;
// Clearance of a free position from the object it left, relative to the character's size.
constexpr float clearance = 1e-3f;
// Height above a point spawn at which the search for its ground starts, relative to the level's size: covers rounding.
constexpr float ground_search_height = 1e-4f;
// Places along each side of a spawn's area that are tried, off the seams of tiles.
constexpr int places_along_area = 16;
// Maximum number of objects that a spawn is moved out of, one after another.
constexpr int max_push_outs = 4;

bool is_at_or_below(std::string_view path, std::string_view above) {
    return path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '/');
}

bool has_usual_name(const std::string& name) {
    const std::string lower = lower_case(name);
    constexpr std::array<std::string_view, 4> words{"spawn", "player_start", "playerstart", "player start"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

// Maps write spawns that may be anywhere as points in their corner.
bool is_anywhere(const NamedPlace<2>& place) {
    return place.position == Vec2(0);
}
bool is_anywhere(const NamedPlace<3>&) {
    return false;
}

template <int D>
struct Exit {
    float distance = 0;
    Vec<D> direction{};
};

// The nearest exit from a point in a body in the plane, of those in the eight directions of a compass that are up to
// `most` long. `closest` doesn't tell: a body of parts, such as tiles, is 0 deep where they meet.
Exit<2> nearest_exit(const View<2>& body, const Vec2& point, float least, float most) {
    Exit<2> best{most, Vec2(1, 0)};
    for (int i = 0; i < 9; ++i) {
        if (i == 4) continue;
        const Vec2 direction = glm::normalize(Vec2(i % 3 - 1, i / 3 - 1));
        const auto is_inside = [&](float distance) { return contains(body, point + direction * distance); };
        float inside = 0, outside = least;
        for (; outside < best.distance && is_inside(outside); outside *= 2) inside = outside;
        outside = std::min(outside, best.distance);
        if (is_inside(outside)) continue;
        for (int k = 0; k < 12; ++k) {
            const float middle = 0.5f * (inside + outside);
            (is_inside(middle) ? inside : outside) = middle;
        }
        best = {outside, direction};
    }
    return best;
}
Exit<3> nearest_exit(const View<3>&, const Vec3&, float, float) {
    return {};
}

template <int D>
struct Overlap {
    std::size_t object = 0;
    float depth = 0;
};

template <int D>
class SpawnCheck {
public:
    SpawnCheck(const LevelView<D>& level, std::vector<ViewedObject<D>> obstacles, std::vector<std::size_t> numbers,
               const SpawnOptions<D>& options)
        : level_(level),
          obstacles_(std::move(obstacles)),
          numbers_(std::move(numbers)),
          options_(options),
          facets_(obstacles_) {
        std::vector<Aabb<D>> boxes;
        for (const ViewedObject<D>& object : obstacles_) {
            boxes.push_back(object.box);
            world_.add(Unowned<D>{object.shape}, {.fixed = true});
        }
        tree_.build(boxes);
        world_.update();
    }

    std::optional<SpawnFinding<D>> test(std::size_t place) const;

private:
    std::optional<SpawnFinding<D>> test(std::size_t place, const Vec<D>& position) const;
    Capsule<D> character_at(const Vec<D>& place) const;
    float size() const { return options_.character ? 0.5f * options_.character->height : 0; }
    float allowed(const ViewedObject<D>& object) const;
    Exit<D> exit_from(const ViewedObject<D>& object, const Vec<D>& middle) const;
    float depth_in(const ViewedObject<D>& object, const Vec<D>& place) const;
    std::optional<Overlap<D>> deepest(const Vec<D>& place) const;
    std::optional<Vec<D>> free_place(const Vec<D>& place) const;
    Vec<D> pushed_out_of(const ViewedObject<D>& object, const Vec<D>& place) const;

    const LevelView<D>& level_;
    std::vector<ViewedObject<D>> obstacles_;
    std::vector<std::size_t> numbers_;  // indices in the level
    const SpawnOptions<D>& options_;
    FacetTree<D> facets_;
    World<D> world_;
    Bvh<D> tree_;
};

template <int D>
Capsule<D> SpawnCheck<D>::character_at(const Vec<D>& place) const {
    if (!options_.character) return {place, place, 0};
    const auto [radius, height] = *options_.character;
    if (!options_.up) return {place, place, radius};
    return {place + *options_.up * radius, place + *options_.up * (height - radius), radius};
}

template <int D>
float SpawnCheck<D>::allowed(const ViewedObject<D>& object) const {
    const float smaller = options_.character ? std::min(size(), object.radius) : object.radius;
    return options_.allow.value_or(default_allow * smaller);
}

template <int D>
Exit<D> SpawnCheck<D>::exit_from(const ViewedObject<D>& object, const Vec<D>& middle) const {
    return nearest_exit(object.shape, middle, 0.01f * object.radius, 2 * object.radius);
}

// The depth of a character at a position in an object, minus the penetration that a slope explains.
template <int D>
float SpawnCheck<D>::depth_in(const ViewedObject<D>& object, const Vec<D>& place) const {
    const Capsule<D> character = character_at(place);
    const Vec<D> middle = (character.a + character.b) * 0.5f;
    float depth = 0;
    if (options_.character) {
        each_contact(character, object.shape, [&](const Contact<D>& contact) {
            float contact_depth = contact.depth;
            if (options_.up) {
                const float cosine = -glm::dot(contact.normal, *options_.up);
                if (cosine >= min_slope_cosine) contact_depth -= options_.character->radius * (1 - cosine);
            }
            depth = std::max(depth, contact_depth);
        });
    }
    // A body that contains the whole character has no surface contact.
    if (depth <= 0 && object.filled && contains(object.shape, middle))
        depth = character.radius +
                std::max(std::abs(closest(object.shape, middle).distance), exit_from(object, middle).distance);
    return depth;
}

template <int D>
std::optional<Overlap<D>> SpawnCheck<D>::deepest(const Vec<D>& place) const {
    const Capsule<D> character = character_at(place);
    std::vector<std::uint32_t> near;
    tree_.each_overlapping(bounds(view(character)), [&](std::uint32_t i) { near.push_back(i); });
    std::sort(near.begin(), near.end());
    std::optional<Overlap<D>> result;
    for (const std::uint32_t i : near) {
        const float depth = depth_in(obstacles_[i], place);
        if (depth > allowed(obstacles_[i]) && (!result || depth > result->depth)) result = {i, depth};
    }
    return result;
}

// Moves the character out of a body that contains its centre: through the closest surface point, plus its own extent.
template <int D>
Vec<D> SpawnCheck<D>::pushed_out_of(const ViewedObject<D>& object, const Vec<D>& place) const {
    const Capsule<D> character = character_at(place);
    const Vec<D> middle = (character.a + character.b) * 0.5f;
    if (!object.filled || !contains(object.shape, middle)) return place;
    const Closest<D> nearest = closest(object.shape, middle);
    float separation = std::abs(nearest.distance);
    // A mesh reports the distance to its surface, and a convex body the separating direction.
    Vec<D> outwards = nearest.distance < 0 ? nearest.normal : -nearest.normal;
    if (const Exit<D> exit = exit_from(object, middle); exit.distance > separation) {
        separation = exit.distance;
        outwards = exit.direction;
    }
    const float half = glm::length(character.b - character.a) * 0.5f;
    const float along = options_.up && half > 0 ? std::abs(glm::dot(outwards, *options_.up)) * half : 0;
    const float gap = options_.character ? clearance * size() : allowed(object);
    return place + outwards * (separation + along + character.radius + gap);
}

template <int D>
std::optional<Vec<D>> SpawnCheck<D>::free_place(const Vec<D>& place) const {
    Vec<D> position = place;
    for (int i = 0; i < max_push_outs; ++i) {
        const std::optional<Overlap<D>> overlap = deepest(position);
        if (!overlap) break;
        const Vec<D> outside = pushed_out_of(obstacles_[overlap->object], position);
        position = outside;
        if (options_.character) {
            const Depenetration<D> separation = depenetrate(character_at(position), world_);
            position += separation.push;
            if (!separation && outside == place) return std::nullopt;
        }
    }
    const std::optional<Overlap<D>> initial = deepest(place);
    const float scale = options_.character ? size() : obstacles_[initial->object].radius;
    if (deepest(position) || glm::distance(position, place) > max_free_distance * scale) return std::nullopt;
    return position;
}

template <int D>
std::optional<SpawnFinding<D>> SpawnCheck<D>::test(std::size_t place) const {
    const NamedPlace<D>& spawn = level_.places[place];
    std::optional<SpawnFinding<D>> finding = test(place, spawn.position);
    if (!finding || !spawn.area) return finding;
    // The places of a grid over the area; areas are of levels in 2D.
    const Vec<D> extent = spawn.area->max - spawn.area->min;
    for (int i = 0; i < places_along_area; ++i)
        for (int j = 0; j < places_along_area; ++j) {
            Vec<D> position = spawn.position;
            position[0] = spawn.area->min[0] + extent[0] * (static_cast<float>(i) + 0.5f) / places_along_area;
            position[1] = spawn.area->min[1] + extent[1] * (static_cast<float>(j) + 0.5f) / places_along_area;
            if (!test(place, position)) return std::nullopt;
        }
    return finding;
}

template <int D>
std::optional<SpawnFinding<D>> SpawnCheck<D>::test(std::size_t place, const Vec<D>& position) const {
    SpawnFinding<D> finding;
    finding.place = place;
    if (const std::optional<Overlap<D>> overlap = deepest(position)) {
        finding.object = numbers_[overlap->object];
        finding.depth = overlap->depth;
        finding.free = free_place(position);
        return finding;
    }
    if (!options_.up) return std::nullopt;
    // Starts inside the character: the ground may be slightly above its lowest point.
    const Capsule<D> character = character_at(position);
    const float above_place = options_.character || obstacles_.empty()
                                  ? 0
                                  : ground_search_height * glm::distance(tree_.bounds().min, tree_.bounds().max);
    const DVec<D> inside((character.a + character.b) * 0.5f + *options_.up * above_place), up(*options_.up);
    constexpr double far = std::numeric_limits<double>::infinity();
    const auto above = facets_.first_hit(inside, up, far);
    if (above && above->from_behind && !facets_[above->facet].two_sided) {
        finding.fault = SpawnFault::beneath;
        finding.object = numbers_[facets_[above->facet].object];
        return finding;
    }
    if (facets_.first_hit(inside, -up, far)) return std::nullopt;
    finding.fault = SpawnFault::no_ground;
    return finding;
}

}  // namespace

template <int D>
std::vector<std::size_t> matching_places(const LevelView<D>& level, const std::string& pattern) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < level.places.size(); ++i)
        if (const NamedPlace<D>& place = level.places[i]; matches_name(pattern, place)) result.push_back(i);
    return result;
}

template <int D>
std::vector<std::size_t> default_spawns(const LevelView<D>& level) {
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < level.places.size(); ++i)
        if (const NamedPlace<D>& place = level.places[i];
            (has_usual_name(place.name) || has_usual_name(place.type)) && !is_anywhere(place))
            named.push_back(i);
    std::vector<std::size_t> result;
    for (const std::size_t i : named)
        if (std::none_of(named.begin(), named.end(), [&](std::size_t other) {
                return other != i && is_at_or_below(level.places[other].path, level.places[i].path);
            }))
            result.push_back(i);
    return result;
}

template <int D>
std::vector<std::size_t> obstacles_of(const LevelView<D>& level, const std::vector<std::size_t>& spawns) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < level.objects.size(); ++i)
        if (std::none_of(spawns.begin(), spawns.end(), [&](std::size_t spawn) {
                return is_at_or_below(level.objects[i].path, level.places[spawn].path);
            }))
            result.push_back(i);
    return result;
}

template <int D>
std::vector<SpawnFinding<D>> find_spawn_faults(const LevelView<D>& level, const std::vector<std::size_t>& spawns,
                                               const SpawnOptions<D>& options) {
    std::vector<std::size_t> numbers = obstacles_of(level, spawns);
    std::vector<ViewedObject<D>> obstacles;
    for (const std::size_t i : numbers) obstacles.push_back(level.objects[i]);
    std::vector<SpawnFinding<D>> result;
    const SpawnCheck<D> check(level, std::move(obstacles), std::move(numbers), options);
    for (const std::size_t spawn : spawns)
        if (std::optional<SpawnFinding<D>> finding = check.test(spawn)) result.push_back(*finding);
    return result;
}

template std::vector<std::size_t> matching_places(const LevelView<2>&, const std::string&);
template std::vector<std::size_t> matching_places(const LevelView<3>&, const std::string&);
template std::vector<std::size_t> default_spawns(const LevelView<2>&);
template std::vector<std::size_t> default_spawns(const LevelView<3>&);
template std::vector<std::size_t> obstacles_of(const LevelView<2>&, const std::vector<std::size_t>&);
template std::vector<std::size_t> obstacles_of(const LevelView<3>&, const std::vector<std::size_t>&);
template std::vector<SpawnFinding<2>> find_spawn_faults(const LevelView<2>&, const std::vector<std::size_t>&,
                                                        const SpawnOptions<2>&);
template std::vector<SpawnFinding<3>> find_spawn_faults(const LevelView<3>&, const std::vector<std::size_t>&,
                                                        const SpawnOptions<3>&);

}  // namespace abut::tool
