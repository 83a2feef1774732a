// Soft shadows and ambient occlusion from distances.

#include <abut/field/field.hpp>
#include <abut/field/shadow_ray.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {
namespace {

using detail::is_finite;

/// Number of points per batch.
constexpr std::size_t batch_size = 64;

constexpr std::size_t occlusion_samples = 5;

template <int D>
std::array<Vec<D>, occlusion_samples> places_along(const Vec<D>& point, const Vec<D>& normal, float reach) {
    std::array<Vec<D>, occlusion_samples> result;
    for (std::size_t i = 0; i < occlusion_samples; ++i) {
        const double height = static_cast<double>(reach) * static_cast<double>(i + 1) / occlusion_samples;
        result[i] = Vec<D>(detail::DVec<D>(point) + height * detail::DVec<D>(normal));
    }
    return result;
}

/// Each sample contributes the free share of its height; its weight is half that of the one before.
float occlusion_of(const float* distances, float reach) {
    double sum = 0, weights = 0, weight = 1;
    for (std::size_t i = 0; i < occlusion_samples; ++i) {
        const double height = static_cast<double>(reach) * static_cast<double>(i + 1) / occlusion_samples;
        sum += weight * std::clamp(static_cast<double>(distances[i]) / height, 0.0, 1.0);
        weights += weight;
        weight *= 0.5;
    }
    return static_cast<float>(sum / weights);
}

template <int D>
[[gnu::noinline]] float light_at(const Field<D>& field, const Vec<D>& point, const Vec<D>& light, float softness) {
    ABUT_ASSERT(is_finite<D>(point) && is_finite<D>(light) && softness >= 0);
    detail::ShadowRay<D> ray(field.data(), point, light);
    while (ray.is_running()) ray.advance(field.distance(ray.place()));
    return ray.light(softness);
}

template <int D>
[[gnu::noinline]] void write_occlusion(const Field<D>& field, std::span<const Vec<D>> points,
                                       std::span<const Vec<D>> normals, float reach, std::span<float> out) {
    ABUT_ASSERT(points.size() == out.size() && points.size() == normals.size() && reach >= 0);
    std::array<Vec<D>, batch_size * occlusion_samples> places;
    std::array<float, batch_size * occlusion_samples> found;
    for (std::size_t begin = 0; begin < points.size(); begin += batch_size) {
        const std::size_t count = std::min(batch_size, points.size() - begin);
        if (!(reach > 0)) {
            for (std::size_t i = 0; i < count; ++i) out[begin + i] = 1;
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto some = places_along<D>(points[begin + i], normals[begin + i], reach);
            std::copy(some.begin(), some.end(), places.begin() + static_cast<std::ptrdiff_t>(i * occlusion_samples));
        }
        field.distance(std::span(places).first(count * occlusion_samples),
                       std::span(found).first(count * occlusion_samples));
        for (std::size_t i = 0; i < count; ++i) out[begin + i] = occlusion_of(&found[i * occlusion_samples], reach);
    }
}

}  // namespace

template <int D>
float Field<D>::shadow(const Vec<D>& point, const Vec<D>& light, float softness) const {
    detail::enter_library();
    return light_at(*this, point, light, softness);
}

template <int D>
void Field<D>::shadow(std::span<const Vec<D>> points, const Vec<D>& light, float softness, std::span<float> out) const {
    detail::enter_library();
    ABUT_ASSERT(points.size() == out.size() && is_finite<D>(light) && softness >= 0);
    std::array<detail::ShadowRay<D>, batch_size> rays;
    std::array<std::uint32_t, batch_size> of;  // the point of each ray
    std::array<Vec<D>, batch_size> places;
    std::array<float, batch_size> found;
    std::size_t next = 0, active = 0;
    while (next < points.size() || active > 0) {
        for (; active < batch_size && next < points.size(); ++next, ++active) {
            rays[active] = detail::ShadowRay<D>(*data_, points[next], light);
            of[active] = static_cast<std::uint32_t>(next);
        }
        for (std::size_t i = 0; i < active; ++i) places[i] = rays[i].place();
        distance(std::span(places).first(active), std::span(found).first(active));
        std::size_t running = 0;
        for (std::size_t i = 0; i < active; ++i) {
            rays[i].advance(found[i]);
            if (rays[i].is_running()) {
                if (running != i) rays[running] = rays[i];
                of[running++] = of[i];
            } else {
                out[of[i]] = rays[i].light(softness);
            }
        }
        active = running;
    }
}

template <int D>
float Field<D>::ambient_occlusion(const Vec<D>& point, const Vec<D>& normal, float reach) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite<D>(point) && is_finite<D>(normal) && reach >= 0);
    if (!(reach > 0)) return 1;
    const std::array<Vec<D>, occlusion_samples> places = places_along<D>(point, normal, reach);
    std::array<float, occlusion_samples> found;
    for (std::size_t i = 0; i < occlusion_samples; ++i) found[i] = distance(places[i]);
    return occlusion_of(found.data(), reach);
}

template <int D>
void Field<D>::ambient_occlusion(std::span<const Vec<D>> points, std::span<const Vec<D>> normals, float reach,
                                 std::span<float> out) const {
    detail::enter_library();
    write_occlusion(*this, points, normals, reach, out);
}

template float Field<2>::shadow(const Vec2&, const Vec2&, float) const;
template float Field<3>::shadow(const Vec3&, const Vec3&, float) const;
template void Field<2>::shadow(std::span<const Vec2>, const Vec2&, float, std::span<float>) const;
template void Field<3>::shadow(std::span<const Vec3>, const Vec3&, float, std::span<float>) const;
template float Field<2>::ambient_occlusion(const Vec2&, const Vec2&, float) const;
template float Field<3>::ambient_occlusion(const Vec3&, const Vec3&, float) const;
template void Field<2>::ambient_occlusion(std::span<const Vec2>, std::span<const Vec2>, float, std::span<float>) const;
template void Field<3>::ambient_occlusion(std::span<const Vec3>, std::span<const Vec3>, float, std::span<float>) const;

}  // namespace abut
