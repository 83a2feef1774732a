#pragma once

// Whether to ask the bounding balls of two shapes before the shapes themselves. It pays or not depending on the shapes
// and on how they lie, so it is measured, for each pair of types of shapes.

#include <abut/query/early_out.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {

/// When a world asks whether bounding balls meet before it asks the shapes. No answer depends on it.
enum class Pretest : std::uint8_t {
    measured,  ///< for the pairs of types of shapes for which that has been found to be faster
    always,
    never,
};

/// As far as it matters to what a test costs.
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

/// Whether to ask the balls, for each pair of types, with a sensor (only whether they touch) and without (contacts).
class Pretests {
public:
    explicit Pretests(Pretest mode = Pretest::measured) : mode_(mode) {}

    struct Entry {
        SampledTests<2> sampled;  ///< 0: the balls, 1: the shapes
        bool wanted = false;
    };

    Entry& of(ShapeType a, ShapeType b, bool sensor);

    bool asked(const Entry& entry) const {
        return mode_ == Pretest::measured ? entry.wanted : mode_ == Pretest::always;
    }
    /// Whether to measure this pair: both tests, whatever the first says. Called once a pair.
    bool due(Entry& entry) const { return mode_ == Pretest::measured && entry.sampled.due(); }
    /// `laps` of a clock: with nothing in it, of the balls, of the shapes; and what they said.
    void add(Entry& entry, const std::array<double, 3>& laps, bool balls_meet, bool shapes_touch);
    /// Makes up its mind by what was measured. Between updates, so that one update treats all alike.
    void decide();

private:
    static constexpr std::size_t types = 10;

    std::array<std::array<Entry, types*(types + 1) / 2>, 2> entries_{};
    Pretest mode_;
    bool news_ = false;  // measured since decide()
};

}  // namespace abut
