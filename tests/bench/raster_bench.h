#pragma once

namespace rastercheck::bench {

/// Adds the benchmarks raster/METHOD/random_72px, one for each textbook method. Call this from
/// main(), when all methods have registered themselves.
void register_methods();

}  // namespace rastercheck::bench
