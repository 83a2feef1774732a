#pragma once

// Shared by all sides of the narrow phase: one call per frame.

#include "bench.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace abut::bench {

/// Runs a query for each pair of a frame, and advances to the next frame in the next call, cyclically: question(pair,
/// place). The place is the same in all frames and indexes caches. `scene->pairs` has the frames one after another.
template <class Scene, class Question>
Run each_pair(std::shared_ptr<const Scene> scene, Question question) {
    return [scene = std::move(scene), question = std::move(question),
            begin = std::size_t{0}](std::span<double> values) mutable {
        const auto* const pairs = scene->pairs.data() + begin;
        for (std::size_t place = 0; place < values.size(); ++place) values[place] = question(pairs[place], place);
        begin = (begin + values.size()) % scene->pairs.size();
    };
}

}  // namespace abut::bench
