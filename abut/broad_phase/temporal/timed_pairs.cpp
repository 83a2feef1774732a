#include <abut/broad_phase/detail/float4-inl.h>
#include <abut/broad_phase/temporal/timed_pairs.hpp>

#include <algorithm>
#include <bit>

namespace abut::detail {
namespace {

float earliest_in(const float* due) {
    float4::Floats least = float4::load(due);
    for (std::size_t i = 4; i < TimedPairs::block; i += 4) least = float4::min(float4::load(due + i), least);
    return float4::min_lane(least);
}

}  // namespace

void TimedPairs::clear() {
    pairs_.clear();
    due_.clear();
    next_.clear();
    touching_.clear();
}

void TimedPairs::add(ItemPair pair, Look look) {
    const std::size_t index = pairs_.size();
    pairs_.push_back(pair);
    if (index % block == 0) {
        due_.resize(index + block, never);
        next_.push_back(never);
        touching_.push_back(0);
    }
    due_[index] = look.due;
    next_[index / block] = std::min(next_[index / block], look.due);
    touching_[index / block] |= std::uint64_t{look.touching} << index % block;
}

std::size_t TimedPairs::collect_due(float now, std::size_t& next_block, std::uint32_t* out) const {
    const float4::Floats limit = float4::broadcast(now);
    std::size_t count = 0, k = next_block;
    for (; k < next_.size() && count + block <= at_once; ++k) {
        if (next_[k] > now) continue;
        std::uint64_t due = 0;
        for (std::size_t i = 0; i < block; i += 4)
            due |= std::uint64_t{float4::bits(float4::load(due_.data() + k * block + i) <= limit)} << i;
        for (; due != 0; due &= due - 1)
            out[count++] = static_cast<std::uint32_t>(k * block + static_cast<std::size_t>(std::countr_zero(due)));
    }
    next_block = k;
    return count;
}

void TimedPairs::renew_next(float now, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
        if (next_[k] <= now) next_[k] = earliest_in(due_.data() + k * block);
}

void TimedPairs::shrink(std::size_t count) {
    const std::size_t whole = (count + block - 1) / block;
    pairs_.resize(count);
    due_.resize(whole * block);
    std::fill(due_.begin() + static_cast<std::ptrdiff_t>(count), due_.end(), never);
    next_.resize(whole);
    touching_.resize(whole);
    if (count % block != 0) touching_.back() &= (std::uint64_t{1} << count % block) - 1;
    for (std::size_t k = 0; k < whole; ++k) next_[k] = earliest_in(due_.data() + k * block);
}

bool TimedPairs::add_touching(std::size_t begin, std::size_t end, PairBuffer& out) const {
    for (std::size_t k = begin; k < end; ++k) {
        for (std::uint64_t touching = touching_[k]; touching != 0; touching &= touching - 1) {
            const ItemPair& pair = pairs_[k * block + static_cast<std::size_t>(std::countr_zero(touching))];
            if (!out.add(pair.first, pair.second)) return false;
        }
    }
    return true;
}

}  // namespace abut::detail
