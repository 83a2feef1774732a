// Contact points and depths.

#include "narrow.hpp"

namespace abut::bench {

namespace {

constexpr Gaps shallow{-0.03, -0.01}, deep{-0.4, -0.1};

// The oracle confirms abut's depths. Both peers use ODE's box detector, which prefers face axes over edge axes and so
// overestimates depths.
constexpr double few = 0.01, some = 0.15;

Job boxes_with(const ConvexPairs<3>& scene, double strays) {
    return job(scene, {abut_contact<Box3, Box3>(scene), straying(bullet_contact_of_boxes(scene), strays),
                       straying(fcl_contact_of_boxes(scene), strays)});
}
Job stacks() {
    oracle::Random random(seed);
    return boxes_with(scenes::resting_stacks(pair_count, random), 0);
}
Job sliding_stacks() {
    oracle::Random random(seed);
    return boxes_with(scenes::sliding_stacks(pair_count, random), 0);
}

// libccd stops at a face of its polytope that is not the closest one.

Job hulls_with(const ConvexPairs<3>& scene) {
    return job(scene, {abut_contact<Polyhedron, Polyhedron>(scene), straying(bullet_contact_of_hulls(scene), few),
                       straying(bullet_contact_of_hulls_by_epa(scene), few), fcl_depth(scene),
                       straying(ccd_depth(scene), some)});
}
Job hulls_mostly_apart() {
    const ConvexPairs<3> scene = moving(hulls<32>, hulls<32>, mostly_apart);
    return job(scene, {abut_contact<Polyhedron, Polyhedron>(scene), straying(bullet_contact_of_hulls(scene), few),
                       straying(bullet_contact_of_hulls_by_epa(scene), few), fcl_depth_of_few(scene),
                       straying(ccd_depth(scene), some)});
}

Job capsule_and_box_at(const Gaps& gaps) {
    const ConvexPairs<3> scene = resting(capsules, boxes<3>, gaps);
    std::vector<Side> sides{abut_contact<Capsule3, Box3>(scene), straying(bullet_contact(scene), few)};
    // FCL takes milliseconds where EPA must approximate a round shape.
    if (gaps.low >= shallow.low) sides.push_back(straying(fcl_depth(scene), few));
    return job(scene, std::move(sides));
}

}  // namespace

std::vector<Bench> contact_benches() {
    return {
        {"narrow/contact/box-box/stacked", stacks},
        {"narrow/contact/box-box/shallow", [] { return boxes_with(resting(boxes<3>, boxes<3>, shallow), few); }},
        {"narrow/contact/box-box/shallow-many",
         [] { return boxes_with(resting(boxes<3>, boxes<3>, shallow, many), few); }},
        {"narrow/contact/box-box/deep", [] { return boxes_with(resting(boxes<3>, boxes<3>, deep), some); }},
        {"narrow/contact/box-box/deep-many", [] { return boxes_with(resting(boxes<3>, boxes<3>, deep, many), some); }},
        {"narrow/contact/box-box/coherent-touching", sliding_stacks},
        {"narrow/contact/box-box/coherent-apart",
         [] { return boxes_with(moving(boxes<3>, boxes<3>, mostly_apart), few); }},
        {"narrow/contact/hull32-hull32/shallow", [] { return hulls_with(resting(hulls<32>, hulls<32>, shallow)); }},
        {"narrow/contact/hull32-hull32/deep", [] { return hulls_with(resting(hulls<32>, hulls<32>, deep)); }},
        {"narrow/contact/hull32-hull32/coherent-touching",
         [] { return hulls_with(moving(hulls<32>, hulls<32>, touching)); }},
        {"narrow/contact/hull32-hull32/coherent-apart", hulls_mostly_apart},
        {"narrow/contact/capsule-box/shallow", [] { return capsule_and_box_at(shallow); }},
        {"narrow/contact/capsule-box/deep", [] { return capsule_and_box_at(deep); }},
    };
}

}  // namespace abut::bench
