#pragma once

// A part of one drawn triangle looked at sample by sample: what reports show of a counterexample or
// of a worst case, as plain data.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/case.h"
#include "records/enclosure.h"
#include "records/judgement.h"
#include "records/stage_split.h"
#include "records/verdict.h"

namespace rastercheck::records {

/// A point of the window, pixels.
struct WindowPoint {
  double x = 0;
  double y = 0;
  bool operator==(const WindowPoint&) const = default;
};

/// Depth or an attribute of one sample.
struct InspectedValue {
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; nothing for depth
  /// Of the exact triangle: a fraction in lowest terms, or "[fraction, fraction]"; digits in the
  /// middle of one of more than 200 are left out ("…"). Empty where undefined.
  std::string exact;
  std::optional<double> nearest;         ///< the double nearest to it; of a range its middle
  std::optional<float> actual;           ///< nothing: not drawn; may be no number
  std::optional<Enclosure> scale_error;  ///< signed, scale ULP, against `exact`
  std::optional<Enclosure> local_error;  ///< signed, local ULP
  std::optional<Enclosure> excess;       ///< signed, scale ULP beyond what the contract leaves open
  std::optional<Enclosure> kappa;        ///< how relative errors of the weights are amplified
  std::optional<Enclosure> kappa_d;      ///< how much cancellation the weights went through
  bool operator==(const InspectedValue&) const = default;
};

struct InspectedSample {
  cases::SamplePlace place = {};
  Verdict verdict = Verdict::forbidden;
  Reason reason = Reason::outside;
  bool is_drawn = false;
  std::optional<Enclosure> distance;              ///< to the boundary that decided, pixels
  std::optional<std::array<Enclosure, 3>> edges;  ///< e_i (RULES §1); nothing where det M = 0
  /// Depth first, then the attributes; none where the sample is forbidden and not drawn.
  std::vector<InspectedValue> values;
  bool operator==(const InspectedSample&) const = default;
};

/// Why it is looked at.
enum class Occasion {
  counterexample,  ///< the run's counterexample of that index
  worst,           ///< the largest error of a law, backend, kind and stratum
  asked_for,       ///< by somebody, of no run
};
constexpr auto names_of(Occasion /*type*/) {
  return std::to_array<std::string_view>({"counterexample", "worst", "asked for"});
}
constexpr std::string_view to_string(Occasion occasion) { return cases::name_of(occasion); }

struct Inspection {
  Occasion occasion = Occasion::counterexample;
  std::string law;
  std::string backend;
  std::uint64_t counterexample = 0;   ///< index into Run::counterexamples; of a worst case 0
  std::optional<AttributeKind> kind;  ///< of a worst case
  std::optional<Stratum> stratum;     ///< of a worst case
  /// Without a camera where it had one: as it was drawn.
  cases::Case source;
  std::vector<WindowPoint> pattern;  ///< [sample], from the pixel's corner of smallest x and y
  /// What was looked for: the first violation's sample, or the worst error's. `attribute` is
  /// nothing for depth and where a sample was missing or extra.
  cases::SamplePlace place = {};
  std::optional<std::uint32_t> attribute;
  /// Rows of the triangle's Q (RULES §1): fractions, long ones elided; nothing where det M = 0.
  std::optional<std::array<std::array<std::string, 3>, 3>> q_matrix;
  /// [triangle of the case]: its outline in the window as far as it is in front of the eye, pixels.
  std::vector<std::vector<WindowPoint>> outlines;
  /// The part of the framebuffer: first pixel and size, at most 32 by 32.
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// All of its samples, of `place.triangle` only, ordered by y, x, sample.
  std::vector<InspectedSample> samples;
  /// Of the sample that was looked for: of each value that it has.
  std::vector<ErrorSplit> splits;
  /// Of a sample that is missing or extra: the first stage whose exact continuation says otherwise
  /// than the rules do; nothing where the backend does not tell.
  std::optional<Stage> coverage_stage;
  bool operator==(const Inspection&) const = default;
};

/// The sample that was looked for; nullptr where it is not among those inspected.
const InspectedSample* inspected_sample(const Inspection& inspection);

/// At most so many in a run, counterexamples first.
inline constexpr std::size_t kMostInspections = 40;
/// Pixels along either side.
inline constexpr std::uint32_t kMostInspected = 32;

}  // namespace rastercheck::records
