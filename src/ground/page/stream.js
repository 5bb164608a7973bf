"use strict";
// The stream of frames: two lengths of 32 bits, most significant byte first, then the words (JSON)
// and the picture (JPEG) of one frame. Read by fetch(), which can carry the token in a header.

class StreamReader {
  constructor() { this.waiting = new Uint8Array(0); }
  add(bytes) {
    const both = new Uint8Array(this.waiting.length + bytes.length);
    both.set(this.waiting);
    both.set(bytes, this.waiting.length);
    this.waiting = both;
  }
  next() {
    if (this.waiting.length < 8) return null;
    const view = new DataView(this.waiting.buffer, this.waiting.byteOffset);
    const words = view.getUint32(0), picture = view.getUint32(4), end = 8 + words + picture;
    if (words > 1 << 23 || picture > 1 << 23) throw new Error("the stream is damaged");
    if (this.waiting.length < end) return null;
    const frame = {
      words: JSON.parse(new TextDecoder().decode(this.waiting.subarray(8, 8 + words))),
      jpeg: this.waiting.slice(8 + words, end),
    };
    this.waiting = this.waiting.subarray(end);
    return frame;
  }
}

// Reads frames until the stream ends; of several that are there at once only the newest is shown.
// Throws "token" when the token is refused.
async function readStream(token, show) {
  const answer = await fetch("stream", { headers: { Authorization: "Bearer " + token }, cache: "no-store" });
  if (answer.status === 401) throw new Error("token");
  if (!answer.ok) throw new Error((await answer.json()).words);
  const reader = answer.body.getReader(), frames = new StreamReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("the program has ended, or the line is cut");
    frames.add(value);
    let newest = null;
    for (let frame = frames.next(); frame; frame = frames.next()) newest = frame;
    if (newest) await show(newest);
  }
}
