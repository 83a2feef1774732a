// Answers of many kinds, whose bits are the same on every machine: python/test_package.py has the same hash.

/** The SHA-256 of all answers. */
export const digest = '6a594f3b7fbc04e9b2c06b3c6ae42c28e600ca91a47479e58b861286bb5862f4';

/** The answers as typed arrays, in an order. */
export function answersOf(abut) {
    let seed = 7;
    const random = () => Math.fround(((seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32) * 4 - 2);
    const vector = () => [random(), random(), random()];
    const parts = [];

    const shapes = [
        abut.Sphere(vector(), 0.5),
        abut.Box3(vector(), [0.5, 0.75, 0.25], [0.5, 0.5, -0.5, 0.5]),
        abut.Capsule3(vector(), vector(), 0.25),
        abut.Cylinder([0, 0, 0], [0.5, 0.25, 1], 0.5),
        abut.Cone([0, 0, 0], [0, 0.5, 1], 0.5),
        abut.Polyhedron(Float32Array.from({ length: 60 }, random)),
    ];
    const poses = Float32Array.from({ length: 7 * 200 }, random);
    for (const a of shapes)
        for (const b of shapes) {
            const closest = abut.closest_many(a, b, poses);
            const contact = abut.contact_many(a, b, poses);
            parts.push(closest.distance, closest.normal, closest.on_a, contact.depth, contact.normal);
        }

    const world = new abut.World3();
    const pose = (i) => ({ position: poses.subarray(7 * i, 7 * i + 3), rotation: poses.subarray(7 * i + 3, 7 * i + 7) });
    for (let i = 0; i < 200; ++i) world.add(shapes[i % 6], { pose: pose(i) });
    parts.push(new TextEncoder().encode(`${world.update().began.length} ${world.contacts().length}`));
    const rays = Float32Array.from(poses, (number, i) => (i % 7 < 3 ? number : [1, 0, 0, 50][(i % 7) - 3]));
    const { hit } = world.raycast_many(rays);
    parts.push(hit.distance, hit.point, hit.normal);
    world.dispose();
    return parts;
}
