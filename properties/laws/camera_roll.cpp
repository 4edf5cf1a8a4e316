// A roll by a quarter turns the picture: if a camera is rolled by 90° about its viewing direction
// (R P replaces the projection P), it shows the picture turned by 90° in the turned viewport.
//
// Why. R takes the clip position (x, y, z, w) to (∓y, ±x, z, w): its rows are rows of the identity
// up to signs, so R P is P with two rows exchanged and signs changed, without any rounding. So the
// clip positions R P V M p are the turned clip positions P V M p (RULES §1), and the picture turns
// by (u, v) → (H − v, u) (internal/quarter_turn.h).
//
// The law checks two consequences.
//
//   The vertex stage  gives positions for the rolled camera that, turned back, are within the
//                     contract's bound of the original camera's exact positions: each sum of
//                     products is the same up to its sign, and so is (|P| |V| |M| |p|)_k, in which
//                     the bound is measured. A stage that handles only diagonal projections well
//                     fails here.
//   The picture       of these positions, turned back, is right for the turned-back positions: it
//                     has the same coverage, values and facing, since det M stays the same.
//
// A backend without a vertex stage gets clip positions that are rounded once. The exceptions are
// those of "a quarter turn turns the picture"; cases without a camera, or with clip positions
// beyond float32, are left out as well.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracle/judged_transform.h"
#include "oracle/transform.h"
#include "properties/camera_matrices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/changed_drawing.h"
#include "properties/laws/internal/quarter_turn.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/window_symmetry.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::camera_roll_law {
namespace {

using cases::Matrix4;
using records::AttributeKind;
using records::FragmentClass;

/// Returns R P.
Matrix4 rolled(const Matrix4& projection, const QuarterTurn& turn) {
  Matrix4 result = projection;
  for (std::size_t column = 0; column < 4; ++column) {
    const float of_x = projection[column];
    const float of_y = projection[4 + column];
    result[column] = turn.negates_y ? -of_y : of_y;
    result[4 + column] = turn.negates_x ? -of_x : of_x;
  }
  return result;
}

/// Returns the clip positions that a backend's vertex stage computes for a camera case or, if it
/// has none, the clip positions that the backend is given.
Result<std::vector<cases::ClipVertex>> positions_of(const cases::Case& c,
                                                    backends::Backend& backend) {
  if (backend.vertex_stage() != nullptr) return transform(c, backend);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  if (!clip) return tl::unexpected(clip.error());
  return clip->positions;
}

/// Checks the rolled camera's positions, already turned back, against the original camera.
void judge_positions(const cases::Case& c, const std::vector<cases::ClipVertex>& positions,
                     float bound, Check& check) {
  const auto judged = oracle::judge_transform(c, positions, bound);
  for (std::size_t vertex = 0; vertex < judged.size(); ++vertex) {
    const cases::ClipVertex& p = positions[vertex];
    const std::array<float, 4> f{p.x, p.y, p.z, p.w};
    for (std::size_t k = 0; k < 4; ++k) {
      const oracle::JudgedNumber& one = judged[vertex][k];
      if (one.fragment_class == FragmentClass::correct) continue;
      ++check.judgement.errors[AttributeKind::coverage].classes[one.fragment_class];
      records::Violation violation;
      violation.fragment_class = one.fragment_class;
      violation.exact = one.exact.to_string();
      violation.actual = value_text(f[k]);
      violation.error = one.error;
      violation.bound = one.bound;
      violation.note = fmt::format(
          "clip {} of vertex {}, drawn with the rolled camera and turned back", "xyzw"[k], vertex);
      add_judged_violation(check, violation);
    }
  }
}

bool is_finite(const cases::ClipVertex& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

/// Draws the clip positions of the rolled camera, turns the drawing back, and compares it with a
/// drawing of the turned-back positions.
Result<Check> check_picture(const cases::Case& upright, const cases::Case& rolled_clip,
                            const QuarterTurn& turn, backends::Backend& backend,
                            std::uint64_t index) {
  const auto contract = turned_back(upright, backend.contract(rolled_clip));
  if (!contract)
    return not_applicable("the contract does not cover the turned case in the same way");
  const Result<backends::Drawn> before = draw_promised(upright, backend);
  if (!before) return tl::unexpected(before.error());
  const Result<backends::Drawn> drawn = draw_promised(rolled_clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check check = judge_changed(upright, *contract, before->fragments,
                              turned_back(upright, drawn->fragments, turn), index);
  add_to_notes(
      check, [&](const records::Violation& violation) { return turned_note(upright, violation); });
  return check;
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, std::uint64_t index) {
  if (!c.camera) return not_applicable("the case has no camera");
  cases::Case source = c;
  move_centroids_to_samples(source);
  const std::optional<QuarterTurn> turn = quarter_turn_of(source);
  if (!turn) return not_applicable("the turned camera cannot be stored as float32");
  cases::Case changed = turned_window(source, *turn);
  changed.camera->projection = rolled(source.camera->projection, *turn);
  Result<std::vector<cases::ClipVertex>> positions = positions_of(changed, backend);
  if (!positions) return tl::unexpected(positions.error());

  changed.camera.reset();
  changed.positions = *positions;
  cases::Case upright = source;
  upright.camera.reset();
  for (cases::ClipVertex& p : *positions) p = turned_back(p, *turn);
  upright.positions = *positions;
  Check check;
  if (std::all_of(positions->begin(), positions->end(), &is_finite)) {
    Result<Check> of_picture = check_picture(upright, changed, *turn, backend, index);
    if (!of_picture || !of_picture->is_applicable) return of_picture;
    check = *std::move(of_picture);
  }
  const std::optional<float> bound = backend.contract(source).transform_bound;
  if (backend.vertex_stage() != nullptr && bound) {
    judge_positions(source, *positions, *bound, check);
    add_label(check, "vertex stage");
  }
  return check;
}

// --- the law's own cases: cameras that look at triangles ----------------------------------------

/// A symmetric projection with near and far planes, and its scales in x and y.
struct RolledLens {
  double near = 0;
  double far = 0;
  double scale_x = 0;
  double scale_y = 0;
};

RolledLens random_lens(Draw& draw) {
  RolledLens lens;
  lens.near = double{draw.uniform(0.05F, 1)};
  lens.far = double{draw.uniform(20, 200)};
  lens.scale_x = double{draw.uniform(0.5F, 3)};
  lens.scale_y = double{draw.uniform(0.5F, 3)};
  return lens;
}

Matrix4 projection_of(const RolledLens& lens, cases::Rules rules) {
  const double depth = lens.near - lens.far;
  Matrix4 matrix{};
  matrix[0] = static_cast<float>(lens.scale_x);
  matrix[5] = static_cast<float>(lens.scale_y);
  if (rules == cases::Rules::opengl) {
    matrix[10] = static_cast<float>((lens.far + lens.near) / depth);
    matrix[11] = static_cast<float>(2 * lens.far * lens.near / depth);
  } else {
    matrix[10] = static_cast<float>(lens.far / depth);
    matrix[11] = static_cast<float>(lens.far * lens.near / depth);
  }
  matrix[14] = -1;
  return matrix;
}

using Point = std::array<double, 3>;

/// Returns the point that a rotation and a translation take to `p`; approximate, since the matrices
/// are rotations only up to rounding.
Point before_motion(const Matrix4& matrix, const Point& p) {
  Point result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[i] += double{matrix[k * 4 + i]} * (p[k] - double{matrix[k * 4 + 3]});
    }
  }
  return result;
}

/// Returns a rotation about an axis followed by a translation.
Matrix4 random_motion(Draw& draw, float farthest) {
  const int axis = draw.between(0, 2);
  Matrix4 matrix = rotation(static_cast<std::size_t>(axis), draw.uniform(-1, 1));
  for (std::size_t i = 0; i < 3; ++i) matrix[i * 4 + 3] = draw.uniform(-farthest, farthest);
  return matrix;
}

/// Returns the point that the camera sees at `ndc`, `distance` in front of the eye, or behind the
/// eye if negative.
Point eye_point(const RolledLens& lens, const std::array<double, 2>& ndc, double distance) {
  return {ndc[0] * distance / lens.scale_x, ndc[1] * distance / lens.scale_y, -distance};
}

/// Chooses how far in front of the eye a vertex is.
using Distance = double (*)(Draw& draw, const RolledLens& lens);

double in_front(Draw& draw, const RolledLens& lens) { return lens.near + 8 * double{draw.unit()}; }

/// One vertex in three is on the eye's side of the near plane.
double about_near_plane(Draw& draw, const RolledLens& lens) {
  return draw.one_in(3) ? lens.near / 2 : in_front(draw, lens);
}

/// One vertex in three is behind the eye.
double about_eye(Draw& draw, const RolledLens& lens) {
  return draw.one_in(3) ? -in_front(draw, lens) : in_front(draw, lens);
}

void add_triangles(Draw& draw, const RolledLens& lens, Distance distance_of, cases::Case& c) {
  const cases::Camera& camera = *c.camera;
  const int triangles = draw.between(1, 1 + draw.size() / 30);
  for (int i = 0; i < 3 * triangles; ++i) {
    const double x = double{draw.uniform(-1.25F, 1.25F)};
    const double y = double{draw.uniform(-1.25F, 1.25F)};
    const double distance = distance_of(draw, lens);
    const Point seen = eye_point(lens, {x, y}, distance);
    const Point p = before_motion(camera.model, before_motion(camera.view, seen));
    add_vertex(c, {to_float(p[0]), to_float(p[1]), to_float(p[2]), 1});
  }
  add_separate_triangles(c);
}

Generated generate(Draw& draw) {
  struct Sort {
    const char* name;
    Distance distance_of;
  };
  constexpr std::array<Sort, 4> kSorts{{{"in front of the camera", &in_front},
                                        {"in front of the camera", &in_front},
                                        {"through the near plane", &about_near_plane},
                                        {"through the eye's plane", &about_eye}}};
  Generated made;
  const Sort& sort = draw.pick(kSorts);
  made.stratum = sort.name;
  StateRequest request;
  request.least_side = 16;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  const bool is_turning = c.framebuffer.samples == 1 || c.framebuffer.samples == 4;
  if (!is_turning) c.framebuffer.samples = draw.one_in(2) ? 1 : 4;
  shorten_viewport(c);
  cases::Camera& camera = c.camera.emplace();
  camera.model = random_motion(draw, 2);
  camera.view = random_motion(draw, 10);
  const RolledLens lens = random_lens(draw);
  camera.projection = projection_of(lens, c.rules);
  add_triangles(draw, lens, sort.distance_of, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-roll-by-a-quarter-turns-the-picture",
     .sentence = "a roll by a quarter turns the picture",
     .reason = "R P is the projection P with two rows exchanged and signs changed: clip positions "
               "are turned by 90°.",
     .exceptions = "cases without a camera; what does not turn, as with a quarter turn",
     .generate = &generate,
     .check_given = &check,
     .covers = {cover(12, "clipped"), cover(6, "w <= 0"), cover(10, "several samples"),
                cover(10, "snapped")}});

}  // namespace
}  // namespace rastercheck::properties::camera_roll_law
