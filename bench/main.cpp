// abut compared with its peers: nanoseconds per item, all in one run and on the same scenes, after verifying that all
// answers agree.

#include "bench.hpp"
#include "measure.hpp"
#include "plot.hpp"
#include "report.hpp"
#include "upper_halves.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace abut::bench;

constexpr int ok = 0, sides_disagree = 1, wrong_usage = 2;

constexpr const char* usage =
    "abut_bench [GROUP] [--json]\n"
    "  GROUP    narrow, broad, motion, levels, convex, field or walk, the beginning of rows' names, such as "
    "broad/moving, or the whole name of one; otherwise all\n"
    "abut_bench --plots FOLDER\n"
    "           measures what the documentation's pictures of broad phases show, and writes them there\n"
    "Exit status: 0 = fine, 1 = abut and a peer disagree, 2 = wrong usage, or a file can't be written\n";

std::vector<Bench> all_benches() {
    std::vector<Bench> result = narrow_benches();
    std::ranges::move(broad_benches(), std::back_inserter(result));
    std::ranges::move(motion_linear_benches(), std::back_inserter(result));
    std::ranges::move(motion_rotation_benches(), std::back_inserter(result));
    std::ranges::move(ray_benches(), std::back_inserter(result));
    std::ranges::move(mesh_sweep_benches(), std::back_inserter(result));
    std::ranges::move(chain_sweep_benches(), std::back_inserter(result));
    std::ranges::move(removal_benches(), std::back_inserter(result));
    std::ranges::move(level_benches(), std::back_inserter(result));
    std::ranges::move(level_load_benches(), std::back_inserter(result));
    std::ranges::move(levels_mover_benches(), std::back_inserter(result));
    std::ranges::move(convex_hull_benches(), std::back_inserter(result));
    std::ranges::move(convex_solid_benches(), std::back_inserter(result));
    std::ranges::move(convex_plane_benches(), std::back_inserter(result));
    std::ranges::move(convex_hull_plane_benches(), std::back_inserter(result));
    std::ranges::move(field_bake_benches(), std::back_inserter(result));
    std::ranges::move(field_sample_benches(), std::back_inserter(result));
    std::ranges::move(field_shape_benches(), std::back_inserter(result));
    std::ranges::move(field_particle_benches(), std::back_inserter(result));
    std::ranges::move(walk_step_benches(), std::back_inserter(result));
    std::ranges::move(walk_nearest_benches(), std::back_inserter(result));
    std::ranges::move(walk_path_benches(), std::back_inserter(result));
    std::ranges::move(upper_halves_benches(), std::back_inserter(result));
    return result;
}

/// Options of the benchmark library: the sides of a job are interleaved.
void set_up_timing() {
    char program[] = "abut_bench", take_turns[] = "--benchmark_enable_random_interleaving=true";
    char* arguments[] = {program, take_turns, nullptr};
    int count = 2;
    benchmark::Initialize(&count, arguments);
}

bool all_agree(std::span<const Row> rows) {
    return std::ranges::all_of(rows, [](const Row& row) { return row.agrees; });
}

int write_plots(const std::filesystem::path& folder) {
    print_machine(std::cout);
    print_table_head(std::cout);
    bool agree = true;
    std::vector<std::string> sides;
    std::vector<Plot> plots = broad_plots();
    for (Plot& plot : plots) {
        for (const PlotPoint& point : plot.points) {
            const std::vector<Row> found = measure(point.bench);
            print_table_rows(std::cout, found);
            add_rows(plot.chart, point.x, found, sides);
            agree = agree && all_agree(found);
        }
        const std::filesystem::path file = folder / plot.file;
        if (!(std::ofstream(file) << svg(plot.chart) << std::flush)) {
            std::cerr << "abut_bench: " << file.string() << " can't be written\n";
            return wrong_usage;
        }
    }
    return agree ? ok : sides_disagree;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string_view(argv[1]) == "--plots") {
        set_up_timing();
        return write_plots(argv[2]);
    }

    std::string_view group;
    bool json = false;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--help" || argument == "-h") {
            std::cout << usage;
            return ok;
        }
        if (argument == "--json" && !json)
            json = true;
        else if (!argument.empty() && !argument.starts_with('-') && group.empty())
            group = argument;
        else {
            std::cerr << usage;
            return wrong_usage;
        }
    }

    std::vector<Bench> benches = all_benches();
    const bool is_one = std::ranges::any_of(benches, [&](const Bench& bench) { return bench.name == group; });
    std::erase_if(benches,
                  [&](const Bench& bench) { return is_one ? bench.name != group : !bench.name.starts_with(group); });
    if (benches.empty()) {
        std::cerr << "abut_bench: there is no group " << group << '\n' << usage;
        return wrong_usage;
    }

    set_up_timing();
    if (!json) {
        print_machine(std::cout);
        print_table_head(std::cout);
    }
    std::vector<Row> rows;
    for (const Bench& bench : benches) {
        const std::vector<Row> found = measure(bench);
        if (!json) print_table_rows(std::cout, found);
        rows.insert(rows.end(), found.begin(), found.end());
    }
    if (json) print_json(std::cout, rows);
    return all_agree(rows) ? ok : sides_disagree;
}
