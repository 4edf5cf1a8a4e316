#include "cases/mesh_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "cases/error_json.h"
#include "cases/json_node.h"
#include "cases/mesh_reader.h"

namespace rastercheck::cases {
namespace {

using nlohmann::json;

/// The longest first line of an answer, in bytes; the line may quote file names. Parsing a longer
/// document would take many times its length in memory.
constexpr std::size_t kLongestLine = 65536;

static_assert(std::endian::native == std::endian::little);

template <typename Element>
std::string_view bytes_of(const std::vector<Element>& elements) {
  return {reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element)};
}

/// Removes the bytes of `count` elements from the front of a text, which must have them.
template <typename Element>
std::vector<Element> take(std::string_view& bytes, std::size_t count) {
  std::vector<Element> elements(count);
  const std::size_t size = count * sizeof(Element);
  std::copy_n(bytes.begin(), size, reinterpret_cast<char*>(elements.data()));
  bytes.remove_prefix(size);
  return elements;
}

template <std::size_t size>
bool all_finite(const std::vector<std::array<float, size>>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const std::array<float, size>& vector) {
    return std::all_of(vector.begin(), vector.end(), [](float x) { return std::isfinite(x); });
  });
}

/// The reason why a mesh cannot be drawn, or "".
std::string fault_of(const Mesh& mesh) {
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
};

Header read_header(const JsonNode& root) {
  if (root.has("error")) return {error_from_json(root)};
  root.expect_object({"vertices", "triangles", "textured"});
  return {std::nullopt, root["vertices"].count<std::uint32_t>(),
          root["triangles"].count<std::uint32_t>(), root["textured"].boolean()};
}

/// Bytes that follow a header; they fit 64 bits, since both counts fit 32.
std::uint64_t payload_size(std::uint64_t vertices, std::uint64_t triangles, bool is_textured) {
  const std::uint64_t per_vertex = (is_textured ? 5 : 3) * sizeof(float);
  return vertices * per_vertex + triangles * sizeof(Triangle);
}

/// The reason why a process failed.
std::string reason_of(const ChildOutcome& outcome, const ProcessLimits& limits) {
  if (!outcome.is_whole) return "the mesh reader's answer is larger than any mesh";
  if (outcome.end.signal == SIGXCPU) {
    return fmt::format("the mesh reader took longer than {} s", limits.seconds);
  }
  if (outcome.end.signal != 0) {
    return fmt::format("the mesh reader crashed ({})", ::strsignal(outcome.end.signal));
  }
  return "the mesh reader " + to_string(outcome.end);
}

bool write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

ProcessLimits default_mesh_limits() {
  constexpr unsigned kSeconds = 120;
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  return {pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2, kSeconds};
}

Result<Mesh> mesh_of_process(const std::vector<std::string>& command, const std::string& file,
                             const ProcessLimits& limits) {
  const Result<ChildOutcome> outcome = run_child(command, limits.memory);
  if (!outcome) return tl::unexpected(outcome.error());
  if (!outcome->is_whole || outcome->end.signal != 0 || outcome->end.exit_code != 0) {
    return tl::unexpected(Error{file, "", reason_of(*outcome, limits)});
  }
  return mesh_from_reply(outcome->output, file);
}

Result<void> serve_mesh(const std::string& file, const std::string& format,
                        const ProcessLimits& limits) {
  // assimp's readers print; their output must not get into the answer.
  const Result<Descriptor> answers = take_standard_output();
  if (!answers) return tl::unexpected(answers.error());
  return limit_this_process(limits).and_then([&]() -> Result<void> {
    if (write_all(answers->number(), mesh_to_reply(read_mesh(file, format)))) return {};
    return tl::unexpected(Error{"standard output", "", std::strerror(errno)});
  });
}

std::string mesh_to_reply(const Result<Mesh>& mesh) {
  json header;
  if (!mesh) {
    header = error_to_json(mesh.error());
  } else {
    header = {{"vertices", mesh->positions.size()},
              {"triangles", mesh->triangles.size()},
              {"textured", mesh->is_textured}};
  }
  std::string reply = header.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  if (!mesh) return reply;
  reply += bytes_of(mesh->positions);
  reply += bytes_of(mesh->texture);
  reply += bytes_of(mesh->triangles);
  return reply;
}

Result<Mesh> mesh_from_reply(std::string_view reply, const std::string& file) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(Error{file, "", "the mesh reader's answer: " + reason});
  };
  const std::size_t end = reply.find('\n');
  if (end == std::string_view::npos || end > kLongestLine) return refuse("no header line");
  const Result<Header> header = read_json(reply.substr(0, end), file, &read_header);
  if (!header) return refuse(header.error().reason);
  if (header->error) return tl::unexpected(*header->error);
  std::string_view payload = reply.substr(end + 1);
  if (payload.size() != payload_size(header->vertices, header->triangles, header->is_textured)) {
    return refuse("its length differs from the one in its header");
  }
  Mesh mesh;
  mesh.is_textured = header->is_textured;
  mesh.positions = take<std::array<float, 3>>(payload, header->vertices);
  if (mesh.is_textured) mesh.texture = take<std::array<float, 2>>(payload, header->vertices);
  mesh.triangles = take<Triangle>(payload, header->triangles);
  if (const std::string fault = fault_of(mesh); !fault.empty()) return refuse(fault);
  return mesh;
}

}  // namespace rastercheck::cases
