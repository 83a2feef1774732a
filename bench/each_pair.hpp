#pragma once

// One call, one frame: what the sides of the narrow phase have in common.

#include "bench.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace abut::bench {

/// Asks the question of each pair of a frame, and of those of the next frame in the next call, for ever:
/// question(pair, place), where the place is the same in all frames, and the caches of a question are kept by it.
/// `scene->pairs` has the frames one after another.
template <class Scene, class Question>
Ask each_pair(std::shared_ptr<const Scene> scene, Question question) {
    return [scene = std::move(scene), question = std::move(question),
            begin = std::size_t{0}](std::span<double> values) mutable {
        const auto* const pairs = scene->pairs.data() + begin;
        for (std::size_t place = 0; place < values.size(); ++place) values[place] = question(pairs[place], place);
        begin = (begin + values.size()) % scene->pairs.size();
    };
}

}  // namespace abut::bench
