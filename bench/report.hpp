#pragma once

// Prints rows as a table or as JSON.

#include "measure.hpp"

#include <iosfwd>
#include <span>

namespace abut::bench {

/// One line with processor, compiler, and the meaning of the times.
void print_machine(std::ostream& out);

void print_table_head(std::ostream& out);
/// The rows of one bench.
void print_table_rows(std::ostream& out, std::span<const Row> rows);

/// {"rows": [{"bench", "who", "ns", "ratio", "answer"}]}, a row's figures by their names, and "disagreement" in a row
/// that has one.
void print_json(std::ostream& out, std::span<const Row> rows);

}  // namespace abut::bench
