// The laser for the page.

#include "laser.h"

#include "json.hpp"
#include <abut/motion/laser.hpp>

using namespace abut::detail;

abut_code abut_play_laser2(const abut_world2* world, abut_ray2 ray, uint32_t max_hits, abut_buffer* out) {
    return entry({present(world, "world"), finite(ray, "ray"), present(out, "out")}, [&] {
        const auto first = same_bytes<abut::Ray2>(ray);
        std::vector<abut::Vec2> points{first.origin}, normals;
        std::vector<std::uint32_t> items;
        bool ends_at_hit = false;
        const auto is_reflected = [&](const abut::Ray2&, const abut::WorldHit<2>& hit) {
            points.push_back(hit.hit.point);
            normals.push_back(hit.hit.normal);
            items.push_back(hit.id.index);
            ends_at_hit = world->world.user(hit.id) == 0 || items.size() >= max_hits;
            return !ends_at_hit;
        };
        const abut::Ray2 last = abut::follow_laser(world->world, first, is_reflected);
        if (!ends_at_hit && std::isfinite(last.length)) points.push_back(last.origin + last.direction * last.length);

        abut::play::Json json;
        json.begin('{').key("points").vecs<2>(points).key("normals").vecs<2>(normals).key("items").begin('[');
        for (const std::uint32_t item : items) json.count(item);
        json.end(']').end('}').write(*out);
    });
}
