//! A little rasterizer in Rust, for `rastercheck run --backend exec:./little`.
//! Build: rustc -O little.rs -o little
//!
//! It is docs/examples/plugin/little.c in Rust: window positions are snapped to a grid of 1/256
//! pixel, edges are then exact integers, and values are computed from the same integers in f64. The
//! comments there derive the bounds that its contract promises.

mod draws;

use draws::{Answer, Cull, Draw, FrontFace, Interpolation, Location, Rules, TieRule};

const GRID: i64 = 256; // points per pixel and axis
const GUARD_BAND: f64 = 32768.0; // pixels
const MOST_DEPTH: f64 = 65536.0; // of z/w at vertices

/// The bounds are 0.5 + 2^-24 and 0.5 + 2^-9.
const HELLO: &str = r#"{
    "protocol": 1, "name": "little.rs", "version": "1.0",
    "limits": {"lacks": ["nonpositive_w", "center"]},
    "contract": {
        "format": "rastercheck-contract", "version": 1,
        "coverage": {
            "subpixel_bits": 8, "rounding": "nearest_even", "position_error": "0x1p-27"
        },
        "clip_tolerance": 1, "basis": "snapped",
        "keeps_constants": true, "keeps_equal_depth": true,
        "bounds": {
            "smooth": {"constant": "0x1.000002p-1"},
            "noperspective": {"constant": "0x1.000002p-1"},
            "depth": {"constant": "0x1.01p-1"}
        }
    }
}"#;

/// A number for each vertex of a triangle.
type Corners = [f64; 3];

/// a u + b v + c of a point (u, v) in grid units.
#[derive(Clone, Copy)]
struct Edge {
    a: i64,
    b: i64,
    c: i64,
}

impl Edge {
    fn at(&self, [u, v]: [i64; 2]) -> i64 {
        self.a * u + self.b * v + self.c
    }
}

/// A triangle in the window. Edge i lies opposite vertex i: positive inside, 0 on the edge.
struct Triangle {
    vertices: [usize; 3],
    x: [i64; 3], // snapped
    y: [i64; 3],
    z: Corners,
    w: Corners,
    edges: [Edge; 3],
}

fn sum(numbers: Corners) -> f64 {
    numbers[0] + numbers[1] + numbers[2]
}

fn product(a: Corners, b: Corners) -> Corners {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

fn quotient(a: Corners, b: Corners) -> Corners {
    [a[0] / b[0], a[1] / b[1], a[2] / b[2]]
}

fn to_nearest_even(number: f64) -> i64 {
    let below = number.floor();
    let rest = number - below;
    below as i64 + i64::from(rest > 0.5 || (rest == 0.5 && below % 2.0 != 0.0))
}

impl Triangle {
    /// None where a vertex lies too far away.
    fn new(draw: &Draw, vertices: [usize; 3]) -> Option<Triangle> {
        let (width, height) = (f64::from(draw.viewport_width), f64::from(draw.viewport_height));
        let middle_x = f64::from(draw.viewport_x) + width / 2.0;
        let middle_y = f64::from(draw.viewport_y) + height / 2.0;
        let half_height = if draw.rules == Rules::D3d { -height / 2.0 } else { height / 2.0 };
        let (mut x, mut y, mut z, mut w) = ([0; 3], [0; 3], [0.0; 3], [0.0; 3]);
        for i in 0..3 {
            let position = draw.positions[vertices[i]].map(f64::from);
            z[i] = position[2];
            w[i] = position[3];
            let u = position[0] / w[i] * (width / 2.0) + middle_x;
            let v = position[1] / w[i] * half_height + middle_y;
            // Comparisons with NaN are false.
            let is_near = u.abs() <= GUARD_BAND && v.abs() <= GUARD_BAND;
            if !(is_near && (z[i] / w[i]).abs() <= MOST_DEPTH) {
                return None;
            }
            x[i] = to_nearest_even(u * GRID as f64);
            y[i] = to_nearest_even(v * GRID as f64);
        }
        let edge = |j: usize, k: usize| {
            let (a, b) = (y[j] - y[k], x[k] - x[j]);
            Edge { a, b, c: -(a * x[j] + b * y[j]) }
        };
        let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
        Some(Triangle { vertices, x, y, z, w, edges })
    }

    /// Makes edges positive inside; false if the triangle has no area or is culled.
    fn orient(&mut self, draw: &Draw) -> bool {
        let area = self.edges[0].at([self.x[0], self.y[0]]);
        let is_ccw = (area > 0) == (draw.rules == Rules::OpenGl); // y up
        let is_front = is_ccw == (draw.front_face == FrontFace::Ccw);
        if area < 0 {
            self.edges = self.edges.map(|edge| Edge { a: -edge.a, b: -edge.b, c: -edge.c });
        }
        area != 0 && draw.cull != if is_front { Cull::Front } else { Cull::Back }
    }

    /// The values of the edges, which f64 holds exactly.
    fn at(&self, point: [i64; 2]) -> Corners {
        self.edges.map(|edge| edge.at(point) as f64)
    }
}

/// Whether a sample at which something is 0 is inside: by the gradient of what is 0 there.
fn owns_zero(draw: &Draw, a: f64, b: f64) -> bool {
    let is_y_down = draw.rules != Rules::OpenGl;
    let is_top = if (draw.tie_rule == TieRule::TopLeft) == is_y_down { b > 0.0 } else { b < 0.0 };
    a > 0.0 || (a == 0.0 && is_top)
}

/// Whether a clip distance, given at the vertices, cuts a sample off. Where it is 0, the tie rule
/// decides, except with D3D.
fn is_cut(draw: &Draw, triangle: &Triangle, heights: Corners, weights: Corners) -> bool {
    let total = sum(product(heights, weights));
    if total != 0.0 || draw.rules == Rules::D3d {
        return total < 0.0;
    }
    let slope = |of: fn(&Edge) -> i64| {
        let slopes = [0, 1, 2].map(|i| of(&triangle.edges[i]) as f64);
        sum(product(heights, quotient(slopes, triangle.w)))
    };
    let (a, b) = (slope(|edge| edge.a), slope(|edge| edge.b));
    !(a == 0.0 && b == 0.0) && !owns_zero(draw, a, b)
}

fn is_between(u: i64, begin: f32, size: f32) -> bool {
    let (begin, end) = (f64::from(begin), f64::from(begin) + f64::from(size));
    let pixels = u as f64 / GRID as f64;
    pixels >= begin.min(end) && pixels < begin.max(end)
}

fn covers(draw: &Draw, triangle: &Triangle, point: [i64; 2]) -> bool {
    let edges = triangle.at(point);
    let is_inside = (0..3).all(|i| {
        let (a, b) = (triangle.edges[i].a as f64, triangle.edges[i].b as f64);
        edges[i] > 0.0 || (edges[i] == 0.0 && owns_zero(draw, a, b))
    });
    if !is_inside
        || !is_between(point[0], draw.viewport_x, draw.viewport_width)
        || !is_between(point[1], draw.viewport_y, draw.viewport_height)
    {
        return false;
    }
    let weights = quotient(edges, triangle.w);
    if !draw.depth_clamp {
        let is_opengl = draw.rules == Rules::OpenGl;
        let (z, w) = (triangle.z, triangle.w);
        let near = [0, 1, 2].map(|i| if is_opengl { z[i] + w[i] } else { z[i] });
        let far = [0, 1, 2].map(|i| w[i] - z[i]);
        if sum(product(near, weights)) < 0.0 || sum(product(far, weights)) < 0.0 {
            return false;
        }
    }
    let count = draw.clip_distance_count;
    (0..count).all(|d| {
        let height = |vertex: usize| f64::from(draw.clip_distances[vertex * count + d]);
        !is_cut(draw, triangle, triangle.vertices.map(height), weights)
    })
}

fn depth_at(draw: &Draw, triangle: &Triangle, point: [i64; 2]) -> f32 {
    let (near, far) = (f64::from(draw.min_depth), f64::from(draw.max_depth));
    let (z, edges) = (quotient(triangle.z, triangle.w), triangle.at(point));
    // Adds differences to the first depth, so that equal depths come out equal.
    let rise = (z[1] - z[0]) * edges[1] + (z[2] - z[0]) * edges[2];
    let mut depth = z[0] + rise / sum(edges);
    if draw.rules == Rules::OpenGl {
        depth = (depth + 1.0) / 2.0;
    }
    depth = near + (far - near) * depth;
    if draw.depth_clamp || draw.rules == Rules::D3d {
        depth = depth.max(near.min(far)).min(near.max(far));
    }
    depth as f32
}

/// The attributes at a sample, or at a point of the pixel that stands for its centroid.
fn shade(draw: &Draw, triangle: &Triangle, sample: [i64; 2], centroid: [i64; 2]) -> Vec<f32> {
    let provoking = if draw.rules == Rules::OpenGl { 2 } else { 0 };
    let value = |i: usize| {
        let corners = triangle.vertices.map(|v| draw.values[v * draw.attribute_count + i]);
        let is_centroid = draw.locations[i] == Location::Centroid;
        let edges = triangle.at(if is_centroid { centroid } else { sample });
        let weights = match draw.interpolations[i] {
            Interpolation::Flat => return corners[provoking],
            Interpolation::Noperspective => edges,
            Interpolation::Smooth => quotient(edges, triangle.w),
        };
        (sum(product(corners.map(f64::from), weights)) / sum(weights)) as f32
    };
    (0..draw.attribute_count).map(value).collect()
}

fn draw_pixel(draw: &Draw, triangle: &Triangle, number: usize, pixel: [i64; 2], out: &mut Answer) {
    let point = |s: usize| {
        let place = draw.sample_positions[s].map(|p| to_nearest_even(f64::from(p) * GRID as f64));
        [pixel[0] * GRID + place[0], pixel[1] * GRID + place[1]]
    };
    let covered: Vec<usize> =
        (0..draw.samples).filter(|&s| covers(draw, triangle, point(s))).collect();
    let centroid = match covered.first() {
        Some(&first) if covered.len() < draw.samples => point(first),
        _ => pixel.map(|p| p * GRID + GRID / 2),
    };
    for s in covered {
        let place = [pixel[0] as usize, pixel[1] as usize, s];
        let depth = depth_at(draw, triangle, point(s));
        if draw.depth_test && depth >= out.depth(place).unwrap_or(draw.depth_clear) {
            continue;
        }
        out.put(place, number, depth, &shade(draw, triangle, point(s), centroid));
    }
}

/// Whether the far border of the viewport is where it should be, and not too far away.
fn is_usable(begin: f32, size: f32) -> bool {
    let (begin, size) = (f64::from(begin), f64::from(size));
    let end = begin + size;
    (begin + size / 2.0).abs() <= GUARD_BAND && end - begin == size && end - size == begin
}

/// Pixels that a triangle's box, the scissor and the framebuffer have in common, along an axis.
fn pixels(corners: [i64; 3], scissor: i32, scissor_size: i32, size: usize) -> std::ops::Range<i64> {
    let least = corners[0].min(corners[1]).min(corners[2]).div_euclid(GRID);
    let most = corners[0].max(corners[1]).max(corners[2]).div_euclid(GRID);
    let scissor_end = i64::from(scissor) + i64::from(scissor_size);
    least.max(i64::from(scissor)).max(0)..(most + 1).min(scissor_end).min(size as i64)
}

fn draw_all(draw: &Draw) -> Result<Answer, String> {
    if !is_usable(draw.viewport_x, draw.viewport_width)
        || !is_usable(draw.viewport_y, draw.viewport_height)
    {
        return Err("a viewport that is too far away, or of too many digits".into());
    }
    let mut out = Answer::new(draw);
    for (number, &vertices) in draw.triangles.iter().enumerate() {
        let mut triangle = Triangle::new(draw, vertices)
            .ok_or("a vertex beyond the guard band, or z/w beyond 65536")?;
        if !triangle.orient(draw) {
            continue;
        }
        for y in pixels(triangle.y, draw.scissor_y, draw.scissor_height, draw.height) {
            for x in pixels(triangle.x, draw.scissor_x, draw.scissor_width, draw.width) {
                draw_pixel(draw, &triangle, number, [x, y], &mut out);
            }
        }
    }
    Ok(out)
}

fn main() -> std::io::Result<()> {
    draws::serve(HELLO, draw_all)
}
