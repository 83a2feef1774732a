// Predicted and measured costs of tests in an order.

#include "early_out.h"

#include "command_canvas.hpp"
#include "early_out_tests.hpp"
#include <abut/draw/draw.hpp>
#include <abut/query/early_out.hpp>

#include <array>
#include <utility>

using namespace abut::detail;
using namespace abut::play;
using abut::TestCost;
using abut::Vec2;

struct abut_play_early_out {
    EarlyOutTests tests;
};

namespace {

/// One test as an EarlyOut takes it.
template <class Tests>
struct NumberedTest {
    const Tests* tests;
    std::uint32_t number;
    bool operator()(std::uint32_t input) const { return tests->passes(number, input); }
};

/// Picoseconds that tests would have taken.
std::uint64_t learned_time = 0;

template <class Tests>
struct LearnedTest {
    const Tests* tests;
    std::uint32_t number;
    std::uint64_t time;
    bool operator()(std::uint32_t input) const {
        learned_time += time;
        return tests->passes(number, input);
    }
};

/// Calls body with the indices of the tests as a sequence: for one, two or three tests.
template <class Body>
void with_count(std::uint32_t count, const Body& body) {
    if (count == 1) body(std::index_sequence<0>());
    if (count == 2) body(std::index_sequence<0, 1>());
    if (count == 3) body(std::index_sequence<0, 1, 2>());
}

template <class Test>
std::uint32_t passed(std::uint32_t inputs, const Test& test) {
    std::uint32_t result = 0;
    for (std::uint32_t input = 0; input < inputs; ++input) result += test(input) ? 1 : 0;
    return result;
}

template <class Tests>
std::uint32_t run(const Tests& tests, const std::uint32_t* order, std::uint32_t count, std::uint32_t repeats) {
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < repeats; ++i) {
        if (count == 0) {
            // The same loop with a test that the compiler can't foresee.
            volatile std::uint32_t limit = ~0u;
            result = passed(tests.inputs(), [&](std::uint32_t input) { return input < limit; });
        }
        with_count(
            count, [&]<std::size_t... I>(std::index_sequence<I...>) {
                const abut::EarlyOut all{NumberedTest<Tests>{&tests, order[I]}...};
                result = passed(tests.inputs(), all);
            });
    }
    return result;
}

template <class Tests>
std::vector<std::uint32_t> learned_order(const Tests& tests, const float* times) {
    std::vector<std::uint32_t> result;
    const auto picoseconds = [&](std::size_t i) { return static_cast<std::uint64_t>(times[i] * 1000); };
    with_count(
        tests.count(), [&]<std::size_t... I>(std::index_sequence<I...>) {
            abut::EarlyOut all{LearnedTest<Tests>{&tests, static_cast<std::uint32_t>(I), picoseconds(I)}...};
            all.set_clock([] { return learned_time; });
            for (int frame = 0; frame < 50; ++frame) {
                passed(tests.inputs(), [&](std::uint32_t input) { return all.measured(input); });
                all.reorder();
            }
            result.assign(all.order().begin(), all.order().end());
        });
    return result;
}

std::vector<TestCost> costs_of(const float* tests, std::uint32_t count) {
    std::vector<TestCost> result;
    for (std::uint32_t i = 0; i < count; ++i) result.push_back({tests[2 * i], tests[2 * i + 1]});
    return result;
}

Fault costs_fault(const float* tests, std::uint32_t count) {
    if (tests == nullptr && count > 0) return {ABUT_NULL_ARGUMENT, "tests", "is null"};
    for (std::uint32_t i = 0; i < count; ++i)
        if (!(tests[2 * i] >= 0 && tests[2 * i] < 1e6f && tests[2 * i + 1] >= 0 && tests[2 * i + 1] <= 1))
            return {ABUT_BAD_ARGUMENT, "tests", "is out of range", i};
    return {};
}
Fault order_fault(const std::uint32_t* order, std::uint32_t order_count, std::uint32_t count) {
    if (order == nullptr && order_count > 0) return {ABUT_NULL_ARGUMENT, "order", "is null"};
    for (std::uint32_t i = 0; i < order_count; ++i)
        if (order[i] >= count) return {ABUT_BAD_ARGUMENT, "order", "is no index of a test", i};
    return {};
}

std::uint32_t count_of(const abut_play_early_out* tests) {
    return tests == nullptr ? 0 : std::visit([](const auto& one) { return one.count(); }, tests->tests);
}

void write(std::span<const std::byte> bytes, abut_buffer& out) {
    out.bytes.assign(bytes.begin(), bytes.end());
}

/// The first test that refuses a pair; 3 if all pass.
std::uint32_t refusing_test(const ShapeTests& tests, std::uint32_t index) {
    std::uint32_t test = 0;
    while (test < tests.count() && tests.passes(test, index)) ++test;
    return test;
}

/// Draws a pair in a square of edge 1, and of circles or boxes those that decided.
void draw_pair(CommandCanvas<2>& canvas, const ShapeTests& tests, std::uint32_t index, std::uint32_t refused_by,
               const abut::Style& style) {
    const ShapeTests::Pair& pair = tests.pair(index);
    const float scale = 1 / static_cast<float>(tests.distance() + 2.2);
    const Vec2 center(static_cast<float>(index % 8) + 0.5f, -static_cast<float>(index / 8) - 0.5f);
    const auto placed = [&](const Vec2& point) { return center + scale * point; };
    for (const abut::Polygon* polygon : {&pair.a, &pair.b}) {
        std::vector<Vec2> points;
        for (const Vec2& point : polygon->points()) points.push_back(placed(point));
        canvas.polygon(points, style);
    }
    const abut::Style outline = style_of(false);
    if (refused_by == 0)
        for (const abut::Circle& circle : {pair.circle_a, pair.circle_b})
            draw(canvas, abut::Circle{placed(circle.center), scale * circle.radius}, outline);
    if (refused_by == 1)
        for (const abut::Aabb2& box : {pair.box_a, pair.box_b})
            draw(canvas, abut::Aabb2{placed(box.min), placed(box.max)}, outline);
}

/// Whether a test a that takes this long comes before b.
bool comes_first(const TestCost& a, const TestCost& b, bool is_redundant) {
    if (is_redundant) return abut::worth_pretesting(a.time, a.pass, b.time);
    return abut::best_order(std::array{a, b})[0] == 0;
}

}  // namespace

abut_code abut_play_early_out_calculated(const float* tests, uint32_t count, float alike, abut_play_early_out** out) {
    const bool is_usable = count >= 1 && count <= 3 && alike >= 0 && alike <= 1;
    const Fault fault = is_usable ? Fault() : Fault{ABUT_BAD_ARGUMENT, "count", "or `alike` is out of range"};
    return entry({costs_fault(tests, count), fault, present(out, "out")}, [&] {
        std::vector<CalculatedTests::Test> numbers;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double limit = static_cast<double>(tests[2 * i + 1]) * 0x1p32;
            numbers.push_back(
                {static_cast<std::uint32_t>(tests[2 * i]), limit < 0x1p32 ? static_cast<std::uint32_t>(limit) : ~0u});
        }
        *out = new abut_play_early_out{CalculatedTests(std::move(numbers), static_cast<double>(alike))};
    });
}
abut_code abut_play_early_out_shapes(uint32_t vertices, float elongation, float distance, abut_play_early_out** out) {
    const bool is_usable =
        vertices >= 3 && vertices <= 64 && elongation >= 1 && elongation <= 100 && distance >= 0 && distance <= 100;
    const Fault fault = is_usable ? Fault() : Fault{ABUT_BAD_ARGUMENT, "vertices", "or another number is out of range"};
    return entry({fault, present(out, "out")}, [&] {
        *out = new abut_play_early_out{
            ShapeTests(vertices, static_cast<double>(elongation), static_cast<double>(distance))};
    });
}
void abut_play_early_out_release(abut_play_early_out* tests) {
    delete tests;
}

abut_code abut_play_early_out_inputs(const abut_play_early_out* tests, uint32_t* out) {
    return entry({present(tests, "tests"), present(out, "out")},
                 [&] { *out = std::visit([](const auto& one) { return one.inputs(); }, tests->tests); });
}
abut_code abut_play_early_out_run(const abut_play_early_out* tests, const uint32_t* order, uint32_t order_count,
                                  uint32_t repeats, uint32_t* out) {
    const Fault fault = order_count <= 3 ? Fault() : Fault{ABUT_BAD_ARGUMENT, "order", "has more than three tests"};
    return entry(
        {present(tests, "tests"), fault, order_fault(order, order_count, count_of(tests)), present(out, "out")}, [&] {
            *out = std::visit([&](const auto& one) { return run(one, order, order_count, repeats); }, tests->tests);
        });
}
abut_code abut_play_early_out_learn(const abut_play_early_out* tests, const float* times, uint32_t count,
                                    abut_buffer* out) {
    const Fault fault =
        count == count_of(tests) ? Fault() : Fault{ABUT_BAD_ARGUMENT, "times", "are not one for each test"};
    return entry({present(tests, "tests"), fault, array(times, count, "times"), present(out, "out")}, [&] {
        const auto order = std::visit([&](const auto& one) { return learned_order(one, times); }, tests->tests);
        write(std::as_bytes(std::span(order)), *out);
    });
}
abut_code abut_play_early_out_draw(const abut_play_early_out* tests, uint32_t refused_by, bool filled,
                                   abut_buffer* out) {
    return entry({present(tests, "tests"), present(out, "out")}, [&] {
        CommandCanvas<2> canvas({Vec2(0, -6), Vec2(8, 0)});
        if (const auto* shapes = std::get_if<ShapeTests>(&tests->tests))
            for (std::uint32_t i = 0; i < 48; ++i)
                if (refusing_test(*shapes, i) == refused_by)
                    draw_pair(canvas, *shapes, i, refused_by, style_of(filled));
        canvas.write(*out);
    });
}

abut_code abut_play_best_order(const float* tests, uint32_t count, abut_buffer* out) {
    return entry({costs_fault(tests, count), present(out, "out")}, [&] {
        std::vector<std::uint32_t> order;
        for (const std::size_t i : abut::best_order(costs_of(tests, count)))
            order.push_back(static_cast<std::uint32_t>(i));
        write(std::as_bytes(std::span(order)), *out);
    });
}
abut_code abut_play_expected_cost(const float* tests, uint32_t count, const uint32_t* order, uint32_t order_count,
                                  double* out) {
    return entry({costs_fault(tests, count), order_fault(order, order_count, count), present(out, "out")}, [&] {
        const std::vector<std::size_t> indices(order, order + order_count);
        *out = abut::expected_cost(costs_of(tests, count), indices);
    });
}
abut_code abut_play_worth_pretesting(float time_a, float pass_a, float time_b, bool* out) {
    return entry({present(out, "out")}, [&] { *out = abut::worth_pretesting(time_a, pass_a, time_b); });
}
abut_code abut_play_break_even(float time_b, float pass_b, bool is_redundant, abut_buffer* out) {
    const float b[] = {time_b, pass_b};
    return entry({costs_fault(b, 1), present(out, "out")}, [&] {
        std::vector<float> points;
        for (int i = 0; i <= 64; ++i) {
            const double pass = i / 64.0;
            double low = 0, high = 1000.0 * static_cast<double>(time_b);
            for (int halving = 0; halving < 40; ++halving) {
                const double middle = 0.5 * (low + high);
                (comes_first({middle, pass}, {time_b, pass_b}, is_redundant) ? low : high) = middle;
            }
            points.insert(points.end(), {static_cast<float>(pass), static_cast<float>(low)});
        }
        write(std::as_bytes(std::span(points)), *out);
    });
}
