#pragma once

// The backend that is probed, the cases it is asked to draw, and what is known of it so far.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract_terms.h"
#include "cases/fragments.h"
#include "properties/draw.h"
#include "properties/probing/probe.h"
#include "properties/window_position.h"
#include "records/judgement.h"
#include "records/probe.h"

namespace rastercheck::properties {

/// A case and what came of it.
struct DrawnCase {
  cases::Case source;
  cases::Fragments fragments;
};

/// How drawings came out under a contract.
struct CoverageTally {
  std::uint64_t required = 0;
  std::uint64_t missing = 0;
  std::uint64_t extra = 0;
  bool holds() const { return missing == 0 && extra == 0; }
  CoverageTally& operator+=(const CoverageTally& other);
};

class Subject {
 public:
  /// Holds the backend to promise something of every case, for as long as it lives:
  /// properties::draw() asks no other.
  Subject(std::string name, backends::Backend& backend, const ProbeOptions& options);
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  ~Subject();

  /// Whether it draws anything; chooses the rules its cases have. Fails as probe() does.
  Result<void> choose_rules();

  /// The backend, which is asked of all numbers, whatever it promises of them.
  backends::Backend& backend() { return *backend_; }
  /// What it promises of a triangle in the middle of a base() case.
  cases::Contract declared() const;
  const ProbeOptions& options() const { return options_; }

  /// A case of 64×64 pixels without vertices that asks for what asked() says.
  cases::Case base() const;
  /// What cases ask for from now on.
  const AskedDrawing& asked() const { return asked_; }
  void ask(const AskedDrawing& asked) { asked_ = asked; }
  /// The same of a case that somebody else made: only what was said is changed.
  void ask_of(cases::Case& c) const;

  /// What it draws; nothing where it does not.
  std::optional<cases::Fragments> draw(const cases::Case& c);
  std::optional<DrawnCase> drawn(cases::Case c);

  /// The contract that is known so far, for a case.
  cases::Contract contract(const cases::Case& c) const;
  /// The same with terms that take the place of the known ones.
  CoverageTally tally(const std::vector<DrawnCase>& drawn, const cases::ContractTerms& terms) const;
  /// Whether nothing is missing, and nothing too much.
  bool holds(const std::vector<DrawnCase>& drawn, const cases::ContractTerms& terms) const;
  /// All that a judge says, by the kind of value.
  records::Judgement judgement(const DrawnCase& drawn, const cases::ContractTerms& terms) const;

  void add(std::string what, std::string declared, std::string measured, std::string detail = "");

  records::Probe result;  ///< its rows and terms are what is known so far

 private:
  backends::Backend* backend_;
  std::optional<cases::ContractTerms> terms_before_;
  ProbeOptions options_;
  AskedDrawing asked_;
  cases::Rules rules_ = cases::Rules::vulkan;
};

/// A stream of choices for one measure.
class MeasureDraw : public Draw {
 public:
  MeasureDraw(const Subject& subject, const std::string& measure, std::uint64_t index = 0)
      : Draw(subject.options().seed, "probe: " + measure, index) {}
};

/// "-" for contracts that say nothing of something.
inline constexpr const char* kNotDeclared = "–";

}  // namespace rastercheck::properties
