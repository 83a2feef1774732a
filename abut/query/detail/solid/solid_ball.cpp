// The signed distance of the centre changes by no more than the centre moves. So no move is shorter than the radius
// minus that distance, and a step of this length along any direction never leads past a place where the ball is free
// (sphere tracing). The direction to the nearest point of the surface reaches the bound wherever the surface is not too
// concave.

#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/query/detail/solid/solid_ball.hpp>
#include <abut/shape/ball.hpp>

#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

class BallSearch {
public:
    BallSearch(const View<3>& solid, const View<3>& ball) : surface_(surface_view(solid)), solid_(solid) {
        const auto& convex = std::get<Convex<3>>(ball);
        center_ = convex.place.point(DVec<3>(convex.vertices()[0]));
        radius_ = convex.radius + convex.inner_radius * convex.scale;
        tolerance_ = 1e-6 * (length(DVec<3>(solid_.box().max) - DVec<3>(solid_.box().min)) + radius_);
    }

    bool find(Closest<3>& closest) {
        const Place start = place_at(center_);
        if (start.distance >= radius_) return false;
        limit_ = std::numeric_limits<double>::infinity();
        best_normal_ = start.normal;
        const double least = radius_ - start.distance;
        trace(start.normal, least);
        if (limit_ > least + tolerance_) {
            for (int i = 0; i < 3; ++i)
                for (const double sign : {1.0, -1.0}) trace(axis<3>(i, sign), least);
            trace_normals(least);
        }
        if (!(limit_ < std::numeric_limits<double>::infinity())) limit_ = least;
        closest.distance = static_cast<float>(-limit_);
        closest.normal = to_float(best_normal_);
        closest.on_b = to_float(center_ - best_normal_ * radius_);
        closest.on_a = to_float(center_ + best_normal_ * (limit_ - radius_));
        closest.feature_a = start.feature;
        closest.feature_b = {};
        return true;
    }

private:
    struct Place {
        double distance = 0;  ///< of the centre from the surface, negative inside
        DVec<3> normal{0.0};  ///< the direction in which it grows
        Feature feature;
    };

    Place place_at(const DVec<3>& center) const {
        const Closest<3> nearest = closest(surface_, Ball<3>{to_float(center), 0});
        const bool inside = solid_.side_of(DVec<3>(to_float(center))) == PointSide::inside;
        const double distance = std::abs(static_cast<double>(nearest.distance)), sign = inside ? -1 : 1;
        return {sign * distance, DVec<3>(nearest.normal) * sign, nearest.feature_a};
    }

    /// Moves the ball along a direction until it is free, if that is better than the best.
    void trace(const DVec<3>& direction, double first) {
        double moved = first;
        for (int i = 0; i < max_steps && moved < limit_; ++i) {
            const double missing = radius_ - place_at(center_ + direction * moved).distance;
            if (missing <= tolerance_) {
                limit_ = moved;
                best_normal_ = direction;
                return;
            }
            moved += missing;
        }
    }

    /// Tries the normals of the triangles around the ball.
    void trace_normals(double least) {
        Aabb3 box;
        for (int i = 0; i < 3; ++i) {
            box.min[i] = static_cast<float>(center_[i] - 2 * least - radius_);
            box.max[i] = static_cast<float>(center_[i] + 2 * least + radius_);
        }
        int count = 0;
        solid_.each_triangle(box, [&](std::uint32_t index) {
            const Corners t = solid_.corners(index);
            trace(normalized<3>(cross(t[1] - t[0], t[2] - t[0])), least);
            return ++count < max_normals;
        });
    }

    static constexpr int max_steps = 64, max_normals = 64;

    View<3> surface_;
    PlacedSolid solid_;
    DVec<3> center_{0.0}, best_normal_{0.0};
    double radius_ = 0, tolerance_ = 0, limit_ = 0;
};

}  // namespace

bool is_ball(const View<3>& shape) {
    const auto* convex = std::get_if<Convex<3>>(&shape);
    return convex != nullptr && convex->core == Core::points && convex->count == 1 &&
           (convex->similar || convex->inner_radius == 0);
}

bool find_ball_depth(const View<3>& solid, const View<3>& ball, Closest<3>& closest) {
    return BallSearch(solid, ball).find(closest);
}

}  // namespace abut::detail
