#include "properties/campaign/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "cases/json.h"
#include "oracle/judge.h"
#include "oracle/transform.h"
#include "properties/campaign/check_case.h"
#include "properties/judged_law.h"
#include "records/judged.h"

namespace rastercheck::properties {
namespace {

using oracle::JudgedSample;
using oracle::JudgedValue;
using records::FragmentClass;
using records::PixelState;

/// Gathers what the judge says of a scene into its map and its first violations.
class SceneReader {
 public:
  /// `laws`: those that are asked for.
  SceneReader(const oracle::SceneTruth& scene, const KnownDefects* known,
              const std::vector<std::string>& laws)
      : scene_(&scene),
        known_(known),
        asks_of_coverage_(std::find(laws.begin(), laws.end(), kCoverageLaw) != laws.end()),
        asks_of_values_(std::find(laws.begin(), laws.end(), kValuesLaw) != laws.end()) {
    const cases::FramebufferSize& size = scene.source().framebuffer;
    map_.width = size.width;
    map_.height = size.height;
    const std::size_t pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    map_.states.resize(pixels, PixelState::empty);
    map_.errors.resize(pixels, 0);
    depths_.resize(pixels, std::numeric_limits<float>::infinity());
  }

  void see(const JudgedSample& sample, const oracle::TriangleTruth* truth) {
    const bool is_in_map =
        std::cmp_less(sample.place.x, map_.width) && std::cmp_less(sample.place.y, map_.height);
    const std::size_t pixel =
        sample.place.y * static_cast<std::size_t>(map_.width) + sample.place.x;
    bool is_violated = sample.fragment_class != FragmentClass::correct;
    bool is_wrong = is_violated && asks_of_coverage_;
    if (is_violated) note_violation(found_.coverage, sample, nullptr, truth);
    for (const JudgedValue& value : sample.values) {
      if (value.fragment_class == FragmentClass::correct) continue;
      note_violation(found_.values, sample, &value, truth);
      is_violated = true;
      is_wrong = is_wrong || asks_of_values_;
    }
    if (is_violated || sample.decision.verdict != records::Verdict::permitted) ++judged_;
    if (is_wrong) ++wrong_;
    if (!is_in_map) return;
    if (is_violated) {
      map_.states[pixel] = PixelState::violated;
    } else if (map_.states[pixel] == PixelState::empty) {
      map_.states[pixel] = PixelState::correct;
    }
    see_nearest(sample, pixel);
  }

  records::ErrorMap take_map() { return std::move(map_); }
  std::uint64_t judged() const { return judged_; }  ///< samples
  std::uint64_t wrong() const { return wrong_; }    ///< samples
  /// What violates a law: the first violation of each class that is not known.
  struct Few {
    std::string_view law;
    std::set<FragmentClass> ways = {};
    std::vector<records::Violation> violations = {};
    std::set<std::string> known = {};  ///< entries that others are of
  };
  const Few& of(std::string_view law) const {
    return law == kCoverageLaw ? found_.coverage : found_.values;
  }

 private:
  void note_violation(Few& few, const JudgedSample& sample, const JudgedValue* value,
                      const oracle::TriangleTruth* truth) {
    const FragmentClass way = value == nullptr ? sample.fragment_class : value->fragment_class;
    if (few.ways.contains(way)) return;
    records::Violation violation = to_violation(sample, value, truth, *scene_);
    if (known_ != nullptr) {
      const auto ids = entries_of(*known_, few.law, scene_->source(), violation);
      few.known.insert(ids.begin(), ids.end());
      if (!ids.empty()) return;
    }
    few.ways.insert(way);
    few.violations.push_back(std::move(violation));
  }

  /// The map shows the fragment that the picture shows: the nearest of the pixel.
  void see_nearest(const JudgedSample& sample, std::size_t pixel) {
    if (sample.values.empty()) return;
    const float depth = sample.values.front().actual;
    if (!(depth < depths_[pixel])) return;
    depths_[pixel] = depth;
    double largest = 0;
    for (const JudgedValue& value : sample.values) {
      if (!value.attribute || !value.ideal) continue;
      largest = std::max(largest, records::magnitude_bound(*value.ideal));
    }
    map_.errors[pixel] = static_cast<float>(largest);
  }

  struct Found {
    Few coverage{kCoverageLaw};
    Few values{kValuesLaw};
  };

  const oracle::SceneTruth* scene_;
  const KnownDefects* known_;
  bool asks_of_coverage_;
  bool asks_of_values_;
  records::ErrorMap map_;
  std::vector<float> depths_;
  std::uint64_t judged_ = 0;
  std::uint64_t wrong_ = 0;
  Found found_;
};

/// The part of a judgement that a law is about.
records::Judgement coverage_part(const records::Judgement& all) {
  records::Judgement part;
  part.counts = all.counts;
  part.levels.samples = all.levels.samples;
  part.errors[records::AttributeKind::coverage] = all.errors.at(records::AttributeKind::coverage);
  return part;
}

/// Keeps a counterexample for each violation, under the index of its triangle.
void keep_violations(const Law& law, const std::string& specification, backends::Backend& backend,
                     std::uint64_t seed, NumberedCase numbered,
                     const std::vector<records::Violation>& violations, Findings& findings,
                     const KnownDefects* known) {
  for (const records::Violation& violation : violations) {
    numbered.index = violation.place.triangle;
    Check check;
    check.violation_count = 1;
    check.violations = {violation};
    keep_counterexample(law, specification, backend, seed, numbered, check, findings, known);
  }
}

/// The two laws, of those asked for.
std::vector<const Law*> scene_laws(const std::vector<std::string>& asked_for) {
  std::vector<const Law*> chosen;
  for (const std::string_view name : {kCoverageLaw, kValuesLaw}) {
    const Law* law = find_law(name);
    if (law == nullptr) continue;
    if (std::find(asked_for.begin(), asked_for.end(), name) != asked_for.end()) {
      chosen.push_back(law);
    }
  }
  return chosen;
}

}  // namespace

Result<SceneFindings> judge_scene(const cases::Case& scene, const std::string& specification,
                                  backends::Backend& backend, std::uint64_t seed,
                                  const std::vector<std::string>& laws, unsigned jobs,
                                  const KnownDefects* known) {
  Result<cases::ClipCase> clip = oracle::to_clip_case(scene, scene.name);
  if (!clip) return tl::unexpected(clip.error());
  SceneFindings result;
  result.source = *std::move(clip);
  NumberedCase numbered{result.source, std::string(records::kSceneStratum) + scene.name, 0,
                        records::Origin::scene};
  numbered.source.name = numbered.stratum;

  const oracle::SceneTruth truth(result.source, backend.contract(result.source));
  SceneReader reader(truth, known, laws);
  result.result.file = scene.name;
  result.result.backend = specification;
  result.result.triangles = result.source.triangles.size();
  Result<backends::Drawn> drawn = draw(result.source, backend);
  if (!drawn) {
    for (const Law* law : scene_laws(laws)) {
      check_case(*law, specification, backend, seed, numbered, result.findings, known);
    }
    result.result.not_judged[cases::one_line(drawn.error().reason)] = result.result.triangles;
    result.map = reader.take_map();
    return result;
  }
  result.drawn = std::move(drawn->fragments);

  oracle::JudgeOptions options;
  options.jobs = jobs;
  const oracle::JudgedDrawing judged =
      oracle::judge(truth, *result.drawn, options,
                    [&reader](const JudgedSample& sample, const oracle::TriangleTruth* triangle) {
                      reader.see(sample, triangle);
                    });
  result.findings.fault = judged.fault;
  result.map = reader.take_map();
  result.result.fragments = result.drawn->size();
  result.result.judged = reader.judged();
  result.result.wrong = reader.wrong();
  result.result.is_known = result.result.wrong > 0;
  records::Judged all;
  for (const auto& [kind, errors] : judged.judgement.errors) records::add(all, kind, errors);
  result.result.values = all.values;
  result.result.values_not_judged = std::move(all.not_judged);

  for (const Law* law : scene_laws(laws)) {
    const bool is_coverage = law->id == kCoverageLaw;
    const SceneReader::Few& few = reader.of(law->id);
    Check check;
    check.judgement = is_coverage ? coverage_part(judged.judgement) : judged.judgement;
    check.violations = few.violations;
    check.violation_count = few.violations.size() + few.known.size();
    if (few.violations.empty()) check.known.assign(few.known.begin(), few.known.end());
    if (!few.violations.empty()) result.result.is_known = false;
    account(*law, specification, backend, numbered, check, result.findings);
    keep_violations(*law, specification, backend, seed, numbered, few.violations, result.findings,
                    known);
  }
  return result;
}

}  // namespace rastercheck::properties
