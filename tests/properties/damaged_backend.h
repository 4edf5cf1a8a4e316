#pragma once

// Backends that draw like another backend (by default method:rational-linear, whose contract leaves
// ties and snapping open) and then go wrong in one way; and a case small enough to work out by hand
// what each law has to find.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "properties/drawing.h"
#include "properties/law.h"

namespace rastercheck::properties {

using Damage = std::function<void(const cases::Case&, cases::Fragments&)>;
using TransformDamage = std::function<void(const cases::Case&, std::vector<cases::ClipVertex>&)>;
using NormalDamage = std::function<void(const cases::Matrix4&, std::vector<cases::Normal>&)>;
/// Damages the input of assembly.
using AssemblyDamage =
    std::function<void(const cases::Case&, cases::Topology&, std::vector<std::uint32_t>& indices)>;
/// Damages a picture that was drawn over, and the result that is reported.
using OverDamage = std::function<void(const cases::Case&, Result<void>& drawn, cases::Picture&)>;
/// Damages the pipeline that a picture is drawn by (PipelineDamage), or the picture.
using PipelineDamage = std::function<void(cases::Pipeline&)>;
using PictureDamage = std::function<void(const cases::Pipeline& asked_for, cases::Picture&)>;
/// Damages what another way of drawing draws, or makes this way report that it cannot draw the
/// case.
using WayDamage = std::function<void(const cases::Case&, Result<cases::Fragments>&)>;
/// Damages the answer to an occlusion query.
using OcclusionDamage =
    std::function<void(const cases::Case&, std::size_t occluders, bool& is_occluded)>;
using TraceDamage =
    std::function<void(const cases::SamplePlace&, std::optional<records::SampleTrace>&)>;

class DamagedBackend : public backends::Backend,
                       protected backends::PictureDrawer,
                       protected backends::PictureContinuer,
                       protected backends::Assembler,
                       protected backends::VertexStage,
                       protected backends::Tracer,
                       protected backends::WaysOfDrawing,
                       protected backends::OcclusionCuller {
 public:
  explicit DamagedBackend(Damage damage = {},
                          const std::string& specification = "method:rational-linear")
      : inner_(backends::make_backend(specification).value()), damage_(std::move(damage)) {}

  backends::About about() const override {
    return {.capabilities = inner_->about().capabilities, .same_as = same_as_these};
  }
  cases::Contract promise(const cases::Case& c) const override {
    if (promised) return *promised;
    cases::Contract contract = inner_->promise(c);
    contract.keeps_equal_depth = true;  // true for the simple planes that the tests draw
    contract.picture_bounds = picture_bounds;
    if (picture_bounds) contract.quad_share.reset();
    if (picture_bounds && contract.texture_bounds) {
      contract.texture_bounds->coordinate_share = picture_bounds->texel_share;
    }
    return contract;
  }
  backends::PictureDrawer* picture_drawer() override {
    return inner_->picture_drawer() ? this : nullptr;
  }
  backends::PictureContinuer* picture_continuer() override {
    return inner_->picture_continuer() ? this : nullptr;
  }
  backends::Assembler* assembler() override { return inner_->assembler() ? this : nullptr; }
  backends::VertexStage* vertex_stage() override { return inner_->vertex_stage() ? this : nullptr; }
  backends::Tracer* tracer() override { return inner_->tracer() ? this : nullptr; }
  backends::WaysOfDrawing* ways_of_drawing() override {
    return way_damage || inner_->ways_of_drawing() ? this : nullptr;
  }

  backends::OcclusionCuller* occlusion_culler() override {
    return inner_->occlusion_culler() ? this : nullptr;
  }

  std::optional<cases::Contract> promised;
  /// If set, pictures are promised as drivers promise them.
  std::optional<cases::PictureBounds> picture_bounds;
  OcclusionDamage occlusion_damage;
  TraceDamage trace_damage;
  TransformDamage transform_damage;
  /// If set, there are two ways of drawing, and this damages the second.
  WayDamage way_damage;
  NormalDamage normal_damage;
  AssemblyDamage assembly_damage;
  OverDamage over_damage;
  PipelineDamage pipeline_damage;
  PictureDamage picture_damage;
  std::vector<std::string> same_as_these;

 protected:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    Result<backends::Drawn> drawn = inner_->draw(c);
    if (!drawn) return tl::unexpected(drawn.error());
    if (damage_) damage_(c, drawn->fragments);
    return std::move(drawn->fragments);
  }
  std::vector<cases::DrawBy> ways() const override {
    if (!way_damage) return inner_->ways_of_drawing()->ways();
    return {cases::DrawBy::append, cases::DrawBy::layers};
  }
  Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) override {
    if (!way_damage) return inner_->ways_of_drawing()->draw_by(c, way);
    Result<cases::Fragments> drawn = draw_fragments(c);
    if (drawn && way == cases::DrawBy::layers) way_damage(c, drawn);
    return drawn;
  }
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override {
    auto traced = inner_->tracer()->trace(c, at);
    if (traced && trace_damage) trace_damage(at, *traced);
    return traced;
  }

  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) override {
    Result<bool> answer = inner_->occlusion_culler()->is_occluded(c, occluders);
    if (answer && occlusion_damage) occlusion_damage(c, occluders, *answer);
    return answer;
  }

  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override {
    Result<void> drawn = inner_->picture_continuer()->draw_over(c, pipeline, picture);
    if (over_damage) over_damage(c, drawn, picture);
    return drawn;
  }

  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override {
    auto positions = inner_->vertex_stage()->transform(c);
    if (positions && transform_damage) transform_damage(c, *positions);
    return positions;
  }

  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override {
    auto world = inner_->vertex_stage()->transform_normals(model, normals);
    if (world && normal_damage) normal_damage(model, *world);
    return world;
  }

  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    cases::Pipeline damaged = pipeline;
    if (pipeline_damage) pipeline_damage(damaged);
    Result<cases::Picture> picture = inner_->picture_drawer()->draw_picture(c, damaged);
    if (picture && picture_damage) picture_damage(pipeline, *picture);
    return picture;
  }

  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    std::vector<std::uint32_t> changed(indices.begin(), indices.end());
    if (assembly_damage) assembly_damage(c, topology, changed);
    Result<cases::Fragments> drawn = inner_->assembler()->draw_assembled(c, topology, changed);
    if (drawn && damage_) damage_(c, *drawn);
    return drawn;
  }

 private:
  std::unique_ptr<backends::Backend> inner_;
  Damage damage_;
};

/// The index of a triangle's fragment at a pixel's sample 0, or the number of fragments if the
/// triangle has none there.
inline std::size_t find(const cases::Fragments& drawn, std::uint32_t triangle, int x, int y) {
  std::size_t i = 0;
  while (i < drawn.size() && (drawn.triangle[i] != triangle || drawn.x[i] != x || drawn.y[i] != y ||
                              drawn.sample[i] != 0)) {
    ++i;
  }
  return i;
}

inline bool is_drawn(const cases::Fragments& drawn, std::uint32_t triangle, int x, int y) {
  return find(drawn, triangle, x, y) < drawn.size();
}

/// Removes a fragment. Throws std::out_of_range if the triangle has none there.
inline void drop(cases::Fragments& drawn, std::uint32_t triangle, int x, int y) {
  if (!is_drawn(drawn, triangle, x, y)) throw std::out_of_range("no such fragment to drop");
  const auto i = static_cast<std::ptrdiff_t>(find(drawn, triangle, x, y));
  const auto count = static_cast<std::ptrdiff_t>(drawn.attribute_count);
  drawn.triangle.erase(drawn.triangle.begin() + i);
  drawn.x.erase(drawn.x.begin() + i);
  drawn.y.erase(drawn.y.begin() + i);
  drawn.sample.erase(drawn.sample.begin() + i);
  drawn.depth.erase(drawn.depth.begin() + i);
  drawn.attributes.erase(drawn.attributes.begin() + i * count,
                         drawn.attributes.begin() + (i + 1) * count);
  if (drawn.derivatives.empty()) return;
  drawn.derivatives.erase(drawn.derivatives.begin() + i * count * 2,
                          drawn.derivatives.begin() + (i + 1) * count * 2);
}

/// Appends a fragment with zero values.
inline void add(cases::Fragments& drawn, std::uint32_t triangle, int x, int y) {
  drawn.triangle.push_back(triangle);
  drawn.x.push_back(static_cast<std::uint16_t>(x));
  drawn.y.push_back(static_cast<std::uint16_t>(y));
  drawn.sample.push_back(0);
  drawn.depth.push_back(0);
  drawn.attributes.resize(drawn.attributes.size() + drawn.attribute_count);
  if (!drawn.derivatives.empty()) drawn.derivatives.resize(drawn.attributes.size() * 2);
}

/// The value of an attribute of the fragment at a pixel's sample 0. Throws std::out_of_range if the
/// triangle has no fragment there.
inline float& value(cases::Fragments& drawn, std::uint32_t triangle, int x, int y,
                    std::size_t attribute) {
  return drawn.attributes.at(find(drawn, triangle, x, y) * drawn.attribute_count + attribute);
}

/// A square that fills 8×8 pixels, as two triangles that share the diagonal from the upper right to
/// the lower left corner; w = 1, depth 1/4 everywhere. Window positions:
///
///   0 (0, 0)   1 (8, 0)      A = (0, 1, 2)   covers pixels with x + y < 7
///   2 (0, 8)   3 (8, 8)      B = (2, 1, 3)   covers pixels with x + y > 7
///
/// Centres of pixels with x + y = 7 lie on the diagonal. By the top-left rule they belong to B,
/// because the diagonal is a left edge of B. Attributes: 0 is the window x; 1 is one and 2 is zero
/// everywhere.
inline cases::Case square() {
  cases::Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.positions = {{-1, -1, 0.25F, 1}, {1, -1, 0.25F, 1}, {-1, 1, 0.25F, 1}, {1, 1, 0.25F, 1}};
  c.attributes = {{"x", cases::Interpolation::smooth, cases::Location::sample},
                  {"one", cases::Interpolation::smooth, cases::Location::sample},
                  {"zero", cases::Interpolation::smooth, cases::Location::sample}};
  c.attribute_values = {0, 1, 0, 8, 1, 0, 0, 1, 0, 8, 1, 0};
  c.triangles = {{0, 1, 2}, {2, 1, 3}};
  return c;
}

/// Loses pixel (7, 7) of the square: a fragment of B, whatever index B has.
inline void lose_last_corner(const cases::Case& /*c*/, cases::Fragments& drawn) {
  const std::uint32_t last = drawn.triangle.back();
  if (find(drawn, last, 7, 7) < drawn.size()) drop(drawn, last, 7, 7);
}

/// Checks a case by the law with this id.
inline Check check_of(std::string_view law, const cases::Case& c, backends::Backend& backend) {
  return check_law(*find_law(law), c, backend, 0).value();
}

/// Checks the case with a backend that has this damage.
inline Check check_of(std::string_view law, const cases::Case& c, const Damage& damage,
                      const std::string& specification = "method:rational-linear") {
  DamagedBackend backend(damage, specification);
  return check_of(law, c, backend);
}

}  // namespace rastercheck::properties
