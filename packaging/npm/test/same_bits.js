// The answers here are those of the library on other machines, bit by bit.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { load } from 'abut';
import { answersOf, digest } from './answers.js';

const hash = createHash('sha256');
for (const { buffer, byteOffset, byteLength } of answersOf(await load())) hash.update(new Uint8Array(buffer, byteOffset, byteLength));
assert.equal(hash.digest('hex'), digest);
