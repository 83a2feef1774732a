#pragma once

// Sphere tracing of a shadow ray from a point to a light. For .cpp files.

#include <abut/field/data.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cstdint>

namespace abut::detail {

/// The slope of the narrowest cone around the ray that touches an obstacle: the minimum of clearance / distance along
/// the ray. It is computed from clearances at increasing distances. All slopes are stored squared.
///
/// As a function of 1 / distance, the squared slope of a straight edge across the ray is a parabola, and so is that of
/// a plane. A parabola through the last three samples gives the minimum between them. It is bounded below by the
/// intersection circle of the last two free balls, the nearest possible obstacle: Aaltonen's estimate, which treats
/// every obstacle as an edge.
class MinSlope {
public:
    void add(double along, double clearance) {
        first_ = second_;
        second_ = last_;
        const double slope = clearance / along;
        last_ = {1 / along, slope * slope, along};
        minimum_ = std::min(minimum_, last_.square);
        if (++count_ >= 3) interpolate();
    }
    double minimum() const { return minimum_; }

private:
    struct Place {
        double inverse = 0, square = 0, along = 0;
    };

    void interpolate() {
        // edge(u) = bend u^2 - 2 x u + 1, through the last two samples; nearest at the distance x along the ray.
        const double here = last_.along * (last_.square - 1), before = second_.along * (second_.square - 1);
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
        if (candidate > 0) minimum_ = std::min(minimum_, candidate);
    }

    Place first_, second_, last_;
    double minimum_ = 1e300;
    std::uint32_t count_ = 0;
};

/// A shadow ray as a state machine: evaluate the field at `place()` and pass the distance to `advance`, as long as it
/// is running.
template <int D>
class ShadowRay {
public:
    ShadowRay() = default;
    ShadowRay(const FieldData<D>& data, const Vec<D>& point, const Vec<D>& light) : point_(point), light_(light) {
        const DVec<D> to_light = DVec<D>(light) - DVec<D>(point);
        length_ = length(to_light);
        if (length_ > 0) direction_ = to_light / length_;
        cell_ = static_cast<double>(data.cell);
        place_ = point;
        // Steps within the volume are at least half a cell; far from it they grow with the distance.
        places_left_ = 256;
        for (int i = 0; i < D; ++i) places_left_ += 4 * data.cells[i];
    }

    bool is_running() const { return stage_ != Stage::done; }
    const Vec<D>& place() const { return place_; }
    /// For tests: the maximum number of places.
    void limit(std::uint32_t places) { places_left_ = places; }

    void advance(float distance) {
        const double here = static_cast<double>(distance);
        if (stage_ == Stage::at_point) {
            // A point at most one cell inside counts as on the surface.
            if (!(here >= -cell_) || (length_ == 0 && here <= 0)) return end(true);
            if (length_ == 0) return end(false);
            stage_ = Stage::at_light;
            place_ = light_;
        } else if (stage_ == Stage::at_light) {
            if (!(here > 0)) return end(true);
            at_light_ = here / length_;
            stage_ = Stage::between;
            move_to(cell_);
        } else {
            if (!(here > 0)) return end(true);
            slopes_.add(along_, here);
            move_to(along_ + std::max(0.7 * here, 0.5 * cell_));
        }
    }

    float light(float softness) const {
        if (dark_) return 0;
        const double minimum = std::min(square_root(slopes_.minimum()), at_light_),
                     soft = static_cast<double>(softness);
        if (!(minimum < soft)) return 1;
        const double fraction = minimum / soft;
        return static_cast<float>(fraction * fraction * (3 - 2 * fraction));
    }

private:
    enum class Stage : std::uint8_t { at_point, at_light, between, done };

    void move_to(double along) {
        if (along >= length_ || places_left_ == 0) return end(false);
        --places_left_;
        along_ = along;
        place_ = Vec<D>(DVec<D>(point_) + direction_ * along);
    }
    void end(bool dark) {
        dark_ = dark;
        stage_ = Stage::done;
    }

    Vec<D> point_{}, light_{}, place_{};
    DVec<D> direction_{0.0};
    double length_ = 0, cell_ = 1, along_ = 0, at_light_ = 1e150;
    MinSlope slopes_;
    std::uint32_t places_left_ = 0;
    Stage stage_ = Stage::at_point;
    bool dark_ = false;
};

}  // namespace abut::detail
