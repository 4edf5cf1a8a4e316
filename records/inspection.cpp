#include "records/inspection.h"

#include <algorithm>

namespace rastercheck::records {

const InspectedSample* inspected_sample(const Inspection& inspection) {
  const auto found = std::find_if(
      inspection.samples.begin(), inspection.samples.end(), [&](const InspectedSample& one) {
        return one.place.x == inspection.place.x && one.place.y == inspection.place.y &&
               one.place.sample == inspection.place.sample;
      });
  return found == inspection.samples.end() ? nullptr : &*found;
}

}  // namespace rastercheck::records
