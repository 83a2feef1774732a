#pragma once

// Random plain shapes of every kind, of similar sizes, near the origin.

#include "../oracle/random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <type_traits>
#include <vector>

namespace abut {

template <int D>
using BuiltHull = std::conditional_t<D == 2, Polygon, Polyhedron>;

/// Some coordinates are exact, so that many shapes are aligned, parallel or equally far apart.
template <int D>
class DrawnShapes {
public:
    explicit DrawnShapes(oracle::Random& random) : random_(random), on_grid_(random.chance(0.3)) {}

    float number(double most) {
        const double x = random_.uniform(-most, most);
        return static_cast<float>(on_grid_ ? std::round(2 * x) / 2 : x);
    }
    float size() {
        return on_grid_ ? 0.5f + 0.5f * static_cast<float>(random_.below(3)) : random_.uniform_float(0.1, 1.5);
    }
    Vec<D> point(double most) {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = number(most);
        return result;
    }
    Vec<D> half() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = size();
        return result;
    }
    Rotation<D> rotation() { return on_grid_ && random_.chance(0.7) ? no_rotation<D> : random_.rotation<D>(); }

    bool on_grid() const { return on_grid_; }

    /// Calls visit(shape) with a shape, or with a shape at a pose.
    template <class Visit>
    void draw(const Visit& visit, const Vec<D>& about = Vec<D>(0.0f)) {
        const std::uint32_t kind = random_.below(6);
        const bool placed = random_.chance(0.5);
        const Pose<D> pose{about + point(0.5), rotation()};
        const Vec<D> shift = placed ? Vec<D>(0.0f) : about;
        const auto visit_placed = [&](const auto& shape) {
            if (placed)
                visit(at(shape, pose));
            else
                visit(shape);
        };
        constexpr double spread = D == 2 ? 1.5 : 1;
        const Vec<D> a = shift + point(spread), b = shift + point(spread), c = shift + point(spread);
        const float radius = random_.chance(0.1) ? 0 : 0.5f * size();
        switch (kind) {
            case 0:
                return visit_placed(Ball<D>{a, radius});
            case 1:
                return visit_placed(Capsule<D>{a, b, radius});
            case 2:
                return visit_placed(Segment<D>{a, b});
            case 3:
                return visit_placed(Triangle<D>{a, b, c});
            case 4: {
                const Vec<D> half_extents = half();
                return visit_placed(Box<D>{a, half_extents, rotation()});
            }
            default: {
                std::vector<Vec<D>> points(D == 2 && random_.chance(0.1) ? 60 : 2 + random_.below(9));
                for (Vec<D>& p : points) p = shift + point(spread);
                return visit_placed(*BuiltHull<D>::build(points));
            }
        }
    }

private:
    oracle::Random& random_;
    bool on_grid_;
};

}  // namespace abut
