// The library takes no square root by the C library, whose bits differ on Windows.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

TEST(SquareRoots, AreThoseOfTheLibrary) {
    const fs::path library = fs::path(ABUT_SOURCE_FOLDER) / "abut";
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(library)) {
        const std::string type = entry.path().extension().string();
        if ((type != ".hpp" && type != ".cpp" && type != ".h") || entry.path().filename() == "square_root.hpp")
            continue;
        ++files;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        EXPECT_EQ(text.str().find("std::sqrt"), std::string::npos) << entry.path() << ": call detail::square_root";
    }
    EXPECT_GT(files, 300);
}

}  // namespace
