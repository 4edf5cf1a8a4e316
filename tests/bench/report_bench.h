#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks report/…, which include one for each format. Call this from main(), when all
/// formats have registered themselves.
void register_reports();

}  // namespace rastercheck::bench
