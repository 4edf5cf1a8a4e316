#include "records/stage_split.h"

#include "records/histogram.h"

namespace rastercheck::records {

std::optional<Stage> largest_part(const ErrorSplit& split) {
  std::optional<Stage> stage;
  double largest = 0;
  for (const StagePart& part : split.parts) {
    const double size = magnitude_bound(part.error);
    if (size <= largest) continue;
    largest = size;
    stage = part.stage;
  }
  return stage;
}

}  // namespace rastercheck::records
