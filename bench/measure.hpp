#pragma once

// Turns a job into rows of the table: verifies that all sides agree, then measures each.

#include "bench.hpp"

#include <string>
#include <vector>

namespace abut::bench {

struct Row {
    std::string bench;
    std::string who;
    double ns = 0;                ///< per item: the median over repetitions
    bool is_mean = false;         ///< the mean instead, if frames were timed
    bool on_the_wall = false;     ///< wall-clock time instead of processor time
    double ratio = 0;             ///< abut's ns / this side's ns
    double over_best = 0;         ///< for the side that chooses: its ns / the minimum of abut's others; else 0
    double answer = 0;            ///< sum of all values of the verified calls
    std::string difference;       ///< difference from abut's values; empty: none
    std::vector<Figure> figures;  ///< figures of the side
    bool agrees = true;           ///< no difference beyond the tolerated ones
};

/// One row per side. Sides are interleaved in random order, so that changes of the machine's speed affect all alike.
std::vector<Row> measure(const Bench& bench);

}  // namespace abut::bench
