// A world: ids, filters, callbacks, the events of an update, and rollback.
import assert from 'node:assert/strict';
import { load } from 'abut';

const abut = await load();
const WALLS = 1, PLAYERS = 2;
const world = new abut.World2();
const door = world.add(abut.Box2([4, 0], [1, 1]), { fixed: true, sensor: true, user: 77 });
world.add(abut.Box2([8, 0], [0.5, 5]), { fixed: true, layers: WALLS });
const player = world.add(abut.Circle([0, 0], 0.5), { layers: PLAYERS });

const seen = [];
for (let step = 0; step < 8; ++step) {
    world.move(player, { position: [step, 0] });
    const { began, ended } = world.update();
    for (const _ of began) seen.push(`enter ${step}`);
    for (const _ of ended) seen.push(`leave ${step}`);
}
console.log(seen.join(', '));
assert.deepEqual(seen, ['enter 3', 'leave 6', 'enter 7']);
assert.equal(world.options(door).user, 77n);

// The player looks along x, but not at itself. A sensor hides nothing.
const ray = { origin: [7, 0], direction: [1, 0], length: 100 };
const hit = world.raycast(ray, { ignore: player, mask: WALLS });
console.log(`a wall ${hit.hit.distance} ahead`);
assert.equal(hit.hit.distance, 0.5);
assert.equal(world.raycast(ray, { accepts: () => false }), null);
assert.equal(world.raycast(ray, { ignore_ids: [player, hit.id] }), null);

const snapshot = world.save();
world.remove(player);
assert.ok(!world.contains(player));
world.restore(snapshot);
assert.ok(world.contains(player));
assert.equal(world.k_nearest(abut.Circle([0, 0], 1), 2).length, 2);

// What is wrong has a code and a message.
assert.throws(() => world.move({ index: 99, generation: 1 }, { position: [0, 0] }), { code: 'STALE_ID' });
assert.throws(() => world.add(abut.Circle([NaN, 0], 1)), { code: 'NOT_FINITE' });
assert.throws(() => abut.overlaps(abut.Circle([0, 0], 1), abut.Sphere([0, 0, 0], 1)), /a shape of the plane is needed/);
assert.throws(() => world.add(abut.Circle([0, 0], 1), { fixd: true }), /no member fixd/);
world.set_pair_filter(() => false);
assert.equal(world.update().stayed.length, 0);
world.dispose();
assert.throws(() => world.size(), /was disposed of/);
