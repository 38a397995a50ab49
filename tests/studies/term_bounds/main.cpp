// Are the bounds that the docstrings promise kept? Prints a table; fails where one is not.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "pipeline/atomic_file.h"
#include "tests/studies/term_bounds/term_bounds.h"

namespace edgewise::study {
namespace {

struct Arguments {
    BoundsOptions bounds;
    std::string output, csv;
};

void addOptions(CLI::App& program, Arguments& arguments) {
    program.add_option("--edges", arguments.bounds.edges, "a category and family, that meet the support")
        ->check(CLI::Range(1L, 1'000'000'000L))
        ->capture_default_str();
    program.add_option("--judged", arguments.bounds.judged, "the worst of each row go before 50 digits")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    program.add_option("--seed", arguments.bounds.seed, "of all edges")->capture_default_str();
    program.add_option("--category", arguments.bounds.categories, "by number, repeatable [every one]")
        ->check(CLI::Range(0, kCategories - 1));
    program.add_option("-o,--output", arguments.output, "a file for the table beside standard output");
    program.add_option("--csv", arguments.csv, "a file for every row");
}

bool allHold(const BoundsResult& result) {
    bool hold = result.unequal_bits == 0;
    for (const BoundsRow& row : result.rows) {
        if (row.holds()) continue;
        hold = false;
        fmt::print(stderr, "term_bounds: error: {}, {}: {} u by {}, the bound is {} u\n", nameOf(row.claim),
                   nameOf(row.category), row.judged, row.worst_kernel, boundOf(row.claim));
    }
    return hold;
}

int run(int count, char** words) {
    CLI::App program("Measures the bounds of terms and polygons over adversarial edges.");
    Arguments arguments;
    addOptions(program, arguments);
    CLI11_PARSE(program, count, words);
    const BoundsResult result = measureBounds(arguments.bounds);
    fmt::print("{}", boundsTable(result));
    if (!arguments.output.empty()) writeAtomically(arguments.output, boundsTable(result));
    if (!arguments.csv.empty()) writeAtomically(arguments.csv, boundsCsv(result));
    return allHold(result) ? 0 : 1;
}

}  // namespace
}  // namespace edgewise::study

int main(int count, char** words) {
    try {
        return edgewise::study::run(count, words);
    } catch (const std::exception& error) {
        fmt::print(stderr, "term_bounds: error: {}\n", error.what());
        return 2;
    }
}
