// A step of a world of 10,000 moving boxes in space: which pairs overlap after it. No peer resolves collisions: its bodies are sensors.
import RAPIER from '@dimforge/rapier3d-compat';
import * as cat from 'crashcat';
import { random_of, row } from './measure.mjs';

const COUNT = 10000;
const SIDE = 60;
const STEP = 1 / 60;
// After how many steps the numbers of pairs are compared. The peers report where the bodies stood before a step.
const STEPS = 10;

/** Positions, rotations and velocities; the boxes fly apart and together, and stay within a few lengths. */
function bodies(random) {
    return Array.from({ length: COUNT }, () => {
        const rotation = Array.from({ length: 4 }, () => random(-1, 1));
        const length = Math.hypot(...rotation);
        return {
            position: Array.from({ length: 3 }, () => random(0, SIDE)),
            rotation: rotation.map((x) => x / length),
            velocity: Array.from({ length: 3 }, () => random(-3, 3)),
        };
    });
}

export default async function world(abut) {
    await RAPIER.init();
    cat.registerAll();
    const all = bodies(random_of(13));
    const makers = [
        ['step and events', () => abut_world(abut, all, false), 0],
        ['abut, with contacts', () => abut_world(abut, all, true), 0],
        ['Rapier', () => rapier_world(all), 1],
        ['crashcat', () => crashcat_world(all), 1],
    ];
    const contenders = makers.map(([name, make, lag]) => {
        const counted = make();
        for (let i = 0; i < STEPS + lag; ++i) counted.step();
        const pairs = counted.pairs();
        counted.free();
        const timed = make();
        timed.step();
        return [name, () => [pairs / 1000], () => timed.step()];
    });
    row('world step, 10,000 moving boxes', 1, contenders, { tolerance: 0.01, once: true });
}

function abut_world(abut, all, with_contacts) {
    const world = new abut.World3();
    const box = abut.build(abut.Box3([0, 0, 0], [0.5, 0.4, 0.3]));
    const poses = Float32Array.from(all.flatMap(({ position, rotation }) => [...position, ...rotation]));
    const velocities = all.map((body) => body.velocity);
    const ids = world.add_many(
        box,
        all.map(({ position, rotation }) => ({ pose: { position, rotation } })),
    );
    let pairs = 0;
    return {
        step() {
            for (let i = 0; i < COUNT; ++i) for (let k = 0; k < 3; ++k) poses[7 * i + k] += velocities[i][k] * STEP;
            world.move_many(ids, poses);
            const { began, ended } = world.update().columns;
            pairs += (began.length - ended.length) / 4;
            if (with_contacts) world.contacts_columns();
        },
        pairs: () => pairs,
        free: () => world.dispose(),
    };
}

function rapier_world(all) {
    const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
    world.timestep = STEP;
    const queue = new RAPIER.EventQueue(true);
    for (const { position, rotation, velocity } of all) {
        const [x, y, z, w] = rotation;
        const body = world.createRigidBody(
            RAPIER.RigidBodyDesc.dynamic()
                .setTranslation(...position)
                .setRotation({ x, y, z, w })
                .setLinvel(...velocity)
                .setCanSleep(false),
        );
        world.createCollider(
            RAPIER.ColliderDesc.cuboid(0.5, 0.4, 0.3).setSensor(true).setActiveEvents(RAPIER.ActiveEvents.COLLISION_EVENTS),
            body,
        );
    }
    let pairs = 0;
    return {
        step() {
            world.step(queue);
            queue.drainCollisionEvents((_a, _b, started) => {
                pairs += started ? 1 : -1;
            });
        },
        pairs: () => pairs,
        free: () => world.free(),
    };
}

function crashcat_world(all) {
    const settings = cat.createWorldSettings();
    const layer = cat.addObjectLayer(settings, cat.addBroadphaseLayer(settings));
    cat.enableCollision(settings, layer, layer);
    settings.gravity = [0, 0, 0];
    const world = cat.createWorld(settings);
    const shape = cat.box.create({ halfExtents: [0.5, 0.4, 0.3], convexRadius: 0 });
    for (const { position, rotation, velocity } of all) {
        const body = cat.rigidBody.create(world, {
            motionType: cat.MotionType.DYNAMIC,
            shape,
            objectLayer: layer,
            position,
            quaternion: rotation,
            sensor: true,
            linearDamping: 0,
            allowSleeping: false,
        });
        cat.rigidBody.setLinearVelocity(world, body, velocity);
    }
    let pairs = 0;
    const listener = { onContactAdded: () => ++pairs, onContactRemoved: () => --pairs };
    return { step: () => cat.updateWorld(world, listener, STEP), pairs: () => pairs, free: () => {} };
}
