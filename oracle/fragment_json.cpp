#include "oracle/fragment_json.h"

#include <fmt/format.h>

#include <cmath>

namespace rastercheck::oracle {
namespace {

std::string to_json(const std::optional<Rational>& value) {
  return value ? fmt::format("\"{}\"", value->to_string()) : "null";
}

/// An infinite end becomes null, as JSON has no infinities.
std::string to_json(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string to_json(const std::optional<records::Enclosure>& enclosure) {
  if (!enclosure) return "null";
  return fmt::format("[{}, {}]", to_json(enclosure->lo), to_json(enclosure->hi));
}

std::string to_json(const std::optional<Derivatives>& derivatives) {
  if (!derivatives) return "null";
  return fmt::format(R"(["{}", "{}"])", derivatives->du.to_string(), derivatives->dv.to_string());
}

/// Formats the members of a fragment's JSON object, without the braces.
std::string members(const Fragment& f) {
  std::vector<std::string> attributes;
  attributes.reserve(f.attributes.size());
  for (const auto& value : f.attributes) attributes.push_back(oracle::to_json(value));
  return fmt::format(
      R"("triangle": {}, "x": {}, "y": {}, "sample": {}, "verdict": "{}", "reason": "{}", )"
      R"("depth": {}, "attributes": [{}])",
      f.place.triangle, f.place.x, f.place.y, f.place.sample,
      records::to_string(f.decision.verdict), records::to_string(f.decision.reason),
      oracle::to_json(f.depth), fmt::join(attributes, ", "));
}

}  // namespace

std::string to_json(const std::optional<ValueRange>& value) {
  if (!value) return "null";
  if (!value->is_open) return fmt::format("\"{}\"", value->lo.to_string());
  return fmt::format(R"(["{}", "{}"])", value->lo.to_string(), value->hi.to_string());
}

std::string to_json(const Fragment& fragment) { return fmt::format("{{{}}}", members(fragment)); }

std::string to_detailed_json(const Fragment& f, const TriangleTruth& truth) {
  const auto x = static_cast<int>(f.place.x);
  const auto y = static_cast<int>(f.place.y);
  const auto sample = static_cast<int>(f.place.sample);
  std::vector<std::string> derivatives;
  std::vector<std::string> kappa;
  std::vector<std::string> kappa_d;
  for (std::size_t a = 0; a < f.attributes.size(); ++a) {
    derivatives.push_back(to_json(truth.derivatives(a, x, y, sample)));
    const Conditioning known = truth.conditioning(a, x, y, sample).value_or(Conditioning{{}, {}});
    kappa.push_back(to_json(known.kappa));
    kappa_d.push_back(to_json(known.kappa_d));
  }
  return fmt::format(
      R"({{{}, "distance": {}, "derivatives": [{}], "kappa": [{}], "kappa_d": [{}]}})", members(f),
      to_json(truth.distance(x, y, sample)), fmt::join(derivatives, ", "), fmt::join(kappa, ", "),
      fmt::join(kappa_d, ", "));
}

}  // namespace rastercheck::oracle
