// Stands for tool/shared/progress.cpp: the page shows the bar.

#include "tool/shared/progress.hpp"

#include <utility>

namespace abut::tool {
namespace {

constexpr std::chrono::milliseconds between_updates{50};

extern "C" [[clang::import_module("page"), clang::import_name("progress")]] void show_progress(const char* what,
                                                                                               std::size_t what_size,
                                                                                               std::size_t done,
                                                                                               std::size_t all);

}  // namespace

// The page shows all that a terminal would.
Progress::Progress(std::string what) : what_(std::move(what)), is_terminal_(true), next_(Clock::now()) {}

Progress::~Progress() = default;

void Progress::operator()(std::size_t done, std::size_t all) {
    if (!is_terminal_ || all == 0 || Clock::now() < next_) return;
    next_ = Clock::now() + between_updates;
    is_shown_ = true;
    show_progress(what_.data(), what_.size(), done, all);
}

}  // namespace abut::tool
