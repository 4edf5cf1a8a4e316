#include "cases/picture_process.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "cases/case.h"
#include "cases/error_json.h"
#include "cases/internal/picture_formats.h"
#include "cases/internal/reader_reply.h"
#include "cases/json_node.h"
#include "cases/names.h"

namespace rastercheck::cases {
namespace {

constexpr std::string_view kKind = "picture";

/// The first line of an answer.
struct PictureHeader {
  std::optional<Error> error;  ///< the error that the answer has in place of a picture
  PictureFile picture;         ///< without its values
};

PictureHeader read_picture_header(const JsonNode& root) {
  if (root.has("error")) return {error_from_json(root), {}};
  root.expect_object({"width", "height", "channels", "stored"});
  PictureFile picture;
  picture.width = static_cast<int>(root["width"].integer(1, kMaxSize));
  picture.height = static_cast<int>(root["height"].integer(1, kMaxSize));
  for (const JsonNode& name : root["channels"].elements(1, kMaxPictureChannels, "names")) {
    picture.channels.push_back(name.text());
  }
  const std::size_t count = picture.channels.size();
  for (const JsonNode& stored : root["stored"].elements(count, count, "ways to store")) {
    picture.stored.push_back(stored.enumerator<Storage>());
  }
  return {std::nullopt, std::move(picture)};
}

}  // namespace

Result<PictureFile> picture_of_process(const std::vector<std::string>& command,
                                       const std::string& file, const ProcessLimits& limits) {
  return reply_of_reader(command, file, kKind, limits).and_then([&file](const std::string& reply) {
    return picture_from_reply(reply, file);
  });
}

Result<void> serve_picture(const std::string& file, ArrayOrder order, const ProcessLimits& limits) {
  return serve_reply([&] { return picture_to_reply(read_picture(file, order)); }, limits);
}

std::string picture_to_reply(const Result<PictureFile>& picture) {
  if (!picture) return header_line(error_to_json(picture.error()));
  nlohmann::json stored = nlohmann::json::array();
  for (const Storage one : picture->stored) stored.push_back(name_of(one));
  std::string reply = header_line({{"width", picture->width},
                                   {"height", picture->height},
                                   {"channels", picture->channels},
                                   {"stored", stored}});
  reply += bytes_of(picture->values);
  return reply;
}

Result<PictureFile> picture_from_reply(std::string_view reply, const std::string& file) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(reply_fault(file, kKind, reason));
  };
  const std::optional<std::string_view> line = take_header_line(reply);
  if (!line) return refuse("no header line");
  Result<PictureHeader> header = read_json(*line, file, &read_picture_header);
  if (!header) return refuse(header.error().reason);
  if (header->error) return tl::unexpected(*header->error);
  PictureFile& picture = header->picture;
  const std::size_t count = picture.value_count();
  if (reply.size() != count * sizeof(float)) {
    return refuse("its length differs from the one in its header");
  }
  picture.values = take_elements<float>(reply, count);
  return std::move(picture);
}

}  // namespace rastercheck::cases
