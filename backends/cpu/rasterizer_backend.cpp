#include "backends/cpu/rasterizer_backend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "backends/cpu/case_state.h"
#include "backends/cpu/geometry.h"
#include "backends/cpu/picture.h"
#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/simd.h"
#include "rasterizer/trace.h"
#include "rasterizer/vertex_stage.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// The fragments that a depth test `less` leaves: of each sample the nearest, of equals the first
/// drawn. Indices in ascending order.
std::vector<std::size_t> nearest(const ras::Fragments& fragments) {
  std::map<std::tuple<int, int, int>, std::size_t> best;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const auto [entry, is_first] =
        best.try_emplace({fragments.y[i], fragments.x[i], fragments.sample[i]}, i);
    if (!is_first && fragments.depth[i] < fragments.depth[entry->second]) entry->second = i;
  }
  std::vector<std::size_t> kept;
  kept.reserve(best.size());
  for (const auto& [place, index] : best) kept.push_back(index);
  std::sort(kept.begin(), kept.end());
  return kept;
}

cases::Framebuffer framebuffer(const ras::Fragments& fragments,
                               const std::vector<std::size_t>& indices, std::size_t attributes) {
  const auto append = [](std::vector<float>& to, const std::vector<float>& from,
                         std::size_t fragment, std::size_t count) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(fragment * count);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
  };
  cases::Framebuffer result;
  result.attribute_count = attributes;
  for (const std::size_t i : indices) {
    result.triangle.push_back(fragments.triangle[i]);
    result.x.push_back(fragments.x[i]);
    result.y.push_back(fragments.y[i]);
    result.sample.push_back(fragments.sample[i]);
    result.depth.push_back(fragments.depth[i]);
    append(result.attributes, fragments.attributes, i, attributes);
    if (!fragments.derivatives.empty()) {
      append(result.derivatives, fragments.derivatives, i, attributes * 2);
    }
  }
  return result;
}

/// How much more than ordinary ones the numbers of clipped vertices may be off: a vertex that
/// clipping makes has coordinates and w that come from the triangle's by cancellation, and are off
/// by a rounding of the largest of these, relative to a w that may be as small as the least. With
/// some w <= 0 the new w is at least what the guard band leaves of x and y, which this leaves out.
double clip_amplification(const cases::Case& c) {
  double largest = 0;
  double least_w = std::numeric_limits<double>::infinity();
  for (const cases::ClipVertex& p : c.positions) {
    for (const float part : {p.x, p.y, p.z, p.w}) {
      largest = std::max(largest, std::abs(double{part}));
    }
    if (p.w > 0) least_w = std::min(least_w, double{p.w});
  }
  return std::max(largest / least_w, 1.0);
}

/// What the method rational-linear promises, which clips, transforms and interpolates in double and
/// rounds nothing to a grid: the figures are derived in rasterizer/methods/rational_linear.cpp.
///
/// Positions. Vertices are off by a few roundings of a double, and crossings with rows by
/// 11 · 2^-53 of the edge's farthest coordinate, which lies within 2^10 half widths around the
/// viewport's middle. The position error granted, 2^-24 pixels, takes that in for viewports up to
/// 2^14; the grid of 2^-16 pixels is only how the contract says where vertices may be. What
/// clipping adds grows with the amplification A of the triangle's numbers, 2^-50 A half widths for
/// a new vertex: the clip tolerance. An edge carries its values along, so what its errors do to
/// values lies within the range that moving the vertices leaves open.
///
/// Values. Besides one rounding to float32, half an ULP, means of s = r/w and of 1/w are off by
/// 11 · 2^-53 of the greatest; for r that is 23 · 2^-53 max|r_i| g, g the horizon ratio, or, with
/// ulp(m) >= 2^-24 m, less than 2^-24 g scale ULP. Depth and noperspective divide nothing: g is 1.
/// A clipped vertex has r w and z off by 2^-60 A of themselves, the guard band being 2^10, so that
/// A 2^-34 scale ULP come on top.
cases::Contract double_precision_contract(const cases::Case& c) {
  cases::Contract contract;
  contract.coverage = cases::Snapping{16, cases::Rounding::unspecified, 0x1p-8F};
  contract.is_on_grid = false;
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  const cases::Viewport& viewport = c.viewport;
  const float half_width = std::max(std::abs(viewport.width), std::abs(viewport.height)) / 2;
  const float middle = std::max(std::abs(viewport.x), std::abs(viewport.y)) + half_width;
  contract.guard_band = std::max(contract.guard_band, 1024 * half_width + middle);

  const double amplification = clip_amplification(c);
  constexpr double kGridUnits = 0x1p16;
  contract.clip_tolerance = static_cast<float>(
      std::clamp(0x1p-50 * amplification * double{half_width} * kGridUnits, 1.0, 0x1p60));
  const auto clipped = static_cast<float>(std::min(0x1p-34 * amplification, 0x1p60));
  constexpr float kInterpolation = 0x1p-24F;
  contract.bounds.smooth = {0.5F + kInterpolation + clipped, kInterpolation};
  contract.bounds.noperspective = {0.5F + kInterpolation + clipped, 0};
  contract.bounds.depth = {0.5F + kInterpolation + clipped, 0};
  return contract;
}

/// Pictures are drawn in double, whatever the precision. Derived in rasterizer/texture.h and, of
/// the derivatives, in rasterizer/internal/derivatives.h: 2^-31 and 44 roundings.
cases::TextureBounds texture_bounds() {
  cases::TextureBounds bounds;
  bounds.coordinate_share = 0x1p-31F;
  bounds.coordinate_constant = 0x1p-51F;
  bounds.bilinear = 6;
  bounds.trilinear = 8;
  bounds.derivative_share = 0x1.0001p-31F;
  return bounds;
}

/// Of what a shader sees of attributes in a quad, derived in rasterizer/internal/certificates.h.
float quad_share() { return 0x1p-29F; }

/// What the production rasterizer promises: the mathematical triangle, or, where the case asks for
/// snapping, that of the vertices on such a grid, exactly rounded; and values within 0.51 scale ULP
/// (the bound derived in rasterizer/internal/certificates.h is 0.5 + 2^-7), attributes in float32
/// within the bounds derived in rasterizer/internal/float_kernels.h. Constants come back as they
/// are, and so do the values of vertices (rasterizer/internal/exact_values.h).
/// Screen derivatives, in either precision, are within 0.51 of their unit
/// (rasterizer/internal/derivatives.h: 0.5 + 2^-7 + 2^-22). Clip positions and normals
/// are within the bounds of rasterizer/vertex_stage.h.
cases::Contract production_contract(const cases::Case& c, ras::Precision precision) {
  cases::Contract contract;
  contract.tie_rule = c.fill_rule;
  if (c.coverage) {
    contract.coverage = cases::Snapping{subpixel_bits(*c.coverage)};
    contract.basis = c.basis == cases::Basis::ideal ? cases::Basis::ideal : cases::Basis::snapped;
    contract.guard_band = ras::kGuardBand;
  }
  constexpr float kBound = 0.51F;
  constexpr float kFloatSmoothBound = 6.84F;  // 6.83 and 3.95 are no floats
  constexpr float kFloatAffineBound = 3.96F;
  contract.bounds = {{kBound, 0}, {kBound, 0}, {kBound, 0}};
  if (precision == ras::Precision::float32) {
    contract.bounds.smooth.constant = kFloatSmoothBound;
    contract.bounds.noperspective.constant = kFloatAffineBound;
  }
  contract.keeps_equal_depth = true;
  contract.keeps_constants = true;
  contract.keeps_vertex_values = true;
  contract.derivative_bound = kBound;
  contract.transform_bound = ras::kTransformBound;
  contract.normal_bound = ras::kNormalBound;
  contract.quad_share = quad_share();
  contract.texture_bounds = texture_bounds();
  return contract;
}

Result<cases::Framebuffer> draw_with_rasterizer(const cases::Case& c, std::string_view method,
                                                ras::Precision precision) {
  ras::State s = state_of(c, precision);
  s.derivatives = method.empty();  // the textbook methods have none
  const CaseMesh memory(c);
  const ras::Mesh mesh = memory.mesh();
  const ras::TargetSize size = target_size(c);
  ras::Fragments fragments;
  const ras::DrawResult drawn = method.empty()
                                    ? ras::draw_fragments(s, mesh, size, fragments)
                                    : ras::draw_fragments_by(method, s, mesh, size, fragments);
  if (drawn.error) return tl::unexpected(refused(*drawn.error));
  std::vector<std::size_t> indices(fragments.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (c.depth_test == cases::DepthTest::less) indices = nearest(fragments);
  return framebuffer(fragments, indices, c.attributes.size());
}

/// What the rasterizer would refuse of a case's arrays: they are read before it sees them.
std::optional<ras::Error> check_arrays(const cases::Case& c) {
  const std::size_t vertices = c.positions.size();
  if (c.attribute_values.size() != vertices * c.attributes.size()) {
    return ras::Error::attribute_values;
  }
  if (c.clip_distances.size() != vertices * c.clip_distance_count) {
    return ras::Error::clip_distance_values;
  }
  const bool has_all =
      std::all_of(c.triangles.begin(), c.triangles.end(), [&](const cases::Triangle& triangle) {
        return *std::max_element(triangle.begin(), triangle.end()) < vertices;
      });
  return has_all ? std::nullopt : std::optional(ras::Error::index);
}

/// Triangles of a case as the rasterizer takes them, with vertices of their own.
class UnsharedTriangles {
 public:
  UnsharedTriangles(const cases::Case& c, std::size_t first, std::size_t count) {
    for (std::uint32_t corner = 0; corner < 3 * count; ++corner) {
      const std::uint32_t vertex = c.triangles[first + corner / 3][corner % 3];
      const cases::ClipVertex& p = c.positions[vertex];
      positions_.emplace_back(p.x, p.y, p.z, p.w);
      append(c.attribute_values, c.attributes.size(), vertex, attributes_);
      append(c.clip_distances, c.clip_distance_count, vertex, clip_distances_);
      if (corner % 3 == 0) triangles_.emplace_back(corner, corner + 1, corner + 2);
    }
  }
  ras::Mesh mesh() const { return {positions_, attributes_, clip_distances_, triangles_}; }

 private:
  /// Appends a vertex's share of what all vertices have `count` of.
  static void append(const std::vector<float>& all, std::size_t count, std::uint32_t vertex,
                     std::vector<float>& to) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(vertex * count);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
  }

  std::vector<glm::vec4> positions_;
  std::vector<float> attributes_;
  std::vector<float> clip_distances_;
  std::vector<glm::uvec3> triangles_;
};

/// Draws through the rasterizer's framebuffer and lists what is in it.
class FramebufferDrawing {
 public:
  FramebufferDrawing(const cases::Case& c, ras::Precision precision, unsigned threads)
      : case_(c), state_(state_of(c, precision)), threads_(threads) {
    state_.derivatives = false;
    result_.attribute_count = c.attributes.size();
  }

  Result<cases::Framebuffer> draw() {
    const std::size_t count = case_.triangles.size();
    if (!is_done(check_arrays(case_))) return tl::unexpected(*error_);
    if (!clear(framebuffer_, case_.attributes.size())) return tl::unexpected(*error_);
    if (case_.depth_test == cases::DepthTest::less) {
      if (count > kMostIndices) {
        return tl::unexpected(Error{"", "", "an index of so many triangles is no float32"});
      }
      state_.depth_test = ras::DepthTest::less;
      const UnsharedTriangles all(case_, 0, count);
      if (!draw(state_, all.mesh(), framebuffer_) || !draw_indices(all)) {
        return tl::unexpected(*error_);
      }
      take([this](std::size_t at) { return static_cast<std::uint32_t>(indices_.attributes[at]); });
      return std::move(result_);
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      if (!draw(state_, UnsharedTriangles(case_, t, 1).mesh(), framebuffer_)) {
        return tl::unexpected(*error_);
      }
      take([t](std::size_t) { return t; });
    }
    return std::move(result_);
  }

 private:
  static constexpr float kFarthest = std::numeric_limits<float>::infinity();
  static constexpr std::size_t kMostIndices = std::size_t{1} << 24;

  bool clear(ras::Framebuffer& framebuffer, std::size_t attributes) {
    return is_done(ras::clear(framebuffer, target_size(case_), attributes, kFarthest));
  }
  bool draw(const ras::State& by, const ras::Mesh& mesh, ras::Framebuffer& into) {
    return is_done(ras::draw(by, mesh, into, threads_).error);
  }
  bool is_done(const std::optional<ras::Error>& error) {
    if (error) error_ = refused(*error);
    return !error;
  }

  /// Draws the same with each triangle's index for its only value.
  bool draw_indices(const UnsharedTriangles& all) {
    std::vector<float> values;
    for (std::size_t triangle = 0; triangle < all.mesh().triangles.size(); ++triangle) {
      values.insert(values.end(), 3, static_cast<float>(triangle));
    }
    ras::Mesh mesh = all.mesh();
    mesh.attributes = values;
    ras::State indexed = state_;
    indexed.attributes = {{ras::Interpolation::flat, ras::Location::sample}};
    return clear(indices_, 1) && draw(indexed, mesh, indices_);
  }

  /// Lists the samples that were drawn and clears them.
  template <typename TriangleOf>
  void take(const TriangleOf& triangle_of) {
    const auto samples = static_cast<std::size_t>(case_.framebuffer.samples);
    const auto width = static_cast<std::size_t>(case_.framebuffer.width);
    const std::size_t attributes = case_.attributes.size();
    for (std::size_t at = 0; at < framebuffer_.depth.size(); ++at) {
      if (framebuffer_.depth[at] == kFarthest) continue;
      result_.triangle.push_back(triangle_of(at));
      result_.x.push_back(static_cast<std::uint16_t>(at / samples % width));
      result_.y.push_back(static_cast<std::uint16_t>(at / samples / width));
      result_.sample.push_back(static_cast<std::uint8_t>(at % samples));
      result_.depth.push_back(framebuffer_.depth[at]);
      framebuffer_.depth[at] = kFarthest;
      const auto values =
          framebuffer_.attributes.begin() + static_cast<std::ptrdiff_t>(at * attributes);
      result_.attributes.insert(result_.attributes.end(), values,
                                values + static_cast<std::ptrdiff_t>(attributes));
    }
  }

  const cases::Case& case_;
  ras::State state_;
  unsigned threads_;
  ras::Framebuffer framebuffer_;
  ras::Framebuffer indices_;
  cases::Framebuffer result_;
  std::optional<Error> error_;
};

/// What draws the same bits as these options do: framebuffers hold what is computed in double.
std::vector<std::string> variants(const RasterizerOptions& options) {
  const bool is_double =
      options.precision == ras::Precision::float64 || options.output == Output::framebuffer;
  std::vector<std::string> ways{"cpu:output=framebuffer", "cpu"};
  if (!is_double) ways = {"cpu:precision=float32"};
  std::vector<std::string> all = ways;
  if (is_double) {
    all.emplace_back("cpu:output=framebuffer,threads=2");
    all.emplace_back("cpu:output=framebuffer,threads=3");
  }
  for (const std::string& way : ways) {
    const std::string with = way + (way.find(':') == std::string::npos ? ":" : ",") + "simd=";
    for (const ras::SimdTarget& target : ras::simd_targets()) {
      if (target.is_supported) all.push_back(with + target.name);
    }
  }
  return all;
}

std::string numbered(const char* name, std::size_t index) { return name + std::to_string(index); }

std::string_view word(ras::Decision decision) {
  switch (decision) {
    case ras::Decision::in_double:
      return "in_double";
    case ras::Decision::exactly:
      return "exactly";
    case ras::Decision::in_whole_numbers:
      break;
  }
  return "in_whole_numbers";
}

double number(bool is_so) { return is_so ? 1 : 0; }

/// What the stage `evaluation` handed on of a value.
void add_value(const std::string& name, const ras::TracedValue& value,
               records::NamedNumbers& numbers) {
  numbers.push_back({name, value.value});
  numbers.push_back({name + "_is_exact", number(value.is_exact)});
  if (value.is_at_sample) return;
  numbers.push_back({name + "_u", value.u});
  numbers.push_back({name + "_v", value.v});
}

/// The rasterizer's trace in the words of records/stage_trace.h.
records::SampleTrace sample_trace(const ras::Trace& trace) {
  records::StageTrace edges{"edges", {}, {}};
  records::NamedNumbers bands;
  records::NamedNumbers weights;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec4& p = trace.edges.positions[i];
    const auto& [a, b, c] = trace.edges.coefficients[i];
    edges.received.push_back({numbered("x", i), p.x});
    edges.received.push_back({numbered("y", i), p.y});
    edges.received.push_back({numbered("z", i), p.z});
    edges.received.push_back({numbered("w", i), p.w});
    edges.handed_on.push_back({numbered("a", i), a});
    edges.handed_on.push_back({numbered("b", i), b});
    edges.handed_on.push_back({numbered("c", i), c});
    bands.push_back({numbered("band", i), trace.edges.bands[i]});
    edges.handed_on.push_back(bands.back());
    weights.push_back({numbered("E", i), trace.weights[i]});
  }
  edges.handed_on.push_back({"is_snapped", number(trace.edges.is_snapped)});
  const records::NamedNumbers certificate{
      {"least_sum", trace.edges.least_sum},
      {"affine_is_certain", number(trace.edges.affine_is_certain)},
      {"depth_is_certain", number(trace.edges.depth_is_certain)}};
  const records::NamedNumbers place{
      {"U", trace.place[0]}, {"V", trace.place[1]}, {"T", trace.place[2]}};

  records::SampleTrace result;
  records::NamedNumbers values;
  add_value("depth", trace.depth, values);
  result.depth = trace.depth.value;
  for (std::size_t a = 0; a < trace.attributes.size(); ++a) {
    add_value("r[" + std::to_string(a) + "]", trace.attributes[a], values);
    result.attributes.push_back(trace.attributes[a].value);
  }
  result.stages = {std::move(edges),
                   {"certificate", std::move(bands), certificate},
                   {"coverage", place, {{std::string(word(trace.decision)), 1}}},
                   {"weights", place, weights},
                   {"evaluation", weights, std::move(values)}};
  return result;
}

class RasterizerBackend : public Backend {
 public:
  explicit RasterizerBackend(RasterizerOptions options) : options_(std::move(options)) {}

  cases::Contract contract(const cases::Case& c) const override {
    if (!options_.method.empty()) return double_precision_contract(c);
    cases::Contract contract = production_contract(c, options_.precision);
    if (options_.output == Output::framebuffer) contract.derivative_bound.reset();  // it holds none
    return contract;
  }
  Result<cases::Framebuffer> draw(const cases::Case& c) override {
    const ras::OnSimdTarget target(options_.simd);
    if (options_.output == Output::framebuffer) {
      return FramebufferDrawing(c, options_.precision, options_.threads).draw();
    }
    return draw_with_rasterizer(c, options_.method, options_.precision);
  }
  /// Framebuffers hold values computed in double, whatever fragments are asked for.
  bool draws_pictures() const override {
    return options_.method.empty() && options_.precision == ras::Precision::float64;
  }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    if (!draws_pictures()) return Backend::draw_picture(c, pipeline);
    const ras::OnSimdTarget target(options_.simd);
    return backends::draw_picture(c, pipeline, options_.threads);
  }
  bool draws_over() const override { return draws_pictures(); }
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override {
    if (!draws_over()) return Backend::draw_over(c, pipeline, picture);
    const ras::OnSimdTarget target(options_.simd);
    return backends::draw_over(c, pipeline, options_.threads, picture);
  }
  std::vector<std::string> same_as() const override {
    return options_.method.empty() ? variants(options_) : std::vector<std::string>();
  }
  bool traces() const override { return options_.method.empty(); }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const records::SampleAddress& at) override {
    if (!options_.method.empty()) return Backend::trace(c, at);
    if (at.triangle >= c.triangles.size()) return tl::unexpected(refused(ras::Error::index));
    if (const auto error = check_arrays(c)) return tl::unexpected(refused(*error));
    if (std::cmp_greater_equal(at.x, c.framebuffer.width) ||
        std::cmp_greater_equal(at.y, c.framebuffer.height) ||
        std::cmp_greater_equal(at.sample, c.framebuffer.samples)) {
      return std::nullopt;
    }
    const UnsharedTriangles one(c, at.triangle, 1);
    const ras::SampleAddress address{0, static_cast<int>(at.x), static_cast<int>(at.y),
                                     static_cast<int>(at.sample)};
    const ras::TraceResult traced =
        ras::trace_sample(state_of(c, options_.precision), one.mesh(), target_size(c), address);
    if (traced.error) return tl::unexpected(refused(*traced.error));
    if (!traced.trace) return std::nullopt;
    return sample_trace(*traced.trace);
  }
  bool assembles() const override { return options_.method.empty(); }
  Result<cases::Framebuffer> draw_assembled(const cases::Case& c, cases::Topology topology,
                                            std::span<const std::uint32_t> indices) override {
    if (!assembles()) return Backend::draw_assembled(c, topology, indices);
    const Result<cases::Case> triangles = assembled(c, topology, indices);
    if (!triangles) return tl::unexpected(triangles.error());
    return draw(*triangles);
  }
  bool transforms() const override { return options_.method.empty(); }
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override {
    return transforms() ? transformed(c) : Backend::transform(c);
  }
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override {
    if (!transforms()) return Backend::transform_normals(model, normals);
    return transformed_normals(model, normals);
  }

 private:
  RasterizerOptions options_;
};

}  // namespace

std::unique_ptr<Backend> make_rasterizer_backend(const RasterizerOptions& options) {
  return std::make_unique<RasterizerBackend>(options);
}

}  // namespace rastercheck::backends
