#include "cases/mesh_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cases/error_json.h"
#include "cases/internal/reader_reply.h"
#include "cases/json_members.h"
#include "cases/json_node.h"
#include "cases/mesh_reader.h"

namespace rastercheck::cases {

/// Here for json_members.h, which finds it by the type's namespace.
template <typename Archive, Either<MeshCamera> Camera>
void members(Archive& archive, Camera& camera) {
  archive.optional("name", camera.name);
  archive.optional("orthographic", camera.is_orthographic);
  archive.optional("yfov", camera.yfov);
  archive.optional("aspect_ratio", camera.aspect_ratio);
  archive.optional("xmag", camera.xmag);
  archive.optional("ymag", camera.ymag);
  archive.optional("znear", camera.znear);
  archive.optional("zfar", camera.zfar);
  archive.required("to_object", camera.to_object);
}

namespace {

using nlohmann::json;

constexpr std::string_view kWhat = "mesh";

template <std::size_t size>
bool all_finite(const std::vector<std::array<float, size>>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const std::array<float, size>& vector) {
    return std::all_of(vector.begin(), vector.end(), [](float x) { return std::isfinite(x); });
  });
}

bool has_finite_numbers(const MeshCamera& camera) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(camera.to_object.begin(), camera.to_object.end(), finite) &&
         finite(camera.yfov) && finite(camera.aspect_ratio.value_or(0)) && finite(camera.xmag) &&
         finite(camera.ymag) && finite(camera.znear) && finite(camera.zfar.value_or(0));
}

/// The reason why a mesh cannot be drawn, or "".
std::string fault_of(const Mesh& mesh) {
  if (mesh.cameras.size() > kMaxMeshCameras) return "too many cameras";
  if (!std::all_of(mesh.cameras.begin(), mesh.cameras.end(), &has_finite_numbers)) {
    return "a camera's number is not finite";
  }
  if (!all_finite(mesh.positions) || !all_finite(mesh.texture)) return "a number is not finite";
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index >= mesh.positions.size()) return "an index is out of range";
    }
  }
  return "";
}

/// The first line of an answer.
struct Header {
  std::optional<Error> error;  ///< the error that the answer has in place of a mesh
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  bool is_textured = false;
  std::vector<MeshCamera> cameras;
};

Header read_header(const JsonNode& root) {
  if (root.has("error")) return {error_from_json(root), 0, 0, false, {}};
  root.expect_object({"vertices", "triangles", "textured"}, {"cameras"});
  Header header{std::nullopt,
                root["vertices"].count<std::uint32_t>(),
                root["triangles"].count<std::uint32_t>(),
                root["textured"].boolean(),
                {}};
  if (root.has("cameras")) header.cameras = read_as<std::vector<MeshCamera>>(root["cameras"]);
  return header;
}

/// Bytes that follow a header; they fit 64 bits, since both counts fit 32.
std::uint64_t payload_size(std::uint64_t vertices, std::uint64_t triangles, bool is_textured) {
  const std::uint64_t per_vertex = (is_textured ? 5 : 3) * sizeof(float);
  return vertices * per_vertex + triangles * sizeof(Triangle);
}

}  // namespace

Result<Mesh> mesh_of_process(const std::vector<std::string>& command, const std::string& file,
                             const ProcessLimits& limits) {
  return reply_of_reader(command, file, kWhat, limits).and_then([&file](const std::string& reply) {
    return mesh_from_reply(reply, file);
  });
}

Result<void> serve_mesh(const std::string& file, const std::string& format,
                        const ProcessLimits& limits) {
  return serve_reply([&] { return mesh_to_reply(read_mesh(file, format)); }, limits);
}

std::string mesh_to_reply(const Result<Mesh>& mesh) {
  json header;
  if (!mesh) {
    header = error_to_json(mesh.error());
  } else {
    header = {{"vertices", mesh->positions.size()},
              {"triangles", mesh->triangles.size()},
              {"textured", mesh->is_textured}};
    if (!mesh->cameras.empty()) header["cameras"] = json_of(mesh->cameras);
  }
  std::string reply = header_line(header);
  if (!mesh) return reply;
  reply += bytes_of(mesh->positions);
  reply += bytes_of(mesh->texture);
  reply += bytes_of(mesh->triangles);
  return reply;
}

Result<Mesh> mesh_from_reply(std::string_view reply, const std::string& file) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(reply_fault(file, kWhat, reason));
  };
  std::string_view payload = reply;
  const std::optional<std::string_view> line = take_header_line(payload);
  if (!line) return refuse("no header line");
  Result<Header> header = read_json(*line, file, &read_header);
  if (!header) return refuse(header.error().reason);
  if (header->error) return tl::unexpected(*header->error);
  if (payload.size() != payload_size(header->vertices, header->triangles, header->is_textured)) {
    return refuse("its length differs from the one in its header");
  }
  Mesh mesh;
  mesh.is_textured = header->is_textured;
  mesh.cameras = std::move(header->cameras);
  mesh.positions = take_elements<std::array<float, 3>>(payload, header->vertices);
  if (mesh.is_textured)
    mesh.texture = take_elements<std::array<float, 2>>(payload, header->vertices);
  mesh.triangles = take_elements<Triangle>(payload, header->triangles);
  if (const std::string fault = fault_of(mesh); !fault.empty()) return refuse(fault);
  return mesh;
}

}  // namespace rastercheck::cases
