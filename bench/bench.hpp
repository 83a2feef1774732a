#pragma once

// What a row of the table is made of: one job, and several sides that do it.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace abut::bench {

/// Does the job once and tells what came out, one number for each value the job asks for. The same call is verified and
/// timed.
using Ask = std::function<void(std::span<double> values)>;

/// The side that is whichever of abut's others it chooses.
inline constexpr const char* chosen_side = "abut chosen";

/// What else is to be known of a side, such as how good its answers are.
struct Figure {
    std::string name;
    double value = 0;
};

struct Side {
    std::string who;  ///< "abut" or the peer
    Ask ask;
    std::function<void()> prepare = nullptr;  ///< before each call, not timed: what happens to all sides alike
    double strays = 0;                        ///< the share of its values that is known to be off, and forgiven
    std::function<std::vector<Figure>()> figures = nullptr;  ///< asked once, not timed
};

/// A job with all that do it, ready to run. The first side is abut, the one the others are compared with.
struct Job {
    std::size_t items = 0;     ///< a call answers for so many: what the time is divided by
    std::size_t values = 0;    ///< a call tells so many numbers
    std::size_t rounds = 1;    ///< how many calls are verified
    std::size_t frames = 0;    ///< 0: every call is like the first. Else so many calls a repetition are timed (two of
                               ///< a slow side), and all count: what a side does only now and then, to keep its tree in
                               ///< order, is paid for
    bool on_the_wall = false;  ///< the time that passes counts, not the processor's: for what runs on several threads
    double tolerance = 1e-3;   ///< how far two sides' values may lie apart
    std::vector<Side> sides;
};

struct Bench {
    std::string name;           ///< group/what/...
    std::function<Job()> make;  ///< the scene and the sides, made when it is their turn
};

std::vector<Bench> narrow_benches();
std::vector<Bench> broad_benches();
std::vector<Bench> motion_straight_benches();
std::vector<Bench> motion_turning_benches();
/// Rays at meshes, and building for them.
std::vector<Bench> ray_benches();
/// In which order things can be taken away.
std::vector<Bench> removal_benches();
/// Shapes at the ground of a level.
std::vector<Bench> level_benches();
/// Characters that walk over levels.
std::vector<Bench> levels_mover_benches();
/// Convex hulls in space.
std::vector<Bench> convex_hull_benches();
/// Meshes cut into convex parts.
std::vector<Bench> convex_solid_benches();
/// Outlines as convex parts.
std::vector<Bench> convex_plane_benches();
/// Convex hulls in the plane, and those of few corners.
std::vector<Bench> convex_hull_plane_benches();
/// Fields of distances, baked.
std::vector<Bench> field_bake_benches();
/// The same, looked up.
std::vector<Bench> field_sample_benches();
/// The same as shapes.
std::vector<Bench> field_shape_benches();
/// Particles over a field.
std::vector<Bench> field_particle_benches();
/// Walkers on a walk mesh.
std::vector<Bench> walk_step_benches();
/// Its nearest places.
std::vector<Bench> walk_nearest_benches();
/// Ways over it.
std::vector<Bench> walk_path_benches();

}  // namespace abut::bench
