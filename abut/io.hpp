#pragma once

// All of abut::io: files to plain structs.

#include <abut/io/level.hpp>
#include <abut/io/read_level.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/io/scene.hpp>
