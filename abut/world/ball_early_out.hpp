#pragma once

// The early out by bounding balls: whether to test the balls of two shapes before the shapes. Whether it pays depends
// on the shapes and on the scene, so it is measured for each pair of shape types.

#include <abut/query/early_out.hpp>
#include <abut/shape/view/view.hpp>

#include <algorithm>

namespace abut {

/// When a world tests bounding balls before the shapes. No answer depends on it.
enum class BallEarlyOut : std::uint8_t {
    measured,  ///< for those pairs of shape types for which it is measured to be faster
    always,
    never,
};

}  // namespace abut

namespace abut::detail {

/// The type of a shape, as fine as the cost of a test depends on it.
enum class ShapeType : std::uint8_t {
    ball,
    segment,
    triangle,
    points,
    box,
    discs,
    function,
    half_space,
    composite,
    distance
};

template <int D>
ShapeType shape_type(const View<D>& view);

/// Decides whether the balls are tested first: for each pair of types, with a sensor (overlap only) and without
/// (contact).
class BallEarlyOuts {
public:
    explicit BallEarlyOuts(BallEarlyOut mode = BallEarlyOut::measured) : mode_(mode) {
        for (auto& entries : entries_)
            for (Entry& entry : entries) entry.is_used = mode == BallEarlyOut::always;
    }

    struct Entry {
        SampledTests<2> sampled;  ///< 0: the balls, 1: the shapes
        bool is_used = false;     ///< if measured, whether the early out costs less than it saves
    };

    Entry& entry(ShapeType a, ShapeType b, bool sensor) {
        const auto low = static_cast<std::size_t>(std::min(a, b)), high = static_cast<std::size_t>(std::max(a, b));
        return entries_[sensor ? 1 : 0][high * (high + 1) / 2 + low];
    }

    /// Whether to measure this pair, which runs both tests regardless of their results. Call it once for each pair.
    bool due(Entry& entry) const { return mode_ == BallEarlyOut::measured && entry.sampled.due(); }
    /// Adds the times, in nanoseconds, of an empty measurement, of the balls' test and of the shapes' test, and the
    /// results of the tests.
    void add_sample(Entry& entry, const std::array<double, 3>& nanoseconds, bool balls_overlap, bool shapes_overlap);
    /// Decides by the samples. Call it between updates, so that an update treats all pairs alike.
    void decide();

private:
    static constexpr std::size_t types = 10;

    std::array<std::array<Entry, types*(types + 1) / 2>, 2> entries_{};
    BallEarlyOut mode_;
    bool has_new_samples_ = false;  // since the last decide()
};

}  // namespace abut::detail
