#pragma once

// A row of the table: one job, and several sides that do it.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace abut::bench {

/// Does the job once and writes one number per value of the job. The same call is verified and timed.
using Run = std::function<void(std::span<double> values)>;

/// The side in which abut chooses one of its structures.
inline constexpr const char* chosen_side = "abut chosen";

/// Additional figures of a side, such as the accuracy of its answers.
struct Figure {
    std::string name;
    double value = 0;
};

struct Side {
    std::string who;  ///< "abut" or the peer
    Run run;
    std::function<void()> prepare =
        nullptr;        ///< called before each call, not timed: changes that are the same for all sides
    double strays = 0;  ///< tolerated fraction of values that differ from abut's
    std::function<std::vector<Figure>()> figures = nullptr;  ///< called once, not timed
};

/// A job with all its sides, ready to run. The first side is abut, the reference for ratios.
struct Job {
    std::size_t items = 0;   ///< items per call; times are divided by this
    std::size_t values = 0;  ///< numbers that a call writes
    std::size_t rounds = 1;  ///< count of calls that are verified
    std::size_t frames = 0;  ///< 0: all calls are equal. Else this many calls per repetition are timed (two for a slow
                             ///< side), and all count: occasional work to maintain a tree is included
    bool on_the_wall = false;  ///< wall-clock time instead of processor time: for several threads
    double tolerance = 1e-3;   ///< maximum difference of two sides' values
    std::vector<Side> sides;
};

struct Bench {
    std::string name;           ///< group/subject/...
    std::function<Job()> make;  ///< makes the scene and the sides, called when the job runs
};

std::vector<Bench> narrow_benches();
std::vector<Bench> broad_benches();
std::vector<Bench> motion_linear_benches();
std::vector<Bench> motion_rotation_benches();
/// Ray casts against meshes, and building their trees.
std::vector<Bench> ray_benches();
/// Sweeps of one shape at a mesh.
std::vector<Bench> mesh_sweep_benches();
/// Sweeps of one shape at a chain.
std::vector<Bench> chain_sweep_benches();
/// Disassembly order.
std::vector<Bench> removal_benches();
/// Shapes against the ground of a level.
std::vector<Bench> level_benches();
/// Loading of levels from bytes.
std::vector<Bench> level_load_benches();
/// Characters that walk over levels.
std::vector<Bench> levels_mover_benches();
/// Convex hulls in 3D.
std::vector<Bench> convex_hull_benches();
/// Convex decomposition of meshes.
std::vector<Bench> convex_solid_benches();
/// Convex decomposition of polygons.
std::vector<Bench> convex_plane_benches();
/// Convex hulls in 2D, and hulls with a vertex limit.
std::vector<Bench> convex_hull_plane_benches();
/// Baking of signed distance fields.
std::vector<Bench> field_bake_benches();
/// Sampling of signed distance fields.
std::vector<Bench> field_sample_benches();
/// Signed distance fields as shapes.
std::vector<Bench> field_shape_benches();
/// Particles above a field.
std::vector<Bench> field_particle_benches();
/// Walkers on a walk mesh.
std::vector<Bench> walk_step_benches();
/// Closest points on a walk mesh.
std::vector<Bench> walk_nearest_benches();
/// Paths over a walk mesh.
std::vector<Bench> walk_path_benches();

}  // namespace abut::bench
