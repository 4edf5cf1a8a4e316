#include "records/specimen_json.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "records/inspection.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using nlohmann::json;

constexpr std::string_view kUndrawn = "-";
constexpr std::size_t kFloatDigits = 8;
constexpr int kFloatBase = 16;
constexpr std::uint32_t kMostCropSamples = 16;

std::string sample_text(const Specimen& specimen, std::size_t at) {
  if (!specimen.drawn[at]) return std::string(kUndrawn);
  std::string text;
  const std::size_t values = specimen.values_per_sample();
  for (std::size_t value = 0; value < values; ++value) {
    text += fmt::format("{}{:08x}", value == 0 ? "" : ":", specimen.bits[at * values + value]);
  }
  return text;
}

std::string row_text(const Specimen& specimen, std::size_t row) {
  const std::size_t samples = std::size_t{specimen.width} * specimen.samples;
  std::string text;
  for (std::size_t i = 0; i < samples; ++i) {
    text += (i == 0 ? "" : " ") + sample_text(specimen, row * samples + i);
  }
  return text;
}

/// Takes the text up to the next separator, or all of it.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return taken;
}

/// Eight lower-case digits; nothing of another text.
std::optional<std::uint32_t> bits_of(const std::string& text) {
  std::uint32_t bits = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, bits, kFloatBase);
  const bool is_read = text.size() == kFloatDigits && error == std::errc() && stop == end;
  return is_read && fmt::format("{:08x}", bits) == text ? std::optional(bits) : std::nullopt;
}

/// Appends a sample; false where its text is none.
bool read_crop_sample(std::string_view text, Specimen& specimen) {
  const std::size_t values = specimen.values_per_sample();
  specimen.drawn.push_back(text != kUndrawn);
  if (text == kUndrawn) {
    specimen.bits.insert(specimen.bits.end(), values, 0);
    return true;
  }
  if (text.size() != values * (kFloatDigits + 1) - 1) return false;
  for (std::size_t value = 0; value < values; ++value) {
    const std::optional<std::uint32_t> bits = bits_of(std::string(take(text, ':')));
    if (!bits) return false;
    specimen.bits.push_back(*bits);
  }
  return true;
}

void read_row(const JsonNode& node, Specimen& specimen) {
  const std::string row = node.text();
  const std::size_t samples = std::size_t{specimen.width} * specimen.samples;
  std::string_view rest = row;
  bool is_row = !row.ends_with(' ');
  for (std::size_t i = 0; is_row && i < samples; ++i) {
    is_row = read_crop_sample(take(rest, ' '), specimen);
  }
  if (is_row && rest.empty()) return;
  node.refuse(
      fmt::format("must be {} samples, each \"-\" or {} times eight hexadecimal digits with "
                  "colons between them",
                  samples, specimen.values_per_sample()));
}

}  // namespace

json specimen_to_json(const Specimen& specimen) {
  json rows = json::array();
  for (std::size_t row = 0; row < specimen.height; ++row) {
    rows.push_back(row_text(specimen, row));
  }
  json object{{"law", specimen.key.law},
              {"backend", specimen.key.backend},
              {"origin", to_string(specimen.key.origin)},
              {"index", specimen.key.index},
              {"triangle", specimen.triangle},
              {"left", specimen.left},
              {"top", specimen.top},
              {"width", specimen.width},
              {"height", specimen.height},
              {"samples", specimen.samples},
              {"attributes", specimen.attributes},
              {"rows", std::move(rows)}};
  if (!specimen.case_name.empty()) object["name"] = specimen.case_name;
  return object;
}

Specimen specimen_from_json(const JsonNode& node) {
  node.expect_object({"law", "backend", "origin", "index", "triangle", "left", "top", "width",
                      "height", "samples", "attributes", "rows"},
                     {"name"});
  Specimen specimen;
  if (node.failed()) return specimen;
  specimen.key = {node["law"].text(), node["backend"].text(), node["origin"].enumerator<Origin>(),
                  node["index"].count()};
  if (node.has("name")) specimen.case_name = node["name"].text();
  specimen.triangle = node["triangle"].count<std::uint32_t>();
  constexpr std::uint32_t kMostPixel = cases::kMaxSize - 1;
  specimen.left = node["left"].count(kMostPixel);
  specimen.top = node["top"].count(kMostPixel);
  specimen.width = node["width"].count(kMostInspected);
  specimen.height = node["height"].count(kMostInspected);
  specimen.samples = node["samples"].count(kMostCropSamples);
  specimen.attributes = node["attributes"].count(static_cast<std::uint32_t>(cases::kMaxAttributes));
  if (node.failed()) return specimen;
  if (specimen.sample_count() == 0) node.refuse("must have a sample");
  for (const JsonNode& row : node["rows"].elements(specimen.height, specimen.height, "rows")) {
    if (node.failed()) break;
    read_row(row, specimen);
  }
  return specimen;
}

std::vector<Specimen> specimens_from_json(const JsonNode& array) {
  std::vector<Specimen> specimens;
  for (const JsonNode& node : array.elements()) {
    if (node.failed()) break;
    specimens.push_back(specimen_from_json(node));
  }
  return specimens;
}

}  // namespace rastercheck::records
