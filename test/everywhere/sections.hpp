#pragma once

// The parts of the program `golden`: each adds the bits of the answers of one area of the library to a hash.

#include "../query/hash.hpp"

#include <string_view>

namespace abut::everywhere {

struct Section {
    std::string_view name;
    void (*add)(Hash& hash);
};

void add_pairs_in_the_plane(Hash& hash);
void add_pairs_in_space(Hash& hash);
void add_polytopes(Hash& hash);
void add_decompositions(Hash& hash);
void add_solids(Hash& hash);
void add_levels(Hash& hash);
void add_broad_phases(Hash& hash);
void add_fields(Hash& hash);
void add_walks(Hash& hash);
void add_motions(Hash& hash);
void add_worlds_in_the_plane(Hash& hash);
void add_worlds_in_space(Hash& hash);
void add_files(Hash& hash);

inline constexpr Section sections[] = {
    {"pairs2", add_pairs_in_the_plane},
    {"pairs3", add_pairs_in_space},
    {"polytopes", add_polytopes},
    {"decompositions", add_decompositions},
    {"solids", add_solids},
    {"levels", add_levels},
    {"broad_phases", add_broad_phases},
    {"fields", add_fields},
    {"walks", add_walks},
    {"motions", add_motions},
    {"worlds2", add_worlds_in_the_plane},
    {"worlds3", add_worlds_in_space},
    {"files", add_files},
};

}  // namespace abut::everywhere
