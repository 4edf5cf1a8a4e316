#include "cases/internal/gltf_cameras.h"

// glTF 2.0: sections 3.5 (scenes, nodes and their transforms), 3.10 (cameras) and 4 (binary files).
// A file may have anything anywhere, so whatever is not of the expected type counts as missing.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace rastercheck::cases {
namespace {

using nlohmann::json;

/// The upper three rows of a matrix whose fourth is 0 0 0 1.
using Affine = std::array<double, 12>;
constexpr Affine kNoMove{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// a · b
Affine product(const Affine& a, const Affine& b) {
  Affine c{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a[4 * row + 3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a[4 * row + k] * b[4 * k + column];
      c[4 * row + column] = sum;
    }
  }
  return c;
}

/// The member of an object, or the element of an array; null if missing.
const json& part(const json& value, const char* key) {
  static const json kNull;
  const auto found = value.is_object() ? value.find(key) : value.end();
  return found != value.end() ? *found : kNull;
}
const json& part(const json& value, std::size_t index) {
  static const json kNull;
  return value.is_array() && index < value.size() ? value[index] : kNull;
}

std::optional<std::size_t> index_in(const json& value) {
  return value.is_number_unsigned() ? std::optional(value.get<std::size_t>()) : std::nullopt;
}

double number_or_zero(const json& value) { return value.is_number() ? value.get<double>() : 0; }

std::optional<double> optional_number(const json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

/// An array of numbers; empty unless it has as many.
template <std::size_t size>
std::optional<std::array<double, size>> numbers_in(const json& value) {
  if (!value.is_array() || value.size() != size) return std::nullopt;
  std::array<double, size> numbers{};
  for (std::size_t i = 0; i < size; ++i) numbers[i] = number_or_zero(value[i]);
  return numbers;
}

std::string_view text_in(const json& value) {
  return value.is_string() ? std::string_view(value.get_ref<const std::string&>())
                           : std::string_view();
}

/// A name, shortened: the answer's first line has a limit.
std::string name_in(const json& value) {
  constexpr std::size_t kLongestName = 200;
  return std::string(text_in(value).substr(0, kLongestName));
}

/// A node's own transform: a matrix column by column, or translation · rotation · scale.
Affine local_transform(const json& node) {
  if (const auto m = numbers_in<16>(part(node, "matrix"))) {
    Affine rows{};
    for (std::size_t i = 0; i < 12; ++i) rows[i] = (*m)[4 * (i % 4) + i / 4];
    return rows;
  }
  const auto move = numbers_in<3>(part(node, "translation")).value_or(std::array{0.0, 0.0, 0.0});
  const auto scale = numbers_in<3>(part(node, "scale")).value_or(std::array{1.0, 1.0, 1.0});
  const auto [x, y, z, w] =
      numbers_in<4>(part(node, "rotation")).value_or(std::array{0.0, 0.0, 0.0, 1.0});
  // The matrix of a quaternion, which is not quite a unit quaternion where a file rounds it.
  const double n = 2 / (x * x + y * y + z * z + w * w);
  const std::array<double, 9> rotation{
      1 - n * (y * y + z * z), n * (x * y - z * w),     n * (x * z + y * w),  //
      n * (x * y + z * w),     1 - n * (x * x + z * z), n * (y * z - x * w),  //
      n * (x * z - y * w),     n * (y * z + x * w),     1 - n * (x * x + y * y)};
  Affine rows{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) rows[4 * row + k] = rotation[3 * row + k] * scale[k];
    rows[4 * row + 3] = move[row];
  }
  return rows;
}

MeshCamera camera_in(const json& camera, const json& node, const Affine& to_object) {
  MeshCamera made;
  made.name = name_in(part(camera, "name"));
  if (made.name.empty()) made.name = name_in(part(node, "name"));
  made.is_orthographic = text_in(part(camera, "type")) == "orthographic";
  const json& numbers = part(camera, made.is_orthographic ? "orthographic" : "perspective");
  made.yfov = number_or_zero(part(numbers, "yfov"));
  made.aspect_ratio = optional_number(part(numbers, "aspectRatio"));
  made.xmag = number_or_zero(part(numbers, "xmag"));
  made.ymag = number_or_zero(part(numbers, "ymag"));
  made.znear = number_or_zero(part(numbers, "znear"));
  made.zfar = optional_number(part(numbers, "zfar"));
  // A transform that overflows has no direction.
  const auto finite = [](double x) { return std::isfinite(x); };
  if (std::all_of(to_object.begin(), to_object.end(), finite)) made.to_object = to_object;
  return made;
}

/// A node to visit.
struct Visit {
  std::size_t node = 0;
  Affine parent_to_object{};
};

/// Appends the nodes of a list, last one first, so that the first is on top.
void append_nodes(const json& list, const Affine& parent_to_object, std::vector<Visit>& visits) {
  for (std::size_t i = list.is_array() ? list.size() : 0; i-- > 0;) {
    if (const auto index = index_in(list[i])) visits.push_back({*index, parent_to_object});
  }
}

/// The nodes in which the hierarchy of the file's scene begins, or of its first one, last one
/// first.
std::vector<Visit> roots_of(const json& file) {
  const json& scene = part(part(file, "scenes"), index_in(part(file, "scene")).value_or(0));
  std::vector<Visit> visits;
  append_nodes(part(scene, "nodes"), kNoMove, visits);
  return visits;
}

/// The cameras of a parsed file.
std::vector<MeshCamera> cameras_in(const json& file) {
  const json& nodes = part(file, "nodes");
  const json& cameras = part(file, "cameras");
  std::vector<std::pair<std::size_t, MeshCamera>> placed;
  std::vector<bool> is_visited(nodes.is_array() ? nodes.size() : 0);
  std::vector<Visit> visits = roots_of(file);
  while (!visits.empty()) {
    const auto [index, parent_to_object] = visits.back();
    visits.pop_back();
    // The hierarchy is a tree; in a file that has it otherwise, the first way counts.
    if (index >= is_visited.size() || is_visited[index]) continue;
    is_visited[index] = true;
    const json& node = nodes[index];
    const Affine to_object = product(parent_to_object, local_transform(node));
    const auto camera = index_in(part(node, "camera"));
    if (camera && part(cameras, *camera).is_object()) {
      placed.emplace_back(*camera, camera_in(cameras[*camera], node, to_object));
    }
    append_nodes(part(node, "children"), to_object, visits);
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<MeshCamera> all;
  for (std::size_t i = 0; i < std::min(placed.size(), kMaxMeshCameras); ++i) {
    all.push_back(std::move(placed[i].second));
  }
  return all;
}

/// The JSON of a binary file (magic, version, length, then chunks of length, type and data), or the
/// content itself.
std::string_view json_text_of(std::string_view content) {
  constexpr std::size_t kDataAt = 20;
  if (!content.starts_with("glTF") || content.size() < kDataAt) return content;
  std::uint32_t length = 0;
  std::memcpy(&length, content.data() + 12, sizeof length);
  return content.substr(kDataAt, length);
}

}  // namespace

std::vector<MeshCamera> gltf_cameras(std::string_view content) {
  const std::string_view text = json_text_of(content);
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || text[begin] != '{') return {};
  // Keeps only what is needed: buffers may be part of the text.
  const auto keep = [](int depth, json::parse_event_t event, json& value) {
    if (depth != 1 || event != json::parse_event_t::key) return true;
    const std::string_view key = text_in(value);
    return key == "asset" || key == "cameras" || key == "nodes" || key == "scene" ||
           key == "scenes";
  };
  const json file = json::parse(text, keep, /*allow_exceptions=*/false);
  if (!text_in(part(part(file, "asset"), "version")).starts_with("2")) return {};
  return cameras_in(file);
}

}  // namespace rastercheck::cases
