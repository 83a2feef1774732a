#include "tool/check/contact_findings.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace abut::tool {

// Closes contacts of the last frame whose pairs precede this one.
template <int D>
void ContactFindings<D>::close_until(const Pair& pair) {
    while (next_open_ < open_.size() && open_[next_open_].pair < pair) close(std::move(open_[next_open_++]));
}

template <int D>
void ContactFindings<D>::close(Open&& open) {
    if (!open.details) {
        ++left_out_;
        return;
    }
    ContactFinding<D>& finding = *open.details;
    finding.first = open.first;
    finding.last = open.last;
    closed_.push_back(std::move(finding));
}

template <int D>
void ContactFindings<D>::extend(const Pair& pair, std::size_t frame) {
    close_until(pair);
    if (next_open_ == open_.size() || open_[next_open_].pair != pair) return;
    next_.push_back(std::move(open_[next_open_++]));
    next_.back().last = static_cast<std::uint32_t>(frame);
}

template <int D>
void ContactFindings<D>::add(const Pair& pair, std::size_t frame) {
    extend(pair, frame);
    if (!next_.empty() && next_.back().pair == pair) return;
    next_.emplace_back();
    next_.back().pair = pair;
    next_.back().first = next_.back().last = static_cast<std::uint32_t>(frame);
}

template <int D>
void ContactFindings<D>::add(const Pair& pair, std::size_t frame, PairContact<D>&& contact) {
    add(pair, frame);
    deepen(next_.back(), frame, std::move(contact));
}

template <int D>
void ContactFindings<D>::deepen(const Pair& pair, std::size_t frame, PairContact<D>&& contact) {
    deepen(open_[static_cast<std::size_t>(find(pair) - open_.begin())], frame, std::move(contact));
}

template <int D>
void ContactFindings<D>::deepen(Open& open, std::size_t frame, PairContact<D>&& contact) {
    if (contact.distance >= open.distance) return;
    open.distance = contact.distance;
    if (rank(open) > last_) return;
    if (!open.details) {
        open.details = std::make_unique<ContactFinding<D>>();
        ++count_details_;
    }
    ContactFinding<D>& finding = *open.details;
    finding.a = open.pair.first;
    finding.b = open.pair.second;
    finding.deepest = frame;
    finding.distance = contact.distance;
    finding.allow = contact.allow;
    finding.normal = contact.normal;
    finding.points = std::move(contact.points);
    finding.inside = contact.inside;
    if (count_details_ > 2 * max_findings_) prune();
}

template <int D>
void ContactFindings<D>::end_frame() {
    for (; next_open_ < open_.size(); ++next_open_) close(std::move(open_[next_open_]));
    open_.clear();
    open_.swap(next_);
    next_open_ = 0;
}

template <int D>
void ContactFindings<D>::add(ContactFinding<D>&& between) {
    if (rank(between) > last_) {
        ++left_out_;
        return;
    }
    closed_.push_back(std::move(between));
    if (++count_details_ > 2 * max_findings_) prune();
}

template <int D>
auto ContactFindings<D>::find(const Pair& pair) const -> typename std::vector<Open>::const_iterator {
    const auto found = std::lower_bound(open_.begin(), open_.end(), pair,
                                        [](const Open& open, const Pair& wanted) { return open.pair < wanted; });
    return found != open_.end() && found->pair == pair ? found : open_.end();
}

template <int D>
bool ContactFindings<D>::has(const Pair& pair) const {
    return find(pair) != open_.end();
}

// Discards the details of all but the deepest findings.
template <int D>
void ContactFindings<D>::prune() {
    std::vector<Rank> ranks;
    ranks.reserve(count_details_);
    const auto each_open = [&](auto visit) {
        for (std::vector<Open>* opens : {&open_, &next_})
            for (Open& open : *opens)
                if (open.details) visit(open);
    };
    for (const ContactFinding<D>& finding : closed_) ranks.push_back(rank(finding));
    each_open([&](Open& open) { ranks.push_back(rank(open)); });
    const auto last = ranks.begin() + static_cast<std::ptrdiff_t>(max_findings_ - 1);
    std::nth_element(ranks.begin(), last, ranks.end());
    last_ = *last;

    left_out_ += std::erase_if(closed_, [&](const ContactFinding<D>& finding) { return rank(finding) > last_; });
    each_open([&](Open& open) {
        if (rank(open) > last_) open.details.reset();
    });
    count_details_ = closed_.size();
    each_open([&](Open&) { ++count_details_; });
}

template <int D>
std::vector<ContactFinding<D>> ContactFindings<D>::take() {
    end_frame();
    if (closed_.size() > max_findings_) {
        std::sort(closed_.begin(), closed_.end(),
                  [](const ContactFinding<D>& x, const ContactFinding<D>& y) { return rank(x) < rank(y); });
        left_out_ += closed_.size() - max_findings_;
        closed_.resize(max_findings_);
    }
    std::sort(closed_.begin(), closed_.end(), [](const ContactFinding<D>& x, const ContactFinding<D>& y) {
        return std::tie(x.a, x.b, x.first, x.between) < std::tie(y.a, y.b, y.first, y.between);
    });
    return std::move(closed_);
}

template class ContactFindings<2>;
template class ContactFindings<3>;

}  // namespace abut::tool
