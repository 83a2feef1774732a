#pragma once

// Scenes of many moving boxes, and sides that count the pairs of each frame.

#include "../bench.hpp"
#include <abut/math/aabb.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace abut::bench {

/// A scene of boxes that can advance by a frame.
template <int D>
class BoxScene {
public:
    virtual ~BoxScene() = default;
    virtual std::span<const Aabb<D>> boxes() const = 0;
    virtual void step() = 0;
};

/// Makes the same scene for each side, at its first frame: sides alternate, and each must see all frames.
template <int D>
using MakeScene = std::function<std::unique_ptr<BoxScene<D>>()>;

/// Makes a scene of a class in scenes/ from its constructor's arguments.
template <int D, template <int> class Scene, class... Arguments>
MakeScene<D> scene_of(Arguments... arguments) {
    class Wrapped final : public BoxScene<D> {
    public:
        explicit Wrapped(const Arguments&... values) : scene_(values...) {}
        std::span<const Aabb<D>> boxes() const override { return scene_.boxes(); }
        void step() override { scene_.step(); }

    private:
        Scene<D> scene_;
    };
    return [=]() -> std::unique_ptr<BoxScene<D>> { return std::make_unique<Wrapped>(arguments...); };
}

/// Counts the overlapping pairs of each frame. The counter is constructed from the first frame's boxes as
/// Counter(boxes, arguments...), and counter.count(boxes) is called in each later frame.
template <class Counter, int D, class... Arguments>
Side count_pairs(std::string who, const MakeScene<D>& make, const Arguments&... arguments) {
    struct State {
        explicit State(std::unique_ptr<BoxScene<D>> first, const Arguments&... values)
            : scene(std::move(first)), counter(scene->boxes(), values...) {}
        std::unique_ptr<BoxScene<D>> scene;
        Counter counter;
    };
    const auto state = std::make_shared<State>(make(), arguments...);
    return {std::move(who),
            [state](std::span<double> values) {
                values[0] = static_cast<double>(state->counter.count(state->scene->boxes()));
            },
            [state] { state->scene->step(); }};
}

}  // namespace abut::bench
