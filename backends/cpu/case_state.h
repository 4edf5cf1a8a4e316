#pragma once

// Translates a case into the rasterizer's types.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/picture.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/texture.h"

namespace rastercheck::backends {

rasterizer::Convention convention(cases::Rules rules);

// Parts of a pipeline (cases/picture.h).
rasterizer::DepthTest depth_test(cases::DepthFunction function);
rasterizer::Blend blend(cases::Blend blend);
rasterizer::ColorFormat format(cases::ColorFormat format);
rasterizer::DepthFormat format(cases::DepthFormat format);
rasterizer::Wrap wrap(cases::Wrap wrap);
rasterizer::Filter filter(cases::Filter filter);

/// The snapping grid that a case asks for. Rounds to nearest if the case leaves the rounding open.
rasterizer::Snapping snapping(const cases::Snapping& asked_for);

/// The rasterizer's state for a case, without the depth test. Conservative coverage is that of the
/// exact positions, whatever grid the case asks for.
rasterizer::State state_of(const cases::Case& c,
                           rasterizer::Conservative conservative = rasterizer::Conservative::off);

/// A depth buffer's initial value, as the format of the case's depths holds it.
float stored_clear(const cases::Case& c, float depth);
/// Returns the depth buffer's initial value as stored; empty if the case names none.
std::optional<float> stored_clear(const cases::Case& c);

/// Adds what the rasterizer promises of depths (rasterizer.h): its bound, the format that a case
/// asks for, and the bias.
void promise_depths(const cases::Case& c, cases::Contract& contract);

/// A case's triangles as the rasterizer's mesh. The case must outlive this object.
class CaseMesh {
 public:
  explicit CaseMesh(const cases::Case& c);
  rasterizer::Mesh mesh() const;

 private:
  const cases::Case& case_;
  std::vector<glm::vec4> positions_;
  std::vector<glm::uvec3> triangles_;
};

rasterizer::TargetSize target_size(const cases::Case& c);

/// The error for a draw that the rasterizer refused.
Error refused(rasterizer::Error error);

}  // namespace rastercheck::backends
