// Ten thousand rays at once, from a typed array into typed arrays.
import assert from 'node:assert/strict';
import { load } from 'abut';

const abut = await load();
let seed = 1;
const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
const world = new abut.World3();
const crate = abut.build(abut.Box3([0, 0, 0], [0.5, 0.5, 0.5]));
const ids = [];
for (let i = 0; i < 1000; ++i) ids.push(world.add(crate, { pose: { position: [random(), random(), random()].map((x) => 40 * x - 20) } }));

const count = 10000;
const rays = new Float32Array(7 * count); // origin, direction, length
for (let i = 0; i < count; ++i) {
    const direction = [random() - 0.5, random() - 0.5, random() - 0.5];
    const length = Math.hypot(...direction);
    rays.set([0, 0, 0, ...direction.map((x) => x / length), 50], 7 * i);
}
const start = performance.now();
const { hit } = world.raycast_many(rays);
const milliseconds = performance.now() - start;
const found = hit.found.reduce((sum, one) => sum + one, 0);
console.log(`${found} of ${count} rays hit, in ${milliseconds.toFixed(1)} ms`);
assert.ok(found > 3000 && found < 9000);
for (let i = 0; i < count; i += 100) {
    const [x, y, z] = hit.point.subarray(3 * i);
    if (hit.found[i]) assert.ok(Math.abs(Math.hypot(x, y, z) - hit.distance[i]) < 1e-3);
}
// One by one the answers are the same.
const one = world.raycast({ origin: [0, 0, 0], direction: rays.subarray(3, 6), length: 50 });
assert.equal(one === null ? 0 : 1, hit.found[0]);
if (one) assert.equal(one.hit.distance, hit.distance[0]);

const poses = new Float32Array(7 * ids.length);
for (let i = 0; i < ids.length; ++i) poses.set([10 * random() - 5, 10 * random() - 5, 10 * random() - 5, 0, 0, 0, 1], 7 * i);
world.move_many(ids, poses);
console.log(`${world.update().began.length} pairs touch`);
const { ends, out } = world.overlapping_many(abut.Sphere([0, 0, 0], 2), new Float32Array([0, 0, 0, 0, 0, 0, 1]));
assert.equal(ends[0], out.length);
