#pragma once

#include <abut/bake/outline_sweep.hpp>

namespace abut::outline {

/// Exchanges the edge between two triangles for the other diagonal of their quadrilateral wherever that is one and is
/// shorter, until none is. The thin triangles of a sweep become triangles of neighbours.
void shorten_edges(Triangulation& triangles);

}  // namespace abut::outline
