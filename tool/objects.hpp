#pragma once

// The objects of a scene or a level, each a shape in its place at a moment.

#include "inside.hpp"
#include "progress.hpp"
#include "stage.hpp"
#include <abut/abut.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut::tool {

template <int D>
struct Object {
    std::string path;
    std::string name;  ///< the last part of the path
    std::string type;  ///< the class that its author gave it, where files have such

    // At the moment that was asked for last:
    std::string_view kind;       ///< what its shape is: "solid", "mesh"; in 2D "box", "tiles", ...
    std::string_view part_name;  ///< what a part of it is, that answers tell: "triangle", "tile"; empty of a convex one
    std::size_t parts = 1;       ///< of those
    bool present = false;        ///< false while its transform flattens it to nothing
    bool moved = false;          ///< other than at the moment before
    bool solid = false;          ///< the shape is convex, and so one body
    bool filled = false;         ///< a closed surface or line around a body: things can be swallowed by it
    float radius = 0;            ///< its size
    InsidePoint<D> inside;       ///< in the shape's frame
    float reach = 0;             ///< how far the shape goes from the origin of its frame
    View<D> shape;               ///< in its frame, of what moves
    Pose<D> pose;
    View<D> placed;
    Aabb<D> box = Aabb<D>::empty();
};

/// In the order of their paths.
template <int D>
class Objects {
public:
    Objects() = default;
    virtual ~Objects() = default;
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    /// Takes all objects to a moment, in seconds. A Problem where one can't be placed there. Progress is told in
    /// objects; the first time takes long, as all shapes are built.
    virtual std::optional<Problem> go_to(double time, ProgressCall progress) = 0;
    std::optional<Problem> go_to(double time) {
        return go_to(time, [](std::size_t, std::size_t) {});
    }

    /// The way from the moment that was asked for last to a later one, stage by stage. Objects and their shapes stay as
    /// they are. Nothing for objects that don't move.
    virtual void each_stage(double from, double to, FunctionRef<void(const Stage<D>&)> visit) {
        static_cast<void>(from), static_cast<void>(to), static_cast<void>(visit);
    }

    /// Those that jumped on some stage so far, or changed their shape.
    virtual std::vector<std::string> unfollowed() const { return {}; }

    /// Those that were left out at some moment so far.
    virtual std::vector<std::string> hidden() const { return {}; }

    std::size_t size() const { return objects_.size(); }
    const Object<D>& operator[](std::size_t i) const { return objects_[i]; }
    std::size_t count_solids() const {
        std::size_t count = 0;
        for (const Object<D>& object : objects_) count += object.solid ? 1 : 0;
        return count;
    }

protected:
    std::vector<Object<D>> objects_;
};

}  // namespace abut::tool
