// All queries on two convex shapes: the exact oracle judges the answers, which have the same bits by each SIMD target.

#include "../corpus/corpus.hpp"
#include "../oracle/simd_targets.hpp"
#include "../world/support/bits.hpp"
#include "bytes.hpp"

#include <cstdio>

namespace {

using namespace abut;

/// Points of a small lattice, some of them one rounding off, so that they coincide and are collinear and coplanar.
template <int D>
Vec<D> point_of(fuzz::Bytes& bytes, float scale) {
    Vec<D> result;
    for (int i = 0; i < D; ++i) {
        const std::uint8_t byte = bytes.byte();
        result[i] = scale * static_cast<float>(byte % 8);
        if (byte >= 0xf0) result[i] = std::nextafter(result[i], byte % 2 == 0 ? -1e30f : 1e30f);
    }
    return result;
}

template <int D>
oracle::Sample<D> shape_of(fuzz::Bytes& bytes, float scale) {
    oracle::Random random(bytes.byte());
    const float radius = bytes.byte() % 3 == 0 ? 0.25f * scale * static_cast<float>(bytes.byte() % 8) : 0;
    Pose<D> pose;
    if (bytes.byte() % 2 == 1) pose.rotation = random.rotation<D>();
    pose.position = point_of<D>(bytes, scale);
    std::vector<Vec<D>> points(1u + bytes.byte() % 8u);
    for (Vec<D>& point : points) point = point_of<D>(bytes, scale);
    return corpus::shape_of<D>(random, points, radius, pose, bytes.byte() % 2 == 1);
}

template <int D>
void check_simd_targets(const View<D>& a, const View<D>& b) {
    const auto answers = [&] { return test::Bits(overlaps(a, b), closest(a, b), contact(a, b)); };
    const test::Bits expected = answers();
    for (const std::int64_t target : oracle::supported_simd_targets()) {
        const oracle::ForcedSimdTarget only(target);
        fuzz::require(answers() == expected, hwy::TargetName(target));
    }
}

template <int D>
void check(fuzz::Bytes& bytes) {
    const float scale = std::ldexp(1.0f, bytes.byte() % 16 - 8);
    const oracle::Sample<D> a = shape_of<D>(bytes, scale);
    const corpus::SamplePair<D> pair{a, shape_of<D>(bytes, scale)};
    corpus::Verdict verdict;
    corpus::judge_samples<D>(pair, {}, bytes.byte(), verdict);
    // What the oracle can't prove in doubles is nothing that the library did.
    verdict.faults &= ~(1u << static_cast<int>(corpus::Fault::oracle));
    fuzz::require(verdict.faults == 0, verdict.story.c_str());
    check_simd_targets<D>(pair.a.view, pair.b.view);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    if (bytes.byte() % 2 == 1)
        check<3>(bytes);
    else
        check<2>(bytes);
    return 0;
}
