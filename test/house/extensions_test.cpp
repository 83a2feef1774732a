// The library is standard C++: extensions of compilers are used only behind conditions, in the headers of
// abut/math/simd/ and where the C API exports its functions.

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

constexpr std::array kExtensions{"__attribute__", "__builtin_", "vector_size",   "ext_vector_type", "({",
                                 "__int128",      "__restrict", "__extension__", "typeof",          "asm volatile",
                                 "__asm",         "_mm_",       "mintrin.h"};

/// A call with a braced list isn't a statement expression: f({1, 2}).
bool is_statement_expression(std::string_view text, std::size_t at) {
    return at == 0 || text[at - 1] == ' ' || text[at - 1] == '=' || text[at - 1] == '\n';
}

std::string first_extension_in(const std::string& text) {
    for (const std::string_view extension : kExtensions)
        for (std::size_t at = text.find(extension); at != std::string::npos; at = text.find(extension, at + 1))
            if (extension != "({" || is_statement_expression(text, at)) return std::string(extension);
    return {};
}

TEST(Extensions, AreFound) {
    EXPECT_EQ(first_extension_in("using V = float __attribute__((packed));"), "__attribute__");
    EXPECT_EQ(first_extension_in("int x = ({ 1; });"), "({");
    EXPECT_EQ(first_extension_in("f({1, 2}); [[gnu::noinline]] void g();"), "");
}

TEST(Extensions, AreNotUsedInTheLibrary) {
    const fs::path library = fs::path(ABUT_SOURCE_FOLDER) / "abut";
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(library)) {
        const std::string type = entry.path().extension().string();
        if (type != ".hpp" && type != ".cpp" && type != ".h") continue;
        ++files;
        if (entry.path().parent_path() == library / "math" / "simd" || entry.path() == library / "c" / "types.h")
            continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        EXPECT_EQ(first_extension_in(text.str()), "") << entry.path();
    }
    EXPECT_GT(files, 300);
}

}  // namespace
