#pragma once

// The shapes that no item of a world has any more, but that its snapshots refer to.

#include <abut/shape/any_shape.hpp>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut::detail {

/// The last shapes that were added, up to a limit, by their hashes.
template <int D>
class ReleasedShapes {
public:
    explicit ReleasedShapes(std::size_t limit) : limit_(limit) {}

    void add(std::uint64_t hash, const AnyShape<D>& shape) {
        if (limit_ == 0 || !shapes_.emplace(hash, shape).second) return;
        if (hashes_.size() < limit_) return hashes_.push_back(hash);
        shapes_.erase(hashes_[oldest_]);
        hashes_[oldest_] = hash;
        oldest_ = (oldest_ + 1) % limit_;
    }
    /// Null if there is none with this hash.
    const AnyShape<D>* find(std::uint64_t hash) const {
        const auto found = shapes_.find(hash);
        return found != shapes_.end() ? &found->second : nullptr;
    }

private:
    std::size_t limit_;
    std::unordered_map<std::uint64_t, AnyShape<D>> shapes_;
    std::vector<std::uint64_t> hashes_;
    std::size_t oldest_ = 0;  // the index of the oldest hash once there are limit_ of them
};

}  // namespace abut::detail
