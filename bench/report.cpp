#include "report.hpp"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <ostream>

namespace abut::bench {

namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "an unknown processor";
}

constexpr const char* compiler =
#ifdef __clang__
    "clang " __clang_version__;
#else
    "g++ " __VERSION__;
#endif

}  // namespace

void print_machine(std::ostream& out) {
    out << processor() << ", " << compiler
        << ". ns: processor time an item, median or, where noted, mean. ratio: abut's ns / this one's\n";
}

void print_table_head(std::ostream& out) {
    out << std::left << std::setw(48) << "bench" << std::setw(21) << "who" << std::right << std::setw(12) << "ns"
        << std::setw(9) << "ratio" << std::setw(16) << "answer" << '\n';
}

void print_table_rows(std::ostream& out, std::span<const Row> rows) {
    out << std::fixed;
    for (const Row& row : rows) {
        out << std::left << std::setw(48) << (&row == &rows.front() ? row.bench : "") << std::setw(21) << row.who
            << std::right << std::setprecision(1) << std::setw(12) << row.ns << std::setprecision(2) << std::setw(9)
            << row.ratio << std::setw(16) << row.answer;
        if (row.is_mean && &row == &rows.front()) out << "  mean of all frames";
        if (row.on_the_wall && &row == &rows.front()) out << ", time on the wall";
        if (row.over_best > 0) out << "  " << row.over_best << " of the best";
        for (const Figure& figure : row.figures)
            out << "  " << figure.name << ' ' << std::setprecision(figure.value < 1 ? 5 : 2) << figure.value;
        if (!row.difference.empty()) out << (row.agrees ? "  (" : "  DISAGREES (") << row.difference << ')';
        out << '\n';
    }
    out << std::flush;
}

void print_json(std::ostream& out, std::span<const Row> rows) {
    out << std::setprecision(std::numeric_limits<double>::max_digits10) << "{\"rows\": [";
    const char* separator = "\n";
    for (const Row& row : rows) {
        out << separator << R"(  {"bench": ")" << row.bench << R"(", "who": ")" << row.who << R"(", "ns": )" << row.ns
            << R"(, "ratio": )" << row.ratio << R"(, "answer": )";
        std::isfinite(row.answer) ? out << row.answer : out << "null";
        if (row.over_best > 0) out << R"(, "over_best": )" << row.over_best;
        for (const Figure& figure : row.figures) out << R"(, ")" << figure.name << R"(": )" << figure.value;
        if (!row.agrees) out << R"(, "disagreement": ")" << row.difference << '"';
        out << '}';
        separator = ",\n";
    }
    out << "\n]}\n";
}

}  // namespace abut::bench
