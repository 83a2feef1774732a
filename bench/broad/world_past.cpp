// The past of a World: recording it, and rays into it, compared with a world whose players are moved back one by one.

#include "../../test/oracle/random.hpp"
#include "broad.hpp"
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/world/history.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

constexpr std::size_t items = 10'000, players = 64, ticks = 64, shots = 256;

/// What the items are that are no players: at rest, and fixed or not; or moving, and recorded too or not.
enum class Others { fixed, resting, moving, recorded };

/// Boxes at random in a cube, players among them that walk and turn, and shots at where a player was.
class Match {
public:
    explicit Match(Others others)
        : others_(others),
          random_(broad_seed),
          history_(world_, ticks, {.layers = others == Others::recorded ? ~std::uint64_t{0} : std::uint64_t{2}}) {
        for (std::size_t i = 0; i < items; ++i) {
            const Pose3 pose{point(), random_.rotation<3>()};
            if (i < players)
                ids_.push_back(world_.add(Capsule3{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.5f}, {.pose = pose, .layers = 2}));
            else
                ids_.push_back(
                    world_.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, {.pose = pose, .fixed = others == Others::fixed}));
        }
        for (std::size_t i = 0; i < ticks + 2; ++i) {
            step();
            record();
        }
        rewound_ = world_;
        for (std::size_t i = 0; i < shots; ++i) {
            Shot shot{.tick = random_.below(ticks - 1), .fraction = random_.uniform_float(0, 1)};
            const Vec3 target = pose_at_shot(shot, random_.below(players)).position;
            shot.ray = Ray3::between(target + Vec3(random_.direction<3>() * 30.0), target);
            shots_.push_back(shot);
        }
    }

    void step() {
        const bool all = others_ == Others::moving || others_ == Others::recorded;
        for (std::size_t i = 0; i < (all ? items : players); ++i) {
            const Pose3 pose = world_.pose(ids_[i]);
            const Vec3 axis(random_.direction<3>());
            world_.move(ids_[i], {pose.position + 0.1f * axis, turn_about(axis, 0.1f) * pose.rotation});
        }
        world_.update();
    }
    void record() {
        history_.record();
        poses_.emplace_back();
        for (std::size_t i = 0; i < players; ++i) poses_.back().push_back(world_.pose(ids_[i]));
        if (poses_.size() > ticks) poses_.erase(poses_.begin());
    }
    void record_history() { history_.record(); }
    double shoot(std::size_t i) {
        const Shot& shot = shots_[i];
        return distance(history_.at(history_.first_tick() + shot.tick, shot.fraction), shot.ray);
    }
    double shoot_at_moved(std::size_t i) {
        for (std::size_t k = 0; k < players; ++k) rewound_.move(ids_[k], pose_at_shot(shots_[i], k));
        return distance(rewound_, shots_[i].ray);
    }
    double last_pose() { return static_cast<double>(world_.pose(ids_[0]).position.x); }

private:
    struct Shot {
        std::uint32_t tick = 0;
        float fraction = 0;
        Ray3 ray{};
    };

    Vec3 point() { return Vec3(random_.in_cube<3>() * 40.0); }
    Pose3 pose_at_shot(const Shot& shot, std::size_t player) const {
        return pose_at(Motion3::between(poses_[shot.tick][player], poses_[shot.tick + 1][player]), shot.fraction);
    }
    static double distance(const World3& world, const Ray3& ray) {
        const auto hit = world.raycast(ray);
        return hit ? static_cast<double>(hit->hit.distance) : -1;
    }

    Others others_;
    oracle::Random random_;
    World3 world_, rewound_;
    History3 history_;
    std::vector<Id> ids_;
    std::vector<std::vector<Pose3>> poses_;  // of the players, at the ticks that are held
    std::vector<Shot> shots_;
};

/// A ray at each of many moments.
Job shots_of(Others others) {
    const auto match = std::make_shared<Match>(others);
    const auto side = [&](std::string who, double (Match::*shoot)(std::size_t)) -> Side {
        return {std::move(who), [match, shoot](std::span<double> values) {
                    for (std::size_t i = 0; i < shots; ++i) values[i] = (match.get()->*shoot)(i);
                }};
    };
    return {.items = shots,
            .values = shots,
            .tolerance = 0,
            .sides = {side("abut", &Match::shoot), side("abut moves", &Match::shoot_at_moved)}};
}

/// A record after each update.
Job records_of(Others others) {
    const auto match = std::make_shared<Match>(others);
    const auto run = [match](std::span<double> values) {
        match->record_history();
        values[0] = match->last_pose();
    };
    return {.items = items, .values = 1, .rounds = 4, .frames = 10, .tolerance = 0, .sides = {{"abut", run, [match] {
                                                                                                   match->step();
                                                                                               }}}};
}

}  // namespace

std::vector<Bench> world_past_benches() {
    return {
        {"broad/world/past/ray/fixed/10000", [] { return shots_of(Others::fixed); }},
        {"broad/world/past/ray/resting/10000", [] { return shots_of(Others::resting); }},
        {"broad/world/past/ray/moving/10000", [] { return shots_of(Others::moving); }},
        {"broad/world/past/record/fixed/10000", [] { return records_of(Others::fixed); }},
        {"broad/world/past/record/resting/10000", [] { return records_of(Others::resting); }},
        {"broad/world/past/record/moving/10000", [] { return records_of(Others::moving); }},
        {"broad/world/past/record/recorded/10000", [] { return records_of(Others::recorded); }},
    };
}

}  // namespace abut::bench
