#include "cases/mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <span>

#include "cases/camera_frame.h"
#include "cases/files.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

/// Polygons become triangles; points and lines become meshes of their own, which are skipped.
/// Vertices are joined and transforms applied below: assimp joins what is merely near, and regroups
/// meshes when it transforms them.
constexpr unsigned kProcessing = aiProcess_Triangulate | aiProcess_SortByPType;

bool has_triangles(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & static_cast<unsigned>(aiPrimitiveType_TRIANGLE)) != 0;
}

bool is_finite(const aiVector3D& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The first thing in a scene that must not be processed further, or "". Some of assimp's readers
/// pass on indices beyond the vertices, which its processing follows.
std::string fault_of(const aiScene& scene) {
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      for (const unsigned index : std::span(face.mIndices, face.mNumIndices)) {
        if (index >= mesh->mNumVertices) {
          return fmt::format("index {} out of range: there are {} vertices", index,
                             mesh->mNumVertices);
        }
      }
    }
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
      if (!is_finite(mesh->mVertices[i])) {
        return fmt::format("vertex {} has a coordinate that is not finite", i);
      }
      if (mesh->HasTextureCoords(0) && !is_finite(mesh->mTextureCoords[0][i])) {
        return fmt::format("vertex {} has a texture coordinate that is not finite", i);
      }
    }
  }
  return "";
}

/// Gathers vertices, each set of equal bits once.
class VertexTable {
 public:
  explicit VertexTable(Case& c) : case_(&c) {}

  std::uint32_t index_of(const aiVector3D& position, const std::array<float, 2>& attributes) {
    const Bits key{
        std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
        std::bit_cast<std::uint32_t>(position.z), std::bit_cast<std::uint32_t>(attributes[0]),
        std::bit_cast<std::uint32_t>(attributes[1])};
    const auto next = static_cast<std::uint32_t>(case_->positions.size());
    const auto [entry, is_new] = indices_.try_emplace(key, next);
    if (is_new) {
      case_->positions.push_back({position.x, position.y, position.z, 1});
      case_->attribute_values.insert(case_->attribute_values.end(), attributes.begin(),
                                     attributes.end());
    }
    return entry->second;
  }

 private:
  using Bits = std::array<std::uint32_t, 5>;
  Case* case_;
  std::map<Bits, std::uint32_t> indices_;
};

/// Gathers the triangles of a scene in the order of its nodes.
class TriangleCollector {
 public:
  TriangleCollector(const aiScene& scene, bool textured, Case& c)
      : scene_(&scene), textured_(textured), case_(&c), vertices_(c) {}

  /// Appends the meshes of a node and of those below it; the reason for refusing them, or "".
  std::string append(const aiNode& node, const aiMatrix4x4& parent_to_object) {
    const aiMatrix4x4 to_object = parent_to_object * node.mTransformation;
    for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
      std::string fault = append(*scene_->mMeshes[index], to_object);
      if (!fault.empty()) return fault;
    }
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) {
      std::string fault = append(*child, to_object);
      if (!fault.empty()) return fault;
    }
    return "";
  }

 private:
  std::string append(const aiMesh& mesh, const aiMatrix4x4& to_object) {
    if (!has_triangles(mesh)) return "";
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      if (face.mNumIndices != 3) continue;  // a triangulated polygon without area
      Triangle triangle{};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const unsigned i = face.mIndices[corner];
        const aiVector3D p =
            to_object.IsIdentity() ? mesh.mVertices[i] : to_object * mesh.mVertices[i];
        if (!is_finite(p)) return "a transformed coordinate is not finite";
        triangle[corner] = vertices_.index_of(
            p, textured_ ? std::array{mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y}
                         : std::array{p.x, p.y});
      }
      if (case_->positions.size() > std::numeric_limits<std::uint32_t>::max()) {
        return "more than 2^32 - 1 vertices";
      }
      case_->triangles.push_back(triangle);
    }
    return "";
  }

  const aiScene* scene_;
  bool textured_;
  Case* case_;
  VertexTable vertices_;
};

Bounds bounds_of(const std::vector<ClipVertex>& positions) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const ClipVertex& p : positions) {
    const std::array<double, 3> xyz{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], xyz[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], xyz[axis]);
    }
  }
  return bounds;
}

bool is_finite(const Camera& camera) {
  const auto finite = [](float value) { return std::isfinite(value); };
  return std::all_of(camera.view.begin(), camera.view.end(), finite) &&
         std::all_of(camera.projection.begin(), camera.projection.end(), finite);
}

/// All but the vertices and triangles.
Case empty_case(const std::string& file, const MeshOptions& options, bool textured) {
  Case c;
  c.name = printable(std::filesystem::path(file).filename().string());
  c.rules = options.rules;
  c.fill_rule = default_fill_rule(c.rules);
  c.basis = default_basis(c.rules);
  c.framebuffer = {options.width, options.height, 1};
  c.viewport.width = static_cast<float>(options.width);
  c.viewport.height = static_cast<float>(options.height);
  c.attributes = {{textured ? "u" : "x", Interpolation::smooth, Location::sample},
                  {textured ? "v" : "y", Interpolation::smooth, Location::sample}};
  return c;
}

/// The case of what an importer has read.
Result<Case> case_from_scene(Assimp::Importer& importer, const std::string& file,
                             const MeshOptions& options) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(Error{file, "", printable(reason)});
  };
  const aiScene* scene = importer.GetScene();
  if (scene == nullptr) return refuse(fmt::format("not a mesh: {}", importer.GetErrorString()));
  if (const std::string broken = fault_of(*scene); !broken.empty()) return refuse(broken);
  scene = importer.ApplyPostProcessing(kProcessing);
  if (scene == nullptr) return refuse(fmt::format("not a mesh: {}", importer.GetErrorString()));

  const std::span meshes(scene->mMeshes, scene->mNumMeshes);
  const bool textured = std::all_of(meshes.begin(), meshes.end(), [](const aiMesh* mesh) {
    return !has_triangles(*mesh) || mesh->HasTextureCoords(0);
  });
  Case c = empty_case(file, options, textured);
  const std::string fault =
      TriangleCollector(*scene, textured, c).append(*scene->mRootNode, aiMatrix4x4());
  if (!fault.empty()) return refuse(fault);
  if (c.triangles.empty()) return refuse("holds no triangle");
  c.camera =
      frame(bounds_of(c.positions), c.rules, double{c.viewport.width} / double{c.viewport.height});
  if (!is_finite(*c.camera)) return refuse("too large to be framed by a float32 camera");
  return c;
}

}  // namespace

Result<Case> case_from_mesh(const std::string& file, const MeshOptions& options) {
  // assimp's own words for a file that is not there are not about the file.
  if (const auto text = read_text(file); !text) return tl::unexpected(text.error());
  Assimp::Importer importer;
  importer.ReadFile(file, 0);
  return case_from_scene(importer, file, options);
}

Result<Case> case_from_mesh_text(std::string_view text, const std::string& format,
                                 const std::string& file, const MeshOptions& options) {
  Assimp::Importer importer;
  importer.ReadFileFromMemory(text.data(), text.size(), 0, format.c_str());
  return case_from_scene(importer, file, options);
}

bool is_mesh_file(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return !extension.empty() && extension != ".json" &&
         Assimp::Importer().IsExtensionSupported(extension);
}

}  // namespace rastercheck::cases
