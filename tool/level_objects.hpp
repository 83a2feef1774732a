#pragma once

// The objects of a level, which doesn't move.

#include "objects.hpp"
#include <abut/io/level.hpp>

#include <vector>

namespace abut::tool {

class LevelObjects final : public Objects<2> {
public:
    /// Refers to the level.
    explicit LevelObjects(const Level& level);

    /// A Problem where an object reaches out of the range of floats.
    std::optional<Problem> go_to(double time, ProgressCall progress) override;
    using Objects<2>::go_to;

    /// Of the object with this number.
    const LevelObject& source(std::size_t object) const { return *sources_[object]; }

private:
    std::vector<const LevelObject*> sources_;
};

// The moments of a level: one.
std::vector<double> key_times(const Level& level);
std::vector<double> frame_times(const Level& level, std::size_t count);

}  // namespace abut::tool
