#pragma once

// All of abut::draw: pictures of shapes and answers, on a canvas that you fill.

#include <abut/draw/canvas.hpp>
#include <abut/draw/draw.hpp>
#include <abut/draw/projected.hpp>
#include <abut/draw/svg.hpp>
#include <abut/draw/trace.hpp>
#include <abut/draw/voronoi.hpp>
#include <abut/draw/walk_mesh.hpp>
#include <abut/draw/world.hpp>
