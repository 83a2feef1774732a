import { load } from 'abut';
import { load as load_plane } from 'abut/2d';
import { load as load_space } from 'abut/3d';
import { load as load_inline } from 'abut/inline';

const gap = (abut, a, b) => abut.closest(a, b).distance;
for (const abut of [await load(), await load_inline(), await load_space()])
    if (gap(abut, abut.Sphere([0, 0, 0], 1), abut.Box3([3, 0, 0], [0.5, 0.5, 0.5])) !== 1.5) throw new Error('wrong');
for (const abut of [await load(), await load_inline(), await load_plane()])
    if (gap(abut, abut.Circle([0, 0], 1), abut.Box2([3, 0], [0.5, 0.5])) !== 1.5) throw new Error('wrong');
