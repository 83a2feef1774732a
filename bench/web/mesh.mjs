// Points and rays against a mesh of 80,000 triangles.
import RAPIER from '@dimforge/rapier3d-compat';
import { BufferAttribute, BufferGeometry, Ray, Vector3, DoubleSide } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { random_of, row } from './measure.mjs';

const COUNT = 1024;
const AROUND = 400;
const ACROSS = 100;

const distances = (hit) => Array.from(hit.found, (found, i) => (found ? hit.distance[i] : -1));

/** A torus with waves, around z. */
function torus() {
    const points = [];
    const triangles = [];
    for (let i = 0; i < AROUND; ++i)
        for (let k = 0; k < ACROSS; ++k) {
            const u = (2 * Math.PI * i) / AROUND;
            const v = (2 * Math.PI * k) / ACROSS;
            const r = 1 + 0.1 * Math.sin(9 * u) * Math.cos(5 * v);
            points.push((3 + r * Math.cos(v)) * Math.cos(u), (3 + r * Math.cos(v)) * Math.sin(u), r * Math.sin(v));
            const at = (a, b) => (a % AROUND) * ACROSS + (b % ACROSS);
            triangles.push(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1));
        }
    return { points: new Float32Array(points), triangles: new Uint32Array(triangles) };
}

export default async function mesh(abut) {
    await RAPIER.init();
    const random = random_of(11);
    const { points, triangles } = torus();
    const shape = abut.Mesh(points, triangles);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    geometry.setIndex(new BufferAttribute(triangles.slice(), 1));
    const bvh = new MeshBVH(geometry);
    const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
    const collider = world.createCollider(RAPIER.ColliderDesc.trimesh(points, triangles));
    world.step();
    build_row(abut, points, triangles, geometry);
    point_row(abut, shape, bvh, collider, random);
    ray_row(abut, shape, bvh, collider, random);
    world.free();
}

function build_row(abut, points, triangles, geometry) {
    const count = () => [triangles.length / 3];
    row('mesh, building', triangles.length / 3, [
        ['per triangle', count, () => abut.Mesh(points, triangles).dispose()],
        ['three-mesh-bvh', count, () => new MeshBVH(geometry, { indirect: true })],
    ]);
}

function point_row(abut, shape, bvh, collider, random) {
    const numbers = Float32Array.from({ length: 3 * COUNT }, (_, i) => (i % 3 === 2 ? random(-2, 2) : random(-5, 5)));
    const vectors = Array.from({ length: COUNT }, (_, i) => Array.from(numbers.subarray(3 * i, 3 * i + 3)));
    const three = vectors.map((point) => new Vector3(...point));
    const rapier = vectors.map(([x, y, z]) => ({ x, y, z }));
    const target = { point: new Vector3(), distance: 0, faceIndex: 0 };
    const one = (who, question) => [who, ...Array(2).fill(() => vectors.map((_, i) => question(i)))];
    row(
        'mesh, closest point',
        COUNT,
        [
            one('one by one', (i) => abut.closest(shape, vectors[i]).distance),
            ['abut, many', () => abut.closest_to_points(shape, numbers).distance, () => abut.closest_to_points(shape, numbers)],
            one('three-mesh-bvh', (i) => bvh.closestPointToPoint(three[i], target).distance),
            one('Rapier', (i) => {
                const { point } = collider.projectPoint(rapier[i], false);
                return Math.hypot(point.x - rapier[i].x, point.y - rapier[i].y, point.z - rapier[i].z);
            }),
        ],
        { outliers: 0.001 },
    );
}

function ray_row(abut, shape, bvh, collider, random) {
    const all = Array.from({ length: COUNT }, () => {
        const raw = [random(-1, 1), random(-1, 1), random(-1, 1)];
        const size = Math.hypot(...raw);
        const direction = raw.map((x) => x / size);
        return { origin: direction.map((x, k) => random(-1, 1) * (k === 2 ? 1 : 3) - 8 * x), direction, length: 20 };
    });
    const numbers = Float32Array.from(all.flatMap(({ origin, direction, length }) => [...origin, ...direction, length]));
    const three = all.map(({ origin, direction }) => new Ray(new Vector3(...origin), new Vector3(...direction)));
    const xyz = ([x, y, z]) => ({ x, y, z });
    const rapier = all.map(({ origin, direction }) => new RAPIER.Ray(xyz(origin), xyz(direction)));
    const one = (who, question) => [who, ...Array(2).fill(() => all.map((_, i) => question(i)))];
    row(
        'mesh, ray',
        COUNT,
        [
            one('one by one', (i) => abut.raycast(all[i], shape)?.distance ?? -1),
            ['abut, many', () => distances(abut.raycast_many(shape, numbers)), () => abut.raycast_many(shape, numbers)],
            one('three-mesh-bvh', (i) => bvh.raycastFirst(three[i], DoubleSide, 0, 20)?.distance ?? -1),
            one('Rapier', (i) => collider.castRayAndGetNormal(rapier[i], 20, false)?.timeOfImpact ?? -1),
        ],
        { outliers: 0.003 },
    );
}
