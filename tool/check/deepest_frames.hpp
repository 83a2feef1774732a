#pragma once

// The deepest contacts of pairs over many frames, without their depths at each of them.

#include "tool/check/contact_findings.hpp"
#include "tool/check/object_copies.hpp"
#include "tool/check/pair_contact.hpp"
#include <abut/math/executor.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace abut::tool {

/// Frames at which two bodies are deeper than allowed. A move that parts them at one frame, in one of their own frames
/// of reference, mostly parts them at others, and there they are no deeper. To test that takes a hundredth of the time
/// that the depth takes.
class DeepFrames {
public:
    DeepFrames(ObjectCopy<3> a, ObjectCopy<3> b) : a_(std::move(a)), b_(std::move(b)) {}

    /// Whether these are the bodies, with their shapes.
    bool are_of(const ObjectCopy<3>& a, const ObjectCopy<3>& b) const { return a_ == a && b_ == b; }
    void add(std::size_t frame, const Pose3& a, const Pose3& b) { frames_.push_back({frame, a, b}); }

    struct Deepest {
        std::size_t frame = 0;
        PairContact<3> contact;
    };
    /// The deepest contact, to within 1e-3 of its depth, at the frames added since the last call; none if it is no
    /// deeper than those before.
    std::optional<Deepest> take_deepest(const Limits& limits);

private:
    struct Frame {
        std::size_t number = 0;
        Pose3 a, b;
    };
    /// The normal at a frame at which the depth was found, in the world and in both bodies.
    struct Normal {
        Vec3 in_world, in_a, in_b;
    };
    static constexpr std::size_t max_normals = 64;

    bool is_no_deeper(const Frame& frame) const;

    ObjectCopy<3> a_, b_;
    std::vector<Frame> frames_;
    std::vector<Normal> normals_;  ///< the last ones
    std::size_t next_normal_ = 0;
    float depth_ = 0;  ///< the largest so far
};

/// Those of all pairs.
class DeepestFrames {
public:
    /// Refers to all arguments.
    DeepestFrames(const Objects<3>& objects, ObjectCopies<3>& copies, const Limits& limits, Executor& workers)
        : objects_(objects), copies_(copies), limits_(limits), workers_(workers) {}

    /// Adds a frame at which a pair is deeper than allowed, after `find` of this frame.
    void add(const Pair& pair, std::size_t frame);

    /// Finds the deepest contacts, before a frame is added, of pairs that are not among those that go on, sorted, or
    /// whose shapes have changed; and of all pairs if they have very many frames.
    void find(const std::vector<Pair>& going_on, ContactFindings<3>& findings);

private:
    /// They take 64 bytes each.
    static constexpr std::size_t max_frames = std::size_t{1} << 20;

    struct Found {
        std::map<Pair, DeepFrames>::iterator pair;
        bool is_over = false;
        std::optional<DeepFrames::Deepest> deepest = std::nullopt;
    };

    const Objects<3>& objects_;
    ObjectCopies<3>& copies_;
    const Limits& limits_;
    Executor& workers_;
    std::map<Pair, DeepFrames> pairs_;
    std::size_t frames_ = 0;  ///< of all pairs, added since the depths of all were found
    std::vector<Found> found_;
};

}  // namespace abut::tool
