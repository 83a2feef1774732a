// Distances, contacts and rays of single shapes: plain objects in and out.
import assert from 'node:assert/strict';
import { load } from 'abut';

const abut = await load();
const ball = abut.Sphere([0, 0, 0], 1);
const crate = abut.Box3([3, 0, 0], [0.5, 0.5, 0.5]);

console.log(abut.overlaps(ball, crate) ? 'they touch' : 'they are apart');
const gap = abut.closest(ball, crate);
console.log(`the gap is ${gap.distance}, from ${gap.on_a} to ${gap.on_b}`);
assert.ok(abut.certify(ball, crate, gap).holds);
assert.equal(abut.closest(ball, [0, 0, 3]).distance, 2);
assert.equal(abut.contact(ball, crate), null);

const moved = abut.at(crate, { position: [-1.75, 0, 0] });
const contact = abut.contact(ball, moved);
for (const point of contact.points) console.log(`${point.depth} deep at ${point.position}`);
assert.equal(contact.depth, 0.25);
assert.equal(abut.contact(ball, crate, { margin: 2 }).depth, -1.5);

const ray = { origin: [-5, 0, 0], direction: [1, 0, 0], length: Infinity };
assert.equal(abut.raycast(ray, ball).distance, 4);
assert.equal(abut.sweep(ball, [9, 0, 0], crate).distance, 1.5);

// The overlap itself, a plain polyhedron again.
const common = abut.intersection(crate, abut.Box3([3.5, 0, 0], [0.5, 0.5, 0.5]));
console.log(`they share a volume of ${common.volume}`);
assert.equal(common.volume, 0.5);
assert.ok(abut.contains(common, [3.25, 0, 0]));
const parts = abut.decompose_outline([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [3, 1], [3, 3], [1, 3]]]);
assert.equal(parts.reduce((sum, part) => sum + part.area, 0), 12);
