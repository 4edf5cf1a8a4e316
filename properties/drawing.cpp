#include "properties/drawing.h"

#include <cassert>

#include "backends/floating_point_modes.h"

namespace rastercheck::properties {
namespace {

/// True if the arrays' lengths fit each other and the case's attributes.
bool is_well_formed(const cases::Fragments& drawn, const cases::Case& c) {
  const std::size_t size = drawn.size();
  return drawn.attribute_count == c.attributes.size() && drawn.x.size() == size &&
         drawn.y.size() == size && drawn.sample.size() == size && drawn.depth.size() == size &&
         drawn.attributes.size() == size * drawn.attribute_count &&
         (drawn.derivatives.empty() ||
          drawn.derivatives.size() == size * drawn.attribute_count * 2);
}

bool is_well_formed(const backends::Drawn& drawn, const cases::Case& c) {
  return is_well_formed(drawn.fragments, c);
}

/// True if the picture has the size and the number of channels that case and pipeline require: four
/// channels if it is textured or its shading has four, else one per attribute.
bool is_well_formed(const cases::Picture& picture, const cases::Case& c,
                    const cases::Pipeline& pipeline) {
  cases::FramebufferSize size = c.framebuffer;
  if (pipeline.resolves) size.samples = 1;
  const std::size_t samples = static_cast<std::size_t>(size.width) *
                              static_cast<std::size_t>(size.height) *
                              static_cast<std::size_t>(size.samples);
  const bool has_four = pipeline.texturing || cases::has_four_channels(pipeline.shading);
  const std::size_t channels = has_four ? 4 : c.attributes.size();
  return picture.size == size && picture.channels == channels && picture.depth.size() == samples &&
         picture.color.size() == samples * picture.channels;
}

Error left_other_modes() {
  return {"", "", "the backend changed the rounding mode or the treatment of subnormal numbers"};
}

Error no_promise() {
  return {"", "", "values outside the range the backend promises to handle", Failure::unsupported};
}

Result<void> check_depth_range(const cases::Case& c, const backends::Backend& backend) {
  if (cases::promises_depth_range_of(backend.contract(c), c)) return {};
  return tl::unexpected(Error{"", "",
                              "depth range outside the range the backend promises to handle",
                              Failure::unsupported});
}

/// Runs `call()`, which draws a case without a camera, and checks its result and the floating-point
/// modes.
template <typename Call>
auto drawn_by(const cases::Case& c, const Call& call) -> decltype(call()) {
  assert(!c.camera);
  const backends::FloatingPointModes modes;
  auto drawn = call();
  if (modes.have_changed()) return tl::unexpected(left_other_modes());
  if (drawn && !is_well_formed(*drawn, c)) {
    return tl::unexpected(Error{"", "",
                                "the backend's fragments do not have the case's attributes, or its "
                                "arrays differ in length"});
  }
  return drawn;
}

void amend(const cases::Case& c, const backends::Backend& backend, cases::Fragments& drawn) {
  if (backend.amendment()) backend.amendment()(c, drawn);
}

/// Draws with backend.draw(), checks the result, and applies the backend's amendment.
Result<backends::Drawn> drawn_by(const cases::Case& c, backends::Backend& backend) {
  Result<backends::Drawn> drawn = drawn_by(c, [&] { return backend.draw(c); });
  if (drawn) amend(c, backend, drawn->fragments);
  return drawn;
}

}  // namespace

Result<backends::Drawn> draw(const cases::Case& c, backends::Backend& backend) {
  if (Result<void> promised = check_depth_range(c, backend); !promised) {
    return tl::unexpected(promised.error());
  }
  return drawn_by(c, backend);
}

Result<backends::Drawn> draw_promised(const cases::Case& c, backends::Backend& backend) {
  if (!cases::promises_all_of(backend.contract(c), c)) return tl::unexpected(no_promise());
  return drawn_by(c, backend);
}

Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way,
                                 backends::Backend& backend) {
  if (!cases::promises_all_of(backend.contract(c), c)) return tl::unexpected(no_promise());
  Result<cases::Fragments> drawn =
      drawn_by(c, [&] { return backend.ways_of_drawing()->draw_by(c, way); });
  if (drawn) amend(c, backend, *drawn);
  return drawn;
}

Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                        std::span<const std::uint32_t> indices,
                                        backends::Backend& backend) {
  if (Result<void> promised = check_depth_range(c, backend); !promised) {
    return tl::unexpected(promised.error());
  }
  Result<cases::Fragments> drawn =
      drawn_by(c, [&] { return backend.assembler()->draw_assembled(c, topology, indices); });
  if (drawn) amend(c, backend, *drawn);
  return drawn;
}

Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c, backends::Backend& backend) {
  const backends::FloatingPointModes modes;
  Result<std::vector<cases::ClipVertex>> positions = backend.vertex_stage()->transform(c);
  if (modes.have_changed()) return tl::unexpected(left_other_modes());
  if (positions && positions->size() != c.positions.size()) {
    return tl::unexpected(Error{
        "", "", "the number of the backend's clip positions differs from the number of vertices"});
  }
  return positions;
}

Result<std::vector<cases::Normal>> transform_normals(const cases::Matrix4& model,
                                                     std::span<const cases::Normal> normals,
                                                     backends::Backend& backend) {
  const backends::FloatingPointModes modes;
  Result<std::vector<cases::Normal>> world =
      backend.vertex_stage()->transform_normals(model, normals);
  if (modes.have_changed()) return tl::unexpected(left_other_modes());
  if (world && world->size() != normals.size()) {
    return tl::unexpected(
        Error{"", "", "the backend returned another number of normals than it was given"});
  }
  return world;
}

Result<cases::Picture> draw_picture(const cases::Case& c, backends::Backend& backend,
                                    const cases::Pipeline& pipeline) {
  assert(!c.camera);
  const backends::FloatingPointModes modes;
  Result<cases::Picture> picture = backend.picture_drawer()->draw_picture(c, pipeline);
  if (modes.have_changed()) return tl::unexpected(left_other_modes());
  if (picture && !is_well_formed(*picture, c, pipeline)) {
    return tl::unexpected(Error{"", "",
                                "the backend's picture does not have the case's size, samples or "
                                "attributes, or the lengths of its arrays are wrong"});
  }
  return picture;
}

Result<bool> is_occluded(const cases::Case& c, std::size_t occluders, backends::Backend& backend) {
  assert(!c.camera);
  if (Result<void> promised = check_depth_range(c, backend); !promised) {
    return tl::unexpected(promised.error());
  }
  const backends::FloatingPointModes modes;
  Result<bool> answer = backend.occlusion_culler()->is_occluded(c, occluders);
  if (modes.have_changed()) return tl::unexpected(left_other_modes());
  return answer;
}

}  // namespace rastercheck::properties
