#pragma once

// All of abut::bake: slow work before the game starts.

#include <abut/bake/combine_fields.hpp>
#include <abut/bake/decompose.hpp>
#include <abut/bake/decompose_outline.hpp>
#include <abut/bake/field.hpp>
#include <abut/bake/fit.hpp>
#include <abut/bake/repair.hpp>
#include <abut/bake/solid.hpp>
#include <abut/shape/weld.hpp>
