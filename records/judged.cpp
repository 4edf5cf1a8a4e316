#include "records/judged.h"

#include <fmt/format.h>

#include <numeric>

namespace rastercheck::records {
namespace {

/// Formats a count with commas between thousands.
std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

}  // namespace

std::uint64_t Judged::all_not_judged() const {
  std::uint64_t all = 0;
  for (const auto& [why, count] : not_judged) all += count;
  return all;
}

double Judged::share_not_judged() const {
  const auto left = static_cast<double>(all_not_judged());
  const double all = static_cast<double>(fragments + values) + left;
  return all > 0 ? left / all : 0;
}

void merge(Judged& into, const Judged& from) {
  into.asked += from.asked;
  into.applicable += from.applicable;
  into.fragments += from.fragments;
  into.values += from.values;
  for (const auto& [why, count] : from.not_judged) into.not_judged[why] += count;
}

void add(Judged& judged, AttributeKind kind, const ErrorStatistics& errors) {
  const auto& classes = errors.classes.counts;
  const std::uint64_t all = std::accumulate(classes.begin(), classes.end(), std::uint64_t{0});
  if (kind != AttributeKind::coverage) {
    judged.values += all;
    for (const auto& [why, count] : errors.not_judged) {
      judged.not_judged[std::string(to_string(why))] += count;
    }
    return;
  }
  // The classes also count fragments that are not judged, so these are subtracted.
  judged.fragments += all;
  for (const auto& [why, count] : errors.not_judged) {
    judged.fragments -= count;
    judged.not_judged[std::string(to_string(why))] += count;
  }
}

std::string not_judged_words(const Judged& judged) {
  std::string words;
  for (const auto& [why, count] : judged.not_judged) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", grouped(count), why);
  }
  return words;
}

}  // namespace rastercheck::records
