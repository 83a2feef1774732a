#pragma once

// Things in space on a flat canvas, without perspective.

#include <abut/draw/canvas.hpp>

namespace abut {

/// Draws on a canvas of the plane what an eye far away sees. Nothing hides what lies behind it: what is drawn later
/// covers what was drawn before.
class Projected final : public Canvas<3> {
public:
    /// The eye is far away in the direction `towards_eye` and sees `up` upwards; of any length, not along one another.
    /// The origin of space lies at the origin of the plane, and lengths stay as they are. Refers to the flat canvas.
    Projected(Canvas<2>& flat, const Aabb3& shown, const Vec3& towards_eye, const Vec3& up);

    /// Where a point of space is drawn.
    Vec2 operator()(const Vec3& point) const;

    Aabb3 shown() const override { return shown_; }
    void line(const Vec3& a, const Vec3& b, const Style& style) override;
    void point(const Vec3& position, const Style& style) override;
    void polygon(std::span<const Vec3> points, const Style& style) override;
    void ball(const Vec3& center, float radius, const Style& style) override;
    void text(const Vec3& position, std::string_view text, const Style& style) override;

private:
    Canvas<2>& flat_;
    Aabb3 shown_;
    DVec<3> right_, up_;
};

}  // namespace abut
