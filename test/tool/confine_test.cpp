#include "tool/shared/confine.hpp"

#include "../io/gltf_builder.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace abut::tool {
namespace {

/// Runs a call in a confined child process. Its exit status is what the call returns, or 100 where calls aren't
/// filtered.
constexpr int unfiltered = 100;
int confined(const std::function<int(int pipe)>& call) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) _exit(confine(ends[1]) ? call(ends[1]) : unfiltered);
    int status = 0;
    waitpid(child, &status, 0);
    close(ends[0]);
    close(ends[1]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The error of a call that fails; 0 if it succeeds.
int error_of(long result) {
    return result < 0 ? errno : 0;
}

class Confine : public test::SceneFiles {
protected:
    void SetUp() override {
        test::SceneFiles::SetUp();
#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
        if (prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "this system can't filter calls";
#else
        GTEST_SKIP() << "calls are filtered on Linux for x86-64 and AArch64 alone";
#endif
    }
    void expect_refused(const char* name, const std::function<long()>& call) {
        const int error = confined([&](int) { return error_of(call()); });
        EXPECT_EQ(error, EPERM) << name;
    }
    const std::string file_ = write("there.txt", "text").string(), other_ = (folder() / "other.txt").string();
};

TEST_F(Confine, ReadsFilesAndWritesToItsPipe) {
    const int error = confined([&](int pipe) {
        const int file = open(file_.c_str(), O_RDONLY);
        char byte = 0;
        return file >= 0 && read(file, &byte, 1) == 1 && ::write(pipe, &byte, 1) == 1 ? 0 : errno;
    });
    EXPECT_EQ(error, 0);
}

TEST_F(Confine, ChangesNoFile) {
    expect_refused("write", [&] { return open(file_.c_str(), O_WRONLY); });
    expect_refused("append", [&] { return open(file_.c_str(), O_RDWR | O_APPEND); });
    expect_refused("truncate on opening", [&] { return open(file_.c_str(), O_RDONLY | O_TRUNC); });
    expect_refused("create", [&] { return open(other_.c_str(), O_RDONLY | O_CREAT, 0600); });
    expect_refused("rename", [&] { return std::rename(file_.c_str(), other_.c_str()); });
    expect_refused("remove", [&] { return unlink(file_.c_str()); });
    expect_refused("link", [&] { return link(file_.c_str(), other_.c_str()); });
    expect_refused("make a folder", [&] { return mkdir(other_.c_str(), 0700); });
    expect_refused("truncate", [&] { return truncate(file_.c_str(), 0); });
    EXPECT_EQ(std::filesystem::file_size(file_), 4u);
    EXPECT_FALSE(std::filesystem::exists(other_));
}

TEST_F(Confine, StartsNothing) {
    expect_refused("fork", [] {
        const pid_t child = fork();
        if (child == 0) _exit(0);
        return child;
    });
    expect_refused("run a program", [] { return execl("/bin/true", "true", nullptr); });
    expect_refused("trace", [] { return ptrace(PTRACE_TRACEME, 0, nullptr, nullptr); });
}

TEST_F(Confine, HasNoNetwork) {
    expect_refused("a socket", [] { return socket(AF_INET, SOCK_STREAM, 0); });
    expect_refused("a socket of this machine", [] { return socket(AF_UNIX, SOCK_STREAM, 0); });
}

TEST_F(Confine, KeepsNoOtherDescriptor) {
    const int secret = open(file_.c_str(), O_RDONLY);
    ASSERT_GE(secret, 0);
    const int error = confined([&](int) {
        char byte = 0;
        return error_of(read(secret, &byte, 1));
    });
    close(secret);
    EXPECT_EQ(error, EBADF);
}

}  // namespace
}  // namespace abut::tool
