#include "tool/shared/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace abut::tool {
namespace {

constexpr std::chrono::milliseconds patience{500};
constexpr std::chrono::milliseconds between_updates{100};
constexpr std::size_t width = 30;

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), is_terminal_(isatty(STDERR_FILENO) != 0), next_(Clock::now() + patience) {}

Progress::~Progress() {
    if (is_shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::operator()(std::size_t done, std::size_t all) {
    if (!is_terminal_ || all == 0 || Clock::now() < next_) return;
    next_ = Clock::now() + between_updates;
    is_shown_ = true;
    const std::size_t filled = std::min(width, width * done / all);
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r%s [%s] %zu of %zu\x1b[K", what_.c_str(), bar.c_str(), done, all);
    std::fflush(stderr);
}

}  // namespace abut::tool
