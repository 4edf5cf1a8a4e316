#pragma once

// Coverage of one triangle by the first two levels of the cascade (docs/oracle.md); what they leave
// open is decide()'s (oracle/internal/coverage.h).

#include <array>
#include <optional>
#include <vector>

#include "oracle/internal/coverage.h"
#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/intervals.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/level.h"

namespace rastercheck::oracle {

/// The verdicts of a row of samples, by two bits each; both zero where they are left open.
struct RowVerdicts {
  std::vector<std::uint64_t> required;   ///< bit x − box.x0; inside all boundaries
  std::vector<std::uint64_t> forbidden;  ///< outside
};

/// A line in doubles about a pixel, for samples of the box; nothing where a coefficient is so large
/// or small that what is computed from it might leave the normal doubles.
std::optional<FilterLine> filter_line(const Line& line, const PixelBox& box);

/// The same in intervals.
IntervalLine interval_line(const Line& line, const PixelBox& box);

class TriangleFilter {
 public:
  /// The triangle must outlive it. `box` holds all pixels that will be asked for. Levels before
  /// `first` leave all open.
  TriangleFilter(const TriangleSetup& triangle, const PixelBox& box, Level first);

  const PixelBox& box() const { return box_; }
  /// Nothing in the box is required or permitted.
  bool is_empty() const { return is_empty_; }

  /// Whether the first level says anything of it.
  bool has_first_level() const { return !lines_.empty(); }

  /// The edges of a map where they are those that coverage is decided by, and no others than
  /// exactly these; three, or nullptr.
  const FilterLine* edges_of(const ProjectiveMap* map) const;

  /// The first level, for that sample of the pixels of row y. Of pixels some of whose samples may
  /// lie outside the viewport no sample is required.
  void classify(int y, const cases::SamplePosition& sample, RowVerdicts& row) const;

  /// The second level; under UpwardRounding. Nothing where it is left open.
  std::optional<records::SampleVerdict> decide(int x, int y,
                                               const cases::SamplePosition& sample) const;

 private:
  struct SignedLine {
    IntervalLine line;
    int sign_a = 0;
    int sign_b = 0;
  };
  /// A boundary as one reading of the contract has it, off by up to `margin`.
  struct OpenLine {
    Line line;
    Ring margin;
  };
  bool is_cut_and_culled() const;
  void set_inner_pixels();
  void add_line_of_degenerate();
  void add_cut_lines();
  bool add(const Line& line, const Ring& margin);
  bool add_enclosing(const std::vector<OpenLine>& readings);
  std::vector<OpenLine> readings_of_edge(std::size_t edge) const;
  bool add_clip_line(const ClipFunctional& functional);
  void make_interval_lines() const;

  const TriangleSetup* triangle_;
  PixelBox box_;
  Level first_level_;
  std::optional<CoverageBoundary> boundary_;
  /// Those whose samples lie within the viewport however far its sides may be off.
  PixelBox inner_;
  bool is_empty_ = false;
  std::vector<FilterLine> lines_;  ///< edges, then clip functionals; empty: no first level
  mutable std::vector<SignedLine> interval_lines_;  ///< made when first asked for
};

}  // namespace rastercheck::oracle
