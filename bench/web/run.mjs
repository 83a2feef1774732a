// Times of the npm package beside its peers: run.mjs PACKAGE_FOLDER [GROUP]... prints one table.
import { pathToFileURL } from 'node:url';
import { cpus } from 'node:os';
import { resolve } from 'node:path';
import { rows, table } from './measure.mjs';

const GROUPS = ['pairs', 'batches', 'casts', 'world', 'mesh', 'boxes', 'plane'];
const [folder, ...wanted] = process.argv.slice(2);
for (const name of wanted)
    if (!GROUPS.includes(name) && name !== '--json') throw new Error(`there is no group ${name}; there are ${GROUPS.join(', ')}`);

const { load } = await import(pathToFileURL(resolve(folder, 'src/index.js')));
const abut = await load();
const as_json = wanted.includes('--json');
const chosen = wanted.filter((name) => name !== '--json');
for (const group of chosen.length > 0 ? chosen : GROUPS) await (await import(`./${group}.mjs`)).default(abut);
if (as_json) console.log(JSON.stringify({ rows }));
else console.log(`abut ${abut.version}, node ${process.version}, ${cpus()[0].model}\n\n${table()}`);
