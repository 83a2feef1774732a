// The library makes no call that gives other bits, or waits for ever, on another platform.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

struct Call {
    const char* text;
    const char* file;  ///< that may make it
    const char* instead;
};

TEST(PortableCalls, NoOthers) {
    constexpr Call calls[] = {
        {"std::sqrt", "square_root.hpp", "detail::square_root: the C library of Windows rounds in another way"},
        {"wait(", "thread_pool.cpp", "detail::Mutex: std::atomic::wait of libstdc++ 12 loses wake-ups without futexes"},
    };
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ABUT_SOURCE_FOLDER) / "abut")) {
        const std::string type = entry.path().extension().string();
        if (type != ".hpp" && type != ".cpp" && type != ".h") continue;
        ++files;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        for (const Call& call : calls)
            if (entry.path().filename() != call.file) {
                EXPECT_EQ(text.str().find(call.text), std::string::npos) << entry.path() << ": " << call.instead;
            }
    }
    EXPECT_GT(files, 300);
}

}  // namespace
