// Rays and moving shapes against one shape in space, and against a world of 1,000 boxes.
import RAPIER from '@dimforge/rapier3d-compat';
import * as cat from 'crashcat';
import { random_of, row } from './measure.mjs';
import { kinds, places, to_xyz, to_xyzw } from './pairs.mjs';

const COUNT = 1024;
const LENGTH = 10;
const SIDE = 20;

/** Rays of a random direction that pass the origin within a distance. */
function rays(random, past, from, length) {
    return Array.from({ length: COUNT }, () => {
        const raw = [random(-1, 1), random(-1, 1), random(-1, 1)];
        const size = Math.hypot(...raw);
        const direction = raw.map((x) => x / size);
        const origin = direction.map((x) => random(-past, past) - from * x);
        return { origin, direction, length };
    });
}

const every = (question) => () => Array.from({ length: COUNT }, (_, i) => question(i));
const loop = (question) => () => {
    let sum = 0;
    for (let i = 0; i < COUNT; ++i) sum += question(i);
    return sum;
};
const contender = (who, question) => [who, every(question), loop(question)];

export default async function casts(abut) {
    await RAPIER.init();
    cat.registerAll();
    const random = random_of(5);
    const all = kinds(abut, random);
    for (const name of ['box', 'hull']) ray_row(abut, name, all[name], random);
    for (const [a, b] of [
        ['ball', 'box'],
        ['box', 'box'],
        ['hull', 'hull'],
    ])
        sweep_row(abut, `${a} and ${b}`, all[a], all[b], random);
    world_rows(abut, random);
}

function ray_row(abut, name, kind, random) {
    const at = places(random, 0.2, COUNT);
    const plain = at.map(kind.plain);
    const built = plain.map((shape) => abut.build(shape));
    const all = rays(random, 0.5, 5, LENGTH);
    const positions = at.map((place) => to_xyz(place.position));
    const rotations = at.map((place) => to_xyzw(place.rotation));
    const rapier_rays = all.map(({ origin, direction }) => new RAPIER.Ray(to_xyz(origin), to_xyz(direction)));
    const collector = cat.createClosestCastRayCollector();
    const settings = cat.createDefaultCastRaySettings();
    row(
        `ray, ${name}`,
        COUNT,
        [
            contender('plain', (i) => abut.raycast(all[i], plain[i])?.distance ?? -1),
            contender('abut, built', (i) => abut.raycast(all[i], built[i])?.distance ?? -1),
            contender(
                'Rapier',
                (i) => kind.rapier.castRayAndGetNormal(rapier_rays[i], positions[i], rotations[i], LENGTH, false)?.timeOfImpact ?? -1,
            ),
            contender('crashcat, no normal', (i) => {
                collector.reset();
                const { origin, direction } = all[i];
                const { position, rotation } = at[i];
                cat.castRayVsShape(collector, settings, ...origin, ...direction, LENGTH, kind.cat, 0, 0, ...position, ...rotation, 1, 1, 1);
                return collector.hit.status === cat.CastRayStatus.COLLIDING ? collector.hit.fraction * LENGTH : -1;
            }),
        ],
        { outliers: 0.01 },
    );
    for (const shape of built) shape.dispose();
}

function sweep_row(abut, name, a, b, random) {
    const at_a = places(random, 0.5, COUNT).map((place) => ({
        ...place,
        position: [place.position[0] - 4, place.position[1], place.position[2]],
    }));
    const at_b = places(random, 0.5, COUNT);
    const plain_a = at_a.map(a.plain);
    const plain_b = at_b.map(b.plain);
    const motion = [8, 0, 0];
    const position_a = at_a.map((place) => to_xyz(place.position));
    const position_b = at_b.map((place) => to_xyz(place.position));
    const rotation_a = at_a.map((place) => to_xyzw(place.rotation));
    const rotation_b = at_b.map((place) => to_xyzw(place.rotation));
    const velocity = to_xyz(motion);
    const still = to_xyz([0, 0, 0]);
    const collector = cat.createClosestCastShapeCollector();
    const settings = cat.createDefaultCastShapeSettings();
    row(
        `moving shape, ${name}`,
        COUNT,
        [
            contender('plain', (i) => abut.sweep(plain_a[i], motion, plain_b[i])?.fraction ?? -1),
            contender(
                'Rapier',
                (i) =>
                    a.rapier.castShape(position_a[i], rotation_a[i], velocity, b.rapier, position_b[i], rotation_b[i], still, 0, 1, true)
                        ?.time_of_impact ?? -1,
            ),
            contender('crashcat', (i) => {
                collector.reset();
                cat.castShapeVsShape(
                    collector,
                    settings,
                    a.cat,
                    0,
                    0,
                    ...at_a[i].position,
                    ...at_a[i].rotation,
                    1,
                    1,
                    1,
                    ...motion,
                    b.cat,
                    0,
                    0,
                    ...at_b[i].position,
                    ...at_b[i].rotation,
                    1,
                    1,
                    1,
                );
                return collector.hit.status === cat.CastShapeStatus.COLLIDING ? collector.hit.fraction : -1;
            }),
        ],
        { tolerance: 5e-3, outliers: 0.02 },
    );
}

function world_rows(abut, random) {
    const at = places(random, SIDE, 1000);
    const world = new abut.World3();
    const box = abut.build(abut.Box3([0, 0, 0], [0.5, 0.4, 0.3]));
    const rapier = new RAPIER.World({ x: 0, y: 0, z: 0 });
    for (const { position, rotation } of at) {
        world.add(box, { pose: { position, rotation }, fixed: true });
        const place = RAPIER.ColliderDesc.cuboid(0.5, 0.4, 0.3)
            .setTranslation(...position)
            .setRotation(to_xyzw(rotation));
        rapier.createCollider(place);
    }
    world.update();
    rapier.step();
    const all = rays(random, SIDE, SIDE, 2 * SIDE);
    const columns = Float32Array.from(all.flatMap(({ origin, direction, length }) => [...origin, ...direction, length]));
    const rapier_rays = all.map(({ origin, direction }) => new RAPIER.Ray(to_xyz(origin), to_xyz(direction)));
    const of_columns = ({ hit }) => Array.from(hit.found, (found, i) => (found ? hit.distance[i] : -1));
    row(
        'ray, world of 1,000 boxes',
        COUNT,
        [
            contender('one by one', (i) => world.raycast(all[i])?.hit.distance ?? -1),
            ['abut, many', () => of_columns(world.raycast_many(columns)), () => world.raycast_many(columns)],
            contender('Rapier', (i) => rapier.castRayAndGetNormal(rapier_rays[i], 2 * SIDE, true)?.timeOfImpact ?? -1),
            contender('crashcat', crashcat_world(at, all)),
        ],
        { outliers: 0.01 },
    );
    const ball = abut.build(abut.Sphere([0, 0, 0], 0.5));
    const starts = all.map(({ origin }) => abut.at(ball, { position: origin }));
    const motions = all.map(({ direction, length }) => direction.map((x) => length * x));
    const rapier_ball = new RAPIER.Ball(0.5);
    const rotation = to_xyzw([0, 0, 0, 1]);
    const positions = all.map(({ origin }) => to_xyz(origin));
    const velocities = motions.map(to_xyz);
    row(
        'moving ball, world of 1,000 boxes',
        COUNT,
        [
            contender('one by one', (i) => world.sweep(starts[i], motions[i])?.hit.fraction ?? -1),
            contender(
                'Rapier',
                (i) => rapier.castShape(positions[i], rotation, velocities[i], rapier_ball, 0, 1, false)?.time_of_impact ?? -1,
            ),
        ],
        { tolerance: 5e-3, outliers: 0.02 },
    );
    rapier.free();
    world.dispose();
}

/** A world of still boxes of crashcat, as a question about a ray. */
function crashcat_world(at, all) {
    const settings = cat.createWorldSettings();
    const broad = cat.addBroadphaseLayer(settings);
    const layer = cat.addObjectLayer(settings, broad);
    cat.enableCollision(settings, layer, layer);
    const world = cat.createWorld(settings);
    const shape = cat.box.create({ halfExtents: [0.5, 0.4, 0.3], convexRadius: 0 });
    for (const { position, rotation } of at)
        cat.rigidBody.create(world, { motionType: cat.MotionType.STATIC, shape, objectLayer: layer, position, quaternion: rotation });
    cat.updateWorld(world, undefined, 1 / 60);
    const collector = cat.createClosestCastRayCollector();
    const ray_settings = cat.createDefaultCastRaySettings();
    const filter = cat.filter.create(settings.layers);
    return (i) => {
        collector.reset();
        cat.castRay(world, collector, ray_settings, all[i].origin, all[i].direction, all[i].length, filter);
        return collector.hit.status === cat.CastRayStatus.COLLIDING ? collector.hit.fraction * all[i].length : -1;
    };
}
