#include "cases/picture_layout_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/float_text.h"
#include "cases/json.h"
#include "cases/names.h"

namespace rastercheck::cases {

PictureLayout read_picture_layout(const JsonNode& node) {
  node.expect_object({},
                     {"channels", "storage", "rounding", "first_row", "resolve", "alpha", "blend"});
  PictureLayout layout;
  if (node.has("channels")) {
    for (const JsonNode& element : node["channels"].elements(1, kMaxPictureChannels, "channels")) {
      element.expect_object({"name", "shows"}, {"background"});
      PictureChannel channel{element["name"].text(), element["shows"].text(), std::nullopt};
      if (element.has("background")) channel.background = element["background"].float32();
      layout.channels.push_back(std::move(channel));
    }
  }
  if (node.has("storage")) layout.storage = node["storage"].enumerator<Storage>();
  if (node.has("rounding")) layout.rounding = node["rounding"].enumerator<StoreRounding>();
  if (node.has("first_row")) layout.first_row = node["first_row"].enumerator<FirstRow>();
  if (node.has("resolve")) layout.resolve = node["resolve"].enumerator<ResolveOf>();
  if (node.has("alpha")) layout.alpha = node["alpha"].enumerator<Alpha>();
  if (node.has("blend")) layout.blend = node["blend"].enumerator<Blend>();
  return layout;
}

std::string to_json(const PictureLayout& layout) {
  std::vector<std::string> members;
  if (!layout.channels.empty()) {
    std::vector<std::string> channels;
    for (const PictureChannel& one : layout.channels) {
      std::string background;
      if (one.background) {
        background = fmt::format(R"(, "background": "{}")", to_hex(*one.background));
      }
      channels.push_back(fmt::format(R"({{"name": {}, "shows": {}{}}})", json_string(one.name),
                                     json_string(one.shows), background));
    }
    members.push_back(fmt::format(R"("channels": [{}])", fmt::join(channels, ", ")));
  }
  const auto add = [&members](std::string_view key, std::string_view word) {
    members.push_back(fmt::format(R"("{}": "{}")", key, word));
  };
  if (layout.storage) add("storage", name_of(*layout.storage));
  add("rounding", name_of(layout.rounding));
  add("first_row", name_of(layout.first_row));
  add("resolve", name_of(layout.resolve));
  add("alpha", name_of(layout.alpha));
  add("blend", name_of(layout.blend));
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

}  // namespace rastercheck::cases
