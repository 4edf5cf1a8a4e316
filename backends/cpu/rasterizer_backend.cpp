#include "backends/cpu/rasterizer_backend.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "backends/cpu/case_state.h"
#include "backends/cpu/fragments.h"
#include "backends/cpu/framebuffer_drawing.h"
#include "backends/cpu/geometry.h"
#include "backends/cpu/occlusion.h"
#include "backends/cpu/picture.h"
#include "backends/cpu/stage_trace.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/simd.h"
#include "rasterizer/trace.h"
#include "rasterizer/vertex_stage.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// Pictures are drawn in double, whatever the precision of fragments. The bounds are derived in
/// rasterizer/texture.h, and derivative_share (2^-31 plus 44 roundings) in
/// rasterizer/internal/derivatives.h.
cases::TextureBounds texture_bounds() {
  cases::TextureBounds bounds;
  bounds.coordinate_share = 0x1p-31F;
  bounds.coordinate_constant = 0x1p-51F;
  bounds.bilinear = 6;
  bounds.trilinear = 8;
  bounds.derivative_share = 0x1.0001p-31F;
  return bounds;
}

/// The promise of conservative coverage: exact, whatever grid a case asks for.
void promise_conservative(ras::Conservative conservative, cases::Contract& contract) {
  contract.coverage.reset();
  contract.basis = cases::Basis::ideal;
  auto& promised = contract.conservative.emplace();
  promised.covers_degenerates = conservative == ras::Conservative::outer;
  promised.kind = conservative == ras::Conservative::outer ? cases::ConservativeKind::outer
                                                           : cases::ConservativeKind::inner;
}

/// The production rasterizer's promise: the mathematical triangle, or the triangle of exactly
/// rounded vertices if the case asks for snapping. Values, screen derivatives, clip positions and
/// normals stay within the bounds of rasterizer/rasterizer.h and vertex_stage.h. Constants and the
/// values at vertices are exact (rasterizer/internal/exact_values.h).
cases::Contract production_contract(const cases::Case& c, ras::Precision precision) {
  cases::Contract contract;
  contract.tie_rule = c.fill_rule;
  if (c.coverage) {
    contract.coverage = c.coverage;
    contract.coverage->position_error = 0;
    if (c.coverage->rounding == cases::Rounding::unspecified) {
      contract.coverage->rounding = cases::Rounding::nearest_even;
    }
    contract.basis = c.basis == cases::Basis::ideal ? cases::Basis::ideal : cases::Basis::snapped;
    contract.guard_band = ras::kGuardBand;
  }
  // The bounds, rounded up to short decimals.
  constexpr float kBound = 0.51F;
  constexpr float kFloatSmoothBound = 6.84F;
  constexpr float kFloatAffineBound = 3.96F;
  static_assert(kBound >= ras::kValueBound && kBound >= ras::kDerivativeBound);
  static_assert(kFloatSmoothBound >= ras::kFloatSmoothBound);
  static_assert(kFloatAffineBound >= ras::kFloatAffineBound);
  contract.bounds.smooth.constant = kBound;
  contract.bounds.noperspective.constant = kBound;
  promise_depths(c, contract);
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
  contract.quad_share = 0x1p-29F;  // rasterizer/internal/certificates.h, for helper lanes
  contract.texture_bounds = texture_bounds();
  return contract;
}

/// The backends that draw the same bits as the backend with these options. Framebuffers hold values
/// computed in double, whatever the precision of fragments.
std::vector<std::string> variants(const RasterizerOptions& options) {
  if (options.rounds_down) return {};
  const bool is_double =
      options.precision == ras::Precision::float64 || options.output == Output::framebuffer;
  std::vector<std::string> ways{"cpu:output=framebuffer", "cpu"};
  std::vector<std::string> threaded{"cpu:output=framebuffer,threads=2",
                                    "cpu:output=framebuffer,threads=3"};
  if (!is_double) ways = {"cpu:precision=float32"};
  if (options.conservative != ras::Conservative::off) {
    const bool is_outer = options.conservative == ras::Conservative::outer;
    const std::string kind = is_outer ? "conservative=outer" : "conservative=inner";
    for (std::string& way : ways) way += (way == "cpu" ? ":" : ",") + kind;
    for (std::string& way : threaded) way += "," + kind;
  }
  std::vector<std::string> all = ways;
  if (is_double) {
    all.insert(all.end(), threaded.begin(), threaded.end());
  }
  for (const std::string& way : ways) {
    const std::string with = way + (way.find(':') == std::string::npos ? ":" : ",") + "simd=";
    for (const ras::SimdTarget& target : ras::simd_targets()) {
      if (target.is_supported) all.push_back(with + target.name);
    }
  }
  return all;
}

class RasterizerBackend : public Backend,
                          private PictureDrawer,
                          private PictureContinuer,
                          private Assembler,
                          private VertexStage,
                          private Tracer,
                          private OcclusionCuller {
 public:
  explicit RasterizerBackend(RasterizerOptions options) : options_(std::move(options)) {}

  About about() const override {
    return {.capabilities = capabilities(),
            .same_as = variants(options_),
            .answers_occlusion_queries = true,
            .draws_pictures = draws_pictures(),
            .assembles = true};
  }
  cases::Contract promise(const cases::Case& c) const override {
    cases::Contract contract = production_contract(c, options_.precision);
    if (options_.output == Output::framebuffer) contract.derivative_bound.reset();  // not stored
    if (options_.rounds_down && contract.coverage) {
      contract.coverage->rounding = cases::Rounding::floor;
    }
    if (is_conservative()) promise_conservative(options_.conservative, contract);
    if (c.primitive != cases::Primitive::triangles) {
      // The bounds of differences and derivatives are derived for triangles.
      contract.derivative_bound.reset();
      contract.quad_share.reset();
    }
    return contract;
  }
  /// Framebuffers hold values computed in double, so only the backend in double draws pictures.
  PictureDrawer* picture_drawer() override { return draws_pictures() ? this : nullptr; }
  PictureContinuer* picture_continuer() override { return draws_pictures() ? this : nullptr; }
  Assembler* assembler() override { return this; }
  VertexStage* vertex_stage() override { return this; }
  /// The stages of a trace say whether a sample is covered, not a pixel.
  Tracer* tracer() override { return is_conservative() || options_.rounds_down ? nullptr : this; }
  OcclusionCuller* occlusion_culler() override { return this; }

 private:
  bool draws_pictures() const {
    return options_.precision == ras::Precision::float64 && !options_.rounds_down;
  }
  cases::Capabilities capabilities() const {
    cases::Capabilities has;
    if (!is_conservative()) {
      has.primitives = {cases::Primitive::triangles, cases::Primitive::lines,
                        cases::Primitive::points};
    }
    return has;
  }
  bool is_conservative() const { return options_.conservative != ras::Conservative::off; }
  Result<cases::Fragments> draw_fragments(const cases::Case& asked_for) override {
    const ras::OnSimdTarget target(options_.simd);
    std::optional<cases::Case> rounded;
    if (options_.rounds_down && asked_for.coverage) {
      rounded = asked_for;
      rounded->coverage->rounding = cases::Rounding::floor;
    }
    const cases::Case& c = rounded ? *rounded : asked_for;
    if (options_.output == Output::framebuffer) {
      return draw_through_framebuffer(c, options_.conservative, options_.threads);
    }
    ras::State state = state_of(c, options_.conservative);
    state.precision = options_.precision;
    state.derivatives = c.primitive == cases::Primitive::triangles;  // others have no bound
    const CaseMesh memory(c);
    ras::Fragments fragments;
    const ras::DrawResult drawn =
        ras::draw_fragments(state, memory.mesh(), target_size(c), fragments);
    return drawn_fragments(c, drawn, fragments);
  }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    const ras::OnSimdTarget target(options_.simd);
    return backends::draw_picture(c, pipeline, {options_.conservative, options_.threads});
  }
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override {
    const ras::OnSimdTarget target(options_.simd);
    return backends::draw_over(c, pipeline, {options_.conservative, options_.threads}, picture);
  }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override {
    if (c.primitive != cases::Primitive::triangles) {
      return tl::unexpected(Error{"", "", "only triangles are traced", Failure::unsupported});
    }
    ras::State state = state_of(c);
    state.precision = options_.precision;
    const CaseMesh memory(c);
    return traced_sample(ras::trace_sample(state, memory.mesh(), target_size(c), sample_place(at)));
  }
  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) override {
    return is_hidden_in_depth_buffer(
        c, occluders, [this](const cases::Case& part) { return draw_fragments(part); });
  }
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    const Result<cases::Case> triangles = assembled(c, topology, indices);
    if (!triangles) return tl::unexpected(triangles.error());
    return draw_fragments(*triangles);
  }
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override {
    return transformed(c);
  }
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override {
    return transformed_normals(model, normals);
  }

  RasterizerOptions options_;
};

}  // namespace

std::unique_ptr<Backend> make_rasterizer_backend(const RasterizerOptions& options) {
  return std::make_unique<RasterizerBackend>(options);
}

}  // namespace rastercheck::backends
