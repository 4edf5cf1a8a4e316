#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks campaign/…, one for each law. Call this from main(), when all laws have
/// registered themselves.
void register_campaigns();

}  // namespace rastercheck::bench
