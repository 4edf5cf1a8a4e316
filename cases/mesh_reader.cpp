#include "cases/mesh_reader.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "cases/files.h"
#include "cases/internal/gltf_cameras.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

/// Polygons become triangles; points and lines become separate meshes, which are skipped. Vertices
/// are joined and transforms applied below, because assimp joins vertices that are merely near, and
/// regroups meshes when it transforms them.
constexpr unsigned kProcessing = aiProcess_Triangulate | aiProcess_SortByPType;

bool has_triangles(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & static_cast<unsigned>(aiPrimitiveType_TRIANGLE)) != 0;
}

bool is_finite(const aiVector3D& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The first reason not to process a scene further, or "". Some of assimp's readers pass on indices
/// beyond the vertices, which assimp's processing would follow.
std::string fault_of_scene(const aiScene& scene) {
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

/// Collects vertices, storing vertices with equal bits once.
class VertexTable {
 public:
  explicit VertexTable(Mesh& mesh) : mesh_(&mesh) {}

  std::uint32_t index_of(const aiVector3D& position, const std::array<float, 2>& texture) {
    const Bits key{
        std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
        std::bit_cast<std::uint32_t>(position.z), std::bit_cast<std::uint32_t>(texture[0]),
        std::bit_cast<std::uint32_t>(texture[1])};
    const auto next = static_cast<std::uint32_t>(mesh_->positions.size());
    const auto [entry, is_new] = indices_.try_emplace(key, next);
    if (is_new) {
      mesh_->positions.push_back({position.x, position.y, position.z});
      if (mesh_->is_textured) mesh_->texture.push_back(texture);
    }
    return entry->second;
  }

 private:
  using Bits = std::array<std::uint32_t, 5>;
  Mesh* mesh_;
  std::map<Bits, std::uint32_t> indices_;
};

/// Collects the triangles of a scene in the order of its nodes.
class TriangleCollector {
 public:
  TriangleCollector(const aiScene& scene, Mesh& mesh)
      : scene_(&scene), mesh_(&mesh), vertices_(mesh) {}

  /// Appends the meshes of a node and its descendants; returns the reason for refusing them, or "".
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
            p, mesh_->is_textured
                   ? std::array{mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y}
                   : std::array{0.0F, 0.0F});
      }
      if (mesh_->positions.size() > std::numeric_limits<std::uint32_t>::max()) {
        return "more than 2^32 - 1 vertices";
      }
      mesh_->triangles.push_back(triangle);
    }
    return "";
  }

  const aiScene* scene_;
  Mesh* mesh_;
  VertexTable vertices_;
};

/// The reason why nothing was read; quotes assimp unless it found no suitable reader. assimp gives
/// input from memory a made-up name, which is replaced by "-". `format` is the format the user
/// named when reading standard input.
std::string import_failure(const Assimp::Importer& importer, bool is_input,
                           const std::string& format) {
  std::string words = importer.GetErrorString();
  if (const std::size_t name = words.find(AI_MEMORYIO_MAGIC_FILENAME); name != std::string::npos) {
    words.replace(name, AI_MEMORYIO_MAGIC_FILENAME_LENGTH, "-");
  }
  if (!words.starts_with("No suitable reader")) return fmt::format("not a mesh: {}", words);
  if (!is_input) return "not a mesh, judging by its ending and its content";
  if (format.empty()) return "not a mesh, or of a format that must be named, such as --format obj";
  return importer.IsExtensionSupported("." + format)
             ? fmt::format("not a mesh of the format '{}'", format)
             : fmt::format("unknown mesh format '{}'", format);
}

/// Returns the mesh of the scene that an importer has read.
Result<Mesh> mesh_of_scene(Assimp::Importer& importer, const std::string& file,
                           const std::string& format) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(Error{file, "", printable(reason)});
  };
  const aiScene* scene = importer.GetScene();
  if (scene == nullptr) return refuse(import_failure(importer, file == "-", format));
  if (const std::string broken = fault_of_scene(*scene); !broken.empty()) return refuse(broken);
  scene = importer.ApplyPostProcessing(kProcessing);
  if (scene == nullptr) return refuse(import_failure(importer, file == "-", format));

  const std::span meshes(scene->mMeshes, scene->mNumMeshes);
  Mesh mesh;
  mesh.is_textured = std::all_of(meshes.begin(), meshes.end(), [](const aiMesh* one) {
    return !has_triangles(*one) || one->HasTextureCoords(0);
  });
  const std::string fault =
      TriangleCollector(*scene, mesh).append(*scene->mRootNode, aiMatrix4x4());
  if (!fault.empty()) return refuse(fault);
  return mesh;
}

}  // namespace

Result<Mesh> read_mesh(const std::string& file, const std::string& format) {
  const bool is_input = file == "-";
  // Reads the file here first, because assimp's own message for a missing file is misleading.
  Result<std::string> text = read_text(file);
  if (!text) return tl::unexpected(text.error());
  if (text->empty()) return tl::unexpected(Error{file, "", "not a mesh: empty"});
  try {
    std::vector<MeshCamera> cameras = gltf_cameras(*text);
    if (!is_input) *text = std::string();  // assimp reads the file itself
    Assimp::Importer importer;
    if (is_input) {
      importer.ReadFileFromMemory(text->data(), text->size(), 0, format.c_str());
    } else {
      importer.ReadFile(file, 0);
    }
    Result<Mesh> mesh = mesh_of_scene(importer, file, format);
    if (mesh) mesh->cameras = std::move(cameras);
    return mesh;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{file, "", "not enough memory to read it"});
  }
}

bool is_mesh_file(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  return !extension.empty() && extension != ".json" &&
         Assimp::Importer().IsExtensionSupported(extension);
}

}  // namespace rastercheck::cases
