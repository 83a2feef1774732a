// The corpus through other libraries: the number of pairs for which each is wrong and abut is right. It prints the
// table of docs/correctness.md.

#include "../corpus/corpus.hpp"

#include "in_child.hpp"
#include "peers.hpp"

#include <iomanip>
#include <iostream>

#include <gtest/gtest.h>

namespace abut::differential {
namespace {

using corpus::Family;

struct Query {
    Family family;
    std::uint64_t seed;
    PeerShape a, b;
    double distance, margin, smaller;
};

/// The 3D pairs of the corpus whose shapes all peers have.
std::vector<Query> make_queries(std::size_t count) {
    std::vector<Query> result;
    for (std::uint64_t number = 0; result.size() < count; ++number) {
        const corpus::Place place = corpus::place(number);
        if (place.dimension != 3 || place.family == Family::round || place.family == Family::half_space) continue;
        const auto pair = corpus::sample_pair<3>(place.family, place.seed);
        const auto a = peer_shape(pair.a), b = peer_shape(pair.b);
        if (!a || !b) continue;
        const double distance = oracle::truth(pair.a.solid, pair.b.solid, oracle::Arithmetic::floating_point).distance;
        result.push_back({place.family, place.seed, *a, *b, distance, oracle::tolerance_for(pair.a.solid, pair.b.solid),
                          std::min(a->size, b->size)});
    }
    return result;
}

struct Row {
    std::size_t overlap_wrong = 0;   ///< outside of the tolerance
    std::size_t distances = 0;       ///< answers with a distance
    std::size_t distance_wrong = 0;  ///< by more than the tolerance
    std::size_t distance_far = 0;    ///< by more than ten tolerances: 1e-4 of the size and the rounding of positions
    std::size_t not_finite = 0;
    std::size_t refusals = 0, crashes = 0, hangs = 0;

    void add(const Query& query, const PeerAnswer& answer) {
        if (answer.state == PeerAnswer::State::refused) ++refusals;
        if (answer.state != PeerAnswer::State::answered) return;
        const bool outside = std::abs(query.distance) > query.margin;
        if (outside && answer.overlap != (query.distance < 0)) ++overlap_wrong;
        if (!answer.knows_distance) return;
        if (!std::isfinite(answer.distance)) {
            ++not_finite;
            return;
        }
        ++distances;
        const double error = std::abs(answer.distance - query.distance);
        if (error > query.margin) ++distance_wrong;
        if (error > 10 * query.margin) ++distance_far;
    }
};

void print(const std::string& name, const Row& row) {
    std::cout << "| " << name << " | " << row.overlap_wrong << " | " << row.distances << " | " << row.distance_wrong
              << " | " << row.distance_far << " | " << row.not_finite << " | " << row.refusals << " | " << row.crashes
              << " | " << row.hangs << " |\n";
}

Row row_of(const std::vector<Query>& queries, Peer peer, std::array<std::size_t, corpus::family_count>& wrong) {
    constexpr int patience = 300;  // milliseconds
    const std::size_t bytes = queries.size() * sizeof(PeerAnswer);
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    auto* answers = static_cast<PeerAnswer*>(memory);
    const Losses losses = in_children(queries.size(), patience, [&](std::size_t i) {
        answers[i] = peer(queries[i].a, queries[i].b, queries[i].smaller);
    });
    Row row;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        Row own;
        own.add(queries[i], answers[i]);
        row.add(queries[i], answers[i]);
        const bool silent = answers[i].state != PeerAnswer::State::answered;
        if (silent || own.overlap_wrong + own.distance_far + own.not_finite > 0)
            ++wrong[static_cast<std::size_t>(queries[i].family)];
    }
    row.crashes = losses.crashes;
    row.hangs = losses.hangs;
    munmap(memory, bytes);
    return row;
}

PeerAnswer query_abut(const Query& query) {
    const auto pair = corpus::sample_pair<3>(query.family, query.seed);
    return {PeerAnswer::State::answered, overlaps(pair.a.view, pair.b.view), true,
            static_cast<double>(closest(pair.a.view, pair.b.view).distance)};
}

struct NamedPeer {
    const char* name;
    Peer answer_of;
};
constexpr std::array<NamedPeer, 5> peers{{{"FCL, libccd", query_fcl_libccd},
                                          {"FCL, its own solver", query_fcl_indep},
                                          {"libccd, GJK and EPA", query_ccd_epa},
                                          {"libccd, MPR", query_ccd_mpr},
                                          {"Bullet, GJK and EPA", query_bullet}}};

// Checks the conversion for the peers: shapes of size 1 at the origin, with a tolerance of 1e-3.
TEST(CorpusPeers, AgreeOnEasyPairs) {
    std::array<int, peers.size()> wrong{};
    int queries = 0;
    for (std::uint64_t seed = 0; queries < 500; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const oracle::Sample<3> a = corpus::Movable<3>{oracle::Random(random.bits()), 1}.at(DVec<3>(0.0));
        DVec<3> center(0.0);
        const corpus::Movable<3> make_b{oracle::Random(random.bits()), 1};
        const oracle::Sample<3> b = corpus::near_by(random, a, make_b, center);
        const auto in_a = peer_shape(a), in_b = peer_shape(b);
        if (!in_a || !in_b) continue;
        ++queries;
        const double smaller = std::min(in_a->size, in_b->size), tolerance = 1e-3 * smaller;
        const double distance = oracle::truth(a.solid, b.solid, oracle::Arithmetic::floating_point).distance;
        for (std::size_t i = 0; i < peers.size(); ++i) {
            if (peers[i].answer_of == query_ccd_epa) continue;  // may be endless
            // The depths of the others are wrong for many of these already.
            const bool depth_too = peers[i].answer_of == query_bullet || peers[i].answer_of == query_fcl_libccd;
            const PeerAnswer answer = peers[i].answer_of(*in_a, *in_b, smaller);
            const bool decided = std::abs(distance) <= tolerance || answer.overlap == (distance < 0);
            const bool judged = answer.knows_distance && (distance > 0 || depth_too);
            const bool near = !judged || std::abs(answer.distance - distance) <= tolerance;
            wrong[i] += answer.state == PeerAnswer::State::answered && decided && near ? 0 : 1;
        }
    }
    for (std::size_t i = 0; i < peers.size(); ++i) EXPECT_LE(wrong[i], queries / 100) << peers[i].name;
}

TEST(CorpusPeers, AreWrongWhereAbutIsNot) {
    const std::vector<Query> queries = make_queries(static_cast<std::size_t>(oracle::case_count(200)));
    std::cout
        << "| of " << queries.size()
        << " pairs | overlap wrong | distances returned | off by > margin | > 10 margins | not finite | refusals | "
           "crashes | hangs |\n|---|---|---|---|---|---|---|---|---|\n";
    Row ours;
    std::array<std::array<std::size_t, corpus::family_count>, peers.size() + 1> wrong{};
    for (const Query& query : queries) {
        const Row before = ours;
        ours.add(query, query_abut(query));
        const bool bad = ours.overlap_wrong + ours.distance_far + ours.not_finite >
                         before.overlap_wrong + before.distance_far + before.not_finite;
        wrong[0][static_cast<std::size_t>(query.family)] += bad ? 1 : 0;
    }
    print("abut", ours);
    for (std::size_t i = 0; i < peers.size(); ++i)
        print(peers[i].name, row_of(queries, peers[i].answer_of, wrong[i + 1]));

    std::cout << "\n| family | pairs | abut |";
    for (const NamedPeer& peer : peers) std::cout << ' ' << peer.name << " |";
    std::cout << "\n|---|---|---|---|---|---|---|---|\n";
    for (std::size_t family = 0; family < corpus::family_count; ++family) {
        std::size_t pairs = 0;
        for (const Query& query : queries) pairs += static_cast<std::size_t>(query.family) == family ? 1 : 0;
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
