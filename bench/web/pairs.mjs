// Pairs of shapes in space, one by one: whether they overlap, how far apart they are, how they touch.
import RAPIER from '@dimforge/rapier3d-compat';
import * as cat from 'crashcat';
import { random_of, row } from './measure.mjs';

const COUNT = 1024;
// What a peer may report otherwise: pairs that touch within its tolerance.
const TOUCHING = 0.005;

/** Random places, near enough that about half of the pairs overlap. */
export function places(random, reach, count = COUNT) {
    return Array.from({ length: count }, () => {
        const position = [random(-reach, reach), random(-reach, reach), random(-reach, reach)];
        const rotation = Array.from({ length: 4 }, () => random(-1, 1));
        const length = Math.hypot(...rotation);
        return { position, rotation: rotation.map((x) => x / length) };
    });
}

export const to_xyz = ([x, y, z]) => ({ x, y, z });
export const to_xyzw = ([x, y, z, w]) => ({ x, y, z, w });

/** The ends of a segment along y that is turned. */
function ends_of([px, py, pz], [x, y, z, w], half) {
    const up = [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)].map((number) => half * number);
    return [
        [px - up[0], py - up[1], pz - up[2]],
        [px + up[0], py + up[1], pz + up[2]],
    ];
}

/** The shapes at their origin, and of abut what makes the plain shape at a place. */
export function kinds(abut, random) {
    const points = Float32Array.from({ length: 3 * 32 }, () => random(-0.7, 0.7));
    const hull = abut.build(abut.Polyhedron(points));
    return {
        ball: {
            plain: ({ position }) => abut.Sphere(position, 0.5),
            rapier: new RAPIER.Ball(0.5),
            cat: cat.sphere.create({ radius: 0.5 }),
        },
        box: {
            plain: ({ position, rotation }) => abut.Box3(position, [0.5, 0.4, 0.3], rotation),
            rapier: new RAPIER.Cuboid(0.5, 0.4, 0.3),
            cat: cat.box.create({ halfExtents: [0.5, 0.4, 0.3], convexRadius: 0 }),
        },
        capsule: {
            plain: ({ position, rotation }) => abut.Capsule3(...ends_of(position, rotation, 0.4), 0.3),
            rapier: new RAPIER.Capsule(0.4, 0.3),
            cat: cat.capsule.create({ halfHeightOfCylinder: 0.4, radius: 0.3 }),
        },
        hull: {
            plain: ({ position, rotation }) => abut.at(hull, { position, rotation }),
            rapier: new RAPIER.ConvexPolyhedron(points, null),
            cat: cat.convexHull.create({ positions: [...points], convexRadius: 0 }),
        },
    };
}

export default async function pairs(abut) {
    await RAPIER.init();
    cat.registerAll();
    const random = random_of(3);
    const all = kinds(abut, random);
    for (const [a, b] of [
        ['ball', 'box'],
        ['box', 'box'],
        ['capsule', 'capsule'],
        ['hull', 'hull'],
    ]) {
        const at_a = places(random, 0.6);
        const at_b = places(random, 0.6);
        pair_rows(abut, `${a} and ${b}`, all[a], all[b], at_a, at_b);
    }
}

function pair_rows(abut, name, a, b, at_a, at_b) {
    const plain_a = at_a.map(a.plain);
    const plain_b = at_b.map(b.plain);
    // Of handles, shapes that stand where they are.
    const built_a = plain_a.map((shape) => abut.build(shape));
    const built_b = plain_b.map((shape) => abut.build(shape));
    const distances = plain_a.map((shape, i) => abut.closest(shape, plain_b[i]).distance);
    const clear = distances.map((distance) => Math.abs(distance) > TOUCHING);
    const pick = (answers) => answers.filter((_, i) => clear[i]);
    const every = (question) => () => pick(Array.from({ length: COUNT }, (_, i) => question(i)));
    const loop = (question) => () => {
        let sum = 0;
        for (let i = 0; i < COUNT; ++i) sum += question(i);
        return sum;
    };
    const contender = (who, question) => [who, every(question), loop(question)];

    const position_a = at_a.map((place) => to_xyz(place.position));
    const position_b = at_b.map((place) => to_xyz(place.position));
    const rotation_a = at_a.map((place) => to_xyzw(place.rotation));
    const rotation_b = at_b.map((place) => to_xyzw(place.rotation));
    const rapier = (margin) => (i) => a.rapier.contactShape(position_a[i], rotation_a[i], b.rapier, position_b[i], rotation_b[i], margin);
    row(`overlaps, ${name}`, COUNT, [
        contender('plain', (i) => (abut.overlaps(plain_a[i], plain_b[i]) ? 1 : 0)),
        contender('abut, built', (i) => (abut.overlaps(built_a[i], built_b[i]) ? 1 : 0)),
        contender('Rapier', (i) =>
            a.rapier.intersectsShape(position_a[i], rotation_a[i], b.rapier, position_b[i], rotation_b[i]) ? 1 : 0,
        ),
        contender('crashcat', crashcat(a.cat, b.cat, at_a, at_b)),
    ]);
    row(
        `closest, ${name}`,
        COUNT,
        [
            contender('plain', (i) => Math.max(0, abut.closest(plain_a[i], plain_b[i]).distance)),
            contender('abut, built', (i) => Math.max(0, abut.closest(built_a[i], built_b[i]).distance)),
            contender('Rapier', (i) => Math.max(0, rapier(1e3)(i)?.distance ?? NaN)),
        ],
        { tolerance: 0.01 },
    );
    row(`contact, ${name}`, COUNT, [
        contender('plain', (i) => (abut.contact(plain_a[i], plain_b[i]) === null ? 0 : 1)),
        contender('abut, built', (i) => (abut.contact(built_a[i], built_b[i]) === null ? 0 : 1)),
        contender('Rapier, one point', (i) => (rapier(0)(i) === null ? 0 : 1)),
    ]);
    for (const shape of [...built_a, ...built_b]) shape.dispose();
}

function crashcat(a, b, at_a, at_b) {
    const collector = cat.createAnyCollideShapeCollector();
    const settings = cat.createDefaultCollideShapeSettings();
    return (i) => {
        collector.reset();
        const [ax, ay, az] = at_a[i].position;
        const [aqx, aqy, aqz, aqw] = at_a[i].rotation;
        const [bx, by, bz] = at_b[i].position;
        const [bqx, bqy, bqz, bqw] = at_b[i].rotation;
        cat.collideShapeVsShape(
            collector,
            settings,
            a,
            0,
            0,
            ax,
            ay,
            az,
            aqx,
            aqy,
            aqz,
            aqw,
            1,
            1,
            1,
            b,
            0,
            0,
            bx,
            by,
            bz,
            bqx,
            bqy,
            bqz,
            bqw,
            1,
            1,
            1,
        );
        return collector.hit === null ? 0 : 1;
    };
}
