// Calls that must not compile, one per line, each with a word that must be in the compiler's message. refused.cmake
// counts the lines of each message: a circle against a sphere once took 65, without the word "dimension".
#include <abut/abut.hpp>

using namespace abut;

extern Circle circle;
extern Sphere sphere;
extern Box2 square;
extern HalfSpace2 ground;
extern Vec2 p2;
extern Vec3 p3;
extern Pose2 pose;
extern Motion2 motion;
extern World2 world;
extern Id id;
extern Closest<2> answer;
extern Ray2 ray;
struct NoShape {
} thing;

// clang-format off
void f1() { overlaps(circle, sphere); }                                    // dimension
void f2() { (void)closest(circle, sphere, {.margin = 1}); }                // dimension
bool f3() { return bool(contact(circle, sphere)); }                        // dimension
void f4() { each_contact(circle, sphere, [](const auto&) {}); }            // dimension
void f5() { sweep(circle, p2, sphere); }                                   // dimension
void f6() { sweep(circle, p2, sphere, p3); }                               // dimension
void f7() { sweep(circle, motion, sphere); }                               // dimension
void f8() { sweep(circle, pose, pose, sphere, pose, pose); }               // dimension
void f9() { sweep(circle, p3, square); }                                   // motion
void f10() { sweep(circle, p2, p2, square, p2, p2); }                      // Pose
void f11() { sweep(circle, pose, pose, square, p2, p2); }                  // Pose
void f12() { certify(circle, sphere, answer); }                            // dimension
void f13() { raycast(ray, sphere); }                                       // dimension
void f14() { contains(circle, p3); }                                       // dimension
float f15() { return closest(circle, p3).distance; }                       // second_argument
void f16() { overlaps(ground, ground); }                                   // half_space
void f17() { if (closest(at(ground, pose), ground).distance > 0) f1(); }   // half_space
void f18() { overlaps(thing, circle); }                                    // first_argument_is_no_shape
void f19() { overlaps(circle, p2); }                                       // second_argument_is_no_shape
void f20() { contact(circle, 3); }                                         // second_argument_is_no_shape
void f21() { raycast(ray, thing); }                                        // no_shape
void f22() { contains(thing, p2); }                                        // no_shape
void f23() { at(circle, p2); }                                             // Pose
void f24() { at(thing, pose); }                                            // no_shape
void f25() { rounded(thing, 1); }                                          // no_shape
void f26() { world.add(sphere); }                                          // dimension
void f27() { world.add(sphere, {.fixed = true}); }                         // dimension
void f28() { world.add(thing); }                                           // no_shape
void f29() { world.set_shape(id, sphere); }                                // dimension
void f30() { world.sweep(sphere, p2); }                                    // dimension
void f31() { world.closest(sphere); }                                      // dimension
void f32() { world.closest(p3); }                                          // no_shape
void f33() { world.overlapping(sphere); }                                  // dimension
void f34() { world.each_overlapping(sphere, [](Id) {}); }                  // dimension
void f35() { world.move(id, p2); }                                         // Pose
void f36() { world.move(id, Pose3{}); }                                    // Pose
void f37() { world.sweep(circle, p2, p2); }                                // Pose
void f38() { world.add(world.shape(id)); }                                 // any_shape
void f39() { world.set_shape(id, stretched(world.shape(id), {1, 0.5f})); } // any_shape
Box2 f40() { return {p2, p2, 0.785f}; }                                    // Turn
Pose2 f41() { return {p2, 0.785f}; }                                       // Turn
void f42() { world.move(id, {p2, 0.785f}); }                               // Pose
void f43() { world.add(circle, {.pose = {p2, 0.785f}}); }                  // Turn
void f44() { at(circle, {p2, 0.785f}); }                                   // Pose
void f46() { world.sweep(circle, p3); }                                      // Pose
void f45() { stretched(thing, p2); }                                       // no_shape
