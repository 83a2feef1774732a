// Queries of levels and other shapes of many parts, and of every other shape that a file can hold.

#include "../shape/saved_shapes.hpp"
#include "sections.hpp"

namespace abut::everywhere {

void add_levels(Hash& hash) {
    test::each_saved_type([&]<class S>() {
        int touching = 0;
        for (std::uint64_t seed = 0; seed < 24; ++seed) {
            oracle::Random random(seed);
            const S shape = test::random_shape<S>(random);
            hash.add(test::answers_of(shape, random, 6, touching));
        }
        hash.add(static_cast<std::uint64_t>(touching));
    });
}

}  // namespace abut::everywhere
