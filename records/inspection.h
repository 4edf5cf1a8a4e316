#pragma once

// A part of one drawn triangle, inspected sample by sample, as plain data: reports show this for
// counterexamples and worst cases.

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
  std::optional<std::uint32_t> attribute;  ///< index into the case's attributes; empty for depth
  /// Value of the exact triangle: a fraction in lowest terms, or "[fraction, fraction]". Fractions
  /// of more than 200 digits have the middle elided ("…"). Empty if undefined.
  std::string exact;
  std::optional<double> nearest;  ///< the double nearest to `exact`; for a range, to its middle
  std::optional<float> actual;    ///< empty if not drawn; may be NaN or infinite
  std::optional<Enclosure> scale_error;  ///< signed, scale ULP, against `exact`
  std::optional<Enclosure> local_error;  ///< signed, local ULP
  std::optional<Enclosure> excess;       ///< signed, scale ULP beyond what the contract leaves open
  std::optional<Enclosure> kappa;        ///< how much relative errors of the weights are amplified
  std::optional<Enclosure> kappa_d;      ///< how much cancellation the weights went through
  bool operator==(const InspectedValue&) const = default;
};

struct InspectedSample {
  cases::SamplePlace place = {};
  Verdict verdict = Verdict::forbidden;
  Reason reason = Reason::outside;
  bool is_drawn = false;
  std::optional<Enclosure> distance;              ///< distance to the deciding boundary, pixels
  std::optional<std::array<Enclosure, 3>> edges;  ///< e_i (RULES §1); empty if det M = 0
  /// Depth first, then the attributes; empty if the sample is forbidden and not drawn.
  std::vector<InspectedValue> values;
  bool operator==(const InspectedSample&) const = default;
};

/// Reason for an inspection.
enum class Occasion {
  counterexample,  ///< the run's counterexample with the index `counterexample`
  worst,           ///< the largest error of a law, backend, kind and stratum
  asked_for,       ///< asked for by a user, independent of any run
};
constexpr auto names_of(Occasion /*type*/) {
  return std::to_array<std::string_view>({"counterexample", "worst", "asked for"});
}
constexpr std::string_view to_string(Occasion occasion) { return cases::name_of(occasion); }

struct Inspection {
  Occasion occasion = Occasion::counterexample;
  std::string law;
  std::string backend;
  std::uint64_t counterexample = 0;   ///< index into Run::counterexamples; 0 for a worst case
  std::optional<AttributeKind> kind;  ///< only for a worst case
  std::optional<Stratum> stratum;     ///< only for a worst case
  /// The case as drawn: a camera, if any, is already applied.
  cases::Case source;
  std::vector<WindowPoint> pattern;  ///< [sample], from the pixel's corner of smallest x and y
  /// The sample in focus: the first violation's, or the worst error's. `attribute` is empty for
  /// depth, and for a missing or extra sample.
  cases::SamplePlace place = {};
  std::optional<std::uint32_t> attribute;
  /// Rows of the triangle's Q (RULES §1): fractions, long ones elided; empty if det M = 0.
  std::optional<std::array<std::array<std::string, 3>, 3>> q_matrix;
  /// [triangle of the case]: the outline, in window pixels, of the part in front of the eye.
  std::vector<std::vector<WindowPoint>> outlines;
  /// The inspected part of the framebuffer: first pixel and size, at most 32 by 32.
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// All samples of that part, for `place.triangle` only, ordered by y, x, sample.
  std::vector<InspectedSample> samples;
  /// One split per value of the sample in focus.
  std::vector<ErrorSplit> splits;
  /// For a missing or extra sample: the first stage whose output, continued exactly, contradicts
  /// the rules; empty if the backend does not report its stages.
  std::optional<Stage> coverage_stage;
  bool operator==(const Inspection&) const = default;
};

/// The sample in focus; nullptr if not among the inspected samples.
const InspectedSample* inspected_sample(const Inspection& inspection);

/// Maximum number of inspections in a run, counterexamples first.
inline constexpr std::size_t kMostInspections = 40;
/// Maximum width and height of the inspected part, pixels.
inline constexpr std::uint32_t kMostInspected = 32;

}  // namespace rastercheck::records
