#pragma once

// The C API of abut: all of it. Each header can be included by itself as well; types.h states the rules of all
// functions. abut_api.json describes the same for programs that generate bindings; make_api_json.py writes it.
//
// Arguments of one name mean the same in all functions:
//   a, b: two shapes or places, of which an answer's normal or direction leads from a to b
//   accepts: called for items or pairs, and returns whether they count
//   answer: an answer of `closest` for the same two shapes
//   areas: a number for each triangle, the index of its cost in paths
//   axis: a unit vector
//   ball, box, capsule, cone, cylinder, half_space, segment, triangle: the values of the shape
//   buffer: receives bytes in place of those it has
//   bytes: what a save function has written
//   capacity: the number of elements that the output array has place for
//   cell: the size of a cell along each axis, above 0
//   children: the parts of the compound
//   closed: whether the last point is joined to the first
//   columns: the number of elements in a row
//   concavity: how deep corners may lie below the edges of a part; a length of at least 0
//   context: passed to the callback
//   continuous, enabled, fixed, sensor: the new value of the option
//   count: the number of elements; as an output the full length of the list
//   ends: for each list, the index behind its last element
//   faces, triangles: point numbers, as many for each as it has corners
//   field: the distance field
//   filter: the items that the query takes into account
//   found: whether there is an answer
//   fraction: of the motion, in [0, 1]
//   from, to: where the motion or path begins and ends
//   group: the number of the group; 0 is none
//   heights: along z, row by row
//   hit: an answer of `raycast`
//   holes: the numbers of cells without triangles
//   id, ids: items of the world
//   index: the number of the element, from 0
//   layers: the layers and the mask, one bit each
//   light: the position of the light
//   max_vertices: the limit on the number of vertices; 0 is none
//   mesh: the mesh
//   motion, motion_a, motion_b, motions: the translation, or the motion with rotation
//   normal, normals: unit vectors out of the surface
//   nx, ny, nz: the number of voxels along each axis
//   one_sided: whether only the right side of each segment collides
//   options: the options; null means the defaults
//   out: receives the answer
//   pair: two items, the lower id first
//   place, places: places on the walk mesh
//   point, points: positions
//   pool: the threads that share the work; null means the calling one
//   pose, poses: positions with rotations
//   radians: the angle, counter-clockwise
//   radius: a length of at least 0
//   ray, rays: the rays, whose directions are unit vectors
//   reach: a length of at least 0, up to which obstacles count
//   scale: a factor for each axis
//   shape, shapes: the shape of the question, or the list of shapes
//   sides: half-spaces, those of one brush after the other
//   size: the number of bytes
//   softness: the light's radius divided by its distance, at least 0
//   solid: a byte for each voxel, 0 if it is empty
//   step, steps: the translations of walks, in space
//   stride, id_stride, pose_stride, place_stride, step_stride: from element to element, in bytes; 0: they are adjacent
//   brush_count, face_count, hole_count, id_count, point_count, ring_count: how many there are
//   side_count, triangle_count: how many there are
//   tiles: an abut_tile for each cell
//   tolerance: a length above 0
//   user: the game's own number of the item
//   visit: called for each element; returns false to stop
//   workers: the number of threads
//   world: the world

#include <abut/c/bake.h>
#include <abut/c/field.h>
#include <abut/c/query.h>
#include <abut/c/shape.h>
#include <abut/c/types.h>
#include <abut/c/walk_mesh.h>
#include <abut/c/world.h>
