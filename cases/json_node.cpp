#include "cases/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/float_text.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

using nlohmann::json;

constexpr std::string_view kInfinityText = "inf";
constexpr std::string_view kMinusInfinityText = "-inf";
/// Doubles hold every integer up to this magnitude exactly.
constexpr double kExactIntegers = 0x1p53;

/// True if the value is an integer, or a float with an integral value.
bool is_integral(const json& value) {
  if (value.is_number_float()) return value.get<double>() == std::floor(value.get<double>());
  return value.is_number_integer();
}

/// The integer that a value holds; empty if the value is not integral, is too large to be known
/// exactly, or does not fit the type.
template <typename Integer>
std::optional<Integer> exact_integer(const json& value) {
  const auto if_it_fits = [](auto number) {
    return std::in_range<Integer>(number) ? std::optional(static_cast<Integer>(number))
                                          : std::nullopt;
  };
  if (!is_integral(value)) return std::nullopt;
  if (value.is_number_unsigned()) return if_it_fits(value.get<std::uint64_t>());
  if (value.is_number_integer()) return if_it_fits(value.get<std::int64_t>());
  if (std::abs(value.get<double>()) > kExactIntegers) return std::nullopt;
  return if_it_fits(static_cast<std::int64_t>(value.get<double>()));
}

}  // namespace

void JsonNode::refuse(std::string reason) const {
  if (failed()) return;
  const std::string place = pointer();
  reading_->error = Error{reading_->file, place.empty() ? "/" : place, std::move(reason)};
}

std::string JsonNode::pointer() const {
  return missing_.empty() ? pointer_in(reading_->document, *value_) : missing_;
}

void JsonNode::expect_object(Keys required, Keys optional) const {
  if (!value_->is_object()) return refuse("must be an object");
  for (const auto& member : value_->items()) {
    const std::string& key = member.key();
    const auto is_key = [&key](std::string_view known) { return known == key; };
    if (std::none_of(required.begin(), required.end(), is_key) &&
        std::none_of(optional.begin(), optional.end(), is_key)) {
      return (*this)[key].refuse(fmt::format("unknown key '{}'", printable(key)));
    }
  }
  for (const std::string_view key : required) {
    if (!has(key)) refuse(fmt::format("missing key '{}'", key));
  }
}

void JsonNode::expect_format(std::string_view format) const {
  if (!has("format")) return;
  const JsonNode node = (*this)["format"];
  const std::string actual = node.text();
  if (actual != format) {
    node.refuse(fmt::format("must be \"{}\", not \"{}\"", format, printable(actual)));
  }
}

bool JsonNode::has(std::string_view key) const {
  return value_->is_object() && value_->contains(key);
}

JsonNode JsonNode::operator[](std::string_view key) const {
  if (value_->is_object()) {
    if (const auto member = value_->find(key); member != value_->end()) return child(*member);
  }
  static const json kMissing;
  JsonNode node = child(kMissing);
  // After the first error nobody asks where a value is.
  node.missing_ = failed() ? "/" : child_pointer(pointer(), key);
  return node;
}

JsonNode JsonNode::child(const json& inner) const {
  JsonNode node = *this;
  node.value_ = &inner;
  return node;
}

JsonNode JsonNode::with(DecimalRounding& rounding) const {
  JsonNode node = *this;
  node.rounding_ = &rounding;
  return node;
}

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> keys;
  if (!value_->is_object()) {
    refuse("must be an object");
    return keys;
  }
  for (const auto& member : value_->items()) keys.push_back(member.key());
  return keys;
}

std::vector<JsonNode> JsonNode::elements() const {
  std::vector<JsonNode> nodes;
  if (!value_->is_array()) {
    refuse("must be an array");
    return nodes;
  }
  nodes.reserve(value_->size());
  for (const json& inner : *value_) nodes.push_back(child(inner));
  return nodes;
}

std::vector<JsonNode> JsonNode::elements(std::size_t least, std::size_t most,
                                         std::string_view what) const {
  std::vector<JsonNode> nodes = elements();
  if (!failed() && (nodes.size() < least || nodes.size() > most)) {
    refuse(least == most
               ? fmt::format("must have {} {}, not {}", least, what, nodes.size())
               : fmt::format("must have {} to {} {}, not {}", least, most, what, nodes.size()));
    nodes.clear();
  }
  return nodes;
}

std::pair<JsonNode, JsonNode> JsonNode::two_elements(std::string_view what) const {
  if (value_->is_array() && value_->size() == 2) return {child((*value_)[0]), child((*value_)[1])};
  refuse(fmt::format("must be an array of two: {}", what));
  return {*this, *this};
}

bool JsonNode::is_string() const { return value_->is_string(); }

std::string JsonNode::text() const {
  if (value_->is_string()) return value_->get<std::string>();
  refuse("must be a string");
  return {};
}

bool JsonNode::boolean() const {
  if (value_->is_boolean()) return value_->get<bool>();
  refuse("must be true or false");
  return false;
}

std::size_t JsonNode::index_in(std::span<const std::string_view> names) const {
  const std::string chosen = text();
  const auto found = std::find(names.begin(), names.end(), chosen);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::size_t before_last = names.size() - 1;
  refuse(fmt::format("must be {} or {}", fmt::join(names.first(before_last), ", "), names.back()));
  return 0;
}

std::int64_t JsonNode::integer(std::int64_t least, std::int64_t most) const {
  if (!is_integral(*value_)) {
    refuse("must be an integer");
    return least;
  }
  const std::optional<std::int64_t> number = exact_integer<std::int64_t>(*value_);
  if (!number || *number < least || *number > most) {
    refuse(fmt::format("out of range: must be an integer from {} to {}", least, most));
    return least;
  }
  return *number;
}

std::uint64_t JsonNode::unsigned_integer() const {
  const std::optional<std::uint64_t> number = exact_integer<std::uint64_t>(*value_);
  if (!number) {
    refuse(fmt::format("out of range: must be an integer from 0 to {}",
                       std::numeric_limits<std::uint64_t>::max()));
  }
  return number.value_or(0);
}

std::uint64_t JsonNode::count_up_to(std::uint64_t most) const {
  // A number set by code rather than parsed may have a signed type.
  if (value_->is_number_unsigned() ||
      (value_->is_number_integer() && value_->get<std::int64_t>() >= 0)) {
    const auto value = value_->get<std::uint64_t>();
    if (value <= most) return value;
  }
  refuse(fmt::format("must be an integer from 0 to {}", most));
  return 0;
}

std::map<std::string, std::uint64_t> JsonNode::counts_by_name() const {
  std::map<std::string, std::uint64_t> counts;
  for (const std::string& key : keys()) counts[key] = (*this)[key].count();
  return counts;
}

float JsonNode::float32() const {
  if (value_->is_string()) {
    const auto text = value_->get<std::string>();
    if (!is_hex_float(text)) {
      refuse(fmt::format("must be a number or a hex float such as \"0x1.8p-2\", not \"{}\"",
                         printable(text)));
      return 0;
    }
    const std::optional<float> value = float_from_hex(text);
    if (!value) refuse(fmt::format("not exactly a float32: {}", printable(text)));
    return value.value_or(0.0F);
  }
  if (!value_->is_number()) {
    refuse("must be a number or a hex-float string");
    return 0;
  }
  const auto value = value_->get<double>();
  const std::optional<float> exact = exact_float(value);
  return exact ? *exact : rounded_float32(value);
}

float JsonNode::rounded_float32(double value) const {
  const auto nearest = static_cast<float>(value);
  if (!std::isfinite(nearest)) {
    refuse(fmt::format("not exactly a float32: {}", value_->dump()));
    return 0;
  }
  if (rounding_ == nullptr || !rounding_->is_allowed) {
    refuse(fmt::format("not exactly a float32: {}; the nearest is \"{}\"{}", value_->dump(),
                       to_hex(nearest),
                       rounding_ == nullptr ? "" : ", which \"round\": true would take"));
    return 0;
  }
  // The document's decimals are doubles already. That double may lie halfway between two float32
  // where the decimal did not, and then nobody knows which of the two was nearer.
  const float other =
      std::nextafter(nearest, value > double{nearest} ? std::numeric_limits<float>::infinity()
                                                      : -std::numeric_limits<float>::infinity());
  if (std::fabs(value - double{nearest}) == std::fabs(double{other} - value)) {
    refuse(fmt::format("as near to \"{}\" as to \"{}\": {}; write one of these", to_hex(nearest),
                       to_hex(other), value_->dump()));
    return 0;
  }
  ++rounding_->rounded;
  return nearest;
}

float JsonNode::float32(float least, float most) const {
  const float value = float32();
  if (failed() || (value >= least && value <= most)) return value;
  refuse(fmt::format("out of range: must be from {} to {}", least, most));
  return least;
}

float JsonNode::hex_float32() const {
  const std::optional<float> value = float_from_hex(text());
  if (!value) refuse("must be the hex float of a float32, such as \"0x1.8p-2\"");
  return value.value_or(0.0F);
}

double JsonNode::float64() const {
  if (*value_ == kInfinityText) return std::numeric_limits<double>::infinity();
  if (*value_ == kMinusInfinityText) return -std::numeric_limits<double>::infinity();
  if (value_->is_number_float()) return value_->get<double>();
  if (value_->is_number_integer()) {
    const auto value = value_->get<double>();
    if (std::abs(value) < kExactIntegers) return value;
    refuse("not exactly a double: write it with a decimal point or an exponent");
    return 0;
  }
  refuse("must be a number, \"inf\" or \"-inf\"");
  return 0;
}

Result<void> visit_json(std::string_view text, const std::string& file,
                        const std::function<void(const JsonNode& root)>& read,
                        JsonNode::Keys left_out) {
  const Result<json> document = parse_json(text, file, left_out);
  if (!document) return tl::unexpected(document.error());
  JsonNode::Reading reading{*document, file};
  read(JsonNode(reading));
  if (reading.error) return tl::unexpected(*reading.error);
  return {};
}

json float64_to_json(double value) {
  if (std::isinf(value)) return value > 0 ? kInfinityText : kMinusInfinityText;
  return value;
}

}  // namespace rastercheck::cases
