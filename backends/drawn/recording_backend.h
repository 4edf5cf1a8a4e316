#pragma once

#include <memory>
#include <optional>

#include "backends/backend.h"
#include "backends/drawn/folder.h"

namespace rastercheck::backends {

/// Wraps a backend and adds every case that it is asked to draw to a folder. Leaves out cases
/// beyond its declared capabilities, which nobody promises to draw; a case that it refuses for
/// other reasons is added, because the other machine may draw it. Draws only fragments, as that
/// machine does.
class RecordingBackend : public Backend {
 public:
  /// The folder must outlive the backend.
  RecordingBackend(std::unique_ptr<Backend> inner, CaseFolder& folder)
      : inner_(std::move(inner)), capabilities_(inner_->about().capabilities), folder_(folder) {}

  About about() const override { return drawn_about(inner_->about()); }
  cases::Contract promise(const cases::Case& c) const override { return inner_->promise(c); }

  /// The first error while writing a case; empty if all cases were written.
  const std::optional<Error>& failure() const { return failure_; }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    if (!failure_ && cases::lacked_by(capabilities_, c).empty()) {
      const Result<void> added = folder_.add(c, contract(c));
      if (!added) failure_ = added.error();
    }
    return inner_->draw_unjudged(c);
  }

  std::unique_ptr<Backend> inner_;
  cases::Capabilities capabilities_;
  CaseFolder& folder_;
  std::optional<Error> failure_;
};

}  // namespace rastercheck::backends
