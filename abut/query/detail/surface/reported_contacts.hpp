#pragma once

// The contacts that each_contact has reported, and the ghost contacts that it may still report. For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/edge_filter.hpp>

#include <algorithm>
#include <span>
#include <tuple>

namespace abut::detail {

/// Normals and depths that have been reported, up to a capacity. Of equal normals it stores only the deepest, which
/// covers all that the others cover.
template <int D>
class ReportedNormals {
public:
    void add(const DVec<D>& normal, double depth) {
        const auto end = reported_.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto same =
            std::find_if(reported_.begin(), end, [&](const Reported& reported) { return reported.normal == normal; });
        if (same != end)
            same->depth = std::max(same->depth, depth);
        else if (count_ < reported_.size())
            reported_[count_++] = {normal, depth};
        else
            is_full_ = true;
    }
    /// Whether a reported contact covers this one.
    bool has(const DVec<D>& normal, double depth, double size) const {
        return std::any_of(reported_.begin(), reported_.begin() + static_cast<std::ptrdiff_t>(count_),
                           [&](const Reported& reported) {
                               return covers_contact(reported.normal, reported.depth, normal, depth, size);
                           });
    }
    /// Some reported normals are missing.
    bool is_full() const { return is_full_; }

private:
    struct Reported {
        DVec<D> normal;
        double depth;
    };
    std::array<Reported, 32> reported_;
    std::size_t count_ = 0;
    bool is_full_ = false;
};

/// The contact that replaces one on an internal edge.
template <int D>
struct Ghost {
    Contact<D> contact;
    detail::SurfaceNormalFlags surface_normals;
    DVec<D> normal;
    double depth = 0;
    bool reported = false;  ///< another contact covers it
};

/// An order that depends on the contacts alone, not on the order of the parts: the deepest first. Among contacts that
/// differ only in their parts, the lowest parts come first.
template <int D>
bool comes_before(const Ghost<D>& a, const Ghost<D>& b) {
    if (a.depth != b.depth) return a.depth > b.depth;
    const auto compare = [](const auto& v, const auto& w) {
        for (int i = 0; i < D; ++i)
            if (v[i] != w[i]) return v[i] < w[i] ? -1 : 1;
        return 0;
    };
    if (const int by_normal = compare(a.normal, b.normal)) return by_normal < 0;
    if (!a.contact.points.empty() && !b.contact.points.empty())
        if (const int by_place = compare(a.contact.points[0].position, b.contact.points[0].position))
            return by_place < 0;
    return std::tie(a.contact.feature_a.part, a.contact.feature_b.part) <
           std::tie(b.contact.feature_a.part, b.contact.feature_b.part);
}

/// The first ghosts in that order, up to a capacity.
template <int D>
class DeepestGhosts {
public:
    void add(const Ghost<D>& ghost) {
        Ghost<D>* const end = ghosts_.data() + count_;
        Ghost<D>* const place = std::upper_bound(ghosts_.data(), end, ghost, comes_before<D>);
        if (count_ == ghosts_.size()) {
            is_truncated_ = true;
            if (place == end) return;
        } else {
            ++count_;
        }
        std::move_backward(place, ghosts_.data() + count_ - 1, ghosts_.data() + count_);
        *place = ghost;
    }
    void clear() {
        count_ = 0;
        is_truncated_ = false;
    }
    bool is_truncated() const { return is_truncated_; }
    std::span<Ghost<D>> all() { return {ghosts_.data(), count_}; }

private:
    std::array<Ghost<D>, 16> ghosts_;
    std::size_t count_ = 0;
    bool is_truncated_ = false;
};

}  // namespace abut::detail
