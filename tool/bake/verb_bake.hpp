#pragma once

// `abut bake`: a verb for each file of a list, on one machine or on many that share a cache.

#include "tool/bake/bake_job.hpp"
#include "tool/verbs.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// Part `index`, from 1, of `count`: every count-th line of the list.
struct Shard {
    std::size_t index = 1, count = 1;
};

struct BakeRequest {
    std::string list;  ///< a file with a path on each line; "-": stdin
    std::string cache;
    Shard shard;
    std::optional<double> audit;  ///< per cent of the results that are made again and compared
    bool report = false;          ///< only reports what the cache has of the whole list
    bool json = false;
    BakeTask task;
};

/// Exits with the worst code of the inputs; 2 if one was rejected or, with `report`, is missing.
Result<ExitCode> run_bake(const BakeRequest& request);

/// I/N with 1 <= I <= N <= 1000000.
Result<Shard> parse_shard(const std::string& text);

/// Above 0, at most 100.
Result<double> parse_percent(const std::string& text);

}  // namespace abut::tool
