#pragma once

// A hash over the bits of answers.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/raycast.hpp>

#include <bit>
#include <cstdint>
#include <optional>

namespace abut {

/// FNV-1a over whole words.
class Hash {
public:
    void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
    void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
    template <int D>
    void add(const glm::vec<D, float>& v) {
        for (int i = 0; i < D; ++i) add(v[i]);
    }
    void add(const Feature& f) {
        add(std::uint64_t{f.part} << 34 | std::uint64_t{f.index} << 2 | static_cast<std::uint64_t>(f.kind));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

template <int D>
void add_closest(Hash& hash, const Closest<D>& found) {
    hash.add(found.distance);
    hash.add<D>(found.normal);
    hash.add<D>(found.on_a);
    hash.add<D>(found.on_b);
    hash.add(found.feature_a);
    hash.add(found.feature_b);
}

template <int D>
void add_contact(Hash& hash, const Contact<D>& touch) {
    hash.add(touch.depth);
    hash.add<D>(touch.normal);
    for (const ContactPoint<D>& point : touch.points) {
        hash.add<D>(point.position);
        hash.add(point.depth);
        hash.add(std::uint64_t{point.feature});
    }
}

template <int D>
void add_hit(Hash& hash, const std::optional<Hit<D>>& hit) {
    if (!hit) return;
    hash.add(hit->fraction);
    hash.add(hit->distance);
    hash.add<D>(hit->point);
    hash.add<D>(hit->normal);
    hash.add(hit->feature);
}

}  // namespace abut
