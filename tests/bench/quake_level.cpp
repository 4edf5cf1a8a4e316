// Quake III's levels: "IBSP", the version, and 17 lumps given as (offset, length) in bytes. Numbers
// are little-endian, with 32 bits. (assimp reads only whole archives of levels, and leaves indices
// uninitialised.)

#include "tests/bench/quake_level.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "cases/files.h"

namespace rastercheck::bench {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Vertex {
  glm::vec3 position;
  glm::vec2 texture;
  glm::vec2 lightmap;
  glm::vec3 normal;
  std::uint32_t color;
};
static_assert(sizeof(Vertex) == 44);

struct Face {
  std::uint32_t texture;
  std::uint32_t effect;
  std::uint32_t type;
  std::uint32_t first_vertex;
  std::uint32_t vertex_count;
  std::uint32_t first_index;
  std::uint32_t index_count;
  std::uint32_t lightmap[17];  // place on the lightmap, normal, size of a patch
  std::uint32_t patch_size[2];
};
static_assert(sizeof(Face) == 104);

enum FaceType : std::uint32_t { kPolygon = 1, kMesh = 3 };
enum Lump : std::size_t { kVertices = 10, kIndices = 11, kFaces = 13 };

/// The elements of a lump; none if the lump extends beyond the file.
template <typename T>
std::vector<T> read_lump(std::string_view bytes, Lump lump) {
  constexpr std::size_t kDirectory = 8;
  struct Entry {
    std::uint32_t offset;
    std::uint32_t length;
  } entry{};
  const std::size_t at = kDirectory + lump * sizeof(Entry);
  if (bytes.size() < at + sizeof(Entry)) return {};
  std::memcpy(&entry, bytes.data() + at, sizeof(Entry));
  if (entry.offset > bytes.size() || entry.length > bytes.size() - entry.offset) return {};
  std::vector<T> elements(entry.length / sizeof(T));
  if (elements.empty()) return elements;
  std::memcpy(elements.data(), bytes.data() + entry.offset, elements.size() * sizeof(T));
  return elements;
}

}  // namespace

Result<QuakeLevel> read_quake_level(const std::string& file) {
  const auto refuse = [&file](const char* reason) {
    return tl::unexpected(Error{file, "", reason});
  };
  const Result<std::string> bytes = cases::read_text(file);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!bytes->starts_with(std::string_view("IBSP\x2e\0\0\0", 8))) {
    return refuse("not a level of Quake III");
  }
  QuakeLevel level;
  for (const Vertex& vertex : read_lump<Vertex>(*bytes, kVertices)) {
    level.positions.push_back(vertex.position);
    level.texture_coordinates.push_back(vertex.texture);
  }
  // Indices count from the first vertex of their face.
  const auto indices = read_lump<std::uint32_t>(*bytes, kIndices);
  for (const Face& face : read_lump<Face>(*bytes, kFaces)) {
    if (face.type != kPolygon && face.type != kMesh) continue;
    const std::uint64_t end = std::uint64_t{face.first_index} + face.index_count;
    if (end > indices.size()) return refuse("a face beyond the indices");
    for (std::uint64_t i = face.first_index; i + 3 <= end; i += 3) {
      glm::uvec3 triangle;
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint64_t index =
            std::uint64_t{face.first_vertex} + indices[i + static_cast<std::uint64_t>(corner)];
        if (index >= level.positions.size()) return refuse("an index beyond the vertices");
        triangle[corner] = static_cast<std::uint32_t>(index);
      }
      level.triangles.push_back(triangle);
    }
  }
  if (level.triangles.empty()) return refuse("holds no triangle");
  return level;
}

}  // namespace rastercheck::bench
