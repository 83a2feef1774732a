// Pairs of shapes in the plane, one by one, rays against a world of boxes, and a step of a world of 10,000 moving boxes. Box2D's package
// has no questions of two shapes, and its sensors don't see one another.
import RAPIER from '@dimforge/rapier2d-compat';
import Box2D from 'box2d3-wasm';
import * as planck from 'planck';
import { random_of, row } from './measure.mjs';

const COUNT = 1024;
const BOXES = 10000;
const SIDE = 300;
const STEP = 1 / 60;
// The peers report where the bodies stood before a step. Boxes of planck have a skin of 0.01, and some pairs more.
const STEPS = 10;
const TOUCHING = 0.02;

const places = (random, reach, count) =>
    Array.from({ length: count }, () => {
        const angle = random(-3, 3);
        return { position: [random(-reach, reach), random(-reach, reach)], angle, rotation: [Math.cos(angle), Math.sin(angle)] };
    });
const xy = ([x, y]) => ({ x, y });

export default async function plane(abut) {
    await RAPIER.init();
    const random = random_of(19);
    const circle = {
        plain: ({ position }) => abut.Circle(position, 0.5),
        rapier: new RAPIER.Ball(0.5),
        planck: new planck.Circle(0.5),
    };
    const box = {
        plain: ({ position, rotation }) => abut.Box2(position, [0.5, 0.4], rotation),
        rapier: new RAPIER.Cuboid(0.5, 0.4),
        planck: new planck.Box(0.5, 0.4),
    };
    pair_row(abut, 'circle and box', circle, box, random);
    pair_row(abut, 'box and box', box, box, random);
    await ray_row(abut, random);
    world_row(abut, random);
}

function pair_row(abut, name, a, b, random) {
    const at_a = places(random, 0.6, COUNT);
    const at_b = places(random, 0.6, COUNT);
    const plain_a = at_a.map(a.plain);
    const plain_b = at_b.map(b.plain);
    const clear = plain_a.map((shape, i) => Math.abs(abut.closest(shape, plain_b[i]).distance) > TOUCHING);
    const position_a = at_a.map((place) => xy(place.position));
    const position_b = at_b.map((place) => xy(place.position));
    const transform = ({ position, angle }) => new planck.Transform(planck.Vec2(...position), angle);
    const transform_a = at_a.map(transform);
    const transform_b = at_b.map(transform);
    const contender = (who, question) => [
        who,
        () => at_a.map((_, i) => question(i)).filter((_, i) => clear[i]),
        () => {
            let sum = 0;
            for (let i = 0; i < COUNT; ++i) sum += question(i);
            return sum;
        },
    ];
    row(`plane: overlaps, ${name}`, COUNT, [
        contender('plain', (i) => (abut.overlaps(plain_a[i], plain_b[i]) ? 1 : 0)),
        contender('Rapier', (i) =>
            a.rapier.intersectsShape(position_a[i], at_a[i].angle, b.rapier, position_b[i], at_b[i].angle) ? 1 : 0,
        ),
        contender('planck', (i) => (planck.testOverlap(a.planck, 0, b.planck, 0, transform_a[i], transform_b[i]) ? 1 : 0)),
    ]);
}

async function ray_row(abut, random) {
    const length = 160;
    const at = places(random, 50, 1000);
    // They begin outside of all boxes: the peers differ about rays from inside.
    const all = Array.from({ length: COUNT }, () => {
        const angle = random(-3, 3);
        const direction = [Math.cos(angle), Math.sin(angle)];
        return { origin: [random(-20, 20), random(-20, 20)].map((x, k) => x - 80 * direction[k]), direction, length };
    });
    const world = new abut.World2();
    const rapier = new RAPIER.World({ x: 0, y: 0 });
    const of_planck = new planck.World();
    for (const { position, angle, rotation } of at) {
        world.add(abut.Box2([0, 0], [0.5, 0.4]), { pose: { position, rotation }, fixed: true });
        rapier.createCollider(
            RAPIER.ColliderDesc.cuboid(0.5, 0.4)
                .setTranslation(...position)
                .setRotation(angle),
        );
        of_planck.createBody({ position: planck.Vec2(...position), angle }).createFixture({ shape: new planck.Box(0.5, 0.4) });
    }
    world.update();
    rapier.step();
    const box2d = await box2d_world(at);
    const rays = all.map(({ origin, direction }) => new RAPIER.Ray(xy(origin), xy(direction)));
    const ends = all.map(({ origin, direction }) => [
        planck.Vec2(...origin),
        planck.Vec2(...origin.map((x, k) => x + length * direction[k])),
    ]);
    const each = (who, question) => [who, ...Array(2).fill(() => all.map((_, i) => question(i)))];
    row(
        'plane: ray, world of 1,000 boxes',
        COUNT,
        [
            each('one by one', (i) => world.raycast(all[i])?.hit.distance ?? -1),
            each('Rapier', (i) => rapier.castRayAndGetNormal(rays[i], length, true)?.timeOfImpact ?? -1),
            each('planck', (i) => {
                let nearest = -1;
                of_planck.rayCast(...ends[i], (_fixture, _point, _normal, fraction) => {
                    nearest = fraction * length;
                    return fraction;
                });
                return nearest;
            }),
            each('Box2D', box2d(all)),
        ],
        { outliers: 0.02 },
    );
    rapier.free();
    world.dispose();
}

/** A world of still boxes of Box2D, as a question about rays. */
async function box2d_world(at) {
    const b2 = await Box2D();
    const world = b2.b2CreateWorld(b2.b2DefaultWorldDef());
    const vector = ([x, y]) => {
        const result = new b2.b2Vec2();
        result.Set(x, y);
        return result;
    };
    for (const { position, angle } of at) {
        const body = b2.b2DefaultBodyDef();
        body.position = vector(position);
        body.rotation = b2.b2MakeRot(angle);
        b2.b2CreatePolygonShape(b2.b2CreateBody(world, body), b2.b2DefaultShapeDef(), b2.b2MakeBox(0.5, 0.4));
    }
    const filter = b2.b2DefaultQueryFilter();
    return (all) => {
        const origins = all.map(({ origin }) => vector(origin));
        const moves = all.map(({ direction, length }) => vector(direction.map((x) => length * x)));
        return (i) => {
            const result = b2.b2World_CastRayClosest(world, origins[i], moves[i], filter);
            const distance = result.hit ? result.fraction * all[i].length : -1;
            result.delete?.();
            return distance;
        };
    };
}

function world_row(abut, random) {
    const all = Array.from({ length: BOXES }, () => ({
        ...places(random, 0, 1)[0],
        position: [random(0, SIDE), random(0, SIDE)],
        velocity: [random(-3, 3), random(-3, 3)],
    }));
    const makers = [
        ['step and events', () => abut_world(abut, all), 0],
        ['Rapier', () => rapier_world(all), 1],
        ['planck', () => planck_world(all), 1],
    ];
    row(
        'plane: world step, 10,000 moving boxes',
        1,
        makers.map(([name, make, lag]) => {
            const counted = make();
            for (let i = 0; i < STEPS + lag; ++i) counted.step();
            const pairs = counted.pairs();
            const timed = make();
            timed.step();
            return [name, () => [pairs / 1000], () => timed.step()];
        }),
        { tolerance: 0.05, once: true },
    );
}

function abut_world(abut, all) {
    const world = new abut.World2();
    const box = abut.build(abut.Box2([0, 0], [0.5, 0.4]));
    const poses = Float32Array.from(all.flatMap(({ position, rotation }) => [...position, ...rotation]));
    const ids = world.add_many(
        box,
        all.map(({ position, rotation }) => ({ pose: { position, rotation } })),
    );
    let pairs = 0;
    return {
        step() {
            for (let i = 0; i < BOXES; ++i) for (let k = 0; k < 2; ++k) poses[4 * i + k] += all[i].velocity[k] * STEP;
            world.move_many(ids, poses);
            const { began, ended } = world.update().columns;
            pairs += (began.length - ended.length) / 4;
        },
        pairs: () => pairs,
    };
}

function rapier_world(all) {
    const world = new RAPIER.World({ x: 0, y: 0 });
    world.timestep = STEP;
    const queue = new RAPIER.EventQueue(true);
    for (const { position, angle, velocity } of all) {
        const body = world.createRigidBody(
            RAPIER.RigidBodyDesc.dynamic()
                .setTranslation(...position)
                .setRotation(angle)
                .setLinvel(...velocity)
                .setCanSleep(false),
        );
        world.createCollider(
            RAPIER.ColliderDesc.cuboid(0.5, 0.4).setSensor(true).setActiveEvents(RAPIER.ActiveEvents.COLLISION_EVENTS),
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
    };
}

function planck_world(all) {
    const world = new planck.World({ gravity: planck.Vec2(0, 0), allowSleep: false });
    for (const { position, angle, velocity } of all) {
        const body = world.createBody({
            type: 'dynamic',
            position: planck.Vec2(...position),
            angle,
            linearVelocity: planck.Vec2(...velocity),
        });
        body.createFixture({ shape: new planck.Box(0.5, 0.4), isSensor: true, density: 1 });
    }
    let pairs = 0;
    world.on('begin-contact', () => ++pairs);
    world.on('end-contact', () => --pairs);
    return { step: () => world.step(STEP), pairs: () => pairs };
}
