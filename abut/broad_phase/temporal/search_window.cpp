#include <abut/broad_phase/temporal/search_window.hpp>

#include <algorithm>

namespace abut::detail {

void SearchWindow::begin(double margin) {
    *this = {};
    margin_ = margin;
}

void SearchWindow::close(double speed, double step) {
    const double now = rate();
    count_anew();
    if (now > rest_rate_) {
        rest_for_ = std::min(2 * rest_for_, longest_rest);
        resting_ = true;
        return;
    }
    rest_for_ = first_rest;
    // Reverses, with a smaller factor.
    if (now > last_rate_) factor_ = factor_ > 1 ? 1 / (1 + 0.7 * (factor_ - 1)) : 1 + 0.7 * (1 / factor_ - 1);
    factor_ = factor_ > 1 ? std::max(factor_, 1.1) : std::min(factor_, 1 / 1.1);
    last_rate_ = now;
    margin_ *= factor_;
    resting_ = margin_ < 2 * speed * step;
}

bool SearchWindow::wakes(double speed, double step) {
    if (updates_ < rest_for_) return false;
    rest_rate_ = rate();
    count_anew();
    margin_ = std::max(margin_, 4 * speed * step);
    last_rate_ = std::numeric_limits<double>::infinity();
    resting_ = false;
    return true;
}

}  // namespace abut::detail
