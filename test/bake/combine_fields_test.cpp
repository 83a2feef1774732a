#include "../field/analytic.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/combine_fields.hpp>
#include <abut/bake/field/isosurface.hpp>
#include <abut/bake/field/samples.hpp>
#include <abut/convex/features.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace abut;
using namespace abut::detail;

constexpr double cell = 0.05;

oracle::Analytic<2> disc() {
    return oracle::ball<2>({0.1, -0.2}, 1);
}
oracle::Analytic<2> square() {
    return oracle::box<2>({0.9, 0.35}, {0.7, 0.5});
}
template <int D>
Field<D> field_of(const oracle::Analytic<D>& solid, FieldStore store = FieldStore::dense, double side = cell,
                  FieldLookup lookup = FieldLookup::linear) {
    return Field<D>(oracle::filled_around(solid, static_cast<float>(side), 4, {.store = store, .lookup = lookup}));
}

enum class What { together, common, without };
constexpr What all_of_them[] = {What::together, What::common, What::without};

double sides(What what, double a, double b) {
    return what == What::together ? std::min(a, b) : what == What::common ? std::max(a, b) : std::max(a, -b);
}
template <int D>
Result<Field<D>> combined(What what, const Field<D>& a, const Field<D>& b, const FieldOptions<D>& options = {}) {
    if (what == What::together) return field_union(a, b, options);
    return what == What::common ? field_intersection(a, b, options) : field_difference(a, b, options);
}

/// Points on the outlines of the disc and the square that bound the combination.
std::vector<DVec<2>> outline(What what) {
    constexpr int count = 8000;
    std::vector<DVec<2>> result;
    const auto offer = [&](const DVec<2>& p) {
        // On the combination's outline: a little to one side is inside, a little to the other outside.
        bool in = false, out = false;
        for (const DVec<2>& by :
             {DVec<2>(1e-6, 3e-7), DVec<2>(-1e-6, -3e-7), DVec<2>(-3e-7, 1e-6), DVec<2>(3e-7, -1e-6)}) {
            const bool inside = sides(what, disc().distance(p + by), square().distance(p + by)) < 0;
            in |= inside;
            out |= !inside;
        }
        if (in && out) result.push_back(p);
    };
    oracle::Random random(1);
    for (int i = 0; i < count; ++i) {
        const DVec<2> d = random.direction<2>();
        offer(DVec<2>(0.1, -0.2) + d);
        const double along = random.uniform(-1, 1);
        for (const double side : {-1.0, 1.0}) {
            offer(DVec<2>(0.9, 0.35) + DVec<2>(0.7 * along, 0.5 * side));
            offer(DVec<2>(0.9, 0.35) + DVec<2>(0.7 * side, 0.5 * along));
        }
    }
    return result;
}
double nearest(const std::vector<DVec<2>>& points, const DVec<2>& p) {
    double result = 1e300;
    for (const DVec<2>& q : points) result = std::min(result, length_squared(p - q));
    return std::sqrt(result);
}

template <int D, class Visit>
void each_place(const Field<D>& field, double step, Visit visit) {
    const Aabb<D> volume = field.volume();
    for (double x = static_cast<double>(volume.min.x); x <= static_cast<double>(volume.max.x); x += step)
        for (double y = static_cast<double>(volume.min.y); y <= static_cast<double>(volume.max.y); y += step) {
            if constexpr (D == 2) {
                visit(DVec<2>(x, y));
            } else {
                for (double z = static_cast<double>(volume.min.z); z <= static_cast<double>(volume.max.z); z += step)
                    visit(DVec<3>(x, y, z));
            }
        }
}

TEST(CombineFields, SignsAreRightAndDistancesAreBounds) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse})
        for (const What what : all_of_them) {
            const auto field = combined(what, field_of(disc(), store), field_of(square(), store), {.store = store});
            ASSERT_TRUE(field);
            EXPECT_EQ(field->cell(), static_cast<float>(cell));
            const auto border = outline(what);
            double off = 0, below = 0;
            int inside = 0, places = 0;
            each_place(*field, 0.071, [&](const DVec<2>& p) {
                const double sign = sides(what, disc().distance(p), square().distance(p)), truth = nearest(border, p);
                const double found = static_cast<double>(field->distance(Vec2(p)));
                ++places;
                inside += sign < 0;
                if (std::abs(sign) > cell) {
                    EXPECT_EQ(found < 0, sign < 0) << p.x << " " << p.y;
                }
                // A lower bound, up to the error between samples: far from bricks one cell in eight is known.
                const double bound = store == FieldStore::dense || truth < 3 * cell ? cell : 4 * cell;
                EXPECT_LE(std::abs(found), truth + bound) << p.x << " " << p.y;
                const double error = std::abs(std::abs(found) - truth);
                // Outside of the union it is a distance where both fields have samples; deep in the intersection too.
                if (what == What::together ? sign > 0 : sign < 0) {
                    if (contains(Aabb2{{0.2f - 0.7f, -0.15f - 0.2f}, {1, 0.8f}}, Vec2(p)) && truth < 3 * cell)
                        off = std::max(off, error);
                } else {
                    below = std::max(below, error);
                }
            });
            EXPECT_GT(inside, places / 20);
            EXPECT_LT(off, cell);
            EXPECT_GT(below, 0.05) << "that it isn't a distance shows";
        }
}

TEST(CombineFields, RedistancedIsTheDistance) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse})
        for (const What what : all_of_them) {
            const auto bound = combined(what, field_of(disc()), field_of(square()), {.store = FieldStore::dense});
            ASSERT_TRUE(bound);
            const auto field =
                field_redistance(*bound, {.store = store, .lookup = FieldLookup::gradient, .closest_points = true});
            ASSERT_TRUE(field) << field.problem().message;
            const auto border = outline(what);
            double most = 0, before = 0, near = 0;
            each_place(*field, cell, [&](const DVec<2>& p) {
                const double truth = nearest(border, p);
                const double found = static_cast<double>(field->distance(Vec2(p)));
                const double was = static_cast<double>(bound->distance(Vec2(p)));
                if (std::abs(was) > 0.1 * cell) {
                    EXPECT_EQ(found < 0, was < 0);
                }
                before = std::max(before, std::abs(std::abs(was) - truth));
                if (store == FieldStore::dense) most = std::max(most, std::abs(std::abs(found) - truth));
                if (truth < 3 * cell) near = std::max(near, std::abs(std::abs(found) - truth));
            });
            std::cout << "off by " << before / cell << " cells before, by " << most / cell
                      << " after, within three cells " << near / cell << "\n";
            // Corners are cut off by as much.
            EXPECT_LT(most, 0.8 * cell);
            EXPECT_LT(near, 0.8 * cell);
            EXPECT_GT(before, 2 * cell);
            EXPECT_EQ(field->data().closest.size(), field->data().samples());
        }
}

TEST(CombineFields, RedistancedByTheNearestOfAllPieces) {
    // Edges through samples make pieces without area, and slivers.
    const Field3 a = field_of(oracle::ball<3>({0, 0, 0}, 1), FieldStore::dense, 0.1);
    const Field3 b = field_of(oracle::box<3>({0.8, 0.3, 0.1}, {0.6, 0.4, 0.5}), FieldStore::dense, 0.1);
    for (const What what : all_of_them) {
        const auto bound = combined(what, a, b, {.store = FieldStore::dense});
        const auto field = field_redistance(*bound, {.store = FieldStore::dense, .closest_points = true});
        ASSERT_TRUE(field);
        const auto pieces = isosurface<3>(bound->data());
        const FieldData<3>& data = field->data();
        ASSERT_EQ(data.distance.size(), bound->data().distance.size());
        const SampleLattice<3> lattice{DVec<3>(data.origin), static_cast<double>(data.cell)};
        for (std::size_t n = 0; n < data.distance.size(); n += 397) {
            const DVec<3> p = lattice.at(oracle::counted<3>(n, data.cells + 1u));
            double nearest = 1e300;
            for (const auto& [u, v, w] : pieces)
                nearest = std::min(nearest, closest_on_triangle(DVec<3>(u), DVec<3>(v), DVec<3>(w), p).distance);
            ASSERT_NEAR(std::abs(data.distance[n]), nearest, 1e-6);
            ASSERT_EQ(data.distance[n] <= 0, bound->data().distance[n] <= 0);
            ASSERT_NEAR(length(DVec<3>(data.closest[n]) - p), nearest, 2e-6);
        }
    }
}

TEST(CombineFields, InSpaceToo) {
    const auto ball = oracle::ball<3>({0, 0, 0}, 1), box = oracle::box<3>({0.8, 0.3, 0.1}, {0.6, 0.4, 0.5});
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        const Field3 a = field_of(ball, store, 0.1), b = field_of(box, store, 0.08);
        for (const What what : all_of_them) {
            FieldReport report;
            const auto field = combined(what, a, b, {.store = store, .report = &report});
            ASSERT_TRUE(field);
            EXPECT_EQ(field->cell(), 0.08f);
            EXPECT_EQ(report.bytes, field->bytes());
            int inside = 0;
            each_place(*field, 0.13, [&](const DVec<3>& p) {
                const double sign = sides(what, ball.distance(p), box.distance(p));
                inside += sign < 0;
                if (std::abs(sign) > 0.1) {
                    EXPECT_EQ(field->distance(Vec3(p)) < 0, sign < 0);
                }
            });
            EXPECT_GT(inside, 100);
            // The box of the surface is tight.
            const auto exact = field_redistance(*field);
            ASSERT_TRUE(exact);
            for (const auto& piece : isosurface<3>(field->data()))
                for (const Vec3& corner : piece) ASSERT_TRUE(contains(grown(field->data().surface, 1e-5f), corner));
            if (what == What::common) {
                EXPECT_GT(field->data().surface.min.x, 0.0f);
            }
            // Near flat and round surfaces, away from edges, it is right to a part of a cell.
            if (what == What::together) {
                EXPECT_NEAR(exact->distance({-1.15f, 0, 0}), 0.15f, 0.01f);
                EXPECT_NEAR(exact->distance({1.5f, 0.3f, 0.1f}), 0.1f, 0.01f);
                EXPECT_NEAR(exact->distance({1.2f, 0.3f, 0.1f}), -0.2f, 0.01f);
            }
        }
    }
}

TEST(CombineFields, SamplesThatOneFieldDecidesStayAsTheyAre) {
    const Field3 a = field_of(oracle::ball<3>({0, 0, 0}, 1), FieldStore::dense, 0.1);
    const Field3 far = field_of(oracle::ball<3>({-9, 0.03, 0.07}, 0.4), FieldStore::dense, 0.17);
    Field3 field = a;
    for (int i = 0; i < 3; ++i) {
        auto next = field_union(field, far, {.store = FieldStore::dense});
        ASSERT_TRUE(next);
        field = *std::move(next);
    }
    each_place(a, 0.1, [&](const DVec<3>& p) { ASSERT_NEAR(field.distance(Vec3(p)), a.distance(Vec3(p)), 5e-6f); });
    // And it covers both.
    EXPECT_TRUE(contains(grown(field.volume(), 1e-5f), merged(a.volume(), far.volume())));
    EXPECT_LT(field.distance({-9, 0, 0}), -0.25f);
}

TEST(CombineFields, ThePiecesAreTheSurface) {
    // All of it without duplicates: equal length or area.
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        double around = 0, area = 0;
        for (const auto& [a, b] : isosurface<2>(field_of(oracle::ball<2>({0.01, 0.02}, 1), store).data()))
            around += length(DVec<2>(b) - DVec<2>(a));
        for (const auto& [a, b, c] : isosurface<3>(field_of(oracle::ball<3>({0.01, 0.02, 0}, 1), store).data()))
            area += 0.5 * length(cross(DVec<3>(b) - DVec<3>(a), DVec<3>(c) - DVec<3>(a)));
        // Every edge has two triangles.
        std::map<std::array<float, 6>, int> edges;
        for (const auto& piece : isosurface<3>(field_of(oracle::ball<3>({0.01, 0.02, 0}, 1), store).data()))
            for (std::size_t i = 0; i < 3; ++i) {
                Vec3 a = piece[i], b = piece[(i + 1) % 3];
                if (a == b) continue;
                if (std::array{a.x, a.y, a.z} > std::array{b.x, b.y, b.z}) std::swap(a, b);
                ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
            }
        for (const auto& [edge, count] : edges) ASSERT_EQ(count % 2, 0);
        EXPECT_NEAR(around / 6.283185, 1, 1e-3);
        EXPECT_NEAR(area / 12.56637, 1, 2e-3);
    }
}

TEST(CombineFields, SmoothUnion) {
    const Field2 a = field_of(disc()), b = field_of(square());
    const auto sharp = field_union(a, b, {.store = FieldStore::dense});
    for (const float radius : {0.0f, 0.1f, 0.6f}) {
        const auto field = field_smooth_union(a, b, radius, {.store = FieldStore::dense});
        ASSERT_TRUE(field);
        double most = 0;
        each_place(*field, cell, [&](const DVec<2>& p) {
            const float by = sharp->distance(Vec2(p)) - field->distance(Vec2(p));
            ASSERT_GE(by, -1e-5f);
            ASSERT_LE(by, 0.25f * radius + 1e-5f);
            most = std::max(most, static_cast<double>(by));
        });
        EXPECT_GE(most, 0.2 * static_cast<double>(radius));
    }
    EXPECT_EQ(field_smooth_union(a, b, -1.0f).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(field_smooth_union(a, b, std::numeric_limits<float>::quiet_NaN()).problem().code,
              ProblemCode::bad_argument);
}

TEST(CombineFields, GradientsAreThoseOfTheDistance) {
    const Field2 a = field_of(disc(), FieldStore::dense, cell, FieldLookup::gradient);
    const Field2 b = field_of(square(), FieldStore::dense, cell, FieldLookup::gradient);
    for (int i = 0; i < 5; ++i) {
        const FieldOptions<2> options{.store = FieldStore::dense, .lookup = FieldLookup::gradient};
        const auto field = i < 3    ? combined(all_of_them[i], a, b, options)
                           : i == 3 ? field_smooth_union(a, b, 0.4f, options)
                                    : field_offset(a, 0.1f, options);
        ASSERT_TRUE(field);
        const FieldData<2>& data = field->data();
        const glm::vec<2, std::uint32_t> along = data.cells + 1u;
        int checked = 0, off = 0;
        for (std::size_t n = 0; n < data.distance.size(); ++n) {
            const auto at = oracle::counted<2>(n, along);
            if (at.x == 0 || at.y == 0 || at.x == data.cells.x || at.y == data.cells.y) continue;
            const DVec<2> slope((data.distance[n + 1] - data.distance[n - 1]),
                                (data.distance[n + along.x] - data.distance[n - along.x]));
            if (length(slope) < 1.9 * cell) continue;  // at a ridge
            ++checked;
            off += dot(normalized(slope), DVec<2>(unpacked<2>(data.direction[n]))) < 0.99;
        }
        EXPECT_GT(checked, 1000);
        EXPECT_LT(off, checked / 15) << "but for edges";
    }
}

TEST(CombineFields, Offset) {
    for (const FieldStore store : {FieldStore::dense, FieldStore::sparse}) {
        const Field3 ball = field_of(oracle::ball<3>({0, 0, 0}, 1), store, 0.1);
        for (const float by : {-0.9f, -0.25f, 0.0f, 0.3f, 1.0f}) {
            const auto field = field_offset(ball, by, {.store = store});
            ASSERT_TRUE(field);
            oracle::Random random(17);
            double most = 0;
            for (int i = 0; i < 500; ++i) {
                const DVec<3> p = random.direction<3>() * (1 + static_cast<double>(by));
                most = std::max(most, static_cast<double>(std::abs(field->distance(Vec3(p)))));
            }
            // Near samples it is about as exact as they are; beyond the volume and the bricks there are bounds.
            const bool beyond = by > 0.35f || (store == FieldStore::sparse && by < -0.3f);
            EXPECT_LT(most, beyond ? 0.35 : 0.03) << by;
            EXPECT_TRUE(contains(grown(field->volume(), 1e-4f), Aabb3{Vec3(-1 - by), Vec3(1 + by)}));
        }
        // Gone altogether.
        const auto nothing = field_offset(ball, -1.5f, {.store = store});
        ASSERT_TRUE(nothing);
        EXPECT_EQ(nothing->data().surface, Aabb3::empty());
        EXPECT_GT(nothing->distance({0, 0, 0}), 0.3f);
        EXPECT_EQ(field_redistance(*nothing).problem().code, ProblemCode::empty_input);
    }
}

TEST(CombineFields, WhatTheVolumeCutsEndsThere) {
    const Field2 a = field_of(disc()), b = field_of(square());
    const auto field = field_union(a, b, {.volume = Aabb2{{-0.5f, -0.5f}, {0.5f, 0.5f}}});
    ASSERT_TRUE(field);
    EXPECT_LT(field->distance({0, 0}), 0);
    EXPECT_GT(field->distance({0.9f, 0}), 0);
    EXPECT_LT(field->volume().max.x, 0.95f);
}

TEST(CombineFields, ManyThreadsMakeTheSame) {
    const Field3 a = field_of(oracle::ball<3>({0, 0, 0}, 1), FieldStore::sparse, 0.08);
    const Field3 b = field_of(oracle::box<3>({0.8, 0.3, 0.1}, {0.6, 0.4, 0.5}), FieldStore::sparse, 0.08);
    ThreadPool threads(3);
    const auto alone = field_redistance(*field_difference(a, b)),
               together = field_redistance(*field_difference(a, b, {.executor = &threads}), {.executor = &threads});
    ASSERT_TRUE(alone);
    ASSERT_TRUE(together);
    EXPECT_EQ(alone->data().brick, together->data().brick);
    EXPECT_EQ(alone->data().distance, together->data().distance);
    EXPECT_EQ(alone->data().coarse, together->data().coarse);
}

TEST(CombineFields, ProblemsAreNamed) {
    const Field2 a = field_of(disc()), b = field_of(square());
    EXPECT_EQ(field_union(a, b, {.closest_points = true}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(field_union(a, b, {.cell = -1}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(field_union(a, b, {.cell = 1e-7f}).problem().code, ProblemCode::too_large);
    EXPECT_EQ(field_offset(a, std::numeric_limits<float>::infinity()).problem().code, ProblemCode::bad_argument);
    const auto never = [](double) { return false; };
    EXPECT_EQ(field_union(a, b, {.progress = FunctionRef<bool(double)>(never)}).problem().code, ProblemCode::cancelled);
    EXPECT_EQ(field_redistance(a, {.progress = FunctionRef<bool(double)>(never)}).problem().code,
              ProblemCode::cancelled);
}

}  // namespace
