// Measures to which range biased depths are limited, and when.
//
// Draws large planes of depths from 1/2 to almost 1, all with the exponent −1, with a constant that
// takes a part of them beyond 0 or 1 or the depth range. Limiting the sum of each fragment leaves
// another picture than limiting depths before the bias, limiting the vertices' sums and
// interpolating these, and limiting nothing. Then holds random biased depths against everything
// that was measured.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

constexpr float kLow = 0.25F;
constexpr float kHigh = 0.75F;

/// A state in which biased depths are limited.
struct LimitScene {
  std::string what;
  float low = 0;
  float high = 1;
  bool depth_clamp = false;
  double most = 1;  ///< the greatest depth without bias; beyond `high` only with depth clamp
  std::array<double, 2> offsets{};
};

/// Four planes, each over a quarter of the window and its own direction.
std::vector<DepthTriangle> large_planes(double most) {
  constexpr double kHalf = 32;  // pixels
  constexpr double kLeast = 0.5;
  std::vector<DepthTriangle> all;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double u = kHalf * (quarter % 2);
    const int row = quarter / 2;
    const double v = kHalf * row;
    DepthTriangle triangle{
        {{{u, v}, {u + kHalf, v}, {u, v + kHalf}}}, {kLeast, kLeast, kLeast}, {1, 1, 1}};
    triangle.depth[static_cast<std::size_t>(quarter % 3)] = most;
    if (quarter == 3) triangle.depth[1] = most;
    all.push_back(triangle);
  }
  return all;
}

/// A way to limit biased depths.
struct LimitRule {
  const char* words;
  double (*depth)(const DepthTriangle& triangle, const WindowPoint& at, double offset,
                  const LimitScene& scene);
};

double in_scene(double depth, const LimitScene& scene) {
  return std::clamp(depth, double{scene.low}, double{scene.high});
}

/// The depth at `at` of the plane through the vertices' limited sums.
double of_limited_vertices(DepthTriangle triangle, const WindowPoint& at, double offset, double low,
                           double high) {
  for (double& depth : triangle.depth) depth = std::clamp(depth + offset, low, high);
  return depth_of_plane(triangle, at);
}

constexpr std::array kLimits{
    LimitRule{"0 to 1, after the bias",
              [](const DepthTriangle& triangle, const WindowPoint& at, double offset,
                 const LimitScene& /*scene*/) {
                return std::clamp(depth_of_plane(triangle, at) + offset, 0.0, 1.0);
              }},
    LimitRule{"the depth range, after the bias",
              [](const DepthTriangle& triangle, const WindowPoint& at, double offset,
                 const LimitScene& scene) {
                return in_scene(depth_of_plane(triangle, at) + offset, scene);
              }},
    LimitRule{"nothing",
              [](const DepthTriangle& triangle, const WindowPoint& at, double offset,
                 const LimitScene& /*scene*/) { return depth_of_plane(triangle, at) + offset; }},
    LimitRule{"the depth range, before the bias",
              [](const DepthTriangle& triangle, const WindowPoint& at, double offset,
                 const LimitScene& scene) {
                return in_scene(depth_of_plane(triangle, at), scene) + offset;
              }},
    LimitRule{"0 to 1, at the vertices",
              [](const DepthTriangle& triangle, const WindowPoint& at, double offset,
                 const LimitScene& /*scene*/) {
                return of_limited_vertices(triangle, at, offset, 0, 1);
              }},
    LimitRule{
        "the depth range, at the vertices", [](const DepthTriangle& triangle, const WindowPoint& at,
                                               double offset, const LimitScene& scene) {
          return of_limited_vertices(triangle, at, offset, double{scene.low}, double{scene.high});
        }}};
constexpr std::size_t kZeroToOne = 0;
constexpr std::size_t kDepthRange = 1;

struct LimitReading {
  std::array<std::uint64_t, kLimits.size()> explained{};
  std::uint64_t telling = 0;
  std::uint64_t undecided = 0;  ///< every rule says the same

  void add(const std::array<double, kLimits.size()>& expected, double drawn) {
    const auto [least, greatest] = std::minmax_element(expected.begin(), expected.end());
    if (*greatest - *least <= 2 * kPlaneError && std::fabs(drawn - *least) <= 2 * kPlaneError) {
      ++undecided;
      return;
    }
    ++telling;
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
      if (std::fabs(drawn - expected[i]) <= kPlaneError) ++explained[i];
    }
  }
};

LimitReading read_limits(Subject& subject, const LimitScene& scene, double float_ratio) {
  LimitReading reading;
  const std::vector<DepthTriangle> triangles = large_planes(scene.most);
  for (const double offset : scene.offsets) {
    // r = float_ratio · 2^-24 for all planes.
    const float constant = to_float(std::ldexp(offset / float_ratio, 24));
    const auto drawn = draw_planes(subject, triangles,
                                   {.bias = {constant, 0, 0},
                                    .min_depth = scene.low,
                                    .max_depth = scene.high,
                                    .depth_clamp = scene.depth_clamp});
    for (std::size_t i = 0; drawn && i < drawn->size(); ++i) {
      std::array<double, kLimits.size()> expected{};
      for (std::size_t k = 0; k < kLimits.size(); ++k) {
        expected[k] = kLimits[k].depth(triangles[drawn->triangle[i]], sample_of(subject, *drawn, i),
                                       offset, scene);
      }
      reading.add(expected, double{drawn->depth[i]});
    }
  }
  return reading;
}

void add_limits(Subject& subject, const LimitScene& scene, double float_ratio) {
  const bool is_range = scene.depth_clamp || subject.base().rules == cases::Rules::d3d;
  // Both are the same where the range is 0 to 1.
  const std::size_t declared = is_range && scene.low > 0 ? kDepthRange : kZeroToOne;
  const LimitReading reading = read_limits(subject, scene, float_ratio);
  if (reading.telling == 0) {
    subject.add(scene.what, kLimits[declared].words, "not drawn");
    return;
  }
  const bool is_as_declared = reading.explained[declared] == reading.telling;
  const auto most = std::max_element(reading.explained.begin(), reading.explained.end());
  const auto best =
      is_as_declared ? declared : static_cast<std::size_t>(most - reading.explained.begin());
  const std::uint64_t explained = reading.explained[best];
  const bool is_explained = explained == reading.telling;
  subject
      .add(scene.what, kLimits[declared].words,
           is_explained ? kLimits[best].words : "of no kind tried",
           is_explained ? "" : fmt::format("at best {}", kLimits[best].words),
           sure_of("samples", explained, reading.telling - explained, reading.undecided))
      .contradicts = !is_as_declared;
}

// ---- Random biased depths.

/// Triangles over much of the window with a random bias, all of it far from both limits.
cases::Case random_biased_case(const Subject& subject, Draw& draw, cases::DepthFormat format) {
  const int bits = cases::unorm_bits(format);
  const float unit = std::ldexp(1.0F, bits > 0 ? -bits : -25);
  DepthState state{.format = format};
  state.bias.constant = std::round(draw.uniform(-0.0625F, 0.0625F) / unit);
  state.bias.slope = draw.uniform(-4, 4);
  if (draw.one_in(2)) state.bias.clamp = draw.uniform(-0.0625F, 0.0625F);
  std::vector<DepthTriangle> triangles;
  for (std::size_t cell = 0; cell < kDepthCells; cell += 4) {
    DepthTriangle triangle = triangle_in_cell(cell, 0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.depth[i] = draw.between(5, 11) / 16.0;
      triangle.w[i] = draw.pick(std::array{0.5F, 1.0F, 2.0F});
    }
    triangles.push_back(triangle);
  }
  return case_of_planes(subject, triangles, state);
}

const records::ErrorStatistics* depth_errors_of(const records::Judgement& judged) {
  const auto found = judged.errors.find(records::AttributeKind::depth);
  return found == judged.errors.end() ? nullptr : &found->second;
}

/// Adds a case's depths: beyond the bound or not. Depths that are beyond it without a bias as well
/// are not the bias's fault, and count as undecided.
void judge_biased(Subject& subject, const cases::Case& c, const cases::ContractTerms& terms,
                  records::Sureness& sureness) {
  const auto biased = subject.drawn(c);
  if (!biased) return;
  const records::Judgement judged = subject.judgement(*biased, terms);
  const records::ErrorStatistics* const errors = depth_errors_of(judged);
  if (errors == nullptr) return;
  const std::uint64_t wrong = errors->classes[records::FragmentClass::beyond_bound] +
                              errors->classes[records::FragmentClass::not_a_number] +
                              errors->classes[records::FragmentClass::infinite];
  const std::uint64_t right = errors->classes[records::FragmentClass::correct];
  if (wrong > 0) {
    cases::Case plain = c;
    plain.depth_bias = {};
    const auto drawn = subject.drawn(plain);
    if (!drawn) return;
    const records::Judgement before = subject.judgement(*drawn, terms);
    const records::ErrorStatistics* const own = depth_errors_of(before);
    if (own != nullptr && own->classes[records::FragmentClass::beyond_bound] > 0) {
      sureness.undecided += right + wrong;
      return;
    }
  }
  sureness.in_favour += right;
  sureness.against += wrong;
}

}  // namespace

void measure_bias_limits(Subject& subject, const BiasSight& sight) {
  const cases::Capabilities capabilities = subject.capabilities();
  const bool has_range = capabilities.has(cases::Feature::depth_range);
  const double ratio = *sight.float_ratio;
  add_limits(subject, {"limits of biased depths", 0, 1, false, 0.96875, {0.25, -0.75}}, ratio);
  if (!has_range) return;
  add_limits(subject,
             {"limits of biased depths, range 1/4 to 3/4",
              kLow,
              kHigh,
              false,
              double{kHigh},
              {0.375, -0.375}},
             ratio);
  if (!capabilities.has(cases::Feature::depth_clamp)) return;
  add_limits(subject,
             {"limits of biased depths, depth clamp", kLow, kHigh, true, 0.96875, {0.125, -0.375}},
             ratio);
}

void check_biased_depths(Subject& subject, const BiasSight& sight) {
  constexpr std::uint64_t kCasesOfFormat = 3;
  cases::ContractTerms terms = subject.result.terms;
  terms.depth_bias = sight.found;
  records::Sureness sureness{"values"};
  std::vector formats{cases::DepthFormat::float32};
  if (subject.capabilities().has(cases::Feature::unorm_depth)) {
    formats.push_back(cases::DepthFormat::unorm16);
    formats.push_back(cases::DepthFormat::unorm24);
  }
  for (const cases::DepthFormat format : formats) {
    for (std::uint64_t i = 0; i < kCasesOfFormat; ++i) {
      MeasureDraw draw(subject, fmt::format("biased depths in {}", cases::unorm_bits(format)), i);
      judge_biased(subject, random_biased_case(subject, draw, format), terms, sureness);
    }
  }
  if (sureness.in_favour + sureness.against + sureness.undecided == 0) return;
  const bool holds = sureness.against == 0;
  subject.add("biased depths as measured", kNotDeclared, holds ? "hold" : "violated", "", sureness)
      .contradicts = !holds;
}

}  // namespace rastercheck::properties
