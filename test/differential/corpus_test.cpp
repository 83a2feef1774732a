// The corpus through other libraries: how often each is wrong where abut is not. The table of docs/correctness.md.

#include "../corpus/corpus.hpp"

#include "in_child.hpp"
#include "peers.hpp"

#include <iomanip>
#include <iostream>

#include <gtest/gtest.h>

namespace abut::differential {
namespace {

using corpus::Family;

struct Question {
    Family family;
    std::uint64_t seed;
    PeerShape a, b;
    double distance, margin, smaller;
};

/// The pairs of the corpus in space that all peers have the shapes for.
std::vector<Question> questions(std::size_t count) {
    std::vector<Question> result;
    for (std::uint64_t number = 0; result.size() < count; ++number) {
        const corpus::Place place = corpus::place(number);
        if (place.dimension != 3 || place.family == Family::round || place.family == Family::half_space) continue;
        const auto pair = corpus::sample_pair<3>(place.family, place.seed);
        const auto a = peer_shape(pair.a), b = peer_shape(pair.b);
        if (!a || !b) continue;
        const double distance = oracle::truth(pair.a.solid, pair.b.solid, oracle::Arithmetic::rough).distance;
        result.push_back({place.family, place.seed, *a, *b, distance, oracle::tolerance_for(pair.a.solid, pair.b.solid),
                          std::min(a->size, b->size)});
    }
    return result;
}

struct Row {
    std::size_t overlap_wrong = 0;   ///< outside of the margin of doubt
    std::size_t distances = 0;       ///< answers with a distance
    std::size_t distance_wrong = 0;  ///< by more than the margin
    std::size_t distance_far = 0;    ///< by more than ten margins: 1e-4 of the size and the rounding of positions
    std::size_t not_finite = 0;
    std::size_t refusals = 0, crashes = 0, hangs = 0;

    void add(const Question& question, const PeerAnswer& answer) {
        if (answer.state == PeerAnswer::State::refused) ++refusals;
        if (answer.state != PeerAnswer::State::answered) return;
        const bool outside = std::abs(question.distance) > question.margin;
        if (outside && answer.overlap != (question.distance < 0)) ++overlap_wrong;
        if (!answer.knows_distance) return;
        if (!std::isfinite(answer.distance)) {
            ++not_finite;
            return;
        }
        ++distances;
        const double error = std::abs(answer.distance - question.distance);
        if (error > question.margin) ++distance_wrong;
        if (error > 10 * question.margin) ++distance_far;
    }
};

void print(const std::string& name, const Row& row) {
    std::cout << "| " << name << " | " << row.overlap_wrong << " | " << row.distances << " | " << row.distance_wrong
              << " | " << row.distance_far << " | " << row.not_finite << " | " << row.refusals << " | " << row.crashes
              << " | " << row.hangs << " |\n";
}

Row row_of(const std::vector<Question>& asked, Peer peer, std::array<std::size_t, corpus::family_count>& wrong) {
    constexpr int patience = 300;  // milliseconds
    const std::size_t bytes = asked.size() * sizeof(PeerAnswer);
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    auto* answers = static_cast<PeerAnswer*>(memory);
    const Losses losses = in_children(
        asked.size(), patience, [&](std::size_t i) { answers[i] = peer(asked[i].a, asked[i].b, asked[i].smaller); });
    Row row;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        Row own;
        own.add(asked[i], answers[i]);
        row.add(asked[i], answers[i]);
        const bool silent = answers[i].state != PeerAnswer::State::answered;
        if (silent || own.overlap_wrong + own.distance_far + own.not_finite > 0)
            ++wrong[static_cast<std::size_t>(asked[i].family)];
    }
    row.crashes = losses.crashes;
    row.hangs = losses.hangs;
    munmap(memory, bytes);
    return row;
}

PeerAnswer ask_abut(const Question& question) {
    const auto pair = corpus::sample_pair<3>(question.family, question.seed);
    return {PeerAnswer::State::answered, overlaps(pair.a.view, pair.b.view), true,
            static_cast<double>(closest(pair.a.view, pair.b.view).distance)};
}

struct NamedPeer {
    const char* name;
    Peer ask;
};
constexpr std::array<NamedPeer, 5> peers{{{"FCL, libccd", ask_fcl_libccd},
                                          {"FCL, its own solver", ask_fcl_indep},
                                          {"libccd, GJK and EPA", ask_ccd_epa},
                                          {"libccd, MPR", ask_ccd_mpr},
                                          {"Bullet, GJK and EPA", ask_bullet}}};

// Shapes of size 1 at the origin, and a thousandth: what is asked of the peers is what is meant.
TEST(CorpusPeers, AgreeOnEasyPairs) {
    std::array<int, peers.size()> wrong{};
    int asked = 0;
    for (std::uint64_t seed = 0; asked < 500; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const oracle::Sample<3> a = corpus::Movable<3>{oracle::Random(random.bits()), 1}.at(DVec<3>(0.0));
        DVec<3> center(0.0);
        const corpus::Movable<3> make_b{oracle::Random(random.bits()), 1};
        const oracle::Sample<3> b = corpus::near_by(random, a, make_b, center);
        const auto in_a = peer_shape(a), in_b = peer_shape(b);
        if (!in_a || !in_b) continue;
        ++asked;
        const double smaller = std::min(in_a->size, in_b->size), doubt = 1e-3 * smaller;
        const double distance = oracle::truth(a.solid, b.solid, oracle::Arithmetic::rough).distance;
        for (std::size_t i = 0; i < peers.size(); ++i) {
            if (peers[i].ask == ask_ccd_epa) continue;  // may take for ever
            // The depths of the others are wrong for many of these already.
            const bool depth_too = peers[i].ask == ask_bullet || peers[i].ask == ask_fcl_libccd;
            const PeerAnswer answer = peers[i].ask(*in_a, *in_b, smaller);
            const bool decided = std::abs(distance) <= doubt || answer.overlap == (distance < 0);
            const bool judged = answer.knows_distance && (distance > 0 || depth_too);
            const bool near = !judged || std::abs(answer.distance - distance) <= doubt;
            wrong[i] += answer.state == PeerAnswer::State::answered && decided && near ? 0 : 1;
        }
    }
    for (std::size_t i = 0; i < peers.size(); ++i) EXPECT_LE(wrong[i], asked / 100) << peers[i].name;
}

TEST(CorpusPeers, AreWrongWhereAbutIsNot) {
    const std::vector<Question> asked = questions(static_cast<std::size_t>(oracle::amount(200)));
    std::cout << "| of " << asked.size()
              << " pairs | overlap wrong | distances told | off by > margin | > 10 margins | not finite | refusals | "
                 "crashes | hangs |\n|---|---|---|---|---|---|---|---|---|\n";
    Row ours;
    std::array<std::array<std::size_t, corpus::family_count>, peers.size() + 1> wrong{};
    for (const Question& question : asked) {
        const Row before = ours;
        ours.add(question, ask_abut(question));
        const bool bad = ours.overlap_wrong + ours.distance_far + ours.not_finite >
                         before.overlap_wrong + before.distance_far + before.not_finite;
        wrong[0][static_cast<std::size_t>(question.family)] += bad ? 1 : 0;
    }
    print("abut", ours);
    for (std::size_t i = 0; i < peers.size(); ++i) print(peers[i].name, row_of(asked, peers[i].ask, wrong[i + 1]));

    std::cout << "\n| family | pairs | abut |";
    for (const NamedPeer& peer : peers) std::cout << ' ' << peer.name << " |";
    std::cout << "\n|---|---|---|---|---|---|---|---|\n";
    for (std::size_t family = 0; family < corpus::family_count; ++family) {
        std::size_t pairs = 0;
        for (const Question& question : asked) pairs += static_cast<std::size_t>(question.family) == family ? 1 : 0;
        if (pairs == 0) continue;
        std::cout << "| " << corpus::family_names[family] << " | " << pairs << " |";
        for (const auto& of_one : wrong) std::cout << ' ' << of_one[family] << " |";
        std::cout << '\n';
    }
    EXPECT_EQ(ours.overlap_wrong, 0u);
    EXPECT_EQ(ours.distance_wrong, 0u);
    EXPECT_EQ(ours.not_finite, 0u);
}

}  // namespace
}  // namespace abut::differential
