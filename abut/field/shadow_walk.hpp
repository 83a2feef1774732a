#pragma once

// The way from a point to a light, step by step through the distances on it. For .cpp files.

#include <abut/field/field_data.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut {

/// The least slope, clearance over way, of what a cone around the way just touches: told by clearances at places that
/// are farther and farther along. All slopes are kept squared.
///
/// Over 1 / way the squared slope of a straight edge across the way is a parabola, and so is that of a plane: the one
/// through the last three places finds the least between them. It is held against the balls that the last two places
/// keep free, whose common rim is the nearest that anything can be: Aaltonen's bound, which takes everything for an
/// edge.
class LeastSlope {
public:
    void add(double way, double clearance) {
        first_ = second_;
        second_ = last_;
        const double slope = clearance / way;
        last_ = {1 / way, slope * slope, way};
        least_ = std::min(least_, last_.square);
        if (++count_ >= 3) look_between();
    }
    double least() const { return least_; }

private:
    struct Place {
        double inverse = 0, square = 0, way = 0;
    };

    void look_between() {
        // edge(u) = bend u^2 - 2 x u + 1, through the last two: nearest at the way x.
        const double here = last_.way * (last_.square - 1), before = second_.way * (second_.square - 1);
        const double across = second_.inverse - last_.inverse;
        const double bend = (before - here) / across, x = 0.5 * (bend * second_.inverse - before);
        if (!(bend > 0) || !(x > bend * last_.inverse && x < bend * second_.inverse)) return;
        const double bound = 1 - x * x / bend;

        const double rise = (last_.square - second_.square) / (last_.inverse - second_.inverse);
        const double rise_before = (second_.square - first_.square) / (second_.inverse - first_.inverse);
        const double curve = (rise - rise_before) / (last_.inverse - first_.inverse);
        if (!(curve > 0)) return;
        const double lowest = 0.5 * (second_.inverse + last_.inverse - rise / curve);
        if (!(lowest > last_.inverse && lowest < first_.inverse)) return;
        const double from = lowest - last_.inverse;
        const double square = last_.square + from * (rise + (lowest - second_.inverse) * curve);
        const double candidate = std::max(bound, square);
        if (candidate > 0) least_ = std::min(least_, candidate);
    }

    Place first_, second_, last_;
    double least_ = 1e300;
    std::uint32_t count_ = 0;
};

/// Ask the field for the distance at `place()` and tell it, as long as it goes on.
template <int D>
class ShadowWalk {
public:
    ShadowWalk() = default;
    ShadowWalk(const FieldData<D>& data, const Vec<D>& point, const Vec<D>& light) : point_(point), light_(light) {
        const DVec<D> to_light = DVec<D>(light) - DVec<D>(point);
        length_ = length(to_light);
        if (length_ > 0) direction_ = to_light / length_;
        cell_ = static_cast<double>(data.cell);
        place_ = point;
        // Within the volume a step is at least half a cell, beside it too; far from it they grow with the distance.
        left_ = 256;
        for (int i = 0; i < D; ++i) left_ += 4 * data.cells[i];
    }

    bool goes_on() const { return stage_ != Stage::done; }
    const Vec<D>& place() const { return place_; }
    /// For tests: so many places at most.
    void limit(std::uint32_t places) { left_ = places; }

    void tell(float distance) {
        const double here = static_cast<double>(distance);
        if (stage_ == Stage::at_point) {
            // What was meant to be on the surface is less than a cell within.
            if (!(here >= -cell_) || (length_ == 0 && here <= 0)) return end(true);
            if (length_ == 0) return end(false);
            stage_ = Stage::at_light;
            place_ = light_;
        } else if (stage_ == Stage::at_light) {
            if (!(here > 0)) return end(true);
            at_light_ = here / length_;
            stage_ = Stage::between;
            walk_to(cell_);
        } else {
            if (!(here > 0)) return end(true);
            slopes_.add(way_, here);
            walk_to(way_ + std::max(0.7 * here, 0.5 * cell_));
        }
    }

    float light(float softness) const {
        if (dark_) return 0;
        const double least = std::min(std::sqrt(slopes_.least()), at_light_), soft = static_cast<double>(softness);
        if (!(least < soft)) return 1;
        const double share = least / soft;
        return static_cast<float>(share * share * (3 - 2 * share));
    }

private:
    enum class Stage : std::uint8_t { at_point, at_light, between, done };

    void walk_to(double way) {
        if (way >= length_ || left_ == 0) return end(false);
        --left_;
        way_ = way;
        place_ = Vec<D>(DVec<D>(point_) + direction_ * way);
    }
    void end(bool dark) {
        dark_ = dark;
        stage_ = Stage::done;
    }

    Vec<D> point_{}, light_{}, place_{};
    DVec<D> direction_{0.0};
    double length_ = 0, cell_ = 1, way_ = 0, at_light_ = 1e150;
    LeastSlope slopes_;
    std::uint32_t left_ = 0;
    Stage stage_ = Stage::at_point;
    bool dark_ = false;
};

}  // namespace abut
