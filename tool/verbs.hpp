#pragma once

// The verbs of the tool. Each prints its report on stdout and returns what the program exits with; what goes wrong
// comes back as the one line for stderr, without the "abut: " before it.

#include "check.hpp"
#include "faults.hpp"
#include "files.hpp"
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abut::tool {

enum ExitCode : int { fine = 0, found = 1, unusable = 2 };

struct CheckRequest {
    std::string scene;
    std::optional<std::string> baseline;
    std::optional<std::size_t> frames;  ///< none: the file's own key times
    bool json = false;
    FileOptions files;
    CheckOptions options;
    FaultOptions faults;  ///< without what the other options tell as well
};

Result<ExitCode> run_check(const CheckRequest& request);

struct CastRequest {
    std::string scene;
    std::optional<std::string> picture;  ///< a file to write one to, as SVG
    std::optional<double> time;          ///< none: the first moment
    bool json = false;
    FileOptions files;
    std::string from, to;  ///< X,Y,Z, or X,Y in a level
    std::size_t bounces = 0;
    bool all = false;
};

Result<ExitCode> run_cast(const CastRequest& request);

struct InfoRequest {
    std::string scene;
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_info(const InfoRequest& request);

struct HullRequest {
    std::string mesh, output;
    std::uint32_t max_vertices = 0;  ///< of each hull; 0: no limit
    bool each = false;               ///< one hull an object
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_hull(const HullRequest& request);

struct DecomposeRequest {
    std::string mesh, output;
    std::optional<std::string> picture;  ///< a file to write one to, as SVG
    std::uint32_t max_parts = 32;
    double concavity = 0.05;
    std::uint32_t max_vertices = 64;  ///< of each part
    bool rooms = false;               ///< surfaces that are seen from inside stay as they are
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_decompose(const DecomposeRequest& request);

/// Across an axis, 0 to 2, at a coordinate.
struct FieldSlice {
    int axis = 0;
    float at = 0;
};

struct FieldRequest {
    std::string mesh, output;
    std::optional<std::string> picture;  ///< a file to write one to, as SVG
    std::vector<FieldSlice> slices;      ///< for the picture; none: the middle of each axis
    float cell = 0;                      ///< 0: a 64th of the longest side
    float padding = 3, band = 3;         ///< in cells
    bool dense = false, gradient = false, quantised = false;
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_field(const FieldRequest& request);

/// How the name of a file ends that holds a field.
inline constexpr std::string_view field_ending = ".field";

/// What is in such a file.
Result<ExitCode> run_field_info(const InfoRequest& request);

struct WalkRequest {
    std::string mesh;
    std::string name;                            ///< a pattern for nodes and meshes; empty: all
    std::optional<std::string> output, picture;  ///< files to write to: the baked mesh, and an SVG
    std::optional<Vec3> from, to;                ///< both or none
    std::optional<float> reach;                  ///< how far off the mesh they may be; none: any distance
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_walk(const WalkRequest& request);

/// How the name of a file ends that holds a walk mesh.
inline constexpr std::string_view walk_ending = ".walk";

/// How a line on stderr is written: with "abut: " before it and the end of a line behind it, all on one.
std::string one_line(std::string message);

/// A whole file, or what is wrong with it, beginning with the file.
std::optional<Problem> write_picture(const std::string& file, const std::string& document);

/// Everything at once on stdout.
Result<ExitCode> print(const std::string& text, ExitCode code);

}  // namespace abut::tool
