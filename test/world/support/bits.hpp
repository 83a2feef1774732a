#pragma once

// Answers of a world as integers, which compare equal only if every bit is equal.

#include <abut/world/world.hpp>

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace abut::test {

class Bits {
public:
    template <class... T>
    explicit Bits(const T&... answers) {
        (put(answers), ...);
    }

    void put(std::uint32_t word) { words_.push_back(word); }
    void put(bool flag) { put(flag ? 1u : 0u); }
    void put(float number) { put(std::bit_cast<std::uint32_t>(number)); }
    template <int D>
    void put(const glm::vec<D, float>& v) {
        for (int i = 0; i < D; ++i) put(v[i]);
    }
    void put(const Feature& f) { put_all(f.part, f.index, static_cast<std::uint32_t>(f.kind)); }
    template <int D>
    void put(const Hit<D>& h) {
        put_all(h.fraction, h.distance, h.point, h.normal, h.started_inside, h.feature);
    }
    template <int D>
    void put(const Closest<D>& c) {
        put_all(c.distance, c.normal, c.on_a, c.on_b, c.feature_a, c.feature_b);
    }
    template <int D>
    void put(const ContactPoint<D>& p) {
        put_all(p.position, p.depth, p.feature);
    }
    template <int D>
    void put(const Contact<D>& c) {
        put_all(c.normal, c.depth, c.points, c.feature_a, c.feature_b);
    }
    void put(const Id& id) { put_all(id.index, id.generation); }
    void put(const IdPair& pair) { put_all(pair.a, pair.b); }
    template <int D>
    void put(const WorldContact<D>& c) {
        put_all(c.a, c.b, c.contact);
    }
    template <int D>
    void put(const WorldImpact<D>& i) {
        put_all(i.a, i.b, i.hit);
    }
    template <int D>
    void put(const WorldHit<D>& h) {
        put_all(h.id, h.hit);
    }
    template <int D>
    void put(const WorldClosest<D>& c) {
        put_all(c.id, c.closest);
    }
    template <class T>
    void put(const std::optional<T>& answer) {
        put(answer.has_value());
        if (answer) put(*answer);
    }
    /// Any range, with its length.
    template <class List>
    auto put(const List& list) -> decltype(list.begin(), void()) {
        put(static_cast<std::uint32_t>(list.size()));
        for (const auto& each : list) put(each);
    }

    /// FNV-1a of the words.
    std::uint64_t hash() const {
        std::uint64_t result = 0xcbf29ce484222325;
        for (const std::uint32_t word : words_) result = (result ^ word) * 0x100000001b3;
        return result;
    }
    friend bool operator==(const Bits&, const Bits&) = default;

private:
    template <class... T>
    void put_all(const T&... parts) {
        (put(parts), ...);
    }

    std::vector<std::uint32_t> words_;
};

}  // namespace abut::test
