// Walks and paths over a surface.
import assert from 'node:assert/strict';
import { load } from 'abut';

const abut = await load();
// A floor with a step up, and a wall that the floor ends at.
const points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [4, 0, 1], [4, 4, 1], [8, 0, 1], [8, 4, 1]];
const triangles = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2], [4, 6, 7], [4, 7, 5]];
const mesh = new abut.WalkMesh(points, triangles);
const here = mesh.nearest([1, 1, 0.5]);
const walked = mesh.walk(here, [5, 0, 0]);
console.log(`walked ${walked.length} to ${walked.position}, over ${walked.crossings} edges`);
assert.deepEqual(walked.position, [5, 1, 1]);

const path = mesh.path(here, mesh.nearest([7, 3, 1]));
console.log(`a path of ${path.out.length.toFixed(3)} with ${path.points.length / 3} points`);
assert.ok(path.out.reached && path.places.length === path.points.length / 3);
const loaded = abut.WalkMesh.load(mesh.save());
assert.deepEqual(loaded.walk(here, [5, 0, 0]), walked);
