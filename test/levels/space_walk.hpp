#pragma once

// A level of Neverball with moving lifts, and paths over its ground.

#include "real_levels.hpp"
#include "walks.hpp"

#include <map>
#include <queue>
#include <tuple>

namespace abut::test {

using detail::length;

inline oracle::Polytope<3> polytope_of(const Polyhedron& shape, const Vec3& offset) {
    oracle::Polytope<3> result;
    result.place.offset = detail::DVec<3>(offset);
    result.points.assign(shape.points().begin(), shape.points().end());
    const detail::Facets& facets = shape.facets();
    for (std::size_t face = 0; face < facets.loop_ends.size(); ++face) {
        const auto loop = facets.loop(face);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
            if (a < b) result.edges.push_back({a, b});
            if (i > 1) result.triangles.push_back({loop[0], loop[i - 1], loop[i]});
        }
    }
    if (shape.rank() == 1) result.edges.push_back({0, 1});
    result.edge_directions = result.edges;
    return result;
}

/// A world in which each brush is an item, or all static brushes are one compound. Bodies on paths are items at their
/// start.
class SpaceLevel {
public:
    SpaceLevel(const scenes::NeverballLevel& level, bool as_compound) {
        std::vector<AnyShape<3>> still;
        scenes::each_solid(
            level, [&](const scenes::NeverballBody& body, const scenes::NeverballBrush&, const Polyhedron& shape) {
                const Vec3 start = scenes::start_of(level, body);
                pieces_.add(polytope_of(shape, start));
                if (as_compound && !body.stop)
                    still.push_back(shape);
                else
                    world_.add(shape, {.pose = {start}, .fixed = true});
            });
        if (!still.empty()) world_.add(*Compound3::build(still), {.fixed = true});
        pieces_.build();
    }

    const World3& world() const { return world_; }
    const Pieces<3>& pieces() const { return pieces_; }

private:
    World3 world_;
    Pieces<3> pieces_;
};

/// Paths of a ball over the ground, by a search over squares from above: within the walkable slope and the allowed
/// drop, and with clearance.
class SpaceGrid {
public:
    SpaceGrid(const SpaceLevel& level, const scenes::NeverballBall& ball, const scenes::NeverballBall& goal)
        : world_(level.world()), radius_(ball.radius), cell_(ball.radius) {
        const auto start = ground_at(ball.position.x, ball.position.z, ball.position.y, 1.0f);
        if (!start) return;
        std::queue<Place> open;
        const Place first{0, 0, height_key(*start)};
        origin_ = ball.position;
        from_.emplace(first, Entry{first, {ball.position.x, *start, ball.position.z}});
        open.push(first);
        while (!open.empty() && from_.size() < 60000) {
            const Place here = open.front();
            open.pop();
            const Vec3 at = from_.at(here).position;
            const double off = length(detail::DVec<2>(static_cast<double>(at.x - goal.position.x),
                                                      static_cast<double>(at.z - goal.position.z)));
            if (off < static_cast<double>(std::max(goal.radius, cell_)) && std::abs(at.y - goal.position.y) < 1) {
                for (Place place = here;; place = from_.at(place).from) {
                    path_.push_back(from_.at(place).position);
                    if (from_.at(place).from == place) break;
                }
                std::reverse(path_.begin(), path_.end());
                return;
            }
            for (const auto& [dx, dz] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                const int x = std::get<0>(here) + dx, z = std::get<1>(here) + dz;
                const float at_x = origin_.x + cell_ * static_cast<float>(x);
                const float at_z = origin_.z + cell_ * static_cast<float>(z);
                const auto height = ground_at(at_x, at_z, at.y + 0.6f * cell_, 1.5f);
                if (!height) continue;
                const Place next{x, z, height_key(*height)};
                const Vec3 there(at_x, *height, at_z);
                if (from_.contains(next) || !free_between(at, there)) continue;
                from_.emplace(next, Entry{here, there});
                open.push(next);
            }
        }
    }

    /// Positions on the ground from the ball to the goal; none if there is no such path.
    const std::vector<Vec3>& path() const { return path_; }

private:
    using Place = std::tuple<int, int, int>;
    struct Entry {
        Place from;
        Vec3 position;
    };

    int height_key(float height) const { return static_cast<int>(height / cell_ + 1000.5f); }
    /// The ground below a height, within a distance.
    std::optional<float> ground_at(float x, float z, float from, float drop) const {
        const auto hit = world_.raycast(Ray3{{x, from, z}, {0, -1, 0}, drop});
        if (!hit || hit->hit.started_inside || hit->hit.normal.y < 0.75f) return std::nullopt;
        return hit->hit.point.y;
    }
    /// Whether a motion is free: sideways at the greater height for two balls, one above the other, and then down for
    /// one.
    bool free_between(const Vec3& a, const Vec3& b) const {
        const float height = std::max(a.y, b.y) + 1.5f * radius_, wide = 1.04f * radius_;
        const Capsule3 tall{{a.x, height, a.z}, {a.x, height + radius_, a.z}, wide};
        if (!world_.overlapping(tall).empty() || world_.sweep(tall, Vec3(b.x - a.x, 0, b.z - a.z))) return false;
        const Sphere above{{b.x, height, b.z}, wide};
        const float rest = b.y + 1.1f * radius_;
        return !world_.sweep(above, Vec3(0, rest - height, 0));
    }

    const World3& world_;
    float radius_, cell_;
    Vec3 origin_{};
    std::map<Place, Entry> from_;
    std::vector<Vec3> path_;
};

}  // namespace abut::test
