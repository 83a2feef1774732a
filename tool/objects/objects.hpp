#pragma once

// The objects of a scene or a level: shapes with poses at the current time.

#include "tool/objects/interior_point.hpp"
#include "tool/objects/stage.hpp"
#include "tool/shared/progress.hpp"
#include <abut/abut.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut::tool {

template <int D>
struct Object {
    std::string path;
    std::string name;  ///< last component of the path
    std::string type;  ///< class assigned by the author, if the format has classes

    // State at the current time:
    std::string_view kind;             ///< kind of shape: "solid", "mesh"; in 2D "box", "tiles", ...
    std::string_view part_name;        ///< name of a part in reports: "triangle", "tile"; empty for a convex shape
    std::size_t parts = 1;             ///< count of parts
    bool present = false;              ///< false while its transform collapses it to a line or a point
    bool moved = false;                ///< it moved since the last time
    bool solid = false;                ///< the shape is convex
    bool filled = false;               ///< a closed surface or line that bounds a body: other objects can be inside
    float radius = 0;                  ///< bounding radius
    InteriorPoint<D> inside;           ///< in the shape's frame
    float reach = 0;                   ///< maximum distance of the shape from the origin of its frame
    std::shared_ptr<const void> data;  ///< what the shape refers to, if that may change; another one if it does
    View<D> shape;                     ///< in its own frame
    View<3> surface;                   ///< of a filled mesh in space: its triangles alone, in its own frame
    Pose<D> pose;
    View<D> placed;
    Aabb<D> box = Aabb<D>::empty();
};

/// A list of objects, sorted by path.
template <int D>
class Objects {
public:
    Objects() = default;
    virtual ~Objects() = default;
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    /// Moves all objects to a time in seconds. Returns a Problem if one can't be placed. Progress counts objects; the
    /// first call is slow, as it builds all shapes.
    virtual std::optional<Problem> go_to(double time, ProgressCall progress) = 0;
    std::optional<Problem> go_to(double time) {
        return go_to(time, [](std::size_t, std::size_t) {});
    }

    /// Visits the stages of the motion from the current time to a later one. Objects and shapes don't change. Objects
    /// that don't move at all have no stages.
    virtual void each_stage(double from, double to, FunctionRef<void(const Stage<D>&)> visit) {
        static_cast<void>(from), static_cast<void>(to), static_cast<void>(visit);
    }

    /// Paths of objects that jumped or changed their shape on some stage so far.
    virtual std::vector<std::string> discontinuous() const { return {}; }

    /// Paths of objects that were not present at some time so far.
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
