#pragma once

// A canvas that records the drawing, for tests.

#include "../oracle/random.hpp"
#include <abut/draw/canvas.hpp>
#include <abut/shape/view/view.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {

using detail::dot;
using detail::DVec;
using detail::normalized;

template <int D>
class Recorder final : public Canvas<D> {
public:
    struct Line {
        Vec<D> a, b;
        Style style;
    };
    struct Area {
        std::vector<Vec<D>> points;
        Style style;
    };
    struct Round {
        Vec<D> center;
        float radius;
        Style style;
    };

    explicit Recorder(const Aabb<D>& shown = {Vec<D>(-10), Vec<D>(10)}) : shown_(shown) {}

    Aabb<D> shown() const override { return shown_; }
    void line(const Vec<D>& a, const Vec<D>& b, const Style& style) override { lines.push_back({a, b, style}); }
    void point(const Vec<D>& position, const Style&) override { points.push_back(position); }
    void polygon(std::span<const Vec<D>> corners, const Style& style) override {
        polygons.push_back({{corners.begin(), corners.end()}, style});
    }
    void ball(const Vec<D>& center, float radius, const Style& style) override {
        balls.push_back({center, radius, style});
    }
    void text(const Vec<D>&, std::string_view text, const Style&) override { texts.emplace_back(text); }

    std::size_t calls() const { return lines.size() + points.size() + polygons.size() + balls.size() + texts.size(); }
    /// All points of the lines and polygons.
    std::vector<Vec<D>> places() const {
        std::vector<Vec<D>> result;
        for (const Line& line : lines) result.insert(result.end(), {line.a, line.b});
        for (const Area& area : polygons) result.insert(result.end(), area.points.begin(), area.points.end());
        return result;
    }

    std::vector<Line> lines;
    std::vector<Vec<D>> points;
    std::vector<Area> polygons;
    std::vector<Round> balls;
    std::vector<std::string> texts;

private:
    Aabb<D> shown_;
};

/// The signed distance of a point to a convex set by brute force over directions d: the maximum of
///     dot(point, d) - dot(support(d), d)
/// over all d of length 1. It uses only the support function of the library.
template <int D>
double tried_distance(const detail::Convex<D>& set, const Vec<D>& point, oracle::Random& random) {
    const auto beyond = [&](const DVec<D>& d) { return dot(d, DVec<D>(point) - support(set, d)); };
    DVec<D> best = random.direction<D>();
    double most = beyond(best), step = 4;
    for (int i = 0; i < 600; ++i) {
        const bool explores = i < 100;
        if (!explores) step *= 0.96;
        const DVec<D> direction = normalized(best + random.direction<D>() * step);
        const double value = beyond(direction);
        if (value <= most) continue;
        most = value;
        best = direction;
    }
    return most;
}

/// The largest distance of the points from the surface of a convex shape; a sample of many points.
template <class S, class Places>
double farthest_from_surface(const S& shape, const Places& places) {
    const auto& set = view(shape);
    oracle::Random random(5);
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); i += 1 + places.size() / 200)
        worst = std::max(worst, std::abs(tried_distance(set, places[i], random)));
    return worst;
}

}  // namespace abut::test
