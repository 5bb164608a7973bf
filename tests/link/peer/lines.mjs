// Messages of node-mavlink as the lines of peer_codec: name, system, component, sequence, a word for
// each field in the order of the wire (elements of arrays joined by commas, floats as their bits,
// characters as bytes), frame in hexadecimal.
import mavlink from 'node-mavlink';

const {
  MavLinkPacketSignature, MavLinkProtocolV2, MSG_ID_MAGIC_NUMBER, common, minimal, standard, x25crc,
} = mavlink;

const HEADER = 10;
const CRC = 2;

const BY_NAME = new Map(
  Object.values({ ...minimal.REGISTRY, ...standard.REGISTRY, ...common.REGISTRY })
    .map((each) => [each.MSG_NAME, each]));

function fieldsOf(name) {
  return [...BY_NAME.get(name).FIELDS].sort((a, b) => a.offset - b.offset);
}
function typeOf(field) {
  return field.type.replace('[]', '').replace('_mavlink_version', '');
}

/// The peer's definition in the words of `peer_codec tables`.
export function definition(name) {
  const fields = fieldsOf(name);
  const end = Math.max(...fields.map((f) => f.offset + f.size * (f.length || 1)));
  const each = fields.map((f) => [f.source, typeOf(f), f.length, f.offset, Number(f.extension)]
    .join(':'));
  return [name, BY_NAME.get(name).MSG_ID, MSG_ID_MAGIC_NUMBER[BY_NAME.get(name).MSG_ID], end, ...each]
    .join(' ');
}

const scratch = Buffer.alloc(4);
function bitsOf(value) {
  scratch.writeFloatLE(value);
  return scratch.readUInt32LE();
}
function floatOf(bits) {
  scratch.writeUInt32LE(Number(bits));
  return scratch.readFloatLE();
}

function wordOf(field, value) {
  const type = typeOf(field);
  if (type === 'char') return [...Buffer.from(value, 'latin1')].join(',');
  const elements = field.length > 0 ? value : [value];
  return elements.map((each) => String(type === 'float' ? bitsOf(each) : each)).join(',');
}
function valueOf(field, word) {
  const type = typeOf(field);
  const words = word.split(',');
  if (type === 'char') return Buffer.from(words.map(Number)).toString('latin1');
  const elements = words.map((each) => {
    if (type === 'float') return floatOf(each);
    return type.endsWith('64_t') ? BigInt(each) : Number(each);
  });
  return field.length > 0 ? elements : elements[0];
}

/// Words as the peer reads them: it ends a text at its first zero, the wire does not.
export function wordsOfTexts(name, words) {
  return fieldsOf(name).map((field, i) => (typeOf(field) === 'char'
    ? words[i].split(',').slice(0, `,${words[i]},`.replace(/,0,.*$/, '').split(',').length - 1)
      .join(',')
    : words[i]));
}

/// The frame that node-mavlink writes.
export function encoded(name, envelope, words, flags = 0) {
  const message = new (BY_NAME.get(name))();
  fieldsOf(name).forEach((field, i) => { message[field.name] = valueOf(field, words[i]); });
  const [system, component, sequence] = envelope;
  return new MavLinkProtocolV2(system, component, flags).serialize(message, sequence);
}

/// What node-mavlink reads from a frame; throws when the checksum is wrong.
export function decoded(frame, trailer = 0) {
  const protocol = new MavLinkProtocolV2();
  const header = protocol.header(frame);
  const [name, type] = [...BY_NAME].find(([, each]) => each.MSG_ID === header.msgid);
  if (frame.length !== HEADER + header.payloadLength + CRC + trailer) throw new Error('not one frame');
  if (protocol.crc(frame) !== x25crc(frame, 1, CRC + trailer, MSG_ID_MAGIC_NUMBER[header.msgid])) {
    throw new Error('bad checksum');
  }
  const message = protocol.data(protocol.payload(frame), type);
  return {
    name,
    flags: header.incompatibilityFlags,
    envelope: [header.sysid, header.compid, header.seq],
    words: fieldsOf(name).map((field) => wordOf(field, message[field.name])),
  };
}

/// The signature of a frame, in the peer's hands.
export function signatureOf(frame) {
  return new MavLinkPacketSignature(frame);
}

/// An unsigned frame of `encoded` with the flag, signed by the peer. It knows times to a millisecond;
/// here any is wanted.
export function signed(frame, linkId, timestamp, key) {
  const result = new MavLinkProtocolV2().sign(frame, linkId, key);
  const signature = signatureOf(result);
  signature.timestamp = timestamp;
  signature.signature = signature.calculate(key);
  return result;
}

export function parsed(line) {
  const words = line.split(' ');
  return {
    name: words[0],
    envelope: words.slice(1, 4).map(Number),
    words: words.slice(4, -1),
    frame: Buffer.from(words[words.length - 1], 'hex'),
  };
}

export function lineOf({ name, envelope, words }, frame) {
  return [name, ...envelope, ...words, frame.toString('hex')].join(' ');
}

// A linear congruential generator: the same values in every run.
let state = 12345;
export function randomByte() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state >>> 24;
}

const FLOATS = [0, 0x80000000, 1, 0x807fffff, 0x00800000, 0x7f7fffff, 0xff7fffff, 0x3f800000];
function randomFloat() {
  if (randomByte() < 64) return FLOATS[randomByte() % FLOATS.length];
  const bits = Buffer.from([randomByte(), randomByte(), randomByte(), randomByte()]).readUInt32LE();
  return ((bits & 0x7f800000) === 0x7f800000 ? bits & 0xbfffffff : bits) >>> 0;
}
// Zero, all ones, the largest and the smallest signed number are often among the integers.
function randomInteger(field) {
  const type = typeOf(field);
  const bits = BigInt(8 * field.size);
  const top = 1n << (bits - 1n);
  let value = 0n;
  for (let i = 0; i < field.size; ++i) value = (value << 8n) + BigInt(randomByte());
  if (randomByte() < 64) value = [0n, 2n * top - 1n, top - 1n, top][randomByte() % 4];
  return type.startsWith('int') ? BigInt.asIntN(Number(bits), value) : value;
}
function randomWord(field) {
  const one = () => String(typeOf(field) === 'float' ? randomFloat() : randomInteger(field));
  return Array.from({ length: field.length || 1 }, one).join(',');
}
function zeroWord(field) {
  return new Array(field.length || 1).fill('0').join(',');
}

/// A message with any values, its floats finite; in half of them some last fields are zeros, which
/// are trimmed.
export function random(name) {
  const fields = fieldsOf(name);
  const kept = randomByte() < 128 ? fields.length : randomByte() % (fields.length + 1);
  return {
    name,
    envelope: [randomByte(), randomByte(), randomByte()],
    words: fields.map((field, i) => (i < kept ? randomWord(field) : zeroWord(field))),
  };
}

export function zeros(name) {
  return { name, envelope: [1, 191, 5], words: fieldsOf(name).map(zeroWord) };
}
