// 100,000 boxes in the plane that stand still: building, and which of them overlap a box.
import Flatbush from 'flatbush';
import RBush from 'rbush';
import { random_of, row } from './measure.mjs';

const COUNT = 100000;
const QUESTIONS = 1000;
const SIDE = 1000;

export default async function boxes(abut) {
    const random = random_of(17);
    const make = (count, size) =>
        Array.from({ length: count }, () => {
            const [x, y] = [random(0, SIDE), random(0, SIDE)].map(Math.fround);
            return [x, y, Math.fround(x + random(0, size)), Math.fround(y + random(0, size))];
        });
    const all = make(COUNT, 2);
    const build_flatbush = () => {
        const tree = new Flatbush(COUNT, 16, Float32Array);
        for (const box of all) tree.add(...box);
        tree.finish();
        return tree;
    };
    const items = all.map(([minX, minY, maxX, maxY], i) => ({ minX, minY, maxX, maxY, i }));
    const build_rbush = () => new RBush().load(items);
    const build_world = () => {
        const world = new abut.World2();
        for (const [x0, y0, x1, y1] of all) world.add(abut.Aabb2([x0, y0], [x1, y1]), { fixed: true });
        world.update();
        return world;
    };
    const done = () => [COUNT];
    const building = (who, build) => [who, done, build];
    row('boxes in the plane, building', COUNT, [
        ['a world, one by one', done, () => build_world().dispose()],
        building('flatbush', build_flatbush),
        building('rbush', build_rbush),
    ]);
    const world = build_world();
    const flatbush = build_flatbush();
    const rbush = build_rbush();
    for (const size of [2, 50]) {
        const questions = make(QUESTIONS, size);
        const shapes = questions.map(([x0, y0, x1, y1]) => abut.Aabb2([x0, y0], [x1, y1]));
        const each = (who, question) => [who, ...Array(2).fill(() => questions.map((_, i) => question(i)))];
        row(`boxes in the plane, overlap with one up to ${size} wide`, QUESTIONS, [
            each('typed arrays', (i) => world.overlapping_columns(shapes[i]).length / 2),
            each('abut, objects', (i) => world.overlapping(shapes[i]).length),
            each('flatbush', (i) => flatbush.search(...questions[i]).length),
            each(
                'rbush',
                (i) => rbush.search({ minX: questions[i][0], minY: questions[i][1], maxX: questions[i][2], maxY: questions[i][3] }).length,
            ),
        ]);
    }
    world.dispose();
}
