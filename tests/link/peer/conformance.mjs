// Kestrel's codec against node-mavlink, an implementation that shares nothing with it: each reads
// what the other writes, field by field, and both write the same bytes.
//   node conformance.mjs CODEC     (see tests/link/peer_codec.cpp for its lines)
import { execFileSync } from 'node:child_process';
import assert from 'node:assert/strict';
import mavlink from 'node-mavlink';
import { NAMES, decoded, encoded, lineOf, parsed, random } from './lines.mjs';

const codec = process.argv[2];
const COUNT = 2000; // half of each message
const BYTES = 64 << 20;

/// Kestrel wrote `line`: the peer must read the same from its frame, and write the same bytes.
function compareWritten(line) {
  const ours = parsed(line);
  const theirs = decoded(ours.frame);
  assert.equal(theirs.name, ours.name, line);
  assert.deepEqual(theirs.envelope, ours.envelope, line);
  assert.deepEqual(theirs.fields, ours.fields, line);
  assert.equal(encoded(ours.name, ours.envelope, ours.fields).toString('hex'),
    ours.frame.toString('hex'), line);
}

function kestrelWrites() {
  const lines = execFileSync(codec, ['write', String(COUNT)], { maxBuffer: BYTES })
    .toString().trim().split('\n');
  assert.equal(lines.length, COUNT);
  lines.forEach(compareWritten);
  for (const name of NAMES) {
    assert.equal(lines.filter((line) => line.startsWith(name + ' ')).length, COUNT / 2);
  }
}

function peerWrites() {
  const written = [];
  for (let i = 0; i < COUNT; ++i) written.push(lineOf(random(NAMES[i % NAMES.length])));
  const read = execFileSync(codec, ['read'], { input: written.join('\n') + '\n', maxBuffer: BYTES })
    .toString().trim().split('\n');
  // The line holds the name, the ids, every field and the bytes.
  assert.deepEqual(read, written);
}

/// Where the two may differ: the peer trims even the first byte of a payload of zeros, against the
/// standard; both must be read.
function zeros() {
  const fields = new Array(16).fill(0);
  const theirs = encoded(NAMES[1], [1, 191, 5], fields);
  assert.equal(theirs[1], 0);
  const read = execFileSync(codec, ['read'], { input: `x ${theirs.toString('hex')}\n` })
    .toString().trim();
  assert.deepEqual(parsed(read).fields, fields);
  assert.equal(parsed(read).frame[1], 1);
  assert.deepEqual(decoded(parsed(read).frame).fields, fields);
}

/// The comparison itself can fail.
function canFail() {
  const line = lineOf(random(NAMES[1]));
  const wrong = parsed(line);
  wrong.fields[4] = (wrong.fields[4] ^ 1) >>> 0;
  assert.throws(() => compareWritten(
    [wrong.name, ...wrong.envelope, ...wrong.fields, wrong.frame.toString('hex')].join(' ')));
}

assert.ok(mavlink.MavLinkProtocolV2);
kestrelWrites();
peerWrites();
zeros();
canFail();
console.log(`${COUNT} frames each way: every field and every byte agree.`);
