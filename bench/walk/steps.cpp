// Ten thousand walkers on hills, one step each: 1/20 cell, one cell, ten cells.

#include "../../test/oracle/random.hpp"
#include "walk.hpp"

#include <string>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t walker_count = 10000;

SharedWalkSteps make_steps(std::uint32_t columns, float length) {
    constexpr std::uint64_t seed = 2;
    oracle::Random random(seed);
    WalkSteps steps{walk_scene(columns), length, {}, {}, {}};
    constexpr std::uint32_t headings = 1024;
    for (std::uint32_t i = 0; i < headings; ++i) {
        const DVec<2> direction = random.direction<2>() * static_cast<double>(length);
        steps.headings.push_back(Vec3(DVec<3>(direction.x, 0, direction.y)));
    }
    const auto count = static_cast<std::uint32_t>(steps.scene->triangles.size());
    for (std::size_t i = 0; i < walker_count; ++i) {
        const std::uint32_t triangle = random.below(count);
        const double first = random.unit(), second = (1 - first) * random.unit();
        steps.starts.push_back({triangle, Vec3(DVec<3>(first, second, 1 - first - second))});
        steps.initial_headings.push_back(random.below(headings));
    }
    return std::make_shared<const WalkSteps>(std::move(steps));
}

/// Steps in world space, the horizontal ones of the peers.
class LevelWalkers {
public:
    explicit LevelWalkers(const SharedWalkSteps& steps)
        : steps_(steps), places_(steps->starts), headings_(steps->initial_headings) {}

    void advance() {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Walked walked = steps_->scene->mesh.walk(places_[i], steps_->headings[headings_[i]]);
            places_[i] = walked.place;
            const bool is_lost = walked.met != WalkMet::nothing;
            lost_ += is_lost;
            if (is_lost || (frame_ + i) % frames_per_heading == 0) headings_[i] = next_heading(*steps_, headings_[i]);
        }
        ++frame_;
    }
    void write(std::span<double> values) const {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Vec3 place = steps_->scene->mesh.to_world(places_[i]);
            values[2 * i] = place.x;
            values[2 * i + 1] = place.z;
        }
    }
    double lost_share() const { return static_cast<double>(lost_) / static_cast<double>(frame_ * places_.size()); }

protected:
    SharedWalkSteps steps_;
    std::vector<WalkPoint> places_;
    std::vector<std::uint32_t> headings_;
    std::size_t frame_ = 0, lost_ = 0;
};

/// Steps in the triangles' frames, transported along the surface: geodesics.
class StraightWalkers : public LevelWalkers {
public:
    explicit StraightWalkers(const SharedWalkSteps& steps) : LevelWalkers(steps) {
        for (std::size_t i = 0; i < places_.size(); ++i) steps_on_.push_back(anew(i));
    }

    void advance() {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Walked walked = steps_->scene->mesh.walk(places_[i], steps_on_[i]);
            places_[i] = walked.place;
            steps_on_[i] = walked.turn * steps_on_[i];
            const bool is_lost = walked.met != WalkMet::nothing;
            lost_ += is_lost;
            if (is_lost || (frame_ + i) % frames_per_heading == 0) {
                headings_[i] = next_heading(*steps_, headings_[i]);
                steps_on_[i] = anew(i);
            }
        }
        ++frame_;
    }

private:
    Vec2 anew(std::size_t i) const {
        return steps_->scene->mesh.to_plane(places_[i].triangle, steps_->headings[headings_[i]]);
    }

    std::vector<Vec2> steps_on_;
};

template <class Walkers>
Side by_abut(const char* who, const SharedWalkSteps& steps) {
    return walking_side(who, "at borders", std::make_shared<Walkers>(steps), 2 * walker_count);
}

/// Detour's steps have their length and are straight seen from above; abut's have their length on the surface, and are
/// straight there. On slopes the end points differ.
Job walk(std::uint32_t columns, float length) {
    const SharedWalkSteps steps = make_steps(columns, length);
    Job job;
    job.items = walker_count * frames_per_call;
    job.values = 2 * walker_count;
    job.tolerance = 0.35 * static_cast<double>(length);
    job.sides.push_back(by_abut<LevelWalkers>("abut", steps));
    job.sides.push_back(by_abut<StraightWalkers>("abut, steps in plane", steps));
    for (const bool with_heights : {false, true}) {
        Side detour = detour_steps(steps, with_heights);
        detour.strays = 1;
        job.sides.push_back(std::move(detour));
    }
    return job;
}

}  // namespace

std::vector<Bench> walk_step_benches() {
    std::vector<Bench> result;
    for (const std::uint32_t columns : {71u, 157u, 226u})
        for (const float length : {0.05f, 1.0f, 10.0f}) {
            const char* step = length < 1 ? "0.05" : length > 1 ? "10" : "1";
            const std::string name = std::string("walk/step/") + step + "/" + std::to_string(2 * columns * columns);
            result.push_back({name, [=] { return walk(columns, length); }});
        }
    return result;
}

}  // namespace abut::bench
