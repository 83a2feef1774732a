// Queries of pairs of shapes: random pairs, pairs on a coarse lattice, and pairs that move a little from query to
// query.

#include "../query/hashed_answers.hpp"
#include "sections.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/query/sweep.hpp>

namespace abut::everywhere {
namespace {

template <int D>
void add_sweeps(Hash& hash, WholeNumbers<D>& make, const View<D>& a, const View<D>& b) {
    const Vec<D> step = make.point() * 4.0f;
    add_hit(hash, sweep(a, step, b));
    const Vec<D> position = make.point();
    const Rotation<D> rotation = make.rotation();
    const Pose<D> rest, end{position, rotation};
    add_hit(hash, sweep(a, rest, end, b, rest, rest));
    add_hit(hash, sweep(b, rest, rest, a, end, rest));
}

/// The same two shapes, one of which moves on by small steps; the cache is that of the last query.
template <int D>
void add_coherent_answers(Hash& hash, WholeNumbers<D>& make, const View<D>& a, const View<D>& b) {
    Cache cache;
    const Vec<D> step = make.point() / 16.0f;
    Pose<D> pose;
    for (int i = 0; i < 8; ++i) {
        pose.position += step;
        const auto moved = at(b, pose);
        add_closest(hash, closest(a, moved, {.cache = &cache}));
        add_contact(hash, contact(a, moved, {.cache = &cache}));
    }
}

template <int D>
void add_pairs(Hash& hash) {
    Cache cache;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        WholeNumbers<D> make(seed, seed % 4 == 3);
        const View<D> a = make.shape(), b = make.shape();
        add_cheap_answers<D>(hash, make, a, b, cache);
        if (seed % 4 == 0) add_sweeps<D>(hash, make, a, b);
        if (seed % 8 == 1) add_coherent_answers<D>(hash, make, a, b);
        if (seed % 8 == 5) each_contact(a, b, [&](const Contact<D>& each) { add_contact(hash, each); });
    }
}

}  // namespace

void add_pairs_in_the_plane(Hash& hash) {
    add_pairs<2>(hash);
}
void add_pairs_in_space(Hash& hash) {
    add_pairs<3>(hash);
}

}  // namespace abut::everywhere
