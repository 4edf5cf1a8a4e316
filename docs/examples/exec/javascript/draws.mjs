// Reads the draws of RasterCheck's protocol "exec:" and writes the answers. Copy this file.
//
//   import { serve, Unsupported } from './draws.mjs';
//   serve({ protocol: 1, name: 'mine' }, draw => answer);
//
// The function gets a draw: all keys of its line (draw.width, draw.rules, ...), and its arrays as
//
//   draw.sample_positions  Float32Array [samples][2], x and y within the pixel
//   draw.positions         Float32Array [vertex_count][4], x, y, z, w
//   draw.attributes        Float32Array [vertex_count][attribute_count]
//   draw.clip_distances    Float32Array [vertex_count][clip_distance_count]
//   draw.indices           Uint32Array [triangle_count][3]
//
// It returns null if nothing is covered; else the rectangle and the arrays that the hello's "gives"
// promises, in this order, each in the order [y][x][sample]:
//
//   { min_x, min_y, max_x, max_y, arrays: [Uint32Array, Float32Array, ...] }
//
// It throws Unsupported('why') for a draw that it does not draw. Any other error that it throws
// fails this draw, and the next one is asked for as usual. Standard output is for answers alone:
// use console.error, not console.log, for messages. Typed arrays are in the machine's byte order;
// the protocol's is little-endian, as are all machines that one is likely to have.

import { readSync, writeSync } from 'node:fs';

const longestLine = 65536;

export class Unsupported extends Error {}

/** Says hello, then answers one draw after another until the input ends. */
export function serve(hello, drawer) {
  if (readLine() === null) return;
  writeLine(hello);
  for (let line = readLine(); line !== null; line = readLine()) {
    const draw = JSON.parse(line);
    const bytes = readBytes(draw.bytes);
    addArrays(draw, bytes);
    let answer;
    try {
      answer = drawer(draw);
    } catch (error) {
      const status = error instanceof Unsupported ? 'unsupported' : 'failed';
      if (status === 'failed') console.error(error);
      writeLine({ status, message: String(error.message).slice(0, 1000) });
      continue;
    }
    if (answer === null) {
      writeLine({ status: 'ok', bytes: 0 });
      continue;
    }
    const { min_x, min_y, max_x, max_y, arrays } = answer;
    const total = arrays.reduce((sum, array) => sum + array.byteLength, 0);
    writeLine({ status: 'ok', min_x, min_y, max_x, max_y, bytes: total });
    for (const array of arrays) {
      writeBytes(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    }
  }
}

/** Splits the bytes after a draw's line into its arrays. */
function addArrays(draw, bytes) {
  let at = 0;
  const take = (Type, count) => {
    const array = new Type(bytes.buffer, at, count);
    at += array.byteLength;
    return array;
  };
  const vertices = draw.vertex_count;
  draw.sample_positions = take(Float32Array, draw.samples * 2);
  draw.positions = take(Float32Array, vertices * 4);
  draw.attributes = take(Float32Array, vertices * draw.attribute_count);
  draw.clip_distances = take(Float32Array, vertices * draw.clip_distance_count);
  draw.indices = take(Uint32Array, draw.triangle_count * 3);
  if (at !== bytes.length) throw new Error(`a draw of ${bytes.length} bytes, not ${at}`);
}

// What has been read of standard input and not been used yet: chunk[used] to chunk[filled - 1].
const chunk = new Uint8Array(longestLine);
let used = 0;
let filled = 0;

/** The next line without its end, or null at the end of the input. */
function readLine() {
  const pieces = [];
  for (;;) {
    const end = chunk.subarray(0, filled).indexOf(10, used);
    pieces.push(Buffer.from(chunk.subarray(used, end < 0 ? filled : end)));
    used = end < 0 ? filled : end + 1;
    if (end >= 0) return Buffer.concat(pieces).toString('utf8');
    filled = wait(() => readSync(0, chunk, 0, chunk.length, null));
    used = 0;
    if (filled === 0) return null;
  }
}

/** The next bytes, in memory of their own that begins with them, as typed arrays need it. */
function readBytes(count) {
  const bytes = new Uint8Array(count);
  const kept = Math.min(count, filled - used);
  bytes.set(chunk.subarray(used, used + kept));
  used += kept;
  for (let at = kept; at < count;) {
    const got = wait(() => readSync(0, bytes, at, count - at, null));
    if (got === 0) throw new Error('the input ended within a draw');
    at += got;
  }
  return bytes;
}

function writeLine(object) {
  writeBytes(Buffer.from(JSON.stringify(object) + '\n'));
}

function writeBytes(bytes) {
  for (let at = 0; at < bytes.length;) {
    at += wait(() => writeSync(1, bytes, at, bytes.length - at));
  }
}

/** Does what reads or writes, again and again while a pipe that does not block says EAGAIN. */
function wait(action) {
  for (;;) {
    try {
      return action();
    } catch (error) {
      if (error.code === 'EOF') return 0;
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
    }
  }
}
