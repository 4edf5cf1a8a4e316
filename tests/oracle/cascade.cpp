#include "tests/oracle/cascade.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <tuple>

#include "oracle/self_check.h"
#include "tests/oracle/drawing.h"

namespace rastercheck::oracle {
namespace {

using records::AttributeKind;
using records::Enclosure;
using records::FragmentClass;

bool overlap(const Enclosure& a, const Enclosure& b) { return a.lo <= b.hi && b.lo <= a.hi; }

bool overlap(const std::optional<Enclosure>& a, const std::optional<Enclosure>& b) {
  return a.has_value() == b.has_value() && (!a || overlap(*a, *b));
}

std::string difference(const records::ErrorSizes& a, const records::ErrorSizes& b) {
  if (!(a.histogram == b.histogram)) return "histogram";
  if (!(a.extremes == b.extremes)) return "extremes";
  if (a.sum.count() != b.sum.count() || a.sum.beyond() != b.sum.beyond()) return "terms of the sum";
  if (a.sum.lo() > b.sum.hi() || b.sum.lo() > a.sum.hi()) return "sum";
  return {};
}

std::string difference(const records::ErrorStatistics& a, const records::ErrorStatistics& b) {
  if (!(a.classes == b.classes)) return "classes";
  if (const std::string in = difference(a.excess, b.excess); !in.empty()) return "excess: " + in;
  if (const std::string in = difference(a.ideal, b.ideal); !in.empty()) return "ideal: " + in;
  if (a.strata.size() != b.strata.size()) return "strata";
  for (const auto& [stratum, sizes] : a.strata) {
    const auto other = b.strata.find(stratum);
    if (other == b.strata.end()) return "strata";
    const std::string in = difference(sizes, other->second);
    if (!in.empty()) return std::string(to_string(stratum)) + ": " + in;
  }
  return {};
}

std::string difference(const records::Judgement& a, const records::Judgement& b) {
  if (!(a.counts == b.counts)) return "counts";
  if (a.errors.size() != b.errors.size()) return "kinds";
  for (const auto& [kind, errors] : a.errors) {
    const auto other = b.errors.find(kind);
    if (other == b.errors.end()) return "kinds";
    const std::string in = difference(errors, other->second);
    if (!in.empty()) return std::string(to_string(kind)) + ", " + in;
  }
  return {};
}

std::string difference(const JudgedValue& a, const JudgedValue& b) {
  if (a.kind != b.kind || a.attribute != b.attribute) return "what its values are of";
  if (std::bit_cast<std::uint32_t>(a.actual) != std::bit_cast<std::uint32_t>(b.actual)) {
    return "actual";
  }
  if (a.fragment_class != b.fragment_class) return "class of a value";
  if (!overlap(a.excess, b.excess)) return "excess of a value";
  return overlap(a.ideal, b.ideal) ? "" : "ideal error of a value";
}

auto place_of(const JudgedSample& s) {
  return std::tie(s.place.triangle, s.place.y, s.place.x, s.place.sample);
}

std::string difference(const JudgedSample& a, const JudgedSample& b) {
  if (place_of(a) != place_of(b)) return "place";
  if (a.decision.verdict != b.decision.verdict) return "verdict";
  if (a.decision.reason != b.decision.reason) return "reason";
  if (a.fragment_class != b.fragment_class) return "class";
  if (a.values.size() != b.values.size()) return "how many values";
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (const std::string in = difference(a.values[i], b.values[i]); !in.empty()) return in;
  }
  return {};
}

std::string difference(const std::vector<JudgedSample>& a, const std::vector<JudgedSample>& b) {
  if (a.size() != b.size()) return "how many samples were shown";
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (const std::string in = difference(a[i], b[i]); !in.empty()) {
      return "sample " + std::to_string(i) + ": " + in;
    }
  }
  return {};
}

bool is_ordinary(const JudgedSample& s) {
  return s.fragment_class == FragmentClass::correct &&
         s.decision.verdict == records::Verdict::required &&
         s.decision.reason == records::Reason::inside &&
         std::all_of(s.values.begin(), s.values.end(), [](const JudgedValue& value) {
           return value.fragment_class == FragmentClass::correct;
         });
}

std::uint64_t total(const records::LevelCounts& levels) {
  return levels.filter + levels.interval + levels.exact;
}

/// Checks the counts of levels: each sample of a triangle's box is decided at most once, and each
/// defined value is judged once.
std::string miscounted_levels(const SceneTruth& scene, const records::Judgement& judgement) {
  std::uint64_t samples = 0;
  for (std::size_t t = 0; t < scene.source().triangles.size(); ++t) {
    const TriangleTruth truth(scene, t);
    const PixelBox box = truth.pixels();
    if (box.x1 <= box.x0 || box.y1 <= box.y0) continue;
    samples += static_cast<std::uint64_t>((box.x1 - box.x0) * (box.y1 - box.y0)) *
               static_cast<std::uint64_t>(scene.source().framebuffer.samples);
  }
  std::uint64_t values = 0;
  for (const auto& [kind, errors] : judgement.errors) {
    for (const std::uint64_t count : errors.classes.counts) {
      values += kind == AttributeKind::coverage ? 0 : count;
    }
  }
  // Samples of a triangle that is culled or has no area need not be decided.
  if (total(judgement.levels.samples) > samples) return "more samples than there are";
  if (total(judgement.levels.values) != values) return "levels of values";
  return {};
}

std::string at_level(Level level, const std::string& what) {
  constexpr std::array<const char*, 3> kNames{"filter", "interval", "exact"};
  return std::string(kNames[static_cast<std::size_t>(level)]) + ": " + what;
}

}  // namespace

Outcome outcome_of(const SceneTruth& scene, const cases::Fragments& drawn,
                   const JudgeOptions& options) {
  Outcome outcome;
  outcome.judged =
      judge(scene, drawn, options, [&outcome](const JudgedSample& sample, const TriangleTruth*) {
        outcome.samples.push_back(sample);
      });
  return outcome;
}

std::string difference(const Outcome& a, const Outcome& b) {
  if (const std::string in = difference(a.judged.judgement, b.judged.judgement); !in.empty()) {
    return in;
  }
  if (a.judged.seen_triangles != b.judged.seen_triangles) return "seen triangles";
  return difference(a.samples, b.samples);
}

std::string difference_in_bits(const Outcome& a, const Outcome& b) {
  if (const std::string in = difference(a, b); !in.empty()) return in;
  if (!(a.judged.judgement == b.judged.judgement)) return "judgement";
  if (a.judged.fault != b.judged.fault) return "fault";
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    for (std::size_t v = 0; v < a.samples[i].values.size(); ++v) {
      const JudgedValue& one = a.samples[i].values[v];
      const JudgedValue& other = b.samples[i].values[v];
      if (one.excess != other.excess || one.ideal != other.ideal) return "enclosures";
    }
  }
  return {};
}

std::string disagreement(const SceneTruth& scene, const cases::Fragments& drawn) {
  JudgeOptions options = from(Level::exact);
  const Outcome exact = outcome_of(scene, drawn, options);
  const records::Levels& exact_levels = exact.judged.judgement.levels;
  Outcome one;
  for (const Level level : {Level::exact, Level::interval, Level::filter}) {
    options.first_level = level;
    one = level == Level::exact ? exact : outcome_of(scene, drawn, options);
    std::string in = difference(exact, one);
    if (in.empty()) in = miscounted_levels(scene, one.judged.judgement);
    const records::Levels& levels = one.judged.judgement.levels;
    if (in.empty() && total(levels.samples) != total(exact_levels.samples)) {
      in = "levels of samples";
    }
    const auto by_filter = levels.samples.filter + levels.values.filter;
    const auto by_interval = levels.samples.interval + levels.values.interval;
    if (in.empty() && level != Level::filter && by_filter > 0) in = "asked the filter";
    if (in.empty() && level == Level::exact && by_interval > 0) in = "asked intervals";
    if (!in.empty()) return at_level(level, in);
  }
  // The checks below are about the judgement that starts at the filter only.
  const records::Judgement unseen = judge(scene, drawn, options).judgement;
  if (!(unseen == one.judged.judgement)) return "no one is shown samples";
  for (const unsigned jobs : {2U, 3U}) {
    options.jobs = jobs;
    const std::string in = difference_in_bits(one, outcome_of(scene, drawn, options));
    if (!in.empty()) return std::to_string(jobs) + " jobs: " + in;
  }
  options.shows_ordinary = false;
  const Outcome hidden = outcome_of(scene, drawn, options);
  std::erase_if(one.samples, is_ordinary);
  const std::string in = difference_in_bits(one, hidden);
  return in.empty() ? in : "without what is ordinary: " + in;
}

std::string wrong_verdict(const SceneTruth& scene) {
  const cases::Fragments all = everything(scene);
  for (const Level level : kLevels) {
    JudgeOptions options;
    options.judges_values = false;
    options.self_check_one_in = level == Level::exact ? 1 : 0;
    options.first_level = level;
    std::string wrong;
    const auto see = [&](const JudgedSample& s, const TriangleTruth* truth) {
      const int x = static_cast<int>(s.place.x);
      const int y = static_cast<int>(s.place.y);
      const records::SampleVerdict right = truth->judge(x, y, static_cast<int>(s.place.sample));
      // If a level forbids a sample by mistake, the judge decides again to learn the reason, but
      // counts the fragment as extra.
      const bool is_extra = s.fragment_class == records::FragmentClass::extra;
      const bool is_right =
          s.decision.verdict == right.verdict &&
          is_extra == (right.verdict == records::Verdict::forbidden) &&
          (right.verdict == records::Verdict::forbidden || s.decision.reason == right.reason);
      if (!is_right && wrong.empty()) {
        wrong = at_level(level, std::to_string(x) + "," + std::to_string(y) + "/" +
                                    std::to_string(s.place.sample));
      }
    };
    const JudgedDrawing judged = judge(scene, all, options, see);
    if (!wrong.empty()) return wrong;
    if (judged.fault) return at_level(level, *judged.fault);
  }
  return {};
}

}  // namespace rastercheck::oracle
