/*
 * Promises the exact triangle, though it snaps.
 *
 * RasterCheck: “the sample is drawn and must not be (outside)”
 */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) {
  static rastercheck_contract exact;
  exact = contract;
  exact.coverage = RASTERCHECK_COVERAGE_EXACT;
  exact.basis = RASTERCHECK_BASIS_IDEAL;
  return little_with_contract(&exact);
}
