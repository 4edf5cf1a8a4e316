#include "cases/mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cases/camera_frame.h"

namespace rastercheck::cases {
namespace {

/// Points and lines become meshes of their own, which are skipped.
constexpr unsigned kImport = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                             aiProcess_PreTransformVertices | aiProcess_SortByPType;

bool has_triangles(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & static_cast<unsigned>(aiPrimitiveType_TRIANGLE)) != 0;
}

/// Appends a mesh's vertices and triangles; the reason for refusing it, or "".
std::string append(const aiMesh& mesh, bool textured, Case& c, Bounds& bounds) {
  const std::size_t base = c.positions.size();
  if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) {
    return "more than 2^32 - 1 vertices";
  }
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return fmt::format("vertex {} has a coordinate that is not finite", base + i);
    }
    const float u = textured ? mesh.mTextureCoords[0][i].x : p.x;
    const float v = textured ? mesh.mTextureCoords[0][i].y : p.y;
    if (!std::isfinite(u) || !std::isfinite(v)) {
      return fmt::format("vertex {} has a texture coordinate that is not finite", base + i);
    }
    c.positions.push_back({p.x, p.y, p.z, 1});
    c.attribute_values.push_back(u);
    c.attribute_values.push_back(v);
    const std::array<float, 3> xyz{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], double{xyz[axis]});
      bounds.hi[axis] = std::max(bounds.hi[axis], double{xyz[axis]});
    }
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    Triangle triangle{};
    for (unsigned corner = 0; corner < 3; ++corner) {
      if (face.mNumIndices != 3 || face.mIndices[corner] >= mesh.mNumVertices) {
        return fmt::format("face {} does not name three vertices", f);
      }
      triangle[corner] = static_cast<std::uint32_t>(base + face.mIndices[corner]);
    }
    c.triangles.push_back(triangle);
  }
  return "";
}

}  // namespace

Result<Case> case_from_mesh(const std::string& file, const MeshOptions& options) {
  const auto refuse = [&file](std::string reason) {
    return tl::unexpected(Error{file, "", std::move(reason)});
  };
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, kImport);
  if (scene == nullptr) return refuse(fmt::format("not a mesh: {}", importer.GetErrorString()));

  const std::span meshes(scene->mMeshes, scene->mNumMeshes);
  const bool textured = std::all_of(meshes.begin(), meshes.end(), [](const aiMesh* mesh) {
    return !has_triangles(*mesh) || mesh->HasTextureCoords(0);
  });
  Case c;
  c.name = std::filesystem::path(file).filename().string();
  c.rules = options.rules;
  c.fill_rule = default_fill_rule(c.rules);
  c.basis = default_basis(c.rules);
  c.framebuffer = {options.width, options.height, 1};
  c.viewport.width = static_cast<float>(options.width);
  c.viewport.height = static_cast<float>(options.height);
  c.attributes = {{textured ? "u" : "x", Interpolation::smooth, Location::sample},
                  {textured ? "v" : "y", Interpolation::smooth, Location::sample}};

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const aiMesh* mesh : meshes) {
    if (!has_triangles(*mesh)) continue;
    std::string reason = append(*mesh, textured, c, bounds);
    if (!reason.empty()) return refuse(std::move(reason));
  }
  if (c.triangles.empty()) return refuse("holds no triangle");
  c.camera = frame(bounds, c.rules, double{c.viewport.width} / double{c.viewport.height});
  const auto finite = [](float value) { return std::isfinite(value); };
  if (!std::all_of(c.camera->view.begin(), c.camera->view.end(), finite) ||
      !std::all_of(c.camera->projection.begin(), c.camera->projection.end(), finite)) {
    return refuse("too large to be framed by a float32 camera");
  }
  return c;
}

bool is_mesh_file(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return !extension.empty() && extension != ".json" &&
         Assimp::Importer().IsExtensionSupported(extension);
}

}  // namespace rastercheck::cases
