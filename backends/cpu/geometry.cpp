#include "backends/cpu/geometry.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "backends/cpu/case_state.h"
#include "cases/topology.h"
#include "rasterizer/assembly.h"
#include "rasterizer/vertex_stage.h"

namespace rastercheck::backends {
namespace {

namespace ras = rasterizer;

/// Transposes: GLM's matrices are [column][row], while cases store theirs row by row.
glm::mat4 matrix(const cases::Matrix4& rows) {
  glm::mat4 result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result[static_cast<glm::length_t>(i % 4)][static_cast<glm::length_t>(i / 4)] = rows[i];
  }
  return result;
}

ras::Topology word(cases::Topology topology) {
  switch (topology) {
    case cases::Topology::triangles:
      return ras::Topology::triangles;
    case cases::Topology::strip:
      return ras::Topology::strip;
    case cases::Topology::fan:
      break;
  }
  return ras::Topology::fan;
}

ras::LineTopology line_word(cases::Topology topology) {
  return topology == cases::Topology::strip ? ras::LineTopology::strip : ras::LineTopology::list;
}

}  // namespace

Result<std::vector<cases::ClipVertex>> transformed(const cases::Case& c) {
  if (!c.camera) return tl::unexpected(Error{"", "", "the case has no camera"});
  const ras::Camera camera{matrix(c.camera->model), matrix(c.camera->view),
                           matrix(c.camera->projection)};
  std::vector<glm::vec4> clip;
  std::optional<ras::Error> error;
  // The rasterizer also accepts positions without w. They are used if every w is 1.
  const bool is_affine = std::all_of(c.positions.begin(), c.positions.end(),
                                     [](const cases::ClipVertex& p) { return p.w == 1; });
  if (is_affine) {
    std::vector<glm::vec3> positions;
    positions.reserve(c.positions.size());
    for (const cases::ClipVertex& p : c.positions) positions.emplace_back(p.x, p.y, p.z);
    error = ras::transform(camera, positions, clip);
  } else {
    std::vector<glm::vec4> positions;
    positions.reserve(c.positions.size());
    for (const cases::ClipVertex& p : c.positions) positions.emplace_back(p.x, p.y, p.z, p.w);
    error = ras::transform(camera, positions, clip);
  }
  if (error) return tl::unexpected(refused(*error));
  std::vector<cases::ClipVertex> result;
  result.reserve(clip.size());
  for (const glm::vec4& p : clip) result.push_back({p.x, p.y, p.z, p.w});
  return result;
}

Result<std::vector<cases::Normal>> transformed_normals(const cases::Matrix4& model,
                                                       std::span<const cases::Normal> normals) {
  std::vector<glm::vec3> of_object;
  of_object.reserve(normals.size());
  for (const auto& [x, y, z] : normals) of_object.emplace_back(x, y, z);
  std::vector<glm::vec3> world;
  if (const auto error = ras::transform_normals(matrix(model), of_object, world)) {
    return tl::unexpected(refused(*error));
  }
  std::vector<cases::Normal> result;
  result.reserve(world.size());
  for (const glm::vec3& n : world) result.push_back({n.x, n.y, n.z});
  return result;
}

Result<cases::Case> assembled(const cases::Case& c, cases::Topology topology,
                              std::span<const std::uint32_t> indices) {
  static_assert(cases::kRestart == ras::kRestart);
  if (!cases::has_topology(c.primitive, topology)) {
    return tl::unexpected(Error{"", "", std::string(cases::kNoSuchTopology), Failure::unsupported});
  }
  const bool is_of_lines = c.primitive == cases::Primitive::lines;
  std::vector<glm::uvec3> triangles;
  const auto error = is_of_lines
                         ? ras::assemble_lines(line_word(topology), indices, triangles)
                         : ras::assemble(word(topology), indices, convention(c.rules), triangles);
  if (error) return tl::unexpected(refused(*error));
  cases::Case result = c;
  result.triangles.clear();
  for (const glm::uvec3& t : triangles) {
    // Callers rely on the triangles of a case naming only existing vertices.
    if (std::max({t.x, t.y, t.z}) >= c.positions.size()) {
      return tl::unexpected(refused(ras::Error::index));
    }
    result.triangles.push_back({t.x, t.y, t.z});
  }
  return result;
}

}  // namespace rastercheck::backends
