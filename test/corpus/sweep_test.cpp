// Sweeps of twenty thousand pairs, or a million with ABUT_LONG in the environment: outside the tolerance, no hit is
// late, missed or false. Eight thousand more (or 400,000) have half-spaces and curved shapes.

#include "by_all_threads.hpp"
#include "plain_shape.hpp"
#include "sweep_by_planes.hpp"
#include "sweep_judge.hpp"

#include <gtest/gtest.h>

namespace abut::corpus {
namespace {

struct SweepSummary {
    std::uint64_t pairs = 0, hits = 0, touching = 0, late = 0, missed = 0, false_hits = 0, wrong = 0;
    double worst = 0;
    std::vector<std::string> stories;

    void add(const Place& where, const SweepVerdict& verdict) {
        ++pairs;
        hits += verdict.hit ? 1 : 0;
        touching += verdict.touches_at_start ? 1 : 0;
        late += verdict.late ? 1 : 0;
        missed += verdict.missed ? 1 : 0;
        false_hits += verdict.false_hit ? 1 : 0;
        worst = std::max(worst, verdict.worst);
        if (verdict.story.empty()) return;
        ++wrong;
        if (stories.size() >= 20) return;
        std::ostringstream story;
        story << "  " << where.dimension << "D " << name_of(where.family) << " seed " << where.seed << '\n'
              << verdict.story;
        stories.push_back(story.str());
    }
    void add(const SweepSummary& other) {
        pairs += other.pairs;
        hits += other.hits;
        touching += other.touching;
        late += other.late;
        missed += other.missed;
        false_hits += other.false_hits;
        wrong += other.wrong;
        worst = std::max(worst, other.worst);
        stories.insert(stories.end(), other.stories.begin(), other.stories.end());
    }
    std::string text() const {
        std::string result = std::to_string(late) + " late, " + std::to_string(missed) + " missed, " +
                             std::to_string(false_hits) + " false\n";
        for (const std::string& story : stories) result += story;
        return result;
    }
};

template <int D>
SweepVerdict judged_sweep(Family family, std::uint64_t seed) {
    const MovingPair<D> pair = set_in_motion<D>(sample_pair<D>(family, seed), Random(~seed));
    return SweepJudge<D>(pair).judge(sweep(pair.a.view, pair.motion, pair.b.view));
}
SweepVerdict judged_sweep(const Place& where) {
    return where.dimension == 2 ? judged_sweep<2>(where.family, where.seed) : judged_sweep<3>(where.family, where.seed);
}

/// 2D sweeps of plain shapes by closed forms.
SweepVerdict judged_plain_sweep(Family family, std::uint64_t seed) {
    const MovingPair<2> moving = set_in_motion<2>(sample_pair<2>(family, seed), Random(~seed));
    Random random(seed);
    const PlainSample a = plain(moving.a, random), b = plain(moving.b, random);
    const MovingPair<2> pair{a.sample, b.sample, moving.motion};
    return SweepJudge<2>(pair).judge(sweep(a.given, pair.motion, b.given, Vec2(0)));
}

/// Sweeps of the corpus's polytopes with radii.
template <class Judge>
SweepSummary judged_sweeps(std::uint64_t pairs, const Judge& judge) {
    return by_all_threads<SweepSummary>(0, pairs, [&](std::uint64_t number, SweepSummary& sum) {
        const Place where = place(number);
        if (where.family != Family::half_space && where.family != Family::round) sum.add(where, judge(where));
    });
}

/// Half of the sweeps have half-spaces, half curved shapes; half of each are in 2D.
SweepVerdict judged_sweep_by_planes(std::uint64_t number) {
    const Random random(number);
    switch (number % 4) {
        case 0:
            return judged_sweep_at_half_space<2>(random);
        case 1:
            return judged_sweep_at_half_space<3>(random);
        case 2:
            return judged_round_sweep<2>(random);
        default:
            return judged_round_sweep<3>(random);
    }
}

#ifdef NDEBUG
constexpr int usual_sweeps = 20'000;
#else
constexpr int usual_sweeps = 2'000;
#endif

void expect_right(const SweepSummary& all) {
    testing::Test::RecordProperty("pairs", std::to_string(all.pairs));
    testing::Test::RecordProperty("hits", std::to_string(all.hits));
    testing::Test::RecordProperty("touching_at_start", std::to_string(all.touching));
    testing::Test::RecordProperty("max_error_ratio", std::to_string(all.worst));
    EXPECT_EQ(all.wrong, 0u) << all.text();
    const double hits = static_cast<double>(all.hits) / static_cast<double>(all.pairs);
    EXPECT_GT(hits, 0.3);
    EXPECT_LT(hits, 0.7);
    EXPECT_GT(all.touching, all.pairs / 10) << "too little of this starts in touch";
}

TEST(SweepCorpus, IsNeverLateNorMissedNorFalse) {
    const auto pairs = static_cast<std::uint64_t>(std::min(oracle::case_count(usual_sweeps, 100), 1'100'000));
    expect_right(judged_sweeps(pairs, [](const Place& where) { return judged_sweep(where); }));
}

/// Sweeps beyond the first twenty thousand that once failed, with the reason.
TEST(SweepCorpus, PassesSweepsThatOnceFailed) {
    const struct {
        int dimension;
        Family family;
        std::uint64_t seed;
        const char* was;
    } found[] = {
        {3, Family::lattice, 766984, "a segment between two equal points at a rounded triangle: the point was NaN"},
        {3, Family::mixed_sizes, 207666, "the same"},
        {3, Family::far, 33368, "the same"},
        {2, Family::far, 566333, "corners 1e-4 apart taken to touch, so that the normal was that of an edge"},
    };
    for (const auto& [dimension, family, seed, was] : found)
        EXPECT_EQ(judged_sweep({dimension, family, seed}).story, "")
            << dimension << "D " << name_of(family) << " seed " << seed << ", once: " << was;
}

TEST(SweepCorpus, OfPlainShapesIsNeverLateNorMissedNorFalse) {
    const auto pairs = static_cast<std::uint64_t>(std::min(oracle::case_count(usual_sweeps, 100), 1'100'000));
    expect_right(judged_sweeps(pairs, [](const Place& where) { return judged_plain_sweep(where.family, where.seed); }));
}

#ifdef NDEBUG
constexpr int usual_sweeps_by_planes = 8'000;
#else
constexpr int usual_sweeps_by_planes = 1'000;
#endif

TEST(SweepCorpus, OfHalfSpacesAndRoundShapesIsNeverLateNorMissedNorFalse) {
    const auto pairs = static_cast<std::uint64_t>(std::min(oracle::case_count(usual_sweeps_by_planes, 100), 400'000));
    SweepSummary all;
    for (std::uint64_t kind = 0; kind < 4; ++kind) {
        const SweepSummary one =
            by_all_threads<SweepSummary>(0, pairs / 4, [kind](std::uint64_t number, SweepSummary& sum) {
                const std::uint64_t seed = 4 * number + kind;
                sum.add({kind % 2 == 0 ? 2 : 3, kind < 2 ? Family::half_space : Family::round, seed},
                        judged_sweep_by_planes(seed));
            });
        const double hits = static_cast<double>(one.hits) / static_cast<double>(one.pairs);
        EXPECT_GT(hits, 0.3) << "kind " << kind;
        EXPECT_LT(hits, 0.7) << "kind " << kind;
        EXPECT_GT(one.touching, one.pairs / 10) << "too little of this starts in touch, kind " << kind;
        all.add(one);
    }
    RecordProperty("pairs", std::to_string(all.pairs));
    RecordProperty("hits", std::to_string(all.hits));
    RecordProperty("touching_at_start", std::to_string(all.touching));
    RecordProperty("max_error_ratio", std::to_string(all.worst));
    EXPECT_EQ(all.wrong, 0u) << all.text();
}

}  // namespace
}  // namespace abut::corpus
