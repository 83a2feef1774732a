#pragma once

// All of abut::io: files to plain structs.

#include <abut/io/level.hpp>
#include <abut/io/read_level.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/read_walk_mesh.hpp>
#include <abut/io/scene.hpp>
#include <abut/io/write_file.hpp>
#include <abut/io/write_gltf.hpp>
#include <abut/io/write_mesh.hpp>
#include <abut/io/write_obj.hpp>
