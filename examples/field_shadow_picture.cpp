// Draws soft shadows of a lamp, computed with a signed distance field. The picture of docs/fields.md.
// example_field_shadow_picture [FILE]          writes to stdout without a file
#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/svg.hpp>
#include <abut/field/field.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>

#include <algorithm>
#include <cstdio>
#include <span>
#include <vector>

namespace {

/// An interval of directions, seen from the lamp.
struct Run {
    float from, to;
};

/// A dark region: one interval per ring around the lamp.
struct Stain {
    std::vector<abut::Vec2> left, right;
    Run last{};
};

/// The intervals of a ring in which values are below the level. The first and the last value are not.
std::vector<Run> runs_below(std::span<const float> ring, float level, float spacing) {
    std::vector<Run> result;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        const bool here = ring[i] < level, before = ring[i - 1] < level;
        if (here == before) continue;
        const float at = spacing * (static_cast<float>(i) - (ring[i] - level) / (ring[i] - ring[i - 1]));
        if (here)
            result.push_back({at, at});
        else if (!result.empty())
            result.back().to = at;
    }
    return result;
}

bool overlap(const Run& a, const Run& b) {
    return a.from < b.to && b.from < a.to;
}

/// Concentric rings around a lamp with the light at each of their points.
struct Rings {
    abut::Vec2 lamp;
    float spacing, angle;  ///< between rings, between directions
    std::vector<std::vector<float>> light;

    abut::Vec2 place(float ring, float direction) const {
        const abut::Turn turn = abut::Turn::by(direction);
        return lamp + abut::Vec2(-turn.cos, -turn.sin) * (spacing * ring);
    }
};

/// Fills all regions with less light than the level. A run of intervals of neighbouring rings that overlap one to one
/// becomes one polygon.
void draw_below(abut::SvgCanvas& canvas, const Rings& rings, float level, const abut::Style& style) {
    std::vector<Stain> open;
    const auto go_round = [&](Stain& stain, float ring, float from, float to) {
        constexpr int pieces = 16;
        for (int i = 0; i <= pieces; ++i)
            stain.left.push_back(rings.place(ring, from + (to - from) * static_cast<float>(i) / pieces));
    };
    for (std::size_t j = 0; j <= rings.light.size(); ++j) {
        const auto ring = static_cast<float>(j);
        const bool last = j == rings.light.size();
        const std::vector<Run> runs = last ? std::vector<Run>() : runs_below(rings.light[j], level, rings.angle);
        std::vector<Stain> next;
        for (const Run& run : runs) {
            const auto met = [&](const Stain& other) { return overlap(other.last, run); };
            const auto before = std::find_if(open.begin(), open.end(), met);
            const bool goes_on =
                before != open.end() && std::count_if(open.begin(), open.end(), met) == 1 &&
                std::count_if(runs.begin(), runs.end(), [&](const Run& r) { return overlap(before->last, r); }) == 1;
            Stain stain;
            if (goes_on) {
                stain = *before;
                open.erase(before);
            }
            stain.last = run;
            if (!goes_on) go_round(stain, ring - 0.5f, run.to, run.from);
            stain.left.push_back(rings.place(ring, run.from));
            stain.right.push_back(rings.place(ring, run.to));
            next.push_back(stain);
        }
        for (Stain& stain : open) {
            go_round(stain, ring - 0.5f, stain.last.from, stain.last.to);
            stain.left.insert(stain.left.end(), stain.right.rbegin(), stain.right.rend());
            canvas.polygon(stain.left, style);
        }
        open = next;
    }
}

template <class S>
abut::Result<abut::Field2> with(const abut::Result<abut::Field2>& scene, const S& shape) {
    const auto baked = abut::bake_field(shape, abut::FieldOptions<2>{.cell = 0.05f});
    if (!scene || !baked) return baked;
    return abut::field_union(*scene, *baked);
}

}  // namespace

int main(int count, char** arguments) {
    const abut::Circle ball{{3.4f, 1.6f}, 0.55f};
    const abut::Box2 crate{{6.3f, 4.2f}, {0.7f, 0.45f}, abut::Turn::by(0.5f)};
    const abut::Capsule2 rod{{4.6f, 2.5f}, {5.6f, 1.7f}, 0.1f};
    const abut::Polygon wedge = *abut::Polygon::build({{7.8f, 1.2f}, {9.4f, 1.5f}, {8.4f, 2.6f}});
    auto scene = with(with(with(abut::bake_field(ball, abut::FieldOptions<2>{.cell = 0.05f}), crate), rod), wedge);
    if (!scene) return 1;

    const abut::Vec2 lamp(1.2f, 3.6f), size(11, 5.5f);
    Rings rings{lamp, 0.1f, 0.004f, {}};
    for (float ring = 0; ring * rings.spacing < 11; ++ring) {
        std::vector<abut::Vec2> places;
        for (float direction = 0; direction < 6.28f; direction += rings.angle)
            places.push_back(rings.place(ring, direction));
        rings.light.emplace_back(places.size());
        scene->shadow(places, lamp, 0.08f, rings.light.back());
    }

    abut::SvgCanvas canvas({{0, 0}, size}, 70, {255, 251, 235});
    constexpr int levels = 7;
    for (int i = 0; i < levels; ++i) {
        const float level = (static_cast<float>(i) + 0.5f) / levels;
        draw_below(canvas, rings, level, {abut::transparent, 0, {30, 41, 59, 40}});
    }
    const abut::Style solid{{37, 99, 235}, 2, {147, 180, 245}};
    draw(canvas, ball, solid);
    draw(canvas, crate, solid);
    draw(canvas, rod, solid);
    draw(canvas, wedge, solid);
    canvas.ball(lamp, 0.13f, {{217, 119, 6}, 2, {253, 224, 71}});

    std::FILE* file = count > 1 ? std::fopen(arguments[1], "wb") : stdout;
    const bool written = file != nullptr && std::fputs(canvas.document().c_str(), file) >= 0 && std::fclose(file) == 0;
    return written && scene->shadow({4.2f, 0.7f}, lamp) == 0 && scene->shadow({2, 5}, lamp) == 1 ? 0 : 1;
}
