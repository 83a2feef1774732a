// A hundred thousand pairs with exactly known answers, or ten million with ABUT_LONG in the environment: no answer is
// wrong outside the tolerance.

#include "corpus.hpp"

#include "by_all_threads.hpp"

#include <gtest/gtest.h>

namespace abut::corpus {
namespace {

/// The counts over many pairs.
struct Summary {
    std::uint64_t pairs = 0, overlapping = 0, wrong = 0, within_margin = 0;
    std::array<std::array<std::uint64_t, fault_count>, family_count> faults{};
    double worst_distance = 0;
    std::vector<std::string> stories;

    void add(const Place& where, const Verdict& verdict) {
        ++pairs;
        overlapping += verdict.overlap ? 1 : 0;
        within_margin += std::abs(verdict.distance) <= verdict.margin ? 1 : 0;
        worst_distance = std::max(worst_distance, verdict.worst_distance);
        if (verdict.faults == 0) return;
        ++wrong;
        bool new_to_us = false;
        for (int fault = 0; fault < fault_count; ++fault) {
            if ((verdict.faults >> fault & 1u) == 0) continue;
            std::uint64_t& count = faults[static_cast<std::size_t>(where.family)][static_cast<std::size_t>(fault)];
            new_to_us = new_to_us || count < few_stories;
            ++count;
        }
        if (!new_to_us) return;
        std::ostringstream story;
        story << "  " << where.dimension << "D " << name_of(where.family) << " seed " << where.seed << ", distance "
              << verdict.distance << ", margin " << verdict.margin << '\n'
              << verdict.story;
        stories.push_back(story.str());
    }
    void add(const Summary& other) {
        pairs += other.pairs;
        overlapping += other.overlapping;
        within_margin += other.within_margin;
        wrong += other.wrong;
        worst_distance = std::max(worst_distance, other.worst_distance);
        for (std::size_t i = 0; i < family_count; ++i)
            for (std::size_t j = 0; j < fault_count; ++j) faults[i][j] += other.faults[i][j];
        stories.insert(stories.end(), other.stories.begin(), other.stories.end());
    }
    /// Prints a line for each family with faults.
    std::string table() const {
        std::ostringstream out;
        for (std::size_t i = 0; i < family_count; ++i)
            for (std::size_t j = 0; j < fault_count; ++j)
                if (faults[i][j] > 0)
                    out << "  " << family_names[i] << ' ' << fault_names[j] << ' ' << faults[i][j] << '\n';
        for (const std::string& story : stories) out << story;
        return out.str();
    }

    /// The first failures of each family and fault, for each thread.
    static constexpr std::uint64_t few_stories = 2;
};

Summary judged(std::uint64_t first, std::uint64_t last) {
    return by_all_threads<Summary>(first, last, [](std::uint64_t number, Summary& sum) {
        const Place where = place(number);
        sum.add(where, check_corpus_pair(where.dimension, where.family, where.seed));
    });
}

/// A tenth of the pairs in builds without optimisation, which serve to find other errors.
#ifdef NDEBUG
constexpr int usual_pairs = 100'000;
#else
constexpr int usual_pairs = 10'000;
#endif

TEST(Corpus, HasNoWrongAnswer) {
    const auto pairs = static_cast<std::uint64_t>(oracle::case_count(usual_pairs, 100));
    const Summary all = judged(0, pairs);
    RecordProperty("pairs", std::to_string(all.pairs));
    RecordProperty("worst_distance_of_margin", std::to_string(all.worst_distance));
    EXPECT_EQ(all.wrong, 0u) << all.table();
    const double overlapping = static_cast<double>(all.overlapping) / static_cast<double>(all.pairs);
    EXPECT_GT(overlapping, 0.3);
    EXPECT_LT(overlapping, 0.7);
    EXPECT_GT(all.within_margin, all.pairs / 20) << "too little of this nearly touches";
    EXPECT_LT(all.within_margin, all.pairs / 2) << "too many pairs are within the tolerance";
}

/// Pairs beyond the first hundred thousand that once failed, with the reason.
TEST(Corpus, PassesPairsThatOnceFailed) {
    const struct {
        int dimension;
        Family family;
        std::uint64_t seed;
        const char* was;
    } found[] = {
        {3, Family::half_space, 10234, "no contact point was the deepest: the reference face lacked it"},
        {3, Family::half_space, 276534, "the same by 347"},
        {3, Family::far, 22868, "the deepest point 1.2 margins deeper than the contact"},
        {3, Family::lattice, 73184,
         "a contact point 19 off a shape of 512: sides moved out meet far from a sharp corner"},
        {3, Family::lattice, 427212, "the same by 30"},
        {3, Family::lattice, 996212, "a contact point beside an edge that was taken for a face"},
        {3, Family::lattice, 143148, "points of two edges that are nearly parallel, off both"},
        {3, Family::lattice, 1746448, "a triangle with two corners 1e-45 apart had no ends"},
        {3, Family::identical, 3580522, "a sliver taken for a face: a contact point 5e-4 beyond its end"},
        {3, Family::needle, 469288, "a normal of a face of a needle whose corners were merged"},
        {3, Family::round, 92198, "an ellipsoid about a flat box 0.1 too deep: the search ended early"},
        {3, Family::round, 65698, "points of two concentric ellipsoids 2.2 margins off them"},
        {2, Family::lattice, 1071685, "crossing segments, nearly parallel, taken to be apart"},
        {3, Family::lattice, 1489184, "nearly parallel segments: a normal 5e-6 off"},
        {3, Family::identical, 4343522, "the point on B 1e-6 off it: the walk had ended early"},
        {3, Family::zero_size, 2272996, "no common point was found of what overlaps"},
        {3, Family::identical, 7866158, "the same: weights of a needle lost their digits"},
        {3, Family::needle, 8159688, "the same"},
        {2, Family::far, 5032133, "corners 5e-4 apart taken to touch, so that an edge was the closest feature"},
        {3, Family::lattice, 9170584, "a point 0.4 beside a thin hull, behind all of its planes, taken to be inside"},
    };
    for (const auto& [dimension, family, seed, was] : found) {
        const Verdict verdict = check_corpus_pair(dimension, family, seed);
        EXPECT_EQ(verdict.faults, 0u) << dimension << "D " << name_of(family) << " seed " << seed << ", once: " << was
                                      << '\n'
                                      << verdict.story;
    }
}

}  // namespace
}  // namespace abut::corpus
