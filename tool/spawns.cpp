#include "spawns.hpp"

#include "glob.hpp"
#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

// Of the smaller one's size: what things that stand on things may sink in.
constexpr float default_allow = 1e-3f;
// The cosine of the steepest slope to stand on.
constexpr float steepest = 0.5f;
// How far away a free place is looked for, in sizes of the character, or of the object that a point is in.
constexpr float near_by = 4;
// A place that is free keeps clear of what it got out of by this part of the character's size.
constexpr float clear = 1e-3f;
// Of the level's size: how far above a spawn without a size its ground may be by rounding.
constexpr float lift = 1e-4f;
// How many objects a spawn is taken out of, one after another.
constexpr int most_ways_out = 4;

bool is_at_or_below(std::string_view path, std::string_view above) {
    return path.starts_with(above) && (path.size() == above.size() || path[above.size()] == '/');
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool has_usual_name(const std::string& name) {
    const std::string lower = lower_case(name);
    constexpr std::array<std::string_view, 4> words{"spawn", "player_start", "playerstart", "player start"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

template <int D>
struct Overlap {
    std::size_t object = 0;
    float depth = 0;
};

template <int D>
class SpawnCheck {
public:
    SpawnCheck(const LevelView<D>& level, std::vector<StandingObject<D>> obstacles, std::vector<std::size_t> numbers,
               const SpawnOptions<D>& options)
        : level_(level),
          obstacles_(std::move(obstacles)),
          numbers_(std::move(numbers)),
          options_(options),
          facets_(obstacles_) {
        std::vector<Aabb<D>> boxes;
        for (const StandingObject<D>& object : obstacles_) {
            boxes.push_back(object.box);
            world_.add(Unowned<D>{object.shape}, {.fixed = true});
        }
        tree_.build(boxes);
        world_.update();
    }

    std::optional<SpawnFinding<D>> look_at(std::size_t place) const;

private:
    Capsule<D> character_at(const Vec<D>& place) const;
    float size() const { return options_.character ? 0.5f * options_.character->height : 0; }
    float allowed(const StandingObject<D>& object) const;
    float depth_in(const StandingObject<D>& object, const Vec<D>& place) const;
    std::optional<Overlap<D>> deepest(const Vec<D>& place) const;
    std::optional<Vec<D>> free_place(const Vec<D>& place) const;
    Vec<D> out_of(const StandingObject<D>& object, const Vec<D>& place) const;

    const LevelView<D>& level_;
    std::vector<StandingObject<D>> obstacles_;
    std::vector<std::size_t> numbers_;  // in the level
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
float SpawnCheck<D>::allowed(const StandingObject<D>& object) const {
    const float smaller = options_.character ? std::min(size(), object.radius) : object.radius;
    return options_.allow.value_or(default_allow * smaller);
}

// How far in an object somebody at a place is, beyond what standing on slopes explains.
template <int D>
float SpawnCheck<D>::depth_in(const StandingObject<D>& object, const Vec<D>& place) const {
    const Capsule<D> character = character_at(place);
    const Vec<D> middle = (character.a + character.b) * 0.5f;
    float depth = 0;
    if (options_.character) {
        each_contact(character, object.shape, [&](const Contact<D>& contact) {
            float deep = contact.depth;
            if (options_.up) {
                const float cosine = -glm::dot(contact.normal, *options_.up);
                if (cosine >= steepest) deep -= options_.character->radius * (1 - cosine);
            }
            depth = std::max(depth, deep);
        });
    }
    // The surface of a body that holds all of it touches nothing.
    if (depth <= 0 && object.filled && contains(object.shape, middle))
        depth = std::abs(closest(object.shape, middle).distance) + character.radius;
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

// To the nearest place of the surface of a body that holds the middle of somebody, and all of him out there.
template <int D>
Vec<D> SpawnCheck<D>::out_of(const StandingObject<D>& object, const Vec<D>& place) const {
    const Capsule<D> character = character_at(place);
    const Vec<D> middle = (character.a + character.b) * 0.5f;
    if (!object.filled || !contains(object.shape, middle)) return place;
    const Closest<D> nearest = closest(object.shape, middle);
    const float way = std::abs(nearest.distance);
    // Of a mesh it is the surface that is near, of a convex body the way out that is told.
    const Vec<D> outwards = nearest.distance < 0 ? nearest.normal : -nearest.normal;
    const float half = glm::length(character.b - character.a) * 0.5f;
    const float along = options_.up && half > 0 ? std::abs(glm::dot(outwards, *options_.up)) * half : 0;
    const float room = options_.character ? clear * size() : allowed(object);
    return place + outwards * (way + along + character.radius + room);
}

template <int D>
std::optional<Vec<D>> SpawnCheck<D>::free_place(const Vec<D>& place) const {
    Vec<D> now = place;
    for (int i = 0; i < most_ways_out; ++i) {
        const std::optional<Overlap<D>> in = deepest(now);
        if (!in) break;
        const Vec<D> outside = out_of(obstacles_[in->object], now);
        now = outside;
        if (options_.character) {
            const Depenetration<D> way = depenetrate(character_at(now), world_);
            now += way.push;
            if (!way && outside == place) return std::nullopt;
        }
    }
    const std::optional<Overlap<D>> was = deepest(place);
    const float scale = options_.character ? size() : obstacles_[was->object].radius;
    if (deepest(now) || glm::distance(now, place) > near_by * scale) return std::nullopt;
    return now;
}

template <int D>
std::optional<SpawnFinding<D>> SpawnCheck<D>::look_at(std::size_t place) const {
    const Vec<D> position = level_.places[place].position;
    SpawnFinding<D> finding;
    finding.place = place;
    if (const std::optional<Overlap<D>> overlap = deepest(position)) {
        finding.object = numbers_[overlap->object];
        finding.depth = overlap->depth;
        finding.free = free_place(position);
        return finding;
    }
    if (!options_.up) return std::nullopt;
    // From within the character: what it stands on may be a little above its lowest point.
    const Capsule<D> character = character_at(position);
    const float above_place =
        options_.character || obstacles_.empty() ? 0 : lift * glm::distance(tree_.bounds().min, tree_.bounds().max);
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
std::vector<std::size_t> described_places(const LevelView<D>& level, const std::string& pattern) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < level.places.size(); ++i)
        if (const NamedPlace<D>& place = level.places[i];
            describes(pattern, place) || (!place.type.empty() && matches(pattern, place.type)))
            result.push_back(i);
    return result;
}

template <int D>
std::vector<std::size_t> usual_spawns(const LevelView<D>& level) {
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < level.places.size(); ++i)
        if (has_usual_name(level.places[i].name) || has_usual_name(level.places[i].type)) named.push_back(i);
    std::vector<std::size_t> result;
    for (const std::size_t i : named)
        if (std::none_of(named.begin(), named.end(), [&](std::size_t other) {
                return other != i && is_at_or_below(level.places[other].path, level.places[i].path);
            }))
            result.push_back(i);
    return result;
}

template <int D>
std::vector<SpawnFinding<D>> find_spawn_faults(const LevelView<D>& level, const std::vector<std::size_t>& spawns,
                                               const SpawnOptions<D>& options) {
    std::vector<StandingObject<D>> obstacles;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < level.objects.size(); ++i) {
        const bool is_mark = std::any_of(spawns.begin(), spawns.end(), [&](std::size_t spawn) {
            return is_at_or_below(level.objects[i].path, level.places[spawn].path);
        });
        if (is_mark) continue;
        obstacles.push_back(level.objects[i]);
        numbers.push_back(i);
    }
    std::vector<SpawnFinding<D>> result;
    const SpawnCheck<D> check(level, std::move(obstacles), std::move(numbers), options);
    for (const std::size_t spawn : spawns)
        if (std::optional<SpawnFinding<D>> finding = check.look_at(spawn)) result.push_back(*finding);
    return result;
}

template std::vector<std::size_t> described_places(const LevelView<2>&, const std::string&);
template std::vector<std::size_t> described_places(const LevelView<3>&, const std::string&);
template std::vector<std::size_t> usual_spawns(const LevelView<2>&);
template std::vector<std::size_t> usual_spawns(const LevelView<3>&);
template std::vector<SpawnFinding<2>> find_spawn_faults(const LevelView<2>&, const std::vector<std::size_t>&,
                                                        const SpawnOptions<2>&);
template std::vector<SpawnFinding<3>> find_spawn_faults(const LevelView<3>&, const std::vector<std::size_t>&,
                                                        const SpawnOptions<3>&);

}  // namespace abut::tool
