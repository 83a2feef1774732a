#pragma once

// A small physics engine on abut: a World finds the contacts, and sequential impulses (Catto, "Iterative Dynamics with
// Temporal Coherence", 2005) keep the bodies apart. Impulses are stored by the features of the contact points, so that
// each step starts from the last one's (warm starting).

#include <abut/world/world.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace abut::scenes {

template <int D>
using Real = glm::vec<D, double>;

// A spin is a number in the plane and a vector in space. turn(r, d) is the moment of d at r.
template <int D>
using Spin = std::conditional_t<D == 2, double, Real<3>>;
inline double turn(const Real<2>& r, const Real<2>& d) {
    return r.x * d.y - r.y * d.x;
}
inline Real<3> turn(const Real<3>& r, const Real<3>& d) {
    return glm::cross(r, d);
}
inline Real<2> velocity_at(double spin, const Real<2>& r) {
    return {-spin * r.y, spin * r.x};
}
inline Real<3> velocity_at(const Real<3>& spin, const Real<3>& r) {
    return glm::cross(spin, r);
}
inline double product(double a, double b) {
    return a * b;
}
inline double product(const Real<3>& a, const Real<3>& b) {
    return glm::dot(a, b);
}

/// A unit vector in the plane.
template <int D>
using DoubleRotation = std::conditional_t<D == 2, glm::dvec2, glm::dquat>;

inline glm::dvec2 turned(const glm::dvec2& turn, double angle) {
    return glm::normalize(turn + angle * glm::dvec2(-turn.y, turn.x));
}
inline glm::dquat turned(const glm::dquat& turn, const Real<3>& angle) {
    return glm::normalize(turn + 0.5 * (glm::dquat(0, angle) * turn));
}

/// A box of density 1; its position and rotation are in double, finer than those of the world. A body without mass
/// stands still.
template <int D>
struct Body {
    Id id{};
    Real<D> position{0.0}, velocity{0.0};
    DoubleRotation<D> rotation{};
    Spin<D> spin{};
    double inverse_mass = 0;
    Real<D> half{0.0};

    Spin<D> inverse_inertia_times(const Spin<D>& moment) const {
        if (inverse_mass == 0) return Spin<D>{};
        if constexpr (D == 2) {
            return moment * (3 * inverse_mass / glm::dot(half, half));
        } else {
            const Real<3> local = glm::conjugate(rotation) * moment, sides = half * half;
            const Real<3> inertia(sides.y + sides.z, sides.x + sides.z, sides.x + sides.y);
            return rotation * (local * (3 * inverse_mass / inertia));
        }
    }
    void push(const Real<D>& impulse, const Real<D>& at) {
        velocity += impulse * inverse_mass;
        spin += inverse_inertia_times(turn(at, impulse));
    }
    Pose<D> pose() const {
        if constexpr (D == 2)
            return {Vec<2>(position), {static_cast<float>(rotation.x), static_cast<float>(rotation.y)}};
        else
            return {Vec<3>(position), glm::quat(rotation)};
    }
};

/// Bodies under gravity, along -y, in a world with a level.
template <int D>
class SmallPhysics {
public:
    static constexpr double friction = 0.6, gravity = 10, slop = 0.005, fastest_push = 3, damping = 0.1;
    static constexpr int iterations = 8;

    World<D> world;

    /// Adds a part of the level.
    template <class S>
    void add_fixed(const S& shape, const Pose<D>& pose) {
        world.add(shape, {.pose = pose, .fixed = true});
    }
    void add_box(const Real<D>& position, const DoubleRotation<D>& rotation, const Vec<D>& half) {
        Body<D> body;
        body.position = position;
        body.rotation = rotation;
        body.half = Real<D>(half);
        double mass = 1;
        for (int i = 0; i < D; ++i) mass *= 2 * body.half[i];
        body.inverse_mass = 1 / mass;
        body.id = world.add(Box<D>{Vec<D>(0.0f), half}, {.pose = body.pose(), .user = bodies_.size()});
        bodies_.push_back(body);
    }

    void set_velocity(std::size_t body, const Real<D>& velocity) { bodies_[body + 1].velocity = velocity; }

    void step(double seconds) {
        world.update();
        begin_points();
        for (Body<D>& body : std::span(bodies_).subspan(1)) {
            body.velocity *= 1 - damping * seconds;
            body.spin *= 1 - damping * seconds;
            body.velocity.y -= gravity * seconds;
        }
        for (const Point& point : points_) push(point, point.total);
        solve(push_out(seconds));
        for (Body<D>& body : std::span(bodies_).subspan(1)) {
            body.position += body.velocity * seconds;
            body.rotation = turned(body.rotation, body.spin * seconds);
            world.move(body.id, body.pose());
        }
        solve({});
    }

    std::span<const Body<D>> bodies() const { return std::span(bodies_).subspan(1); }
    /// The contact points of the last step, and how many of them were there in the step before.
    std::size_t points() const { return points_.size(); }
    std::size_t persistent_points() const { return persistent_points_; }
    /// The root mean square of the velocities of the bodies.
    double speed() const {
        double sum = 0;
        for (const Body<D>& body : bodies()) sum += glm::dot(body.velocity, body.velocity);
        return std::sqrt(sum / static_cast<double>(bodies().size()));
    }

private:
    /// A contact point. The impulses act on b; their axes are the normal and D - 1 tangents.
    struct Point {
        Body<D>*a, *b;
        Real<D> at_a, at_b;
        std::array<Real<D>, D> axes;
        std::array<double, D> mass, total{};
        double depth;
    };
    /// How much of a depth is pushed out in a second, and how soft a spring is.
    struct Softness {
        double rate = 0, mass_share = 1, impulse_share = 0;
    };
    using Key = std::tuple<Id, Id, std::uint32_t>;

    Body<D>& body_of(Id id) { return world.is_fixed(id) ? bodies_[0] : bodies_[world.user(id)]; }

    void begin_points() {
        std::map<Key, std::array<double, D>> last;
        for (std::size_t i = 0; i < points_.size(); ++i) last.emplace(keys_[i], points_[i].total);
        points_.clear();
        keys_.clear();
        persistent_points_ = 0;
        for (const WorldContact<D>& touch : world.contacts())
            for (const ContactPoint<D>& point : touch.contact.points) {
                Point& added = points_.emplace_back();
                added.a = &body_of(touch.a);
                added.b = &body_of(touch.b);
                added.at_a = Real<D>(point.position) - added.a->position;
                added.at_b = Real<D>(point.position) - added.b->position;
                added.depth = static_cast<double>(point.depth);
                set_axes(Real<D>(touch.contact.normal), added);
                keys_.emplace_back(touch.a, touch.b, point.feature);
                const auto found = last.find(keys_.back());
                if (found == last.end()) continue;
                ++persistent_points_;
                added.total = found->second;
                last.erase(found);
            }
    }
    void set_axes(const Real<D>& normal, Point& point) {
        point.axes[0] = glm::normalize(normal);
        if constexpr (D == 2) {
            point.axes[1] = {-normal.y, normal.x};
        } else {
            const Real<3> side = std::abs(normal.x) < 0.6 ? Real<3>(1, 0, 0) : Real<3>(0, 0, 1);
            point.axes[1] = glm::normalize(glm::cross(point.axes[0], side));
            point.axes[2] = glm::cross(point.axes[0], point.axes[1]);
        }
        for (std::size_t i = 0; i < D; ++i) {
            const Spin<D> moment_a = turn(point.at_a, point.axes[i]), moment_b = turn(point.at_b, point.axes[i]);
            point.mass[i] = 1 / (point.a->inverse_mass + point.b->inverse_mass +
                                 product(moment_a, point.a->inverse_inertia_times(moment_a)) +
                                 product(moment_b, point.b->inverse_inertia_times(moment_b)));
        }
    }

    void push(const Point& point, const std::array<double, D>& impulses) {
        Real<D> sum(0.0);
        for (std::size_t i = 0; i < D; ++i) sum += point.axes[i] * impulses[i];
        point.a->push(-sum, point.at_a);
        point.b->push(sum, point.at_b);
    }
    Real<D> relative_velocity(const Point& point) const {
        return point.b->velocity + velocity_at(point.b->spin, point.at_b) - point.a->velocity -
               velocity_at(point.a->spin, point.at_a);
    }
    void solve_friction(Point& point) {
        const Real<D> velocity = relative_velocity(point);
        std::array<double, D> wanted = point.total, change{};
        double length_squared = 0;
        for (std::size_t i = 1; i < D; ++i) {
            wanted[i] -= point.mass[i] * glm::dot(velocity, point.axes[i]);
            length_squared += wanted[i] * wanted[i];
        }
        const double most = friction * point.total[0], length = std::sqrt(length_squared);
        for (std::size_t i = 1; i < D; ++i) {
            const double limited = length > most ? wanted[i] * (most / length) : wanted[i];
            change[i] = limited - point.total[i];
            point.total[i] = limited;
        }
        push(point, change);
    }
    /// A contact is a damped spring as stiff as the step allows.
    static Softness push_out(double seconds) {
        const double turns = 2 * 3.141592653589793 * 0.125 / seconds, ratio = 10;
        const double first = 2 * ratio + seconds * turns, second = seconds * turns * first;
        return {turns / first, second / (1 + second), 1 / (1 + second)};
    }
    void solve_normal(Point& point, const Softness& softness) {
        const double before = point.total[0], deep = std::max(0.0, point.depth - slop);
        const double wanted = std::min(softness.rate * deep, fastest_push);
        const double velocity = glm::dot(relative_velocity(point), point.axes[0]);
        const double change =
            point.mass[0] * softness.mass_share * (wanted - velocity) - softness.impulse_share * before;
        point.total[0] = std::max(0.0, before + change);
        push(point, std::array<double, D>{point.total[0] - before});
    }
    void solve(const Softness& softness) {
        for (int i = 0; i < iterations; ++i)
            for (Point& point : points_) {
                solve_friction(point);
                solve_normal(point, softness);
            }
    }

    std::vector<Body<D>> bodies_ = std::vector<Body<D>>(1);  // the first one stands for all that is fixed
    std::vector<Point> points_;
    std::vector<Key> keys_;
    std::size_t persistent_points_ = 0;
};

}  // namespace abut::scenes
