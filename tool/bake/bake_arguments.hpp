#pragma once

// The command line of `abut bake`.

#include "tool/bake/verb_bake.hpp"

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace abut::tool {

/// Arguments of `abut bake`; numbers are still text.
struct BakeArguments {
    BakeRequest request;
    std::optional<std::string> shard, audit;
    std::vector<std::string> options;
};

inline void add_options(CLI::App& verb, BakeArguments& arguments) {
    BakeRequest& request = arguments.request;
    verb.add_option("LIST", request.list, "A file with a path on each line; - reads them from stdin")->required();
    verb.add_option("OPTIONS", arguments.options, "After --: options of the verb, for all files");
    verb.add_option("--verb", request.task.verb, "What to do with each file: check, hull, decompose, field or walk")
        ->type_name("VERB")
        ->required();
    verb.add_option("--cache", request.cache,
                    "Where results are stored, and looked up first: a folder, or a URL of a server that takes GET "
                    "and PUT")
        ->type_name("DIR|URL")
        ->required();
    verb.add_option("--shard", arguments.shard, "Only the I-th of N parts of the list")->type_name("I/N");
    CLI::Option* audit =
        verb.add_option("--audit", arguments.audit,
                        "Make P per cent of the results again, chosen at random, and compare all bytes")
            ->type_name("P");
    verb.add_flag("--report", request.report, "Only report what is stored for the whole list")->excludes(audit);
    verb.add_flag("--json", request.json, "Print one JSON object instead of text");
    verb.footer(
        "A result is stored under the SHA-256 of all that it depends on: the version, the verb and its options, and "
        "all bytes of the file and of those it names. So a second run does only what is missing or has changed, and "
        "any number of workers may share a cache.");
}

}  // namespace abut::tool
