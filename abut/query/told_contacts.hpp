#pragma once

// What each_contact has told of, and what it may still have to tell. For .cpp files.

#include <abut/query/contact.hpp>
#include <abut/query/felt_contact.hpp>

#include <algorithm>
#include <span>
#include <tuple>

namespace abut {

/// Normals and depths that have been told, as far as there is room. Of equal normals only the deepest is kept: it tells
/// of whatever the others do.
template <int D>
class ToldNormals {
public:
    void add(const DVec<D>& normal, double depth) {
        const auto end = told_.begin() + static_cast<std::ptrdiff_t>(count_);
        const auto same = std::find_if(told_.begin(), end, [&](const Told& told) { return told.normal == normal; });
        if (same != end)
            same->depth = std::max(same->depth, depth);
        else if (count_ < told_.size())
            told_[count_++] = {normal, depth};
        else
            is_full_ = true;
    }
    /// Whether that tells of this one as well.
    bool has(const DVec<D>& normal, double depth, double size) const {
        return std::any_of(told_.begin(), told_.begin() + static_cast<std::ptrdiff_t>(count_),
                           [&](const Told& told) { return tells_of(told.normal, told.depth, normal, depth, size); });
    }
    /// Some were not kept.
    bool is_full() const { return is_full_; }

private:
    struct Told {
        DVec<D> normal;
        double depth;
    };
    std::array<Told, 32> told_;
    std::size_t count_ = 0;
    bool is_full_ = false;
};

/// A contact in place of one that isn't felt.
template <int D>
struct Ghost {
    Contact<D> contact;
    FeltBy felt;
    DVec<D> normal;
    double depth = 0;
    bool told = false;  ///< by another
};

/// An order that depends on nothing but the contacts: the deepest first. Of such as are the same but for their parts,
/// the one of the lowest parts.
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

/// The first of many ghosts, in their order.
template <int D>
class FirstGhosts {
public:
    void add(const Ghost<D>& ghost) {
        Ghost<D>* const end = kept_.data() + count_;
        Ghost<D>* const place = std::upper_bound(kept_.data(), end, ghost, comes_before<D>);
        if (count_ == kept_.size()) {
            has_left_out_ = true;
            if (place == end) return;
        } else {
            ++count_;
        }
        std::move_backward(place, kept_.data() + count_ - 1, kept_.data() + count_);
        *place = ghost;
    }
    void clear() {
        count_ = 0;
        has_left_out_ = false;
    }
    bool has_left_out() const { return has_left_out_; }
    std::span<Ghost<D>> all() { return {kept_.data(), count_}; }

private:
    std::array<Ghost<D>, 16> kept_;
    std::size_t count_ = 0;
    bool has_left_out_ = false;
};

}  // namespace abut
