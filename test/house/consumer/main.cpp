// A minimal client of abut, built by the tests twice: with our flags, and outside from the installed package with -O3
// -march=native. Both must print the same: equal inputs give equal bits with any flags of the user.
#include <abut/abut.hpp>

#include <bit>
#include <cstdint>
#include <cstdio>

namespace {

// Numbers in [-2, 2] that are equal on every machine.
class Numbers {
public:
    float next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<float>(static_cast<std::int32_t>(state_ >> 32)) / 1073741824.0f;
    }
    glm::vec3 point() {
        const float x = next(), y = next(), z = next();
        return {x, y, z};
    }

private:
    std::uint64_t state_ = 1;
};

// FNV-1a over the bits of the answers.
class Hash {
public:
    void add(float value) { value_ = (value_ ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211u; }
    void add(const glm::vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(const abut::Closest<3>& answer) {
        add(answer.distance);
        add(answer.normal);
        add(answer.on_a);
        add(answer.on_b);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace

int main() {
    const abut::Sphere ball{.center = {3, 0, 0}, .radius = 1};
    const abut::Box3 crate{.center = {0, 0, 0}, .half = {1, 1, 1}};
    const auto gap = abut::closest(ball, crate);
    std::printf("apart %d, distance %g, normal %g %g %g\n", !abut::overlaps(ball, crate), gap.distance, gap.normal.x,
                gap.normal.y, gap.normal.z);
    if (abut::overlaps(ball, crate) || gap.distance != 1.0f || gap.normal.x != -1.0f) return 1;

    // Argument-dependent lookup finds the queries for the views of a world.
    abut::World3 world;
    const abut::Id first = world.add(ball), second = world.add(crate);
    if (overlaps(world.shape(first), world.shape(second)) ||
        closest(world.shape(first), crate.center).distance != 2.0f || bounds(world.shape(second)).max.x != 1.0f)
        return 1;

    Numbers numbers;
    Hash hash;
    constexpr int kPairs = 2000;
    int overlapping = 0;
    for (int i = 0; i < kPairs; ++i) {
        const glm::quat turn = glm::normalize(glm::quat{1.0f, numbers.point()});
        const abut::Box3 a{.center = numbers.point(), .half = {1, 0.5f, 0.25f}, .rotation = turn};
        const abut::Box3 b{.center = numbers.point(), .half = {0.5f, 1, 0.75f}};
        const abut::Sphere c{.center = numbers.point(), .radius = 0.5f};
        hash.add(abut::closest(a, b));
        hash.add(abut::closest(a, c));
        overlapping += abut::overlaps(a, b) ? 1 : 0;
    }
    std::printf("%d pairs, %d overlap, hash %016llx\n", kPairs, overlapping,
                static_cast<unsigned long long>(hash.value()));
    // The sample must have both separated and overlapping pairs.
    return overlapping > kPairs / 5 && overlapping < kPairs * 4 / 5 ? 0 : 1;
}
