#include "properties/laws/internal/same_picture.h"

#include <cstdint>
#include <optional>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"

namespace rastercheck::properties {

using records::AttributeKind;

namespace {

/// True if a channel is one of the case's attributes; false for colours of a texture and added
/// alpha.
bool is_attribute(const cases::Case& c, std::optional<std::uint32_t> channel) {
  return channel && *channel < c.attributes.size();
}

}  // namespace

AttributeKind kind_of_channel(const cases::Case& c, std::optional<std::uint32_t> channel) {
  return channel && !is_attribute(c, channel) ? AttributeKind::flat : kind_of(c, channel);
}

records::Violation picture_violation(const cases::Case& c, const cases::Picture& picture,
                                     std::size_t at, std::optional<std::uint32_t> channel,
                                     float expected, const std::string& note) {
  const float actual =
      channel ? picture.color[at * picture.channels + *channel] : picture.depth[at];
  const auto attribute = is_attribute(c, channel) ? channel : std::nullopt;
  return violation_at(place_at(picture, at), class_of(actual, expected), value_text(expected), note,
                      {kind_of_channel(c, channel), attribute, actual});
}

Check compare_pictures(const cases::Case& c, const cases::Picture& expected,
                       const cases::Picture& drawn, const std::string& note) {
  Check check;
  std::uint64_t correct = 0;
  const auto compare = [&](std::size_t at, std::optional<std::uint32_t> channel, float before,
                           float now) {
    if (is_same(before, now)) {
      ++correct;
      return;
    }
    add_violation(check, picture_violation(c, drawn, at, channel, before, note));
  };
  for (std::size_t at = 0; at < expected.depth.size(); ++at) {
    compare(at, std::nullopt, expected.depth[at], drawn.depth[at]);
    for (std::uint32_t channel = 0; channel < expected.channels; ++channel) {
      const std::size_t index = at * expected.channels + channel;
      compare(at, channel, expected.color[index], drawn.color[index]);
    }
  }
  check.judgement.errors[AttributeKind::depth].classes[records::FragmentClass::correct] += correct;
  return check;
}

}  // namespace rastercheck::properties
