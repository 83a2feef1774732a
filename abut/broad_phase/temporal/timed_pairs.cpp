#include <abut/broad_phase/detail/float4-inl.h>
#include <abut/broad_phase/temporal/timed_pairs.hpp>

#include <algorithm>

namespace abut::detail {

void TimedPairs::add(const ItemPair& pair, const Look& look) {
    const std::size_t index = pairs_.size();
    if (index % block == 0) {
        due_.resize(index + block, never);
        next_.push_back(never);
        touching_.push_back(0);
    }
    pairs_.push_back(pair);
    set(index, pair, look);
    next_[index / block] = std::min(next_[index / block], look.due);
}

void TimedPairs::shrink(std::size_t count) {
    const std::size_t blocks = (count + block - 1) / block;
    pairs_.resize(count);
    due_.resize(blocks * block);
    std::fill(due_.begin() + static_cast<std::ptrdiff_t>(count), due_.end(), never);
    next_.resize(blocks);
    touching_.resize(blocks);
    if (count % block != 0) touching_.back() &= (std::uint64_t{1} << count % block) - 1;
    for (std::size_t k = 0; k < blocks; ++k) next_[k] = earliest_in(k);
}

std::uint64_t TimedPairs::due_in(std::size_t k, float now) const {
    const float4::Floats limit = float4::broadcast(now);
    std::uint64_t due = 0;
    for (std::size_t i = 0; i < block; i += 4)
        due |= std::uint64_t{float4::bits(float4::load(due_.data() + k * block + i) <= limit)} << i;
    return due;
}

float TimedPairs::earliest_in(std::size_t k) const {
    float4::Floats least = float4::broadcast(never);
    for (std::size_t i = 0; i < block; i += 4) least = float4::min(float4::load(due_.data() + k * block + i), least);
    return float4::min_lane(least);
}

bool TimedPairs::add_touching(std::size_t k, PairBuffer& out) const {
    for (std::uint64_t touching = touching_[k]; touching != 0; touching &= touching - 1) {
        const ItemPair& pair = pairs_[k * block + static_cast<std::size_t>(std::countr_zero(touching))];
        if (!out.add(pair.first, pair.second)) return false;
    }
    return true;
}

}  // namespace abut::detail
