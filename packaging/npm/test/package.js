// The package: that each function of the C API has a place, that questions leave no memory behind, and what it says of wrong input.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { load } from 'abut';

const api = JSON.parse(await readFile(new URL('../abut_api.json', import.meta.url)));
const wasm = await WebAssembly.compile(await readFile(new URL('../abut.wasm', import.meta.url)));
const abut = await load(wasm, api);

// Each function is exported; nothing but these and the memory is.
const exported = WebAssembly.Module.exports(wasm).map((entry) => entry.name);
for (const { name } of api.functions) assert.ok(exported.includes(name), name);
assert.deepEqual(exported.filter((name) => !name.startsWith('abut_')).sort(), [
    '__indirect_function_table',
    '_initialize',
    'free',
    'malloc',
    'memory',
]);
const methods = (cls) => Object.getOwnPropertyNames(cls.prototype).length;
assert.ok(methods(abut.World3) + methods(Object.getPrototypeOf(abut.World3)) > 45);

// Questions about plain shapes are freed at once.
const ball = abut.rounded(abut.at(abut.Box3([0, 0, 0], [1, 1, 1]), { position: [1, 0, 0] }), 0.5);
const bytes = () => process.memoryUsage().arrayBuffers + process.memoryUsage().external;
abut.closest(ball, [9, 0, 0]);
const before = bytes();
for (let i = 0; i < 20000; ++i) abut.closest(ball, [9, 0, 0]);
assert.equal(abut.closest(ball, [9, 0, 0]).distance, 6.5);
assert.ok(bytes() - before < 1 << 20, `${bytes() - before} bytes more`);

// Large arrays make the memory grow in the middle of a call.
const points = new Float32Array(3 * 300000).fill(1);
points[3 * 299999] = 9;
const { distance, on_a } = abut.closest_to_points(abut.Sphere([0, 0, 0], 1), points);
assert.equal(distance.length, 300000);
assert.equal(on_a.length, 900000);
assert.ok(Math.abs(distance[299999] - (Math.sqrt(83) - 1)) < 1e-5);

// Both forms of an array, and strict ones.
const two = [
    [0, 0, 0],
    [3, 0, 0],
];
assert.deepEqual(abut.contains_many(abut.Sphere([0, 0, 0], 1), two), Uint8Array.of(1, 0));
assert.deepEqual(abut.contains_many(abut.Sphere([0, 0, 0], 1), two.flat()), Uint8Array.of(1, 0));
assert.throws(() => abut.contains_many(abut.Sphere([0, 0, 0], 1), [0, 0]), RangeError);
assert.throws(
    () =>
        abut.contains_many(abut.Sphere([0, 0, 0], 1), [
            [0, 0, 0],
            [NaN, 0, 0],
        ]),
    { code: 'NOT_FINITE', index: 1, message: 'points[1] is not finite' },
);
assert.throws(() => abut.overlaps(abut.Sphere([0, 0, 0], 1)), TypeError);
assert.throws(() => abut.overlaps(abut.Sphere([0, 0, 0], 1), { type: 'blob' }), /a shape is needed, not blob/);
assert.throws(() => abut.Box3([0, 0, 0]) && abut.bounds(abut.Box3([0, 0], [1, 1, 1])), /an array of 3 numbers/);
assert.throws(() => abut.contact(abut.Circle([0, 0], 1), abut.Circle([0, 0], 1), { depth: 1 }), /no member depth/);
assert.throws(() => abut.Mesh([[0, 0, 0]], [[0, 1, 2]]), { code: 'INDEX_OUT_OF_RANGE' });
await assert.rejects(load(new Uint8Array([1, 2, 3])));

// Lists longer than the first try, and what dispose frees.
const world = new abut.World3();
for (let i = 0; i < 200; ++i) world.add(abut.Sphere([0, 0, 0], 1));
assert.equal(world.overlapping(abut.Sphere([0, 0, 0], 1)).length, 200);
assert.equal(world.k_nearest(abut.Sphere([0, 0, 0], 1), 3).length, 3);
const visited = [];
world.each_overlapping(abut.Sphere([0, 0, 0], 1), (id) => visited.push(id.index) < 5);
assert.equal(visited.length, 5);
const copy = world.copy();
world.dispose();
world.dispose();
assert.equal(copy.size(), 200);
assert.ok(copy instanceof abut.World3);
copy.dispose();
const used = new abut.World2();
used[Symbol.dispose ?? Symbol.for('Symbol.dispose')]();
assert.throws(() => used.size(), /this World2 was disposed of/);

// Lists of objects have a form of typed arrays, also longer than the first try; the events have both.
const pile = new abut.World3();
const options = Array.from({ length: 100 }, (_, i) => ({ pose: { position: [i, 0, 0] } }));
const ids = pile.add_many(abut.Sphere([0, 0, 0], 0.625), options);
assert.equal(ids.length, 200);
const events = pile.update();
assert.equal(events.columns.began.length, 4 * 99);
assert.deepEqual(events.began[7], { a: { index: 8, generation: ids[15] }, b: { index: 9, generation: ids[17] } });
assert.equal(events.began, events.began);
assert.deepEqual([events.stayed, events.ended, events.fractions.length], [[], [], 99]);
const contacts = pile.contacts();
const columns = pile.contacts_columns();
assert.equal(contacts.length, 99);
assert.deepEqual([columns.a.length, columns.contact.depth.length, columns.contact.points[0].position.length], [198, 99, 297]);
assert.equal(columns.contact.depth[50], contacts[50].contact.depth);
assert.deepEqual([...columns.b.subarray(2, 4)], [contacts[1].b.index, contacts[1].b.generation]);
assert.equal(pile.items_columns().length, 200);
const poses = new Float32Array(700).map((_, i) => (i % 7 === 6 ? 1 : i % 7 === 0 ? 2 * i : 0));
pile.move_many(ids, poses);
assert.equal(pile.update().columns.ended.length, 4 * 99);
assert.throws(() => pile.move_many(ids, poses.subarray(7)), /poses has 99 elements, where 100 are needed/);

// Calls within callbacks, and errors in the middle of them, leave the outer call whole.
let inner = 0;
const found = pile.overlapping(abut.Sphere([0, 0, 0], 9), {
    accepts: (id) => {
        inner += abut.closest(abut.Sphere([0, 0, 0], 1), [4, 0, 0]).distance;
        assert.throws(() => abut.overlaps(abut.Sphere([0, 0, 0], 1), abut.Sphere([0, 0], 1)), TypeError);
        return id.index % 2 === 1;
    },
});
assert.ok(found.length > 0 && inner >= 3 * found.length);
pile.dispose();

// What objects may leave out, and what they may not have.
assert.deepEqual(abut.bounds(abut.at(abut.Box3([0, 0, 0], [1, 1, 1]), {})).min, [-1, -1, -1]);
assert.throws(
    () => abut.overlaps({ type: 'box3', center: [0, 0, 0], half: [1, 1, 1], rotatoin: [0, 0, 0, 1] }, ball),
    /no member rotatoin/,
);

// The entries of one dimension have what is theirs, and the same answers; the inline entry has all.
const wasm_of = async (name) =>
    WebAssembly.Module.exports(await WebAssembly.compile(await readFile(new URL(`../${name}.wasm`, import.meta.url)))).map(
        (entry) => entry.name,
    );
assert.ok(!(await wasm_of('abut2d')).some((name) => /3|walk_mesh/.test(name)));
assert.ok(!(await wasm_of('abut3d')).some((name) => /abut_\w+2_/.test(name)));
const [plane, space, both] = await Promise.all(['abut/2d', 'abut/3d', 'abut/inline'].map(async (name) => (await import(name)).load()));
assert.deepEqual(
    space.closest(space.at(space.Box3([0, 0, 0], [1, 2, 1]), { position: [3, 0, 0] }), [9, 0, 0]),
    both.closest(both.at(both.Box3([0, 0, 0], [1, 2, 1]), { position: [3, 0, 0] }), [9, 0, 0]),
);
assert.equal(plane.closest(plane.Circle([0, 0], 1), plane.Box2([3, 0], [1, 1])).distance, 1);
assert.ok(!('Sphere' in plane) && !('Circle' in space) && 'WalkMesh' in space && 'Circle' in both);
assert.throws(() => plane.overlaps(plane.Circle([0, 0], 1), both.Sphere([0, 0, 0], 1)), TypeError);
console.log(`abut ${abut.version}: ${api.functions.length} functions`);
