#pragma once

// What a law asks a backend in the course of one check, recorded, so that the same can be asked of
// another backend without the law, whose oracle takes far longer than any drawing.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backends/backend.h"

namespace rastercheck::mutants {

/// Answers as another backend does, and keeps questions and answers.
class RecordingBackend : public backends::Backend {
 public:
  /// `answering` outlives it.
  explicit RecordingBackend(backends::Backend& answering) : answering_(&answering) {}

  /// Whether `other` gives the same answers to the questions kept, to the bit. A law, which knows
  /// nothing but the case and the answers, then finds of the other what it has found of this one:
  /// up to the first difference it asks the same.
  bool is_answered_alike_by(backends::Backend& other) const;

  cases::Contract contract(const cases::Case& c) const override;
  Result<cases::Fragments> draw(const cases::Case& c) override;
  bool traces() const override;
  Result<std::optional<records::SampleTrace>> trace(const cases::Case& c,
                                                    const cases::SamplePlace& at) override;
  bool draws_pictures() const override;
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override;
  bool draws_over() const override;
  Result<void> draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                         cases::Picture& picture) override;
  std::vector<std::string> same_as() const override;
  bool assembles() const override;
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override;
  bool transforms() const override;
  Result<std::vector<cases::ClipVertex>> transform(const cases::Case& c) override;
  Result<std::vector<cases::Normal>> transform_normals(
      const cases::Matrix4& model, std::span<const cases::Normal> normals) override;

 private:
  template <typename Question>
  auto asked(const Question& question) const;

  backends::Backend* answering_;
  /// Each asks a backend and says whether its answer is the one kept.
  mutable std::vector<std::function<bool(backends::Backend&)>> questions_;
};

}  // namespace rastercheck::mutants
