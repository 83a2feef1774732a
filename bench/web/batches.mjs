// Many answers in one call, from typed arrays into typed arrays. Rapier has no such calls: it answers one by one.
import RAPIER from '@dimforge/rapier3d-compat';
import { random_of, row } from './measure.mjs';
import { kinds, places, to_xyz, to_xyzw } from './pairs.mjs';

const COUNT = 10000;
const TOUCHING = 0.005;

export default async function batches(abut) {
    await RAPIER.init();
    const random = random_of(7);
    const all = kinds(abut, random);
    for (const [a, b] of [
        ['ball', 'box'],
        ['box', 'box'],
        ['hull', 'hull'],
    ])
        pair_rows(abut, `${a} and ${b}`, all[a], all[b], random);
    point_rows(abut, all.hull, random);
}

function pair_rows(abut, name, a, b, random) {
    const origin = { position: [0, 0, 0], rotation: [0, 0, 0, 1] };
    const own = abut.build(a.plain(origin));
    const other = abut.build(b.plain(origin));
    const at = places(random, 1, COUNT);
    const poses = Float32Array.from(at.flatMap(({ position, rotation }) => [...position, ...rotation]));
    const positions = at.map((place) => to_xyz(place.position));
    const rotations = at.map((place) => to_xyzw(place.rotation));
    const position = to_xyz(origin.position);
    const rotation = to_xyzw(origin.rotation);
    const clear = abut.closest_many(own, other, poses).distance.map((distance) => (Math.abs(distance) > TOUCHING ? 1 : 0));
    const one_by_one = (question) => () => {
        const result = new Float32Array(COUNT);
        for (let i = 0; i < COUNT; ++i) result[i] = question(i);
        return result;
    };
    const contender = (who, run) => [who, () => run().filter((_, i) => clear[i] === 1), run];
    row(`overlaps_many, ${name}`, COUNT, [
        contender('many', () => abut.overlaps_many(own, other, poses)),
        contender(
            'Rapier',
            one_by_one((i) => a.rapier.intersectsShape(position, rotation, b.rapier, positions[i], rotations[i])),
        ),
    ]);
    row(
        `closest_many, ${name}`,
        COUNT,
        [
            [
                'many',
                () => abut.closest_many(own, other, poses).distance.map((x) => Math.max(0, x)),
                () => abut.closest_many(own, other, poses),
            ],
            [
                'Rapier',
                ...Array(2).fill(
                    one_by_one((i) =>
                        Math.max(0, a.rapier.contactShape(position, rotation, b.rapier, positions[i], rotations[i], 1e3)?.distance ?? NaN),
                    ),
                ),
            ],
        ],
        { tolerance: 0.01 },
    );
}

function point_rows(abut, hull, random) {
    const shape = abut.build(hull.plain({ position: [0, 0, 0], rotation: [0, 0, 0, 1] }));
    const points = Float32Array.from({ length: 3 * COUNT }, () => random(-2, 2));
    const vectors = Array.from({ length: COUNT }, (_, i) => to_xyz(points.subarray(3 * i, 3 * i + 3)));
    const zero = to_xyz([0, 0, 0]);
    const rotation = to_xyzw([0, 0, 0, 1]);
    row(
        'contains_many, hull',
        COUNT,
        [
            ['many', ...Array(2).fill(() => abut.contains_many(shape, points))],
            ['Rapier', ...Array(2).fill(() => vectors.map((point) => (hull.rapier.containsPoint(zero, rotation, point) ? 1 : 0)))],
        ],
        { outliers: 0.001 },
    );
}
