//! Reads draws and writes answers: the part of an exec: program that every rasterizer needs.
//!
//! Copy this file. docs/exec-protocol.md says what each member means.

#![allow(dead_code)] // not every rasterizer needs all of it

use std::collections::HashMap;
use std::io::{self, BufRead, Read, Write};
use std::str::FromStr;

/// Enumerations, and the names that their members have in a draw's line.
macro_rules! names {
    ($($type:ident { $($member:ident $name:literal)+ })+) => {$(
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $type { $($member),+ }
        impl FromStr for $type {
            type Err = ();
            fn from_str(name: &str) -> Result<$type, ()> {
                match name { $($name => Ok($type::$member),)+ _ => Err(()) }
            }
        }
    )+};
}
names! {
    Rules { OpenGl "opengl" Vulkan "vulkan" D3d "d3d" }
    Cull { None "none" Back "back" Front "front" }
    FrontFace { Ccw "ccw" Cw "cw" }
    Coverage { Exact "exact" Snapped "snapped" }
    Rounding { NearestEven "nearest_even" HalfUp "half_up" }
    TieRule { TopLeft "top_left" BottomLeft "bottom_left" }
    Basis { Ideal "ideal" Snapped "snapped" Unspecified "unspecified" }
    Interpolation { Smooth "smooth" Noperspective "noperspective" Flat "flat" }
    Location { Sample "sample" Center "center" Centroid "centroid" }
    Primitive { Triangles "triangles" Lines "lines" Points "points" }
    LineMode { Rectangular "rectangular" Parallelogram "parallelogram" Bresenham "bresenham" }
}

/// The members of a draw's line, and its arrays.
macro_rules! draw {
    ($($member:ident: $type:ty),+) => {
        #[derive(Clone, Debug)]
        pub struct Draw {
            $(pub $member: $type,)+
            pub interpolations: Vec<Interpolation>,
            pub locations: Vec<Location>,
            pub sample_positions: Vec<[f32; 2]>, // within the pixel
            pub positions: Vec<[f32; 4]>,        // of vertices, in clip space: x, y, z, w
            pub values: Vec<f32>,                // [vertex][attribute]
            pub clip_distances: Vec<f32>,        // [vertex][distance]
            pub triangles: Vec<[usize; 3]>,      // vertices
        }
        impl Draw {
            /// A draw without its arrays.
            fn from_line(line: &Line) -> io::Result<Draw> {
                Ok(Draw {
                    $($member: line.get(stringify!($member))?,)+
                    interpolations: line.list("interpolations")?,
                    locations: line.list("locations")?,
                    sample_positions: vec![],
                    positions: vec![],
                    values: vec![],
                    clip_distances: vec![],
                    triangles: vec![],
                })
            }
        }
    };
}
draw! {
    rules: Rules, width: usize, height: usize, samples: usize,
    viewport_x: f32, viewport_y: f32, viewport_width: f32, viewport_height: f32,
    min_depth: f32, max_depth: f32,
    scissor_x: i32, scissor_y: i32, scissor_width: i32, scissor_height: i32,
    cull: Cull, front_face: FrontFace,
    depth_test: bool, depth_clamp: bool, depth_clear: f32,
    bias_constant: f32, bias_slope: f32, bias_clamp: f32, depth_bits: u32,
    primitive: Primitive, line_mode: LineMode, line_width: f32, point_size: f32,
    coverage: Coverage, subpixel_bits: u32, rounding: Rounding, tie_rule: TieRule, basis: Basis,
    vertex_count: usize, triangle_count: usize,
    attribute_count: usize, clip_distance_count: usize
}

/// What was drawn. Places are [x, y, sample].
pub struct Answer {
    size: [usize; 3],      // of the framebuffer: width, height, samples
    rows: [usize; 3],      // of the arrays: numbers for each sample
    arrays: [Vec<u32>; 3], // what is seen (0, or a triangle plus 1), depth and attributes, as bits
    min: [usize; 2],       // the pixels min <= (x, y) < max hold all that was drawn
    max: [usize; 2],
}

impl Answer {
    /// A framebuffer in which nothing is drawn yet.
    pub fn new(draw: &Draw) -> Answer {
        let rows = [1, 1, draw.attribute_count];
        let count = draw.width * draw.height * draw.samples;
        Answer {
            size: [draw.width, draw.height, draw.samples],
            rows,
            arrays: rows.map(|row| vec![0; count * row]),
            min: [draw.width, draw.height],
            max: [0, 0],
        }
    }

    fn index(&self, [x, y, sample]: [usize; 3]) -> usize {
        (y * self.size[0] + x) * self.size[2] + sample
    }

    /// The depth that was drawn.
    pub fn depth(&self, place: [usize; 3]) -> Option<f32> {
        let i = self.index(place);
        Some(f32::from_bits(self.arrays[1][i])).filter(|_| self.arrays[0][i] > 0)
    }

    /// Covers a sample, which has a number for each attribute.
    pub fn put(&mut self, place: [usize; 3], triangle: usize, depth: f32, values: &[f32]) {
        let (i, row) = (self.index(place), self.rows[2]);
        self.arrays[0][i] = triangle as u32 + 1;
        self.arrays[1][i] = depth.to_bits();
        for (to, value) in self.arrays[2][i * row..(i + 1) * row].iter_mut().zip(values) {
            *to = value.to_bits();
        }
        for axis in 0..2 {
            self.min[axis] = self.min[axis].min(place[axis]);
            self.max[axis] = self.max[axis].max(place[axis] + 1);
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        let ([x0, y0], [x1, y1]) = (if self.max[0] > 0 { self.min } else { [0, 0] }, self.max);
        let bytes = (x1 - x0) * (y1 - y0) * self.size[2] * 4 * self.rows.iter().sum::<usize>();
        let mut to = format!(
            r#"{{"status":"ok","min_x":{},"min_y":{},"max_x":{},"max_y":{},"bytes":{}}}"#,
            x0, y0, x1, y1, bytes
        )
        .into_bytes();
        to.push(b'\n');
        to.reserve(bytes);
        for (array, row) in self.arrays.iter().zip(self.rows) {
            for y in y0..y1 {
                let (begin, end) = (self.index([x0, y, 0]), self.index([x1, y, 0]));
                for number in &array[begin * row..end * row] {
                    to.extend_from_slice(&number.to_le_bytes());
                }
            }
        }
        to
    }
}

fn wrong(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

fn without_quotes(text: &str) -> &str {
    text.trim().trim_matches('"')
}

/// A line of JSON, an object: keys and the texts of values, strings without their quotes.
struct Line<'a>(HashMap<&'a str, &'a str>);

impl<'a> Line<'a> {
    /// Reads no escapes (there are none in a draw), but finds where values with escapes end.
    fn new(line: &'a str) -> Line<'a> {
        let (mut members, mut key, mut begin) = (HashMap::new(), "", 0);
        let (mut depth, mut is_text, mut is_escaped) = (0, false, false);
        for (i, byte) in line.bytes().enumerate() {
            if is_text {
                is_text = is_escaped || byte != b'"';
                is_escaped = !is_escaped && byte == b'\\';
                continue;
            }
            match byte {
                b'"' => is_text = true,
                b'{' | b'[' => depth += 1,
                b'}' | b']' => depth -= 1,
                _ => {}
            }
            match (byte, depth) {
                (b'{', 1) => begin = i + 1,
                (b':', 1) => {
                    key = without_quotes(&line[begin..i]);
                    begin = i + 1;
                }
                (b',', 1) | (b'}', 0) => {
                    members.insert(key, without_quotes(&line[begin..i]));
                    begin = i + 1;
                }
                _ => {}
            }
        }
        Line(members)
    }

    fn get<T: FromStr>(&self, key: &str) -> io::Result<T> {
        let value = self.0.get(key).ok_or_else(|| wrong(&format!("no {}", key)))?;
        value.parse().map_err(|_| wrong(&format!("{}: {}", key, value)))
    }

    fn list<T: FromStr>(&self, key: &str) -> io::Result<Vec<T>> {
        let list: String = self.get(key)?;
        let texts = list.trim_matches(|c| c == '[' || c == ']').split(',').map(without_quotes);
        let values = texts.filter(|text| !text.is_empty()).map(|text| text.parse());
        values.collect::<Result<_, _>>().map_err(|_| wrong(&format!("{}: {}", key, list)))
    }
}

/// Reads the arrays that follow a line.
fn read_draw(line: &str, input: &mut impl Read) -> io::Result<Draw> {
    let line = Line::new(line);
    let mut draw = Draw::from_line(&line)?;
    let mut bytes = vec![0; line.get("bytes")?];
    input.read_exact(&mut bytes)?;
    let mut words = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let mut word = || words.next().unwrap_or_default();
    let mut float = || f32::from_bits(word());
    draw.sample_positions = (0..draw.samples).map(|_| [float(), float()]).collect();
    let position = |_| [float(), float(), float(), float()];
    draw.positions = (0..draw.vertex_count).map(position).collect();
    draw.values = (0..draw.vertex_count * draw.attribute_count).map(|_| float()).collect();
    draw.clip_distances =
        (0..draw.vertex_count * draw.clip_distance_count).map(|_| float()).collect();
    let mut vertex = || word() as usize;
    draw.triangles = (0..draw.triangle_count).map(|_| [vertex(), vertex(), vertex()]).collect();
    Ok(draw)
}

/// Answers draws until the input ends. `hello` is the program's hello, on any number of lines. If
/// `draw` does not support a draw, it says why, in plain text.
pub fn serve(hello: &str, draw: impl Fn(&Draw) -> Result<Answer, String>) -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::stdout().lock());
    let mut line = String::new();
    input.read_line(&mut line)?;
    let mut answer = hello.replace('\n', " ").into_bytes();
    answer.push(b'\n');
    loop {
        output.write_all(&answer)?;
        output.flush()?;
        line.clear();
        if input.read_line(&mut line)? == 0 {
            return Ok(());
        }
        answer = match draw(&read_draw(&line, &mut input)?) {
            Ok(drawn) => drawn.to_bytes(),
            Err(why) => {
                format!("{{\"status\":\"unsupported\",\"message\":{:?}}}\n", why).into_bytes()
            }
        };
    }
}
