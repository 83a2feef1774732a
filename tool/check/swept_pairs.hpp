#pragma once

// Contacts between frames, by continuous sweeps.

#include "tool/check/contact_findings.hpp"
#include <abut/math/executor.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace abut::tool {

/// Sweeps pairs from one frame to the next, stage by stage. Pairs in contact at the first frame are skipped. From the
/// time of impact on, a pair is sampled until it separates, to find contacts deeper than allowed.
template <int D>
class SweptPairs {
public:
    /// Refers to all arguments.
    SweptPairs(const Objects<D>& objects, const Limits& limits, const PairFilter& selection, const Piles<D>& piles,
               Executor& workers)
        : objects_(objects), limits_(limits), piles_(piles), overlapping_(selection), workers_(workers) {}

    /// Sweeps all pairs through a stage; `at_first` has the contacts of the frame before it.
    std::optional<Problem> test(const Stage<D>& stage, const ContactFindings<D>& at_first);

    /// Adds contacts found since the frame `first` to `findings`, which is at the next frame by now. Pairs in contact
    /// there are skipped.
    void end(std::size_t first, ContactFindings<D>& findings);

    /// Count of pairs swept so far.
    std::uint64_t swept() const { return swept_; }

private:
    /// The contact of a pair on a stage.
    struct Swept {
        Pair pair;
        bool is_swept = false;  ///< false if nothing moves
        std::optional<ContactFinding<D>> contact = std::nullopt;
    };

    void sweep_pair(const Stage<D>& stage, float clearance, Swept& swept) const;
    void add(Swept&& swept);

    const Objects<D>& objects_;
    const Limits& limits_;
    const Piles<D>& piles_;  ///< of the frame before
    OverlappingPairs<D> overlapping_;
    Executor& workers_;
    std::vector<Aabb<D>> boxes_;
    std::vector<Swept> swept_pairs_;
    std::map<Pair, ContactFinding<D>> contacts_;
    std::uint64_t swept_ = 0;
};

}  // namespace abut::tool
