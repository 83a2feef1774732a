#pragma once

// The verbs of the tool. Each prints its report on stdout and returns the exit code. A Problem's message is the line
// for stderr, without the prefix "abut: ".

#include "tool/check/settings.hpp"
#include "tool/shared/files.hpp"
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
    std::vector<std::string> scenes;    ///< files, folders, and "-" for a list on stdin
    Settings settings;                  ///< of the command line
    std::optional<std::string> config;  ///< instead of the abut.toml of each file; empty: none
    bool json = false, github = false;
    std::optional<std::string> sarif, junit;   ///< files to write
    std::optional<std::string> page, picture;  ///< files to write, of one scene: HTML and SVG
    std::size_t threads = 0;                   ///< 0: one for each core
};

Result<ExitCode> run_check(const CheckRequest& request);

struct InitRequest {
    std::string scene;
    Settings settings;
};

/// Writes an abut.toml beside the scene, with these settings, that ignores what is found now.
Result<ExitCode> run_init(const InitRequest& request);

struct CastRequest {
    std::string scene;
    std::optional<std::string> picture;  ///< SVG file to write
    std::optional<double> time;          ///< default: the first time
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
    std::uint32_t max_vertices = 0;  ///< per hull; 0: no limit
    bool each = false;               ///< one hull per object
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_hull(const HullRequest& request);

struct DecomposeRequest {
    std::string mesh, output;
    std::optional<std::string> picture;  ///< SVG file to write
    std::uint32_t max_parts = 32;
    double concavity = 0.05;
    std::uint32_t max_vertices = 64;  ///< per part
    bool rooms = false;               ///< closed surfaces that face inwards stay as they are
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_decompose(const DecomposeRequest& request);

struct FixRequest {
    std::string mesh, output;
    bool json = false;
    FileOptions files;
};

/// Welds corners, removes duplicate triangles and those of zero area, and orients closed surfaces outwards.
Result<ExitCode> run_fix(const FixRequest& request);

/// A slice perpendicular to an axis (0 to 2) at a coordinate.
struct FieldSlice {
    int axis = 0;
    float at = 0;
};

struct FieldRequest {
    std::string mesh, output;
    std::optional<std::string> picture;  ///< SVG file to write
    std::vector<FieldSlice> slices;      ///< for the picture; default: the middle of each axis
    float cell = 0;                      ///< 0: 1/64 of the longest side
    float padding = 3, band = 3;         ///< in cells
    bool dense = false, gradient = false, quantised = false;
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_field(const FieldRequest& request);

/// File extension of a field.
inline constexpr std::string_view field_ending = ".field";

/// Prints the contents of a field file.
Result<ExitCode> run_field_info(const InfoRequest& request);

struct WalkRequest {
    std::string mesh;
    std::string name;                            ///< a glob pattern for nodes and meshes; empty: all
    std::optional<std::string> output, picture;  ///< files to write: the baked mesh, and an SVG
    std::optional<Vec3> from, to;                ///< both or neither
    std::optional<float> reach;                  ///< maximum distance of both from the mesh; default: any
    bool json = false;
    FileOptions files;
};

Result<ExitCode> run_walk(const WalkRequest& request);

/// File extension of a walk mesh.
inline constexpr std::string_view walk_ending = ".walk";

struct ReplayRequest {
    std::string file;
    std::size_t max_differences = 10;
    bool json = false;
};

Result<ExitCode> run_replay(const ReplayRequest& request);

/// Formats a line for stderr: "abut: ", the message made printable, and a newline.
std::string one_line(const std::string& message);

/// Writes a file. The message of a Problem begins with the file.
std::optional<Problem> write_picture(const std::string& file, const std::string& document);

/// Writes text to stdout and returns the exit code; a Problem if writing fails.
Result<ExitCode> print(const std::string& text, ExitCode code);

}  // namespace abut::tool
