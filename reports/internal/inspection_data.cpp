#include "reports/internal/inspection_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "cases/float_text.h"
#include "cases/names.h"
#include "reports/internal/embedded_json.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using nlohmann::json;
using records::Enclosure;
using records::InspectedSample;
using records::InspectedValue;
using records::Inspection;

constexpr int kDataDigits = 6;  ///< significant digits of enclosed numbers
constexpr std::size_t kAllDigits = std::numeric_limits<std::size_t>::max();

/// How much of an inspection is kept.
struct DataExtent {
  std::size_t most_digits;  ///< for each whole number
  std::uint32_t reach;      ///< pixels around the inspected sample
};
/// Tried in this order until the data fits.
constexpr std::array<DataExtent, 5> kExtents{
    {{kAllDigits, records::kMostInspected}, {60, 32}, {30, 32}, {16, 32}, {16, 8}}};

json certain(const std::optional<Enclosure>& number) {
  return number ? json(records::to_decimal(*number, kDataDigits)) : json();
}

/// Shortens each whole number of one or two fractions that has more than `most_digits` digits, by
/// replacing its middle with "…".
std::string shortened(std::string_view fraction, std::size_t most_digits) {
  std::string text;
  for (std::size_t at = 0; at < fraction.size();) {
    const std::size_t end = std::min(fraction.find_first_not_of("0123456789", at), fraction.size());
    if (end == at) {
      text += fraction[at++];
      continue;
    }
    text += elided(fraction.substr(at, end - at), most_digits);
    at = end;
  }
  return text;
}

json points(const std::vector<records::WindowPoint>& all) {
  json array = json::array();
  for (const records::WindowPoint& point : all) array.push_back({point.x, point.y});
  return array;
}

/// Adds with outward rounding: a rounded sum is off by less than the step to its neighbours.
Enclosure sum_of_two(const Enclosure& a, const Enclosure& b) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto end = [](double x, double y, double towards) {
    return x == 0 || y == 0 ? x + y : std::nextafter(x + y, towards);
  };
  return {end(a.lo, b.lo, -kInfinity), end(a.hi, b.hi, kInfinity)};
}

json value_data(const InspectedValue& value, std::size_t most_digits) {
  json data = json::array();
  data.push_back(value.attribute ? static_cast<int>(*value.attribute) : -1);
  data.push_back(value.exact.empty() ? json() : json(shortened(value.exact, most_digits)));
  data.push_back(value.nearest ? json(*value.nearest) : json());
  data.push_back(value.actual ? json(cases::to_hex(*value.actual)) : json());
  for (const auto& number :
       {value.scale_error, value.local_error, value.excess, value.kappa, value.kappa_d}) {
    data.push_back(certain(number));
  }
  return data;
}

json sample_data(const InspectedSample& sample, const Inspection& of, std::size_t most_digits) {
  const bool is_looked_for = sample.place.x == of.place.x && sample.place.y == of.place.y &&
                             sample.place.sample == of.place.sample;
  if (is_looked_for) most_digits = kAllDigits;
  json data{sample.place.x - of.left,  sample.place.y - of.top,  sample.place.sample,
            to_string(sample.verdict), to_string(sample.reason), sample.is_drawn ? 1 : 0,
            certain(sample.distance)};
  json edges;
  if (sample.edges) {
    Enclosure sum;
    for (const Enclosure& edge : *sample.edges) {
      edges.push_back(certain(edge));
      sum = sum_of_two(sum, edge);
    }
    edges.push_back(certain(sum));
  }
  data.push_back(std::move(edges));
  json values = json::array();
  for (const InspectedValue& value : sample.values) {
    values.push_back(value_data(value, most_digits));
  }
  data.push_back(std::move(values));
  return data;
}

json inspection_json(const Inspection& inspection, std::size_t most_digits) {
  json attributes = json::array();
  for (const cases::Attribute& attribute : inspection.source.attributes) {
    attributes.push_back({attribute.name, cases::name_of(attribute.interpolation)});
  }
  json outlines = json::array();
  for (const auto& outline : inspection.outlines) outlines.push_back(points(outline));
  json samples = json::array();
  for (const InspectedSample& sample : inspection.samples) {
    samples.push_back(sample_data(sample, inspection, most_digits));
  }
  // For a sample that was inspected for its coverage, the value is neither an attribute nor depth.
  const bool is_of_value = !inspection.splits.empty();
  json value;
  if (inspection.attribute) {
    value = *inspection.attribute;
  } else if (is_of_value) {
    value = -1;
  }
  return {{"rules", cases::name_of(inspection.source.rules)},
          {"attributes", std::move(attributes)},
          {"pattern", points(inspection.pattern)},
          {"triangle", inspection.place.triangle},
          {"x", inspection.place.x},
          {"y", inspection.place.y},
          {"sample", inspection.place.sample},
          {"value", std::move(value)},
          {"q", inspection.q_matrix ? json(*inspection.q_matrix) : json()},
          {"outlines", std::move(outlines)},
          {"left", inspection.left},
          {"top", inspection.top},
          {"width", inspection.width},
          {"height", inspection.height},
          {"shortened", most_digits != kAllDigits},
          {"samples", std::move(samples)}};
}

/// Intersects the `size` pixels from `first` on with those within `reach` of `place`; returns first
/// and size of the result.
std::pair<std::uint32_t, std::uint32_t> around(std::uint32_t first, std::uint32_t size,
                                               std::uint32_t place, std::uint32_t reach) {
  if (size == 0) return {first, size};
  place = std::clamp(place, first, first + size - 1);
  const std::uint32_t from = std::max(first, place - std::min(place, reach));
  return {from, std::min(first + size, place + reach + 1) - from};
}

/// The part of an inspection that is near the inspected sample.
Inspection within(const Inspection& whole, std::uint32_t reach) {
  Inspection part = whole;
  std::tie(part.left, part.width) = around(whole.left, whole.width, whole.place.x, reach);
  std::tie(part.top, part.height) = around(whole.top, whole.height, whole.place.y, reach);
  std::erase_if(part.samples, [&part](const InspectedSample& sample) {
    return sample.place.x < part.left || sample.place.x - part.left >= part.width ||
           sample.place.y < part.top || sample.place.y - part.top >= part.height;
  });
  return part;
}

}  // namespace

std::vector<std::string> inspection_data(const std::vector<Inspection>& inspections,
                                         std::size_t most) {
  std::vector<std::string> data;
  for (const DataExtent& extent : kExtents) {
    data.clear();
    std::size_t bytes = 0;
    for (const Inspection& inspection : inspections) {
      const json part = inspection_json(within(inspection, extent.reach), extent.most_digits);
      data.push_back(embedded_json(part));
      bytes += data.back().size();
      if (bytes > most) break;
    }
    if (bytes <= most) break;
  }
  // Inspections that are still too large get empty texts.
  data.resize(inspections.size());
  return data;
}

}  // namespace rastercheck::reports
