#include <abut/broad_phase/search_window.hpp>

#include <algorithm>

namespace abut {
namespace {

double time_for_way(double way, double speed) {
    return speed > 0 ? way / speed : std::numeric_limits<double>::infinity();
}

}  // namespace

void SearchWindow::begin(double margin) {
    *this = {};
    margin_ = margin;
}

double SearchWindow::next(double speed, double step, bool over) {
    if (resting_) {
        if (updates_ < rest_for_) return 0;
        // Another try, of some updates.
        rest_rate_ = cost_ / updates_;
        resting_ = false;
        margin_ = std::max(margin_, 4 * speed * step);
        last_rate_ = std::numeric_limits<double>::infinity();
        cost_ = updates_ = 0;
    } else if (over && updates_ > 0) {
        const double rate = cost_ / updates_;
        cost_ = updates_ = 0;
        if (rate > rest_rate_) {
            rest_for_ = std::min(2 * rest_for_, longest_rest);
            return rest();
        }
        rest_for_ = first_rest;
        if (rate > last_rate_) factor_ = factor_ > 1 ? 1 / (1 + 0.7 * (factor_ - 1)) : 1 + 0.7 * (1 / factor_ - 1);
        factor_ = factor_ > 1 ? std::max(factor_, 1.1) : std::min(factor_, 1 / 1.1);
        last_rate_ = rate;
        margin_ *= factor_;
    }
    return margin_ > 2 * speed * step ? time_for_way(margin_, speed) : rest();
}

double SearchWindow::rest() {
    resting_ = true;
    return 0;
}

}  // namespace abut
