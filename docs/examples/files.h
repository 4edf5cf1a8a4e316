#pragma once

// Reading meshes with assimp and writing pictures with libpng, for the examples.

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <png.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

struct Model {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
};

/// Reads the first mesh of a file, with smooth normals; nothing if the file has none.
inline std::optional<Model> read_model(const char* file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(
      file, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_DropNormals |
                aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mNumMeshes == 0) return std::nullopt;
  const aiMesh& mesh = *scene->mMeshes[0];
  if (mesh.mPrimitiveTypes != aiPrimitiveType_TRIANGLE || !mesh.HasNormals()) return std::nullopt;
  Model model;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    model.positions.push_back(glm::make_vec3(&mesh.mVertices[i].x));
    model.normals.push_back(glm::make_vec3(&mesh.mNormals[i].x));
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    model.triangles.push_back(glm::make_vec3(mesh.mFaces[i].mIndices));
  }
  return model;
}

/// The texels of a checkerboard of two by two squares, white and red, with `size` texels per side.
inline std::vector<std::uint8_t> checkerboard(std::size_t size) {
  std::vector<std::uint8_t> rgba(4 * size * size, 255);
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const std::size_t i = 4 * (y * size + x);
      if ((2 * x / size + 2 * y / size) % 2 == 0) rgba[i + 1] = rgba[i + 2] = 96;
    }
  }
  return rgba;
}

/// Writes a picture, top row first. Returns true on success. If some samples of a pixel were not
/// drawn, the pixel's mean colour is darker by the same factor as its alpha. A PNG stores colours
/// without that factor, so they are divided by alpha.
inline bool write_png(const char* file, int width, int height, std::span<const std::uint8_t> rgba) {
  std::vector<std::uint8_t> straight(rgba.begin(), rgba.end());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    const unsigned alpha = rgba[i | 3];
    if (i % 4 == 3 || alpha == 0) continue;
    straight[i] = static_cast<std::uint8_t>(std::min((rgba[i] * 255U + alpha / 2) / alpha, 255U));
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_RGBA;
  return png_image_write_to_file(&png, file, 0, straight.data(), 0, nullptr) != 0;
}
