#pragma once

// The objects of a level, which is static.

#include "tool/objects/objects.hpp"
#include <abut/io/level.hpp>

#include <vector>

namespace abut::tool {

class LevelObjects final : public Objects<2> {
public:
    /// Refers to the level. `solid` selects among its objects; empty: all.
    explicit LevelObjects(const Level& level, const std::vector<bool>& solid = {});

    /// Returns a Problem if an object extends out of the range of floats.
    std::optional<Problem> go_to(double time, ProgressCall progress) override;
    using Objects<2>::go_to;

    /// The level object with this index.
    const LevelObject& source(std::size_t object) const { return *sources_[object]; }

private:
    std::vector<const LevelObject*> sources_;
};

// A level has a single time, 0.
std::vector<double> key_times(const Level& level);
std::vector<double> frame_times(const Level& level, std::size_t count);

}  // namespace abut::tool
