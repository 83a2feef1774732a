#pragma once

// From a job to the rows of the table: first whether all sides agree, then how long each takes.

#include "bench.hpp"

#include <string>
#include <vector>

namespace abut::bench {

struct Row {
    std::string bench;
    std::string who;
    double ns = 0;                ///< an item: the median over the repetitions
    bool is_mean = false;         ///< ... or the mean, where frames were timed
    bool on_the_wall = false;     ///< not the processor's time
    double ratio = 0;             ///< abut's ns / this one's
    double over_best = 0;         ///< of the side that chooses: its ns / the least of abut's others; 0 of any other
    double answer = 0;            ///< the sum of all values of the verified calls
    std::string difference;       ///< from abut's values; empty: none
    std::vector<Figure> figures;  ///< what its side tells of itself
    bool agrees = true;           ///< no difference but for the forgiven strays
};

/// One row a side. The sides take turns, in random order, so that a machine that changes its speed changes it for all.
std::vector<Row> measure(const Bench& bench);

}  // namespace abut::bench
