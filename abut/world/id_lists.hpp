#pragma once

// The answers of many questions for items, one after another in one list.

#include <abut/world/id.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

namespace detail {

template <int D>
class WorldBatches;

}  // namespace detail

/// A list of ids for each question of a batch. Used again, it allocates nothing for answers of a size that it has seen.
class IdLists {
public:
    /// The number of questions.
    std::size_t size() const { return ends_.size(); }
    /// The answer of a question, sorted; valid until the next batch.
    std::span<const Id> operator[](std::size_t question) const {
        return {ids_.data() + begin(question), ids_.data() + ends_[question]};
    }
    /// The answers of all questions, one after another.
    std::span<const Id> all() const { return ids_; }

private:
    template <int D>
    friend class detail::WorldBatches;

    std::size_t begin(std::size_t question) const { return question == 0 ? 0 : ends_[question - 1]; }

    std::vector<Id> ids_;
    std::vector<std::size_t> ends_;          // of each question's answer in ids_
    std::vector<std::vector<Id>> part_ids_;  // of each part of the questions, if they are not answered in their order
};

}  // namespace abut
