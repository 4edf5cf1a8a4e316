#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks report/…, one for each format among them: to be called when all formats have
/// registered themselves, which is once main() runs.
void register_reports();

}  // namespace rastercheck::bench
