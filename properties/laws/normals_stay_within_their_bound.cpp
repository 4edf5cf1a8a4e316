// Normals stay within their bound: each component of the unit normal that a backend computes from a
// normal and a model matrix is no farther from the exact component than its contract says
// (cases::Contract::normal_bound), and a normal whose image is zero becomes zero.
//
// Why. A plane's normal is perpendicular to its tangents. Under a model A the tangents become A t,
// and (C n) · (A t) = det A (n · t) with C the cofactors of A, so C n is perpendicular to the new
// tangents for any A. With the sign of det A, it also stays on the same side of the plane. A n is
// not perpendicular if A scales the axes differently. Cofactors are products of two numbers and
// nothing is divided, so only cancellation may cost digits: the bound is in parts of ‖|C| |n|‖ / ‖C
// n‖.
//
// The normals of a case are x, y and z of its positions, of any length. All normals of cases with a
// camera are judged, by squares of exact numbers.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "oracle/judged_normals.h"
#include "properties/camera_matrices.h"
#include "properties/judged_law.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::normals_stay_within_their_bound_law {
namespace {

using cases::Matrix4;
using cases::Normal;
using records::AttributeKind;
using records::FragmentClass;

std::vector<Normal> normals_of(const cases::Case& c) {
  std::vector<Normal> normals;
  normals.reserve(c.positions.size());
  for (const cases::ClipVertex& p : c.positions) normals.push_back({p.x, p.y, p.z});
  return normals;
}

void add_labels(const oracle::JudgedNormal& judged, std::set<std::string>& labels) {
  if (!judged.has_direction) labels.emplace("no direction");
  if (judged.is_mirrored) labels.emplace("mirrored");
  if (judged.is_singular) labels.emplace("singular");
  if (judged.has_direction && judged.is_cancelled) labels.emplace("cancellation");
}

Check judge(const cases::Case& c, const std::vector<Normal>& computed, float bound) {
  const std::vector<oracle::JudgedNormal> judged =
      oracle::judge_normals(c.camera->model, normals_of(c), computed, bound);
  Check found;
  std::set<std::string> labels;
  auto& classes = found.judgement.errors[AttributeKind::coverage].classes;
  for (std::uint32_t vertex = 0; vertex < judged.size(); ++vertex) {
    ++found.judgement.counts.required;
    add_labels(judged[vertex], labels);
    for (std::size_t i = 0; i < 3; ++i) {
      const oracle::JudgedComponent& one = judged[vertex].components[i];
      ++classes[one.fragment_class];
      if (one.fragment_class == FragmentClass::correct) continue;
      records::Violation violation;
      violation.fragment_class = one.fragment_class;
      violation.exact = records::to_decimal(one.exact, 17);
      violation.actual = value_text(computed[vertex][i]);
      violation.note =
          fmt::format("{} of the unit normal computed from ({}, {}, {}), position {}", "xyz"[i],
                      c.positions[vertex].x, c.positions[vertex].y, c.positions[vertex].z, vertex);
      add_judged_violation(found, violation);
    }
  }
  found.labels.assign(labels.begin(), labels.end());
  return found;
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, std::uint64_t /*index*/) {
  const std::optional<float> bound = backend.contract(c).normal_bound;
  if (!c.camera || backend.vertex_stage() == nullptr || !bound)
    return not_applicable("the backend promises no normals, or the case has no camera");
  const auto computed = transform_normals(c.camera->model, normals_of(c), backend);
  if (!computed) return tl::unexpected(computed.error());
  return judge(c, *computed, *bound);
}

bool is_promised(backends::Backend& backend) {
  return backend.vertex_stage() != nullptr && backend.contract({}).normal_bound.has_value();
}

// The cases.

float& at(Matrix4& model, std::size_t row, std::size_t column) { return model[4 * row + column]; }

void make_rotated(Draw& draw, Matrix4& model) {
  const int axis = draw.between(0, 2);
  model = rotation(static_cast<std::size_t>(axis), draw.uniform(-1, 1));
  const float far = draw.spread(0, 30);  // normals must ignore the translation
  for (std::size_t row = 0; row < 3; ++row) at(model, row, 3) = far;
}

/// Scales each axis by its own factor, sometimes with a shear or a mirror.
void make_scaled(Draw& draw, Matrix4& model) {
  const bool is_mirrored = draw.one_in(2);
  for (std::size_t i = 0; i < 3; ++i) at(model, i, i) = std::fabs(draw.spread(-12, 12));
  if (is_mirrored) at(model, 1, 1) = -at(model, 1, 1);
  if (draw.one_in(2)) at(model, 0, 1) = draw.uniform(-1, 1);
  if (draw.one_in(2)) at(model, 2, 0) = draw.uniform(-1, 1);
}

void make_any(Draw& draw, Matrix4& model) {
  const int exponent = draw.between(-40, 40);
  model = any_matrix(draw, exponent);
}

/// Uses numbers as large and as small as float32 allows.
void make_extreme(Draw& draw, Matrix4& model) {
  const int least = draw.pick(std::array{-149, -149, -126, 100});
  for (float& number : model) number = draw.spread(least, draw.one_in(2) ? least + 20 : 127);
}

/// Makes a row the sum of the other two rows, all integers; in some cases, one number is then off
/// by a float.
void make_nearly_singular(Draw& draw, Matrix4& model) {
  const int bits = draw.between(3, 22);
  const int most = 1 << bits;
  for (std::size_t column = 0; column < 3; ++column) {
    const int first = draw.between(-most, most);
    const int second = draw.between(-most, most);
    at(model, 0, column) = static_cast<float>(first);
    at(model, 1, column) = static_cast<float>(second);
    at(model, 2, column) = static_cast<float>(first + second);
  }
  if (draw.one_in(3)) return;
  float& moved = at(model, 2, 0);
  moved = nudged(draw, moved);
}

/// Flattens everything into a plane, as planar shadows do. A normal that equals a row of the model
/// then becomes zero.
void make_flat(Draw& draw, Matrix4& model) {
  const int exponent = draw.between(-4, 4);
  model = any_matrix(draw, exponent);
  const int row = draw.between(0, 2);
  for (std::size_t column = 0; column < 3; ++column) {
    at(model, static_cast<std::size_t>(row), column) = 0;
  }
}

/// A normal of any length, along an axis, equal to a row of the model, or zero.
cases::ClipVertex random_normal(Draw& draw, const Matrix4& model) {
  cases::ClipVertex n;
  const int middle = draw.pick(std::array{0, 0, 0, 0, -140, 120});
  const int least = std::max(middle - 6, -149);
  switch (draw.between(0, 7)) {
    case 0:
      n.x = draw.spread(least, middle);
      return n;
    case 1:
      n.z = draw.spread(least, middle);
      return n;
    case 2:
    case 3: {
      const auto row = static_cast<std::size_t>(draw.between(0, 2));
      return {model[4 * row], model[4 * row + 1], model[4 * row + 2], 1};
    }
    case 4:
      if (draw.one_in(2)) return n;
      break;
    default:
      break;
  }
  n.x = draw.spread(least, middle);
  n.y = draw.spread(least, middle);
  n.z = draw.spread(least, middle);
  return n;
}

Generated generate(Draw& draw) {
  struct Sort {
    const char* name;
    void (*make)(Draw&, Matrix4&);
  };
  constexpr std::array<Sort, 6> kSorts{{{"rotated", &make_rotated},
                                        {"scaled", &make_scaled},
                                        {"any matrix", &make_any},
                                        {"extreme", &make_extreme},
                                        {"nearly singular", &make_nearly_singular},
                                        {"flat", &make_flat}}};
  Generated made;
  StateRequest request;
  request.has_clip_distances = false;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.camera.emplace();
  const Sort& sort = draw.pick(kSorts);
  sort.make(draw, c.camera->model);
  const int triangles = draw.between(1, 3);
  for (int i = 0; i < triangles; ++i) {
    const cases::ClipVertex first = random_normal(draw, c.camera->model);
    const cases::ClipVertex second = random_normal(draw, c.camera->model);
    const cases::ClipVertex third = random_normal(draw, c.camera->model);
    add_triangle(c, first, second, third);
  }
  add_attribute_values(draw, c);
  made.stratum = sort.name;
  return made;
}

const LawRegistration kRegistration(
    {.id = "normals-stay-within-their-bound",
     .sentence = "normals stay within their bound",
     .reason = "C n, with C the cofactors of the model, is perpendicular to what A makes of the "
               "tangents, and needs no division.",
     .exceptions = "cases without a camera; backends that transform no normals",
     .generate = &generate,
     .check_given = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend has no vertex stage or promises no bound for normals",
     .covers = {cover(14, "mirrored"), cover(22, "no direction"), cover(13, "singular")}});

}  // namespace
}  // namespace rastercheck::properties::normals_stay_within_their_bound_law
