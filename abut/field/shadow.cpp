// Light and surroundings, told by distances alone.

#include <abut/field/field.hpp>
#include <abut/field/shadow_walk.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {
namespace {

/// So many at once are looked up together.
constexpr std::size_t at_once = 64;

constexpr std::size_t occlusion_places = 5;

template <int D>
std::array<Vec<D>, occlusion_places> places_along(const Vec<D>& point, const Vec<D>& normal, float reach) {
    std::array<Vec<D>, occlusion_places> result;
    for (std::size_t i = 0; i < occlusion_places; ++i) {
        const double way = static_cast<double>(reach) * static_cast<double>(i + 1) / occlusion_places;
        result[i] = Vec<D>(DVec<D>(point) + way * DVec<D>(normal));
    }
    return result;
}

/// Each place says which share of its height is free, and counts half as much as the one before it.
float occlusion_of(const float* distances, float reach) {
    double sum = 0, weights = 0, weight = 1;
    for (std::size_t i = 0; i < occlusion_places; ++i) {
        const double way = static_cast<double>(reach) * static_cast<double>(i + 1) / occlusion_places;
        sum += weight * std::clamp(static_cast<double>(distances[i]) / way, 0.0, 1.0);
        weights += weight;
        weight *= 0.5;
    }
    return static_cast<float>(sum / weights);
}

}  // namespace

template <int D>
float Field<D>::shadow(const Vec<D>& point, const Vec<D>& light, float softness) const {
    ABUT_ASSERT(is_finite<D>(point) && is_finite<D>(light) && softness >= 0);
    ShadowWalk<D> walk(*data_, point, light);
    while (walk.goes_on()) walk.tell(distance(walk.place()));
    return walk.light(softness);
}

template <int D>
void Field<D>::shadow(std::span<const Vec<D>> points, const Vec<D>& light, float softness, std::span<float> out) const {
    ABUT_ASSERT(points.size() == out.size() && is_finite<D>(light) && softness >= 0);
    std::array<ShadowWalk<D>, at_once> walks;
    std::array<std::uint32_t, at_once> of;  // whose walk it is
    std::array<Vec<D>, at_once> places;
    std::array<float, at_once> found;
    std::size_t next = 0, walking = 0;
    while (next < points.size() || walking > 0) {
        for (; walking < at_once && next < points.size(); ++next, ++walking) {
            walks[walking] = ShadowWalk<D>(*data_, points[next], light);
            of[walking] = static_cast<std::uint32_t>(next);
        }
        for (std::size_t i = 0; i < walking; ++i) places[i] = walks[i].place();
        distance(std::span(places).first(walking), std::span(found).first(walking));
        std::size_t kept = 0;
        for (std::size_t i = 0; i < walking; ++i) {
            walks[i].tell(found[i]);
            if (walks[i].goes_on()) {
                if (kept != i) walks[kept] = walks[i];
                of[kept++] = of[i];
            } else {
                out[of[i]] = walks[i].light(softness);
            }
        }
        walking = kept;
    }
}

template <int D>
float Field<D>::ambient_occlusion(const Vec<D>& point, const Vec<D>& normal, float reach) const {
    ABUT_ASSERT(is_finite<D>(point) && is_finite<D>(normal) && reach >= 0);
    if (!(reach > 0)) return 1;
    const std::array<Vec<D>, occlusion_places> places = places_along<D>(point, normal, reach);
    std::array<float, occlusion_places> found;
    for (std::size_t i = 0; i < occlusion_places; ++i) found[i] = distance(places[i]);
    return occlusion_of(found.data(), reach);
}

template <int D>
void Field<D>::ambient_occlusion(std::span<const Vec<D>> points, std::span<const Vec<D>> normals, float reach,
                                 std::span<float> out) const {
    ABUT_ASSERT(points.size() == out.size() && points.size() == normals.size() && reach >= 0);
    std::array<Vec<D>, at_once * occlusion_places> places;
    std::array<float, at_once * occlusion_places> found;
    for (std::size_t begin = 0; begin < points.size(); begin += at_once) {
        const std::size_t count = std::min(at_once, points.size() - begin);
        if (!(reach > 0)) {
            for (std::size_t i = 0; i < count; ++i) out[begin + i] = 1;
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto some = places_along<D>(points[begin + i], normals[begin + i], reach);
            std::copy(some.begin(), some.end(), places.begin() + static_cast<std::ptrdiff_t>(i * occlusion_places));
        }
        distance(std::span(places).first(count * occlusion_places), std::span(found).first(count * occlusion_places));
        for (std::size_t i = 0; i < count; ++i) out[begin + i] = occlusion_of(&found[i * occlusion_places], reach);
    }
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
