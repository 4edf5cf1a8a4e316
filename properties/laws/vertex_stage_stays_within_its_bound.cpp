// The vertex stage stays within its bound: each coordinate of clip = projection · view · model ·
// position that a backend computes is a number no farther from the exact coordinate than the
// contract says (cases::Contract::transform_bound). RULES §3 asks this of a backend that is given
// camera and object positions.
//
// The bound is in parts of (|P| |V| |M| |p|)_k, plus half an ulp for rounding to float32, so only
// cancellation may cost digits. The bound also holds if clip coordinates are subnormal, or if a
// product of two matrices exceeds float32. All vertices of cases with a camera are judged.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "oracle/judged_transform.h"
#include "properties/camera_matrices.h"
#include "properties/judged_law.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::vertex_stage_stays_within_its_bound_law {
namespace {

using cases::Matrix4;
using records::AttributeKind;
using records::FragmentClass;

std::array<float, 4> coordinates_of(const cases::ClipVertex& p) { return {p.x, p.y, p.z, p.w}; }

/// The first triangle with this vertex; 0 if none has it.
std::uint32_t triangle_with(const cases::Case& c, std::uint32_t vertex) {
  const auto found = std::find_if(
      c.triangles.begin(), c.triangles.end(), [vertex](const cases::Triangle& triangle) {
        return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
      });
  return found == c.triangles.end() ? 0 : static_cast<std::uint32_t>(found - c.triangles.begin());
}

void add_labels(const oracle::JudgedPosition& judged, const cases::ClipVertex& computed,
                std::set<std::string>& labels) {
  const std::array<float, 4> f = coordinates_of(computed);
  for (std::size_t k = 0; k < 4; ++k) {
    if (judged[k].is_cancelled) labels.emplace("cancellation");
    if (std::fpclassify(f[k]) == FP_SUBNORMAL) labels.emplace("subnormal");
    if (std::isinf(f[k])) labels.emplace("beyond float32");
  }
  if (computed.w <= 0) labels.emplace("w <= 0");
}

Check judge(const cases::Case& c, const std::vector<cases::ClipVertex>& computed, float bound) {
  const std::vector<oracle::JudgedPosition> judged = oracle::judge_transform(c, computed, bound);
  Check found;
  std::set<std::string> labels;
  auto& classes = found.judgement.errors[AttributeKind::coverage].classes;
  for (std::uint32_t vertex = 0; vertex < judged.size(); ++vertex) {
    ++found.judgement.counts.required;
    add_labels(judged[vertex], computed[vertex], labels);
    for (std::size_t k = 0; k < 4; ++k) {
      const oracle::JudgedNumber& one = judged[vertex][k];
      ++classes[one.fragment_class];
      if (one.fragment_class == FragmentClass::correct) continue;
      records::Violation violation;
      violation.fragment_class = one.fragment_class;
      violation.place.triangle = triangle_with(c, vertex);
      violation.exact = one.exact.to_string();
      violation.actual = value_text(coordinates_of(computed[vertex])[k]);
      violation.error = one.error;
      violation.bound = one.bound;
      violation.note = fmt::format("clip {} of vertex {}; errors in its ULP", "xyzw"[k], vertex);
      add_judged_violation(found, violation);
    }
  }
  found.labels.assign(labels.begin(), labels.end());
  return found;
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, std::uint64_t /*index*/) {
  const std::optional<float> bound = backend.contract(c).transform_bound;
  if (!c.camera || backend.vertex_stage() == nullptr || !bound)
    return not_applicable("the backend promises no vertex stage, or the case has no camera");
  const Result<std::vector<cases::ClipVertex>> computed = transform(c, backend);
  if (!computed) return tl::unexpected(computed.error());
  return judge(c, *computed, *bound);
}

bool is_promised(backends::Backend& backend) {
  return backend.vertex_stage() != nullptr && backend.contract({}).transform_bound.has_value();
}

// The cases. Numbers have up to 24 bits, so that hardly any sum is exact.

/// Returns a perspective as in real programs, with random near and far planes and scales.
Matrix4 perspective(Draw& draw) {
  const double near = double{draw.uniform(0.01F, 1)};
  const double far = double{draw.uniform(10, 1000)};
  Matrix4 matrix{};
  matrix[0] = draw.uniform(0.5F, 3);
  matrix[5] = draw.uniform(-3, 3);
  matrix[10] = static_cast<float>(far / (near - far));
  matrix[11] = static_cast<float>(near * far / (near - far));
  matrix[14] = -1;
  return matrix;
}

void add_vertices(Draw& draw, cases::Case& c, int exponent) {
  const int triangles = draw.between(1, 3);
  const bool is_affine = draw.one_in(2);
  for (int i = 0; i < 3 * triangles; ++i) {
    cases::ClipVertex p;
    p.x = draw.spread(std::max(exponent - 6, -149), exponent);
    p.y = draw.spread(std::max(exponent - 6, -149), exponent);
    p.z = draw.spread(std::max(exponent - 6, -149), exponent);
    p.w = is_affine ? 1 : draw.spread(std::max(exponent - 6, -149), exponent);
    add_vertex(c, p);
  }
  add_separate_triangles(c);
}

/// Makes a model in front of a perspective camera.
void make_ordinary(Draw& draw, cases::Case& c) {
  cases::Camera& camera = *c.camera;
  const int axis = draw.between(0, 2);
  camera.model = rotation(static_cast<std::size_t>(axis), draw.uniform(-1, 1));
  const float x = draw.uniform(-2, 2);
  const float y = draw.uniform(-2, 2);
  const float z = draw.uniform(-20, -2);
  camera.view = translation(x, y, z);
  camera.projection = perspective(draw);
  add_vertices(draw, c, 0);
}

/// Makes a model far from the origin, viewed from nearby: the translations of model and view nearly
/// cancel.
void make_far_from_origin(Draw& draw, cases::Case& c) {
  cases::Camera& camera = *c.camera;
  const int exponent = draw.between(8, 40);
  const float x = draw.spread(exponent - 2, exponent);
  const float y = draw.spread(exponent - 2, exponent);
  const float z = draw.spread(exponent - 2, exponent);
  camera.model = translation(x, y, z);
  const int axis = draw.between(0, 2);
  const Matrix4 turn = rotation(static_cast<std::size_t>(axis), draw.uniform(-0.25F, 0.25F));
  const float back_x = nudged(draw, -x);
  const float back_y = nudged(draw, -y);
  const float back_z = nudged(draw, -z);
  camera.view = translation(back_x, back_y, back_z);
  if (draw.one_in(2)) std::swap(camera.model, camera.view);
  if (draw.one_in(2)) camera.projection = turn;
  if (draw.one_in(2)) camera.projection = perspective(draw);
  add_vertices(draw, c, 0);
}

/// Makes a mirrored and sheared model with its axes scaled differently.
void make_mirrored(Draw& draw, cases::Case& c) {
  cases::Camera& camera = *c.camera;
  for (std::size_t i = 0; i < 3; ++i) camera.model[i * 5] = draw.spread(-12, 12);
  camera.model[0] = -std::fabs(camera.model[0]);
  camera.model[5] = std::fabs(camera.model[5]);
  camera.model[10] = std::fabs(camera.model[10]);
  camera.model[1] = draw.uniform(-1, 1);
  const int axis = draw.between(0, 2);
  camera.view = rotation(static_cast<std::size_t>(axis), draw.uniform(-1, 1));
  camera.projection = perspective(draw);
  add_vertices(draw, c, 2);
}

/// Chooses exponents for three matrices and a position that add up to `sum`, each anywhere in
/// float32's range, including subnormal numbers. A clip coordinate has 64 terms, each below 2^(sum
/// + 4).
void make_with_exponents(Draw& draw, cases::Case& c, int sum) {
  constexpr int kLeast = -140;
  constexpr int kMost = 120;
  std::array<int, 4> exponents{};
  int rest = sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const int parts = 3 - static_cast<int>(i);  // matrices and position after this one
    const int least = std::max(kLeast, rest - parts * kMost);
    const int most = std::min(kMost, rest - parts * kLeast);
    exponents[i] = draw.between(least, most);
    rest -= exponents[i];
  }
  exponents[3] = rest;
  cases::Camera& camera = *c.camera;
  camera.model = any_matrix(draw, exponents[0]);
  camera.view = any_matrix(draw, exponents[1]);
  camera.projection = any_matrix(draw, exponents[2]);
  add_vertices(draw, c, exponents[3]);
  // Replaces w = 1, which does not fit the other exponents.
  for (cases::ClipVertex& p : c.positions) {
    if (p.w == 1) p.w = p.x;
  }
}

/// Makes matrices without any structure.
void make_any(Draw& draw, cases::Case& c) { make_with_exponents(draw, c, draw.between(-40, 40)); }

/// Makes clip coordinates near the largest float32.
void make_huge(Draw& draw, cases::Case& c) { make_with_exponents(draw, c, draw.between(90, 117)); }

/// Makes clip coordinates that are subnormal or round to 0.
void make_tiny(Draw& draw, cases::Case& c) {
  make_with_exponents(draw, c, draw.between(-156, -126));
}

Generated generate(Draw& draw) {
  struct Sort {
    const char* name;
    void (*make)(Draw&, cases::Case&);
  };
  constexpr std::array<Sort, 6> kSorts{{{"ordinary", &make_ordinary},
                                        {"far from the origin", &make_far_from_origin},
                                        {"mirrored and sheared", &make_mirrored},
                                        {"any matrices", &make_any},
                                        {"huge", &make_huge},
                                        {"tiny", &make_tiny}}};
  Generated made;
  StateRequest request;
  request.has_clip_distances = false;
  made.source = random_state(draw, request);
  made.source.camera.emplace();
  const Sort& sort = draw.pick(kSorts);
  sort.make(draw, made.source);
  add_attribute_values(draw, made.source);
  made.stratum = sort.name;
  return made;
}

const LawRegistration kRegistration(
    {.id = "the-vertex-stage-stays-within-its-bound",
     .sentence = "the vertex stage stays within its bound",
     .reason = "clip = projection · view · model · position is a sum of products; only what "
               "cancels may cost digits.",
     .exceptions = "cases without a camera; backends without a vertex stage",
     .generate = &generate,
     .check_given = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend has no vertex stage or promises no bound for it",
     .covers = {cover(5, "cancellation"), cover(6, "subnormal"), cover(41, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::vertex_stage_stays_within_its_bound_law
