// Retired words, which the terms of docs/glossary.md replaced, don't come back.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

constexpr std::array kRetired{
    "felt",        "feels",        "told",     "telling",    "foot",       "feet",          "doubt",
    "plainly",     "guest",        "resident", "lump",       "ask",        "asks",          "careful",
    "slack",       "tidy",         "pretest",  "wind_alike", "quick_walk", "careful_walk",  "growing_polytope",
    "turning_set", "told_normals", "kept",     "part_touch", "meeting",    "turning_sweep", "frontier",
    "carefully",   "as_it_were"};

constexpr std::array kFolders{"abut", "bench", "docs", "examples", "scenes", "test", "tool"};

// This file lists the words.
constexpr std::string_view kExempt = "words_test.cpp";

// The words of a text in lower case with underscores: GrowingPolytope becomes growing_polytope.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> result;
    std::string word;
    char before = ' ';
    for (const char c : text) {
        const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0, is_upper = is_letter && c < 'a';
        if (is_letter || (c == '_' && !word.empty())) {
            if (is_upper && std::islower(static_cast<unsigned char>(before)) != 0) word += '_';
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (!word.empty()) {
            result.push_back(word);
            word.clear();
        }
        before = c;
    }
    if (!word.empty()) result.push_back(word);
    return result;
}

// Whether a name contains a retired word, whole or between underscores.
bool holds(const std::string& name, std::string_view retired) {
    for (std::size_t at = name.find(retired); at != std::string::npos; at = name.find(retired, at + 1)) {
        const std::size_t end = at + retired.size();
        if ((at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_')) return true;
    }
    return false;
}

std::vector<std::string> retired_in(std::string_view text) {
    std::vector<std::string> result;
    for (const std::string& name : words_of(text))
        for (const char* retired : kRetired)
            if (holds(name, retired)) result.push_back(name);
    return result;
}

TEST(House, RetiredWordsAreFound) {
    EXPECT_EQ(retired_in("A FeltPair is told of each_foot; fault, footing and football are not."),
              (std::vector<std::string>{"felt_pair", "told", "each_foot"}));
}

TEST(House, RetiredWordsStayAway) {
    const fs::path root = ABUT_SOURCE_FOLDER;
    // The change log names what was.
    std::vector<fs::path> paths{root / "README.md", root / "CONTRIBUTING.md"};
    for (const char* folder : kFolders)
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string suffix = entry.path().extension().string();
            if (suffix != ".hpp" && suffix != ".cpp" && suffix != ".md") continue;
            if (entry.path().filename() != kExempt) paths.push_back(entry.path());
        }
    EXPECT_GT(paths.size(), 700u);
    for (const fs::path& path : paths) {
        std::ifstream file(path);
        std::string line;
        for (int number = 1; std::getline(file, line); ++number)
            for (const std::string& word : retired_in(line))
                ADD_FAILURE() << fs::relative(path, root).string() << ':' << number << ": " << word;
    }
}

}  // namespace
