#include "gate/policy.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "cases/files.h"
#include "cases/json_members.h"

namespace rastercheck::gate {
namespace {

/// Returns the digits in [first, last) as a number; empty if another character occurs.
std::optional<int> number_in(std::string_view text, std::size_t first, std::size_t last) {
  int number = 0;
  const char* const end = text.data() + last;
  const auto [stop, error] = std::from_chars(text.data() + first, end, number);
  const bool is_signed = text[first] == '-';
  return error == std::errc() && stop == end && !is_signed ? std::optional(number) : std::nullopt;
}

/// True if the text is an existing day in the form "2026-12-31".
bool is_day(std::string_view text) {
  constexpr std::string_view kShape = "yyyy-mm-dd";
  if (text.size() != kShape.size() || text[4] != '-' || text[7] != '-') return false;
  const auto year = number_in(text, 0, 4);
  const auto month = number_in(text, 5, 7);
  const auto day = number_in(text, 8, 10);
  return year && month && day &&
         std::chrono::year_month_day(std::chrono::year(*year),
                                     std::chrono::month(static_cast<unsigned>(*month)),
                                     std::chrono::day(static_cast<unsigned>(*day)))
             .ok();
}

bool matches(const std::string& pattern, std::string_view text) {
  return ::fnmatch(pattern.c_str(), std::string(text).c_str(), 0) == 0;
}

bool matches(const Allowance& allowance, const records::Comparison& comparison) {
  return matches(records::section_name(allowance.backend), comparison.key.backend);
}

/// True if the entry is worse only in error sizes, not in mismatches or non-finite numbers, and its
/// largest error is within the limit `worst`.
bool is_within(double worst, const records::EntryChange& entry) {
  const bool is_size = std::all_of(
      entry.figures.begin(), entry.figures.end(), [](const records::FigureChange& change) {
        return change.change != records::Change::worse || change.figure >= records::Figure::worst;
      });
  return is_size && entry.key.kind != records::AttributeKind::coverage &&
         entry.after.worst.hi <= worst &&
         entry.after.histogram.non_finite() <= entry.before.histogram.non_finite();
}

bool allows(const Allowance& allowance, const records::Comparison& comparison,
            const records::EntryChange& entry) {
  const std::string_view stratum = entry.key.stratum ? to_string(*entry.key.stratum) : "all";
  return matches(allowance, comparison) && matches(allowance.law, entry.key.law) &&
         matches(allowance.kind, to_string(entry.key.kind)) &&
         matches(allowance.stratum, stratum) &&
         (!allowance.worst || is_within(*allowance.worst, entry));
}

std::string described(const Policy& policy, std::size_t index) {
  const Allowance& allowance = policy.allow[index];
  return fmt::format("{}: /allow/{} (property '{}', backend '{}', {}, {}: {})", policy.file, index,
                     allowance.law, allowance.backend, allowance.kind, allowance.stratum,
                     allowance.reason);
}

/// Marks the worse entries that the allowance covers; returns true if there are any.
bool apply(const Allowance& allowance, std::vector<records::Comparison>& comparisons) {
  bool is_used = false;
  for (records::Comparison& comparison : comparisons) {
    for (records::EntryChange& entry : comparison.entries) {
      if (entry.change != records::Change::worse || !allows(allowance, comparison, entry)) continue;
      is_used = true;
      if (!entry.allowed_because) {
        entry.allowed_because = fmt::format("{} (until {})", allowance.reason, allowance.until);
      }
    }
  }
  return is_used;
}

}  // namespace

template <typename Archive, cases::Either<Allowance> T>
void members(Archive& archive, T& allowance) {
  archive.optional("property", allowance.law, "*");
  archive.optional("backend", allowance.backend, "*");
  archive.optional("kind", allowance.kind, "*");
  archive.optional("stratum", allowance.stratum, "*");
  archive.required("reason", allowance.reason);
  archive.required("until", allowance.until);
  archive.optional("worst", allowance.worst);
  archive.check([&](const cases::JsonNode& node) {
    if (allowance.reason.find_first_not_of(" \t\r\n") == std::string::npos) {
      node["reason"].refuse("must not be empty");
    }
    if (!is_day(allowance.until)) node["until"].refuse("must be a date such as \"2026-12-31\"");
    if (allowance.worst && !(*allowance.worst >= 0)) node["worst"].refuse("must not be negative");
  });
}

template <typename Archive, cases::Either<Policy> T>
void members(Archive& archive, T& policy) {
  archive.format("rastercheck-policy", kPolicyVersion);
  archive.required("allow", policy.allow);
}

records::PolicyReview apply(const Policy& policy, const Day& today,
                            std::vector<records::Comparison>& comparisons) {
  records::PolicyReview review;
  for (std::size_t i = 0; i < policy.allow.size(); ++i) {
    const Allowance& allowance = policy.allow[i];
    // Allowances for other backends are not reviewed here.
    const bool is_asked = std::any_of(
        comparisons.begin(), comparisons.end(),
        [&](const records::Comparison& comparison) { return matches(allowance, comparison); });
    if (!is_asked) continue;
    if (allowance.until < today) {
      review.expired.push_back(
          fmt::format("{} allowed until {}", described(policy, i), allowance.until));
    } else if (!apply(allowance, comparisons)) {
      review.unused.push_back(described(policy, i));
    }
  }
  return review;
}

Result<Policy> parse_policy(std::string_view text, const std::string& file) {
  return cases::read_json(text, file, &cases::read_as<Policy>).map([&file](Policy policy) {
    policy.file = file;
    return policy;
  });
}

Result<Policy> read_policy(const std::string& file) {
  return cases::read_text(file).and_then(
      [&file](const std::string& text) { return parse_policy(text, file); });
}

}  // namespace rastercheck::gate
