#include <abut/bake/outline/partition.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>

namespace abut::outline {
namespace {

using detail::no_index;

/// Another round is worthwhile if the last one saved at least one face in this many.
constexpr std::size_t is_worthwhile = 40;

}  // namespace

Partition::FaceNumbers Partition::number_faces() const {
    FaceNumbers result;
    result.first = faces();
    result.of.assign(origins_.size(), no_index);
    for (std::uint32_t face = 0; face < result.first.size(); ++face) {
        std::uint32_t edge = result.first[face];
        do {
            result.of[edge] = face;
            edge = next_[edge];
        } while (edge != result.first[face]);
    }
    result.done.assign(result.first.size(), false);
    return result;
}

/// True if the face beyond a half-edge shares only this edge with the patch, and the union has at most `corners`
/// corners. `added` receives that face's other half-edges.
bool Partition::may_join(const Patch& patch, std::uint32_t half_edge, std::uint32_t corners, const FaceNumbers& numbers,
                         std::vector<std::uint32_t>& added) const {
    const std::uint32_t twin = twins_[half_edge];
    const auto in_patch = [&](std::uint32_t edge) {
        return std::ranges::find(patch.faces, numbers.of[edge]) != patch.faces.end();
    };
    if (twin == no_index || in_patch(twin)) return false;
    added.clear();
    for (std::uint32_t edge = next_[twin]; edge != twin; edge = next_[edge]) {
        added.push_back(edge);
        if (patch.loop.size() + added.size() - 1 > corners) return false;
        if (twins_[edge] != no_index && in_patch(twins_[edge])) return false;
    }
    return true;
}

bool Partition::grow(Patch& patch, std::uint32_t face, std::uint32_t corners, const FaceNumbers& numbers) const {
    patch.loop.clear();
    patch.inner.clear();
    patch.faces.assign(1, face);
    std::uint32_t edge = numbers.first[face];
    do {
        if (patch.loop.size() == corners) return false;
        patch.loop.push_back(edge);
        edge = next_[edge];
    } while (edge != numbers.first[face]);

    std::vector<std::uint32_t> added;
    for (std::size_t i = 0; i < patch.loop.size();) {
        const std::uint32_t out = patch.loop[i++];
        if (!may_join(patch, out, corners, numbers, added)) continue;
        // The neighbours of this face are considered in the next turn around the loop.
        std::rotate(patch.loop.begin(), patch.loop.begin() + static_cast<std::ptrdiff_t>(i), patch.loop.end());
        patch.loop.back() = added.front();
        patch.loop.insert(patch.loop.end(), added.begin() + 1, added.end());
        patch.inner.push_back(out);
        patch.inner.push_back(twins_[out]);
        patch.faces.push_back(numbers.of[twins_[out]]);
        i = 0;
    }
    return true;
}

/// True if the patch may have a face too many. An edge resolves at most two reflex corners. If there are nearly as many
/// edges as reflex corners, an improvement is likely only if one edge can resolve two.
bool Partition::may_improve(const Patch& patch, bool promising_only) const {
    struct Corner {
        const Vec2 &before, &at, &after;
    };
    std::vector<Corner> reflex;
    for (std::size_t i = 0; i < patch.loop.size(); ++i) {
        const Corner corner{at(patch.loop[i == 0 ? patch.loop.size() - 1 : i - 1]), at(patch.loop[i]),
                            at(patch.loop[i + 1 == patch.loop.size() ? 0 : i + 1])};
        if (orientation(corner.before, corner.at, corner.after) < 0) reflex.push_back(corner);
    }
    if (patch.faces.size() <= (reflex.size() + 1) / 2 + 1) return false;
    if (!promising_only || reflex.size() + 2 <= patch.faces.size()) return true;
    const auto splits = [](const Corner& corner, const Vec2& to) {
        return orientation(corner.before, corner.at, to) >= 0 && orientation(to, corner.at, corner.after) >= 0;
    };
    for (std::size_t i = 0; i < reflex.size(); ++i)
        for (std::size_t j = i + 1; j < reflex.size(); ++j)
            if (splits(reflex[i], reflex[j].at) && splits(reflex[j], reflex[i].at)) return true;
    return false;
}

void Partition::solve(Patch& patch, OptimalPartition& solver) const {
    std::vector<Vec2>& corners = patch.corners;
    std::vector<std::uint8_t>& may_be_straight = patch.may_be_straight;
    corners.clear();
    may_be_straight.clear();
    for (const std::uint32_t edge : patch.loop) {
        corners.push_back(at(edge));
        if (!conforming_) continue;
        std::uint32_t faces_in_patch = 1;
        for (const std::uint32_t inner : patch.inner) faces_in_patch += origins_[inner] == origins_[edge] ? 1 : 0;
        may_be_straight.push_back(faces_at_[origins_[edge]] == faces_in_patch ? 1 : 0);
    }
    solver.solve(corners, may_be_straight);
}

void Partition::recut(const Patch& patch, const OptimalPartition& parts, FaceNumbers& numbers) {
    struct Cut {
        std::uint32_t from, to, half_edge;
    };
    std::vector<Cut> cuts;
    std::size_t used = 0;
    for (const std::uint32_t edge : patch.inner) {
        --faces_at_[origins_[edge]];
        next_[edge] = no_index;
    }
    const auto half_edge = [&](std::uint32_t from, std::uint32_t to) {
        if (to == from + 1 || (to == 0 && from + 1 == patch.loop.size())) return patch.loop[from];
        const auto found = std::ranges::find_if(cuts, [&](const Cut& cut) { return cut.from == from && cut.to == to; });
        if (found != cuts.end()) return found->half_edge;
        const std::uint32_t there = patch.inner[used++], back = patch.inner[used++];
        cuts.push_back({from, to, there});
        cuts.push_back({to, from, back});
        origins_[there] = origins_[patch.loop[from]];
        origins_[back] = origins_[patch.loop[to]];
        twins_[there] = back;
        twins_[back] = there;
        ++faces_at_[origins_[there]];
        ++faces_at_[origins_[back]];
        return there;
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::span<const std::uint32_t> part = parts.part(i);
        const std::uint32_t face = patch.faces[i];
        std::uint32_t last = half_edge(part.back(), part.front());
        numbers.first[face] = last;
        for (std::size_t j = 0; j < part.size(); ++j) {
            const std::uint32_t edge = j + 1 < part.size() ? half_edge(part[j], part[j + 1]) : numbers.first[face];
            next_[last] = edge;
            before_[edge] = last;
            numbers.of[edge] = face;
            last = edge;
        }
    }
    face_count_ -= patch.faces.size() - parts.size();
    for (std::size_t i = parts.size(); i < patch.faces.size(); ++i) numbers.first[patch.faces[i]] = no_index;
}

Improvement Partition::improve(std::uint32_t corners, int rounds, bool promising_only) {
    FaceNumbers numbers = number_faces();
    OptimalPartition solver;
    Patch patch;
    Improvement result{true, false};
    for (int round = 0; round < rounds; ++round) {
        std::size_t saved = 0, left = 0;
        std::fill(numbers.done.begin(), numbers.done.end(), false);
        for (std::uint32_t i = 0; i < numbers.first.size(); ++i) {
            const auto face = round % 2 == 0 ? i : static_cast<std::uint32_t>(numbers.first.size() - 1 - i);
            if (numbers.first[face] == no_index) continue;
            ++left;
            if (numbers.done[face]) continue;
            const bool grown = grow(patch, face, corners, numbers);
            for (const std::uint32_t covered : patch.faces) numbers.done[covered] = true;
            result.optimal =
                result.optimal && (patch.faces.size() == 1 || grown) &&
                std::ranges::all_of(patch.loop, [&](std::uint32_t edge) { return twins_[edge] == no_index; });
            if (!grown || !may_improve(patch, promising_only)) continue;
            solve(patch, solver);
            if (solver.size() > patch.faces.size()) continue;
            saved += patch.faces.size() - solver.size();
            recut(patch, solver, numbers);
        }
        result.is_worthwhile = saved * is_worthwhile >= left;
        if (result.optimal || !result.is_worthwhile) break;
    }
    return result;
}

}  // namespace abut::outline
