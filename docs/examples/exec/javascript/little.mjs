// A small rasterizer that RasterCheck judges:
//
//   rastercheck run --backend 'exec:node little.mjs' --seed 1
//
// Vertices are rounded to a grid of 1/256 pixel. Whether a sample is covered is decided without any
// rounding: edges and clip planes are linear functions with integer coefficients (BigInt), and for
// each row and sample number one division says from which pixel to which one they hold. Values are
// computed in double from the rounded triangle, and rounded once, to float32.

import { serve, Unsupported } from './draws.mjs';

const subpixelBits = 8;

// Values are rounded to the nearest float32, except that doubles may put one on the wrong side of
// the middle between two: half a unit in the last place (ULP) and 2^-17.
const nearlyRounded = { constant: '0x1.0001p-1' };

const hello = {
  protocol: 1,
  name: 'little.mjs',
  version: '1',
  gives: 'attributes',
  contract: {
    format: 'rastercheck-contract',
    version: 1,
    coverage: { subpixel_bits: subpixelBits, rounding: 'nearest_even' },
    basis: 'snapped',
    bounds: { smooth: nearlyRounded, noperspective: nearlyRounded, depth: nearlyRounded },
    keeps_constants: true,
    keeps_equal_depth: true,
    keeps_vertex_values: true,
    keeps_sign_of_zero: true,
    is_invariant: true,
  },
  // A triangle with a vertex behind the eye would have to be cut before its vertices are rounded.
  limits: { lacks: ['nonpositive_w'] },
};

// float32 numbers are multiples of 2^-149 below 2^128: times 2^149 each is an integer, which a
// double holds without rounding.
const floatScale = 2 ** 149;
const big = value => BigInt(Math.fround(value) * floatScale);
const bigFloatScale = 1n << 149n;

const floorDivide = (a, b) => { // b > 0
  const quotient = a / b;
  return a % b < 0n ? quotient - 1n : quotient;
};
const ceilDivide = (a, b) => -floorDivide(-a, b);
const smaller = (a, b) => (a < b ? a : b);
const greater = (a, b) => (a > b ? a : b);

/** a / b rounded to an integer, to the even one of two that are as near; b > 0. */
function roundDivide(a, b) {
  const low = floorDivide(a, b);
  const twiceRest = 2n * (a - low * b);
  return twiceRest > b || (twiceRest === b && low % 2n !== 0n) ? low + 1n : low;
}

/**
 * Where the coordinate `clip` of a vertex is in the window, on the grid:
 * 2^8 * (start + (clip / w + 1) / 2 * size), rounded once.
 */
function snap(clip, w, start, size) {
  const [c, W] = [big(clip), big(w)];
  const numerator = 2n * big(start) * W + (c + W) * big(size);
  return roundDivide(numerator << BigInt(subpixelBits), 2n * bigFloatScale * W);
}

/** How many binary places the positions of samples and pixel centres have, at least the grid's. */
function placesOf(samplePositions) {
  let places = subpixelBits;
  for (const position of samplePositions) {
    while (!Number.isInteger(position * 2 ** places)) ++places;
  }
  return places;
}

/** f(x, y) = a x + b y + c, which must be at least `least`; x and y in units of 2^-places pixel. */
const halfPlane = (a, b, c, least) => ({ a, b, c, least });

/**
 * A sample on an edge belongs to the side f > 0 if it is a left edge, or a top (bottom) one as
 * displayed; else f must be at least 1, as it is an integer.
 */
function edgePlane(a, b, c, draw) {
  const isDown = draw.rules !== 'opengl';
  const isTop = a === 0n && (isDown ? b > 0n : b < 0n);
  const isBottom = a === 0n && (isDown ? b < 0n : b > 0n);
  const owns = a > 0n || (draw.tie_rule === 'bottom_left' ? isBottom : isTop);
  return halfPlane(a, b, c, owns ? 0n : 1n);
}

/**
 * What is to be known of a triangle before its samples: its edges as functions that are positive
 * inside, and all half-planes in which its samples must be. Null if nothing of it is drawn.
 */
function setUp(draw, triangle, places) {
  const vertices = [...draw.indices.subarray(3 * triangle, 3 * triangle + 3)];
  const clip = vertices.map(v => draw.positions.subarray(4 * v, 4 * v + 4));
  const w = clip.map(p => p[3]);
  if (!w.every(value => value > 0)) throw new Unsupported('a vertex with w that is not positive');

  const shift = BigInt(places - subpixelBits);
  const isFlipped = draw.rules === 'd3d';
  const x = clip.map(p => snap(p[0], p[3], draw.viewport_x, draw.viewport_width) << shift);
  const y = clip.map(p => snap(isFlipped ? -p[1] : p[1], p[3], draw.viewport_y,
    draw.viewport_height) << shift);

  const area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area === 0n) return null;
  const isCounterclockwise = (area > 0n) === (draw.rules === 'opengl');
  const isFront = isCounterclockwise === (draw.front_face === 'ccw');
  if (draw.cull === (isFront ? 'front' : 'back')) return null;

  // Edge i is opposite to vertex i: its function is 0 on the edge and |area| at the vertex.
  const sign = area > 0n ? 1n : -1n;
  const edges = [0, 1, 2].map(i => {
    const [j, k] = [(i + 1) % 3, (i + 2) % 3];
    const [a, b] = [sign * (y[j] - y[k]), sign * (x[k] - x[j])];
    return { a, b, c: -(a * x[j] + b * y[j]) };
  });
  const planes = edges.map(({ a, b, c }) => edgePlane(a, b, c, draw));

  // Nothing may be drawn beyond the sides of the viewport. Of the samples on them, those on the
  // sides of least x and y are inside.
  const sides = (start, size) => {
    const [from, to] = [big(start), big(start) + big(size)].map(side => side << BigInt(places));
    return [smaller(from, to), greater(from, to)];
  };
  const [left, right] = sides(draw.viewport_x, draw.viewport_width);
  const [low, high] = sides(draw.viewport_y, draw.viewport_height);
  const one = bigFloatScale;
  planes.push(halfPlane(one, 0n, -left, 0n), halfPlane(-one, 0n, right, 1n),
    halfPlane(0n, one, -low, 0n), halfPlane(0n, -one, high, 1n));

  // A clip distance d is linear in clip space. As all w > 0, at a sample it has the sign of the sum
  // of edge i * d[i] / w[i], and of the sum of edge i * d[i] * w[j] * w[k], which is an integer.
  const W = w.map(big);
  const addClipPlane = d => {
    if (d.every(value => value >= 0n)) return;
    const factors = [0, 1, 2].map(i => d[i] * W[(i + 1) % 3] * W[(i + 2) % 3]);
    const sum = key => edges.reduce((total, edge, i) => total + edge[key] * factors[i], 0n);
    planes.push(halfPlane(sum('a'), sum('b'), sum('c'), 0n));
  };
  const Z = clip.map(p => big(p[2]));
  if (!draw.depth_clamp) {
    addClipPlane(draw.rules === 'opengl' ? Z.map((z, i) => z + W[i]) : Z);
    addClipPlane(Z.map((z, i) => W[i] - z));
  }
  const distances = draw.clip_distance_count;
  for (let d = 0; d < distances; ++d) {
    addClipPlane(vertices.map(v => big(draw.clip_distances[distances * v + d])));
  }

  const minDepth = Math.fround(draw.min_depth);
  const maxDepth = Math.fround(draw.max_depth);
  const depths = clip.map(p => {
    const ndc = p[2] / p[3];
    const t = draw.rules === 'opengl' ? (ndc + 1) / 2 : ndc;
    return minDepth * (1 - t) + maxDepth * t;
  });
  return { triangle, vertices, w, x, y, edges, planes, depths };
}

/** For each row that may be covered, for each sample, the pixels covered: [first, last + 1]. */
function findSpans(draw, triangle, places) {
  const unit = 1n << BigInt(places);
  const minX = Math.max(0, draw.scissor_x);
  const maxX = Math.min(draw.width, draw.scissor_x + draw.scissor_width);
  const yOf = compare => Number(triangle.y.reduce(compare) >> BigInt(places));
  const minY = Math.max(0, draw.scissor_y, yOf(smaller));
  const maxY = Math.min(draw.height, draw.scissor_y + draw.scissor_height, yOf(greater) + 1);

  const rows = [];
  for (let y = minY; y < maxY; ++y) {
    const spans = [];
    for (let s = 0; s < draw.samples; ++s) {
      const sampleX = BigInt(draw.sample_positions[2 * s] * 2 ** places);
      const sampleY = BigInt(draw.sample_positions[2 * s + 1] * 2 ** places) + BigInt(y) * unit;
      let first = BigInt(minX);
      let end = BigInt(maxX);
      for (const { a, b, c, least } of triangle.planes) {
        // step * pixel must be at least need.
        const step = a * unit;
        const need = least - (a * sampleX + b * sampleY + c);
        if (step > 0n) first = greater(first, ceilDivide(need, step));
        else if (step < 0n) end = smaller(end, floorDivide(-need, -step) + 1n);
        else if (need > 0n) end = first;
      }
      spans.push(end > first ? [Number(first), Number(end)] : [0, 0]);
    }
    rows.push({ y, spans });
  }
  return rows;
}

/**
 * A function of a position in units of 2^-places pixel, which gives the three edge functions there
 * as doubles. Where no product or sum can reach 2^53 doubles compute them without rounding, and
 * fast; else BigInt does, and each is rounded once.
 */
function edgeEvaluator(draw, triangle, places) {
  const [maxX, maxY] = [draw.width, draw.height].map(size => size * 2 ** places);
  const numbers = triangle.edges.map(({ a, b, c }) => [Number(a), Number(b), Number(c)]);
  const isSmall = numbers.every(([a, b, c]) =>
    Math.abs(a) * maxX + Math.abs(b) * maxY + Math.abs(c) < 2 ** 53);
  if (isSmall) return (x, y) => numbers.map(([a, b, c]) => a * x + b * y + c);
  return (x, y) => {
    const [X, Y] = [BigInt(x), BigInt(y)];
    return triangle.edges.map(({ a, b, c }) => Number(a * X + b * Y + c));
  };
}

/** The mean of three values with these weights, of any sum. Equal values come out as they are. */
function mean(weights, values) {
  const [p, q, r] = values;
  if (Object.is(p, q) && Object.is(q, r)) return p;
  const [a, b, c] = weights;
  // Dividing last keeps what is a sum of integers exact until then.
  return (a * p + b * q + c * r) / (a + b + c);
}

function drawAll(draw) {
  const places = placesOf(draw.sample_positions);
  const scale = 2 ** places;
  const attributes = draw.attribute_count;

  const triangles = [];
  const box = { min_x: Infinity, min_y: Infinity, max_x: -Infinity, max_y: -Infinity };
  for (let t = 0; t < draw.triangle_count; ++t) {
    const triangle = setUp(draw, t, places);
    if (triangle === null) continue;
    triangle.rows = findSpans(draw, triangle, places);
    triangles.push(triangle);
    for (const { y, spans } of triangle.rows) {
      for (const [first, end] of spans.filter(span => span[1] > span[0])) {
        box.min_x = Math.min(box.min_x, first);
        box.max_x = Math.max(box.max_x, end);
        box.min_y = Math.min(box.min_y, y);
        box.max_y = Math.max(box.max_y, y + 1);
      }
    }
  }
  if (box.max_x < 0) return null;

  const boxWidth = box.max_x - box.min_x;
  const count = boxWidth * (box.max_y - box.min_y) * draw.samples;
  const seen = new Uint32Array(count);
  const depths = new Float32Array(count);
  const values = new Float32Array(count * attributes);
  const nearest = Math.min(draw.min_depth, draw.max_depth);
  const farthest = Math.max(draw.min_depth, draw.max_depth);

  for (const triangle of triangles) {
    const edgesAt = edgeEvaluator(draw, triangle, places);
    const vertexValues = Array.from({ length: attributes }, (_, k) =>
      triangle.vertices.map(v => draw.attributes[attributes * v + k]));
    const provoking = draw.rules === 'opengl' ? 2 : 0;
    const weightsAt = (x, y) => {
      const edges = edgesAt(x, y);
      return { noperspective: edges, smooth: edges.map((edge, i) => edge / triangle.w[i]) };
    };
    for (const { y, spans } of triangle.rows) {
      const at = (x, s) => (s < 0 ? weightsAt((x + 0.5) * scale, (y + 0.5) * scale)
        : weightsAt((x + draw.sample_positions[2 * s]) * scale,
          (y + draw.sample_positions[2 * s + 1]) * scale));
      const holds = x => span => span[0] <= x && x < span[1];
      for (let s = 0; s < draw.samples; ++s) {
        for (let x = spans[s][0]; x < spans[s][1]; ++x) {
          const to = ((y - box.min_y) * boxWidth + x - box.min_x) * draw.samples + s;
          const sample = at(x, s);
          const exact = mean(sample.noperspective, triangle.depths);
          const depth = Math.fround(Math.min(Math.max(exact, nearest), farthest));
          if (draw.depth_test) {
            const isFirst = seen[to] === 0;
            const bar = isFirst ? draw.depth_clear : depths[to];
            if (!(depth < bar || (isFirst && bar === 1 && depth === 1))) continue;
          }
          seen[to] = triangle.triangle + 1;
          depths[to] = depth;
          const weights = { sample };
          for (let k = 0; k < attributes; ++k) {
            const how = draw.interpolations[k];
            const where = draw.locations[k];
            if (how === 'flat') {
              values[to * attributes + k] = vertexValues[k][provoking];
              continue;
            }
            if (where === 'center') weights.center ??= at(x, -1);
            // The centroid of a pixel that is covered in part is the first sample that is covered.
            if (where === 'centroid') {
              weights.centroid ??= at(x, spans.every(holds(x)) ? -1 : spans.findIndex(holds(x)));
            }
            values[to * attributes + k] = mean(weights[where][how], vertexValues[k]);
          }
        }
      }
    }
  }
  return { ...box, arrays: [seen, depths, values] };
}

serve(hello, drawAll);
