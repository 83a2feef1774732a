// What a strict compiler must take, and what it must refuse.
import { load, Handle, type Abut, type AnyShape3, type Closest3, type Hit3, type Id, type Polytope3 } from 'abut';
import { load as load_plane } from 'abut/2d';
import { load as load_space } from 'abut/3d';
import { load as load_inline } from 'abut/inline';

const abut: Abut = await load();
const ball: AnyShape3 = abut.Sphere([0, 0, 0], 1);
const crate = abut.at(abut.Box3([0, 0, 0], [1, 1, 1], [0, 0, 0, 1]), { position: [3, 0, 0] });
const gap: Closest3 = abut.closest(ball, crate);
const [x, y, z]: [number, number, number] = gap.on_a;
const hit: Hit3 | null = abut.raycast({ origin: [x, y, z], direction: [1, 0, 0], length: 9 }, crate);
const points: Float32Array | undefined = hit === null ? undefined : abut.closest_to_points(ball, new Float32Array(hit.point)).on_a;
const common: Polytope3 | null = abut.intersection(crate, abut.Box3([3, 0, 0], [1, 1, 1]));
if (common) abut.overlaps(common, ball);

using world = new abut.World3();
const id: Id = world.add(ball, { fixed: true, layers: 1, user: 5n });
world.move_many(new Uint32Array([id.index, id.generation]), new Float32Array([0, 0, 0, 0, 0, 0, 1]));
const { began, columns } = world.update();
const first: number | undefined = began[0]?.a.index ?? columns.began[0];
const depths: Float32Array = world.contacts_columns().contact.depth;
world.each_overlapping(ball, (found) => found.index === first);
const handle: Handle = abut.build(crate);
handle.dispose();

const plane = await load_plane();
const both = await load_inline();
const space = await load_space();
plane.overlaps(plane.Circle([0, 0], 1), both.Circle([0, 0], 1));
// @ts-expect-error: a ball of space is no shape of the plane.
plane.overlaps(plane.Circle([0, 0], 1), abut.Sphere([0, 0, 0], 1));
// @ts-expect-error: the entry of space has no circles.
space.Circle([0, 0], 1);
// @ts-expect-error: there is no such option.
world.add(ball, { fixd: true });
// @ts-expect-error: a radius is a number.
abut.Sphere([0, 0, 0], '1');
export { points, depths };
