#pragma once

// The order of tests: predicted by their costs and pass rates, and run for real.

#include <abut/c/abut.h>

ABUT_C_BEGIN

/// Tests, and inputs for them.
typedef struct abut_play_early_out abut_play_early_out;

/// One to three tests that calculate. `tests` has two numbers for each: the rounds of its calculation, and the fraction
/// of the inputs that passes. For the share `alike` of the inputs one random number decides all tests.
ABUT_API abut_code abut_play_early_out_calculated(ABUT_ARRAY(2 * count) const float* tests, uint32_t count, float alike,
                                                  abut_play_early_out** out);

/// Three tests of pairs of polygons, of which the first two are redundant: whether their bounding circles overlap,
/// their boxes, and they themselves. Their centers are at most `distance` apart, and the circles have radius 1.
ABUT_API abut_code abut_play_early_out_shapes(uint32_t vertices, float elongation, float distance,
                                              abut_play_early_out** out);

/// Frees it.
ABUT_API void abut_play_early_out_release(ABUT_OPTIONAL abut_play_early_out* tests);

/// The number of inputs.
ABUT_API abut_code abut_play_early_out_inputs(const abut_play_early_out* tests, uint32_t* out);

/// Runs tests in this order on all inputs so many times, by the const call of an EarlyOut. Returns how many inputs
/// pass. Without tests, only the loop runs.
ABUT_API abut_code abut_play_early_out_run(const abut_play_early_out* tests,
                                           ABUT_ARRAY(order_count) const uint32_t* order, uint32_t order_count,
                                           uint32_t repeats, uint32_t* out);

/// Lets an EarlyOut of all tests measure and reorder, and writes its order. Its clock advances by `times`, one for each
/// test, because the clocks of browsers are coarse.
ABUT_API abut_code abut_play_early_out_learn(const abut_play_early_out* tests, ABUT_ARRAY(count) const float* times,
                                             uint32_t count, abut_buffer* out);

/// Draws those of the first 48 pairs of polygons that the test refuses, where all tests before it pass; test 3 stands
/// for no refusal. There are 8 pairs in a row of length 8, from (0, 0) to the right and down.
ABUT_API abut_code abut_play_early_out_draw(const abut_play_early_out* tests, uint32_t refused_by, bool filled,
                                            abut_buffer* out);

/// best_order of tests, with two numbers for each: its time, and the fraction of the inputs that passes. Indices.
ABUT_API abut_code abut_play_best_order(ABUT_ARRAY(2 * count) const float* tests, uint32_t count, abut_buffer* out);

/// expected_cost of tests in an order, which may leave out some of them.
ABUT_API abut_code abut_play_expected_cost(ABUT_ARRAY(2 * count) const float* tests, uint32_t count,
                                           ABUT_ARRAY(order_count) const uint32_t* order, uint32_t order_count,
                                           double* out);

/// worth_pretesting: whether a redundant test a pays before b.
ABUT_API abut_code abut_play_worth_pretesting(float time_a, float pass_a, float time_b, bool* out);

/// The greatest time of a test a, for 65 pass rates from 0 to 1, at which it comes before b: by worth_pretesting if a
/// is redundant, else by best_order. Floats, the pass rate and the time. Times end at 1000 times that of b.
ABUT_API abut_code abut_play_break_even(float time_b, float pass_b, bool is_redundant, abut_buffer* out);

ABUT_C_END
