#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks campaign/…, one for each law: to be called when all have registered
/// themselves, which is once main() runs.
void register_campaigns();

}  // namespace rastercheck::bench
