// The steps of the engines, and the distance of moving shapes.

#include "trace.h"

#include "json.hpp"
#include <abut/query/detail/sweep/rotating.hpp>

using namespace abut::detail;
using abut::play::Json;

namespace {

template <int D>
void write(Json& json, const abut::GjkStep<D>& step) {
    json.key("kind").string("gjk").key("points").template vecs<D>(std::span(step.points).first(step.count));
    json.key("closest").template vec<D>(step.closest);
}
template <int D>
void write(Json& json, const abut::PenetrationStep<D>& step) {
    json.key("kind").string("penetration").key("points").template vecs<D>(step.points);
    json.key("normal").template vec<D>(step.normal);
    json.key("distance").number(step.distance).key("extent").number(step.extent);
}
template <int D>
void write(Json& json, const abut::AxisStep<D>& step) {
    json.key("kind").string("axis").key("axis").template vec<D>(step.axis);
    json.key("min_a").number(step.min_a).key("max_a").number(step.max_a);
    json.key("min_b").number(step.min_b).key("max_b").number(step.max_b);
}
template <int D>
void write(Json& json, const abut::ClipStep<D>& step) {
    json.key("kind").string("clip").key("normal").template vec<D>(step.normal).key("offset").number(step.offset);
    json.key("points").template vecs<D>(step.points);
}
template <int D>
void write(Json& json, const abut::SweepStep<D>& step) {
    json.key("kind").string("sweep").key("position").template vec<D>(step.position);
    json.key("normal").template vec<D>(step.normal).key("distance").number(step.distance);
}

template <int D>
void answer(std::uint32_t question, const ShapeHandle<D>& a, const ShapeHandle<D>& b, const abut::Vec<D>& motion,
            abut::Trace<D>& trace) {
    const abut::QueryOptions<D> options{.trace = &trace};
    const auto x = a.shape.view(), y = b.shape.view();
    if (question == 0) closest(x, y, options);
    if (question == 1) contact(x, y, options);
    if (question == 2) sweep(x, motion, y, options);
    const auto* p = std::get_if<abut::PolytopeOf<D>>(&a.source);
    const auto* q = std::get_if<abut::PolytopeOf<D>>(&b.source);
    if (question == 3 && p != nullptr && q != nullptr) {
        abut::PolytopeOf<D> overlap;
        intersection(*p, *q, overlap, options);
    }
}

template <int D>
abut_code traced(std::uint32_t question, const ShapeHandle<D>* a, const ShapeHandle<D>* b,
                 typename CTypes<D>::Vec motion, abut_buffer* out) {
    return entry({present(a, "a"), present(b, "b"), finite(motion, "motion"), present(out, "out"), pair_of(a, b)}, [&] {
        abut::Trace<D> trace;
        answer(question, *a, *b, same_bytes<abut::Vec<D>>(motion), trace);
        Json json;
        json.begin('[');
        for (const abut::TraceStep<D>& step : trace.steps) {
            json.begin('{');
            std::visit([&](const auto& one) { write<D>(json, one); }, step);
            json.end('}');
        }
        json.end(']').write(*out);
    });
}

/// More stops than any sweep of the page has.
constexpr int max_stops = 64;

/// A search that is limited to some steps ends where these have led it, as at an impact. So it runs once for each stop.
template <int D>
void write_stops(const abut::View<D>& a, const abut::Motion<D>& motion_a, const abut::View<D>& b,
                 const abut::Motion<D>& motion_b, Json& json) {
    const auto path_a = rigid_path(motion_a), path_b = rigid_path(motion_b);
    const auto &convex_a = std::get<Convex<D>>(a), &convex_b = std::get<Convex<D>>(b);
    RotatingImpact<D> last;
    const bool hits = time_of_impact<D>(convex_a, path_a, convex_b, path_b, RotatingSweepLimits(), {}, last);
    for (int step = 0; step < max_stops; ++step) {
        RotatingImpact<D> stop;
        const RotatingSweepLimits limits{.max_iterations = step};
        if (!time_of_impact<D>(convex_a, path_a, convex_b, path_b, limits, {}, stop)) return;
        const auto here_a = placed(convex_a, {.place = place_at(path_a, stop.time)});
        const auto here_b = placed(convex_b, {.place = place_at(path_b, stop.time)});
        json.begin('{').key("time").number(static_cast<float>(stop.time));
        json.key("distance").number(static_cast<float>(part_distance<D>(here_a, here_b).distance));
        json.key("normal").template vec<D>(to_float(stop.normal)).end('}');
        if (hits && stop.time >= last.time) return;
    }
}

template <int D>
using Motion = typename CTypes<D>::Motion;

/// Calls body(view of A, motion of A, view of B, motion of B).
template <int D, class Body>
abut_code with_movers(const ShapeHandle<D>* a, Motion<D> motion_a, const ShapeHandle<D>* b, Motion<D> motion_b,
                      abut_buffer* out, Body&& body) {
    return entry({present(a, "a"), finite(motion_a, "motion_a"), present(b, "b"), finite(motion_b, "motion_b"),
                  present(out, "out"), pair_of(a, b)},
                 [&] {
                     return body(a->shape.view(), same_bytes<abut::Motion<D>>(motion_a), b->shape.view(),
                                 same_bytes<abut::Motion<D>>(motion_b));
                 });
}

template <int D>
abut_code sweep_stops(const ShapeHandle<D>* a, Motion<D> motion_a, const ShapeHandle<D>* b, Motion<D> motion_b,
                      abut_buffer* out) {
    return with_movers(a, motion_a, b, motion_b, out,
                       [&](const auto& x, const auto& of_x, const auto& y, const auto& of_y) {
                           if (!std::holds_alternative<Convex<D>>(x))
                               return report(Fault{ABUT_WRONG_SHAPE, "a", "is not convex"});
                           if (!std::holds_alternative<Convex<D>>(y))
                               return report(Fault{ABUT_WRONG_SHAPE, "b", "is not convex"});
                           Json json;
                           json.begin('[');
                           write_stops<D>(x, of_x, y, of_y, json);
                           json.end(']').write(*out);
                           return ABUT_OK;
                       });
}

template <int D>
abut_code distances(const ShapeHandle<D>* a, Motion<D> motion_a, const ShapeHandle<D>* b, Motion<D> motion_b,
                    std::uint32_t count, abut_buffer* out) {
    return with_movers(
        a, motion_a, b, motion_b, out, [&](const auto&, const auto& of_a, const auto&, const auto& of_b) {
            if (count < 2) return report(Fault{ABUT_BAD_ARGUMENT, "count", "is below 2"});
            std::vector<float> result;
            for (std::uint32_t i = 0; i < count; ++i) {
                const float time = static_cast<float>(i) / static_cast<float>(count - 1);
                const PlacedShape<D> here_a{a->shape, pose_at(of_a, time)}, here_b{b->shape, pose_at(of_b, time)};
                result.push_back(abut::closest(here_a, here_b).distance);
            }
            const auto bytes = std::as_bytes(std::span(result));
            out->bytes.assign(bytes.begin(), bytes.end());
            return ABUT_OK;
        });
}

}  // namespace

abut_code abut_play_sweep_stops2(const abut_shape2* a, abut_motion2 motion_a, const abut_shape2* b,
                                 abut_motion2 motion_b, abut_buffer* out) {
    return sweep_stops<2>(a, motion_a, b, motion_b, out);
}
abut_code abut_play_sweep_stops3(const abut_shape3* a, abut_motion3 motion_a, const abut_shape3* b,
                                 abut_motion3 motion_b, abut_buffer* out) {
    return sweep_stops<3>(a, motion_a, b, motion_b, out);
}

abut_code abut_play_distances2(const abut_shape2* a, abut_motion2 motion_a, const abut_shape2* b, abut_motion2 motion_b,
                               uint32_t count, abut_buffer* out) {
    return distances<2>(a, motion_a, b, motion_b, count, out);
}
abut_code abut_play_distances3(const abut_shape3* a, abut_motion3 motion_a, const abut_shape3* b, abut_motion3 motion_b,
                               uint32_t count, abut_buffer* out) {
    return distances<3>(a, motion_a, b, motion_b, count, out);
}

abut_code abut_play_trace2(uint32_t question, const abut_shape2* a, const abut_shape2* b, abut_vec2 motion,
                           abut_buffer* out) {
    return traced<2>(question, a, b, motion, out);
}
abut_code abut_play_trace3(uint32_t question, const abut_shape3* a, const abut_shape3* b, abut_vec3 motion,
                           abut_buffer* out) {
    return traced<3>(question, a, b, motion, out);
}
