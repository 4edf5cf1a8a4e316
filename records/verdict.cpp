#include "records/verdict.h"

namespace rastercheck::records {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::required:
      return "required";
    case Verdict::forbidden:
      return "forbidden";
    case Verdict::permitted:
      return "permitted";
  }
  return "?";
}

std::string_view to_string(Reason reason) {
  switch (reason) {
    case Reason::inside:
      return "inside";
    case Reason::tie:
      return "tie";
    case Reason::snapping:
      return "snapping";
    case Reason::clip_edge:
      return "clip edge";
    case Reason::nonpositive_w:
      return "w <= 0";
    case Reason::depth:
      return "depth";
    case Reason::outside:
      return "outside";
    case Reason::clipped:
      return "clipped";
    case Reason::viewport:
      return "viewport";
    case Reason::culled:
      return "culled";
    case Reason::degenerate:
      return "degenerate";
  }
  return "?";
}

}  // namespace rastercheck::records
