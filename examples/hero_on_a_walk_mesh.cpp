// A character that can't leave the level: a position on a walk mesh, a closed door, items found through a World, and a
// monster that follows a path.
#include <abut/abut.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>

namespace {

constexpr std::uint32_t columns = 24, rows = 12, wall = 12, door = 6;

/// Two rooms of hills. Missing triangles form the wall between them, except for one square, the doorway.
abut::WalkMesh make_level(std::vector<std::uint8_t>& is_door) {
    std::vector<abut::Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t z = 0; z <= rows; ++z)
        for (std::uint32_t x = 0; x <= columns; ++x)
            points.push_back({x, 0.1f * static_cast<float>((x * 7 + z * 5) % 6), z});
    for (std::uint32_t z = 0; z < rows; ++z)
        for (std::uint32_t x = 0; x < columns; ++x) {
            if (x == wall && z != door) continue;
            const std::uint32_t i = z * (columns + 1) + x, beyond = i + columns + 1;
            triangles.push_back({i, beyond, i + 1});
            triangles.push_back({i + 1, beyond, beyond + 1});
            is_door.resize(triangles.size(), x == wall ? 1 : 0);
        }
    return *abut::WalkMesh::build(points, triangles);
}

/// Moves one step of at most `reach` along the shortest path to a target; false if there is none.
bool follow(const abut::WalkMesh& level, abut::WalkPoint& place, const abut::WalkPoint& target, float reach,
            const abut::WalkAllow& allow) {
    const auto path = level.path(place, target, {.allow = allow});
    if (!path) return false;
    const abut::Vec3 here = level.to_world(place);
    for (const abut::Vec3& next : *path) {
        const float distance = glm::length(next - here);
        if (distance < 1e-3f) continue;
        place = level.walk(place, (next - here) * std::min(1.0f, reach / distance), {.allow = allow}).place;
        break;
    }
    return true;
}

}  // namespace

int main() {
    constexpr std::uint32_t hero_layer = 1, monster_layer = 2, coin_layer = 4, key_layer = 8;
    constexpr float hero_speed = 0.1f, monster_speed = 0.05f;
    std::vector<std::uint8_t> is_door;
    const abut::WalkMesh level = make_level(is_door);
    bool is_open = false;
    const auto may_pass = [&](const abut::WalkSide& from, const abut::WalkSide& to) {
        return is_open || (is_door[from.triangle] == 0 && is_door[to.triangle] == 0);
    };

    // Items are placed on the level's surface.
    abut::World3 world;
    const auto put = [&](const abut::Vec3& where, std::uint32_t layer, std::uint32_t mask) {
        const abut::Vec3 ground = level.to_world(level.nearest(where));
        return world.add(abut::Sphere{{0, 0, 0}, 0.3f},
                         {.pose = {ground}, .layers = layer, .mask = mask, .sensor = true});
    };
    const abut::Id key = put({2, 3, 10}, key_layer, hero_layer);
    for (const abut::Vec3& where : {abut::Vec3(15, 0, 2), abut::Vec3(22, 0, 10), abut::Vec3(20, 0, 4)})
        put(where, coin_layer, hero_layer);
    abut::WalkPoint hero = level.nearest({4, 0, 6.4f}), monster = level.nearest({1, 0, 1});
    const abut::Id hero_id = put({4, 0, 6.4f}, hero_layer, coin_layer | key_layer | monster_layer);
    const abut::Id monster_id = put({1, 0, 1}, monster_layer, hero_layer);

    // Walks to the right, as a player would, until the door blocks it.
    bool met_door = false;
    for (int frame = 0; frame < 200 && !met_door; ++frame) {
        const abut::Walked walked = level.walk(hero, abut::Vec3(hero_speed, 0, 0), {.allow = may_pass});
        hero = walked.place;
        met_door = walked.met != abut::WalkMet::nothing && level.beyond(walked.side) &&
                   is_door[level.beyond(walked.side)->triangle] != 0;
    }
    std::printf("at the door: %.1f %.1f\n", static_cast<double>(level.to_world(hero).x),
                static_cast<double>(level.to_world(hero).z));

    int coins = 0, frame = 0;
    bool is_caught = false;
    for (; frame < 2000 && !is_caught; ++frame) {
        // Goes to the key, then to the nearest coin; waits if none is left.
        const auto next =
            world.closest(level.to_world(hero), {.mask = is_open ? coin_layer : key_layer, .sensors = true});
        if (next) follow(level, hero, level.nearest(world.pose(next->id).position), hero_speed, may_pass);
        if (is_open) follow(level, monster, hero, monster_speed, may_pass);
        world.move(hero_id, {level.to_world(hero)});
        world.move(monster_id, {level.to_world(monster)});

        const abut::Events events = world.update();
        std::vector<abut::Id> found;
        for (const abut::IdPair& pair : events.began) {
            const abut::Id other = pair.a == hero_id ? pair.b : pair.a;
            if (other == monster_id)
                is_caught = true;
            else
                found.push_back(other);
        }
        for (const abut::Id id : found) {
            is_open = is_open || id == key;
            coins += id == key ? 0 : 1;
            world.remove(id);
        }
    }
    std::printf("%d coins, caught in frame %d\n", coins, frame);
    return met_door && coins == 3 && is_caught ? 0 : 1;
}
