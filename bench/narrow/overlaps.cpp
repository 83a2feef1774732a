// Overlap tests.

#include "narrow.hpp"

namespace abut::bench {

namespace {

constexpr Gaps apart{0.01, 0.5}, mixed{-0.3, 0.3};
constexpr Course to_and_fro{mixed, {-0.6, 0.6, 0.001}};

Job boxes_at(const Gaps& gaps) {
    const ConvexPairs<3> scene = resting(boxes<3>, boxes<3>, gaps);
    return job(scene, {abut_overlaps<Box3, Box3>(scene), bullet_overlaps_of_boxes(scene), fcl_overlaps(scene),
                       ccd_overlaps(scene)});
}

Job hulls_with(const ConvexPairs<3>& scene) {
    return job(scene, {abut_overlaps<Polyhedron, Polyhedron>(scene), bullet_overlaps(scene), fcl_overlaps(scene),
                       ccd_overlaps(scene)});
}

}  // namespace

std::vector<Bench> overlaps_benches() {
    return {
        {"narrow/overlaps/box-box/apart", [] { return boxes_at(apart); }},
        {"narrow/overlaps/box-box/mixed", [] { return boxes_at(mixed); }},
        {"narrow/overlaps/hull32-hull32/apart", [] { return hulls_with(resting(hulls<32>, hulls<32>, apart)); }},
        {"narrow/overlaps/hull32-hull32/mixed", [] { return hulls_with(resting(hulls<32>, hulls<32>, mixed)); }},
        {"narrow/overlaps/hull32-hull32/coherent", [] { return hulls_with(moving(hulls<32>, hulls<32>, to_and_fro)); }},
    };
}

}  // namespace abut::bench
