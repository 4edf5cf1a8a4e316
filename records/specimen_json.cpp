#include "records/specimen_json.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "records/inspection.h"
#include "records/internal/shared_members.h"

namespace rastercheck::records {
namespace {

using cases::JsonNode;
using cases::UpTo;

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

/// Parses eight lower-case hexadecimal digits; empty for any other text.
std::optional<std::uint32_t> bits_of(const std::string& text) {
  std::uint32_t bits = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, bits, kFloatBase);
  const bool is_read = text.size() == kFloatDigits && error == std::errc() && stop == end;
  return is_read && fmt::format("{:08x}", bits) == text ? std::optional(bits) : std::nullopt;
}

/// Appends a sample; returns false if the text is not that of a sample.
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
  node.refuse(fmt::format(
      "must be {} samples, each \"-\" or {} groups of eight hexadecimal digits separated by colons",
      samples, specimen.values_per_sample()));
}

/// The rows of a specimen. When reading, the specimen must already have all other members.
template <typename T>
struct CropRows {
  T& specimen;

  friend void write_value(nlohmann::json& to, const CropRows& rows) {
    to = nlohmann::json::array();
    for (std::size_t row = 0; row < rows.specimen.height; ++row) {
      to.push_back(row_text(rows.specimen, row));
    }
  }
  friend void read_value(const JsonNode& node, CropRows& rows) {
    const std::size_t height = rows.specimen.height;
    for (const JsonNode& row : node.elements(height, height, "rows")) {
      if (node.failed()) return;
      read_row(row, rows.specimen);
    }
  }
};
template <typename T>
CropRows(T&) -> CropRows<T>;

}  // namespace

template <typename Archive, cases::Either<Specimen> T>
void members(Archive& archive, T& specimen) {
  constexpr std::uint32_t kMostPixel = cases::kMaxSize - 1;
  members(archive, specimen.key);
  archive.optional("name", specimen.case_name);
  archive.required("triangle", specimen.triangle);
  archive.required("left", UpTo{specimen.left, kMostPixel});
  archive.required("top", UpTo{specimen.top, kMostPixel});
  archive.required("width", UpTo{specimen.width, kMostInspected});
  archive.required("height", UpTo{specimen.height, kMostInspected});
  archive.required("samples", UpTo{specimen.samples, kMostCropSamples});
  archive.required("attributes", UpTo{specimen.attributes, cases::kMaxAttributes});
  archive.check([&](const JsonNode& node) {
    if (specimen.sample_count() == 0) node.refuse("must have a sample");
  });
  archive.required("rows", CropRows{specimen});
}

void write_value(nlohmann::json& to, const Specimen& specimen) {
  cases::write_members(to, specimen);
}
void read_value(const JsonNode& node, Specimen& specimen) { cases::read_members(node, specimen); }

}  // namespace rastercheck::records
