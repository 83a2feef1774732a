#pragma once

// The library's answers as those of the C API. For .cpp files.

#include <abut/c/detail/handles.hpp>

#include <optional>

namespace abut::detail {

template <int D>
typename CTypes<D>::Vec to_c(const Vec<D>& v) {
    return same_bytes<typename CTypes<D>::Vec>(v);
}
inline abut_feature to_c(const Feature& feature) {
    return {feature.part, feature.index, static_cast<std::uint32_t>(feature.kind)};
}
inline abut_id to_c(const Id& id) {
    return {id.index, id.generation};
}

template <int D>
typename CTypes<D>::Closest to_c(const Closest<D>& closest) {
    return {closest.distance,      to_c<D>(closest.normal), to_c<D>(closest.on_a),
            to_c<D>(closest.on_b), to_c(closest.feature_a), to_c(closest.feature_b)};
}

template <int D>
typename CTypes<D>::Contact to_c(const Contact<D>& contact) {
    typename CTypes<D>::Contact result{};
    if (!contact) return result;
    result.normal = to_c<D>(contact.normal);
    result.depth = contact.depth;
    for (const ContactPoint<D>& point : contact.points)
        result.points[result.count++] = {to_c<D>(point.position), point.depth, point.feature};
    result.feature_a = to_c(contact.feature_a);
    result.feature_b = to_c(contact.feature_b);
    return result;
}

template <int D>
typename CTypes<D>::Hit to_c(const Hit<D>& hit) {
    return {1,
            hit.fraction,
            hit.distance,
            to_c<D>(hit.point),
            to_c<D>(hit.normal),
            hit.started_inside ? 1u : 0u,
            to_c(hit.feature)};
}
template <int D>
typename CTypes<D>::Hit to_c(const std::optional<Hit<D>>& hit) {
    return hit ? to_c(*hit) : typename CTypes<D>::Hit{};
}

template <int D>
typename CTypes<D>::WorldHit to_c(const WorldHit<D>& hit) {
    return {to_c(hit.id), to_c(hit.hit)};
}
template <int D>
typename CTypes<D>::WorldHit to_c(const std::optional<WorldHit<D>>& hit) {
    return hit ? to_c(*hit) : typename CTypes<D>::WorldHit{};
}
template <int D>
typename CTypes<D>::WorldClosest to_c(const WorldClosest<D>& closest) {
    return {to_c(closest.id), to_c(closest.closest)};
}
template <int D>
typename CTypes<D>::WorldClosest to_c(const std::optional<WorldClosest<D>>& closest) {
    return closest ? to_c(*closest) : typename CTypes<D>::WorldClosest{};
}
template <int D>
typename CTypes<D>::WorldContact to_c(const WorldContact<D>& contact) {
    return {to_c(contact.a), to_c(contact.b), to_c(contact.contact)};
}
template <int D>
typename CTypes<D>::WorldImpact to_c(const WorldImpact<D>& impact) {
    return {to_c(impact.a), to_c(impact.b), to_c(impact.hit)};
}

inline Feature from_c(const abut_feature& feature) {
    return {feature.part, feature.index, static_cast<FeatureKind>(feature.kind)};
}
inline Id from_c(const abut_id& id) {
    return {id.index, id.generation};
}
template <int D>
QueryOptions<D> from_c(const abut_query_options* options) {
    QueryOptions<D> result;
    if (options == nullptr) return result;
    result.margin = options->margin;
    result.back_faces = options->back_faces != 0;
    return result;
}
inline Fault valid(const abut_query_options* options) {
    return options == nullptr ? Fault() : not_below_zero(options->margin, "options->margin");
}

}  // namespace abut::detail
