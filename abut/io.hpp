#pragma once

// All of abut::io: files to plain structs.

#include <abut/io/read_scene.hpp>
#include <abut/io/scene.hpp>
