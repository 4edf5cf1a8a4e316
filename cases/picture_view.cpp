#include "cases/picture_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cases/json.h"
#include "cases/names.h"

namespace rastercheck::cases {
namespace {

constexpr std::string_view kAttributePrefix = "attribute:";

/// The number that a text is, if it is one.
std::optional<float> number_in(std::string_view text) {
  float number = 0;
  const auto [end, why] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = why == std::errc() && end == text.data() + text.size();
  return is_number && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<std::uint32_t> attribute_named(const Case& c, std::string_view name) {
  const auto found = std::find_if(c.attributes.begin(), c.attributes.end(),
                                  [name](const Attribute& a) { return a.name == name; });
  if (found == c.attributes.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - c.attributes.begin());
}

/// Finds the thing that a word names; empty if the case has no such attribute.
std::optional<ShownChannel> shown_by(const Case& c, std::string_view word) {
  ShownChannel channel;
  if (word == "-") return channel;
  if (word == "depth") {
    channel.shows = Shown::depth;
    channel.background = 1;
    return channel;
  }
  if (word == "triangle") {
    channel.shows = Shown::triangle;
    return channel;
  }
  if (word == "coverage") {
    channel.shows = Shown::coverage;
    channel.constant = 1;
    return channel;
  }
  if (const std::optional<float> number = number_in(word)) {
    channel.shows = Shown::constant;
    channel.constant = *number;
    return channel;
  }
  if (word.starts_with(kAttributePrefix)) word.remove_prefix(kAttributePrefix.size());
  const std::optional<std::uint32_t> attribute = attribute_named(c, word);
  if (!attribute) return std::nullopt;
  channel.shows = Shown::attribute;
  channel.attribute = *attribute;
  return channel;
}

/// The layout's channels or, without any, the attributes on the file's channels.
std::vector<PictureChannel> planned_channels(const Case& c, const PictureLayout& layout,
                                             std::span<const std::string> names) {
  if (!layout.channels.empty()) return layout.channels;
  std::vector<PictureChannel> channels;
  // OpenEXR's order is alphabetical: B, G, R.
  const std::vector<std::string> usual = default_channel_names(names.size());
  if (std::is_permutation(names.begin(), names.end(), usual.begin(), usual.end())) names = usual;
  for (std::size_t i = 0; i < std::min(names.size(), c.attributes.size()); ++i) {
    channels.push_back({names[i], std::string(kAttributePrefix) + c.attributes[i].name, {}});
  }
  return channels;
}

std::string list_of(std::span<const std::string> names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// How a file's channel is stored: 8-bit integers may have a transfer function that no file names.
Result<Storage> storage_of(const PictureLayout& layout, const PictureFile& picture,
                           std::size_t channel, const std::string& file) {
  const Storage stored = picture.stored[channel];
  const Storage asked = layout.storage.value_or(stored);
  const bool is_possible = asked == stored ||
                           (asked == Storage::srgb8 && stored == Storage::unorm8) ||
                           // A float32 file may hold numbers that were rounded to float16.
                           (asked == Storage::float16 && stored == Storage::float32);
  // Formats of sRGB hold alpha as it is (OpenGL 4.6, §17.3.7).
  const bool is_alpha = picture.channels[channel] == "A";
  if (is_possible) return asked == Storage::srgb8 && is_alpha ? Storage::unorm8 : asked;
  return tl::unexpected(
      Error{file, "",
            fmt::format("channel {} holds {} numbers, not {}", printable(picture.channels[channel]),
                        name_of(stored), name_of(asked))});
}

/// Says which part of the layout needs alpha; empty if none does.
std::string_view use_of_alpha(const PictureLayout& layout) {
  if (layout.alpha == Alpha::premultiplied) return "alpha premultiplied";
  return layout.blend == Blend::over ? "blend over" : "";
}

/// Finds the channel that shows alpha. Fails if the layout needs one that the file does not have.
Result<void> find_alpha(const PictureLayout& layout, std::span<const std::string> names,
                        const std::string& file, PictureView& view) {
  const auto found = std::find_if(view.channels.begin(), view.channels.end(),
                                  [](const ShownChannel& one) { return one.name == "A"; });
  if (found != view.channels.end()) {
    view.alpha_channel = static_cast<std::size_t>(found - view.channels.begin());
  }
  const std::string_view use = use_of_alpha(layout);
  if (use.empty()) return {};
  if (!view.alpha_channel) {
    return tl::unexpected(Error{file, "",
                                fmt::format("has no channel A, which {} needs; its channels are {}",
                                            use, printable(list_of(names)))});
  }
  const bool is_alpha = found->shows == Shown::attribute || found->shows == Shown::constant ||
                        found->shows == Shown::coverage;
  if (is_alpha) return {};
  return tl::unexpected(
      Error{file, "",
            fmt::format("channel A shows no alpha, which {} needs: name an attribute, a number or "
                        "coverage",
                        use)});
}

}  // namespace

PictureFile planned_picture(const Case& c, const PictureLayout& layout) {
  PictureFile picture;
  picture.width = c.framebuffer.width;
  picture.height = c.framebuffer.height;
  for (const PictureChannel& one : layout.channels) picture.channels.push_back(one.name);
  if (layout.channels.empty()) picture.channels = default_channel_names(c.attributes.size());
  const Storage storage = layout.storage.value_or(Storage::float32);
  picture.stored.assign(picture.channels.size(),
                        storage == Storage::srgb8 ? Storage::unorm8 : storage);
  return picture;
}

Result<PictureView> view_of(const Case& c, const PictureLayout& layout, const PictureFile& picture,
                            const std::string& file) {
  const auto refuse = [&file](std::string reason) {
    return tl::unexpected(Error{file, "", std::move(reason)});
  };
  const FramebufferSize& size = c.framebuffer;
  if (picture.width != size.width || picture.height != size.height) {
    return refuse(fmt::format("has {} x {} pixels, the case {} x {}", picture.width, picture.height,
                              size.width, size.height));
  }
  if (picture.channels.empty()) {
    return refuse("would show nothing: the case has no attributes, and no channels are named");
  }
  PictureView view;
  view.size = size;
  view.rounding = layout.rounding;
  view.resolve = layout.resolve;
  view.alpha = layout.alpha;
  view.blend = layout.blend;
  view.is_flipped = (c.rules == Rules::opengl) == (layout.first_row == FirstRow::top);
  const std::vector<PictureChannel> planned = planned_channels(c, layout, picture.channels);
  for (const PictureChannel& one : planned) {
    const bool is_there = std::find(picture.channels.begin(), picture.channels.end(), one.name) !=
                          picture.channels.end();
    if (!is_there) {
      return refuse(fmt::format("has no channel {}; its channels are {}", printable(one.name),
                                printable(list_of(picture.channels))));
    }
  }
  for (std::size_t i = 0; i < picture.channels.size(); ++i) {
    const std::string& name = picture.channels[i];
    const auto one = std::find_if(planned.begin(), planned.end(),
                                  [&name](const PictureChannel& p) { return p.name == name; });
    if (one == planned.end()) {
      return refuse(
          fmt::format("nothing says what channel {} shows: name an attribute, depth, "
                      "triangle, coverage, a number, or - for a channel not to judge",
                      printable(name)));
    }
    std::optional<ShownChannel> shown = shown_by(c, one->shows);
    if (!shown) {
      return refuse(fmt::format("channel {} shows {}, which the case has no attribute for",
                                printable(name), json_string(one->shows)));
    }
    const Result<Storage> storage = storage_of(layout, picture, i, file);
    if (!storage) return tl::unexpected(storage.error());
    shown->name = name;
    shown->storage = *storage;
    shown->background = one->background.value_or(shown->background);
    if (shown->shows == Shown::triangle && size.samples > 1) {
      return refuse("the mean of several samples' triangles means nothing; use coverage or -");
    }
    view.channels.push_back(*std::move(shown));
  }
  if (const auto found = find_alpha(layout, picture.channels, file, view); !found) {
    return tl::unexpected(found.error());
  }
  return view;
}

}  // namespace rastercheck::cases
