#pragma once

// The probed backend, the cases it is asked to draw, and the results so far.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract_terms.h"
#include "cases/fragments.h"
#include "cases/picture.h"
#include "properties/draw.h"
#include "properties/probing/probe.h"
#include "properties/window_position.h"
#include "records/judgement.h"
#include "records/probe.h"

namespace rastercheck::properties {

inline constexpr cases::PixelFraction kPixelCentre{1, 1, 2};
cases::PixelFraction in_lowest_terms(const cases::PixelFraction& at);

/// A case and its drawing.
struct DrawnCase {
  cases::Case source;
  cases::Fragments fragments;
};

/// Coverage of drawings counted under a contract.
struct CoverageTally {
  std::uint64_t required = 0;
  std::uint64_t missing = 0;
  std::uint64_t extra = 0;
  bool holds() const { return missing == 0 && extra == 0; }
  CoverageTally& operator+=(const CoverageTally& other);
};

class Subject {
 public:
  /// Makes the backend promise something for every case during the Subject's lifetime, as
  /// properties::draw() requires.
  Subject(std::string name, backends::Backend& backend, const ProbeOptions& options);
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  ~Subject();

  /// Chooses the rules for all cases. Fails as probe() does if the backend draws nothing.
  Result<void> choose_rules();

  /// The backend, set to accept all numbers, whatever it promises.
  backends::Backend& backend() { return *backend_; }
  /// The backend's contract for a triangle in the middle of a base() case, by these rules if given.
  cases::Contract declared(std::optional<cases::Rules> rules = std::nullopt) const;
  /// The cases that the backend draws.
  cases::Capabilities capabilities() const;
  const ProbeOptions& options() const { return options_; }

  /// A case of 64×64 pixels without vertices, with the settings of asked(), by these rules if
  /// given.
  cases::Case base(std::optional<cases::Rules> rules = std::nullopt) const;
  /// Where a pixel's only sample lies, from its corner of least window x and y: as the backend
  /// declares, until set_sample() says what was measured.
  const cases::PixelFraction& sample() const { return sample_; }
  void set_sample(const cases::PixelFraction& sample) { sample_ = sample; }
  /// The settings that all cases ask for.
  const AskedDrawing& asked() const { return asked_; }
  void ask(const AskedDrawing& asked) { asked_ = asked; }
  /// Applies the settings that are not empty to another case.
  void ask_of(cases::Case& c) const;

  /// True once the time is up (ProbeOptions::is_time_up). From then on nothing is drawn or judged
  /// any more, so the running measure must be discarded.
  bool is_time_up() const;
  /// True if is_time_up() was ever true.
  bool was_cut_short() const { return was_cut_short_; }

  /// Returns the backend's drawing; empty if it does not draw the case, or if the time is up.
  std::optional<cases::Fragments> draw(const cases::Case& c);
  std::optional<DrawnCase> drawn(cases::Case c);
  /// True if the backend draws pictures.
  bool draws_pictures();
  /// Returns the backend's picture; empty if it does not draw it, or if the time is up. The backend
  /// must draw pictures.
  std::optional<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline);

  /// Returns the contract measured so far, for a case.
  cases::Contract contract(const cases::Case& c) const;
  /// Counts drawings' coverage under the contract with these terms in place of the measured ones.
  CoverageTally tally(const std::vector<DrawnCase>& drawn, const cases::ContractTerms& terms) const;
  /// True if no sample is missing or extra.
  bool holds(const std::vector<DrawnCase>& drawn, const cases::ContractTerms& terms) const;
  /// Returns the judge's full result, by kind of value.
  records::Judgement judgement(const DrawnCase& drawn, const cases::ContractTerms& terms) const;

  /// Adds a row and returns it.
  records::Measured& add(std::string what, std::string declared, std::string measured,
                         std::string detail = "", records::Sureness sureness = {});

  records::Probe result;  ///< rows and terms measured so far

 private:
  /// Counts a drawing that failed.
  void count_failure(const Error& error);

  backends::Backend* backend_;
  std::optional<cases::ContractTerms> terms_before_;
  ProbeOptions options_;
  AskedDrawing asked_;
  cases::PixelFraction sample_ = kPixelCentre;
  mutable bool was_cut_short_ = false;
  cases::Rules rules_ = cases::Rules::vulkan;
};

/// A sureness of counts that may be of any integer type.
template <typename A, typename B = int, typename C = int>
records::Sureness sure_of(const char* unit, A in_favour, B against = 0, C undecided = 0) {
  return {unit, static_cast<std::uint64_t>(in_favour), static_cast<std::uint64_t>(against),
          static_cast<std::uint64_t>(undecided)};
}

/// A stream of random choices for one measure.
class MeasureDraw : public Draw {
 public:
  MeasureDraw(const Subject& subject, const std::string& measure, std::uint64_t index = 0)
      : Draw(subject.options().seed, "probe: " + measure, index) {}
  /// For cases that are fitted to a backend with these capabilities, which must outlive this.
  MeasureDraw(const Subject& subject, const std::string& measure, std::uint64_t index,
              const cases::Capabilities& capabilities)
      : Draw(subject.options().seed, "probe: " + measure, index, capabilities) {}
};

/// Stands for a declared value that contracts do not cover.
inline constexpr const char* kNotDeclared = "–";

}  // namespace rastercheck::properties
