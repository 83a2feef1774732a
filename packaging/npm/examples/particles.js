// A distance field of a mesh, for particles and shadows; meshes and fields are handles with `dispose`.
import assert from 'node:assert/strict';
import { load } from 'abut';

const abut = await load();
const corners = [-1, 1].flatMap((z) => [-1, 1].flatMap((y) => [-1, 1].map((x) => [x, y, z])));
const cube = new Uint32Array([0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]);
const mesh = abut.Mesh(corners, cube);
assert.deepEqual(mesh.triangles(), cube);
const field = abut.Field3.bake(mesh, { cell: 0.1 });

let seed = 2;
const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
const particles = new Float32Array(3 * 5000);
for (let i = 0; i < particles.length; ++i) particles[i] = 3 * random() - 1.5 + (i % 3 === 2 ? 3 : 0);
for (let frame = 0; frame < 60; ++frame) {
    for (let i = 2; i < particles.length; i += 3) particles[i] -= 0.05;
    const { distance, normal } = field.sample_many(particles);
    distance.forEach((d, i) => {
        if (d < 0) for (let k = 0; k < 3; ++k) particles[3 * i + k] -= normal[3 * i + k] * d;
    });
}
const deepest = field.distance_many(particles).reduce((least, d) => Math.min(least, d), 0);
console.log(`5000 particles, the deepest ${(-deepest).toFixed(4)} inside`);
assert.ok(deepest > -0.02);
const light = field.shadow_many(particles, [0, 0, 10], 0.05);
console.log(`${light.filter((share) => share < 0.5).length} of them lie in the shadow`);

const same = abut.Field3.load(field.save());
assert.equal(same.distance([0.5, 0.25, 2]), field.distance([0.5, 0.25, 2]));
const parts = abut.decompose_mesh(mesh);
assert.equal(parts.length, 1);
assert.equal(parts[0].volume, 8);
for (const handle of [mesh, field, same]) handle.dispose();
