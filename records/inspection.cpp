#include "records/inspection.h"

#include <algorithm>

namespace rastercheck::records {

const InspectedSample* inspected_sample(const Inspection& inspection) {
  const auto found = std::find_if(
      inspection.samples.begin(), inspection.samples.end(), [&](const InspectedSample& one) {
        return one.x == inspection.x && one.y == inspection.y && one.sample == inspection.sample;
      });
  return found == inspection.samples.end() ? nullptr : &*found;
}

}  // namespace rastercheck::records
