#pragma once

// An orthographic projection from 3D onto a 2D canvas.

#include <abut/draw/canvas.hpp>

namespace abut {

/// Draws 3D things on a 2D canvas by orthographic projection. Nothing is hidden: later drawings cover earlier ones.
class Projected final : public Canvas<3> {
public:
    /// The eye is infinitely far away in the direction `towards_eye`, with `up` upwards; both of any length but not
    /// parallel. The origin is mapped to the origin, and lengths are preserved. Refers to the 2D canvas.
    Projected(Canvas<2>& flat, const Aabb3& shown, const Vec3& towards_eye, const Vec3& up);

    /// The projection of a point.
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
    detail::DVec<3> right_, up_;
};

}  // namespace abut
