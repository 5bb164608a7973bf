// Kestrel's codec against node-mavlink, an implementation that shares nothing with it: the same
// definitions, each reads what the other writes, field by field, and both write the same bytes.
//   node conformance.mjs CODEC     (see tests/link/peer_codec.cpp for its lines)
//
// Where the two differ:
// * node-mavlink trims even the first byte of a payload of zeros, against the standard, which always
//   keeps one (mavlink.io, "Empty-Byte Payload Truncation"). Each reads the other's frame.
// * node-mavlink ends a text at its first zero when it reads; Kestrel keeps every byte. What stands
//   before the zero is the same, and both write the same bytes.
// * In JavaScript a NaN has no bits of its own to keep, so the floats here are finite; that Kestrel
//   keeps those bits is a test of its own (Frame.KeepsTheBitsOfNanAndInfinity).
import { execFileSync } from 'node:child_process';
import assert from 'node:assert/strict';
import {
  decoded, definition, encoded, lineOf, parsed, random, randomByte, signatureOf, signed,
  wordsOfTexts, zeros,
} from './lines.mjs';

const codec = process.argv[2];
const EACH = 200; // frames of each message, each way
const MESSAGES = 31;
const BYTES = 64 << 20;

function codecLines(words, lines = []) {
  const input = lines.map((line) => line + '\n').join('');
  const output = execFileSync(codec, words, { input, maxBuffer: BYTES }).toString();
  return output.trimEnd().split('\n');
}

/// Kestrel's tables are the peer's: ids, CRC_EXTRA, names, types, places, extensions.
function sameTables() {
  const ours = codecLines(['tables']);
  assert.equal(ours.length, MESSAGES);
  const names = ours.map((line) => line.split(' ')[0]);
  assert.deepEqual(ours, names.map(definition));
  return names;
}

/// How the frame differs that the peer writes for the same values: in an empty payload only.
function inTheManner(frame, ours) {
  if (frame[1] !== 0) return frame;
  assert.equal(ours[1], 1);
  assert.equal(ours[10], 0);
  return ours;
}

/// Kestrel wrote `line`: the peer must read the same from its frame, and write the same bytes.
function compareWritten(line) {
  const ours = parsed(line);
  const theirs = decoded(ours.frame);
  assert.equal(theirs.name, ours.name, line);
  assert.deepEqual(theirs.envelope, ours.envelope, line);
  assert.deepEqual(theirs.words, wordsOfTexts(ours.name, ours.words), line);
  const written = inTheManner(encoded(ours.name, ours.envelope, ours.words), ours.frame);
  assert.equal(written.toString('hex'), ours.frame.toString('hex'), line);
}

function kestrelWrites(names) {
  const lines = codecLines(['write', String(EACH)]);
  lines.forEach(compareWritten);
  for (const name of names) {
    assert.equal(lines.filter((line) => line.startsWith(name + ' ')).length, EACH, name);
  }
  return lines;
}

function peerWrites(names) {
  const written = names.flatMap((name) => Array.from({ length: EACH }, () => random(name)))
    .map((message) => [message, encoded(message.name, message.envelope, message.words)]);
  const read = codecLines(['read'], written.map(([, frame]) => frame.toString('hex')));
  assert.equal(read.length, written.length);
  // The line holds the name, the ids, every field and the bytes.
  written.forEach(([message, frame], i) => {
    assert.equal(read[i], lineOf(message, inTheManner(frame, parsed(read[i]).frame)));
  });
}

/// Every message of nothing but zeros: the peer writes no payload at all, Kestrel one byte.
function emptyPayloads(names) {
  for (const name of names) {
    const message = zeros(name);
    const theirs = encoded(name, message.envelope, message.words);
    assert.equal(theirs[1], 0);
    const [line] = codecLines(['read'], [theirs.toString('hex')]);
    assert.deepEqual(parsed(line).words, message.words);
    assert.equal(parsed(line).frame[1], 1);
    assert.deepEqual(decoded(parsed(line).frame).words, wordsOfTexts(name, message.words));
  }
}

const SIGNED = 1; // incompat flag
const SIGNATURE = 13;
const KEY = Buffer.from(Array.from({ length: 32 }, randomByte));

/// Kestrel signed the frame: to the peer it is genuine, and it signs with the same bytes.
function compareSigned(line) {
  const ours = parsed(line);
  const theirs = decoded(ours.frame, SIGNATURE);
  assert.equal(theirs.flags, SIGNED);
  assert.deepEqual(theirs.words, wordsOfTexts(ours.name, ours.words), line);
  const signature = signatureOf(ours.frame);
  assert.ok(signature.matches(KEY), line);
  const bare = encoded(ours.name, ours.envelope, ours.words, SIGNED);
  if (bare[1] === 0) return;
  const written = signed(bare, signature.linkId, signature.timestamp, KEY);
  assert.equal(written.toString('hex'), ours.frame.toString('hex'), line);
}

/// The peer signed: to Kestrel the frames are genuine, and it signs with the same bytes; with any
/// bit of the signature flipped they are forged.
function peerSigns(names) {
  const messages = names.flatMap((name) => Array.from({ length: EACH }, () => random(name)));
  const frames = messages.map(({ name, envelope, words }) => signed(
    encoded(name, envelope, words, SIGNED), randomByte(),
    Array.from({ length: 6 }, randomByte).reduce((sum, byte) => 256 * sum + byte, 0), KEY));
  const read = codecLines(['read', KEY.toString('hex')], frames.map((frame) => frame.toString('hex')));
  read.forEach((line, i) => {
    const same = frames[i][1] === 0 ? parsed(line).frame : frames[i];
    assert.equal(line, lineOf(messages[i], same));
  });
  for (const frame of frames) {
    frame[frame.length - 1 - randomByte() % SIGNATURE] ^= 1 << (randomByte() % 8);
  }
  const forged = codecLines(['read', KEY.toString('hex')],
    frames.map((frame) => frame.toString('hex')));
  assert.deepEqual(forged, frames.map(() => 'forged'));
}

function withSignatures(names) {
  const lines = codecLines(['write', String(EACH), KEY.toString('hex')]);
  assert.equal(lines.length, EACH * names.length);
  lines.forEach(compareSigned);
  peerSigns(names);
}

/// The comparison itself can fail: one bit of any field of any message is noticed.
function canFail(lines, names) {
  for (const name of names) {
    const right = parsed(lines.find((line) => line.startsWith(name + ' ')));
    right.words.forEach((word, i) => {
      const words = [...right.words];
      words[i] = word.replace(/^-?\d+/, (number) => String(BigInt(number) ^ 1n));
      assert.throws(() => compareWritten(lineOf({ ...right, words }, right.frame)), name);
    });
  }
}

const names = sameTables();
const lines = kestrelWrites(names);
peerWrites(names);
emptyPayloads(names);
withSignatures(names);
canFail(lines, names);
console.log(`${names.length} messages, ${EACH} frames of each, each way, signed and unsigned:`
  + ' every field and every byte agree.');
