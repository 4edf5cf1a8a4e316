// Camera form equals clip form: what a camera shows at a sample lies on the ray from the eye
// through that sample, however the transform is distributed over the camera's matrices. The law
// checks clip positions, viewport, interpolation and depth against the camera, without any inverse.
//
// Why. The Rasterization slides give P = C + (c + u a + v b) w for the point P seen at (u, v), from
// the eye C and the basis of an image plane. The clip form says the same: P's clip position,
// projection · view · model · (P, 1), appears at (u, v) (RULES §1). If R_x … R_w are the rows of
// that matrix, both forms say
//
//   U · (P, 1) = 0,  U = R_x W/2 + (x0 + W/2 − u) R_w       V alike, from R_y
//   Z · (P, 1) = 0,  Z = s R_z − (d − l) R_w                d = l + s z/w, the depth
//
// An object position is linear over its triangle, so if it is stored in three smooth attributes,
// their values at a sample are the P seen there. If the attributes are off by at most δ_j and the
// depth by at most ε, the drawn P' satisfies
//
//   |U · (P', 1)| <= Σ |U_j| δ_j + ρ |w|      |Z · (P', 1)| <= Σ |Z_j| δ_j + ε |w|
//   |w| <= |R_w · (P', 1)| + Σ |R_wj| δ_j
//
// where ρ is how far snapping may move a vertex, in pixels, if values come from snapped vertices:
// the fragment at p is then a mean of vertices moved by at most ρ, so its true place is within ρ of
// p. The sums are computed in double, each with fewer than 16 roundings, so another 2^-48 of the
// summed absolute values is allowed.
//
// The numbers of matrices and positions have so few bits that the clip positions are exact in
// float32. So moving the product of view and model into the model, or of all three into the
// projection, gives the same camera. The harness must round each of these cameras to the same clip
// positions; a backend's vertex stage must compute the same clip positions or, if its contract
// allows, numbers within its bound.
//
// Samples: all drawn ones; but if values come from snapped vertices, only those of unclipped
// triangles. Depths: only if nothing is snapped or clamped. If a contract does not say where
// vertices are placed, the oracle judges the drawing.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracle/judged_transform.h"
#include "oracle/transform.h"
#include "properties/camera_matrices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/close_drawings.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::camera_form_equals_clip_form_law {
namespace {

using cases::ClipVertex;
using cases::Matrix4;
using records::AttributeKind;
using records::FragmentClass;

/// Returns the product if all its numbers are exact in float32, else nothing. Sums of four products
/// of numbers with few bits are exact in double.
std::optional<Matrix4> product(const Matrix4& left, const Matrix4& right) {
  Matrix4 result{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0;
      double size = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double term = double{left[4 * i + k]} * double{right[4 * k + j]};
        sum += term;
        size += std::abs(term);
      }
      result[4 * i + j] = to_float(sum);
      // If all sums are multiples of 2^-20 below 2^30, none was rounded.
      const bool is_short = size < 0x1p30 && std::floor(sum * 0x1p20) == sum * 0x1p20;
      if (!is_short || double{result[4 * i + j]} != sum) return std::nullopt;
    }
  }
  return result;
}

/// A case with a camera, rewritten in clip form, and the camera's matrices as one.
struct Forms {
  cases::Case clip;  ///< its attributes are the object position
  Matrix4 matrix{};
  std::vector<cases::Case> cameras;  ///< the same case, with its transform distributed differently
                                     ///< over the matrices
};

/// The case with x, y and z of its positions as attributes.
cases::Case with_positions(const cases::Case& c) {
  cases::Case result = c;
  result.depth_test = cases::DepthTest::none;
  result.attributes.clear();
  result.attribute_values.clear();
  for (const char* name : {"x", "y", "z"}) {
    result.attributes.push_back({name, cases::Interpolation::smooth, cases::Location::sample});
  }
  for (const ClipVertex& p : c.positions) {
    result.attribute_values.insert(result.attribute_values.end(), {p.x, p.y, p.z});
  }
  return result;
}

bool is_affine(const cases::Case& c) {
  return std::all_of(c.positions.begin(), c.positions.end(),
                     [](const ClipVertex& p) { return p.w == 1; });
}

/// Returns the forms of a case; nothing if the case has no camera, if any object position has w !=
/// 1, or if any number is rounded.
std::optional<Forms> forms_of(const cases::Case& c) {
  if (!c.camera || !is_affine(c)) return std::nullopt;
  const auto view_model = product(c.camera->view, c.camera->model);
  const auto matrix = view_model ? product(c.camera->projection, *view_model) : std::nullopt;
  const auto project_view = product(c.camera->projection, c.camera->view);
  if (!matrix || !project_view) return std::nullopt;
  Forms forms;
  forms.matrix = *matrix;
  const cases::Case source = with_positions(c);
  forms.clip = source;
  forms.clip.camera.reset();
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    const ClipVertex& p = c.positions[v];
    const auto column = product(*matrix, {p.x, 0, 0, 0, p.y, 0, 0, 0, p.z, 0, 0, 0, 1, 0, 0, 0});
    if (!column) return std::nullopt;
    forms.clip.positions[v] = {(*column)[0], (*column)[4], (*column)[8], (*column)[12]};
  }
  const Matrix4& one = cases::kIdentity;
  for (const cases::Camera& camera :
       {*c.camera, cases::Camera{*view_model, one, c.camera->projection},
        cases::Camera{one, *view_model, c.camera->projection},
        cases::Camera{c.camera->model, one, *project_view}, cases::Camera{one, one, *matrix},
        cases::Camera{*matrix, one, one}}) {
    forms.cameras.push_back(source);
    forms.cameras.back().camera = camera;
  }
  return forms;
}

std::array<float, 4> coordinates_of(const ClipVertex& p) { return {p.x, p.y, p.z, p.w}; }

/// Checks that the clip positions that a vertex stage computed from one form equal the case's clip
/// positions, or are within the bound.
void check_stage(const Forms& forms, const cases::Case& camera,
                 const std::vector<ClipVertex>& computed, float bound, Check& check) {
  if (computed == forms.clip.positions) return;  // nearly always
  const auto judged = oracle::judge_transform(camera, computed, bound);
  for (std::size_t v = 0; v < judged.size(); ++v) {
    for (std::size_t k = 0; k < 4; ++k) {
      const oracle::JudgedNumber& one = judged[v][k];
      if (one.fragment_class == FragmentClass::correct) continue;
      ++check.judgement.errors[AttributeKind::coverage].classes[one.fragment_class];
      records::Violation violation;
      violation.fragment_class = one.fragment_class;
      violation.exact = one.exact.to_string();
      violation.actual = value_text(coordinates_of(computed[v])[k]);
      violation.error = one.error;
      violation.bound = one.bound;
      violation.note = std::string("clip ") + "xyzw"[k] + " of vertex " + std::to_string(v) +
                       ", with the matrices distributed differently";
      add_judged_violation(check, violation);
    }
  }
}

/// A sum, and the sum of its terms' magnitudes.
struct Sum {
  double value = 0;
  double size = 0;
};

/// Coefficients of (x, y, z, 1), each with the magnitude of its terms.
using Row = std::array<Sum, 4>;

class RayCheck {
 public:
  RayCheck(const Forms& forms, const cases::Contract& contract)
      : forms_(&forms), contract_(contract), verdicts_(forms.clip, contract), tally_(forms.clip) {}

  Check run(const cases::Fragments& drawn) {
    if (!drawn.triangle.empty()) tally_.label("drawn");
    if (contract_.coverage) tally_.label("snapped");
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const cases::SamplePlace place = drawn.place_of(i);
      if (!is_of_case(forms_->clip, place)) continue;  // a matter for laws about coverage
      tally_.pass_required(place.triangle);
      if (has_promise(place.triangle)) see(place, drawn, i);
    }
    return tally_.finish();
  }

 private:
  bool takes_placed_positions() const {
    return contract_.coverage && contract_.basis != cases::Basis::ideal;
  }

  bool has_promise(std::uint32_t triangle) {
    if (!takes_placed_positions()) return true;
    if (promised_for_ != triangle) {
      is_promised_ = is_unclipped(triangle);
      promised_for_ = triangle;
    }
    return is_promised_;
  }

  bool is_unclipped(std::uint32_t triangle) {
    const cases::Case& c = forms_->clip;
    const float near = near_depth(c);
    for (const std::uint32_t vertex : c.triangles[triangle]) {
      const ClipVertex& p = c.positions[vertex];
      if (p.w <= 0 || (!c.depth_clamp && (p.z < near * p.w || p.z > p.w))) return false;
    }
    return verdicts_.truth(triangle).has_certain_orientation();
  }

  /// Returns a r + b R_w, where r is row `row` of the matrix.
  Row combined(double a, std::size_t row, double b) const {
    Row result;
    for (std::size_t j = 0; j < 4; ++j) {
      const double first = a * double{forms_->matrix[4 * row + j]};
      const double second = b * double{forms_->matrix[12 + j]};
      result[j] = {first + second, std::abs(first) + std::abs(second)};
    }
    return result;
  }

  /// The computed P' and what is known about it.
  struct Seen {
    std::array<double, 4> p{};
    std::array<double, 4> off{};  ///< δ_j
    double w = 0;                 ///< an upper bound for |w| of the exact P
  };

  static Sum times(const Row& row, const Seen& seen) {
    Sum sum;
    for (std::size_t j = 0; j < 4; ++j) {
      sum.value += row[j].value * seen.p[j];
      sum.size += row[j].size * std::abs(seen.p[j]);
    }
    return sum;
  }

  static double off_by(const Row& row, const Seen& seen) {
    double off = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      off += (std::abs(row[j].value) + 0x1p-50 * row[j].size) * seen.off[j];
    }
    return off;
  }

  std::optional<Seen> seen_of(const cases::SamplePlace& place,
                              std::span<const float> values) const {
    Seen seen;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto allowance =
          value_allowance(forms_->clip, contract_, forms_->clip.triangles[place.triangle], j);
      if (!allowance) return std::nullopt;
      seen.p[j] = number_of(values[j]);
      seen.off[j] = greatest_difference(*allowance, seen.p[j], seen.p[j]);
    }
    seen.p[3] = 1;
    const Row w = combined(0, 0, 1);
    seen.w = std::abs(times(w, seen).value) + off_by(w, seen);
    return seen;
  }

  void see(const cases::SamplePlace& place, const cases::Fragments& drawn, std::size_t i) {
    const auto seen = seen_of(place, drawn.attributes_of(i));
    if (!seen) return;
    const cases::Case& c = forms_->clip;
    const cases::Viewport& view = c.viewport;
    const WindowPoint at = sample_points(c, contract_)[place.sample];
    const double u = place.x + at.u;
    const double v = place.y + at.v;
    const double half_width = double{view.width} / 2;
    const double half_height = double{view.height} / 2;
    const double turn = c.rules == cases::Rules::d3d ? -1 : 1;
    const double reach = takes_placed_positions() ? placement_reach(*contract_.coverage) : 0;
    hold(place, combined(half_width, 0, double{view.x} + half_width - u), *seen, reach * seen->w,
         "x");
    hold(place, combined(turn * half_height, 1, double{view.y} + half_height - v), *seen,
         reach * seen->w, "y");
    if (contract_.coverage || c.depth_clamp) return;
    const bool is_halved = c.rules == cases::Rules::opengl;
    const double near = view.min_depth;
    const double far = view.max_depth;
    const double low = is_halved ? (near + far) / 2 : near;
    const double span = is_halved ? (far - near) / 2 : far - near;
    const ValueAllowance depth = depth_allowance(c, contract_);
    hold(place, combined(span, 2, low - number_of(drawn.depth[i])), *seen,
         depth.units * ulp_of(depth.magnitude) * seen->w, "depth");
  }

  void hold(const cases::SamplePlace& place, const Row& row, const Seen& seen, double besides,
            const char* what) {
    const Sum sum = times(row, seen);
    const double most = off_by(row, seen) + besides + 0x1p-48 * sum.size;
    if (std::abs(sum.value) <= most * (1 + 0x1p-48)) return;  // NaN does not pass
    if (contract_.coverage && verdicts_.is_undefined(place, 0)) return;
    records::Violation violation =
        violation_at(place, FragmentClass::beyond_bound, "on the ray through the sample",
                     std::string("off the ray along ") + what + " by " +
                         std::to_string(sum.value / (seen.w == 0 ? 1 : seen.w)));
    violation.kind =
        std::string_view(what) == "depth" ? AttributeKind::depth : AttributeKind::smooth;
    violation.actual = "(" + value_text(static_cast<float>(seen.p[0])) + ", " +
                       value_text(static_cast<float>(seen.p[1])) + ", " +
                       value_text(static_cast<float>(seen.p[2])) + ")";
    tally_.report(violation);
  }

  const Forms* forms_;
  cases::Contract contract_;
  Verdicts verdicts_;
  Tally tally_;
  std::optional<std::uint32_t> promised_for_;
  bool is_promised_ = false;
};

/// Checks that the harness and the vertex stage compute the same clip positions from all forms.
Result<Check> check_forms(const Forms& forms, backends::Backend& backend) {
  Check check;
  check.judgement.errors[AttributeKind::coverage];
  for (const cases::Case& camera : forms.cameras) {
    const Result<cases::ClipCase> clip = oracle::to_clip_case(camera, "");
    if (!clip) return tl::unexpected(clip.error());
    if (clip->positions != forms.clip.positions) {
      check.fault =
          "the harness computes other clip positions if the matrices are distributed differently";
      return check;
    }
    const auto bound = backend.contract(camera).transform_bound;
    if (backend.vertex_stage() == nullptr || !bound) continue;
    const Result<std::vector<ClipVertex>> computed = transform(camera, backend);
    if (!computed) return tl::unexpected(computed.error());
    check_stage(forms, camera, *computed, *bound, check);
  }
  return check;
}

Result<Check> check(const cases::Case& c, backends::Backend& backend, std::uint64_t index) {
  const std::optional<Forms> forms = forms_of(c);
  if (!forms) {
    return not_applicable("the case has no camera whose clip positions are exact");
  }
  Result<Check> check = check_forms(*forms, backend);
  if (!check || check->fault) return check;
  const Result<backends::Drawn> drawn = draw_promised(forms->clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  const cases::Contract& contract = drawn->contract;
  if (contract.is_unspecified()) {
    JudgeRequest request;
    request.counts_coverage = false;
    merge(*check, judge_drawn(forms->clip, contract, drawn->fragments, request, index));
    return check;
  }
  merge(*check, RayCheck(*forms, contract).run(drawn->fragments));
  if (backend.vertex_stage() != nullptr) add_label(*check, "vertex stage");
  return check;
}

// --- the law's own cases: cameras with integer matrices ------------------------------------------

/// An integer matrix and its inverse, also integer.
struct Turn {
  Matrix4 matrix = cases::kIdentity;
  Matrix4 inverse = cases::kIdentity;
  bool is_sheared = false;
  bool is_mirrored = false;

  /// Applies another matrix after this one.
  void add(const Matrix4& next, const Matrix4& next_inverse) {
    matrix = product(next, matrix).value_or(matrix);
    inverse = product(inverse, next_inverse).value_or(inverse);
  }
};

/// Returns a random product of quarter turns, a shear, a mirror image and a translation.
Turn random_turn(Draw& draw) {
  Turn turn;
  const int turns = draw.between(0, 2);
  for (int i = 0; i < turns; ++i) {
    const int axis = draw.between(0, 2);
    const float t = draw.one_in(2) ? 1.0F : -1.0F;
    turn.add(rotation(static_cast<std::size_t>(axis), t),
             rotation(static_cast<std::size_t>(axis), -t));
  }
  if (draw.one_in(3)) {
    const int row = draw.between(0, 2);
    const int step = draw.between(1, 2);
    const int factor = draw.between(-2, 2);
    Matrix4 shear = cases::kIdentity;
    Matrix4 back = cases::kIdentity;
    const auto place =
        static_cast<std::size_t>(4 * row) + static_cast<std::size_t>((row + step) % 3);
    shear[place] = static_cast<float>(factor);
    back[place] = static_cast<float>(-factor);
    turn.add(shear, back);
    turn.is_sheared = factor != 0;
  }
  if (draw.one_in(4)) {
    Matrix4 mirror = cases::kIdentity;
    mirror[0] = -1;
    turn.add(mirror, mirror);
    turn.is_mirrored = true;
  }
  const auto x = static_cast<float>(draw.between(-8, 8));
  const auto y = static_cast<float>(draw.between(-8, 8));
  const auto z = static_cast<float>(draw.between(-8, 8));
  turn.add(translation(x, y, z), translation(-x, -y, -z));
  return turn;
}

/// Returns a projection with w = −z and z/w = 1 − n/w: the near plane is at w = n (OpenGL: n/2),
/// the far plane at infinity.
Matrix4 random_projection(Draw& draw) {
  Matrix4 matrix{};
  matrix[0] = draw.pick(std::array{0.5F, 0.75F, 1.0F, 1.5F});
  matrix[5] = draw.pick(std::array{-1.5F, -1.0F, 0.5F, 0.75F, 1.0F, 1.5F});
  matrix[2] = draw.pick(std::array{0.0F, 0.0F, 0.25F});
  matrix[10] = -1;
  matrix[11] = -draw.pick(std::array{0.25F, 0.5F, 1.0F});
  matrix[14] = -1;
  return matrix;
}

/// A multiple of 1/64 from −most to `most`.
float short_number(Draw& draw, float most) {
  const int units = static_cast<int>(most * 64);
  const int chosen = draw.between(-units, units);
  return static_cast<float>(chosen) / 64;
}

/// A point in front of the camera, or sometimes beside or behind it.
std::array<float, 3> point_in_view(Draw& draw) {
  const bool is_behind = draw.one_in(8);
  const int depth = draw.between(16, 400);
  const float w = static_cast<float>(depth) / 64;
  const float x = short_number(draw, 1.5F * w);
  const float y = short_number(draw, 1.5F * w);
  return {x, y, is_behind ? w : -w};
}

Generated generate(Draw& draw) {
  Generated made;
  StateRequest request;
  request.has_clip_distances = false;
  request.most_side = 32;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  const Turn model = random_turn(draw);
  const Turn view = random_turn(draw);
  c.camera.emplace();
  c.camera->model = model.matrix;
  c.camera->view = view.matrix;
  c.camera->projection = random_projection(draw);
  const Matrix4 back = product(model.inverse, view.inverse).value_or(cases::kIdentity);
  const int triangles = draw.between(1, 2 + draw.size() / 40);
  for (int t = 0; t < triangles; ++t) {
    std::array<ClipVertex, 3> corners;
    for (ClipVertex& corner : corners) {
      const auto [x, y, z] = point_in_view(draw);
      const auto at =
          product(back, {x, 0, 0, 0, y, 0, 0, 0, z, 0, 0, 0, 1, 0, 0, 0}).value_or(Matrix4{});
      corner = {at[0], at[4], at[8], 1};
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
  add_attribute_values(draw, c);
  made.stratum = "turned";
  if (model.is_mirrored != view.is_mirrored) made.stratum = "mirrored";
  if (model.is_sheared || view.is_sheared) made.stratum = "sheared";
  return made;
}

const LawRegistration kRegistration(
    {.id = "camera-form-equals-clip-form",
     .sentence = "camera form equals clip form",
     .reason = "The object position that is seen at a sample appears there, whichever matrices "
               "take it to clip space.",
     .exceptions = "cases without a camera, or whose clip positions are rounded; values of clipped "
                   "triangles that come from snapped vertices",
     .generate = &generate,
     .check_given = &check,
     .excludes_outer = true,
     .covers = {cover(15, "clipped"), cover(14, "several samples"), cover_decided(12, "snapped"),
                cover(15, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::camera_form_equals_clip_form_law
