#include "tool/help/suggestion.hpp"

#include <algorithm>
#include <cstddef>

namespace abut::tool {
namespace {

// The distance of Damerau and Levenshtein, where no letter is changed twice.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            std::size_t& cell = rows[i][j];
            cell = i == 0 ? j : j == 0 ? i : rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            if (i == 0 || j == 0) continue;
            cell = std::min({cell, rows[i - 1][j] + 1, rows[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cell = std::min(cell, rows[i - 2][j - 2] + 1);
        }
    return rows[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
    constexpr std::size_t max_word = 64;
    if (word.size() > max_word) return {};
    std::string nearest;
    std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
    for (const std::string& candidate : words) {
        const std::size_t here = distance(word, candidate);
        if (here >= least) continue;
        least = here;
        nearest = candidate;
    }
    return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
    const std::string nearest = nearest_word(word, words);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace abut::tool
