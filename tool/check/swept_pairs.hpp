#pragma once

// Contacts between frames, by continuous sweeps.

#include "tool/check/contact_findings.hpp"
#include "tool/check/object_copies.hpp"
#include <abut/math/executor.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace abut::tool {

/// Sweeps pairs from one frame to the next, stage by stage. Pairs in contact at either frame are skipped. From the time
/// of impact on, a pair is sampled until it separates, to find contacts deeper than allowed.
template <int D>
class SweptPairs {
public:
    /// Refers to all arguments.
    SweptPairs(const Objects<D>& objects, ObjectCopies<D>& copies, const Limits& limits, const PairFilter& selection,
               const Piles<D>& piles, Executor& workers)
        : objects_(objects),
          copies_(copies),
          limits_(limits),
          piles_(piles),
          overlapping_(selection),
          workers_(workers) {}

    /// Finds the pairs that may touch in a stage; `at_first` has the contacts of the frame before it. The objects are
    /// still there.
    std::optional<Problem> add(const Stage<D>& stage, const ContactFindings<D>& at_first);

    /// Sweeps them, and adds their contacts since the frame `first` to `findings`, which is at the next frame by now.
    void find(std::size_t first, ContactFindings<D>& findings);

    /// Count of pairs swept so far.
    std::uint64_t swept() const { return swept_; }

private:
    /// The contact of a pair on a stage.
    struct Swept {
        Pair pair;
        ObjectCopy<D> a, b;
        bool is_swept = false;  ///< false if nothing moves
        std::optional<ContactFinding<D>> contact = std::nullopt;
    };

    struct SweptStage {
        Stage<D> stage;
        std::vector<Swept> pairs;
    };

    void sweep_pair(const Stage<D>& stage, float clearance, Swept& swept) const;
    void add(Swept&& swept);

    const Objects<D>& objects_;
    ObjectCopies<D>& copies_;
    const Limits& limits_;
    const Piles<D>& piles_;  ///< of the frame before
    OverlappingPairs<D> overlapping_;
    Executor& workers_;
    std::vector<Aabb<D>> boxes_;
    std::vector<SweptStage> stages_;
    std::map<Pair, ContactFinding<D>> contacts_;
    std::uint64_t swept_ = 0;
};

}  // namespace abut::tool
