// Messages of node-mavlink as the lines of peer_codec: name, system, component, sequence, fields in
// the order of the wire (floats as their bits), frame in hexadecimal.
import mavlink from 'node-mavlink';

const { MavLinkProtocolV2, MSG_ID_MAGIC_NUMBER, common, minimal, x25crc } = mavlink;

const CLASSES = {
  HEARTBEAT: minimal.Heartbeat,
  SET_POSITION_TARGET_LOCAL_NED: common.SetPositionTargetLocalNed,
};
export const NAMES = Object.keys(CLASSES);

const HEADER = 10;
const CRC = 2;

function wireFields(name) {
  return [...CLASSES[name].FIELDS].sort((a, b) => a.offset - b.offset);
}

const scratch = Buffer.alloc(4);
function toBits(field, value) {
  if (field.type !== 'float') return value;
  scratch.writeFloatLE(value);
  return scratch.readUInt32LE();
}
function fromBits(field, bits) {
  if (field.type !== 'float') return bits;
  scratch.writeUInt32LE(bits);
  return scratch.readFloatLE();
}

/// The frame that node-mavlink writes.
export function encoded(name, envelope, fields) {
  const message = new CLASSES[name]();
  wireFields(name).forEach((field, i) => { message[field.name] = fromBits(field, fields[i]); });
  const [system, component, sequence] = envelope;
  return new MavLinkProtocolV2(system, component).serialize(message, sequence);
}

/// What node-mavlink reads from a frame; throws when the checksum is wrong.
export function decoded(frame) {
  const protocol = new MavLinkProtocolV2();
  const header = protocol.header(frame);
  const name = NAMES.find((each) => CLASSES[each].MSG_ID === header.msgid);
  if (frame.length !== HEADER + header.payloadLength + CRC) throw new Error('not one frame');
  if (protocol.crc(frame) !== x25crc(frame, 1, CRC, MSG_ID_MAGIC_NUMBER[header.msgid])) {
    throw new Error('bad checksum');
  }
  const message = protocol.data(protocol.payload(frame), CLASSES[name]);
  return {
    name,
    envelope: [header.sysid, header.compid, header.seq],
    fields: wireFields(name).map((field) => toBits(field, message[field.name])),
  };
}

export function parsed(line) {
  const words = line.split(' ');
  const numbers = words.slice(1, -1).map(Number);
  return {
    name: words[0],
    envelope: numbers.slice(0, 3),
    fields: numbers.slice(3),
    frame: Buffer.from(words[words.length - 1], 'hex'),
  };
}

export function lineOf({ name, envelope, fields }) {
  return [name, ...envelope, ...fields, encoded(name, envelope, fields).toString('hex')].join(' ');
}

// A linear congruential generator: the same values in every run.
let state = 12345;
function randomByte() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state >>> 24;
}

const EDGES = [0, 0x80000000, 1, 0x807fffff, 0x00800000, 0x7f7fffff, 0xff7fffff, 0x3f800000];
function randomBits(field) {
  let bits = 0;
  for (let i = 0; i < field.size; ++i) bits = (bits * 256) + randomByte();
  if (field.type !== 'float') return bits;
  if (randomByte() < 64) return EDGES[randomByte() % EDGES.length];
  const finite = (bits & 0x7f800000) === 0x7f800000 ? bits & 0xbfffffff : bits;
  return finite >>> 0;
}

/// A message with any values, its floats finite; half of them end in zeros, which are trimmed.
export function random(name) {
  const fields = wireFields(name).map(randomBits);
  if (randomByte() < 128) fields[fields.length - 1] = 0;
  return { name, envelope: [randomByte(), randomByte(), randomByte()], fields };
}
